//! What a given slip wears under a load that stays as it is.
//!
//! # Formula
//!
//! ```text
//! Δf = wear(τ, Δs),   τ = ±μp where all slip in one direction;   ΔE_d = 2∫ μq |Δs| dx
//! ```
//!
//! Eq. (15) of the paper and its work of friction, with p and q of the contact as it is solved.

use super::super::Setup;
use super::super::workspace::Workspace;
use super::worn_volume::{self, LoadEnd};
use crate::math::abel::bend::Bend;

/// Wears `work.surface_slip` in a time of `seconds` under `work.pressure`, into `work.worn` (m) and
/// `work.beyond_nodes` (m³), and returns the work of friction of `work.slip` with its `kinks` (J). From the node
/// `zone` on τ is `sign` times μp; further in, it is what `work.working_shear` says.
pub(super) fn wear(
    setup: &Setup,
    work: &mut Workspace,
    zone: usize,
    sign: f64,
    seconds: f64,
    kinks: &[(usize, Bend)],
) -> f64 {
    let friction = setup.material.friction();
    let pressures = work.pressure[zone..].iter();
    for (tau, p) in work.working_shear[zone..].iter_mut().zip(pressures) {
        *tau = sign * friction * p;
    }
    for (limit, load) in work.friction_work.iter_mut().zip(&work.normal_load) {
        *limit = friction * load;
    }
    match &setup.wear {
        Some(law) => {
            let (tau, slip) = (&work.working_shear, &work.surface_slip);
            law.wear(tau, slip, seconds, &mut work.worn);
        }
        None => work.worn.fill(0.0),
    }
    let end = LoadEnd::now(work);
    work.beyond_nodes = worn_volume::beyond_nodes(setup, work, [end, end], zone);
    let (contact, rim_edge) = (&work.contact.normal, work.rim_edge.as_ref());
    let between_springs = worn_volume::between_springs(setup, &work.normal_breaks, rim_edge);
    let at_edge = match contact.nodes {
        0 => 0.0,
        nodes => 2.0 * friction * between_springs * work.slip[nodes - 1].abs(),
    };
    let row = &work.planned.row;
    let (limit, slip) = (&work.friction_work, &work.slip);
    at_edge + row.work(limit, slip, kinks, contact.edge())
}

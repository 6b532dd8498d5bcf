//! Explicit Euler, the paper's own.
//!
//! # Formula
//!
//! Fig. 1 of the paper: f → g by Eq. (1) → springs → τ by Eq. (3) and the slip of the surface by
//! Eq. (2) → f by the wear law, Eq. (15).
//!
//! The slip of the springs is what Eq. (2) transforms, not their displacement: the two are the same
//! by linearity, since a rigid shift maps to itself, but the slip is exactly zero inside the stick
//! zone and stays so under a causal transform.
//!
//! - **Order**: first in the step.
//! - **Limit**: stable while μkE*s < 4h/π, s the slip of a step and h the cell's width.

use super::super::Setup;
use super::super::breakdown::Cause;
use super::super::solve::{self, solve_contact};
use super::super::stability;
use super::super::state::State;
use super::super::stress;
use super::super::workspace::Workspace;
use super::parts::{self, Outcome, Part};
use super::{commit, stiffness};
use crate::contact::tangential::Hold;
use crate::math::abel::bend;
use crate::math::scan::leading;
use crate::math::vector::{vectorized, write_each};

/// The stiffness beyond which a step is taken in parts, and that of the parts, in limits: an explicit
/// step at its limit rings, at half of it no error changes its sign.
const HARSH: f64 = 0.5;
const AIM: f64 = 0.4;

/// One step from the state's cycle to `cycle`.
pub(super) fn step(
    setup: &Setup,
    state: &mut State,
    work: &mut Workspace,
    cycle: f64,
) -> Result<(), Cause> {
    let limit = stability::limit(setup.scheme);
    parts::step(
        setup.stability,
        AIM * limit,
        state,
        cycle,
        |state, reach, part| {
            // The contact is solved on the profile as it stands.
            std::mem::swap(&mut work.g, &mut work.predicted);
            let solved = solve_contact(setup, state, work, reach);
            std::mem::swap(&mut work.g, &mut work.predicted);
            solved?;
            let mut friction_work = worn(setup, state, work, reach);
            let stiffness = stiffness::of_step(setup, work, reach - state.cycle);
            match part {
                Part::Guarded if stiffness > HARSH * limit => {
                    return Ok(Outcome::TooHarsh(stiffness));
                }
                Part::Guarded | Part::Raw => {}
                Part::Snap => friction_work *= stiffness::damp(work),
            }
            commit(setup, state, work, reach, friction_work)?;
            Ok(Outcome::Done(stiffness))
        },
    )
}

/// What the step that the contact has been solved for wears (m, into `work.worn`), and its work of
/// friction (J).
pub(super) fn worn(setup: &Setup, state: &State, work: &mut Workspace, cycle: f64) -> f64 {
    work.beyond_nodes = None;
    if setup.drive.tangential().is_none() {
        return 0.0;
    }
    if let Some(law) = &setup.wear {
        // Method B's stress looks one node across.
        let end = (work.contact.normal.nodes + 1).min(work.worn.len());
        solve::surface_slip(work, end);
        let first = leading(&work.surface_slip[..end], |&slip| slip == 0.0);
        work.sliding = first..end;
        let (mut tau, mut rest) = (
            std::mem::take(&mut work.working_shear),
            std::mem::take(&mut work.rest),
        );
        let core = state.core_radius();
        stress::shear_of(first..end, work, &setup.material, core, &mut rest, &mut tau);
        (work.working_shear, work.rest) = (tau, rest);
        work.transforms += 1;
        let seconds = (cycle - state.cycle) * setup.drive.period();
        let (tau, slip) = (
            &work.working_shear[first..end],
            &work.surface_slip[first..end],
        );
        work.worn[..first].fill(0.0);
        work.worn[end..].fill(0.0);
        let worn = &mut work.worn[first..end];
        vectorized(
            #[inline(always)]
            || law.wear(tau, slip, seconds, worn),
        );
    }
    work_of_friction(setup, work)
}

/// 2∫ q_x Δs dx, the integrand falling to zero at the contact's edge.
fn work_of_friction(setup: &Setup, work: &mut Workspace) -> f64 {
    let modulus = setup.material.tangential_modulus();
    // Springs that stick do no work, those out of contact bear nothing.
    let end = work.contact.normal.nodes;
    let first = leading(&work.hold[..end], |&hold| hold == Hold::Stick);
    work.friction_work[..first].fill(0.0);
    work.friction_work[end..].fill(0.0);
    write_each(
        &mut work.friction_work[first..end],
        &work.spring[first..end],
        &work.slip[first..end],
        #[inline(always)]
        |u, slip| modulus * u * slip,
    );
    let (normal, squares) = (&work.contact.normal, work.planned.grid.squares());
    work.work_breaks.clear();
    if normal.nodes > 0 && normal.nodes < squares.len() {
        let last = normal.nodes - 1;
        let ends = [work.friction_work[last], work.friction_work[last + 1]];
        let edge = (normal.radius * normal.radius, 0.0);
        bend::polyline(
            [squares[last], squares[last + 1]],
            ends,
            &[edge],
            &mut work.work_breaks,
        );
    }
    work.planned
        .row
        .force(&work.friction_work, &work.work_breaks, normal.edge())
}

//! How stiffly the pressure answers to wear: what limits an explicit step.
//!
//! # Formula
//!
//! Wear that answers to the stress with ∂Δf/∂τ feeds back, at a node with cells of the width h, with
//!
//! ```text
//! z = ρ μ E* ∂Δf/∂τ / h,       k s for ∂Δf/∂τ under Archard's law
//! ```
//!
//! ρ the [largest eigenvalue](super::super::stability::response) of the response of p to wear.

use super::super::Setup;
use super::super::stability::response;
use super::super::workspace::Workspace;
use crate::math::quadrature::weighted;
use crate::math::scan::largest;
use crate::math::vector::vectorized;

/// The stiffness z of every node that slides in the step of `duration` cycles that has just been worn, into
/// `work.stiffness`; returns the largest.
pub(super) fn of_step(setup: &Setup, work: &mut Workspace, duration: f64) -> f64 {
    let Some(law) = &setup.wear else { return 0.0 };
    let seconds = duration * setup.drive.period();
    let scale =
        response(setup.method) * setup.material.friction() * setup.material.normal_modulus();
    let nodes = || work.sliding.clone();
    let (tau, slip) = (&work.working_shear[nodes()], &work.surface_slip[nodes()]);
    let (stiffness, per_width) = (
        &mut work.stiffness[nodes()],
        &work.planned.per_width[nodes()],
    );
    vectorized(
        #[inline(always)]
        || {
            law.sensitivity(tau, slip, seconds, stiffness);
            for (z, per_width) in stiffness.iter_mut().zip(per_width) {
                *z *= scale * per_width;
            }
            largest(stiffness)
        },
    )
}

/// Lets every node wear what an implicit step with its own response alone would, Δf/(1 + z): monotone for
/// any z. Returns the share of the wear that is left: that of the stress which is left at the end of the
/// step, and so that of the work of friction.
pub(super) fn damp(work: &mut Workspace) -> f64 {
    let explicit = weighted(&work.planned.volume_weights, &work.worn);
    let nodes = work.sliding.clone();
    let stiffness = &work.stiffness[nodes.clone()];
    for (worn, z) in work.worn[nodes].iter_mut().zip(stiffness) {
        *worn /= 1.0 + z;
    }
    if explicit > 0.0 {
        weighted(&work.planned.volume_weights, &work.worn) / explicit
    } else {
        1.0
    }
}

//! How stiffly the pressure answers to wear: what limits an explicit step.
//!
//! # Formula
//!
//! The response of p to wear at one node is E* D with D ≈ 0.87/h, h the width of its cell, and the
//! largest eigenvalue of the response in units of D is 1.7 on any grid of the product method. Wear
//! that answers to the stress with ∂Δf/∂τ therefore feeds back with
//!
//! ```text
//! z = 1.48 μ E* ∂Δf/∂τ / h,       k s for ∂Δf/∂τ under Archard's law
//! ```
//!
//! An explicit step is stable for z < 2.

use super::super::Setup;
use super::super::workspace::Workspace;

/// Largest eigenvalue of the response of p to wear times its diagonal, 1.7 · 0.87, per cell's width.
const RESPONSE: f64 = 1.48;

/// The stiffness z of every node in the step of `duration` cycles that has just been worn, into
/// `work.stiffness`; returns the largest.
pub(super) fn of_step(setup: &Setup, work: &mut Workspace, duration: f64) -> f64 {
    let Some(law) = &setup.wear else { return 0.0 };
    let seconds = duration * setup.drive.period();
    let scale = RESPONSE * setup.material.friction() * setup.material.normal_modulus();
    let points = work.working_shear.iter().zip(&work.surface_slip);
    let mut stiffest: f64 = 0.0;
    for ((z, width), (&tau, &slip)) in work
        .stiffness
        .iter_mut()
        .zip(&work.planned.widths)
        .zip(points)
    {
        *z = 0.0;
        if tau != 0.0 && slip != 0.0 {
            *z = scale / width * law.sensitivity(tau, slip, seconds);
            stiffest = stiffest.max(*z);
        }
    }
    stiffest
}

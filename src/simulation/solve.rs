//! One contact problem: the worn profile and the springs' memory in, loads and displacements out.

use super::Setup;
use super::breakdown::Cause;
use super::drive::Target;
use super::workspace::{Contact, Workspace};
use crate::contact::normal;
use crate::contact::tangential::{Grip, Slide, slide};
use crate::math::root;

/// Brings g up to date with the worn depth `wear` (m) by Eq. (1).
pub(super) fn update_profile(work: &mut Workspace, wear: &[f64]) {
    work.plan.profile(wear, &mut work.g);
    for (g, unworn) in work.g.iter_mut().zip(work.unworn_1d.iter()) {
        *g += unworn;
    }
}

/// Presses and shifts the indenter to what the drive asks for at `cycle`.
///
/// Reads `work.g`; writes the loads, the springs and their slip. `spring` and `shift` are the
/// springs and the indenter before.
pub(super) fn solve_contact(
    setup: &Setup,
    work: &mut Workspace,
    cycle: f64,
    spring: &[f64],
    shift: f64,
) -> Result<(), Cause> {
    let depth = depth_at(setup, work, cycle)?;
    let xs = setup.grid.nodes();
    let modulus = setup.material.normal_modulus();
    let normal = normal::press(xs, &work.g, depth, modulus, &mut work.normal_load);
    if !normal.force.is_finite() {
        return Err(Cause::NotFinite {
            quantity: "normal force",
            method: setup.method,
        });
    }
    let has_rim = setup.indenter.rim().is_some();
    if !has_rim
        && normal.nodes == xs.len()
        && work.normal_load[xs.len() - 1] > 1e-9 * modulus * depth
    {
        let radius = setup.grid.radius();
        // Wear only lowers the surface: where f₀ exceeds the depth, nothing ever touches.
        return Err(if work.unworn[xs.len() - 1] >= depth * (1.0 - 1e-9) {
            Cause::BlownUp {
                radius,
                method: setup.method,
            }
        } else {
            Cause::EdgeReached {
                domain_radius: radius,
            }
        });
    }
    work.contact = Contact {
        depth,
        shift,
        normal,
        tangential_force: 0.0,
        slide: None,
    };
    match setup.drive.tangential_at(cycle) {
        None => Ok(()),
        Some(Target::Displacement(target)) => {
            shift_by(setup, work, target - shift, spring);
            work.contact.shift = target;
            Ok(())
        }
        Some(Target::Force(target)) => {
            let increment = increment_for_force(setup, work, target, spring)?;
            shift_by(setup, work, increment, spring);
            work.contact.shift = shift + increment;
            Ok(())
        }
    }
}

/// The depth, m: prescribed, or the one that carries the prescribed force.
fn depth_at(setup: &Setup, work: &mut Workspace, cycle: f64) -> Result<f64, Cause> {
    match setup.drive.normal_at(cycle) {
        Target::Displacement(depth) => Ok(depth),
        Target::Force(force) => {
            let deepest = work.g[setup.grid.cells()];
            normal::depth_for_load(
                setup.grid.nodes(),
                &work.g,
                force,
                setup.material.normal_modulus(),
                deepest,
                &mut work.normal_load,
            )
            .ok_or(Cause::LoadTooLarge {
                force,
                domain_radius: setup.grid.radius(),
            })
        }
    }
}

/// Moves the tangential springs from `spring` by `increment` (m).
fn shift_by(setup: &Setup, work: &mut Workspace, increment: f64, spring: &[f64]) -> Slide {
    work.spring.copy_from_slice(spring);
    let grip = Grip {
        xs: setup.grid.nodes(),
        normal_load: &work.normal_load,
        contact_radius: work.contact.normal.radius,
        reach: setup.material.friction() / setup.material.tangential_modulus(),
    };
    let slide = slide(grip, increment, &mut work.spring, &mut work.slip);
    for (load, u) in work.tangential_load.iter_mut().zip(&work.spring) {
        *load = setup.material.tangential_modulus() * u;
    }
    work.contact.slide = Some(slide);
    work.contact.tangential_force = line_integral(setup, work, &work.tangential_load);
    slide
}

/// 2∫ q dx over the contact.
pub(super) fn line_integral(setup: &Setup, work: &Workspace, q: &[f64]) -> f64 {
    let normal = work.contact.normal;
    normal::force(setup.grid.nodes(), q, normal.nodes, normal.radius)
}

/// The increment of displacement (m) that brings the tangential force to `target` (N).
fn increment_for_force(
    setup: &Setup,
    work: &mut Workspace,
    target: f64,
    spring: &[f64],
) -> Result<f64, Cause> {
    let limit = setup.material.friction() * work.contact.normal.force;
    if target.abs() >= limit {
        return Err(Cause::FrictionExceeded {
            force: target,
            limit,
        });
    }
    // Twice the largest strain a spring can hold turns every spring over.
    let stiffest = work.normal_load.iter().copied().fold(0.0, f64::max);
    let span = 2.0 * stiffest * setup.material.friction() / setup.material.tangential_modulus();
    root::bracketed(
        |increment| {
            shift_by(setup, work, increment, spring);
            (work.contact.tangential_force - target) / limit
        },
        -span,
        span,
        1e-15 * span,
    )
    .ok_or(Cause::FrictionExceeded {
        force: target,
        limit,
    })
}

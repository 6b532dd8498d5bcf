//! One contact problem: the worn profile and the springs' memory in, loads and displacements out.

use super::Setup;
use super::breakdown::Cause;
use super::drive::Target;
use super::state::State;
use super::workspace::{Contact, Workspace};
use crate::contact::material::Material;
use crate::contact::normal;
use crate::contact::tangential::{self, Grip, Motion};
use crate::math::abel::{bend, rim_edge};
use crate::math::root;
use crate::math::scan::largest;

/// Presses the indenter to what the drive asks for at `cycle` on the 1D profile `work.predicted`. Writes the
/// normal loads; the springs stay where they are.
pub(super) fn press_at(setup: &Setup, work: &mut Workspace, cycle: f64) -> Result<(), Cause> {
    let depth = depth_at(setup, work, cycle)?;
    press(setup, work, depth)
}

/// Presses and shifts the indenter to what the drive asks for at `cycle`, from the springs and the
/// shift of `state`, with the 1D profile `work.predicted`. Writes the loads, the springs, their slip
/// and the scalars.
pub(super) fn solve_contact(
    setup: &Setup,
    state: &State,
    work: &mut Workspace,
    cycle: f64,
) -> Result<(), Cause> {
    press_at(setup, work, cycle)?;
    work.contact.shift = state.shift;
    match setup.drive.tangential_at(cycle) {
        None => Ok(()),
        Some(Target::Displacement(target)) => {
            shift_by(setup, state, work, target - state.shift);
            work.contact.shift = target;
            Ok(())
        }
        Some(Target::Force(target)) => {
            let increment = increment_for_force(setup, state, work, target)?;
            shift_by(setup, state, work, increment);
            work.contact.shift = state.shift + increment;
            Ok(())
        }
    }
}

fn press(setup: &Setup, work: &mut Workspace, depth: f64) -> Result<(), Cause> {
    let planned = &work.planned;
    let modulus = setup.material.normal_modulus();
    let (load, breaks) = (&mut work.normal_load, &mut work.normal_breaks);
    let mut normal = normal::press(&planned.row, &work.predicted, depth, modulus, load, breaks);
    if !planned.row.most_force(normal.strongest).is_finite() {
        if work.predicted.iter().all(|g| g.is_finite()) {
            return Err(Cause::Overflow { depth });
        }
        return Err(Cause::NotFinite {
            quantity: "normal force",
            method: setup.method,
            stability: setup.stability,
        });
    }
    let last = setup.grid.cells();
    if setup.indenter.rim().is_none() && normal.nodes > last && load[last] > 1e-9 * modulus * depth
    {
        let radius = setup.grid.radius();
        // Wear only lowers the surface: where f₀ exceeds the depth, nothing ever touches.
        return Err(if planned.unworn[last] >= depth * (1.0 - 1e-9) {
            Cause::BlownUp {
                radius,
                method: setup.method,
                stability: setup.stability,
            }
        } else {
            Cause::EdgeReached {
                domain_radius: radius,
            }
        });
    }
    work.rim_edge = None;
    if let Some(rim) = &work.rim {
        let compression = |j: usize| depth - work.predicted[j];
        if let Some(edge) = rim_edge::edge_at_rim(rim, &planned.grid, compression) {
            // It takes the place of the edge that was found in its cell, if one was.
            let end = planned.grid.squares()[rim.cell + 1];
            if breaks.last().is_some_and(|last| last.at == end) {
                breaks.truncate(breaks.len().saturating_sub(3));
            }
            normal.radius = edge.at.sqrt();
            work.rim_edge = Some(edge);
        }
    }
    work.contact = Contact {
        depth,
        normal,
        ..Contact::default()
    };
    Ok(())
}

/// The depth, m: prescribed, or the one that carries the prescribed force.
fn depth_at(setup: &Setup, work: &mut Workspace, cycle: f64) -> Result<f64, Cause> {
    match setup.drive.normal_at(cycle) {
        Target::Displacement(depth) => Ok(depth),
        Target::Force(force) => {
            let deepest = match setup.indenter.rim() {
                // A punch carries any load; its springs yield at most what the load needs.
                Some(rim) => {
                    let flat = force / (2.0 * setup.material.normal_modulus() * rim);
                    largest(&work.predicted) + 2.0 * flat.abs()
                }
                None => work.predicted[setup.grid.cells()],
            };
            normal::depth_for_load(
                &work.planned.row,
                &work.predicted,
                force,
                setup.material.normal_modulus(),
                deepest,
                &mut work.normal_load,
                &mut work.normal_breaks,
            )
            .ok_or(Cause::LoadTooLarge {
                force,
                domain_radius: setup.grid.radius(),
            })
        }
    }
}

/// Moves the tangential springs by `increment` (m) from where they stand in `state`.
fn shift_by(setup: &Setup, state: &State, work: &mut Workspace, increment: f64) {
    let grip = Grip {
        row: &work.planned.row,
        normal_load: &work.normal_load,
        strongest: work.contact.normal.strongest,
        edge: work.contact.normal.edge(),
        reach: setup.material.friction() / setup.material.tangential_modulus(),
    };
    tangential::slide(
        grip,
        increment,
        &state.spring,
        &mut work.spring,
        &mut work.slip,
        &mut work.hold,
    );
    let motion = Motion {
        before: &state.spring,
        held: &state.hold,
    };
    let stick = tangential::borders(
        grip,
        motion,
        &work.spring,
        &work.hold,
        &mut work.spring_breaks,
    );
    work.contact.stick_radius = Some(stick);
}

/// F_z, N, of the solved contact.
pub(super) fn normal_force(work: &Workspace, material: &Material) -> f64 {
    let (load, breaks) = (&work.normal_load, &work.normal_breaks);
    let force = work
        .planned
        .row
        .force(load, breaks, work.contact.normal.edge());
    let at_rim = work.rim_edge.map_or(0.0, |edge| edge.line_integral());
    force + 2.0 * material.normal_modulus() * at_rim
}

/// F_x, N, of the solved contact; 0 without tangential motion.
pub(super) fn tangential_force(work: &Workspace, material: &Material) -> f64 {
    if work.spring.is_empty() {
        return 0.0;
    }
    let (spring, breaks) = (&work.spring, &work.spring_breaks);
    let edge = work.contact.normal.edge();
    material.tangential_modulus() * work.planned.row.force(spring, breaks, edge)
}

/// The increment of displacement (m) that brings the tangential force to `target` (N).
fn increment_for_force(
    setup: &Setup,
    state: &State,
    work: &mut Workspace,
    target: f64,
) -> Result<f64, Cause> {
    let limit = setup.material.friction() * normal_force(work, &setup.material);
    if target.abs() >= limit {
        return Err(Cause::FrictionExceeded {
            force: target,
            limit,
        });
    }
    // Twice the largest strain a spring can hold turns every spring over.
    let span = 2.0 * work.contact.normal.strongest * setup.material.friction()
        / setup.material.tangential_modulus();
    root::bracketed(
        |increment| {
            shift_by(setup, state, work, increment);
            (tangential_force(work, &setup.material) - target) / limit
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

/// The slip of the surface in the step, m, by Eq. (2), into `work.surface_slip`, on the first `nodes`.
pub(super) fn surface_slip(work: &mut Workspace, nodes: usize) {
    work.transforms += 1;
    let (slip, surface) = (&work.slip, &mut work.surface_slip);
    let plan = &work.planned.plan;
    plan.displacement_rows(slip, surface, 0..nodes);
}

/// u_x(r), m, of the surface by Eq. (2).
pub(super) fn surface_displacement(work: &Workspace, out: &mut [f64]) {
    let planned = &work.planned;
    planned.plan.displacement(&work.spring, out);
    if planned.has_breaks() {
        bend::add_to_displacement(&work.spring_breaks, &planned.grid, out);
    }
}

/// u_z(r), m, of the surface by Eq. (2), downwards; `modulus` is E*. The cusp of an edge within the
/// rim's cell is left out: for looking at, and only outside the contact.
pub(super) fn depression(work: &Workspace, modulus: f64, out: &mut [f64]) {
    let planned = &work.planned;
    planned.plan.displacement(&work.normal_load, out);
    if planned.has_breaks() {
        bend::add_to_displacement(&work.normal_breaks, &planned.grid, out);
    }
    for depth in out {
        *depth /= modulus;
    }
}

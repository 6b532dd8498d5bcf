//! The wear of a settled cycle on a frozen profile: the slope dδ/dn that jumps over cycles integrate.
//!
//! One period of the motion lets the springs settle: it needs no transform, since nothing wears. The
//! next one is gone through step by step like any other, but the profile stays as it is.
//!
//! # Formula
//!
//! Where the normal direction stands still, the tangential one swings by ±U, and wear is in proportion
//! to friction work, no steps are needed. Each spring that slips does so by S(x) = 2(U − μq_z/G*)₊ in
//! each half of a cycle, from the edge of the contact inwards, so that τ = μp where anything slips:
//!
//! ```text
//! W(r) = 2 k μ p(r) s(r),   s the transform (2) of S             E_d a cycle = 2 · 2∫ μ q_z S dx
//! ```
//!
//! On an unworn profile that is the 4μkps of Cattaneo and Mindlin.

use super::super::Setup;
use super::super::breakdown::Cause;
use super::super::choices::Scheme;
use super::super::drive::{Control, Oscillation};
use super::super::profile::update_profile;
use super::super::solve::solve_contact;
use super::super::state::{SettledCycle, State};
use super::super::stress::stresses;
use super::super::workspace::Workspace;
use super::{euler, steady_load, stiffness, take_over, trapezoid};
use crate::math::abel::bend;
use crate::math::scan::{largest, leading};
use crate::math::vector::add_to;

/// What a cycle does once the springs have settled on the worn depth `wear` (m), on average over the
/// period of the motion. `memory` lends the springs and keeps them; its profile, its counters of energy
/// and its cycle are left as they are.
pub(super) fn cycle(
    setup: &Setup,
    memory: &mut State,
    work: &mut Workspace,
    wear: &[f64],
) -> Result<SettledCycle, Cause> {
    update_profile(work, wear);
    work.predicted.copy_from_slice(&work.g);
    let now = memory.cycle;
    if let Some(swing) = plain_swing(setup) {
        memory.effort.evaluated_cycles += 1;
        let outcome = plain_cycle(setup, memory, work, swing);
        memory.cycle = now;
        memory.last.duration = 0.0;
        return outcome;
    }
    let moments = std::mem::take(&mut work.moments);
    let outcome = period(setup, memory, work, &moments);
    work.moments = moments;
    memory.cycle = now;
    memory.last.duration = 0.0;
    outcome
}

/// What looking at a settled period costs, in periods stepped directly.
pub(super) fn cost(setup: &Setup) -> f64 {
    if plain_swing(setup).is_some() {
        2.0 / f64::from(setup.steps_per_cycle)
    } else {
        4.0 / 3.0
    }
}

fn period(
    setup: &Setup,
    memory: &mut State,
    work: &mut Workspace,
    moments: &[f64],
) -> Result<SettledCycle, Cause> {
    memory.cycle = 0.0;
    for &moment in moments {
        solve_contact(setup, memory, work, moment)?;
        take_over(memory, work, moment);
    }
    keep_stresses(setup, memory, work);
    memory.cycle = 0.0;
    let mut settled = SettledCycle {
        wear: vec![0.0; work.worn.len()],
        stick_radius: f64::INFINITY,
        beyond_nodes: Some(0.0),
        ..SettledCycle::default()
    };
    let mut stiffness = vec![0.0; work.stiffness.len()];
    for &moment in moments {
        solve_contact(setup, memory, work, moment)?;
        settled.friction_work += match setup.scheme {
            Scheme::Euler => euler::worn(setup, memory, work, moment),
            Scheme::Trapezoid => trapezoid::worn(setup, memory, work, moment),
        };
        settled.beyond_nodes = settled
            .beyond_nodes
            .zip(work.beyond_nodes)
            .map(|(sum, more)| sum + more);
        stiffness::of_step(setup, work, moment - memory.cycle);
        let nodes = work.sliding.clone();
        add_to(
            &mut stiffness[nodes.clone()],
            &work.stiffness[nodes.clone()],
        );
        add_to(&mut settled.wear[nodes.clone()], &work.worn[nodes]);
        if let Some(stick) = work.contact.stick_radius {
            settled.stick_radius = settled.stick_radius.min(stick);
        }
        take_over(memory, work, moment);
        memory.last.pressure.copy_from_slice(&work.pressure);
        memory.last.shear.copy_from_slice(&work.shear);
    }
    let cycles = memory.cycle;
    memory.effort.evaluated_cycles += cycles as u64;
    for worn in &mut settled.wear {
        *worn /= cycles;
    }
    settled.friction_work /= cycles;
    settled.beyond_nodes = settled.beyond_nodes.map(|volume| volume / cycles);
    settled.stiffness = largest(&stiffness) / cycles;
    Ok(settled)
}

/// p and τ of the solved contact, for the next step to begin with.
fn keep_stresses(setup: &Setup, memory: &mut State, work: &mut Workspace) {
    let core = memory.core_radius();
    let last = &mut memory.last;
    let (p, tau) = (&mut last.pressure, &mut last.shear);
    let mut rest = std::mem::take(&mut work.rest);
    stresses(work, &setup.material, core, &mut rest, p, tau);
    work.rest = rest;
    work.transforms += 2;
}

/// The tangential motion, where a cycle needs no steps.
fn plain_swing(setup: &Setup) -> Option<&Oscillation> {
    let still = setup.drive.normal().oscillation().amplitude() == 0.0;
    let energetic = setup.wear.is_some_and(|law| law.follows_energy());
    match setup.drive.tangential() {
        Some(Control::Displacement(swing)) if still && energetic => Some(swing),
        _ => None,
    }
    .filter(|_| setup.scheme == Scheme::Trapezoid)
}

/// A settled cycle of ±U at a depth that is held.
fn plain_cycle(
    setup: &Setup,
    memory: &mut State,
    work: &mut Workspace,
    swing: &Oscillation,
) -> Result<SettledCycle, Cause> {
    // First the normal contact, whatever the springs do; then the springs where the cycle ends.
    solve_contact(setup, memory, work, 0.0)?;
    settle_springs(setup, memory, work, swing);
    solve_contact(setup, memory, work, 0.0)?;
    take_over(memory, work, 0.0);
    keep_stresses(setup, memory, work);

    let reach = setup.material.friction() / setup.material.tangential_modulus();
    let (load, squares) = (&work.normal_load, work.planned.grid.squares());
    let excess = |j: usize| swing.amplitude() - reach * load[j];
    for (j, slip) in work.slip.iter_mut().enumerate() {
        *slip = 2.0 * excess(j).max(0.0);
    }
    let core = leading(&work.slip, |&slip| slip == 0.0);
    let mut kinks = Vec::new();
    let mut stick_radius = work.contact.normal.radius;
    if core == 0 {
        stick_radius = 0.0;
    } else if core < work.contact.normal.nodes {
        let k = core - 1;
        let share = excess(k) / (excess(k) - excess(core));
        let border = squares[k] + share * (squares[core] - squares[k]);
        let ends = [squares[k], squares[core]];
        let slips = [work.slip[k], work.slip[core]];
        bend::polyline(ends, slips, &[(border, 0.0)], &mut kinks);
        stick_radius = border.sqrt();
    }
    work.planned
        .plan
        .displacement(&work.slip, &mut work.surface_slip);
    if work.planned.has_breaks() {
        bend::add_to_displacement(&kinks, &work.planned.grid, &mut work.surface_slip);
    }
    work.surface_slip[..core].fill(0.0);
    work.sliding = core..work.surface_slip.len();
    work.transforms += 1;
    work.pressure.copy_from_slice(&memory.last.pressure);
    work.working_shear[..core].fill(0.0);
    let kinks: Vec<_> = bend::by_cell(&kinks, squares).collect();
    let friction_work = steady_load::wear(setup, work, core, 1.0, 1.0, &kinks);
    let wear = work.worn.iter().map(|worn| 2.0 * worn).collect();
    Ok(SettledCycle {
        wear,
        friction_work: 2.0 * friction_work,
        beyond_nodes: work.beyond_nodes.map(|volume| 2.0 * volume),
        stiffness: 2.0 * stiffness::of_step(setup, work, 1.0 / setup.drive.period()),
        stick_radius,
    })
}

/// Brings the springs that slip in a settled cycle to where they stand at its end: those that do not
/// stay where they are.
fn settle_springs(setup: &Setup, memory: &mut State, work: &Workspace, swing: &Oscillation) {
    let reach = setup.material.friction() / setup.material.tangential_modulus();
    let rising = swing.phase().cos() >= 0.0;
    // How far the indenter has come since its last turn.
    let shift = swing.amplitude() * swing.phase().sin();
    let since = if rising {
        swing.amplitude() + shift
    } else {
        swing.amplitude() - shift
    };
    let sign = if rising { 1.0 } else { -1.0 };
    for (u, load) in memory.spring.iter_mut().zip(&work.normal_load) {
        let limit = reach * load;
        if limit < swing.amplitude() {
            *u = sign * (since - limit).min(limit);
        }
    }
}

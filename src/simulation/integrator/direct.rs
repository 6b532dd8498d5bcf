//! Direct stepping: every step of every cycle, explicit Euler as in the paper.
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

use super::super::breakdown::Cause;
use super::super::solve::{line_integral, solve_contact, update_profile};
use super::super::state::State;
use super::super::workspace::Workspace;
use super::super::{Setup, cycles_to_settle};
use crate::math::quadrature::volume_of_revolution;
use crate::wear::WearLaw;

/// A worn depth of this many times the largest depth of indentation cannot come from contact.
const RUNAWAY: f64 = 10.0;

/// Solves the contact at the present cycle: pressed to u_z, shifted to u_x, nothing worn.
pub(crate) fn settle(setup: &Setup, state: &mut State, work: &mut Workspace) -> Result<(), Cause> {
    update_profile(work, &state.wear);
    solve_contact(setup, work, state.cycle, &state.spring, state.shift)?;
    work.wear.copy_from_slice(&state.wear);
    if setup.drive.tangential().is_some() {
        work.plan.stress(&work.tangential_load, &mut work.tau);
    }
    take_over(state, work);
    Ok(())
}

/// One step from the state's cycle to `cycle`. On an error the state is as it was.
pub(crate) fn step(
    setup: &Setup,
    state: &mut State,
    work: &mut Workspace,
    cycle: f64,
) -> Result<(), Cause> {
    if setup.wear.is_some() {
        update_profile(work, &state.wear);
    }
    solve_contact(setup, work, cycle, &state.spring, state.shift)?;
    let mut friction_work = 0.0;
    if setup.drive.tangential().is_some() {
        for ((power, load), slip) in work
            .friction_work
            .iter_mut()
            .zip(&work.tangential_load)
            .zip(&work.slip)
        {
            *power = load * slip;
        }
        friction_work = line_integral(setup, work, &work.friction_work);
        if let Some(law) = &setup.wear {
            work.plan.stress(&work.tangential_load, &mut work.tau);
            work.plan.displacement(&work.slip, &mut work.surface_slip);
            let duration = (cycle - state.cycle) * setup.drive.period();
            work.wear.copy_from_slice(&state.wear);
            law.wear(&work.tau, &work.surface_slip, duration, &mut work.wear);
            check(setup, work)?;
            account(setup, law, state, work, friction_work);
        }
    }
    state.dissipated_energy += friction_work;
    take_over(state, work);
    keep_smallest_stick(setup, state, work, cycle);
    state.cycle = cycle;
    state.steps += 1;
    Ok(())
}

/// Refuses a worn profile that is not finite or far above anything that can touch.
fn check(setup: &Setup, work: &Workspace) -> Result<(), Cause> {
    let method = setup.method;
    let (mut highest, mut at) = (0.0, 0);
    let mut sum = 0.0;
    for (j, &worn) in work.wear.iter().enumerate() {
        sum += worn;
        if worn > highest {
            (highest, at) = (worn, j);
        }
    }
    if !f64::is_finite(sum) {
        return Err(Cause::NotFinite {
            quantity: "worn profile",
            method,
        });
    }
    let deepest = setup.deepest().unwrap_or(work.contact.depth);
    if highest > RUNAWAY * deepest && deepest > 0.0 {
        return Err(Cause::Runaway {
            worn: highest / deepest,
            radius: setup.grid.nodes()[at],
            method,
        });
    }
    Ok(())
}

/// Keeps the two sides of V = k E_d: what work explains, and what other laws wore.
fn account(setup: &Setup, law: &WearLaw, state: &mut State, work: &Workspace, friction_work: f64) {
    if law.follows_energy() {
        state.expected_volume += law.coefficient() * friction_work;
    } else {
        let nodes = setup.grid.nodes();
        state.unexplained_volume +=
            volume_of_revolution(nodes, &work.wear) - volume_of_revolution(nodes, &state.wear);
    }
}

/// Makes the solved contact the state.
fn take_over(state: &mut State, work: &mut Workspace) {
    state.depth = work.contact.depth;
    state.shift = work.contact.shift;
    state.wear.copy_from_slice(&work.wear);
    state.spring.copy_from_slice(&work.spring);
}

/// Follows the smallest stick radius through a period of the motion.
fn keep_smallest_stick(setup: &Setup, state: &mut State, work: &Workspace, cycle: f64) {
    let Some(slide) = work.contact.slide else {
        return;
    };
    state.smallest_stick_radius = state.smallest_stick_radius.min(slide.stick_radius);
    let period = f64::from(cycles_to_settle(&setup.drive));
    if (cycle / period).floor() > (state.cycle / period).floor() {
        state.settled_stick_radius = Some(state.smallest_stick_radius);
        state.smallest_stick_radius = f64::INFINITY;
    }
}

//! How the state is carried forward in time: direct stepping, every step of every cycle, or jumps over
//! many cycles that are alike.

use super::breakdown::Cause;
use super::choices::Scheme;
use super::profile::{grow_profile, update_profile};
use super::solve::solve_contact;
use super::state::{LastStep, State};
use super::stress::{pressure, shear};
use super::workspace::Workspace;
use super::{Setup, at_rim, cycles_to_settle, volume_by_rate};
use crate::math::abel::cone::Rest;
use crate::math::quadrature::weighted;
use crate::math::scan::largest;
use crate::math::vector::vectorized;

mod cycle_jump;
mod euler;
mod parts;
mod relaxed;
mod settled;
mod steady_load;
mod stiffness;
mod trapezoid;
mod worn_volume;

pub(super) use cycle_jump::{Jumped, is_possible, jump};

/// A worn depth of this many times the largest depth of indentation cannot come from contact.
const RUNAWAY: f64 = 10.0;

/// Solves the contact at the present cycle: pressed to u_z, shifted to u_x, nothing worn.
pub(super) fn settle(setup: &Setup, state: &mut State, work: &mut Workspace) -> Result<(), Cause> {
    update_profile(work, &state.wear);
    state.image.clone_from(&work.image);
    work.predicted.copy_from_slice(&work.g);
    solve_contact(setup, state, work, state.cycle)?;
    let nodes = work.g.len();
    let mut last = LastStep {
        normal_load: vec![0.0; nodes],
        growth: vec![0.0; nodes],
        wear: vec![0.0; nodes],
        pressure: vec![0.0; nodes],
        shear: vec![0.0; nodes],
        ..LastStep::default()
    };
    let core = state.core_radius();
    let mut rest = Rest::default();
    pressure(work, &setup.material, core, &mut rest, &mut last.pressure);
    if setup.drive.tangential().is_some() {
        shear(work, &setup.material, core, &mut rest, &mut last.shear);
    }
    state.last = last;
    take_over(state, work, state.cycle);
    work.keep_as_good();
    Ok(())
}

/// One step from the state's cycle to `cycle`, at which the motion turns or does not. On an error
/// the state is that of the last good step.
pub(super) fn step(
    setup: &Setup,
    state: &mut State,
    work: &mut Workspace,
    cycle: f64,
    turns: bool,
) -> Result<(), Cause> {
    match setup.scheme {
        Scheme::Euler => euler::step(setup, state, work, cycle)?,
        Scheme::Trapezoid => trapezoid::step(setup, state, work, cycle)?,
    }
    if turns {
        state.last.duration = 0.0;
    }
    state.steps += 1;
    work.keep_as_good();
    Ok(())
}

/// Adds what one step has worn, and makes the solved contact and the worn profile the state.
fn commit(
    setup: &Setup,
    state: &mut State,
    work: &mut Workspace,
    cycle: f64,
    friction_work: f64,
) -> Result<(), Cause> {
    wear_down(setup, state, work)?;
    if let Some(law) = &setup.wear {
        // The two sides of V = k E_d: what work explains, and what other laws wore.
        if law.follows_energy() {
            state.expected_volume += law.coefficient() * friction_work;
        } else {
            state.unexplained_volume += weighted(&work.planned.volume_weights, &work.worn);
        }
        match setup.scheme {
            Scheme::Euler => grow_profile(work, &mut state.image, &state.wear),
            Scheme::Trapezoid => grow_profile_keeping_growth(state, work),
        }
        std::mem::swap(&mut state.last.wear, &mut work.worn);
        state.volume_between_nodes = match work.beyond_nodes {
            Some(volume) => state.volume_between_nodes + volume,
            None => at_rim(work),
        };
    }
    state.dissipated_energy += friction_work;
    keep_smallest_stick(setup, state, work, cycle);
    take_over(state, work, cycle);
    // The profile has changed: what a settled cycle wore on the old one is out of date.
    state.jump.settled = None;
    Ok(())
}

/// Brings g up to date and notes by how much it has grown.
fn grow_profile_keeping_growth(state: &mut State, work: &mut Workspace) {
    // What they held is overwritten.
    std::mem::swap(&mut state.last.growth, &mut work.g);
    grow_profile(work, &mut state.image, &state.wear);
    vectorized(
        #[inline(always)]
        || {
            for (growth, g) in state.last.growth.iter_mut().zip(&work.g) {
                *growth = g - *growth;
            }
        },
    );
}

/// Adds what the step has worn to the wear of the state, if that can be.
fn wear_down(setup: &Setup, state: &mut State, work: &mut Workspace) -> Result<(), Cause> {
    let nodes = work.sliding.clone();
    let (after, worn) = (&mut work.wear[nodes.clone()], &work.worn[nodes.clone()]);
    let before = &state.wear[nodes.clone()];
    let deepest = vectorized(
        #[inline(always)]
        || {
            for (after, (before, worn)) in after.iter_mut().zip(before.iter().zip(worn)) {
                *after = before + worn;
            }
            deepest(after)
        },
    );
    let after = &work.wear[nodes.clone()];
    let radii = &setup.grid.nodes()[nodes.clone()];
    refuse(setup, work.contact.depth, after, radii, deepest)?;
    state.wear[nodes].copy_from_slice(after);
    Ok(())
}

/// Refuses a worn profile that is not finite or far above anything that can touch.
fn check(setup: &Setup, work: &Workspace, wear: &[f64]) -> Result<(), Cause> {
    refuse(
        setup,
        work.contact.depth,
        wear,
        setup.grid.nodes(),
        deepest(wear),
    )
}

/// The largest of the worn depths; none where one is not finite.
#[inline(always)]
fn deepest(wear: &[f64]) -> Option<f64> {
    let finite = wear.iter().fold(true, |all, worn| all & worn.is_finite());
    finite.then(|| largest(wear))
}

/// Refuses the worn depths `wear` (m) at some `radii` (m) if the `deepest` of them says so.
fn refuse(
    setup: &Setup,
    depth: f64,
    wear: &[f64],
    radii: &[f64],
    deepest: Option<f64>,
) -> Result<(), Cause> {
    let (method, stability) = (setup.method, setup.stability);
    let depth = setup.depth_scale(depth);
    let worn = deepest.map_or(f64::INFINITY, |deepest| deepest / depth);
    if deepest.is_none() || worn == f64::INFINITY && depth > 0.0 {
        return Err(Cause::NotFinite {
            quantity: "worn profile",
            method,
            stability,
        });
    }
    if worn > RUNAWAY && depth > 0.0 {
        let at = wear.iter().position(|&worn| Some(worn) == deepest);
        return Err(Cause::Runaway {
            worn,
            radius: radii[at.unwrap_or_default()],
            method,
            stability,
        });
    }
    Ok(())
}

/// Makes the solved contact that of the state, at `cycle`.
fn take_over(state: &mut State, work: &mut Workspace, cycle: f64) {
    state.depth = work.contact.depth;
    state.shift = work.contact.shift;
    state.spring.copy_from_slice(&work.spring);
    state.hold.copy_from_slice(&work.hold);
    state.last.normal_load.copy_from_slice(&work.normal_load);
    state.last.normal_breaks.clone_from(&work.normal_breaks);
    state.last.rim_edge = work.rim_edge;
    state.last.spring_breaks.clone_from(&work.spring_breaks);
    state.last.duration = cycle - state.cycle;
    state.cycle = cycle;
    state.effort.contacts += 1;
    state.effort.transforms += std::mem::take(&mut work.transforms);
}

/// Weighs what a period of the motion has worn against its work of friction.
fn close_period(state: &mut State, work: &Workspace) {
    let volume = volume_by_rate(state, work) - state.unexplained_volume;
    state.period.close(volume, state.expected_volume);
}

/// Follows the smallest stick radius and the energy balance through a period of the motion.
fn keep_smallest_stick(setup: &Setup, state: &mut State, work: &Workspace, cycle: f64) {
    let Some(stick) = work.contact.stick_radius else {
        return;
    };
    state.smallest_stick_radius = state.smallest_stick_radius.min(stick);
    // A period is a whole number of cycles.
    if cycle.floor() == state.cycle.floor() {
        return;
    }
    let period = f64::from(cycles_to_settle(&setup.drive));
    if (cycle / period).floor() > (state.cycle / period).floor() {
        state.settled_stick_radius = Some(state.smallest_stick_radius);
        state.smallest_stick_radius = f64::INFINITY;
        close_period(state, work);
    }
}

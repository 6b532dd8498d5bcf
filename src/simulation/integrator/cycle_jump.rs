//! Jumps over many cycles that are alike.
//!
//! # Formula
//!
//! Wear changes the profile little in a cycle, so the worn depth δ is a smooth function of the number n
//! of cycles, dδ/dn = W(δ), W the wear of a [settled cycle](super::settled) on the frozen profile. That
//! is integrated by [Runge–Kutta–Chebyshev steps](crate::math::chebyshev), whose error is kept at the
//! tolerance and whose stages follow the stiffness of the response of p to wear. The work of friction
//! is integrated along with it.
//!
//! A jump covers whole periods of the motion. It begins after the first period, in which the springs
//! shake down, and where it would cost more cycles than it covers, cycles are stepped directly for a
//! while.
//!
//! - **Order**: second in the length of the jump; the wear within one cycle is that of the scheme.
//! - **Cost**: as many evaluated cycles as stages, whatever the number of cycles covered.
//! - **Known failure**: none of the motions that never repeat can be jumped; they are stepped directly.

use super::super::Setup;
use super::super::at_rim;
use super::super::breakdown::Cause;
use super::super::choices::Integrator;
use super::super::state::{JumpMemory, SettledCycle, State};
use super::super::workspace::Workspace;
use super::{check, close_period, settled};
use crate::math::chebyshev;
use crate::math::quadrature::weighted;
use crate::math::scan::largest;

/// A jump must save this much: the cycles it covers over what its evaluation costs, in cycles.
const WORTH: f64 = 1.5;

/// The most stages of a jump.
const MOST_STAGES: usize = 40;

/// The first jump wears this much at most, in depths and in units of the root of the tolerance.
const FIRST: f64 = 0.3;

/// The most cycles of a jump, also where nothing wears any more.
const LONGEST: f64 = 1e9;

/// How many times its rms the error of a single node may be.
const PEAK: f64 = 4.0;

/// Most periods of direct stepping before a jump is tried again.
const LONGEST_REST: u32 = 16;

/// What came of a try to jump.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in super::super) enum Jumped {
    /// The state is that after the jump.
    Done,
    /// Jumps do not pay here: the state is as it was, and wants direct steps.
    NotWorthIt,
}

/// Whether the state is one that cycles can be jumped from: at the end of a period but the first.
pub(in super::super) fn is_possible(setup: &Setup, state: &State) -> bool {
    let (Integrator::CycleJump { .. }, Some(period)) =
        (setup.integrator, setup.drive.repeats_after())
    else {
        return false;
    };
    let period = f64::from(period);
    setup.wear.is_some()
        && setup.drive.tangential().is_some()
        && state.cycle >= period.max(state.jump.rest_until)
        && state.cycle % period == 0.0
}

/// Jumps, over at most `most` cycles.
///
/// The first try is as long as it would be without a goal, so that a run which is stopped where a jump
/// has ended, and one that goes there without stopping, are the same.
pub(in super::super) fn jump(
    setup: &Setup,
    state: &mut State,
    work: &mut Workspace,
    most: f64,
) -> Result<Jumped, Cause> {
    let mut memory = state.clone();
    let first = match memory.jump.settled.take() {
        Some(first) => first,
        None => settled::cycle(setup, &mut memory, work, &state.wear)?,
    };
    let springs = memory.clone();
    let mut found = search(setup, state, &mut memory, work, &first, f64::INFINITY);
    if found.as_ref().is_some_and(|jump| jump.covered > most) {
        go_back(&mut memory, &springs);
        found = search(setup, state, &mut memory, work, &first, most);
    } else if found.is_none() {
        rest(setup, state);
    }
    memory.effort.transforms += std::mem::take(&mut work.transforms);
    match found {
        Some(jump) => {
            accept(setup, state, work, memory, jump);
            Ok(Jumped::Done)
        }
        None => {
            state.effort = memory.effort;
            work.show_last_good(state);
            Ok(Jumped::NotWorthIt)
        }
    }
}

/// Looks for a jump of at most `most` cycles whose error is allowed; none if direct steps are better.
/// `memory` then holds the springs at its end.
fn search(
    setup: &Setup,
    state: &State,
    memory: &mut State,
    work: &mut Workspace,
    first: &SettledCycle,
    most: f64,
) -> Option<Jump> {
    let Integrator::CycleJump { tolerance } = setup.integrator else {
        return None;
    };
    let period = f64::from(setup.drive.repeats_after()?);
    let deepest = setup.depth_scale(state.depth);
    let largest = largest(&first.wear);
    let mut length = if state.jump.length > 0.0 {
        state.jump.length
    } else {
        FIRST * tolerance.sqrt() * deepest / largest
    };
    let springs = memory.clone();
    loop {
        let covered = (length.min(most).min(LONGEST) / period).floor() * period;
        let stages = chebyshev::stages_for(covered * first.stiffness);
        if stages > MOST_STAGES {
            length = 0.5 * covered;
            continue;
        }
        let price = stages as f64 * settled::cost(setup) * period;
        if covered < (WORTH * price).max(period) {
            return None;
        }
        let tried = attempt(setup, memory, work, first, covered, stages);
        let error = match &tried {
            Ok(after) => error(state, first, after, covered, tolerance * deepest, tolerance),
            // What fails in the middle of a jump is left to a shorter one, or to direct steps.
            Err(_) => f64::INFINITY,
        };
        let factor = (0.75 * error.powf(-1.0 / 3.0)).clamp(0.2, 2.0);
        match tried {
            Ok(after) if error <= 1.0 => {
                let next = covered * factor;
                return Some(Jump {
                    covered,
                    // A goal that was near says nothing about the next jump.
                    next: if most < length {
                        next.max(length)
                    } else {
                        next
                    },
                    after,
                });
            }
            _ => {
                go_back(memory, &springs);
                memory.effort.rejected_jumps += 1;
                length = covered * factor;
            }
        }
    }
}

/// Takes the springs back to where they stood; the effort was made all the same.
fn go_back(memory: &mut State, springs: &State) {
    let effort = memory.effort;
    memory.clone_from(springs);
    memory.effort = effort;
}

/// A jump that was found good.
struct Jump {
    covered: f64,
    /// How many cycles the next one should cover.
    next: f64,
    after: After,
}

/// The state of the profile after a jump.
struct After {
    wear: Vec<f64>,
    friction_work: f64,
    beyond_nodes: f64,
    settled: SettledCycle,
}

/// One Runge–Kutta–Chebyshev step over `covered` cycles. The last entries of y are the work of friction and
/// the volume between nodes.
fn attempt(
    setup: &Setup,
    memory: &mut State,
    work: &mut Workspace,
    first: &SettledCycle,
    covered: f64,
    stages: usize,
) -> Result<After, Cause> {
    let nodes = memory.wear.len();
    let with_sums = |wear: &[f64], friction_work: f64, volume: Option<f64>| {
        let mut values = wear.to_vec();
        values.extend([friction_work, volume.unwrap_or_default()]);
        values
    };
    let rates =
        |cycle: &SettledCycle| with_sums(&cycle.wear, cycle.friction_work, cycle.beyond_nodes);
    let start = with_sums(&memory.wear, 0.0, None);
    let slope = rates(first);
    let mut end = Vec::new();
    chebyshev::step(stages, covered, &start, &slope, &mut end, |y, out| {
        let settled = settled::cycle(setup, memory, work, &y[..nodes])?;
        *out = rates(&settled);
        Ok::<(), Cause>(())
    })?;
    let beyond_nodes = end.pop().unwrap_or_default();
    let friction_work = end.pop().unwrap_or_default();
    let settled = settled::cycle(setup, memory, work, &end)?;
    check(setup, work, &end)?;
    Ok(After {
        wear: end,
        friction_work,
        beyond_nodes,
        settled,
    })
}

/// The error of a jump in units of what is allowed: that of the worn depth, by its rms over the nodes that
/// wear and its largest value, and that of the friction work in parts of all the work so far.
fn error(
    state: &State,
    first: &SettledCycle,
    after: &After,
    covered: f64,
    allowed: f64,
    tolerance: f64,
) -> f64 {
    let (mut sum, mut largest, mut count) = (0.0, 0.0_f64, 0.0);
    for (j, (&y, &next)) in state.wear.iter().zip(&after.wear).enumerate() {
        let (f, last) = (first.wear[j], after.settled.wear[j]);
        if f != 0.0 || last != 0.0 {
            let error = chebyshev::error(covered, y, next, f, last).abs();
            sum += error * error;
            largest = largest.max(error);
            count += 1.0;
        }
    }
    let (before, after_work) = (first.friction_work, after.settled.friction_work);
    let work = chebyshev::error(covered, 0.0, after.friction_work, before, after_work).abs();
    let total = state.dissipated_energy + after.friction_work;
    let of_depth = f64::sqrt(sum / f64::max(count, 1.0)).max(largest / PEAK) / allowed;
    of_depth.max(work / (tolerance * total).max(f64::MIN_POSITIVE))
}

fn accept(setup: &Setup, state: &mut State, work: &mut Workspace, memory: State, jump: Jump) {
    let Jump {
        covered,
        next,
        after,
    } = jump;
    let worn = weighted(&work.planned.volume_weights, &state.wear);
    // Rounding must not take work back where none is done any more.
    let friction_work = after.friction_work.max(0.0);
    *state = State {
        cycle: state.cycle + covered,
        steps: state.steps + 1,
        wear: after.wear,
        image: work.image.clone(),
        dissipated_energy: state.dissipated_energy + friction_work,
        smallest_stick_radius: f64::INFINITY,
        settled_stick_radius: Some(after.settled.stick_radius),
        ..memory
    };
    if let Some(law) = &setup.wear {
        if law.follows_energy() {
            state.expected_volume += law.coefficient() * friction_work;
        } else {
            let now = weighted(&work.planned.volume_weights, &state.wear);
            state.unexplained_volume += now - worn;
        }
    }
    state.volume_between_nodes = match after.settled.beyond_nodes {
        Some(_) => state.volume_between_nodes + after.beyond_nodes,
        None => at_rim(work),
    };
    close_period(state, work);
    state.effort.jumps += 1;
    state.last.duration = 0.0;
    // A jump has as many stages as it needs: the limit of a step is not its own.
    state.last.stiffness = 0.0;
    state.last.growth.fill(0.0);
    state.last.wear.fill(0.0);
    state.jump = JumpMemory {
        length: next,
        settled: Some(after.settled),
        ..JumpMemory::default()
    };
    work.keep_as_good();
}

/// Leaves the next periods to direct steps, ever more of them while jumps do not pay.
fn rest(setup: &Setup, state: &mut State) {
    let period = f64::from(setup.drive.repeats_after().unwrap_or(1));
    let patience = state.jump.patience.max(1);
    state.jump.rest_until = state.cycle + f64::from(patience) * period;
    state.jump.patience = (2 * patience).min(LONGEST_REST);
}

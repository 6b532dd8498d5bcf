//! Jumps over many similar cycles.
//!
//! # Formula
//!
//! Wear changes the profile little in a cycle, so the worn depth δ is a smooth function of the
//! number n of cycles, dδ/dn = W(δ), W the wear of a [steady-state cycle](super::steady_cycle) on
//! the frozen profile. That is integrated with an error that is controlled by the tolerance: by
//! [Runge–Kutta–Chebyshev steps](crate::math::chebyshev), whose number of stages follows the stiffness z of the response
//! of p to wear, or by [linearly implicit steps](crate::math::rosenbrock) if z is so large that stages cost more. The
//! friction work is integrated along with the depth. The tolerance is in units of the largest depth of the motion or,
//! if the force is prescribed, of the largest compression of a spring. The work may err by the same relative amount as
//! the depth of the scar, at most 1e-4.
//!
//! Friction and k that run in are taken where a stage stands, in cycles and in work. A jump ends before the next corner of
//! their courses and before the threshold of wear, which direct steps pass.
//!
//! A jump covers whole periods of the motion. It begins after the first period, in which the
//! springs shake down. If it would need more cycles than it covers, cycles are stepped directly for
//! a while.
//!
//! - **Order**: second in the length of the jump; within one cycle, the order of the scheme.
//! - **Cost**: as many evaluated cycles as stages, or two, whatever the number of cycles covered.
//! - **Known failure**: motions that never repeat cannot be jumped; they are stepped directly.

use super::super::breakdown::Cause;
use super::super::choices::Integrator;
use super::super::model::Model;
use super::super::profile::{even_end, scar_volume};
use super::super::setup::Setup;
use super::super::state::{JumpMemory, Ledger, State, SteadyCycle};
use super::jump_step::{Jump, Means};
use super::{Scratch, deepest, steady_cycle};
use crate::math::chebyshev;
use crate::math::scan::largest;

/// Minimum saving of a jump: cycles covered per cycle of evaluation.
const WORTH: f64 = 1.5;

/// What the linear systems of an implicit step cost, in steps within a cycle.
const SYSTEMS: f64 = 76.0;

/// The first jump wears this much at most, in depths and in units of the root of the tolerance.
const FIRST: f64 = 0.3;

/// Maximum length of a jump, in cycles, also if nothing wears any more.
const LONGEST: f64 = 1e9;

/// Maximum error of a single node, relative to the rms.
const PEAK: f64 = 10.0;

/// Maximum error of the friction work by a jump, relative to all of it, however shallow the scar is.
const LEAST_CERTAIN: f64 = 1e-4;

/// A contact beyond this fraction of the domain gets a wider domain before a jump is shortened for lack of room.
const NEAR_EDGE: f64 = 0.8;

/// Maximum number of periods stepped directly before another try.
const LONGEST_REST: u32 = 16;

/// Result of a try to jump.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in super::super) enum Jumped {
    /// The state is the one after the jump.
    Done,
    /// The same, and without a goal the jump would have gone further.
    Shortened,
    /// Jumps do not pay here: the state is unchanged, and needs direct steps.
    NotWorthIt,
    /// No jump before the goal pays: step directly up to there.
    TooNear,
    /// The contact would grow beyond the domain: the state is unchanged.
    WithoutRoom,
}

/// Whether cycles can be jumped from this state: at the end of any period but the first.
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

/// Jumps over at most `most` cycles, into `next`; if jumps do not pay, `next` is `state` with a rest.
///
/// The goal does not shorten the first try. A run saved at the end of a jump towards a distant goal is
/// repeated with that cycle as its goal; a shorter first try, if rejected, would lead to other jumps.
pub(in super::super) fn jump(
    model: &Model,
    state: &State,
    next: &mut State,
    scratch: &mut Scratch,
    most: f64,
) -> Result<Jumped, Cause> {
    let mut memory = state.clone();
    let first = match memory.jump.settled.take() {
        Some(first) => first,
        None => {
            let worn = [&state.wear[..], &state.image];
            steady_cycle::cycle(model, &mut memory, next, scratch, worn)?
        }
    };
    let springs = memory.clone();
    let mut search = JumpSearch {
        model,
        state,
        first: &first,
        springs: &springs,
        spare: next,
        scratch,
    };
    let mut found = search.search(&mut memory, f64::INFINITY);
    let is_short = matches!(&found, Ok((jump, _)) if jump.covered > most);
    if is_short {
        go_back(&mut memory, &springs);
        found = search.search(&mut memory, most);
    }
    let refused = match found {
        Ok((jump, length)) => {
            *next = after_jump(model, state, memory, jump);
            next.jump.length = length;
            return Ok(if is_short {
                Jumped::Shortened
            } else {
                Jumped::Done
            });
        }
        Err(refused) => refused,
    };
    next.clone_from(state);
    next.stats = memory.stats;
    Ok(match refused {
        Refused::WithoutRoom => Jumped::WithoutRoom,
        Refused::TooShort(_) if is_short => Jumped::TooNear,
        Refused::TooShort(length) => {
            pause_jumps(&model.setup, next, length);
            Jumped::NotWorthIt
        }
    })
}

/// The search for a jump from one state.
struct JumpSearch<'a> {
    model: &'a Model,
    state: &'a State,
    /// The cycle at that state.
    first: &'a SteadyCycle,
    /// The springs at that state, shaken down.
    springs: &'a State,
    spare: &'a mut State,
    scratch: &'a mut Scratch,
}

impl JumpSearch<'_> {
    /// A jump of at most `most` cycles whose error is allowed, or one so short that direct steps are better.
    /// `memory` then holds the springs at its end.
    fn search(&mut self, memory: &mut State, most: f64) -> Result<(Jump, f64), Refused> {
        let (state, first, setup) = (self.state, self.first, &self.model.setup);
        let Integrator::CycleJump { tolerance } = setup.integrator else {
            return Err(Refused::TooShort(0.0));
        };
        let period = f64::from(setup.drive.cycles_to_settle());
        // Under a held force the depth of indentation grows with the scar, and says nothing about the contact.
        let depth = setup.depth_scale(first.elastic_depth);
        let near_edge = NEAR_EDGE * setup.grid.radius();
        let (cycle, work) = (state.cycle, state.ledger.dissipated_energy);
        let running_in = setup.running_in.as_ref();
        let has_run_in = running_in.is_none_or(|all| all.is_settled(cycle, work));
        let [cycles_left, work_left] =
            running_in.map_or([f64::INFINITY; 2], |all| all.smooth_for(cycle, work));
        let mut most = most
            .min(cycles_left)
            .min(work_left / first.friction_work.max(0.0));
        // Below a threshold nothing wears, which tells nothing about the jumps beyond it.
        let wears = setup.wear.is_some_and(|law| law.coefficient() > 0.0);
        let known = |length: f64| if wears { length } else { 0.0 };
        let mut length = if state.jump.length > 0.0 {
            state.jump.length
        } else {
            FIRST * tolerance.sqrt() * depth / largest(&first.wear)
        };
        let stiffest = largest(&first.stiffness);
        let can_be_implicit = has_run_in
            && setup.wear.is_some_and(|law| law.traits().is_continuous)
            && !steady_cycle::is_even(setup, first);
        let most_stages = most_stages(setup);
        loop {
            let covered = (length.min(most).min(LONGEST) / period).floor() * period;
            let stages = chebyshev::stages_for(covered * stiffest);
            let is_implicit = stages > most_stages;
            if is_implicit && !can_be_implicit {
                length = 0.5 * covered;
                continue;
            }
            // An implicit step costs as much as an explicit one of the most stages.
            let price = stages.min(most_stages) as f64 * steady_cycle::cost(setup) * period;
            if covered < (WORTH * price).max(period) {
                // What a corner holds back need not grow.
                let length = if most < length { 0.5 * length } else { length };
                return Err(Refused::TooShort(known(length)));
            }
            let means = self.means(memory);
            let tried = if is_implicit {
                means.implicit(covered)
            } else {
                means.explicit(covered, stages)
            };
            let error = match &tried {
                Ok(jump) => error(state, first, jump, tolerance * depth, tolerance),
                // The state before the jump still has the springs unchanged.
                Err(cause) if cause.lacks_room() && state.contact.normal.radius > near_edge => {
                    return Err(Refused::WithoutRoom);
                }
                // If a jump fails inside, a shorter one or direct steps take over.
                Err(_) => f64::INFINITY,
            };
            let next = covered * (0.75 * error.powf(-1.0 / 3.0)).clamp(0.2, 2.0);
            match tried {
                Ok(jump) if error <= 1.0 && jump.friction_work > (1.0 + 1e-9) * work_left => {
                    most = 0.999 * covered * work_left / jump.friction_work;
                    go_back(memory, self.springs);
                }
                Ok(jump) if error <= 1.0 => {
                    // A goal that was near tells nothing about the next jump.
                    let next = if most < length {
                        next.max(length)
                    } else {
                        next
                    };
                    return Ok((jump, known(next)));
                }
                _ => {
                    go_back(memory, self.springs);
                    memory.stats.rejected_jumps += 1;
                    // What the response has not foreseen may well be within the reach of stages.
                    length = if is_implicit {
                        next.max(chebyshev::reach(most_stages) / stiffest)
                    } else {
                        next
                    };
                }
            }
        }
    }

    fn means<'a>(&'a mut self, memory: &'a mut State) -> Means<'a> {
        Means {
            model: self.model,
            first: self.first,
            memory,
            spare: self.spare,
            scratch: self.scratch,
        }
    }
}

/// The most stages of an explicit step: an implicit one costs no more, and is more accurate by then.
fn most_stages(setup: &Setup) -> usize {
    let systems = SYSTEMS / (steady_cycle::cost(setup) * setup.steps_in_a_cycle());
    (2.0 + systems) as usize
}

/// Takes the springs back to where they stood; the counts of what was done stay.
fn go_back(memory: &mut State, springs: &State) {
    let stats = memory.stats;
    memory.clone_from(springs);
    memory.stats = stats;
}

/// Why there is no jump.
enum Refused {
    /// It would cover so few cycles that direct steps are better; the number of cycles.
    TooShort(f64),
    /// The contact is about to outgrow the domain.
    WithoutRoom,
}

/// The error of a jump relative to the allowed error: the worn depth counts by its rms over the nodes that wear and by
/// its largest value, the friction work relative to all the work so far.
fn error(state: &State, first: &SteadyCycle, jump: &Jump, allowed: f64, tolerance: f64) -> f64 {
    let (mut sum, mut largest, mut count) = (0.0, 0.0_f64, 0.0);
    for (j, error) in jump.error.iter().enumerate() {
        if first.wear[j] != 0.0 || jump.steady.wear[j] != 0.0 {
            sum += error * error;
            largest = largest.max(error.abs());
            count += 1.0;
        }
    }
    let total = state.ledger.dissipated_energy + jump.friction_work;
    let of_depth = f64::sqrt(sum / f64::max(count, 1.0)).max(largest / PEAK) / allowed;
    // The error allowed for the work is the same fraction as for the scar's depth.
    let scar = deepest(&jump.wear).unwrap_or(f64::INFINITY);
    let of_scar = (allowed / scar).min(LEAST_CERTAIN).max(tolerance);
    of_depth.max(jump.error_of_work.abs() / (of_scar * total).max(f64::MIN_POSITIVE))
}

/// Returns the state after a jump from `state`, with the springs of `memory`.
fn after_jump(model: &Model, state: &State, memory: State, jump: Jump) -> State {
    // Rounding must not undo work when no more is done.
    let friction_work = jump.friction_work.max(0.0);
    let even = even_end(model, &state.contact.load);
    let worn = scar_volume(model, &jump.wear, even) - scar_volume(model, &state.wear, even);
    let mut end = State {
        cycle: state.cycle + jump.covered,
        steps: state.steps + 1,
        ledger: Ledger {
            dissipated_energy: state.ledger.dissipated_energy + friction_work,
            smallest_stick_radius: f64::INFINITY,
            settled_stick_radius: Some(jump.steady.stick_radius),
            ..state.ledger
        },
        jump: JumpMemory {
            settled: Some(jump.steady),
            ..JumpMemory::default()
        },
        wear: jump.wear,
        image: jump.image,
        ..memory
    };
    match &model.setup.wear {
        Some(law) if !law.traits().explained_by_work => end.ledger.unexplained_volume += worn,
        _ => end.ledger.expected_volume += jump.expected_volume.max(0.0),
    }
    end.stats.jumps += 1;
    end.last.duration = 0.0;
    // A jump has as many stages as it needs, so the limit of a step does not apply.
    end.last.stiffness = 0.0;
    end.last.growth.fill(0.0);
    end.last.wear.fill(0.0);
    end
}

/// Leaves the next periods to direct steps, more each time while jumps do not pay. The obstacle to jumps of `length`
/// cycles may be gone by then: the next try is twice as long.
fn pause_jumps(setup: &Setup, state: &mut State, length: f64) {
    let patience = state.jump.patience.max(1);
    state.jump.rest_until = state.cycle + f64::from(patience * setup.drive.cycles_to_settle());
    state.jump.patience = (2 * patience).min(LONGEST_REST);
    state.jump.length = 2.0 * length;
}

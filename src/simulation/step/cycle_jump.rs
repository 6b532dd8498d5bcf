//! Jumps over many similar cycles.
//!
//! # Formula
//!
//! Wear changes the profile little in a cycle, so the worn depth δ is a smooth function of the
//! number n of cycles, dδ/dn = W(δ), W the wear of a [steady-state cycle](super::steady_cycle) on
//! the frozen profile. That is integrated by [Runge–Kutta–Chebyshev steps](crate::math::chebyshev),
//! whose error is controlled by the tolerance and whose number of stages follows the stiffness of
//! the response of p to wear. The friction work is integrated along with it. The tolerance is in units of the largest
//! depth of the motion or, where the force is prescribed, of the largest compression of a spring; of the work
//! it allows the part that it is of the scar's depth, up to 1e-4.
//!
//! A jump covers whole periods of the motion. It begins after the first period, in which the
//! springs shake down. If it would need more cycles than it covers, cycles are stepped directly for
//! a while.
//!
//! Wear only slows down as the profile adapts, so W × the cycles left bounds what is still to wear. Where that is a small
//! part of the allowed error, the run goes to its goal at once: the bound of stiffness would make the number of jumps
//! proportional to that of cycles in which nothing happens.
//!
//! - **Order**: second in the length of the jump; the wear within one cycle is that of the scheme.
//! - **Cost**: as many evaluated cycles as stages, whatever the number of cycles covered.
//! - **Known failure**: motions that never repeat cannot be jumped; they are stepped directly.

use super::super::breakdown::Cause;
use super::super::choices::Integrator;
use super::super::model::Model;
use super::super::profile::{even_end, scar_volume};
use super::super::setup::Setup;
use super::super::state::{JumpMemory, Ledger, State, SteadyCycle};
use super::{Scratch, deepest, refuse, steady_cycle};
use crate::math::chebyshev;
use crate::math::scan::largest;

/// A jump must save this much: the cycles it covers over what its evaluation costs, in cycles.
const WORTH: f64 = 1.5;

/// A run whose wear up to its goal is at most this part of the error that a jump may have goes there at once.
const QUIET: f64 = 0.1;

/// The most stages of a jump.
const MOST_STAGES: usize = 40;

/// The first jump wears this much at most, in depths and in units of the root of the tolerance.
const FIRST: f64 = 0.3;

/// The most cycles of a jump, also where nothing wears any more.
const LONGEST: f64 = 1e9;

/// How many times its rms the error of a single node may be.
const PEAK: f64 = 10.0;

/// The largest error of the friction work that a jump may make, relative to all of it, however shallow the scar is.
const LEAST_CERTAIN: f64 = 1e-4;

/// The part of the domain beyond which a contact is given room before a jump is made shorter for the want of it.
const NEAR_EDGE: f64 = 0.8;

/// Most periods of direct stepping before a jump is tried again.
const LONGEST_REST: u32 = 16;

/// What came of a try to jump.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in super::super) enum Jumped {
    /// The state is that after the jump.
    Done,
    /// The same, and without a goal the jump would have gone further.
    Shortened,
    /// Jumps do not pay here: the state is as it was, and wants direct steps.
    NotWorthIt,
    /// No jump before the goal pays: direct steps up to there.
    TooNear,
    /// The contact would grow beyond the domain: the state is as it was.
    WithoutRoom,
}

/// Whether the state is one that cycles can be jumped from: at the end of a period but the first.
pub(in super::super) fn is_possible(setup: &Setup, state: &State) -> bool {
    let (Integrator::CycleJump { .. }, Some(period)) =
        (setup.integrator, setup.drive.repeats_after())
    else {
        return false;
    };
    let period = f64::from(period);
    let running_in = setup.running_in.as_ref();
    setup.wear.is_some()
        && setup.drive.tangential().is_some()
        && running_in.is_none_or(|all| all.is_settled(state.cycle, state.ledger.dissipated_energy))
        && state.cycle >= period.max(state.jump.rest_until)
        && state.cycle % period == 0.0
}

/// Jumps over at most `most` cycles, into `next`; where jumps do not pay, `next` is `state` with a rest.
///
/// The first try is as long as it would be without a goal. A run that is saved where a jump has ended, its own goal far
/// away, is repeated with that cycle as its goal: a shorter first try, rejected, would lead to other jumps.
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
    let mut search = Search {
        model,
        state,
        first: &first,
        springs: &springs,
        spare: next,
        scratch,
    };
    if let Some(jump) = search.quiet(&mut memory, most) {
        *next = after_jump(model, state, memory, jump);
        return Ok(Jumped::Shortened);
    }
    let mut found = search.search(&mut memory, f64::INFINITY);
    let is_short = matches!(&found, Ok(jump) if jump.covered > most);
    if is_short {
        go_back(&mut memory, &springs);
        found = search.search(&mut memory, most);
    }
    let refused = match found {
        Ok(jump) => {
            *next = after_jump(model, state, memory, jump);
            return Ok(match is_short {
                true => Jumped::Shortened,
                false => Jumped::Done,
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
            rest(&model.setup, next, length);
            Jumped::NotWorthIt
        }
    })
}

/// The search for a jump from one state.
struct Search<'a> {
    model: &'a Model,
    state: &'a State,
    /// What a cycle does there.
    first: &'a SteadyCycle,
    /// The springs there, shaken down.
    springs: &'a State,
    spare: &'a mut State,
    scratch: &'a mut Scratch,
}

impl Search<'_> {
    /// A jump over all of the `most` cycles up to the goal, where they wear next to nothing: one stable Euler step,
    /// which takes V and k E_d alike.
    fn quiet(&mut self, memory: &mut State, most: f64) -> Option<Jump> {
        let (state, first, setup) = (self.state, self.first, &self.model.setup);
        let Integrator::CycleJump { tolerance } = setup.integrator else {
            return None;
        };
        let period = f64::from(setup.drive.cycles_to_settle());
        let covered = (most / period).floor() * period;
        let worn = covered.min(1.0 / first.stiffness);
        let wear = state.wear.iter().zip(&first.wear);
        let mut jump = Jump {
            covered,
            next: state.jump.length,
            wear: wear.map(|(before, rate)| before + worn * rate).collect(),
            image: vec![0.0; self.model.nodes()],
            friction_work: worn * first.friction_work,
            steady: first.clone(),
        };
        let allowed = tolerance * setup.depth_scale(first.elastic_depth);
        let is_quiet = covered >= period && error(state, first, &jump, allowed, tolerance) <= QUIET;
        if !is_quiet {
            return None;
        }
        self.model.plan.image(&jump.wear, &mut jump.image);
        memory.stats.transforms += 1;
        // The contact at the goal is that of a cycle on its profile.
        let (spare, scratch) = (&mut *self.spare, &mut *self.scratch);
        let steady = steady_cycle::cycle(
            self.model,
            memory,
            spare,
            scratch,
            [&jump.wear, &jump.image],
        );
        if steady.is_err() {
            go_back(memory, self.springs);
        }
        jump.steady = steady.ok()?;
        Some(jump)
    }

    /// A jump of at most `most` cycles whose error is allowed, or one so short that direct steps are better.
    /// `memory` then holds the springs at its end.
    fn search(&mut self, memory: &mut State, most: f64) -> Result<Jump, Refused> {
        let (state, first, setup) = (self.state, self.first, &self.model.setup);
        let Integrator::CycleJump { tolerance } = setup.integrator else {
            return Err(Refused::TooShort(0.0));
        };
        let period = f64::from(setup.drive.cycles_to_settle());
        // Under a held force the depth of indentation grows with the scar, and says nothing of the contact.
        let depth = setup.depth_scale(first.elastic_depth);
        let near_edge = NEAR_EDGE * setup.grid.radius();
        let mut length = if state.jump.length > 0.0 {
            state.jump.length
        } else {
            FIRST * tolerance.sqrt() * depth / largest(&first.wear)
        };
        loop {
            let covered = (length.min(most).min(LONGEST) / period).floor() * period;
            let stages = chebyshev::stages_for(covered * first.stiffness);
            if stages > MOST_STAGES {
                length = 0.5 * covered;
                continue;
            }
            let price = stages as f64 * steady_cycle::cost(setup) * period;
            if covered < (WORTH * price).max(period) {
                return Err(Refused::TooShort(length));
            }
            let tried = self.attempt(memory, covered, stages);
            let error = match &tried {
                Ok(jump) => error(state, first, jump, tolerance * depth, tolerance),
                // The state before the jump still has the springs as they were.
                Err(cause) if cause.lacks_room() && state.contact.normal.radius > near_edge => {
                    return Err(Refused::WithoutRoom);
                }
                // What fails in the middle of a jump is left to a shorter one, or to direct steps.
                Err(_) => f64::INFINITY,
            };
            let next = covered * (0.75 * error.powf(-1.0 / 3.0)).clamp(0.2, 2.0);
            match tried {
                Ok(jump) if error <= 1.0 => {
                    // A goal that was near says nothing about the next jump.
                    let next = if most < length {
                        next.max(length)
                    } else {
                        next
                    };
                    return Ok(Jump { next, ..jump });
                }
                _ => {
                    go_back(memory, self.springs);
                    memory.stats.rejected_jumps += 1;
                    length = next;
                }
            }
        }
    }

    /// One Runge–Kutta–Chebyshev step over `covered` cycles. The last entry of y is the work of friction.
    fn attempt(&mut self, memory: &mut State, covered: f64, stages: usize) -> Result<Jump, Cause> {
        let (model, nodes) = (self.model, self.model.nodes());
        let with_work = |wear: &[f64], friction_work: f64| [wear, &[friction_work]].concat();
        let start = with_work(&memory.wear, 0.0);
        let slope = with_work(&self.first.wear, self.first.friction_work);
        let mut image = vec![0.0; nodes];
        let (spare, scratch) = (&mut *self.spare, &mut *self.scratch);
        let mut look = |memory: &mut State, wear: &[f64], image: &mut [f64]| {
            model.plan.image(wear, image);
            memory.stats.transforms += 1;
            steady_cycle::cycle(model, memory, spare, scratch, [wear, image])
        };
        let stage = |y: &[f64], out: &mut [f64]| {
            let steady = look(memory, &y[..nodes], &mut image)?;
            out[..nodes].copy_from_slice(&steady.wear);
            out[nodes] = steady.friction_work;
            Ok::<(), Cause>(())
        };
        let mut end = chebyshev::step(stages, covered, &start, &slope, stage)?;
        let friction_work = end.pop().unwrap_or_default();
        let steady = look(memory, &end, &mut image)?;
        let depth = memory.contact.depth;
        refuse(model, depth, &end, model.grid.nodes())?;
        Ok(Jump {
            covered,
            next: covered,
            wear: end,
            image,
            friction_work,
            steady,
        })
    }
}

/// Takes the springs back to where they stood; the counts of what was done stay.
fn go_back(memory: &mut State, springs: &State) {
    let stats = memory.stats;
    memory.clone_from(springs);
    memory.stats = stats;
}

/// Why there is no jump.
enum Refused {
    /// It would cover so few cycles that direct steps are better: how long it would have been, in cycles.
    TooShort(f64),
    /// The contact is about to outgrow the domain.
    WithoutRoom,
}

/// A jump over cycles, and the profile after it.
struct Jump {
    /// How many cycles it covers.
    covered: f64,
    /// How many cycles the next one should cover.
    next: f64,
    wear: Vec<f64>,
    image: Vec<f64>,
    friction_work: f64,
    steady: SteadyCycle,
}

/// The error of a jump in units of what is allowed: that of the worn depth, by its rms over the nodes that
/// wear and its largest value, and that of the friction work relative to all the work so far.
fn error(state: &State, first: &SteadyCycle, jump: &Jump, allowed: f64, tolerance: f64) -> f64 {
    let covered = jump.covered;
    let (mut sum, mut largest, mut count) = (0.0, 0.0_f64, 0.0);
    for (j, (&y, &next)) in state.wear.iter().zip(&jump.wear).enumerate() {
        let (f, last) = (first.wear[j], jump.steady.wear[j]);
        if f != 0.0 || last != 0.0 {
            let error = chebyshev::error(covered, y, next, f, last).abs();
            sum += error * error;
            largest = largest.max(error);
            count += 1.0;
        }
    }
    let (before, after) = (first.friction_work, jump.steady.friction_work);
    let work = chebyshev::error(covered, 0.0, jump.friction_work, before, after).abs();
    let total = state.ledger.dissipated_energy + jump.friction_work;
    let of_depth = f64::sqrt(sum / f64::max(count, 1.0)).max(largest / PEAK) / allowed;
    // The part of the scar's depth that is allowed is allowed of the work as well.
    let scar = deepest(&jump.wear).unwrap_or(f64::INFINITY);
    let of_scar = (allowed / scar).min(LEAST_CERTAIN).max(tolerance);
    of_depth.max(work / (of_scar * total).max(f64::MIN_POSITIVE))
}

/// The state after a jump from `state`, with the springs of `memory`.
fn after_jump(model: &Model, state: &State, memory: State, jump: Jump) -> State {
    // Rounding must not take work back where none is done any more.
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
            length: jump.next,
            settled: Some(jump.steady),
            ..JumpMemory::default()
        },
        wear: jump.wear,
        image: jump.image,
        ..memory
    };
    if let Some(law) = &model.setup.wear {
        if law.follows_energy() {
            end.ledger.expected_volume += law.coefficient() * friction_work;
        } else {
            end.ledger.unexplained_volume += worn;
        }
    }
    end.stats.jumps += 1;
    end.last.duration = 0.0;
    // A jump has as many stages as it needs: the limit of a step is not its own.
    end.last.stiffness = 0.0;
    end.last.growth.fill(0.0);
    end.last.wear.fill(0.0);
    end
}

/// Leaves the next periods to direct steps, ever more of them while jumps do not pay. What made jumps of `length`
/// cycles too short may be over by then: the next one tried is twice as long.
fn rest(setup: &Setup, state: &mut State, length: f64) {
    let patience = state.jump.patience.max(1);
    state.jump.rest_until = state.cycle + f64::from(patience * setup.drive.cycles_to_settle());
    state.jump.patience = (2 * patience).min(LONGEST_REST);
    state.jump.length = 2.0 * length;
}

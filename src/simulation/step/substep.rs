//! Splits steps that are too stiff for the scheme into sub-steps.
//!
//! A step is tried, and its stiffness is known before its wear is accepted. If that is too large,
//! the step is split into sub-steps just short enough, which grow again as the wear allows. Other
//! steps are taken exactly as without the guard.
//!
//! # Slip instabilities
//!
//! A spring that slips holds u = μq/G*, so wear by Δg lets it slip back by μE*Δg/G*, and that slip
//! wears again: by kμp μE*/G* times as much. Where this exceeds 1, from about K = 140 for μ = 0.1,
//! the spring slips all at once at any step size. The wear of such a sub-step is limited
//! implicitly, so that the pressure just vanishes, and friction does work only while there is
//! pressure: the rest of the spring's energy is released without friction, and V = k E_d still
//! holds.

use super::super::breakdown::Cause;
use super::super::choices::Stability;
use super::super::state::State;

/// By how much a sub-step may be longer than the one before it.
const GROWTH: f64 = 1.5;

/// The smallest sub-step, in steps: a slip instability in smaller ones ends the same to 1e-3 of the depth, and a step
/// stays quick at any wear.
const SMALLEST: f64 = 3e-3;

/// What came of a try.
pub(super) enum Outcome {
    /// Accepted, at this stiffness.
    Done(f64),
    /// Accepted, and its stiffness did not matter.
    Stabilised,
    /// Not accepted, for this stiffness.
    TooStiff(f64),
}

/// How a step or a sub-step is to be tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// As it is, whatever comes of it.
    Raw,
    /// If it is not too stiff.
    Guarded,
    /// As a slip instability, which stays as stiff in the smallest sub-steps.
    Unstable,
}

/// One step from `state` to `cycle`, into `next`, its sub-steps as long as brings the stiffness to `aim`.
/// `attempt` tries one from a state into another, up to a cycle.
pub(super) fn step(
    guard: Stability,
    aim: f64,
    state: &State,
    next: &mut State,
    cycle: f64,
    mut attempt: impl FnMut(&State, &mut State, f64, Part) -> Result<Outcome, Cause>,
) -> Result<(), Cause> {
    let whole = cycle - state.cycle;
    // The end of the last sub-step; none before there is one.
    let mut within: Option<State> = None;
    let mut part = 1.0;
    let mut hopeless = false;
    let (mut parts, mut stiffest) = (0, 0.0_f64);
    loop {
        let from = within.as_ref().unwrap_or(state);
        let left = cycle - from.cycle;
        let in_parts = part * whole < left * (1.0 - 1e-9);
        let reach = if in_parts {
            // Equal sub-steps avoid a tiny last one, too short to extrapolate from.
            let left_over = (left / (part * whole) - 1e-9).ceil();
            from.cycle + left / left_over
        } else {
            cycle
        };
        let kind = match guard {
            _ if hopeless => Part::Raw,
            Stability::Off => Part::Raw,
            Stability::SubStep if part <= SMALLEST => Part::Unstable,
            Stability::SubStep => Part::Guarded,
        };
        let growth = match attempt(from, next, reach, kind)? {
            // No sub-step is short enough: what comes of it says what is wrong.
            Outcome::TooStiff(f64::INFINITY) => {
                hopeless = true;
                continue;
            }
            Outcome::TooStiff(stiffness) => {
                part = (part * aim / stiffness).max(SMALLEST);
                continue;
            }
            Outcome::Stabilised => {
                stiffest = stiffest.max(aim);
                GROWTH
            }
            Outcome::Done(stiffness) => {
                stiffest = stiffest.max(stiffness);
                (aim / stiffness).clamp(1.0, GROWTH)
            }
        };
        parts += 1;
        part = (part * growth).min(1.0);
        if next.cycle >= cycle {
            break;
        }
        std::mem::swap(within.get_or_insert_with(|| state.clone()), next);
    }
    if parts > 1 {
        next.stats.parts += parts;
    }
    next.last.stiffness = stiffest;
    Ok(())
}

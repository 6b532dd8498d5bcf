//! Steps too harsh for the method, taken in parts.
//!
//! A step is tried, and its stiffness is known before its wear is committed. Where that is too large,
//! the step is taken in parts just small enough, and the parts grow again as the wear allows. A step
//! that nothing parts is taken exactly as without the guard.
//!
//! # Snaps
//!
//! A spring that slips holds u = μq/G*, so wear by Δg lets it slip back by μE*Δg/G*, and that slip wears
//! again: by kμp μE*/G* times as much. Where this exceeds 1, from about K = 140 for μ = 0.1, the spring lets go
//! at once, however short the step. What such a part wears is limited implicitly, so that the pressure vanishes
//! and no more, and friction works only as far as there is pressure left: the rest of the spring's energy
//! is let go of without friction, and V = k E_d goes on holding.

use super::super::breakdown::Cause;
use super::super::choices::Stability;
use super::super::state::State;

/// By how much a part may be longer than the one before it.
const GROWTH: f64 = 1.5;

/// The smallest part of a step: a snap in smaller ones ends the same to 1e-3 of the depth, and a step stays quick
/// at any wear.
const SMALLEST: f64 = 3e-3;

/// What came of a try.
pub(super) enum Outcome {
    /// It is the state, at this stiffness.
    Done(f64),
    /// It is the state, and its stiffness did not matter.
    Relaxed,
    /// It would be, at this stiffness: nothing is changed.
    TooHarsh(f64),
}

/// How a step or a part of one is to be tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// As it is, whatever comes of it.
    Raw,
    /// If it is not too harsh.
    Guarded,
    /// As one that no smaller parts would tame.
    Snap,
}

/// One step from the state's cycle to `cycle`, its parts as long as brings the stiffness to `aim`.
/// `attempt` tries a part that ends at a cycle. On an error the state is as it was before the step.
pub(super) fn step(
    guard: Stability,
    aim: f64,
    state: &mut State,
    cycle: f64,
    mut attempt: impl FnMut(&mut State, f64, Part) -> Result<Outcome, Cause>,
) -> Result<(), Cause> {
    let whole = cycle - state.cycle;
    // A step that fails in a later part must leave nothing of its earlier ones.
    let mut before = None;
    let mut part = 1.0;
    // The last try that was too harsh, its length and its excess.
    let (mut failed, mut snaps, mut hopeless) = (None, false, false);
    let (mut parts, mut stiffest) = (0, 0.0_f64);
    while state.cycle < cycle {
        let left = cycle - state.cycle;
        let in_parts = part * whole < left * (1.0 - 1e-9);
        let reach = if in_parts {
            // Parts of one length: from a short rest nothing is to be looked ahead.
            let left_over = (left / (part * whole) - 1e-9).ceil();
            state.cycle + left / left_over
        } else {
            cycle
        };
        if in_parts && before.is_none() {
            before = Some(state.clone());
        }
        let kind = match guard {
            _ if hopeless => Part::Raw,
            Stability::Off => Part::Raw,
            Stability::SubStep if snaps || part <= SMALLEST => Part::Snap,
            Stability::SubStep => Part::Guarded,
        };
        match attempt(state, reach, kind) {
            // No part is short enough: what comes of it says what is wrong.
            Ok(Outcome::TooHarsh(f64::INFINITY)) => hopeless = true,
            Ok(Outcome::TooHarsh(stiffness)) => {
                // Slip that takes no time stays as large in a part of the step.
                let (tried, was) = failed
                    .replace((part, stiffness))
                    .unwrap_or((part, stiffness));
                snaps = part < tried && stiffness / was > (part / tried).sqrt();
                if !snaps {
                    part = (part * aim / stiffness).max(SMALLEST);
                }
            }
            Ok(Outcome::Relaxed) => {
                parts += 1;
                (failed, snaps) = (None, false);
                stiffest = stiffest.max(aim);
                part = (part * GROWTH).min(1.0);
            }
            Ok(Outcome::Done(stiffness)) => {
                parts += 1;
                (failed, snaps) = (None, false);
                stiffest = stiffest.max(stiffness);
                part = (part * (aim / stiffness).clamp(1.0, GROWTH)).min(1.0);
            }
            Err(cause) => {
                if let Some(before) = before {
                    *state = before;
                }
                return Err(cause);
            }
        }
    }
    if parts > 1 {
        state.effort.parts += parts;
    }
    state.last.stiffness = stiffest;
    Ok(())
}

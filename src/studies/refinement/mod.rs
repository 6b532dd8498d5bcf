//! Errors measured by refinement: the same scenario on other levels of cells and steps.
//!
//! Nothing is assumed about a scenario. [`Ladder`] climbs from coarse to fine until the measured
//! error is as small as `numerics.accuracy` asks for.

use std::time::Instant;

use crate::scenario::Scenario;
use crate::scenario::session::{Session, SessionError};

mod estimate;
mod ladder;
mod level;
mod outcome;
mod placing;
mod resolve;

pub use estimate::{by_twin, estimate, twin};
pub use ladder::{Ladder, Next, Rung, Verdict};
pub use level::Level;
pub use outcome::{Difference, Outcome};
pub use resolve::{Resolved, resolve, resolve_soon, statements_of, words_of};

/// The end of a ladder.
#[derive(Debug, Clone)]
pub struct Reached {
    /// The last rung, at its end.
    pub session: Session,
    /// How finely it was computed, and how it ended.
    pub rung: Rung,
    /// Its estimated error.
    pub error: Difference,
    /// Whether the accuracy is met, or why the ladder ended before.
    pub verdict: Verdict,
    /// The time of all rungs, s.
    pub seconds: f64,
}

/// Runs `scenario` over `cycles` on finer and finer levels until the worn depth and the volume have an
/// estimated error of at most `accuracy`, or the search takes longer than `budget` seconds: then the last level that came
/// to its end is the result. The coarsest first level is always finished, since nothing is known before.
/// `go_on` is asked at every step; if it says no, there is no result.
///
/// # Errors
/// If a level is refused, if no level runs to its end, or on an interrupt.
pub fn run_to_accuracy(
    scenario: &Scenario,
    cycles: f64,
    accuracy: f64,
    budget: f64,
    go_on: &dyn Fn() -> bool,
) -> Result<Reached, SessionError> {
    let begin = Instant::now();
    let clock = || begin.elapsed().as_secs_f64();
    climb(scenario, cycles, accuracy, budget, go_on, &clock)
}

/// [`run_to_accuracy`] with the seconds of another clock.
///
/// # Errors
/// As there.
pub fn climb(
    scenario: &Scenario,
    cycles: f64,
    accuracy: f64,
    budget: f64,
    go_on: &dyn Fn() -> bool,
    clock: &dyn Fn() -> f64,
) -> Result<Reached, SessionError> {
    let mut ladder = Ladder::new(scenario, cycles, accuracy, budget);
    let begin = clock();
    let mut last = None;
    loop {
        let next = ladder.next();
        let level = match &next {
            Next::Run(level) | Next::Twin(level) => level,
            Next::Done(verdict) => {
                let (Some(session), Some((rung, error))) = (last, ladder.reached()) else {
                    return Err(match verdict {
                        Verdict::Failed(why) => SessionError::Unfinished(why.clone()),
                        _ => SessionError::Interrupted,
                    });
                };
                return Ok(Reached {
                    session,
                    rung: rung.clone(),
                    error,
                    verdict: verdict.clone(),
                    seconds: ladder.spent(),
                });
            }
        };
        let start = clock();
        let is_late = || clock() - begin > ladder.deadline();
        let ended = run(&level.of_scenario(scenario)?, cycles, &|| {
            go_on() && !is_late()
        });
        let seconds = clock() - start;
        match ended {
            Ok(session) => {
                ladder.report(Outcome::of(&session), seconds);
                if matches!(next, Next::Run(_)) {
                    last = Some(session);
                }
            }
            Err(SessionError::Interrupted) if go_on() && is_late() => ladder.cut(seconds),
            Err(SessionError::Interrupted) => return Err(SessionError::Interrupted),
            Err(error) => ladder.fail(error.to_string(), seconds),
        }
    }
}

/// Runs a scenario to `cycles`, as long as `go_on` says so.
///
/// # Errors
/// If the run stops, or is [interrupted](SessionError::Interrupted).
pub fn run(
    scenario: &Scenario,
    cycles: f64,
    go_on: &dyn Fn() -> bool,
) -> Result<Session, SessionError> {
    let mut session = Session::start(scenario.clone())?;
    session.advance_while(cycles, |_| go_on())?;
    Ok(session)
}

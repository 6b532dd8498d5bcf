//! A rung of the ladder and its errors.
//!
//! A difference D of two levels, one ρ times finer than the other, gives the error of the finer one:
//!
//! ```text
//! e = D/(ρᵖ − 1),   p = 1.1,   but at least e of the previous rung/ρ²
//! ```
//!
//! If both cells and steps are refined, D is divided in proportion to their previous errors. Errors of several sources
//! add up like independent ones: as the root of the sum of squares.

use super::level::Level;
use super::outcome::{Difference, Outcome};
use crate::scenario::Scenario;
use crate::scenario::session::{Session, SessionError};

/// One run of the ladder.
#[derive(Debug, Clone)]
pub struct Rung {
    /// Its resolution.
    pub level: Level,
    /// The run at its end.
    pub session: Session,
    /// State at the end of the run.
    pub outcome: Outcome,
    /// Its time, s.
    pub seconds: f64,
}

impl Rung {
    /// Returns the error in a source by a twin that is coarser in it.
    pub(super) fn error_by(&self, twin: &Self, source: usize) -> Difference {
        let ratio = self.level.ratio(&twin.level)[source];
        self.outcome.error_by(&twin.outcome, ratio)
    }
}

/// A rung and its errors by source.
#[derive(Debug)]
pub(super) struct Top {
    pub rung: Rung,
    /// Errors due to cells, steps and jumps.
    pub sources: Vec<Difference>,
}

impl Top {
    pub fn error(&self) -> Difference {
        let add = |sum: Difference, one: &Difference| sum.combined(one, |sum, one| sum + one * one);
        let squares = self.sources.iter().fold(Difference::default(), add);
        let sum = squares.combined(&squares, |sum, _| sum.sqrt());
        sum.as_estimate()
    }

    /// Returns the error to compare with the requested accuracy. V and k E_d must agree as well, since they are two
    /// computations of one number.
    pub fn promised(&self) -> f64 {
        self.error().promised().max(self.rung.outcome.imbalance)
    }

    pub fn is_unworn(&self) -> bool {
        self.rung.outcome.volume <= 0.0
    }

    /// Returns the errors of a finer rung.
    pub fn errors_of(&self, finer: &Rung) -> Vec<Difference> {
        let ratios = finer.level.ratio(&self.rung.level);
        let difference = self.rung.outcome.difference_from(&finer.outcome);
        let known = || self.sources.iter().zip(ratios);
        let refined = known().filter(|(_, ratio)| *ratio > 1.0);
        let add =
            |sum: Difference, (one, _): (&Difference, f64)| sum.combined(one, |sum, one| sum + one);
        let total = refined.fold(Difference::default(), add);
        let after = |(before, ratio): (&Difference, f64)| {
            if ratio <= 1.0 {
                return *before;
            }
            let share = before.combined(&total, |error, total| match total {
                0.0 => 1.0,
                total => error / total,
            });
            let own = share.combined(&difference, |share, d| share * d);
            own.error_above(before, ratio)
        };
        known().map(after).collect()
    }
}

/// Runs a scenario to `cycles` while `go_on` returns true.
///
/// # Errors
/// If the run stops, or is [interrupted](SessionError::Interrupted).
pub fn run(
    scenario: &Scenario,
    cycles: f64,
    go_on: &dyn Fn() -> bool,
) -> Result<Session, SessionError> {
    run_in_part(scenario, cycles, u64::MAX, go_on)
}

/// As [`run`], but ends before `cycles` after `most_jumps`.
pub(super) fn run_in_part(
    scenario: &Scenario,
    cycles: f64,
    most_jumps: u64,
    go_on: &dyn Fn() -> bool,
) -> Result<Session, SessionError> {
    let mut session = Session::start(scenario.clone())?;
    let has_room = |session: &Session| session.simulation().stats().jumps < most_jumps;
    let ended = session.advance_while(cycles, |session| go_on() && has_room(session));
    match ended {
        Err(SessionError::Interrupted) if go_on() && !has_room(&session) => Ok(session),
        ended => ended.map(|()| session),
    }
}

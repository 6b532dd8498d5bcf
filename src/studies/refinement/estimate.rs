//! Estimates the error of a run from coarser twins.
//!
//! Two twins with a half and a quarter of the cells and of the steps give two differences, and these the order:
//!
//! ```text
//! D₁ = |run − half|,  D₂ = |half − quarter|,  p = log₂(D₂/D₁),  e = D₁/(2ᵖ − 1)
//! ```
//!
//! p is limited to the observed range, since two runs may agree by chance: V and F_x are numbers in which errors of
//! opposite sign cancel, so D₁ counts as at least a quarter of D₂, as in a scheme of second order. A run too coarse
//! to be halved twice is compared with a finer twin instead.

use super::level::{Level, at_steps};
use super::outcome::{Difference, Outcome};
use super::run;
use crate::scenario::session::{Session, SessionError};
use crate::scenario::{Change, Scenario};

/// The orders that are believed, and the one assumed where it is not measured.
const ORDERS: (f64, f64) = (0.8, 1.7);
const ASSUMED: f64 = 1.3;

/// The fewest cells and steps that a twin is any good with.
const COARSEST: (usize, u32) = (8, 4);

/// No difference falls faster than this from the quarter to the half: the schemes are of second order at best.
const FASTEST: f64 = 4.0;

/// Estimates the error of a run at its present moment.
///
/// # Errors
/// If the twin cannot be run, or if `go_on` said no on the way.
pub fn estimate(session: &Session, go_on: &dyn Fn() -> bool) -> Result<Difference, SessionError> {
    let level = Level::of(session.loaded());
    let cycle = session.simulation().cycle();
    let here = Outcome::of(session);
    let ended = |factor: f64| -> Result<Outcome, SessionError> {
        let twin = run(&twin_of(session, factor)?, cycle, go_on)?;
        Ok(Outcome::of(&twin))
    };
    if !level.can_be(0.25) {
        let ratio = 2f64.powf(ASSUMED);
        let difference = here.against(&ended(2.0)?);
        return Ok(difference.with(&difference, |d, _| d * ratio / (ratio - 1.0)));
    }
    let half = ended(0.5)?;
    match ended(0.25) {
        Ok(quarter) => Ok(half
            .against(&here)
            .with(&quarter.against(&half), by_observed_order)
            .as_estimate()),
        Err(SessionError::Interrupted) => Err(SessionError::Interrupted),
        // A quarter that breaks down leaves the order unknown, and no more.
        Err(_) => Ok(by_twin(&half, &here)),
    }
}

/// Estimates the error of a run from its [`twin`] alone, at the same cycle: with the order that is usually seen.
pub fn by_twin(twin: &Outcome, run: &Outcome) -> Difference {
    let difference = twin.against(run);
    difference.with(&difference, |d, _| d / (2f64.powf(ASSUMED) - 1.0))
}

/// The run with half its cells and steps, at its start; `None` if it is too coarse to be halved.
pub fn twin(session: &Session) -> Option<Result<Session, SessionError>> {
    let level = Level::of(session.loaded());
    level
        .can_be(0.5)
        .then(|| Session::start(twin_of(session, 0.5)?))
}

impl Level {
    /// Whether a twin of `factor` times its cells and steps is any good.
    fn can_be(&self, factor: f64) -> bool {
        let (cells, steps) = COARSEST;
        self.points as f64 * factor >= cells as f64
            && f64::from(self.steps) * factor >= f64::from(steps)
    }
}

/// The error of the finest of three levels, from their two differences.
fn by_observed_order(first: f64, second: f64) -> f64 {
    let order = match first > 0.0 && second > 0.0 {
        true => (second / first).log2().clamp(ORDERS.0, ORDERS.1),
        false => ASSUMED,
    };
    first.max(second / FASTEST) / (2f64.powf(order) - 1.0)
}

/// The run as a scenario with `factor` times its cells and steps, including the changes made to it.
fn twin_of(session: &Session, factor: f64) -> Result<Scenario, SessionError> {
    let loaded = session.loaded();
    let level = Level::of(loaded);
    let changes = session.changes().iter().map(|change| {
        let value = change.value().parse::<f64>();
        let scaled = match (change.key(), value) {
            ("numerics.points", Ok(points)) => (points * factor).round().max(8.0).to_string(),
            ("numerics.steps_per_cycle", Ok(steps)) => {
                (steps * factor).round().max(4.0).to_string()
            }
            ("numerics.tolerance", Ok(tolerance)) => {
                format!("{:e}", at_steps(tolerance, factor))
            }
            _ => return change.clone(),
        };
        Change::new(change.at_cycle, change.key(), &scaled)
    });
    let changes: Vec<Change> = changes.collect();
    let scenario = level.scaled(factor, factor).of_scenario(loaded)?;
    Ok(scenario.with_changes(changes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_levels_give_the_error_of_the_finest() {
        // e(h) = h^p: D₁ = 2ᵖ − 1, D₂ = 4ᵖ − 2ᵖ for an error of 1.
        for order in [0.8f64, 1.0, 1.5, 1.7] {
            let half = 2f64.powf(order);
            let found = by_observed_order(half - 1.0, half * half - half);
            assert!((found - 1.0).abs() < 1e-12, "{order}: {found}");
        }
        // A coincidence of the two finer ones is not believed.
        assert!(by_observed_order(0.0, 1.0) > 0.5 / FASTEST);
        // Runs that do not come nearer have an error of about their distance.
        assert!(by_observed_order(1.0, 0.5) > 1.0);
    }
}

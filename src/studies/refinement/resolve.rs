//! Resolves an accuracy to points and steps, and words the result for files and messages.

use super::{Difference, Reached, RefinementError, Verdict, run_to_accuracy};
use crate::scenario::Scenario;
use crate::scenario::session::Session;

/// Cycles over which an accuracy is met for a run without an end.
const WITHOUT_END: f64 = 100.0;

/// The longest that a screen waits for an accuracy, s.
pub const SCREEN_BUDGET: f64 = 10.0;

/// A scenario with the points and steps that were found for its accuracy.
#[derive(Debug, Clone)]
pub struct Resolved {
    /// The scenario, ready to run.
    pub scenario: Scenario,
    /// What the headers of its files state: keys and values.
    pub statements: Vec<(String, String)>,
    /// One line if the accuracy is not met.
    pub warning: Option<String>,
    /// The run on these points and steps at its end, if there was an accuracy to meet.
    pub ended: Option<Session>,
}

/// Finds the points and steps that meet the accuracy of `scenario` in a run of `cycles` (those of its own plan if
/// `None`), looking for `budget` seconds at most. A scenario without an accuracy is returned as it is.
///
/// # Errors
/// If no level runs to its end, or if `go_on` says no.
pub fn resolve(
    scenario: &Scenario,
    cycles: Option<f64>,
    budget: f64,
    go_on: &dyn Fn() -> bool,
) -> Result<Resolved, RefinementError> {
    let Some(accuracy) = scenario.accuracy() else {
        return Ok(Resolved {
            scenario: scenario.clone(),
            statements: Vec::new(),
            warning: None,
            ended: None,
        });
    };
    let cycles = cycles.or(scenario.run().cycles).unwrap_or(WITHOUT_END);
    let reached = run_to_accuracy(scenario, cycles, accuracy, budget, go_on)?;
    let mut statements = vec![("accuracy".to_owned(), format!("{accuracy:e}"))];
    if reached.verdict != Verdict::Unworn {
        statements.extend(statements_of(&reached.error));
    }
    let warning = unmet(&reached, accuracy, budget);
    statements.extend(warning.clone().map(|word| ("warning".to_owned(), word)));
    Ok(Resolved {
        scenario: reached.session.loaded().clone(),
        statements,
        warning,
        ended: Some(reached.session),
    })
}

/// Estimated errors as the headers of files state them.
pub fn statements_of(error: &Difference) -> Vec<(String, String)> {
    [
        ("estimated_error", error.worn_depth),
        ("estimated_error_volume", error.volume),
        ("estimated_error_energy", error.work),
        ("estimated_error_force", error.force),
        ("estimated_error_pressure", error.pressure),
    ]
    .map(|(key, value)| (key.to_owned(), format!("{value:.1e}")))
    .to_vec()
}

/// What is said of an accuracy that is not met.
fn unmet(reached: &Reached, accuracy: f64, budget: f64) -> Option<String> {
    let level = &reached.rung.level;
    let why = match &reached.verdict {
        Verdict::Met => return None,
        Verdict::Unworn => {
            return Some(format!(
                "numerics.accuracy = {accuracy:e}: nothing has worn, so the accuracy of a scar \
                 means nothing"
            ));
        }
        Verdict::OutOfTime => format!("in {budget} s"),
        Verdict::Finest => "even by the finest level".into(),
        Verdict::Stalled => format!(
            "because finer levels do not improve \
             it; the scar is {:.1e} m deep, in a contact {:.1e} m deep",
            reached.rung.outcome.scar_depth(),
            reached.rung.outcome.depth
        ),
        Verdict::Failed(error) => format!("because finer levels fail: {error}"),
    };
    Some(format!(
        "numerics.accuracy = {accuracy:e} was not reached \
         {why}; the estimated error is {:.1e} with {} points and \
         {} steps per cycle",
        reached.error.promised().max(reached.rung.outcome.imbalance),
        level.points,
        level.steps
    ))
}

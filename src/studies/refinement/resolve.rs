//! Finds points and steps for an accuracy, and words the result for files and messages.

use super::budget::Budget;
use super::ladder::{Reached, SearchError, Verdict, run_to_accuracy};
use super::level::Level;
use crate::reading::Errors;
use crate::scenario::session::{Session, SessionError};
use crate::scenario::spec::Passage;
use crate::scenario::{Scenario, USUAL_ACCURACY};

/// Cycles over which a run without an end must meet its accuracy.
const WITHOUT_END: f64 = 100.0;

/// Maximum time that a screen waits for the usual accuracy, and for one that was requested, s.
const SCREEN_WAITS: [f64; 2] = [0.5, 10.0];

/// A screen shows every cycle of shorter runs, unless the scenario asks for jumps.
const WATCHED: f64 = 1e4;

/// A scenario with the points and steps found for its accuracy.
#[derive(Debug, Clone)]
pub struct Resolved {
    /// The scenario, ready to run.
    pub scenario: Scenario,
    /// The errors that its files state.
    pub errors: Errors,
    /// One line if the accuracy is not met.
    pub warning: Option<String>,
    /// Estimated error of a scar, if it exceeds the requested accuracy.
    pub missed_by: Option<f64>,
    /// The run on these points and steps at its end, if there was an accuracy to meet.
    pub ended: Option<Session>,
}

impl Resolved {
    /// Wraps a scenario unchanged; its error is unknown.
    fn as_given(scenario: Scenario) -> Self {
        Self {
            scenario,
            errors: Errors::default(),
            warning: None,
            missed_by: None,
            ended: None,
        }
    }
}

/// Finds the points and steps that meet the accuracy of `scenario` in a run of `cycles` (its own plan's if `None`)
/// within a `budget`. If no level finishes in that time, the result is the coarsest level, whose error is unknown. A
/// scenario without an accuracy is returned unchanged.
///
/// # Errors
/// If no level can be run, or if `go_on` returns false and no run follows.
pub fn resolve(
    scenario: &Scenario,
    cycles: Option<f64>,
    budget: Budget,
    go_on: &dyn Fn() -> bool,
) -> Result<Resolved, SessionError> {
    match search(scenario, cycles, budget, go_on) {
        Ok(found) => Ok(found),
        Err(SearchError::Unended(level)) => unverified(scenario, &level, budget),
        Err(SearchError::Session(error)) => Err(error),
    }
}

fn search(
    scenario: &Scenario,
    cycles: Option<f64>,
    budget: Budget,
    go_on: &dyn Fn() -> bool,
) -> Result<Resolved, SearchError> {
    let Some(accuracy) = scenario.accuracy() else {
        return Ok(Resolved::as_given(scenario.clone()));
    };
    let cycles = cycles.or(scenario.run().cycles).unwrap_or(WITHOUT_END);
    let reached = run_to_accuracy(scenario, cycles, accuracy, budget, go_on)?;
    let has_worn = reached.verdict != Verdict::Unworn;
    let warning = unmet(&reached, accuracy, budget);
    let is_missed = !matches!(reached.verdict, Verdict::Met | Verdict::Unworn);
    let errors = Errors {
        accuracy: Some(accuracy),
        warning: warning.clone(),
        ..reached.error.stated(has_worn)
    };
    Ok(Resolved {
        scenario: reached.rung.session.loaded().clone(),
        errors,
        warning,
        missed_by: is_missed.then(|| error_of(&reached)),
        ended: Some(reached.rung.session),
    })
}

/// Runs [`resolve`] for a screen: if no level finishes in time, the scenario takes the default level.
///
/// # Errors
/// If no level can be run.
pub fn resolve_soon(scenario: &Scenario) -> Result<Resolved, SessionError> {
    let [usual, asked_for] = SCREEN_WAITS;
    let budget = Budget::of_search(match scenario.accuracy() {
        Some(USUAL_ACCURACY) => usual,
        _ => asked_for,
    });
    match search(scenario, None, budget, &|| true) {
        Ok(found) if is_watched(scenario) => Ok(Resolved {
            scenario: (found.scenario)
                .edited(|spec| spec.numerics.integrator = Some(Passage::Direct))?,
            ..found
        }),
        Ok(found) => Ok(found),
        Err(SearchError::Unended(_)) => {
            unverified(scenario, &Level::from_scenario(scenario), budget)
        }
        Err(SearchError::Session(error)) => Err(error),
    }
}

/// Returns a scenario on a `level` of unknown error, since no search finished within the `budget`.
fn unverified(
    scenario: &Scenario,
    level: &Level,
    budget: Budget,
) -> Result<Resolved, SessionError> {
    let Level { points, steps, .. } = level;
    let warning = format!(
        "no level of refinement ended {}: these are {points} points and {steps} steps per cycle, of unknown error",
        in_time(budget)
    );
    Ok(Resolved {
        errors: Errors {
            warning: Some(warning.clone()),
            ..Errors::default()
        },
        warning: Some(warning),
        missed_by: Some(f64::INFINITY),
        ..Resolved::as_given(level.of_scenario(scenario)?)
    })
}

/// Says in words how the search ended.
fn in_time(budget: Budget) -> String {
    match budget.seconds() {
        f64::INFINITY => "before the search was interrupted".into(),
        seconds => format!("in {seconds} s"),
    }
}

/// Whether the screen should show every cycle of a run, though the run could jump over them.
fn is_watched(scenario: &Scenario) -> bool {
    let is_open = scenario.accuracy().is_some() && scenario.spec().numerics.integrator.is_none();
    is_open && scenario.run().cycles.is_none_or(|cycles| cycles < WATCHED)
}

/// Explains why an accuracy was not met, if so.
fn unmet(reached: &Reached, accuracy: f64, budget: Budget) -> Option<String> {
    let (Level { points, steps, .. }, outcome) = (&reached.rung.level, &reached.rung.outcome);
    let why = match &reached.verdict {
        Verdict::Met => return None,
        Verdict::Unworn => {
            return Some(format!(
                "numerics.accuracy = {accuracy:e}: nothing has worn, so the accuracy of a scar \
                 means nothing"
            ));
        }
        Verdict::OutOfTime => in_time(budget),
        Verdict::Interrupted => in_time(Budget::UNLIMITED),
        Verdict::Finest => "even by the finest level".into(),
        Verdict::Stalled => format!(
            "because finer levels do not improve it; the scar is {:.1e} m deep, in a contact {:.1e} m deep",
            outcome.scar_depth(),
            outcome.depth
        ),
        Verdict::Failed(error) => format!("because finer levels fail: {error}"),
    };
    let error = error_of(reached);
    Some(format!(
        "numerics.accuracy = {accuracy:e} was not reached {why}; the estimated error is {error:.1e} with {points} \
         points and {steps} steps per cycle"
    ))
}

/// Returns the estimated error to compare with an accuracy.
fn error_of(reached: &Reached) -> f64 {
    reached.error.promised().max(reached.rung.outcome.imbalance)
}

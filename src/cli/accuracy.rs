//! `numerics.accuracy` and `--estimate-error` on the command line.

use super::complain;
use super::progress::{self, Bar};
use crate::reading::Errors;
use crate::scenario::Scenario;
use crate::scenario::session::{Session, SessionError};
use crate::studies::refinement::{self, Budget, Resolved};

/// Finds the points and steps that meet the accuracy of `scenario` with `search`. Shows progress on stderr unless
/// `quiet`, and warns there if the accuracy is not met.
///
/// # Errors
/// The errors of `search`.
pub(super) fn resolve(
    scenario: &Scenario,
    quiet: bool,
    search: impl FnOnce(&Scenario) -> Result<Resolved, SessionError>,
) -> Result<Resolved, SessionError> {
    let message = "looking for points and steps that meet numerics.accuracy";
    let is_quiet = quiet || scenario.accuracy().is_none();
    let bar = Bar::new(message, 0.0, progress::COUNTS, is_quiet);
    let found = search(scenario);
    drop(bar);
    if let Ok(Resolved { warning, .. }) = &found {
        warning.iter().for_each(|word| complain(word));
    }
    found
}

/// Starts a session of `scenario`. If it asks for an accuracy, chooses points and steps that meet it in a run of
/// `cycles`.
///
/// # Errors
/// If no level runs to its end, or the contact cannot be made.
pub(super) fn session(
    scenario: &Scenario,
    cycles: Option<f64>,
    quiet: bool,
) -> Result<Session, SessionError> {
    let found = resolve(scenario, quiet, |scenario| {
        refinement::resolve(scenario, cycles, Budget::UNLIMITED, &|| true)
    })?;
    let mut session = Session::start(found.scenario)?;
    session.state(found.errors);
    Ok(session)
}

/// Returns the estimated errors of a finished run, or the reason why there are none in one line.
pub(super) fn estimated(session: &Session, go_on: &dyn Fn() -> bool) -> Result<Errors, String> {
    let moment = session.simulation().moment();
    let has_worn = moment.wear_volume > moment.initial_volume;
    match refinement::estimate(session, go_on) {
        Ok(error) => Ok(error.stated(has_worn)),
        Err(SessionError::Interrupted) => Err("interrupted: no error was estimated".into()),
        Err(error) => Err(format!("cannot estimate the error: a coarser run {error}")),
    }
}

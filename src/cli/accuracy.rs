//! `numerics.accuracy` and `--estimate-error` on the command line.

use super::{complain, progress};
use crate::scenario::Scenario;
use crate::scenario::session::{Session, SessionError};
use crate::studies::refinement::{self, Budget, Resolved};

/// Finds the points and steps that meet the accuracy of `scenario` by `search`, with a spinner on stderr unless `quiet`,
/// and says there if they do not meet it.
///
/// # Errors
/// Those of `search`.
pub(super) fn resolve(
    scenario: &Scenario,
    quiet: bool,
    search: impl FnOnce(&Scenario) -> Result<Resolved, SessionError>,
) -> Result<Resolved, SessionError> {
    let message = "looking for points and steps that meet numerics.accuracy";
    let spinner = progress::spinner(message, quiet || scenario.accuracy().is_none());
    let found = search(scenario);
    // What ticks would draw it once more.
    spinner.disable_steady_tick();
    spinner.finish_and_clear();
    if let Ok(Resolved { warning, .. }) = &found {
        warning.iter().for_each(|word| complain(word));
    }
    found
}

/// A session of `scenario` at its start, with points and steps that meet its accuracy in a run of `cycles`, if it
/// has one.
///
/// # Errors
/// If no level runs to its end, and a contact that cannot be made.
pub(super) fn session(
    scenario: &Scenario,
    cycles: Option<f64>,
    quiet: bool,
) -> Result<Session, SessionError> {
    let found = resolve(scenario, quiet, |scenario| {
        refinement::resolve(scenario, cycles, Budget::UNLIMITED, &|| true)
    })?;
    let mut session = Session::start(found.scenario)?;
    session.state(found.statements);
    Ok(session)
}

/// The estimated error of a finished run as header lines, or one line saying why there is none.
pub(super) fn estimated(
    session: &Session,
    go_on: &dyn Fn() -> bool,
) -> Result<Vec<(String, String)>, String> {
    let moment = session.simulation().moment();
    let has_worn = moment.wear_volume > moment.initial_volume;
    match refinement::estimate(session, go_on) {
        Ok(error) => Ok(refinement::statements_of(&error, has_worn)),
        Err(SessionError::Interrupted) => Err("interrupted: no error was estimated".into()),
        Err(error) => Err(format!("cannot estimate the error: a coarser run {error}")),
    }
}

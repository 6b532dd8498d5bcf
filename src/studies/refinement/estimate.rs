//! Estimates the error of a run from coarser twins.
//!
//! Two twins, one [coarser](TWIN) in cells and steps and one coarser still, give two differences, from which the error
//! follows as on the [ladder](super::climb). A run too coarse for that is compared with a finer twin instead.

use super::ladder::TWIN;
use super::level::{Level, at_steps};
use super::outcome::{Difference, Outcome};
use super::rung::run;
use crate::scenario::session::{Session, SessionError};
use crate::scenario::value::Value;
use crate::scenario::{Change, Scenario};
use crate::simulation::Spacing;

/// Minimum cells and steps for a useful twin.
const COARSEST: (usize, u32) = (8, 4);

/// Estimates the error of a run at its present moment.
///
/// # Errors
/// If the twin cannot be run, or if `go_on` returns false before the end.
pub fn estimate(session: &Session, go_on: &dyn Fn() -> bool) -> Result<Difference, SessionError> {
    let level = Level::from_scenario(session.loaded());
    let cycle = session.simulation().cycle();
    let here = Outcome::from_session(session);
    let ended = |factor: f64| -> Result<Outcome, SessionError> {
        let twin = run(&twin_of(session, factor)?, cycle, go_on)?;
        Ok(Outcome::from_session(&twin))
    };
    let by = |twin: &Outcome| here.error_by(twin, here.finer_than(twin));
    let coarser = TWIN.recip();
    if !level.allows_twin(coarser * coarser) {
        return Ok(by(&ended(TWIN)?));
    }
    let twin = ended(coarser)?;
    match ended(coarser * coarser) {
        Ok(coarsest) => {
            let before = twin.error_by(&coarsest, twin.finer_than(&coarsest));
            let difference = twin.difference_from(&here);
            let error = difference.error_above(&before, here.finer_than(&twin));
            Ok(error.as_estimate())
        }
        Err(SessionError::Interrupted) => Err(SessionError::Interrupted),
        // If the coarsest one breaks down, only a chance agreement of two numbers may go unnoticed.
        Err(_) => Ok(by(&twin)),
    }
}

/// Returns the run with fewer cells and steps by [`TWIN`], at its start; `None` if that would be too coarse.
pub fn twin(session: &Session) -> Option<Result<Session, SessionError>> {
    let coarser = TWIN.recip();
    let can_be = Level::from_scenario(session.loaded()).allows_twin(coarser);
    can_be.then(|| Session::start(twin_of(session, coarser)?))
}

impl Level {
    /// Whether a twin with `factor` times its cells and steps is useful.
    fn allows_twin(&self, factor: f64) -> bool {
        let (cells, steps) = COARSEST;
        self.points as f64 * factor >= cells as f64
            && f64::from(self.steps) * factor >= f64::from(steps)
    }
}

/// Returns the scenario of the run with `factor` times its cells and steps, including the changes made to it.
fn twin_of(session: &Session, factor: f64) -> Result<Scenario, SessionError> {
    let loaded = session.loaded();
    let mut level = Level::from_scenario(loaded);
    let setup = session.simulation().setup();
    // Cells placed by a pilot keep their spacing: another pilot would place the twin's cells elsewhere, and the
    // difference would measure the placement. A node on a stick border is placed again, as are nodes after a change.
    let is_placed = setup.spacing == Spacing::Graded && setup.grid.border().is_none();
    if is_placed && session.changes().is_empty() {
        level.nodes = Some(setup.grid.clone());
    }
    let whole = |number: f64, least: f64| (number * factor).round().max(least);
    let mut changes = session.changes().to_vec();
    for Change { key, value, .. } in &mut changes {
        match (key.path, value) {
            ("numerics.points", Value::Whole(points)) => {
                *points = whole(*points as f64, 8.0) as i64
            }
            ("numerics.steps_per_cycle", Value::Whole(steps)) => {
                *steps = whole(*steps as f64, 4.0) as i64;
            }
            ("numerics.tolerance", Value::Number(tolerance)) => {
                *tolerance = at_steps(*tolerance, factor);
            }
            _ => {}
        }
    }
    let scenario = level.scaled(factor, factor).of_scenario(loaded)?;
    Ok(scenario.with_changes(changes))
}

//! Estimates the error of a run from coarser twins.
//!
//! Two twins, one [coarser](TWIN) in cells and steps and one coarser still, give two differences, which tell the error as
//! rungs of the [ladder](super::climb) do. A run too coarse for that is compared with a finer twin instead.

use super::ladder::TWIN;
use super::level::{Level, at_steps};
use super::outcome::{Difference, Outcome};
use super::rung::run;
use crate::scenario::session::{Session, SessionError};
use crate::scenario::{Change, Scenario};
use crate::simulation::Spacing;

/// The fewest cells and steps that a twin is any good with.
const COARSEST: (usize, u32) = (8, 4);

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
    let coarser = TWIN.recip();
    if !level.can_be(coarser * coarser) {
        // The error of the coarser one is that of the finer one and the difference.
        let twin = ended(TWIN)?;
        let difference = here.against(&twin);
        let finer = difference.error_of_finer(ratio(&here, &twin));
        return Ok(difference.with(&finer, |difference, finer| difference + finer));
    }
    let twin = ended(coarser)?;
    match ended(coarser * coarser) {
        Ok(coarsest) => {
            let before = by_twin(&coarsest, &twin);
            let error = twin
                .against(&here)
                .error_above(&before, ratio(&twin, &here));
            Ok(error.as_estimate())
        }
        Err(SessionError::Interrupted) => Err(SessionError::Interrupted),
        // If the coarsest breaks down, it only stays unseen that two numbers may agree by chance.
        Err(_) => Ok(by_twin(&twin, &here)),
    }
}

/// Estimates the error of a run from its [`twin`] alone, at the same cycle.
pub fn by_twin(twin: &Outcome, run: &Outcome) -> Difference {
    twin.against(run).error_of_finer(ratio(twin, run))
}

/// How many times finer one of two runs is; rounding to whole cells makes this differ from [`TWIN`].
fn ratio(coarse: &Outcome, fine: &Outcome) -> f64 {
    fine.grid.cells() as f64 / coarse.grid.cells() as f64
}

/// The run with fewer cells and steps by [`TWIN`], at its start; `None` if it is too coarse for one.
pub fn twin(session: &Session) -> Option<Result<Session, SessionError>> {
    let coarser = TWIN.recip();
    let can_be = Level::of(session.loaded()).can_be(coarser);
    can_be.then(|| Session::start(twin_of(session, coarser)?))
}

impl Level {
    /// Whether a twin of `factor` times its cells and steps is any good.
    fn can_be(&self, factor: f64) -> bool {
        let (cells, steps) = COARSEST;
        self.points as f64 * factor >= cells as f64
            && f64::from(self.steps) * factor >= f64::from(steps)
    }
}

/// The run as a scenario with `factor` times its cells and steps, including the changes made to it.
fn twin_of(session: &Session, factor: f64) -> Result<Scenario, SessionError> {
    let loaded = session.loaded();
    let mut level = Level::of(loaded);
    let setup = session.simulation().setup();
    // Cells that a pilot has placed keep their spacing: another pilot would place those of the twin elsewhere, and the
    // difference would be that of the places. A node on a stick border is found anew, and so are nodes after a change.
    let is_placed = setup.spacing == Spacing::Graded && setup.grid.border().is_none();
    if is_placed && session.changes().is_empty() {
        level.nodes = Some(setup.grid.clone());
    }
    let whole = |number: f64, least: f64| (number * factor).round().max(least).to_string();
    let changes = session.changes().iter().map(|change| {
        let scaled = match (change.key(), change.value().parse::<f64>()) {
            ("numerics.points", Ok(points)) => whole(points, 8.0),
            ("numerics.steps_per_cycle", Ok(steps)) => whole(steps, 4.0),
            ("numerics.tolerance", Ok(before)) => format!("{:e}", at_steps(before, factor)),
            _ => return change.clone(),
        };
        Change::new(change.at_cycle, change.key(), &scaled)
    });
    let changes: Vec<Change> = changes.collect();
    let scenario = level.scaled(factor, factor).of_scenario(loaded)?;
    Ok(scenario.with_changes(changes))
}

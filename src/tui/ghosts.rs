//! Where ghosts come from: files, states that the user freezes, and scenarios that run beside.

use std::path::Path;
use std::sync::Arc;

use super::beside::Beside;
use super::trend::Recorded;
use crate::export::state;
use crate::reading::Curves;
use crate::scenario::Scenario;
use crate::scenario::session::Session;
use crate::studies::ghost::Ghost;
use crate::studies::refinement;
use crate::traces::Table;

/// The most ghosts at once: each has a stroke of its own.
pub const MOST: usize = 4;

/// Curves beside the run.
#[derive(Debug, Clone)]
pub enum Source {
    /// They do not change.
    Still(Arc<Ghost>),
    /// They are those of another run at the same cycle.
    Run(GhostRun),
}

/// A scenario that runs beside, from its start to the present cycle.
#[derive(Debug, Clone)]
pub struct GhostRun {
    name: String,
    beside: Box<Beside>,
}

impl Source {
    /// What `given` names, which is to be shown over a contact that reaches as far as `reach`, m: a
    /// directory or a CSV file, or else a scenario.
    ///
    /// # Errors
    /// One line.
    pub fn load(given: &str, reach: f64) -> Result<Self, String> {
        let path = Path::new(given);
        let is_scenario = path
            .extension()
            .is_none_or(|end| end.eq_ignore_ascii_case("toml"));
        if is_scenario && !path.is_dir() {
            let scenario = Scenario::load(given, &[]).map_err(|error| error.to_string())?;
            let resolved = refinement::resolve_soon(&scenario);
            let resolved = resolved.map_err(|error| error.to_string())?;
            let start = Session::start(resolved.scenario).map_err(|error| error.to_string())?;
            return Ok(Self::Run(GhostRun {
                name: scenario.stem(),
                beside: Box::new(Beside::from_start(start)),
            }));
        }
        let ghost = Ghost::read(path).map_err(|error| error.to_string())?;
        let checked = ghost.check_radii(reach);
        checked.map_err(|refusal| refusal.to_string())?;
        Ok(Self::Still(Arc::new(ghost)))
    }

    /// The present state of a run.
    pub(super) fn frozen(run: &Recorded) -> Self {
        let name = format!("cycle {:.2}", run.cycle());
        Self::Still(Arc::new(ghost(&name, run, Curves::all())))
    }

    /// What legends call it.
    pub(super) fn name(&self) -> &str {
        match self {
            Self::Still(ghost) => &ghost.name,
            Self::Run(run) => &run.name,
        }
    }

    /// The run that follows, if it is one.
    pub(super) fn beside(&self) -> Option<&Beside> {
        match self {
            Self::Still(_) => None,
            Self::Run(run) => Some(&run.beside),
        }
    }

    /// The same, to be stepped.
    pub(super) fn beside_mut(&mut self) -> Option<&mut Beside> {
        match self {
            Self::Still(_) => None,
            Self::Run(run) => Some(&mut run.beside),
        }
    }

    /// Its curves, `curves` of them if they are computed for each frame.
    pub(super) fn seen(&self, curves: Curves) -> Arc<Ghost> {
        let GhostRun { name, beside } = match self {
            Self::Still(ghost) => return Arc::clone(ghost),
            Self::Run(run) => run,
        };
        let end = match beside.stopped {
            Some(_) => format!(" (ends at {:.2})", beside.run.cycle()),
            None => String::new(),
        };
        Arc::new(ghost(&format!("{name}{end}"), &beside.run, curves))
    }
}

fn ghost(name: &str, run: &Recorded, curves: Curves) -> Ghost {
    let seen = run.simulation().observe(curves);
    let mut ghost = Ghost::new(name);
    let columns = state::columns(&seen);
    ghost.tables.push(Table::of_columns(Vec::new(), columns));
    ghost.tables.push(run.trend.history());
    if seen.moment.stick_radius.is_some() {
        let last = run.trend.loops.last(seen.moment.cycle);
        ghost.take_loop(last.shifts, last.forces);
    }
    ghost
}

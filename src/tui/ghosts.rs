//! Where ghosts come from: files, states that the user freezes, and scenarios that run beside.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

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
    Run(Box<GhostRun>),
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
            return Ok(Self::Run(Box::new(GhostRun::start(&scenario)?)));
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

    /// Whether it is not yet where the run is.
    pub(super) fn lags(&self, cycle: f64) -> bool {
        match self {
            Self::Still(_) => false,
            Self::Run(run) => run.beside.lags(cycle) || run.is_ahead(cycle),
        }
    }

    /// Comes nearer to the run for about as long as `budget`.
    pub(super) fn follow_for(&mut self, cycle: f64, budget: Duration) {
        if let Self::Run(run) = self {
            run.follow_for(cycle, budget);
        }
    }

    /// Its curves, `curves` of them if they are computed for each frame.
    pub(super) fn seen(&self, curves: Curves) -> Arc<Ghost> {
        match self {
            Self::Still(ghost) => Arc::clone(ghost),
            Self::Run(run) => Arc::new(ghost(&run.shown_name(), &run.beside.run, curves)),
        }
    }
}

/// A scenario that runs beside, from its start to the present cycle.
#[derive(Debug, Clone)]
pub struct GhostRun {
    name: String,
    /// As it was before its first step: where it begins again when the screen goes back in time.
    start: Session,
    beside: Beside,
}

impl GhostRun {
    fn start(scenario: &Scenario) -> Result<Self, String> {
        let resolved = refinement::resolve_soon(scenario);
        let resolved = resolved.map_err(|error| error.to_string())?;
        let start = Session::start(resolved.scenario).map_err(|error| error.to_string())?;
        Ok(Self {
            name: scenario.stem(),
            beside: Beside::new(start.clone().into()),
            start,
        })
    }

    /// Whether the screen has gone back in time.
    fn is_ahead(&self, cycle: f64) -> bool {
        self.beside.run.cycle() > cycle + 1e-9
    }

    fn follow_for(&mut self, cycle: f64, budget: Duration) {
        if self.is_ahead(cycle) {
            self.beside = Beside::new(self.start.clone().into());
        }
        self.beside.follow(cycle, cycle, budget);
    }

    fn shown_name(&self) -> String {
        match self.beside.stopped {
            Some(_) => {
                let cycle = self.beside.run.cycle();
                format!("{} (ends at {cycle:.2})", self.name)
            }
            None => self.name.clone(),
        }
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

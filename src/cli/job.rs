//! What a run still has to do and what it has recorded. Checkpoints hold it next to the session, so that an interrupted
//! run writes the same files as an uninterrupted one.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail, ensure};
use serde::{Deserialize, Serialize};

use super::args::{CycleAsGiven, HistoryChoice, RunOptions, cycles};
use crate::export::history::History;
use crate::export::provenance::{self, Provenance};
use crate::reading::Errors;
use crate::scenario::session::Session;
use crate::scenario::{MOST_SNAPSHOTS, Refusal, Scenario};

/// Maximum number of rows in a history: a file of some 3 GB.
const MOST_ROWS: f64 = 1e7;

/// The job of a run and its progress.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RunJob {
    /// Identifies the run: the same for runs of the same scenario and options. See [`RunJob::identify`].
    pub id: String,
    /// Where the run ends, cycles.
    pub cycles: f64,
    /// Whether the history has one row per step instead of one per cycle.
    every_step: bool,
    /// Cycles at which the state is written, in increasing order, including those beyond the end.
    pub snapshots: Vec<CycleAsGiven>,
    /// The number of snapshots taken so far, or due before the run took over from the explorer.
    taken: usize,
    /// The rows so far.
    pub history: History,
    /// Whether the stresses inside the bodies are written at the end.
    pub field: bool,
    /// Whether the error of the result is estimated at the end.
    pub estimates: bool,
    /// The errors that its files state.
    pub errors: Errors,
    /// The folder of the run, for a checkpoint that does not lie in it.
    pub home: Option<PathBuf>,
}

impl RunJob {
    /// Makes the job that the options ask for.
    pub fn new(options: &RunOptions, scenario: &Scenario, name: &str) -> Result<Self> {
        let cycles = end(options.cycles.or(scenario.run().cycles), name)?;
        let snapshots = match &options.snapshot_at {
            Some(given) => {
                if let Some(late) = given.iter().find(|snapshot| snapshot.cycle() > cycles) {
                    let rule = format!("is after the end of the run, {cycles} cycles");
                    bail!(Refusal::new(format_args!("--snapshot-at {}", late.0), rule));
                }
                given.clone()
            }
            None => planned(scenario),
        };
        let history = History::with_columns(&options.column);
        Self {
            cycles,
            every_step: options.history == HistoryChoice::EveryStep,
            snapshots,
            field: options.field,
            estimates: options.estimate_error,
            history: history.map_err(|why| Refusal::new("--column", why))?,
            ..Self::default()
        }
        .ready(scenario)
    }

    /// Makes the job of a restored `session`: `kept` if the checkpoint comes from a run, or the scenario's plan with the
    /// rows so far if it comes from the explorer.
    pub fn resumed(
        kept: Option<Self>,
        session: &Session,
        cycles: Option<f64>,
        name: &str,
    ) -> Result<Self> {
        let now = session.simulation().cycle();
        let mut job = match kept {
            Some(job) if !job.id.is_empty() => job,
            explored => {
                let snapshots = planned(session.loaded());
                let planned_end = session.loaded().run().cycles.filter(|end| *end > now);
                Self {
                    cycles: end(cycles.or(planned_end), name)?,
                    taken: snapshots.iter().filter(|at| at.cycle() < now).count(),
                    snapshots,
                    ..explored.unwrap_or_default()
                }
                .identify(session.loaded())
            }
        };
        job.check().map_err(|why| Refusal::new(name, why))?;
        job.cycles = cycles.unwrap_or(job.cycles);
        let place = format!("--cycles {}", job.cycles);
        let rule = format!("the checkpoint is already at cycle {now}");
        ensure!(job.cycles >= now, Refusal::new(place, rule));
        job.ready(session.scenario())
    }

    /// Sorts the snapshots and refuses a history too large to store.
    fn ready(mut self, scenario: &Scenario) -> Result<Self> {
        self.snapshots
            .sort_by(|a, b| a.cycle().total_cmp(&b.cycle()));
        let count = self.snapshots.len();
        let rule = format!("{count} snapshots; the limit is {MOST_SNAPSHOTS}");
        ensure!(count <= MOST_SNAPSHOTS, Refusal::new("--snapshot-at", rule));
        let rows = self.cycles * scenario.setup().steps_in_a_cycle();
        let rule = format!("{rows:.1e} rows; the limit is {MOST_ROWS:e}");
        let hint = "reduce --cycles or numerics.steps_per_cycle";
        let refusal = Refusal::new("--history every-step", rule).or(hint);
        ensure!(!self.every_step || rows <= MOST_ROWS, refusal);
        Ok(self)
    }

    /// Sets the identity: runs that compute and record the same have the same identity, so that their files are equal.
    #[must_use]
    pub fn identify(mut self, scenario: &Scenario) -> Self {
        let mut sum = crc32fast::Hasher::new();
        sum.update(scenario.to_toml().as_bytes());
        let options = (self.cycles, self.every_step, &self.snapshots, &self.history);
        sum.update(format!("{options:?}").as_bytes());
        self.id = format!("{:08x}", sum.finalize());
        self
    }

    /// Checks a job read from a checkpoint.
    fn check(&self) -> Result<(), String> {
        cycles(&self.cycles.to_string())?;
        for snapshot in &self.snapshots {
            snapshot.0.parse::<CycleAsGiven>()?;
        }
        if self.taken > self.snapshots.len() {
            return Err("more snapshots are done than there are".into());
        }
        self.history.check()
    }

    /// Returns the next snapshot before `cycle`.
    pub fn next_snapshot(&self, cycle: f64) -> Option<&CycleAsGiven> {
        let next = self.snapshots.get(self.taken)?;
        (next.cycle() < cycle && next.cycle() <= self.cycles).then_some(next)
    }

    /// Marks the next snapshot as taken.
    pub fn snapshot_is_done(&mut self) {
        self.taken += 1;
    }

    /// Returns the names of the snapshots' files.
    pub fn snapshot_files(&self) -> impl Iterator<Item = String> {
        self.snapshots.iter().map(file_of)
    }

    /// Returns the identity of the run, and the names of the tables that it writes.
    pub fn provenance(&self) -> Provenance {
        let tables = ["history.csv", "state.csv", "loop.csv", provenance::FILE];
        let field = self.field.then_some("field.csv");
        let tables = tables.into_iter().chain(field).map(str::to_owned);
        Provenance {
            run: self.id.clone(),
            files: tables.chain(self.snapshot_files()).collect(),
        }
    }

    /// Returns the snapshots for the `scenario.toml`.
    pub fn snapshot_at(&self) -> Vec<f64> {
        self.snapshots.iter().map(CycleAsGiven::cycle).collect()
    }

    /// Records the present moment in the history if it is due.
    pub fn record(&mut self, session: &Session) {
        let simulation = session.simulation();
        if self.every_step
            || simulation.cycle().fract() == 0.0
            || simulation.cycle() >= self.cycles
            // A change ends a block, which gets its own row.
            || session.changes().last().is_some_and(|last| last.at_cycle == simulation.cycle())
            || self.history.is_empty()
        {
            self.history.record(session);
        }
    }

    /// Stores the folder of the run in checkpoints.
    pub fn set_home(&mut self, folder: &Path) {
        let real = folder.canonicalize().ok();
        // A checkpoint holds only text.
        self.home = real.filter(|home| home.to_str().is_some());
    }

    /// Returns to the progress that the job had when `earlier` was copied from it.
    pub fn rewind(&mut self, earlier: &Self) {
        self.taken = earlier.taken;
        self.history.rewind(&earlier.history);
    }
}

/// Returns the name of a snapshot's file.
pub fn file_of(snapshot: &CycleAsGiven) -> String {
    format!("state-{}.csv", snapshot.0)
}

/// Returns the end of a run, which must be given.
pub(super) fn end(cycles: Option<f64>, name: &str) -> Result<f64, Refusal> {
    cycles.ok_or_else(|| Refusal::new(name, "run.cycles is missing; give --cycles X"))
}

/// Returns the snapshots that the scenario itself asks for.
fn planned(scenario: &Scenario) -> Vec<CycleAsGiven> {
    let planned = scenario.run().snapshot_at.iter();
    planned.map(|at| CycleAsGiven(at.to_string())).collect()
}

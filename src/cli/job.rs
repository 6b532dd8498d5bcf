//! What a run still has to do and what it has recorded: beside the session, all that its checkpoint
//! holds, so that an interrupted run writes the same files as one that was not.

use std::io::{self, Write};
use std::path::Path;

use anyhow::Result;
use serde::{Deserialize, Serialize};

use super::Misuse;
use super::args::{CycleAsGiven, HistoryChoice, Run};
use crate::export::file::rows_in;
use crate::export::history::History;
use crate::scenario::session::Session;
use crate::scenario::{MOST_SNAPSHOTS, Scenario};

/// The most rows of a history: a file of some 3 GB.
const MOST_ROWS: f64 = 1e7;

/// The order that a run was given, and how far it has come.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RunJob {
    /// Where the run ends, cycles.
    pub cycles: f64,
    /// Whether the history has a row a step, or a row a cycle.
    every_step: bool,
    /// Cycles at which the state is written, in the order given, those beyond the end included.
    snapshots: Vec<CycleAsGiven>,
    /// Those of them that do not lie beyond the end, sorted by cycle.
    #[serde(skip)]
    due: Vec<CycleAsGiven>,
    /// How many of these have been dealt with.
    taken: usize,
    /// The rows so far.
    history: History,
    /// What the headers of the files state beside the numbers, such as the estimated error.
    #[serde(default)]
    pub statements: Vec<(String, String)>,
    /// The directory of the run's files, for a checkpoint that is kept elsewhere.
    #[serde(default)]
    home: Option<String>,
}

impl RunJob {
    /// What the options ask for on `scenario`.
    pub fn new(options: &Run, scenario: &Scenario, name: &str) -> Result<Self> {
        let cycles = end(options.cycles.or(scenario.run().cycles), name)?;
        let snapshots = match &options.snapshot_at {
            Some(given) => {
                if let Some(late) = given.iter().find(|snapshot| snapshot.cycle > cycles) {
                    let message = format!(
                        "--snapshot-at {}: lies beyond the end at {cycles} cycles",
                        late.spelling
                    );
                    return Err(Misuse(message).into());
                }
                given.clone()
            }
            None => planned(scenario),
        };
        Self {
            cycles,
            every_step: options.history == HistoryChoice::EveryStep,
            snapshots,
            due: Vec::new(),
            taken: 0,
            history: History::default(),
            statements: Vec::new(),
            home: None,
        }
        .ready(scenario)
    }

    /// What is left to do for a `session` that was put away: `kept` if a run did it, and what the
    /// scenario plans if the explorer did.
    pub fn resumed(
        kept: Option<Self>,
        session: &Session,
        cycles: Option<f64>,
        name: &str,
    ) -> Result<Self> {
        let now = session.simulation().cycle();
        let mut job = match kept {
            Some(job) => job,
            None => {
                let snapshots = planned(session.loaded());
                let planned_end = session.loaded().run().cycles.filter(|end| *end > now);
                Self {
                    cycles: end(cycles.or(planned_end), name)?,
                    every_step: false,
                    taken: snapshots.iter().filter(|at| at.cycle < now).count(),
                    due: Vec::new(),
                    snapshots,
                    history: History::default(),
                    statements: Vec::new(),
                    home: None,
                }
            }
        };
        job.cycles = cycles.unwrap_or(job.cycles);
        if job.cycles < now {
            let message = format!(
                "--cycles {}: the checkpoint stands at cycle {now} already",
                job.cycles
            );
            return Err(Misuse(message).into());
        }
        job.ready(session.scenario())
    }

    /// Sorts what is to be done, and refuses what no machine can hold.
    fn ready(mut self, scenario: &Scenario) -> Result<Self> {
        self.due = self.snapshots.clone();
        self.due.retain(|snapshot| snapshot.cycle <= self.cycles);
        self.due.sort_by(|a, b| a.cycle.total_cmp(&b.cycle));
        if self.due.len() > MOST_SNAPSHOTS {
            let message = format!(
                "--snapshot-at: {} snapshots; a run takes {MOST_SNAPSHOTS} or fewer",
                self.due.len()
            );
            return Err(Misuse(message).into());
        }
        let rows = self.cycles * scenario.setup().steps_in_a_cycle();
        if self.every_step && rows > MOST_ROWS {
            let message = format!(
                "--history every-step: {rows:.1e} rows; a history has {MOST_ROWS:e} or fewer: \
                 fewer --cycles or numerics.steps_per_cycle would do"
            );
            return Err(Misuse(message).into());
        }
        Ok(self)
    }

    /// The next snapshot that lies before `cycle`; it counts as dealt with.
    pub fn next_snapshot(&mut self, cycle: f64) -> Option<CycleAsGiven> {
        let next = self.due.get(self.taken)?;
        (next.cycle < cycle).then(|| {
            self.taken += 1;
            next.clone()
        })
    }

    /// Whether a snapshot is to be taken before `cycle`.
    pub fn has_snapshot_before(&self, cycle: f64) -> bool {
        let next = self.due.get(self.taken);
        next.is_some_and(|next| next.cycle < cycle)
    }

    /// The snapshots that were dealt with.
    pub fn taken(&self) -> Vec<CycleAsGiven> {
        self.due.iter().take(self.taken).cloned().collect()
    }

    /// The snapshots as `scenario.toml` is to name them.
    pub fn snapshot_at(&self) -> Vec<f64> {
        let all = self.snapshots.iter();
        all.map(|snapshot| snapshot.cycle).collect()
    }

    /// Takes the present moment into the history, if it is one of those that it records.
    pub fn record(&mut self, session: &Session) {
        let simulation = session.simulation();
        if self.every_step
            || simulation.cycle().fract() == 0.0
            || simulation.cycle() >= self.cycles
            // What changes ends a block, which is to have a row of its own.
            || session.changes().last().is_some_and(|last| last.at_cycle == simulation.cycle())
            || self.history.is_empty()
        {
            self.history.record(session);
        }
    }

    /// Puts rows into the file at `path` when there are enough of them.
    pub fn spill(&mut self, path: &Path) -> io::Result<()> {
        if self.history.is_due() {
            self.history.spill(path)?;
        }
        Ok(())
    }

    /// Writes `history.csv`, up to the present moment.
    pub fn write_history(
        &self,
        session: &Session,
        rows: &Path,
        out: &mut impl Write,
    ) -> io::Result<()> {
        self.history.write(session, rows, out)
    }

    /// Goes on with the files in the directory `to`, which the rows of the history are brought to.
    ///
    /// # Errors
    ///
    /// If they are not all there; the history then begins at the present moment.
    pub fn settle_in(&mut self, from: Option<&Path>, to: &Path) -> io::Result<()> {
        let real = |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_owned());
        let (from, to) = (real(from.unwrap_or(Path::new("."))), real(to));
        self.live_in(&to);
        self.history.move_rows(&rows_in(&from), &rows_in(&to))
    }

    /// Has checkpoints tell where the files of the run are.
    pub fn live_in(&mut self, directory: &Path) {
        let real = directory.canonicalize().ok();
        self.home = real.and_then(|home| home.to_str().map(str::to_owned));
    }

    /// The directory of the run's files when it was put away.
    pub fn home(&self) -> Option<&Path> {
        self.home.as_deref().map(Path::new)
    }

    /// Goes back to how far the job had come when `earlier` was copied from it.
    pub fn rewind(&mut self, earlier: &Self) {
        self.taken = earlier.taken;
        self.history.rewind(earlier.history.mark());
    }
}

/// The end of a run, which must be known.
pub(super) fn end(cycles: Option<f64>, name: &str) -> Result<f64, Misuse> {
    cycles.ok_or_else(|| {
        Misuse(format!(
            "{name}: has no run.cycles; say how many with --cycles X"
        ))
    })
}

/// The snapshots that the scenario itself asks for.
fn planned(scenario: &Scenario) -> Vec<CycleAsGiven> {
    let planned = scenario.run().snapshot_at.iter();
    planned
        .map(|&cycle| CycleAsGiven {
            cycle,
            spelling: cycle.to_string(),
        })
        .collect()
}

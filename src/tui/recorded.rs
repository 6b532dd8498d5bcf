//! A run in the explorer with its past, cycle by cycle; older cycles are kept ever more coarsely.

use std::sync::Arc;

use serde::Serialize;

use super::loops::Loops;
use crate::charts::{ALL, Run, history_columns};
use crate::export::autosave::Work;
use crate::export::history::History;
use crate::reading::{Column, Observation, Recorder, Table};
use crate::scenario::checkpoint;
use crate::scenario::scalars::Reading;
use crate::scenario::session::{Session, SessionError};
use crate::simulation::Simulation;

/// Maximum number of recorded rows.
const MOST: usize = 2048;

/// A run with its past.
#[derive(Debug, Clone)]
pub struct Recorded {
    /// The run.
    pub session: Session,
    /// Its past: the columns of `history.csv`, then what charts need besides.
    pub past: Recorder,
    /// The fretting loops.
    pub loops: Loops,
    /// The time per step for new rows, s.
    pub step_cost: Option<f64>,
}

impl From<Session> for Recorded {
    /// Begins the record with the present moment.
    fn from(session: Session) -> Self {
        let start = session.simulation().cycle().floor();
        let mut run = Self::unrecorded(session, start);
        run.record();
        run
    }
}

/// What a run without a screen takes over from the explorer besides the session.
#[derive(Serialize)]
struct Explored {
    history: History,
}

impl Work for Recorded {
    fn session(&self) -> &Session {
        &self.session
    }

    fn checkpoint(&self) -> Vec<u8> {
        let history = History::of_cycles(&self.past, self.cycle());
        checkpoint::encode(&self.session, Some(&Explored { history }))
    }
}

impl Recorded {
    /// A run whose record, still empty, begins at the cycle `start`.
    pub(super) fn unrecorded(session: Session, start: f64) -> Self {
        let mut further = history_columns(ALL.iter().copied());
        further.retain(|column| !Column::HISTORY.contains(column));
        let columns = Column::HISTORY.into_iter().chain(further);
        Self {
            session,
            past: Recorder::of_cycles(columns, start, MOST),
            loops: Loops::default(),
            step_cost: None,
        }
    }

    /// Restores the past from the tables of its files: the history, whose cycles after the present are left out, and the
    /// last loop.
    pub(super) fn with_past(session: Session, history: &Table, last_loop: &Table) -> Self {
        let now = session.simulation().cycle();
        let mut run = Self::unrecorded(session, 0.0);
        run.past.record_table(history, now);
        run.loops.restore(last_loop);
        run
    }

    /// The simulation.
    pub fn simulation(&self) -> &Simulation {
        self.session.simulation()
    }

    /// Returns the present cycle.
    pub fn cycle(&self) -> f64 {
        self.simulation().cycle()
    }

    /// Returns the data for charts: `seen` at the present moment, and the past.
    pub fn charted(&self, seen: &Observation) -> Run {
        let moves = seen.moment.stick_radius.is_some();
        let needed = history_columns(ALL.iter().copied());
        Run {
            states: vec![Arc::clone(&seen.columns)],
            history: Some(self.past.table(&needed).into()),
            loops: self.loops.last().filter(|_| moves).into_iter().collect(),
            geometry: seen.geometry,
            ..Run::default()
        }
    }

    /// Returns the history with the columns of a run's `history.csv`, up to and including the present moment. As on the
    /// screen, contact radii and stick radii are the largest and the smallest of each cycle.
    pub(super) fn history(&self) -> Table {
        let mut past = self.past.clone();
        past.close(self.reader(&Reading::new(&self.session)));
        past.table(&Column::HISTORY)
    }

    /// Takes and records one step or jump, at most to `goal`.
    ///
    /// # Errors
    /// The error that stops the run.
    pub fn step_until(&mut self, goal: f64) -> Result<(), SessionError> {
        self.session.step_until(goal)?;
        self.record();
        Ok(())
    }

    /// Records the present moment.
    fn record(&mut self) {
        let reading = Reading::new(&self.session);
        let read = |column| reading.number(column);
        self.loops.record(self.session.simulation(), read);
        let mut past = std::mem::take(&mut self.past);
        past.record(self.reader(&reading));
        self.past = past;
    }

    /// Returns the reader of columns of the present moment.
    fn reader(&self, reading: &Reading) -> impl Fn(Column) -> f64 {
        // A jump knows only the stick radius of its last cycle; of the steps of a cycle, the smallest one is kept.
        let stick = match self.simulation().has_jumped() {
            true => Column::PermanentStickRadius,
            false => Column::StickRadius,
        };
        let cost = self.step_cost.unwrap_or(f64::NAN);
        move |column| match column {
            Column::PermanentStickRadius => reading.number(stick),
            Column::StepCost => cost,
            column => reading.number(column),
        }
    }
}

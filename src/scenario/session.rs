//! A run under way: a scenario, its simulation, and the changes made to it.
//!
//! The explorer and the headless commands both drive this, so the same scenario and the same
//! changes give the same bits.

use std::mem::replace;

use thiserror::Error;

use super::change::{Change, MOST_CHANGES, Planned, parsed};
use super::key::Key;
use super::value::Value;
use super::{Refusal, RunPlan, Scenario, Spec, written};
use crate::reading::{Check, CycleFigures, Errors, Log};
use crate::simulation::{Breakdown, Domain, Simulation};

/// Why a session could not start, change or continue.
#[derive(Debug, Error)]
pub enum SessionError {
    /// A refused value.
    #[error(transparent)]
    Scenario(#[from] Refusal),
    /// A contact that cannot continue.
    #[error(transparent)]
    Breakdown(#[from] Breakdown),
    /// An accuracy for which no resolution has been chosen yet.
    #[error(
        "numerics.accuracy = {0:e}: points and steps that meet it must be found before the run; \
         give numerics.points and numerics.steps_per_cycle instead"
    )]
    Unresolved(f64),
    /// A search for an accuracy in which no level finished, and why the last one stopped.
    #[error("no refinement level finished; the last one: {0}")]
    Unfinished(String),
    /// The caller stopped it.
    #[error("interrupted")]
    Interrupted,
}

/// A scenario being run.
#[derive(Debug, Clone)]
pub struct Session {
    /// As loaded, without the changes.
    pub(super) loaded: Scenario,
    pub(super) now: SessionState,
    pub(super) changes: Vec<Change>,
    pub(super) pending: Vec<Change>,
    /// Cycles at which steps were cut short so far.
    pub(super) goals: Vec<f64>,
    /// The run before the changes of the current cycle, which are made together: each further change restarts from
    /// there, with the earlier ones.
    pub(super) unchanged: Option<Box<Unchanged>>,
    /// The errors that its files state.
    pub(super) errors: Errors,
}

/// A moment of a run.
#[derive(Debug, Clone)]
pub(super) struct SessionState {
    /// With the changes so far.
    pub(super) scenario: Scenario,
    pub(super) simulation: Simulation,
    /// Notes on the run.
    pub(super) log: Log,
}

/// A run before the changes of a cycle.
#[derive(Debug, Clone)]
pub(super) struct Unchanged {
    pub(super) state: SessionState,
    /// The number of changes so far.
    pub(super) changes: usize,
}

impl Session {
    /// Starts `scenario` from the unworn contact, or from its scar. Recorded changes are made again at their cycles.
    ///
    /// # Errors
    ///
    /// If the contact cannot be made, or if no points and steps have been found yet for `numerics.accuracy`: see
    /// [`refinement`](crate::studies::refinement).
    pub fn start(scenario: Scenario) -> Result<Self, SessionError> {
        if let Some(accuracy) = scenario.accuracy() {
            return Err(SessionError::Unresolved(accuracy));
        }
        let simulation = Simulation::new(scenario.setup().clone())?;
        let mut session = Self {
            now: SessionState {
                scenario: scenario.clone(),
                log: Log::new(&simulation),
                simulation,
            },
            changes: Vec::new(),
            pending: scenario.changes().to_vec(),
            loaded: scenario,
            unchanged: None,
            errors: Errors::default(),
            goals: Vec::new(),
        };
        session.make_due_changes()?;
        Ok(session)
    }

    /// Returns the current scenario, including changes.
    pub fn scenario(&self) -> &Scenario {
        &self.now.scenario
    }

    /// Returns the scenario as loaded, ready to start again.
    pub fn loaded(&self) -> &Scenario {
        &self.loaded
    }

    /// The simulation.
    pub fn simulation(&self) -> &Simulation {
        &self.now.simulation
    }

    /// Returns the notes on the run.
    pub fn log(&self) -> &Log {
        &self.now.log
    }

    /// Returns the [figures](Log::cycle_figures) of the last complete period of the motion.
    pub fn cycle_figures(&self) -> Option<CycleFigures> {
        self.now.log.cycle_figures(&self.now.simulation)
    }

    /// Returns all checks available at the present moment.
    pub fn checks(&self) -> Vec<Check> {
        self.now.simulation.checks(&self.now.log)
    }

    /// Returns a line for each way in which the run lies outside the theory, or beyond what any grid resolves, and for
    /// what was left out of its files.
    pub fn warnings(&self) -> Vec<String> {
        let notes = self.loaded.notes().iter().cloned();
        notes
            .chain(self.now.simulation.warnings(&self.now.log))
            .collect()
    }

    /// Returns the changes made so far, in order.
    pub fn changes(&self) -> &[Change] {
        &self.changes
    }

    /// Takes one step or jump, which ends at `cycle` or the next recorded change at the latest; then makes the changes
    /// that are due.
    pub fn step_until(&mut self, cycle: f64) -> Result<(), SessionError> {
        let change = self.pending.first().map(|change| change.at_cycle);
        // A scenario that records a run tells where its steps were cut short.
        let now = self.now.simulation.cycle();
        let recorded = self.loaded.run().shortened_at.iter().copied();
        let stops = recorded.filter(|&stop| stop > now).chain(change);
        let goal = stops.fold(cycle, f64::min);
        self.now.simulation.step_until(goal)?;
        self.now.log.follow(&self.now.simulation);
        if self.unchanged().is_none() {
            self.unchanged = None;
        }
        // A step cut short for a recorded change need not be recorded again.
        let is_new = !self.goals.contains(&goal);
        if self.now.simulation.was_shortened() && is_new && change != Some(goal) {
            self.goals.push(goal);
        }
        self.make_due_changes()
    }

    /// Returns the goal of the steps in a run that ends at the cycle `end`. It lies further on if the scenario records
    /// a run that was stopped on its way there, since its jumps were made with that goal.
    pub fn heading(&self, end: f64) -> f64 {
        let plan = self.loaded.run();
        let beyond = plan.shortened_at.iter().copied().filter(|&goal| goal > end);
        match plan.cycles {
            Some(cycles) if cycles == end => beyond.reduce(f64::min).unwrap_or(end),
            _ => end,
        }
    }

    /// Steps to `cycle` exactly, making recorded changes on the way.
    pub fn advance_to(&mut self, cycle: f64) -> Result<(), SessionError> {
        self.advance_while(cycle, |_| true)
    }

    /// Runs [`advance_to`](Self::advance_to) while `go_on`, called before each step and at the end, returns true.
    ///
    /// # Errors
    ///
    /// [`SessionError::Interrupted`] if it returned false before `cycle`, or the error that stops the run.
    pub fn advance_while(
        &mut self,
        cycle: f64,
        go_on: impl FnMut(&Self) -> bool,
    ) -> Result<(), SessionError> {
        self.advance_towards(cycle, cycle, go_on)
    }

    /// Runs [`advance_while`](Self::advance_while) with steps and jumps towards `goal`, at `cycle` or beyond it.
    ///
    /// # Errors
    ///
    /// As for [`advance_while`](Self::advance_while).
    pub fn advance_towards(
        &mut self,
        goal: f64,
        cycle: f64,
        mut go_on: impl FnMut(&Self) -> bool,
    ) -> Result<(), SessionError> {
        loop {
            let goes_on = go_on(self);
            if self.now.simulation.cycle() >= cycle {
                return Ok(());
            }
            if !goes_on {
                return Err(SessionError::Interrupted);
            }
            self.step_until(goal)?;
        }
    }

    /// Changes values of the scenario now, carrying the state over; what differs is recorded, and returned.
    ///
    /// # Errors
    ///
    /// If a value is refused, the contact cannot be solved, or wear would be lost; nothing has changed then.
    pub fn edit(
        &mut self,
        edit: impl FnOnce(&mut Spec),
    ) -> Result<Vec<(Key, Value)>, SessionError> {
        let before = self.now.scenario.spec();
        let mut after = before.clone();
        edit(&mut after);
        let edits = before.diff(&after);
        let at_cycle = self.now.simulation.cycle();
        let changes = edits.iter().cloned();
        let changes = changes.map(|(key, value)| Change {
            at_cycle,
            key,
            value,
        });
        self.make(changes.collect())?;
        Ok(edits)
    }

    /// Assigns keys that change together, such as a control and its force, by the rules of `--set`; carries the state
    /// over, and records them.
    ///
    /// # Errors
    ///
    /// As [`edit`](Self::edit), and for unknown keys.
    pub fn assign(
        &mut self,
        assignments: &[(impl AsRef<str>, impl AsRef<str>)],
    ) -> Result<(), SessionError> {
        let at_cycle = self.now.simulation.cycle();
        let planned = assignments.iter().map(|(key, text)| {
            let (key, text) = (key.as_ref().trim(), text.as_ref().trim());
            Planned::new(at_cycle, key, |key| parsed(key, text), written(key, text))
        });
        let planned = planned.collect::<Result<Vec<_>, _>>()?;
        let changes = self.now.scenario.read_changes(&planned)?;
        self.make_called(changes, planned.into_iter().map(|of| of.place).collect())
    }

    /// Makes changes now, and records them.
    ///
    /// # Errors
    ///
    /// As [`edit`](Self::edit).
    pub fn make(&mut self, changes: Vec<Change>) -> Result<(), SessionError> {
        let places = changes.iter().map(Change::to_string).collect();
        self.make_called(changes, places)
    }

    /// Makes changes together with those already made at this cycle; messages call each by its place.
    fn make_called(
        &mut self,
        new: Vec<Change>,
        mut places: Vec<String>,
    ) -> Result<(), SessionError> {
        let (before, made) = match self.unchanged() {
            Some(before) => (&before.state, before.changes),
            None => (&self.now, self.changes.len()),
        };
        let changes = [self.changes.clone(), new].concat();
        if changes.len() > MOST_CHANGES {
            let rule = format!("a run takes at most {MOST_CHANGES} changes");
            return Err(Refusal::new(places.pop().unwrap_or_default(), rule).into());
        }
        let earlier = self.changes[made..].iter().map(Change::to_string);
        let places: Vec<String> = earlier.chain(places).collect();
        let scenario = before.scenario.changed(&changes[made..], &places)?;
        let (mut simulation, mut log) = (before.simulation.clone(), before.log.clone());
        // If no key changes the domain, it may have grown.
        let radius = |scenario: &Scenario| scenario.setup().grid.radius();
        let domain = if radius(&scenario) == radius(&before.scenario) {
            Domain::Derived
        } else {
            scenario.domain()
        };
        simulation.reconfigure(scenario.setup().clone(), domain)?;
        log.restart(&simulation);
        let changed = SessionState {
            scenario,
            simulation,
            log,
        };
        let is_first = self.unchanged().is_none();
        let state = replace(&mut self.now, changed);
        if is_first {
            let changes = made;
            self.unchanged = Some(Box::new(Unchanged { state, changes }));
        }
        self.changes = changes;
        Ok(())
    }

    /// Returns the run before the changes of the current cycle, if there are any.
    pub(super) fn unchanged(&self) -> Option<&Unchanged> {
        let before = self.unchanged.as_deref()?;
        (before.state.simulation.cycle() == self.simulation().cycle()).then_some(before)
    }

    /// Sets the errors that the run's files state.
    pub fn state(&mut self, errors: Errors) {
        self.errors = errors;
    }

    /// Returns the errors that its files state.
    pub fn errors(&self) -> &Errors {
        &self.errors
    }

    /// Returns the same run with a remark for its files.
    #[must_use]
    pub fn noted(&self, note: &str) -> Self {
        let mut noted = self.clone();
        noted.loaded.spec.run.note = Some(note.to_owned());
        noted
    }

    /// Returns the run so far as a scenario: as loaded, with each change, up to the present cycle.
    pub fn as_run(&self, snapshot_at: Vec<f64>) -> Scenario {
        let end = self.now.simulation.cycle();
        // The end of the run cuts a step short anyway.
        let goals = self.goals.iter().copied().filter(|&goal| goal != end);
        let plan = RunPlan {
            cycles: Some(end),
            snapshot_at,
            shortened_at: goals.collect(),
            note: self.loaded.run().note.clone(),
            ..RunPlan::default()
        };
        self.loaded
            .with_changes(self.changes.clone())
            .with_run(plan)
            .stating(&self.errors)
    }

    /// Makes the recorded changes whose cycle has come. Changes of one cycle are made together: a force and its control
    /// would be wrong one after the other.
    fn make_due_changes(&mut self) -> Result<(), SessionError> {
        let now = self.now.simulation.cycle();
        let pending = self.pending.iter();
        match pending.take_while(|change| change.at_cycle <= now).count() {
            0 => Ok(()),
            due => {
                let changes = self.pending.drain(..due).collect();
                self.make(changes)
            }
        }
    }
}

//! A run under way: a scenario, its simulation, and the changes made to it.
//!
//! The explorer and the headless commands both drive this, so the same scenario and the same
//! changes give the same bits.

use std::borrow::Cow;
use std::collections::VecDeque;

use thiserror::Error;

use super::{Change, RunPlan, Scenario, ScenarioError, accuracy};
use crate::simulation::{Breakdown, Saved, Simulation, Unfit};

/// Why a session could not start, change or go on.
#[derive(Debug, Error)]
pub enum SessionError {
    /// A value that is refused.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// A contact that cannot go on.
    #[error(transparent)]
    Breakdown(#[from] Breakdown),
}

/// A saved run that cannot be taken up.
#[derive(Debug, Error)]
pub enum RestoreError {
    /// A change in it that is refused.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// A state that is none of its scenario's.
    #[error(transparent)]
    Unfit(#[from] Unfit),
}

/// All that a session is made of.
pub(super) struct Parts<'a> {
    pub loaded: Cow<'a, Scenario>,
    pub changes: Cow<'a, [Change]>,
    pub pending: Vec<Change>,
    pub saved: Saved,
}

/// A scenario being run.
#[derive(Debug, Clone)]
pub struct Session {
    /// As it was loaded, without the changes.
    loaded: Scenario,
    /// As it is now, with the changes made so far.
    scenario: Scenario,
    simulation: Simulation,
    changes: Vec<Change>,
    pending: VecDeque<Change>,
}

impl Session {
    /// Starts `scenario` from the unworn contact. Changes it has recorded are made again when their
    /// cycle comes.
    pub fn start(scenario: Scenario) -> Result<Self, SessionError> {
        let simulation = Simulation::new(scenario.setup().clone())?;
        let mut pending: Vec<Change> = scenario.changes().to_vec();
        pending.sort_by(|a, b| a.at_cycle.total_cmp(&b.at_cycle));
        let mut session = Self {
            scenario: scenario.clone(),
            loaded: scenario,
            simulation,
            changes: Vec::new(),
            pending: pending.into(),
        };
        session.make_due_changes()?;
        Ok(session)
    }

    /// What there is to be put away.
    pub(super) fn parts(&self) -> Parts<'_> {
        Parts {
            loaded: Cow::Borrowed(&self.loaded),
            changes: Cow::Borrowed(&self.changes),
            pending: self.pending.iter().cloned().collect(),
            saved: self.simulation.save(),
        }
    }

    /// Goes on where a session was put away.
    pub(super) fn restore(parts: Parts) -> Result<Self, RestoreError> {
        let loaded = parts.loaded.into_owned();
        let mut scenario = loaded.clone();
        for change in parts.changes.iter() {
            scenario = scenario.after(change)?;
        }
        let simulation = Simulation::restore(scenario.setup().clone(), parts.saved)?;
        Ok(Self {
            loaded,
            scenario,
            simulation,
            changes: parts.changes.into_owned(),
            pending: parts.pending.into(),
        })
    }

    /// The scenario as it is now, changes included.
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// The scenario as it was loaded, ready to start again.
    pub fn loaded(&self) -> &Scenario {
        &self.loaded
    }

    /// The simulation.
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// The changes made so far, in order.
    pub fn changes(&self) -> &[Change] {
        &self.changes
    }

    /// One step or jump, then the changes that are due.
    pub fn step(&mut self) -> Result<(), SessionError> {
        self.step_until(f64::INFINITY)
    }

    /// One step or jump that ends at `cycle` at the latest, and where the next recorded change is to be
    /// made; then the changes that are due.
    pub fn step_until(&mut self, cycle: f64) -> Result<(), SessionError> {
        let change = self.pending.front().map(|change| change.at_cycle);
        let end = change.map_or(cycle, |at| cycle.min(at));
        self.simulation.step_until(end)?;
        self.make_due_changes()
    }

    /// Steps to `cycle` exactly, making recorded changes on the way.
    pub fn advance_to(&mut self, cycle: f64) -> Result<(), SessionError> {
        while self.simulation.cycle() < cycle {
            self.step_until(cycle)?;
        }
        Ok(())
    }

    /// Changes one key of the scenario now, carrying the state over, and records it.
    /// On an error nothing has changed.
    pub fn change(&mut self, key: &str, value: &str) -> Result<(), SessionError> {
        self.make(Change::new(self.simulation.cycle(), key, value))
    }

    fn make(&mut self, change: Change) -> Result<(), SessionError> {
        let scenario = self.scenario.after(&change)?;
        self.simulation.reconfigure(scenario.setup().clone())?;
        self.scenario = scenario;
        self.changes.push(change);
        Ok(())
    }

    /// The same run with a remark that its files carry.
    #[must_use]
    pub fn noted(&self, note: &str) -> Self {
        let run = RunPlan {
            note: Some(note.to_owned()),
            ..self.loaded.run().clone()
        };
        Self {
            loaded: self.loaded.with_run(run),
            ..self.clone()
        }
    }

    /// The run so far as a scenario of its own: what was loaded, each change, and where it stands.
    pub fn as_run(&self, snapshot_at: Vec<f64>) -> Scenario {
        let loaded = self.loaded.run();
        // What an accuracy chooses depends on the length of the run.
        let by_accuracy = |change: &Change| change.key() == "numerics.accuracy";
        let chosen = self.loaded.value("numerics.accuracy").is_some()
            || self.changes.iter().any(by_accuracy);
        let plan = RunPlan {
            cycles: Some(self.simulation.cycle()),
            snapshot_at,
            planned: chosen.then(|| accuracy::planned(loaded)),
            note: loaded.note.clone(),
        };
        self.loaded
            .with_changes(self.changes.clone())
            .with_run(plan)
    }

    fn make_due_changes(&mut self) -> Result<(), SessionError> {
        let due = |change: &Change, cycle| change.at_cycle <= cycle;
        while self
            .pending
            .front()
            .is_some_and(|change| due(change, self.simulation.cycle()))
        {
            if let Some(change) = self.pending.pop_front() {
                self.make(change)?;
            }
        }
        Ok(())
    }
}

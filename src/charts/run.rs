//! The data of a run, from its files or from memory.

use std::sync::Arc;

use crate::contact::indenter::Indenter;
use crate::math::geometry::Geometry;
use crate::reading::Column;
use crate::scenario::Scenario;
use crate::studies::ghost::Ghost;
use crate::studies::theory::Theory;
use crate::traces::{Loop, Table};

/// The data of a run: over the radius, over cycles, over one cycle, and data of other sources to compare with.
#[derive(Debug, Clone, Default)]
pub struct Run {
    /// The states, in the order of their cycles.
    pub states: Vec<Arc<Table>>,
    /// The history.
    pub history: Option<Arc<Table>>,
    /// Loops of single cycles.
    pub loops: Vec<Loop>,
    /// Curves of other sources.
    pub ghosts: Vec<Arc<Ghost>>,
    /// The stresses inside the half-space.
    pub field: Option<Table>,
    /// The closed forms for the scenario.
    pub theory: Option<Arc<Theory>>,
    /// The unworn shape.
    pub indenter: Option<Indenter>,
    /// Whether the contact is round or a line.
    pub geometry: Geometry,
}

impl Run {
    /// Adds what follows from the scenario.
    #[must_use]
    pub fn with_scenario(self, scenario: &Scenario) -> Self {
        let setup = scenario.setup();
        Self {
            theory: Some(Arc::new(Theory::new(setup))),
            indenter: Some(setup.indenter.clone()),
            geometry: setup.geometry,
            ..self
        }
    }

    /// Adds a table, recognised by its columns; refuses a table that is not from a run.
    pub fn add_table(&mut self, table: Table) -> Result<(), String> {
        if table.has(&[Column::Radius, Column::Profile]) {
            self.states.push(table.into());
            self.states.sort_by(|a, b| a.cycle().total_cmp(&b.cycle()));
            self.states.dedup_by(|a, b| a.cycle() == b.cycle());
        } else if table.has(&[Column::Cycle, Column::ContactRadius, Column::WearVolume]) {
            self.history = Some(table.into());
        } else if let Some(one) = Loop::from_table(&table, None) {
            self.loops.push(one);
        } else if table.has(&[Column::X, Column::Z, Column::VonMises]) {
            self.field = Some(table);
        } else {
            return Err("does not have the columns of a state, a history or a field".into());
        }
        Ok(())
    }

    /// Returns the loop of the cycle that ends at `end`, from its table or from a history of every step.
    pub fn loop_at(&self, end: f64) -> Option<Loop> {
        let mut alone = self.loops.iter();
        let alone = alone.find(|one| (one.end - end).abs() < 1e-9).cloned();
        let recorded = || Loop::from_table(self.history.as_deref()?, Some(end));
        alone.or_else(recorded)
    }

    /// Returns this run's data as an overlay for another run's charts.
    pub fn ghost(&self, name: &str) -> Ghost {
        let mut ghost = Ghost::new(name);
        ghost
            .tables
            .extend(self.states.last().into_iter().chain(&self.history).cloned());
        if let Some(one) = self.end().and_then(|end| self.loop_at(end)) {
            ghost.add_loop(one.shifts, one.forces);
        }
        ghost
    }

    /// The radius of the outermost node, m; 0 without a state.
    pub fn edge(&self) -> f64 {
        let radii = self
            .states
            .last()
            .and_then(|state| state.column(Column::Radius));
        radii.and_then(<[f64]>::last).copied().unwrap_or(0.0)
    }

    /// Returns f₀ at a radius, m; NaN if the shape is unknown.
    pub fn unworn(&self, r: f64) -> f64 {
        let indenter = self.indenter.as_ref();
        indenter.map_or(f64::NAN, |indenter| indenter.profile(r))
    }

    /// Returns the last cycle that any of the data reach.
    pub fn end(&self) -> Option<f64> {
        let recorded = self.history.as_deref().and_then(Table::last_cycle);
        let states = self.states.iter().map(|state| state.cycle());
        let loops = self.loops.iter().map(|one| one.end);
        states.chain(loops).chain(recorded).reduce(f64::max)
    }

    /// Returns the data for a caption.
    pub fn facts(&self) -> Vec<(String, String)> {
        let last = self.states.last().or(self.history.as_ref());
        let Some(last) = last.map(Arc::as_ref).or(self.field.as_ref()) else {
            return Vec::new();
        };
        let known = [
            "scenario",
            "method",
            "law",
            "points",
            "grid",
            "scheme",
            "steps_per_cycle",
            Column::WornDepthError.name(),
            Column::VolumeError.name(),
            Column::ForceError.name(),
            "checks",
        ];
        let mut facts: Vec<(String, String)> = known
            .into_iter()
            .filter_map(|key| Some((key.to_owned(), last.fact(key)?.to_owned())))
            .collect();
        let cycles = self.states.iter().map(|state| state.cycle().to_string());
        let cycles: Vec<String> = cycles.collect();
        if !cycles.is_empty() {
            facts.push(("cycles".into(), cycles.join(", ")));
        }
        facts
    }
}

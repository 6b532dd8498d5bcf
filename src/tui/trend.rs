//! The explorer's record of a run, cycle by cycle; older cycles are kept ever more coarsely.

use std::array::from_fn;
use std::sync::Arc;

use super::loops::Loops;
use crate::charts::Run;
use crate::export::history;
use crate::math::scan::largest;
use crate::reading::{Column, Moment, Observation};
use crate::scenario::scalars::{Reading, scar_radius};
use crate::scenario::session::{Session, SessionError};
use crate::simulation::Simulation;
use crate::traces::Table;

/// A run with its past.
#[derive(Debug, Clone)]
pub struct Recorded {
    /// The run.
    pub session: Session,
    /// Its past.
    pub trend: Trend,
}

impl From<Session> for Recorded {
    /// Begins the record with the present moment.
    fn from(session: Session) -> Self {
        let mut trend = Trend::default();
        trend.record(&session);
        Self { session, trend }
    }
}

impl Recorded {
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
        let moment = &seen.moment;
        let moves = moment.stick_radius.is_some();
        let last = moves.then(|| self.trend.loops.last(moment.cycle));
        Run {
            states: vec![Arc::clone(&seen.columns)],
            history: Some(self.trend.history()),
            loops: last.into_iter().collect(),
            geometry: seen.geometry,
            ..Run::default()
        }
    }

    /// Takes and records one step or jump, at most to `goal`.
    ///
    /// # Errors
    /// The error that stops the run.
    pub fn step_until(&mut self, goal: f64) -> Result<(), SessionError> {
        self.session.step_until(goal)?;
        self.trend.record(&self.session);
        Ok(())
    }
}

/// Maximum number of cycles stored individually; then neighbours are merged in pairs.
const CAPACITY: usize = 2048;

/// Merges a value of two cycles; extremes survive.
type Merge = fn(f64, f64) -> f64;

const LAST: Merge = |_, later| later;

/// The columns of a history, by their names in `history.csv` where they are there.
pub const COLUMNS: [(Column, Merge); 11] = [
    (Column::Cycle, LAST),
    (Column::ContactRadius, f64::max),
    (Column::PermanentStickRadius, f64::min),
    (Column::WearVolume, LAST),
    (Column::ScarDepth, LAST),
    (Column::ScarRadius, LAST),
    (Column::DissipatedEnergy, LAST),
    (Column::EnergyResidual, LAST),
    (Column::StepCost, f64::max),
    // Of the last whole cycle.
    (Column::ShiftAmplitude, LAST),
    (Column::MeanNormalForce, LAST),
];

const VOLUME: usize = 3;
const AMPLITUDE: usize = 9;
const LOAD: usize = 10;

/// One cycle, or several merged ones; NaN for unknown values.
#[derive(Debug, Clone, PartialEq)]
pub struct Cycle {
    /// Its values, in the order of the [`COLUMNS`].
    pub values: [f64; COLUMNS.len()],
    /// The fields of its end in `history.csv`; `None` while it is incomplete.
    pub fields: Option<Arc<[String]>>,
}

impl Cycle {
    /// Returns its end.
    pub fn end(&self) -> f64 {
        self.values[0]
    }

    fn merged(&self, later: &Self) -> Self {
        Self {
            values: from_fn(|k| (COLUMNS[k].1)(self.values[k], later.values[k])),
            fields: later.fields.clone(),
        }
    }
}

/// The past of a run. Copies share the cycles.
#[derive(Debug, Clone, Default)]
pub struct Trend {
    cycles: Vec<Arc<Cycle>>,
    /// The incomplete cycle.
    open: Option<Arc<Cycle>>,
    /// Number of cycles per entry.
    stride: f64,
    /// The time per step for new entries, s.
    pub step_cost: Option<f64>,
    /// Cycle and worn volume (m³) at the first moment.
    start: Option<[f64; 2]>,
    /// The fretting loops.
    pub loops: Loops,
}

impl Trend {
    /// Restores a past from `cycles`, oldest first, and the [steps](Loops::steps) of the last one. The run began with a
    /// worn volume `initial` (m³).
    pub fn of_past(
        cycles: impl Iterator<Item = Cycle>,
        steps: impl Iterator<Item = [f64; 4]>,
        initial: f64,
    ) -> Self {
        let mut cycles: Vec<_> = cycles.take(CAPACITY - 1).map(Arc::new).collect();
        // An incomplete last cycle stays open.
        let whole = cycles.iter().rev().nth(1).map_or(0.0, |entry| entry.end());
        let is_open = |last: &mut Arc<Cycle>| last.end() < whole + 1.0 - 1e-9;
        let mut trend = Self {
            open: cycles.pop_if(is_open),
            cycles,
            start: Some([0.0, initial]),
            ..Self::default()
        };
        trend.loops.steps.extend(steps);
        trend
    }

    /// Returns its memory in bytes, not counting the cycles that it shares with `other`.
    pub fn bytes_beside(&self, other: Option<&Self>) -> usize {
        let first = |trend: &Self| trend.cycles.first().map(Arc::as_ptr);
        let other = other.filter(|other| first(other) == first(self));
        let shared = other.map_or(0, |other| other.cycles.len());
        let fields = 32 * Column::HISTORY.len();
        let own = self.cycles.len().saturating_sub(shared) * (size_of::<Cycle>() + fields);
        let places = size_of::<Arc<Cycle>>() * self.cycles.len();
        own + places + size_of::<[f64; 4]>() * self.loops.steps.len()
    }

    /// Records the moment after a step.
    pub fn record(&mut self, session: &Session) {
        let simulation = session.simulation();
        let radius = scar_radius(simulation).unwrap_or(f64::NAN);
        let scar = [largest(simulation.worn_depth()), radius];
        let mut moment = simulation.moment();
        if simulation.has_jumped() {
            self.loops.record_jump(simulation);
            // A jump knows only the end of the last cycle.
            moment.stick_radius = moment.permanent_stick_radius;
        } else {
            self.loops.record(&moment);
        }
        let is_end = self.take(&moment, scar);
        let ended = self.cycles.last_mut().filter(|_| is_end);
        if let Some(entry) = ended.map(Arc::make_mut) {
            let reading = Reading::new(session);
            for k in [AMPLITUDE, LOAD] {
                entry.values[k] = reading.number(COLUMNS[k].0);
            }
            entry.fields = Some(Arc::new(history::fields(&reading)));
        }
    }

    /// Adds a moment, with the largest worn depth and the outer radius of the scar, m; returns true if it completes an
    /// entry.
    fn take(&mut self, moment: &Moment, [depth, radius]: [f64; 2]) -> bool {
        let [start, _] = *self.start.get_or_insert([moment.cycle, moment.wear_volume]);
        let before = self.cycles.last().map(|last| last.values);
        let of_last = |k: usize| before.map_or(f64::NAN, |values| values[k]);
        let now = Cycle {
            values: [
                moment.cycle,
                moment.contact_radius,
                moment.stick_radius.unwrap_or(f64::NAN),
                moment.wear_volume,
                depth,
                radius,
                moment.dissipated_energy,
                moment.energy_residual.unwrap_or(f64::NAN),
                self.step_cost.unwrap_or(f64::NAN),
                of_last(AMPLITUDE),
                of_last(LOAD),
            ],
            fields: None,
        };
        let merged = match self.open.take() {
            Some(open) => open.merged(&now),
            None => now,
        };
        let before = before.map_or(start, |values| values[0]);
        if merged.end() < before + self.stride.max(1.0) - 1e-9 {
            self.open = Some(Arc::new(merged));
            return false;
        }
        self.cycles.push(Arc::new(merged));
        if self.cycles.len() >= CAPACITY {
            let pairs = self.cycles.chunks(2).map(|pair| match pair {
                [one, other] => Arc::new(one.merged(other)),
                alone => Arc::clone(&alone[0]),
            });
            self.cycles = pairs.collect();
            self.stride = 2.0 * self.stride.max(1.0);
        }
        true
    }

    /// Returns the cycles so far, including the incomplete one, oldest first.
    pub fn cycles(&self) -> impl Iterator<Item = &Cycle> {
        self.cycles.iter().chain(&self.open).map(Arc::as_ref)
    }

    /// Whether the last cycle is incomplete.
    pub fn is_within_a_cycle(&self) -> bool {
        self.open.is_some()
    }

    /// Returns the cycles so far as columns, with the mean wear volume per cycle in each entry.
    pub fn history(&self) -> Table {
        let columns = COLUMNS.into_iter().enumerate();
        let columns = columns.map(|(k, (column, _))| {
            let values = self.cycles().map(|entry| entry.values[k]);
            (column, values.collect())
        });
        let start = self.start.unwrap_or_default();
        let rates = self.cycles().scan(start, |before, entry| {
            let [cycle, volume] = std::mem::replace(before, [entry.end(), entry.values[VOLUME]]);
            Some((before[1] - volume) / (before[0] - cycle))
        });
        let rates = (Column::WearRate, rates.collect());
        Table::of_columns(Vec::new(), columns.chain([rates]))
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(in crate::tui) fn moment(cycle: f64, stick: f64) -> Moment {
        Moment {
            cycle,
            time: 0.0,
            depth: 0.0,
            shift: cycle.fract(),
            rig_displacement: None,
            normal_force: 0.0,
            tangential_force: 1.0,
            contact_radius: 2.0,
            stick_radius: Some(stick),
            permanent_stick_radius: Some(stick),
            wear_volume: cycle,
            initial_volume: 0.0,
            dissipated_energy: 0.0,
            energy_residual: None,
            stability_margin: None,
        }
    }

    #[test]
    fn memory_is_bounded_and_extremes_survive() {
        let mut trend = Trend::default();
        for step in 1..=200_000_u32 {
            let cycle = f64::from(step) / 4.0;
            trend.take(
                &moment(cycle, if step == 777 { 0.1 } else { 1.0 }),
                [0.0; 2],
            );
        }
        assert!(trend.cycles().count() <= CAPACITY);
        let smallest = trend
            .cycles()
            .map(|cycle| cycle.values[2])
            .fold(f64::INFINITY, f64::min);
        assert_eq!(smallest, 0.1);
        assert_eq!(trend.cycles().last().map(Cycle::end), Some(50_000.0));
    }
}

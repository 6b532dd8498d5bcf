//! The explorer's record of a run, cycle by cycle; older cycles are kept ever more coarsely.

use std::array::from_fn;
use std::sync::Arc;

use super::loops::Loops;
use crate::charts::Run;
use crate::export::history;
use crate::reading::{Column, Observation};
use crate::scenario::scalars::Reading;
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
            history: Some(Arc::clone(&self.trend.history)),
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

/// Where the value of a column comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Taken {
    /// Read after every step.
    Step,
    /// Read at the end of a cycle, and until then that of the last whole cycle.
    Cycle,
    /// The record itself.
    Here,
}

/// The columns of a history, by their names in `history.csv` where they are there.
const COLUMNS: [(Column, Merge, Taken); 12] = [
    (Column::Cycle, LAST, Taken::Step),
    (Column::ContactRadius, f64::max, Taken::Step),
    (Column::PermanentStickRadius, f64::min, Taken::Step),
    (Column::WearVolume, LAST, Taken::Step),
    (Column::ScarDepth, LAST, Taken::Step),
    (Column::ScarRadius, LAST, Taken::Step),
    (Column::DissipatedEnergy, LAST, Taken::Step),
    (Column::EnergyResidual, LAST, Taken::Step),
    (Column::StepCost, f64::max, Taken::Here),
    (Column::ShiftAmplitude, LAST, Taken::Cycle),
    (Column::MeanNormalForce, LAST, Taken::Cycle),
    // The mean since the entry before.
    (Column::WearRate, LAST, Taken::Here),
];

/// The place of a column in the list; one that is not there does not compile.
const fn place(column: Column) -> usize {
    let mut k = 0;
    while COLUMNS[k].0 as usize != column as usize {
        k += 1;
    }
    k
}

const CYCLE: usize = place(Column::Cycle);
const VOLUME: usize = place(Column::WearVolume);
const RATE: usize = place(Column::WearRate);
const COST: usize = place(Column::StepCost);

/// One cycle, or several merged ones, in the order of the [`COLUMNS`]; NaN for unknown values.
type Cycle = [f64; COLUMNS.len()];

/// The fields of a cycle's end in `history.csv`; `None` while it is incomplete.
pub type Fields = Option<Arc<[String]>>;

/// The past of a run. Copies share what has not changed since.
#[derive(Debug, Clone, Default)]
pub struct Trend {
    /// The cycles so far, oldest first.
    pub history: Arc<Table>,
    /// The fields of each.
    pub fields: Vec<Fields>,
    /// Whether the last cycle is incomplete.
    pub is_within_a_cycle: bool,
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
    /// Restores a past from `cycles`, oldest first: their values by column and their fields, and the
    /// [steps](Loops::steps) of the last one. The run began with a worn volume `initial` (m³).
    pub fn of_past(
        cycles: impl Iterator<Item = (impl Fn(Column) -> f64, Fields)>,
        steps: impl Iterator<Item = [f64; 4]>,
        initial: f64,
    ) -> Self {
        let mut trend = Self {
            start: Some([0.0, initial]),
            ..Self::default()
        };
        for (value, fields) in cycles.take(CAPACITY - 1) {
            // An incomplete last cycle stays open.
            let whole = trend.last().map_or(0.0, |last| last[CYCLE]);
            trend.is_within_a_cycle = value(Column::Cycle) < whole + 1.0 - 1e-9;
            trend.push(COLUMNS.map(|(column, ..)| value(column)), fields);
        }
        trend.loops.steps.extend(steps);
        trend
    }

    /// Records the moment after a step.
    pub fn record(&mut self, session: &Session) {
        let simulation = session.simulation();
        let moment = simulation.moment();
        let mut stick = moment.stick_radius;
        if simulation.has_jumped() {
            self.loops.record_jump(simulation);
            // A jump knows only the end of the last cycle.
            stick = moment.permanent_stick_radius;
        } else {
            self.loops.record(&moment);
        }
        let reading = Reading::new(session);
        let value = |column| match column {
            Column::PermanentStickRadius => stick.unwrap_or(f64::NAN),
            column => reading.number(column),
        };
        self.add(value, || Arc::new(history::fields(&reading)));
    }

    /// Adds a moment with these values. If it completes an entry, `complete` returns its fields.
    fn add(&mut self, value: impl Fn(Column) -> f64, complete: impl FnOnce() -> Arc<[String]>) {
        let first = [Column::Cycle, Column::WearVolume];
        let start = *self.start.get_or_insert_with(|| first.map(&value));
        let open = self.is_within_a_cycle.then(|| self.pop()).flatten();
        let before = self.last();
        let mut now: Cycle = from_fn(|k| match COLUMNS[k] {
            (column, _, Taken::Step) => value(column),
            (_, _, Taken::Cycle) => before.map_or(f64::NAN, |values| values[k]),
            (_, _, Taken::Here) => f64::NAN,
        });
        now[COST] = self.step_cost.unwrap_or(f64::NAN);
        let mut cycle = open.map_or(now, |open| merged(&open, &now));
        let before = before.map_or(start[0], |values| values[CYCLE]);
        self.is_within_a_cycle = cycle[CYCLE] < before + self.stride.max(1.0) - 1e-9;
        let fields = (!self.is_within_a_cycle).then(|| {
            for (now, (column, _, taken)) in cycle.iter_mut().zip(COLUMNS) {
                if taken == Taken::Cycle {
                    *now = value(column);
                }
            }
            complete()
        });
        self.push(cycle, fields);
        if !self.is_within_a_cycle && self.fields.len() >= CAPACITY {
            self.merge_pairs();
        }
    }

    /// Adds an entry, with the mean wear volume per cycle since the one before.
    fn push(&mut self, mut cycle: Cycle, fields: Fields) {
        let before = self.last().map(|last| [last[CYCLE], last[VOLUME]]);
        let [then, volume] = before.or(self.start).unwrap_or_default();
        cycle[RATE] = (cycle[VOLUME] - volume) / (cycle[CYCLE] - then);
        let columns = COLUMNS.map(|(column, ..)| column).into_iter();
        Arc::make_mut(&mut self.history).push(columns.zip(cycle));
        self.fields.push(fields);
    }

    /// Removes and returns the last entry.
    fn pop(&mut self) -> Option<Cycle> {
        let last = self.last();
        Arc::make_mut(&mut self.history).pop();
        self.fields.pop();
        last
    }

    fn merge_pairs(&mut self) {
        let rows: Vec<_> = (0..self.fields.len()).map(|row| self.cycle(row)).collect();
        let fields = std::mem::take(&mut self.fields);
        self.history = Arc::default();
        for (pair, fields) in rows.chunks(2).zip(fields.chunks(2)) {
            let cycle = pair
                .iter()
                .copied()
                .reduce(|one, other| merged(&one, &other));
            let fields = fields.last().cloned().flatten();
            cycle
                .into_iter()
                .for_each(|cycle| self.push(cycle, fields.clone()));
        }
        self.stride = 2.0 * self.stride.max(1.0);
    }

    fn cycle(&self, row: usize) -> Cycle {
        COLUMNS.map(|(column, ..)| {
            self.history
                .column(column)
                .map_or(f64::NAN, |values| values[row])
        })
    }

    fn last(&self) -> Option<Cycle> {
        Some(self.cycle(self.fields.len().checked_sub(1)?))
    }
}

fn merged(one: &Cycle, later: &Cycle) -> Cycle {
    from_fn(|k| (COLUMNS[k].1)(one[k], later[k]))
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::reading::Moment;

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
            let stick = if step == 777 { 0.1 } else { 1.0 };
            let value = |column| match column {
                Column::Cycle | Column::WearVolume => cycle,
                Column::PermanentStickRadius => stick,
                _ => 0.0,
            };
            trend.add(value, || Arc::new([]));
        }
        assert!(trend.fields.len() <= CAPACITY);
        assert_eq!(trend.history.rows(), trend.fields.len());
        let radii = trend.history.column(Column::PermanentStickRadius);
        let smallest = radii.and_then(|radii| radii.iter().copied().reduce(f64::min));
        assert_eq!(smallest, Some(0.1));
        assert_eq!(trend.history.last_cycle(), Some(50_000.0));
        // One unit of volume per cycle.
        let rates = trend.history.column(Column::WearRate).unwrap_or_default();
        assert!(
            rates.iter().all(|rate| (rate - 1.0).abs() < 1e-9),
            "{rates:?}"
        );
    }
}

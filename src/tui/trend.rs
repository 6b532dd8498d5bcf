//! The explorer's record of the past, cycle by cycle: older ones ever more coarsely.

use std::sync::Arc;

use super::loops::{Loops, Steps};
use crate::export::history;
use crate::math::scan::largest;
use crate::reading::Moment;
use crate::scenario::scalars::{self, Reading, Value, scar_radius};
use crate::scenario::session::Session;
use crate::traces::Table;

/// Maximum number of cycles stored one by one; then neighbours are merged in pairs.
const CAPACITY: usize = 2048;

/// What is left of a value where two cycles are merged: extremes survive.
type Merge = fn(f64, f64) -> f64;

const LAST: Merge = |_, later| later;

/// The columns of a history, by their names in `history.csv` where they are there.
pub const COLUMNS: [(&str, Merge); 12] = [
    ("cycle", LAST),
    ("contact_radius_m", f64::max),
    ("permanent_stick_radius_m", f64::min),
    ("wear_volume_m3", LAST),
    ("scar_depth_m", LAST),
    ("scar_radius_m", LAST),
    ("dissipated_energy_J", LAST),
    ("energy_residual", LAST),
    ("step_cost_s", f64::max),
    // Of the last whole cycle.
    ("u_x_amplitude_m", LAST),
    ("mean_F_z_N", LAST),
    // On average over the entry.
    ("wear_rate_m3", LAST),
];

const VOLUME: usize = 3;
const AMPLITUDE: usize = 9;
const LOAD: usize = 10;
const RATE: usize = 11;

/// One cycle, or several that were merged; NaN where a value is not known.
#[derive(Debug, Clone, PartialEq)]
pub struct Cycle {
    /// Its values in the order of the [`COLUMNS`].
    pub values: [f64; COLUMNS.len()],
    /// The fields of its end in `history.csv`; none while it is unfinished.
    pub fields: Option<Arc<[String]>>,
}

impl Cycle {
    /// Where it ends.
    pub fn end(&self) -> f64 {
        self.values[0]
    }

    fn merged(mut self, later: Self) -> Self {
        for (k, (_, merge)) in COLUMNS.into_iter().enumerate() {
            self.values[k] = merge(self.values[k], later.values[k]);
        }
        self.fields = later.fields;
        self
    }

    /// The same with the volume worn in a cycle since `before`: a cycle and the volume then.
    fn since(mut self, [start, volume]: [f64; 2]) -> Self {
        let lasts = self.end() - start;
        self.values[RATE] = match lasts > 0.0 {
            true => (self.values[VOLUME] - volume) / lasts,
            false => f64::NAN,
        };
        self
    }
}

/// The part of a [`Trend`] that is lost when it is cut back to an earlier cycle.
#[derive(Debug, Clone, Default)]
pub struct Tip {
    open: Option<Cycle>,
    steps: Steps,
}

impl Tip {
    /// Its memory, bytes.
    pub fn bytes(&self) -> usize {
        bytes(&self.steps)
    }
}

fn bytes(steps: &Steps) -> usize {
    size_of::<[f64; 4]>() * steps.len()
}

/// The past of a run.
#[derive(Debug, Clone, Default)]
pub struct Trend {
    cycles: Vec<Cycle>,
    /// The unfinished one.
    open: Option<Cycle>,
    /// How many cycles an entry stands for.
    stride: f64,
    step_cost: Option<f64>,
    /// Cycle and worn volume (m³) of the first moment.
    start: Option<[f64; 2]>,
    /// Amplitude and load of the last cycle.
    condition: Option<[f64; 2]>,
    /// Fretting loops.
    pub loops: Loops,
}

impl Trend {
    /// The past of a run that begins with the present moment of `session`.
    pub fn from(session: &Session) -> Self {
        let mut trend = Self::default();
        trend.record(session);
        trend
    }

    /// A past of `cycles`, oldest first, and of the steps of the last one: cycle, u_x⁽⁰⁾ (m), F_x (N).
    /// The run began with a worn volume `initial` (m³).
    pub fn of_past(
        cycles: impl Iterator<Item = Cycle>,
        steps: Vec<[f64; 3]>,
        initial: f64,
    ) -> Self {
        let start = [0.0, initial];
        let mut trend = Self {
            start: Some(start),
            loops: Loops::of_steps(steps),
            ..Self::default()
        };
        for entry in cycles.take(CAPACITY - 1) {
            let entry = entry.since(trend.before().unwrap_or(start));
            trend.cycles.push(entry);
        }
        // What is not whole yet stays open.
        let whole = trend.cycles.iter().rev().nth(1).map_or(0.0, Cycle::end);
        if (trend.cycles.last()).is_some_and(|last| last.end() < whole + 1.0 - 1e-9) {
            trend.open = trend.cycles.pop();
        }
        trend
    }

    /// The end of the last entry, and the worn volume there.
    fn before(&self) -> Option<[f64; 2]> {
        let last = self.cycles.last();
        last.map(|entry| [entry.end(), entry.values[VOLUME]])
    }

    /// Sets the time per step from now on, s.
    pub fn note_cost(&mut self, step_cost: Option<f64>) {
        self.step_cost = step_cost;
    }

    /// The part that is lost when the trend is cut back to an earlier cycle.
    pub fn tip(&self) -> Tip {
        Tip {
            open: self.open.clone(),
            steps: self.loops.steps.clone(),
        }
    }

    /// Its memory, bytes.
    pub fn bytes(&self) -> usize {
        let fields = self.cycles.iter().flat_map(|entry| entry.fields.iter());
        let fields: usize = fields.map(|fields| 32 * fields.len()).sum();
        size_of_val(self.cycles.as_slice()) + fields + bytes(&self.loops.steps)
    }

    /// The trend as it was at `cycle`, where it had this tip.
    pub fn until(&self, cycle: f64, tip: &Tip) -> Self {
        let before = self.cycles.iter();
        Self {
            cycles: before
                .take_while(|entry| entry.end() <= cycle + 1e-9)
                .cloned()
                .collect(),
            open: tip.open.clone(),
            loops: self.loops.until(cycle, &tip.steps),
            condition: None,
            ..*self
        }
    }

    /// Takes in the moment after a step; returns true where it ends an entry, of which [`end`](Self::end) tells
    /// more.
    pub fn record(&mut self, session: &Session) -> bool {
        let simulation = session.simulation();
        let radius = scar_radius(simulation).unwrap_or(f64::NAN);
        self.take(
            &simulation.moment(),
            [largest(simulation.worn_depth()), radius],
        )
    }

    /// The same of a moment, and of the largest worn depth and the outer radius of the scar then, m.
    fn take(&mut self, moment: &Moment, [depth, radius]: [f64; 2]) -> bool {
        let first = [moment.cycle, moment.wear_volume];
        let first = *self.start.get_or_insert(first);
        self.loops.record(moment);
        let [amplitude, load] = self.condition.unwrap_or([f64::NAN; 2]);
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
                amplitude,
                load,
                f64::NAN,
            ],
            fields: None,
        };
        let before = self.before().unwrap_or(first);
        let merged = match self.open.take() {
            Some(open) => open.merged(now),
            None => now,
        };
        let merged = merged.since(before);
        if merged.end() < before[0] + self.stride.max(1.0) - 1e-9 {
            self.open = Some(merged);
            return false;
        }
        self.cycles.push(merged);
        if self.cycles.len() >= CAPACITY {
            let pairs = self.cycles.chunks(2);
            self.cycles = pairs
                .filter_map(|pair| pair.iter().cloned().reduce(Cycle::merged))
                .collect();
            self.stride = 2.0 * self.stride.max(1.0);
        }
        true
    }

    /// Notes the end of the last entry, which is the moment that is read.
    pub fn end(&mut self, reading: &Reading) {
        let condition = [AMPLITUDE, LOAD].map(|k| {
            let scalar = scalars::find(COLUMNS[k].0);
            match scalar.map(|scalar| scalar.read(reading)) {
                Some(Value::Number(number)) => number,
                _ => f64::NAN,
            }
        });
        self.condition = Some(condition);
        if let Some(entry) = self.cycles.last_mut() {
            [entry.values[AMPLITUDE], entry.values[LOAD]] = condition;
            entry.fields = Some(Arc::new(history::fields(reading)));
        }
    }

    /// The cycles so far, the unfinished one included, oldest first.
    pub fn cycles(&self) -> impl Iterator<Item = &Cycle> {
        self.cycles.iter().chain(&self.open)
    }

    /// Whether the last of them is unfinished.
    pub fn is_within_a_cycle(&self) -> bool {
        self.open.is_some()
    }

    /// The cycles so far as columns.
    pub fn history(&self) -> Table {
        let columns = COLUMNS.into_iter().enumerate();
        let columns = columns.map(|(k, (name, _))| {
            let values = self.cycles().map(|entry| entry.values[k]);
            (name, values.collect())
        });
        Table::of_columns(Vec::new(), columns)
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
            period_residual: None,
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

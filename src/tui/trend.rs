//! The explorer's record of the past: the last loop in full, older cycles ever more coarsely.

use std::collections::VecDeque;
use std::sync::Arc;

use crate::charts::Loop;
use crate::export::history;
use crate::reading::Moment;
use crate::scenario::scalars::{self, Reading, Value};
use crate::traces::Table;

/// Maximum number of cycles stored one by one; then neighbours are merged in pairs.
const CAPACITY: usize = 2048;

/// Maximum number of points of the fretting loop.
const LOOP_CAPACITY: usize = 4096;

/// Maximum number of stored loops, maximum points of each, and minimum points of a loop.
const MOST_LOOPS: usize = 24;
const LOOP_POINTS: usize = 64;
const SHORTEST_LOOP: usize = 9;

/// One cycle, or several that were merged: extremes survive merging.
#[derive(Debug, Clone, PartialEq)]
pub struct Cycle {
    /// Where it ends.
    pub cycle: f64,
    /// Largest contact radius, m.
    pub contact_radius: f64,
    /// Smallest stick radius, m; NaN without tangential motion.
    pub stick_radius: f64,
    /// Worn volume at the end, m³.
    pub wear_volume: f64,
    /// Largest worn depth at the end, m.
    pub scar_depth: f64,
    /// Outer radius of the scar at the end, m; NaN without wear.
    pub scar_radius: f64,
    /// Energy lost to friction since the start, J.
    pub dissipated_energy: f64,
    /// The volume from friction work, k E_d, m³; NaN if the wear law does not follow energy.
    pub expected_volume: f64,
    /// Volume worn in a cycle, m³, on average over the entry.
    pub wear_rate: f64,
    /// Time per step, s; NaN if not measured.
    pub step_cost: f64,
    /// Amplitude of u_x (m) and mean of F_z (N) of the last cycle; NaN before there is one.
    pub amplitude: f64,
    /// F_z.
    pub normal_force: f64,
    /// The fields of its end in `history.csv`; none while it is unfinished.
    pub fields: Option<Arc<[String]>>,
}

/// A quantity of a cycle.
pub type OfCycle = fn(&Cycle) -> f64;

/// The columns of a history, by their names in `history.csv` where they are there, and what they are of a cycle.
pub const COLUMNS: [(&str, OfCycle); 12] = [
    ("cycle", |entry| entry.cycle),
    ("contact_radius_m", |entry| entry.contact_radius),
    ("permanent_stick_radius_m", |entry| entry.stick_radius),
    ("wear_volume_m3", |entry| entry.wear_volume),
    ("scar_depth_m", |entry| entry.scar_depth),
    ("scar_radius_m", |entry| entry.scar_radius),
    ("dissipated_energy_J", |entry| entry.dissipated_energy),
    ("energy_residual", |entry| {
        1.0 - entry.wear_volume / entry.expected_volume
    }),
    ("wear_rate_m3", |entry| entry.wear_rate),
    ("step_cost_s", |entry| entry.step_cost),
    ("u_x_amplitude_m", |entry| entry.amplitude),
    ("mean_F_z_N", |entry| entry.normal_force),
];

/// A stored loop of one cycle.
#[derive(Debug, Clone, PartialEq)]
struct KeptLoop {
    cycle: f64,
    shifts: Vec<f64>,
    forces: Vec<f64>,
}

impl Cycle {
    /// A cycle of which nothing is known.
    pub const UNKNOWN: Self = Self {
        cycle: f64::NAN,
        contact_radius: f64::NAN,
        stick_radius: f64::NAN,
        wear_volume: f64::NAN,
        scar_depth: f64::NAN,
        scar_radius: f64::NAN,
        dissipated_energy: f64::NAN,
        expected_volume: f64::NAN,
        wear_rate: f64::NAN,
        step_cost: f64::NAN,
        amplitude: f64::NAN,
        normal_force: f64::NAN,
        fields: None,
    };

    fn merged(self, later: Self) -> Self {
        Self {
            contact_radius: self.contact_radius.max(later.contact_radius),
            stick_radius: self.stick_radius.min(later.stick_radius),
            step_cost: self.step_cost.max(later.step_cost),
            ..later
        }
    }
}

/// The unfinished cycle and the last loop of a [`Trend`].
#[derive(Debug, Clone, Default)]
pub struct Tip {
    open: Option<Cycle>,
    shifts: VecDeque<f64>,
    forces: VecDeque<f64>,
    /// The displacements of the rig's actuator, m; empty on a stiff rig.
    sensed: VecDeque<f64>,
    loop_cycles: VecDeque<f64>,
}

impl Tip {
    /// Its memory, bytes.
    pub fn bytes(&self) -> usize {
        8 * (3 * self.loop_cycles.len() + self.sensed.len())
    }
}

/// The past of a run.
#[derive(Debug, Clone, Default)]
pub struct Trend {
    cycles: Vec<Cycle>,
    /// How many cycles an entry stands for.
    stride: f64,
    tip: Tip,
    step_cost: Option<f64>,
    /// Cycle and worn volume (m³) of the first moment.
    start: Option<(f64, f64)>,
    scar: [f64; 2],
    /// Amplitude and load of the last cycle.
    condition: Option<[f64; 2]>,
    /// Loops of cycles so far apart, oldest first.
    loops: Vec<Arc<KeptLoop>>,
    loop_stride: f64,
}

impl Trend {
    /// A past of `cycles`, oldest first, and of the steps of the last one: cycle, u_x⁽⁰⁾ (m), F_x (N).
    /// The run began with a worn volume `initial` (m³).
    pub fn of_past(
        cycles: impl Iterator<Item = Cycle>,
        steps: Vec<[f64; 3]>,
        initial: f64,
    ) -> Self {
        let mut trend = Self {
            start: Some((0.0, initial)),
            ..Self::default()
        };
        let mut before = [0.0, initial];
        for mut entry in cycles.take(CAPACITY - 1) {
            let [start, volume] = before;
            entry.wear_rate = (entry.wear_volume - volume) / (entry.cycle - start);
            before = [entry.cycle, entry.wear_volume];
            trend.cycles.push(entry);
        }
        // What is not whole yet stays open.
        let whole = trend.cycles.iter().rev().nth(1);
        let whole = whole.map_or(0.0, |entry| entry.cycle);
        if trend
            .cycles
            .last()
            .is_some_and(|last| last.cycle < whole + 1.0 - 1e-9)
        {
            trend.tip.open = trend.cycles.pop();
        }
        for [cycle, shift, force] in steps.into_iter().take(LOOP_CAPACITY) {
            trend.tip.loop_cycles.push_back(cycle);
            trend.tip.shifts.push_back(shift);
            trend.tip.forces.push_back(force);
        }
        trend
    }

    /// Sets the time per step from now on, s.
    pub fn note_cost(&mut self, step_cost: Option<f64>) {
        self.step_cost = step_cost;
    }

    /// The largest worn depth and the outer radius of the scar (NaN without wear) at the moment that is recorded
    /// next, m.
    pub fn note_scar(&mut self, scar: [f64; 2]) {
        self.scar = scar;
    }

    /// The part that is lost when the trend is cut back to an earlier cycle.
    pub fn tip(&self) -> Tip {
        self.tip.clone()
    }

    /// Its memory, bytes.
    pub fn bytes(&self) -> usize {
        let fields = self.cycles.iter().flat_map(|entry| entry.fields.iter());
        let fields: usize = fields.map(|fields| 32 * fields.len()).sum();
        std::mem::size_of_val(self.cycles.as_slice()) + fields + self.tip.bytes()
    }

    /// The trend as it was at `cycle`, where it had this tip.
    pub fn until(&self, cycle: f64, tip: &Tip) -> Self {
        let before = self.cycles.iter();
        Self {
            cycles: before
                .take_while(|entry| entry.cycle <= cycle + 1e-9)
                .cloned()
                .collect(),
            stride: self.stride,
            tip: tip.clone(),
            step_cost: self.step_cost,
            start: self.start,
            scar: self.scar,
            condition: None,
            loops: self
                .loops
                .iter()
                .filter(|kept| kept.cycle <= cycle + 1e-9)
                .cloned()
                .collect(),
            loop_stride: self.loop_stride,
        }
    }

    /// Takes in the moment after a step; returns true where it ends an entry, of which [`end`](Self::end) tells
    /// more.
    pub fn record(&mut self, moment: &Moment) -> bool {
        let start = (moment.cycle, moment.wear_volume);
        let start = *self.start.get_or_insert(start);
        self.record_loop(moment);
        self.keep_loop(moment.cycle);
        let now = Cycle {
            cycle: moment.cycle,
            contact_radius: moment.contact_radius,
            stick_radius: moment.stick_radius.unwrap_or(f64::NAN),
            wear_volume: moment.wear_volume,
            scar_depth: self.scar[0],
            scar_radius: self.scar[1],
            dissipated_energy: moment.dissipated_energy,
            expected_volume: moment
                .energy_residual
                .map_or(f64::NAN, |residual| moment.wear_volume / (1.0 - residual)),
            wear_rate: 0.0,
            step_cost: self.step_cost.unwrap_or(f64::NAN),
            amplitude: self.condition.map_or(f64::NAN, |seen| seen[0]),
            normal_force: self.condition.map_or(f64::NAN, |seen| seen[1]),
            fields: None,
        };
        let mut merged = match self.tip.open.take() {
            Some(open) => open.merged(now),
            None => now,
        };
        let (start, volume) = self
            .cycles
            .last()
            .map(|entry| (entry.cycle, entry.wear_volume))
            .unwrap_or(start);
        merged.wear_rate = if merged.cycle > start {
            (merged.wear_volume - volume) / (merged.cycle - start)
        } else {
            f64::NAN
        };
        if merged.cycle < start + self.stride.max(1.0) - 1e-9 {
            self.tip.open = Some(merged);
            return false;
        }
        self.cycles.push(merged);
        if self.cycles.len() >= CAPACITY {
            self.cycles = self
                .cycles
                .chunks(2)
                .filter_map(|pair| pair.iter().cloned().reduce(Cycle::merged))
                .collect();
            self.stride = 2.0 * self.stride.max(1.0);
        }
        true
    }

    /// Notes the end of the last entry, which is the moment that is read.
    pub fn end(&mut self, reading: &Reading) {
        let number = |name| match scalars::find(name).map(|scalar| scalar.read(reading)) {
            Some(Value::Number(number)) => number,
            _ => f64::NAN,
        };
        let condition = ["u_x_amplitude_m", "mean_F_z_N"].map(number);
        self.condition = Some(condition);
        if let Some(entry) = self.cycles.last_mut() {
            [entry.amplitude, entry.normal_force] = condition;
            entry.fields = Some(Arc::new(history::fields(reading)));
        }
    }

    fn record_loop(&mut self, moment: &Moment) {
        self.tip.shifts.push_back(moment.shift);
        self.tip.forces.push_back(moment.tangential_force);
        self.tip.loop_cycles.push_back(moment.cycle);
        match moment.rig_displacement {
            Some(sensed) => self.tip.sensed.push_back(sensed),
            None => self.tip.sensed.clear(),
        }
        // One cycle and the point that closes it.
        while self.tip.loop_cycles.len() > 1
            && (self.tip.loop_cycles[0] < moment.cycle - 1.0 - 1e-9
                || self.tip.loop_cycles.len() > LOOP_CAPACITY)
        {
            self.tip.shifts.pop_front();
            self.tip.forces.pop_front();
            if self.tip.sensed.len() > self.tip.shifts.len() {
                self.tip.sensed.pop_front();
            }
            self.tip.loop_cycles.pop_front();
        }
    }

    /// Stores the loop of a finished cycle; when there are too many, every second one is dropped.
    fn keep_loop(&mut self, cycle: f64) {
        let whole = (cycle + 1e-9).floor();
        let last = self.loops.last().map_or(0.0, |kept| kept.cycle);
        let ends = cycle - whole < 1e-9 && whole >= last + self.loop_stride.max(1.0);
        let (shifts, forces) = self.fretting_loop();
        if !ends || shifts.len() < SHORTEST_LOOP {
            return;
        }
        let every = shifts.len().div_ceil(LOOP_POINTS);
        let thinned = |values: Vec<f64>| {
            let last = values.len() - 1;
            let kept = values.iter().enumerate();
            let kept = kept.filter(|(k, _)| k % every == 0 || *k == last);
            kept.map(|(_, value)| *value).collect()
        };
        self.loops.push(Arc::new(KeptLoop {
            cycle: whole,
            shifts: thinned(shifts),
            forces: thinned(forces),
        }));
        if self.loops.len() > MOST_LOOPS {
            let mut k = 0;
            self.loops.retain(|_| {
                k += 1;
                k % 2 == 1
            });
            self.loop_stride = 2.0 * self.loop_stride.max(1.0);
        }
    }

    /// The stored loops, oldest first: the cycle that each ends, u_x⁽⁰⁾ (m) and F_x (N).
    pub fn loops(&self) -> impl Iterator<Item = (f64, Vec<f64>, Vec<f64>)> + '_ {
        let kept = self.loops.iter();
        kept.map(|one| (one.cycle, one.shifts.clone(), one.forces.clone()))
    }

    /// The cycles so far, the unfinished one included, oldest first.
    pub fn cycles(&self) -> impl Iterator<Item = &Cycle> {
        self.cycles.iter().chain(&self.tip.open)
    }

    /// The finished cycles; the unfinished one if there is no other.
    pub fn finished_cycles(&self) -> impl Iterator<Item = &Cycle> {
        let first = self.tip.open.iter().filter(|_| self.cycles.is_empty());
        self.cycles.iter().chain(first)
    }

    /// Whether the last of them is unfinished.
    pub fn is_within_a_cycle(&self) -> bool {
        self.tip.open.is_some()
    }

    /// The cycles so far as columns.
    pub fn history(&self) -> Table {
        let columns = COLUMNS.map(|(name, of)| (name, self.cycles().map(of).collect()));
        Table::of_columns(Vec::new(), columns)
    }

    /// The loop of the last cycle, which ends at `end`.
    pub fn last_loop(&self, end: f64) -> Loop {
        let (shifts, forces) = self.fretting_loop();
        // A rig that was mounted within the cycle has sensed the end of it.
        let (sensed, _) = self.sensed_loop();
        let mut displacements = vec![f64::NAN; shifts.len() - sensed.len()];
        displacements.extend(sensed);
        Loop {
            end,
            shifts,
            forces,
            sensed: displacements,
        }
    }

    /// The displacement of the rig's actuator (m) and F_x (N) of the last cycle, as far as there is a rig that
    /// yields.
    pub fn sensed_loop(&self) -> (Vec<f64>, Vec<f64>) {
        let unsensed = self.tip.forces.len() - self.tip.sensed.len();
        (
            self.tip.sensed.iter().copied().collect(),
            self.tip.forces.iter().skip(unsensed).copied().collect(),
        )
    }

    /// The steps of the last cycle: cycle, u_x⁽⁰⁾ (m) and F_x (N).
    pub fn loop_rows(&self) -> impl Iterator<Item = [f64; 3]> + '_ {
        let tip = &self.tip;
        let rows = 0..tip.loop_cycles.len();
        rows.map(|row| [tip.loop_cycles[row], tip.shifts[row], tip.forces[row]])
    }

    /// u_x⁽⁰⁾ (m) and F_x (N) of the last cycle.
    pub fn fretting_loop(&self) -> (Vec<f64>, Vec<f64>) {
        (
            self.tip.shifts.iter().copied().collect(),
            self.tip.forces.iter().copied().collect(),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moment(cycle: f64, stick: f64) -> Moment {
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
            trend.record(&moment(cycle, if step == 777 { 0.1 } else { 1.0 }));
        }
        assert!(trend.cycles().count() <= CAPACITY);
        let smallest = trend
            .cycles()
            .map(|cycle| cycle.stick_radius)
            .fold(f64::INFINITY, f64::min);
        assert_eq!(smallest, 0.1);
        assert_eq!(
            trend.cycles().last().map(|cycle| cycle.cycle),
            Some(50_000.0)
        );
    }

    #[test]
    fn an_unfinished_cycle_counts_as_finished_only_if_it_is_the_first() {
        let mut trend = Trend::default();
        let mut record = |cycle: f64| {
            trend.record(&moment(cycle, 1.0));
            let ends = trend.finished_cycles().map(|entry| entry.cycle);
            ends.collect::<Vec<_>>()
        };
        assert_eq!(record(0.0), [0.0]);
        assert_eq!(record(0.5), [0.5]);
        assert_eq!(record(1.0), [1.0]);
        assert_eq!(record(1.5), [1.0]);
        assert_eq!(record(2.0), [1.0, 2.0]);
    }

    #[test]
    fn loops_are_kept_ever_further_apart() {
        let mut trend = Trend::default();
        for step in 1..=100_000_u32 {
            trend.record(&moment(f64::from(step) / 100.0, 1.0));
        }
        let cycles: Vec<f64> = trend.loops().map(|kept| kept.0).collect();
        assert!((12..=MOST_LOOPS).contains(&cycles.len()), "{cycles:?}");
        let steps: Vec<f64> = cycles.windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert!(steps.iter().all(|step| *step == steps[0]), "{cycles:?}");
        assert!(1000.0 - cycles[cycles.len() - 1] < steps[0]);
        assert!(trend.loops().all(|kept| (50..=66).contains(&kept.1.len())));
        let before = trend.until(500.0, &trend.tip());
        assert!(before.loops().all(|kept| kept.0 <= 500.0) && before.loops().count() > 3);
    }

    /// The sensor's loop has the forces of the contact's, and begins where a rig is mounted.
    #[test]
    fn the_loop_of_the_sensor_is_that_of_the_rig() {
        let mut trend = Trend::default();
        for step in 1..=1000_u32 {
            let mut moment = moment(f64::from(step) / 100.0, 1.0);
            moment.tangential_force = f64::from(step);
            moment.rig_displacement = (step > 950).then_some(2.0 * f64::from(step));
            trend.record(&moment);
        }
        let (sensed, forces) = trend.sensed_loop();
        assert_eq!((sensed.len(), forces.len()), (50, 50));
        assert!(
            sensed
                .iter()
                .zip(&forces)
                .all(|(u, force)| *u == 2.0 * force)
        );
        for step in 1001..=1200_u32 {
            let mut moment = moment(f64::from(step) / 100.0, 1.0);
            moment.rig_displacement = Some(0.0);
            trend.record(&moment);
        }
        assert_eq!(trend.sensed_loop().0.len(), trend.fretting_loop().0.len());
        trend.record(&moment(12.01, 1.0));
        assert!(trend.sensed_loop().0.is_empty());
    }

    #[test]
    fn the_loop_holds_one_cycle() {
        let mut trend = Trend::default();
        for step in 1..=1000_u32 {
            trend.record(&moment(f64::from(step) / 100.0, 1.0));
        }
        assert_eq!(trend.fretting_loop().0.len(), 101);
    }
}

//! Fretting loops and loads of a run's past: the last cycle's loop in full, earlier loops thinned and ever further
//! apart, and the loads of the last cycle, from which the largest stresses of a cycle are computed.

use std::collections::VecDeque;
use std::sync::Arc;

use crate::export::last_loop;
use crate::reading::subsurface::SpringLoad;
use crate::reading::{Column, Curves, Recorder, Table};
use crate::simulation::Simulation;
use crate::traces::Loop;

/// Maximum number of steps of the last loop.
const CAPACITY: usize = 4096;

/// Maximum number of stored loops, and of points in each.
const MOST: usize = 24;
const POINTS: usize = 64;

/// The loops.
#[derive(Debug, Clone)]
pub struct Loops {
    /// The steps of the last cycle, and the point that closes it.
    steps: Recorder,
    /// Loops of earlier cycles, at least `apart` cycles from each other, oldest first.
    pub kept: Vec<Arc<Loop>>,
    apart: f64,
}

impl Default for Loops {
    fn default() -> Self {
        Self {
            steps: Recorder::of_moments(last_loop::COLUMNS),
            kept: Vec::new(),
            apart: 1.0,
        }
    }
}

impl Loops {
    /// Records the present moment, whose columns are read by `read`. A jump over cycles knows no steps: its last cycle is
    /// stepped finely on the present profile.
    pub fn record(&mut self, simulation: &Simulation, read: impl Fn(Column) -> f64) {
        if simulation.has_jumped() {
            self.steps = last_loop::record(simulation);
            return self.end_step(simulation.cycle());
        }
        self.record_step(read);
    }

    fn record_step(&mut self, read: impl Fn(Column) -> f64) {
        self.steps.record(&read);
        self.end_step(read(Column::Cycle));
    }

    /// Restores the steps of the last cycle.
    pub fn restore(&mut self, table: &Table) {
        self.steps.record_table(table, f64::INFINITY);
    }

    /// Forgets the steps before the cycle that ends now, at `cycle`. Stores the loop of a whole cycle; when there are too
    /// many, drops every second one.
    fn end_step(&mut self, cycle: f64) {
        let begin = cycle - 1.0 - 1e-9;
        let steps = self.steps.rows();
        let before = steps.iter().take_while(|row| row[0] < begin).count();
        let first = before.max(steps.len().saturating_sub(CAPACITY));
        self.steps.forget_oldest(first);
        let whole = (cycle + 1e-9).floor();
        let last = self.kept.last().map_or(0.0, |kept| kept.end);
        let ends = cycle - whole < 1e-9 && whole >= last + self.apart;
        let count = self.steps.rows().len();
        if !ends || count < Loop::SHORTEST {
            return;
        }
        let (every, mut thinned) = (count.div_ceil(POINTS), self.steps.clone());
        thinned.keep(|step| step % every == 0 || step + 1 == count);
        self.kept.extend(Loop::recorded(&thinned).map(Arc::new));
        if self.kept.len() > MOST {
            self.kept = self.kept.iter().step_by(2).cloned().collect();
            self.apart *= 2.0;
        }
    }

    /// Returns the loop of the last cycle, if there is any.
    pub fn last(&self) -> Option<Loop> {
        Loop::recorded(&self.steps)
    }
}

/// Moments stored per cycle; extremes between them are missed by about 1 %.
const MOMENTS: f64 = 16.0;

/// Loads with their cycles, spanning at most one cycle.
#[derive(Debug, Default)]
pub(super) struct CycleLoads(VecDeque<(f64, Arc<SpringLoad>)>);

impl CycleLoads {
    /// Records the present load, unless one was recorded a moment ago.
    pub fn note(&mut self, simulation: &Simulation) {
        let now = simulation.cycle();
        match self.0.back() {
            // A different run, or an earlier state of this one.
            Some((last, _)) if now < *last => self.0.clear(),
            Some((last, _)) if now < last + 1.0 / MOMENTS - 1e-9 => return,
            _ => {}
        }
        let seen = simulation.observe(Curves::SPRINGS);
        let load = seen.spring_load(simulation.setup().material.poisson());
        self.0.push_back((now, Arc::new(load)));
        while self.0.front().is_some_and(|(then, _)| *then < now - 1.0) {
            self.0.pop_front();
        }
    }

    /// Returns the loads, oldest first.
    pub fn all(&self) -> Vec<Arc<SpringLoad>> {
        self.0.iter().map(|(_, load)| Arc::clone(load)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(loops: &mut Loops, step: u32, force: f64, sensed: f64) {
        let cycle = f64::from(step) / 100.0;
        loops.record_step(|column| match column {
            Column::Cycle => cycle,
            Column::Shift => cycle.fract(),
            Column::TangentialForce => force,
            _ => sensed,
        });
    }

    fn of_steps(steps: u32) -> Loops {
        let mut loops = Loops::default();
        (1..=steps).for_each(|step| record(&mut loops, step, 1.0, f64::NAN));
        loops
    }

    fn last(loops: &Loops) -> Loop {
        loops.last().expect("a loop")
    }

    #[test]
    fn loops_are_kept_ever_further_apart() {
        let loops = of_steps(100_000);
        let cycles: Vec<f64> = loops.kept.iter().map(|kept| kept.end).collect();
        assert!((12..=MOST).contains(&cycles.len()), "{cycles:?}");
        let steps: Vec<f64> = cycles.windows(2).map(|pair| pair[1] - pair[0]).collect();
        assert!(steps.iter().all(|step| *step == steps[0]), "{cycles:?}");
        assert!(1000.0 - cycles[cycles.len() - 1] < steps[0]);
        let mut points = loops.kept.iter().map(|kept| kept.shifts.len());
        assert!(points.all(|points| (50..=66).contains(&points)));
    }

    /// The sensor's loop begins when a rig is mounted.
    #[test]
    fn the_loop_of_the_sensor_is_that_of_the_rig() {
        let mut loops = Loops::default();
        for step in 1..=1000_u32 {
            let force = f64::from(step);
            let sensed = if step > 950 { 2.0 * force } else { f64::NAN };
            record(&mut loops, step, force, sensed);
        }
        let one = last(&loops);
        let pairs = one.sensed.iter().zip(&one.forces);
        let sensed: Vec<_> = pairs.filter(|(u, _)| !u.is_nan()).collect();
        assert_eq!(sensed.len(), 50);
        assert!(sensed.iter().all(|(u, force)| **u == 2.0 * **force));
        (1001..=1200).for_each(|step| record(&mut loops, step, 1.0, 0.0));
        assert!(last(&loops).sensed.iter().all(|u| !u.is_nan()));
    }

    #[test]
    fn the_last_loop_holds_one_cycle() {
        assert_eq!(last(&of_steps(1000)).shifts.len(), 101);
    }
}

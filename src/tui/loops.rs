//! Fretting loops and loads of a run's past: the last cycle's loop in full, earlier loops thinned and ever further
//! apart, and the loads of the last cycle, from which the largest stresses of a cycle are computed.

use std::collections::VecDeque;
use std::sync::Arc;

use crate::export::last_loop;
use crate::reading::subsurface::SpringLoad;
use crate::reading::{Curves, Moment};
use crate::simulation::Simulation;
use crate::traces::Loop;

/// Maximum number of steps of the last loop.
const CAPACITY: usize = 4096;

/// Maximum number of stored loops, and of points in each.
const MOST: usize = 24;
const POINTS: usize = 64;

/// The loops.
#[derive(Debug, Clone, Default)]
pub struct Loops {
    /// The steps of the last cycle, and the point that closes it: cycle, u_x⁽⁰⁾ (m), F_x (N), and the displacement of
    /// the rig's actuator (m), NaN on a stiff rig.
    pub steps: VecDeque<[f64; 4]>,
    /// Loops of earlier cycles, at least `apart` cycles from each other, oldest first.
    pub kept: Vec<Arc<Loop>>,
    apart: f64,
}

impl Loops {
    /// Records the moment after a step.
    pub fn record(&mut self, moment: &Moment) {
        let sensed = moment.rig_displacement.unwrap_or(f64::NAN);
        self.steps
            .push_back([moment.cycle, moment.shift, moment.tangential_force, sensed]);
        while self.steps.len() > 1
            && (self.steps[0][0] < moment.cycle - 1.0 - 1e-9 || self.steps.len() > CAPACITY)
        {
            self.steps.pop_front();
        }
        self.store_cycle(moment.cycle);
    }

    /// Records the moment after a jump over cycles by stepping the last cycle finely on the present profile.
    pub fn record_jump(&mut self, simulation: &Simulation) {
        let begin = simulation.cycle() - 1.0 - 1e-9;
        let rows = last_loop::rows(simulation).into_iter();
        self.steps = rows.filter(|row| row[0] >= begin).collect();
        self.store_cycle(simulation.cycle());
    }

    /// Stores the loop of a complete cycle; when there are too many, drops every second one.
    fn store_cycle(&mut self, cycle: f64) {
        let whole = (cycle + 1e-9).floor();
        let last = self.kept.last().map_or(0.0, |kept| kept.end);
        let ends = cycle - whole < 1e-9 && whole >= last + self.apart.max(1.0);
        if !ends || self.steps.len() < Loop::SHORTEST {
            return;
        }
        let (every, last) = (self.steps.len().div_ceil(POINTS), self.steps.len() - 1);
        let steps = self.steps.iter().enumerate();
        let thinned = steps.filter(|(k, _)| k % every == 0 || *k == last);
        let thinned = thinned.map(|(_, step)| step);
        self.kept.push(Arc::new(Loop::of_rows(whole, thinned)));
        if self.kept.len() > MOST {
            self.kept = self.kept.iter().step_by(2).cloned().collect();
            self.apart = 2.0 * self.apart.max(1.0);
        }
    }

    /// Returns the loop of the last cycle, which ends at `end`.
    pub fn last(&self, end: f64) -> Loop {
        Loop::of_rows(end, self.steps.iter())
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
    use super::super::trend::tests::moment;
    use super::*;

    fn of_steps(steps: u32) -> Loops {
        let mut loops = Loops::default();
        for step in 1..=steps {
            loops.record(&moment(f64::from(step) / 100.0, 1.0));
        }
        loops
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
            let mut moment = moment(f64::from(step) / 100.0, 1.0);
            moment.tangential_force = f64::from(step);
            moment.rig_displacement = (step > 950).then_some(2.0 * f64::from(step));
            loops.record(&moment);
        }
        let last = loops.last(10.0);
        let pairs = last.sensed.iter().zip(&last.forces);
        let sensed: Vec<_> = pairs.filter(|(u, _)| !u.is_nan()).collect();
        assert_eq!(sensed.len(), 50);
        assert!(sensed.iter().all(|(u, force)| **u == 2.0 * **force));
        for step in 1001..=1200_u32 {
            let mut moment = moment(f64::from(step) / 100.0, 1.0);
            moment.rig_displacement = Some(0.0);
            loops.record(&moment);
        }
        assert!(loops.last(12.0).sensed.iter().all(|u| !u.is_nan()));
    }

    #[test]
    fn the_last_loop_holds_one_cycle() {
        assert_eq!(of_steps(1000).last(10.0).shifts.len(), 101);
    }
}

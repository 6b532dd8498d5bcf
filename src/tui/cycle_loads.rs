//! The loads of the last cycle, from which the half-space's largest stresses of a cycle follow.

use std::collections::VecDeque;
use std::sync::Arc;

use crate::reading::Curves;
use crate::reading::subsurface::SpringLoad;
use crate::simulation::Simulation;

/// Moments stored per cycle: extremes between them are missed by about 1 %.
const MOMENTS: f64 = 16.0;

/// Loads with the cycles at which they were seen, at most one cycle of them.
#[derive(Debug, Default)]
pub(super) struct CycleLoads(VecDeque<(f64, Arc<SpringLoad>)>);

impl CycleLoads {
    /// Takes the present load in, unless one was taken a moment ago.
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

    /// The loads, oldest first.
    pub fn all(&self) -> Vec<Arc<SpringLoad>> {
        self.0.iter().map(|(_, load)| Arc::clone(load)).collect()
    }
}

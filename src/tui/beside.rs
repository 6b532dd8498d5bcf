//! A second run that follows the first from cycle to cycle.

use std::time::{Duration, Instant};

use super::trend::Recorded;

/// The second run, and what its steps have cost.
#[derive(Debug, Clone)]
pub(super) struct Beside {
    pub run: Recorded,
    busy: Duration,
    steps: u64,
    /// Why it stopped, if it did.
    pub stopped: Option<String>,
}

impl Beside {
    /// A run that begins where `run` stands.
    pub fn new(run: Recorded) -> Self {
        Self {
            run,
            busy: Duration::ZERO,
            steps: 0,
            stopped: None,
        }
    }

    /// What a step of it costs, s; none before the first.
    pub fn step_cost(&self) -> Option<f64> {
        (self.steps > 0).then(|| self.busy.as_secs_f64() / self.steps as f64)
    }

    /// Whether it is not yet at `cycle`.
    pub fn lags(&self, cycle: f64) -> bool {
        self.stopped.is_none() && self.run.cycle() < cycle
    }

    /// Steps to `cycle`, where the first run is, for about as long as `budget`, but at least once: the first run may
    /// have jumped over many cycles that this one has to step through. Steps may lead past `cycle`, but not past
    /// `goal`.
    pub fn follow(&mut self, goal: f64, cycle: f64, budget: Duration) {
        let (start, before) = (Instant::now(), self.run.simulation().steps());
        while self.lags(cycle) {
            let stepped = self.run.step_until(goal);
            self.stopped = stepped.err().map(|error| error.to_string());
            if start.elapsed() >= budget {
                break;
            }
        }
        self.busy += start.elapsed();
        self.steps += self.run.simulation().steps() - before;
    }
}

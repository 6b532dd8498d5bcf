//! A second run that follows the first from cycle to cycle.

use std::time::{Duration, Instant};

use super::trend::Recorded;
use crate::scenario::session::Session;

/// The second run, and what its steps have cost.
#[derive(Debug, Clone)]
pub(super) struct Beside {
    pub run: Recorded,
    /// The run before its first step: where it begins again when the first one goes back in time.
    start: Option<Session>,
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
            start: None,
            busy: Duration::ZERO,
            steps: 0,
            stopped: None,
        }
    }

    /// A run that begins with `session`, and again wherever the first run goes back in time.
    pub fn from_start(session: Session) -> Self {
        Self {
            start: Some(session.clone()),
            ..Self::new(session.into())
        }
    }

    /// What a step of it costs, s; none before the first.
    pub fn step_cost(&self) -> Option<f64> {
        (self.steps > 0).then(|| self.busy.as_secs_f64() / self.steps as f64)
    }

    /// Whether it is not yet at `cycle`.
    pub fn lags(&self, cycle: f64) -> bool {
        self.stopped.is_none() && self.run.cycle() < cycle || self.must_restart(cycle)
    }

    /// Whether the first run has gone back in time, to `cycle`.
    fn must_restart(&self, cycle: f64) -> bool {
        self.start.is_some() && self.run.cycle() > cycle + 1e-9
    }

    /// Steps to `cycle`, where the first run is, for about as long as `budget`, but at least once: the first run may
    /// have jumped over many cycles that this one has to step through. Steps may lead past `cycle`, but not past
    /// `goal`.
    pub fn follow(&mut self, goal: f64, cycle: f64, budget: Duration) {
        if self.must_restart(cycle)
            && let Some(start) = self.start.take()
        {
            *self = Self::from_start(start);
        }
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

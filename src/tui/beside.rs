//! A second run that follows the first from cycle to cycle.

use std::time::{Duration, Instant};

use crate::scenario::session::{Session, SessionError};

/// The second run, and what its steps have cost.
#[derive(Debug, Clone)]
pub(super) struct Beside {
    session: Session,
    busy: Duration,
    steps: u64,
    stopped: Option<String>,
}

impl Beside {
    /// A run that begins where `session` stands.
    pub fn new(session: Session) -> Self {
        Self {
            session,
            busy: Duration::ZERO,
            steps: 0,
            stopped: None,
        }
    }

    /// The run.
    pub fn session(&self) -> &Session {
        &self.session
    }

    /// Why it stopped, if it did.
    pub fn stopped(&self) -> Option<&str> {
        self.stopped.as_deref()
    }

    /// What a step of it costs, s; none before the first.
    pub fn step_cost(&self) -> Option<f64> {
        (self.steps > 0).then(|| self.busy.as_secs_f64() / self.steps as f64)
    }

    /// Whether it is not yet at `cycle`.
    pub fn lags(&self, cycle: f64) -> bool {
        self.stopped.is_none() && self.session.simulation().cycle() < cycle
    }

    /// Steps to `cycle`, where the first run is, for about as long as `budget`: the first run may
    /// have jumped over many cycles that this one has to step through. `on_step` sees every step.
    pub fn follow_for(&mut self, cycle: f64, budget: Duration, on_step: impl FnMut(&Session)) {
        self.step(cycle, cycle, budget, on_step);
    }

    /// The same, with steps that may lead past `cycle`, but not past `goal`.
    pub fn follow_towards(&mut self, goal: f64, cycle: f64, budget: Duration) {
        self.step(goal, cycle, budget, |_| {});
    }

    fn step(&mut self, goal: f64, cycle: f64, budget: Duration, mut on_step: impl FnMut(&Session)) {
        if self.stopped.is_some() {
            return;
        }
        let (start, before) = (Instant::now(), self.session.simulation().steps());
        let mut stands = true;
        let ended = self.session.advance_towards(goal, cycle, |session| {
            // Whatever the budget, it takes a step.
            if std::mem::take(&mut stands) {
                return true;
            }
            on_step(session);
            start.elapsed() < budget
        });
        if let Err(error) = ended
            && !matches!(error, SessionError::Interrupted)
        {
            self.stopped = Some(error.to_string());
        }
        self.busy += start.elapsed();
        self.steps += self.session.simulation().steps() - before;
    }
}

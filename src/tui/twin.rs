//! A coarser twin of the run: what the two differ by tells the error of the run while it goes on.
//!
//! The twin has half the cells and half the steps per cycle, so about a quarter of the work. The two are compared at
//! the end of a cycle, then again when the run is a quarter longer. In between the twin takes steps and jumps of
//! its own length: one that was cut wherever the run stands would show no error of time.

use std::time::Duration;

use super::beside::Beside;
use crate::scenario::session::Session;
use crate::studies::refinement::{self, Outcome};

/// The run is this many times longer at the next comparison.
const NEXT: f64 = 1.25;

/// The twin, and what it has told so far.
#[derive(Debug)]
pub(super) struct Twin {
    beside: Beside,
    /// The cycle at which the two are compared next.
    due: f64,
    /// The run at that cycle, once it has been there.
    run: Option<Outcome>,
    error: Option<f64>,
}

impl Twin {
    /// A twin of `session`, which it has to catch up with; `None` if nothing wears, or if the run is too coarse to be
    /// halved.
    pub fn of(session: &Session) -> Option<Self> {
        session.simulation().setup().wear?;
        let mut twin = Self {
            beside: Beside::new(refinement::twin(session)?.ok()?.into()),
            due: 1.0,
            run: None,
            error: None,
        };
        twin.look_at(session, true);
        Some(twin)
    }

    /// The last estimate of the run's error: of the worn depth or of the volume, whichever is larger, relative.
    pub fn error(&self) -> Option<f64> {
        self.error.filter(|error| error.is_finite())
    }

    /// Looks at the run if a comparison is due, or in any case if it `must`; a jump may have led the twin past it.
    pub fn look_at(&mut self, session: &Session, must: bool) {
        let cycle = session.simulation().cycle();
        let is_due = self.run.is_none() && cycle >= self.due;
        let is_ahead = self.beside.run.cycle() > cycle;
        if cycle > 0.0 && (is_due || must) && !is_ahead {
            self.due = cycle;
            self.run = Some(Outcome::of(session));
        }
    }

    /// Whether it has not yet told the error of the run, which is at `cycle`.
    pub fn lags(&self, cycle: f64) -> bool {
        self.beside.lags(cycle.min(self.due))
    }

    /// Steps towards the next comparison for about `budget`, but not past the run, which is at `cycle`.
    pub fn follow_for(&mut self, cycle: f64, budget: Duration) {
        self.beside.follow(self.due, cycle.min(self.due), budget);
        let is_there = self.beside.run.cycle() >= self.due;
        if let Some(run) = self.run.take_if(|_| is_there) {
            let twin = Outcome::of(&self.beside.run.session);
            self.error = Some(refinement::by_twin(&twin, &run).promised());
            self.due = (NEXT * self.due).ceil().max(self.due.floor() + 1.0);
        }
    }
}

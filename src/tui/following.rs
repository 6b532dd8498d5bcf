//! Second runs that follow the first from cycle to cycle: ghosts over the plots, and a coarser twin, whose difference
//! from the run is about the run's error.
//!
//! The twin has fewer cells and steps per cycle by a factor of 1.7, so about a third of the work. The two are compared
//! at the end of a cycle, and again when the run is a quarter longer. In between, the twin takes steps and jumps of its
//! natural length; if it stopped wherever the run stands, it would not show the error in time.

use std::time::{Duration, Instant};

use super::recorded::Recorded;
use crate::scenario::session::Session;
use crate::studies::refinement::{self, Difference, Outcome};

/// The second run.
#[derive(Debug, Clone)]
pub(super) struct FollowingRun {
    pub run: Recorded,
    /// The run before its first step, from which it restarts when the first run goes back in time.
    start: Option<Session>,
    /// Why it stopped, if it did.
    pub stopped: Option<String>,
}

impl FollowingRun {
    /// Makes a run that begins at the state of `session`. If it `restarts`, it begins again there whenever the first
    /// run goes back in time.
    pub fn new(session: Session, restarts: bool) -> Self {
        Self {
            start: restarts.then(|| session.clone()),
            run: session.into(),
            stopped: None,
        }
    }

    /// Whether it still has to reach `cycle`.
    pub fn lags(&self, cycle: f64) -> bool {
        self.stopped.is_none() && self.run.cycle() < cycle || self.must_restart(cycle)
    }

    /// Whether the first run has gone back in time, to `cycle`.
    fn must_restart(&self, cycle: f64) -> bool {
        self.start.is_some() && self.run.cycle() > cycle + 1e-9
    }

    /// Steps to `cycle`, where the first run is, for about as long as `budget`, but at least once: the first run may
    /// have jumped over many cycles that this one has to step through. Steps may go past `cycle`, but not past `goal`.
    pub fn follow(&mut self, goal: f64, cycle: f64, budget: Duration) {
        if self.must_restart(cycle)
            && let Some(start) = self.start.take()
        {
            *self = Self::new(start, true);
        }
        let start = Instant::now();
        while self.lags(cycle) {
            let stepped = self.run.step_until(goal);
            self.stopped = stepped.err().map(|error| error.to_string());
            if start.elapsed() >= budget {
                break;
            }
        }
    }
}

/// At the next comparison the run is this many times longer.
const NEXT: f64 = 1.25;

/// The message before anything can be compared.
pub(super) const NOTHING_YET: &str = "nothing to compare yet: let it run for a cycle";

/// The twin, and its last result.
#[derive(Debug)]
pub(super) struct Twin {
    twin_run: FollowingRun,
    /// The cycle of the next comparison.
    due: f64,
    /// The run at that cycle, once it has reached it.
    run: Option<Outcome>,
    /// The cycle of the last comparison, and the estimated errors there.
    last: Option<(f64, Difference)>,
}

impl Twin {
    /// Makes a twin of `session`, which has to catch up with it. `None` if nothing wears, or if the run is already too
    /// coarse.
    pub fn new(session: &Session) -> Option<Self> {
        session.simulation().setup().wear?;
        let mut twin = Self {
            twin_run: FollowingRun::new(refinement::twin(session)?.ok()?, false),
            due: 1.0,
            run: None,
            last: None,
        };
        twin.look_at(session, true);
        Some(twin)
    }

    /// Returns the cycle of the last comparison and the run's estimated errors, or why there are none yet; the run is
    /// at `cycle`.
    pub fn errors(&self, cycle: f64) -> Result<(f64, Difference), String> {
        let waits = if self.lags(cycle) {
            "running ..."
        } else {
            NOTHING_YET
        };
        let stopped = self.twin_run.stopped.as_deref();
        self.last.ok_or_else(|| stopped.unwrap_or(waits).to_owned())
    }

    /// Notes the run's outcome if a comparison is due or forced by `must`, unless the twin has jumped past it.
    pub fn look_at(&mut self, session: &Session, must: bool) {
        let cycle = session.simulation().cycle();
        let is_due = self.run.is_none() && cycle >= self.due;
        let is_ahead = self.twin_run.run.cycle() > cycle;
        if cycle > 0.0 && (is_due || must) && !is_ahead {
            self.due = cycle;
            self.run = Some(Outcome::from_session(session));
        }
    }

    /// Whether the error of the run, which is at `cycle`, is still to come.
    pub fn lags(&self, cycle: f64) -> bool {
        self.twin_run.lags(cycle.min(self.due))
    }

    /// Steps towards the next comparison for about `budget`, but not past the run, which is at `cycle`.
    pub fn follow_for(&mut self, cycle: f64, budget: Duration) {
        self.twin_run.follow(self.due, cycle.min(self.due), budget);
        let is_there = self.twin_run.run.cycle() >= self.due;
        if let Some(run) = self.run.take_if(|_| is_there) {
            let twin = Outcome::from_session(&self.twin_run.run.session);
            self.last = Some((self.due, run.error_by(&twin, run.finer_than(&twin))));
            self.due = (NEXT * self.due).ceil().max(self.due.floor() + 1.0);
        }
    }
}

//! Stepping: as far as the pace allows while it runs, or by hand.

use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use super::Worker;
use super::travel::ends_cycle;
use crate::tui::frame::Activity;
use crate::tui::pace::Pace;

/// The time between two jumps over cycles, unless the pace is without limit.
const JUMP_EVERY: Duration = Duration::from_millis(100);

/// How long the worker steps before it looks for orders again.
const STINT: Duration = Duration::from_millis(4);

/// What is said when a run that cannot go on is asked to.
const BROKEN_DOWN: &str = "the run has broken down; r starts again, m changes the method";

impl Worker {
    /// Runs, or pauses.
    pub(super) fn run_or_pause(&mut self) {
        match self.activity {
            Activity::Running => self.activity = Activity::Paused,
            Activity::Paused | Activity::Done => self.activity = Activity::Running,
            Activity::Stopped(_) => self.notice(BROKEN_DOWN),
        }
    }

    /// How long to wait for orders before the next step or checkpoint is due; forever when there is
    /// none.
    pub(super) fn until_next_step(&self) -> Option<Duration> {
        if self.activity != Activity::Running {
            return self.keeping.as_ref()?.wait(self.past.line(&self.session));
        }
        Some(Duration::from_secs_f64(self.ahead().clamp(0.0, 0.1)))
    }

    /// Seconds until the next step is due. A jump over many cycles is due a moment after the one before:
    /// how far it goes is not for the pace to say, or no run could be repeated.
    fn ahead(&self) -> f64 {
        let simulation = self.session.simulation();
        match Pace::of_rung(self.rung) {
            Pace::Unlimited => 0.0,
            Pace::Cycles(_) if simulation.may_jump() => {
                JUMP_EVERY.as_secs_f64() - self.stepped.elapsed().as_secs_f64()
            }
            Pace::Cycles(pace) => self.meter.ahead(simulation.next_moment(), pace),
        }
    }

    /// Steps while the pace allows it, for no longer than orders may wait.
    pub(super) fn step_for_a_stint(&mut self) {
        let start = Instant::now();
        while self.activity == Activity::Running && start.elapsed() < STINT {
            if self.ahead() > 0.0 {
                break;
            }
            let before = self.session.simulation().cycle();
            #[cfg(debug_assertions)]
            if before > 5.0 {
                crate::tui::fault::strike("sixth cycle");
            }
            self.step();
            self.keep_cycle(before);
            self.end_where_planned(before);
        }
        self.meter.measure(
            self.session.simulation().cycle(),
            self.session.simulation().state().steps,
            start.elapsed(),
        );
        self.trend.note_cost(self.meter.step_cost);
        if self.published.elapsed() >= self.interval || self.activity != Activity::Running {
            self.publish();
        }
    }

    fn step(&mut self) {
        self.branch();
        if self.session.simulation().state().steps == 0 {
            self.keep();
        }
        self.stepped = Instant::now();
        let now = self.session.simulation().cycle();
        let end = self.session.loaded().run().cycles;
        let end = end.filter(|&end| now < end).unwrap_or(f64::INFINITY);
        match self.session.step_until(end) {
            Ok(()) => {
                self.trend.record(&self.session.simulation().moment());
                if let Some(rival) = &mut self.rival {
                    rival.follow(self.session.simulation().cycle());
                }
            }
            Err(error) => self.activity = Activity::Stopped(error.to_string()),
        }
    }

    /// Pauses when a running simulation passes the end of the scenario's plan.
    fn end_where_planned(&mut self, before: f64) {
        let Some(end) = self.session.loaded().run().cycles else {
            return;
        };
        let simulation = self.session.simulation();
        let end = end - simulation.rounding();
        if self.activity == Activity::Running && before < end && simulation.cycle() >= end {
            self.activity = Activity::Done;
        }
    }

    /// Pauses and steps until `done`, which is given the cycles before and now, is true.
    pub(super) fn by_hand(&mut self, done: impl Fn(f64, f64) -> bool) {
        if matches!(self.activity, Activity::Stopped(_)) {
            return self.notice(BROKEN_DOWN);
        }
        self.activity = Activity::Paused;
        let before = self.session.simulation().cycle();
        loop {
            self.step();
            if ends_cycle(before, self.session.simulation().cycle()) {
                self.keep();
            }
            if self.activity != Activity::Paused
                || done(before, self.session.simulation().cycle())
                || self.halt.load(Ordering::Relaxed)
            {
                break;
            }
        }
        self.keep();
    }
}

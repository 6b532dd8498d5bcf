//! Stepping: as far as the pace allows while it runs, or by hand.

use std::time::{Duration, Instant};

use super::travel::ends_cycle;
use super::{CATCH_UP, Worker};
use crate::reading::Curves;
use crate::scenario::scalars::Reading;
use crate::tui::frame::Activity;
use crate::tui::ghosts;
use crate::tui::pace::Pace;
use crate::tui::twin::Twin;

/// The time between two jumps over cycles, unless the pace is without limit.
const JUMP_EVERY: Duration = Duration::from_millis(100);

/// How long the worker steps before it looks for orders again.
const STINT: Duration = Duration::from_millis(4);

/// How long the run's twin steps after each stint: about a quarter of the work is its.
const TWIN_STINT: Duration = Duration::from_millis(2);

/// Frames of a fast run are taken at this fraction of a cycle: at its end, as the rows of a history
/// are.
const HELD: f64 = 0.0;

/// A run too slow for a frame at each cycle shows one at least this often.
const AT_LEAST: Duration = Duration::from_secs(1);

/// Cycles that a jump beyond the planned end may cover at least.
const SHORTEST_PLAN: f64 = 1000.0;

/// The notice when a failed run is asked to continue.
const BROKEN_DOWN: &str = "the run has failed; r restarts it, m changes the method";

impl Worker {
    /// Runs, or pauses.
    pub fn run_or_pause(&mut self) {
        match self.activity {
            Activity::Running => self.activity = Activity::Paused,
            Activity::Done if !self.told_of_end => {
                self.told_of_end = true;
                self.notice("planned end reached; Space again continues without limit, r restarts");
            }
            Activity::Paused | Activity::Done => self.activity = Activity::Running,
            Activity::Stopped(_) => self.notice(BROKEN_DOWN),
        }
    }

    /// The phase at which frames are taken, degrees; `None` while the motion itself is shown.
    pub(super) fn held_phase(&self) -> Option<f64> {
        let holds = self.holds_phase
            && Pace::of_rung(self.rung).blurs_motion()
            && !self.session.simulation().may_jump();
        holds.then_some(360.0 * HELD)
    }

    /// Takes frames at one phase of the motion from now on, or as they come.
    pub fn hold_or_release_phase(&mut self) {
        self.holds_phase = !self.holds_phase;
        self.notice(if self.holds_phase {
            "above 2 cycles/s, all frames show the same phase of the motion"
        } else {
            "frames at any phase: in a fast run the motion seems to jump"
        });
    }

    /// How long to wait for orders before the next step or checkpoint is due; forever if none is
    /// due.
    pub(super) fn until_next_step(&self) -> Option<Duration> {
        if self.activity != Activity::Running {
            let line = self.past.line(&self.session);
            return super::locked(self.keeping.as_ref()?).wait(line);
        }
        Some(Duration::from_secs_f64(self.ahead().clamp(0.0, 0.1)))
    }

    /// Seconds until the next step is due. A jump over many cycles is due a moment after the one
    /// before: its length must not depend on the pace, or runs would not be repeatable.
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
                crate::failpoint::hit("sixth cycle");
                crate::failpoint::stall("long step");
            }
            self.step();
            self.keep_cycle(before);
            self.end_where_planned(before);
            let now = self.session.simulation().cycle() + 1e-9;
            let passed = (now - HELD).floor() > (before + 1e-9 - HELD).floor();
            if passed && self.held_phase().is_some() && self.published.elapsed() >= self.interval {
                self.publish();
            }
        }
        self.meter.measure(
            self.session.simulation().cycle(),
            self.session.simulation().steps(),
            start.elapsed(),
        );
        self.trend.note_cost(self.meter.step_cost);
        self.follow_with_twin(TWIN_STINT);
        let wait = match self.held_phase() {
            Some(_) => self.interval.max(AT_LEAST),
            None => self.interval,
        };
        if self.published.elapsed() >= wait || self.activity != Activity::Running {
            self.publish();
        }
    }

    fn step(&mut self) {
        if let Some(word) = self.branch() {
            self.twin = Twin::of(&self.session);
            self.notice(&word);
        }
        if self.session.simulation().steps() == 0 {
            self.keep();
        }
        self.stepped = Instant::now();
        let now = self.session.simulation().cycle();
        match self.session.step_until(self.goal()) {
            Ok(()) => {
                if self.curves.contains(Curves::SPRINGS) {
                    self.cycle_loads.note(self.session.simulation());
                }
                let simulation = self.session.simulation();
                let is_end = self.has_reached_end(now);
                let ends = ends_cycle(now, simulation.cycle());
                if let Some(twin) = self.twin.as_mut().filter(|_| ends || is_end) {
                    // Steps by hand are few, and each is looked at.
                    let must = is_end || self.activity != Activity::Running;
                    twin.look_at(&self.session, must);
                }
                if ghosts::record(&mut self.trend, &self.session) {
                    self.trend.end(&Reading::new(&self.session));
                }
                if let Some(comparison) = &mut self.comparison {
                    comparison.follow_for(self.session.simulation().cycle(), CATCH_UP);
                }
                for ghost in &mut self.ghosts {
                    ghost.follow_for(self.session.simulation().cycle(), CATCH_UP);
                }
            }
            Err(error) => self.activity = Activity::Stopped(error.to_string()),
        }
    }

    /// The cycle at which the next step or jump ends at the latest: the planned end, and beyond it as far
    /// again. Where nothing wears any more, a jump would otherwise go so far that no comparison run by direct
    /// steps could follow.
    fn goal(&self) -> f64 {
        let simulation = self.session.simulation();
        let now = simulation.cycle();
        match self.session.loaded().run().cycles {
            Some(end) if now < end => self.session.heading(end),
            Some(end) if simulation.may_jump() => now + end.max(SHORTEST_PLAN).ceil(),
            _ => f64::INFINITY,
        }
    }

    /// Pauses when a running simulation passes the end of the scenario's plan.
    fn end_where_planned(&mut self, before: f64) {
        if self.activity == Activity::Running && self.has_reached_end(before) {
            self.activity = Activity::Done;
            self.told_of_end = false;
        }
    }

    /// Whether the planned end lies between the cycle `before` and now.
    fn has_reached_end(&self, before: f64) -> bool {
        let simulation = self.session.simulation();
        let end = self.session.loaded().run().cycles;
        let end = end.map(|end| end - simulation.rounding());
        end.is_some_and(|end| before < end && simulation.cycle() >= end)
    }

    /// Pauses and steps until `done`, which is given the cycles before and now, is true.
    pub(super) fn step_by_hand(&mut self, done: impl Fn(f64, f64) -> bool) {
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
                || self.is_over()
            {
                break;
            }
        }
        self.keep();
    }
}

//! Stepping: as far as the pace allows while running, or by hand.

use std::time::{Duration, Instant};

use super::travel::ends_cycle;
use super::{BROKEN_DOWN, Worker};
use crate::panics::locked;
use crate::reading::Curves;
use crate::tui::frame::Activity;

/// How long the worker steps before it looks for orders again.
const STINT: Duration = Duration::from_millis(4);

/// How long the run's twin steps after each stint; it gets about a quarter of the time.
const TWIN_STINT: Duration = Duration::from_millis(2);

/// Minimum time between stored states, so that storing them takes no noticeable time.
const APART: Duration = Duration::from_millis(50);

/// A run too slow to show every cycle shows a frame at least this often.
const AT_LEAST: Duration = Duration::from_secs(1);

/// Minimum number of cycles that a jump beyond the planned end may cover.
const SHORTEST_PLAN: f64 = 1000.0;

impl Worker {
    /// Returns how long to wait for orders before the next step or checkpoint is due; the maximum if none is.
    pub(super) fn until_next_step(&self) -> Duration {
        if self.pace.is_running() {
            let ahead = self.pace.ahead(self.run.simulation());
            return Duration::from_secs_f64(ahead.clamp(0.0, 0.1));
        }
        let wait = locked(&self.autosave).time_until_due(&self.past.line(&self.run).session);
        wait.unwrap_or(Duration::MAX)
    }

    /// Steps while the pace allows, but no longer than orders may wait.
    pub(super) fn step_for_a_while(&mut self) {
        let start = Instant::now();
        while self.pace.is_running() && start.elapsed() < STINT {
            let simulation = self.run.simulation();
            if self.pace.ahead(simulation) > 0.0 {
                break;
            }
            let before = simulation.cycle();
            if before > 5.0 {
                crate::failpoint::hit("sixth cycle");
                crate::failpoint::stall("long step");
            }
            self.step();
            let simulation = self.run.simulation();
            let is_end = ends_cycle(before, simulation.cycle());
            let is_shown = if self.pace.shows_ends(simulation) {
                self.screen.is_due()
            } else {
                self.pace.shows_motion(simulation)
            };
            if is_end && is_shown {
                self.publish();
            }
        }
        let simulation = self.run.simulation();
        self.pace.measure(simulation, start.elapsed());
        let waits = self.pace.shows_ends(simulation) && !self.screen.is_due_after(AT_LEAST);
        self.run.step_cost = self.pace.step_cost;
        self.follow_with_twin(TWIN_STINT);
        if self.screen.is_due() && !waits || !self.pace.is_running() {
            self.publish();
        }
    }

    pub(super) fn step(&mut self) {
        if let Some(word) = self.branch() {
            self.renew();
            self.screen.notice(&word);
        }
        if self.run.simulation().steps() == 0 {
            self.past.store(&self.run);
        }
        self.pace.stepped = Instant::now();
        let before = self.run.cycle();
        if let Err(error) = self.run.step_until(self.goal()) {
            self.pace.activity = Activity::Stopped(error.to_string());
            return;
        }
        let cycle = self.run.cycle();
        if self.curves.contains(Curves::SPRINGS) {
            self.cycle_loads.note(self.run.simulation());
        }
        let is_running = self.pace.is_running();
        let (ends_cycle, is_end) = (ends_cycle(before, cycle), self.has_reached_end(before));
        if ends_cycle || is_end {
            // Manual steps are few, so the twin compares after each of them.
            self.compare_twin(is_end || !is_running);
        }
        self.ghosts.follow(cycle);
        if ends_cycle && self.past.stored.is_none_or(|at| at.elapsed() > APART) {
            self.past.store(&self.run);
        }
        let pace = &mut self.pace;
        let goes_on = pace.stop_at.is_some_and(|stop| stop > cycle);
        if is_end && is_running && !goes_on {
            (pace.activity, pace.is_end_known) = (Activity::Done, false);
        }
        if pace.stop_at.take_if(|stop| *stop <= cycle).is_some() {
            if pace.is_running() {
                pace.activity = Activity::Paused;
            }
            self.past.store(&self.run);
        }
    }

    /// Returns the cycle that the next step or jump must not pass: the planned end or, beyond it, the same distance
    /// again. Otherwise, once nothing wears any more, a jump would go so far that no comparison run by direct steps
    /// could follow.
    fn goal(&self) -> f64 {
        let simulation = self.run.simulation();
        let now = simulation.cycle();
        let goal = match self.run.session.loaded().run().cycles {
            Some(end) if now < end => self.run.session.heading(end),
            Some(end) if simulation.may_jump() => now + end.max(SHORTEST_PLAN).ceil(),
            _ => f64::INFINITY,
        };
        self.pace.stop_at.map_or(goal, |stop| goal.min(stop))
    }

    /// Whether the planned end lies between the cycle `before` and now.
    fn has_reached_end(&self, before: f64) -> bool {
        let simulation = self.run.simulation();
        let end = self.run.session.loaded().run().cycles;
        let end = end.map(|end| end - simulation.rounding());
        end.is_some_and(|end| before < end && simulation.cycle() >= end)
    }

    /// Pauses and steps until `is_done`, called with the cycles before and now, returns true.
    pub(super) fn step_manually(&mut self, is_done: fn(f64, f64) -> bool) {
        if matches!(self.pace.activity, Activity::Stopped(_)) {
            return self.screen.notice(BROKEN_DOWN);
        }
        (self.pace.activity, self.pace.stop_at) = (Activity::Paused, None);
        let before = self.run.cycle();
        loop {
            self.step();
            let has_stopped = self.pace.activity != Activity::Paused || self.is_over();
            if has_stopped || is_done(before, self.run.cycle()) {
                break;
            }
        }
        self.past.store(&self.run);
    }
}

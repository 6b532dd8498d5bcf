//! Whether and how fast the run steps: the requested and the actual speed.

use std::time::{Duration, Instant};

use super::BROKEN_DOWN;
use crate::plot::step::Step;
use crate::simulation::Simulation;
use crate::tui::frame::Activity;

/// The slowest rung of the ladder of paces.
const SLOWEST: i32 = -3;

/// The initial rung: half a cycle per second, slow enough to watch the rubbing.
const START: i32 = -1;

/// The rung without a limit.
const UNLIMITED: i32 = 15;

/// Above this pace, cycles per second, each frame would show an arbitrary phase of the motion, which would then seem to
/// creep or to run backwards.
const BLURRED: f64 = 2.0;

/// Returns the pace of a rung: 1, 2, 5, 10, … cycles per second; infinite for the last one.
fn pace_of(rung: i32) -> f64 {
    match rung {
        UNLIMITED.. => f64::INFINITY,
        _ => Step(rung).value(),
    }
}

/// Time between two cycle jumps, unless the pace is unlimited.
const JUMP_EVERY: Duration = Duration::from_millis(100);

/// Whether a run steps, and its speed, measured from some moment on. It decides when the next step is due, and at which
/// phase of the motion frames are taken.
#[derive(Debug)]
pub struct Pace {
    pub(super) activity: Activity,
    /// The cycle to which the run goes at full speed, to pause there.
    pub(super) stop_at: Option<f64>,
    /// Whether the user knows that the planned end is reached.
    pub(super) is_end_known: bool,
    rung: i32,
    /// Whether frames of a fast run are taken at a fixed phase of the motion.
    holds_phase: bool,
    /// When the last step began.
    pub(super) stepped: Instant,
    /// When the measurement began, and the cycle and steps of the run then.
    since: Instant,
    cycle: f64,
    steps: u64,
    /// The time spent in steps since then.
    busy: Duration,
    /// Cycles per second; `None` until measured.
    pub(super) speed: Option<f64>,
    /// Time per step, s; `None` until measured.
    pub(super) step_cost: Option<f64>,
}

impl Pace {
    /// The initial pace, of a run that steps or waits.
    pub(super) fn new(is_running: bool) -> Self {
        Self {
            activity: if is_running {
                Activity::Running
            } else {
                Activity::Paused
            },
            stop_at: None,
            is_end_known: false,
            rung: START,
            holds_phase: true,
            stepped: Instant::now(),
            since: Instant::now(),
            cycle: 0.0,
            steps: 0,
            busy: Duration::ZERO,
            speed: None,
            step_cost: None,
        }
    }

    /// Runs or pauses; returns a notice if it does neither.
    pub fn run_or_pause(&mut self) -> Option<&'static str> {
        self.stop_at = None;
        match self.activity {
            Activity::Running => self.activity = Activity::Paused,
            Activity::Done if !self.is_end_known => {
                self.is_end_known = true;
                return Some(
                    "planned end reached; Space again continues without limit, r restarts",
                );
            }
            Activity::Paused | Activity::Done => self.activity = Activity::Running,
            Activity::Stopped(_) => return Some(BROKEN_DOWN),
        }
        None
    }

    /// Toggles between frames at a fixed phase of the motion and frames at any phase; returns the notice about it.
    pub fn hold_or_release_phase(&mut self) -> Option<&'static str> {
        self.holds_phase ^= true;
        Some(if self.holds_phase {
            "above 2 cycles/s, all frames show the same phase of the motion"
        } else {
            "frames at any phase: in a fast run the motion seems to jump"
        })
    }

    pub(super) fn is_running(&self) -> bool {
        self.activity == Activity::Running
    }

    /// Returns the requested pace, cycles per second; infinite for no limit.
    pub(super) fn requested(&self) -> f64 {
        pace_of(self.rung)
    }

    /// Changes the pace by this many rungs.
    pub(super) fn change(&mut self, rungs: i32) {
        self.rung = (self.rung + rungs).clamp(SLOWEST, UNLIMITED);
    }

    /// Whether frames are taken at the end of a cycle, like rows of the history; otherwise they show the motion.
    pub(super) fn shows_ends(&self, simulation: &Simulation) -> bool {
        self.holds_phase && self.requested() > BLURRED && !simulation.may_jump()
    }

    /// Whether the motion can be followed. Frames then include the end of each cycle, so that what is held for a cycle is
    /// of the same phase each time.
    pub(super) fn shows_motion(&self, simulation: &Simulation) -> bool {
        self.requested() <= BLURRED && !simulation.may_jump()
    }

    /// Returns the seconds until the next step is due: 0 on the way to a cycle at full speed. A jump over many cycles is
    /// due a fixed time after the previous one: its length must not depend on the pace, or runs would not be
    /// repeatable.
    pub(super) fn ahead(&self, simulation: &Simulation) -> f64 {
        let pace = self.requested();
        if self.stop_at.is_some() {
            return 0.0;
        }
        if pace.is_finite() && simulation.may_jump() {
            return JUMP_EVERY.as_secs_f64() - self.stepped.elapsed().as_secs_f64();
        }
        let cycles = simulation.next_moment() - self.cycle;
        cycles / pace - self.since.elapsed().as_secs_f64()
    }

    /// Restarts the measurement at the present state, forgetting how far the run was ahead or behind.
    pub(super) fn restart(&mut self, simulation: &Simulation) {
        self.since = Instant::now();
        (self.cycle, self.steps) = (simulation.cycle(), simulation.steps());
        self.busy = Duration::ZERO;
    }

    /// Adds a stint of the run, which has led to the present state.
    pub(super) fn measure(&mut self, simulation: &Simulation, busy: Duration) {
        self.busy += busy;
        let elapsed = self.since.elapsed().as_secs_f64();
        if elapsed < 0.5 {
            return;
        }
        let taken = simulation.steps() - self.steps;
        self.speed = Some((simulation.cycle() - self.cycle) / elapsed);
        if taken > 0 {
            self.step_cost = Some(self.busy.as_secs_f64() / taken as f64);
        }
        // A machine too slow for the pace does not have to catch up.
        self.restart(simulation);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pace_goes_up_in_ones_twos_and_fives() {
        let paces: Vec<f64> = (0..7).map(pace_of).collect();
        assert_eq!(paces, [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0]);
        assert_eq!((pace_of(-1), pace_of(START)), (0.5, 0.5));
        assert_eq!(pace_of(UNLIMITED), f64::INFINITY);
        assert!(pace_of(1) <= BLURRED && pace_of(2) > BLURRED);
    }
}

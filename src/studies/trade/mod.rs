//! Speed against accuracy, measured: one scenario computed in many ways, each against a reference.
//!
//! A run is judged by the worst of its errors: of the worn depth (rms over the scar, in largest depths), of V and
//! E_d (relative), and of F_x (in μF_z). A run that fails its own checks is not recommended, whatever its errors.
//! The reference is the best method, twice as fine as the finest setting tried; its own distance from half as fine
//! is reported with it. The cost of `numerics.accuracy`, which finds its own level, is measured as well.

use std::time::Instant;

use crate::reading::Check;
use crate::scenario::Scenario;
use crate::scenario::session::{Session, SessionError};
use crate::studies::refinement::{self, Difference, Outcome};

pub mod report;
mod setting;

pub use setting::{POINTS, STEPS, Setting, reference, settings};

/// A run on the front is repeated until it has taken this long, s, and its median time counts.
const LONG_ENOUGH: f64 = 0.06;

/// The most repetitions.
const REPETITIONS: usize = 25;

/// How a run ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// What runs are compared by.
    outcome: Outcome,
    /// The permanent stick radius, m; NaN without one.
    stick_radius: f64,
    /// The contact radius, m.
    contact_radius: f64,
    /// The run's own checks that fail.
    failing: Vec<Check>,
    /// Time of one run with its set-up, s.
    pub seconds: f64,
    /// Transforms computed.
    pub transforms: u64,
    /// Steps and jumps taken.
    pub steps: u64,
}

/// How far a run is from the reference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// Of depth, volume, work and force.
    pub of_run: Difference,
    /// Of the permanent stick radius, in contact radii; it does not count towards the worst.
    pub stick_radius: f64,
}

impl Errors {
    /// The worst of depth, volume, work and force; NaN if one of them is.
    pub fn worst(&self) -> f64 {
        let Difference {
            worn_depth,
            volume,
            work,
            force,
            ..
        } = self.of_run;
        let errors = [worn_depth, volume, work, force];
        match errors.iter().any(|error| error.is_nan()) {
            true => f64::NAN,
            false => errors.into_iter().fold(0.0, f64::max),
        }
    }
}

impl Sample {
    /// The present moment of a run that has taken `seconds`.
    pub fn of(session: &Session, seconds: f64) -> Self {
        let simulation = session.simulation();
        let moment = simulation.moment();
        let mut failing = simulation.checks();
        failing.retain(|check| !check.holds());
        Self {
            outcome: Outcome::of(session),
            stick_radius: moment.permanent_stick_radius.unwrap_or(f64::NAN),
            contact_radius: moment.contact_radius,
            failing,
            seconds,
            transforms: simulation.stats().transforms,
            steps: simulation.steps(),
        }
    }

    /// Drops the failing checks that fail in the `reference` too: the setting is not their cause.
    pub fn judged_by(mut self, reference: &Self) -> Self {
        let others = &reference.failing;
        let is_common = |check: &Check| others.iter().any(|other| other.subject == check.subject);
        self.failing.retain(|check| !is_common(check));
        self
    }

    /// The differences of this run from another one.
    pub fn against(&self, reference: &Self) -> Errors {
        let stick = (self.stick_radius - reference.stick_radius).abs();
        Errors {
            of_run: self.outcome.against(&reference.outcome),
            stick_radius: stick / reference.contact_radius,
        }
    }
}

/// Runs `scenario` by `setting` over `cycles`; `None` if `go_on`, which is asked at every step, says no.
pub fn run(
    scenario: &Scenario,
    setting: &Setting,
    cycles: f64,
    go_on: &dyn Fn() -> bool,
) -> Option<Result<Sample, SessionError>> {
    let scenario = match setting.of(scenario) {
        Ok(scenario) => scenario,
        Err(error) => return Some(Err(error.into())),
    };
    let start = Instant::now();
    let session = refinement::run(&scenario, cycles, go_on)?;
    let seconds = start.elapsed().as_secs_f64();
    Some(session.map(|session| Sample::of(&session, seconds)))
}

/// The median time of one run, s, of as many as a clock needs, after `first` seconds were measured once.
pub fn median_time(
    scenario: &Scenario,
    setting: &Setting,
    cycles: f64,
    first: f64,
    go_on: &dyn Fn() -> bool,
) -> f64 {
    let mut times = vec![first];
    while times.iter().sum::<f64>() < LONG_ENOUGH && times.len() < REPETITIONS {
        match run(scenario, setting, cycles, go_on) {
            Some(Ok(sample)) => times.push(sample.seconds),
            _ => break,
        }
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

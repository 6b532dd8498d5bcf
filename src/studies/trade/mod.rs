//! Speed against accuracy, measured: one scenario computed in many ways, each against a reference.
//!
//! The error is that of the worn profile at the end, at 401 radii in equal distances over the
//! domain: its rms and its largest value, in units of the largest depth; also the errors of the
//! permanent stick radius, in contact radii, and of the worn volume, relative. The reference is the
//! best method, twice as fine as the finest setting tried; its own distance from half as fine is
//! reported with it. What `numerics.accuracy` costs, which finds its level by itself, is measured beside.

use std::time::Instant;

use crate::math::abel::worn;
use crate::scenario::Scenario;
use crate::scenario::session::{Session, SessionError};
use crate::studies::refinement::{self, Level, Outcome, RefinementError, Verdict};

pub mod report;
mod setting;

pub use setting::{Ladder, POINTS, STEPS, Setting, TOLERANCES};

/// Radii at which profiles are compared.
const RADII: usize = 401;

/// A run is repeated until it has taken this long, s, and its median time counts.
const LONG_ENOUGH: f64 = 0.06;

/// The most repetitions.
const REPETITIONS: usize = 25;

/// How a run ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// The worn depth at equidistant radii, in units of the largest depth.
    worn: Vec<f64>,
    /// The permanent stick radius, m; NaN without one.
    stick_radius: f64,
    /// The contact radius, m.
    contact_radius: f64,
    /// m³.
    volume: f64,
    /// The scar, as an accuracy sees it.
    outcome: Outcome,
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
    /// Of the profile, rms, in largest depths.
    pub rms: f64,
    /// Of the profile, largest, in largest depths.
    pub largest: f64,
    /// Of the permanent stick radius, in contact radii.
    pub stick_radius: f64,
    /// Of the worn volume, relative to it.
    pub volume: f64,
    /// What `numerics.accuracy` is held against: the larger of the errors of the scar and of its volume.
    pub scar: f64,
}

impl Sample {
    /// The differences of this run from another one.
    pub fn against(&self, reference: &Self) -> Errors {
        let differences = || {
            self.worn
                .iter()
                .zip(&reference.worn)
                .map(|(a, b)| (a - b).abs())
        };
        let sum: f64 = differences().map(|error| error * error).sum();
        Errors {
            rms: (sum / RADII as f64).sqrt(),
            largest: differences().fold(0.0, f64::max),
            stick_radius: (self.stick_radius - reference.stick_radius).abs()
                / reference.contact_radius,
            volume: (self.volume / reference.volume - 1.0).abs(),
            scar: self.outcome.against(&reference.outcome).promised(),
        }
    }
}

/// Runs `scenario` by `setting` over `cycles`, and again while that is quick. `go_on` is told after each
/// cycle what share of the run is done; if it says no, there is no result.
pub fn run(
    scenario: &Scenario,
    setting: &Setting,
    cycles: f64,
    go_on: &dyn Fn(f64) -> bool,
) -> Option<Result<Sample, SessionError>> {
    let (mut times, mut all) = (Vec::new(), 0.0);
    loop {
        let sample = match run_once(scenario, setting, cycles, go_on)? {
            Ok(sample) => sample,
            Err(error) => return Some(Err(error)),
        };
        all += sample.seconds;
        times.push(sample.seconds);
        if all >= LONG_ENOUGH || times.len() == REPETITIONS {
            times.sort_by(f64::total_cmp);
            return Some(Ok(Sample {
                seconds: times[times.len() / 2],
                ..sample
            }));
        }
    }
}

/// What `numerics.accuracy` costs and reaches.
#[derive(Debug, Clone, PartialEq)]
pub struct Adaptive {
    /// The accuracy asked for.
    pub accuracy: f64,
    /// The last level.
    pub level: Level,
    /// Whether the accuracy was met, or why not.
    pub verdict: Verdict,
    /// The last level's run; the time is that of all levels.
    pub sample: Sample,
}

/// Runs `scenario` over `cycles` to an accuracy, for `budget` seconds at most.
///
/// # Errors
/// If no level runs to its end, or `go_on` says no.
pub fn adaptive(
    scenario: &Scenario,
    accuracy: f64,
    cycles: f64,
    budget: f64,
    go_on: &dyn Fn() -> bool,
) -> Result<Adaptive, RefinementError> {
    let reached = refinement::run_to_accuracy(scenario, cycles, accuracy, budget, go_on)?;
    Ok(Adaptive {
        accuracy,
        level: reached.rung.level,
        sample: sample(&reached.session, reached.seconds),
        verdict: reached.verdict,
    })
}

/// The same once, for who counts work and not time.
pub fn run_once(
    scenario: &Scenario,
    setting: &Setting,
    cycles: f64,
    go_on: &dyn Fn(f64) -> bool,
) -> Option<Result<Sample, SessionError>> {
    let scenario = match setting.of(scenario) {
        Ok(scenario) => scenario,
        Err(error) => return Some(Err(error.into())),
    };
    let start = Instant::now();
    let session = one_run(&scenario, cycles, go_on)?;
    let seconds = start.elapsed().as_secs_f64();
    Some(session.map(|session| sample(&session, seconds)))
}

fn one_run(
    scenario: &Scenario,
    cycles: f64,
    go_on: &dyn Fn(f64) -> bool,
) -> Option<Result<Session, SessionError>> {
    let mut session = match Session::start(scenario.clone()) {
        Ok(session) => session,
        Err(error) => return Some(Err(error)),
    };
    while session.simulation().cycle() < cycles {
        if !go_on(session.simulation().cycle() / cycles) {
            return None;
        }
        // A cycle at a time: a stop is seen soon, and asking costs nothing.
        let cycle = session.simulation().cycle();
        let outcome = if session.simulation().may_jump() {
            session.step_until(cycles)
        } else {
            session.advance_to((cycle.floor() + 1.0).min(cycles))
        };
        if let Err(error) = outcome {
            return Some(Err(error));
        }
    }
    Some(Ok(session))
}

fn sample(session: &Session, seconds: f64) -> Sample {
    let simulation = session.simulation();
    let setup = simulation.setup();
    let moment = simulation.moment();
    let depth = setup.depth_scale(moment.depth);
    let radius = |i: usize| setup.grid.radius() * (i as f64 / (RADII - 1) as f64);
    Sample {
        worn: (0..RADII)
            .map(|i| worn::interpolate(&setup.grid, simulation.worn_depth(), radius(i)) / depth)
            .collect(),
        stick_radius: moment.permanent_stick_radius.unwrap_or(f64::NAN),
        contact_radius: moment.contact_radius,
        volume: moment.wear_volume,
        outcome: Outcome::of(session),
        seconds,
        transforms: simulation.stats().transforms,
        steps: simulation.steps(),
    }
}

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
    transforms: u64,
    /// Steps and jumps taken.
    steps: u64,
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

    /// The differences of this run from another one.
    pub fn against(&self, reference: &Self) -> Difference {
        self.outcome.against(&reference.outcome)
    }
}

/// A run with its errors.
#[derive(Debug, Clone, PartialEq)]
pub struct Judged {
    /// The run; of its failing checks those that hold in the reference, as the setting is not the others' cause.
    pub sample: Sample,
    /// How far it is from the reference.
    pub errors: Difference,
    /// How far the permanent stick radius is, in contact radii; it does not count towards the worst.
    stick_error: f64,
}

/// One setting, and how it did.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// The setting.
    pub setting: Setting,
    /// The run and its errors, or why there is none.
    pub outcome: Result<Judged, String>,
}

impl Trial {
    /// Judges how a run by `setting` ended.
    pub fn new(setting: Setting, ended: Result<Sample, SessionError>, reference: &Sample) -> Self {
        let judged = ended.map(|mut sample| {
            let others = &reference.failing;
            let is_common = |check: &Check| others.iter().any(|one| one.subject == check.subject);
            sample.failing.retain(|check| !is_common(check));
            let stick_error = (sample.stick_radius - reference.stick_radius).abs();
            Judged {
                errors: sample.against(reference),
                stick_error: stick_error / reference.contact_radius,
                sample,
            }
        });
        Self {
            setting,
            outcome: judged.map_err(|error| error.to_string()),
        }
    }

    /// Time and worst error of a run that reached its end and passes its own checks.
    pub fn point(&self) -> Option<[f64; 2]> {
        let judged = self.outcome.as_ref().ok()?;
        let worst = judged.errors.worst();
        let is_sound = judged.sample.failing.is_empty() && worst.is_finite();
        is_sound.then_some([judged.sample.seconds, worst])
    }

    /// Repeats the run of `cycles` as often as a clock needs, and takes the median time.
    pub fn time_well(&mut self, scenario: &Scenario, cycles: f64, go_on: &dyn Fn() -> bool) {
        let Ok(judged) = &mut self.outcome else {
            return;
        };
        let mut times = vec![judged.sample.seconds];
        while times.iter().sum::<f64>() < LONG_ENOUGH && times.len() < REPETITIONS {
            match run(scenario, &self.setting, cycles, go_on) {
                Ok(sample) => times.push(sample.seconds),
                Err(_) => break,
            }
        }
        times.sort_by(f64::total_cmp);
        judged.sample.seconds = times[times.len() / 2];
    }
}

/// Runs `scenario` by `setting` over `cycles`, as long as `go_on`, which is asked at every step, says so.
///
/// # Errors
/// If the run stops, or is [interrupted](SessionError::Interrupted).
pub fn run(
    scenario: &Scenario,
    setting: &Setting,
    cycles: f64,
    go_on: &dyn Fn() -> bool,
) -> Result<Sample, SessionError> {
    let scenario = setting.of(scenario)?;
    let start = Instant::now();
    let session = refinement::run(&scenario, cycles, go_on)?;
    Ok(Sample::of(&session, start.elapsed().as_secs_f64()))
}

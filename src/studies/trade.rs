//! Measures speed against accuracy: computes one scenario in many ways, and compares each with a reference.
//!
//! A run is judged by the worst of its errors: of the worn depth (rms over the scar, in largest depths), of V and E_d
//! (relative), and of F_x (in μF_z). A run that fails its own checks is not recommended, whatever its errors. The
//! reference is a run of the best method, refined until its own estimated error is a third of the smallest accuracy in
//! question, as far as time allows; that error is reported with it, and added to the measured ones. The cost of
//! `numerics.accuracy`, which finds its own level, is measured as well.

use std::fmt::{self, Display, Formatter};
use std::time::Instant;

use crate::math::abel::AbelMethod;
use crate::reading::{CheckSubject, Moment, Quantity};
use crate::scenario::key::Key;
use crate::scenario::scalars::Value;
use crate::scenario::session::{Session, SessionError};
use crate::scenario::spec::{Numerics, Spec};
use crate::scenario::{Refusal, Scenario, value};
use crate::simulation::{Integrator, Scheme};
use crate::studies::refinement::{self, Level, Outcome, Reached};
use crate::studies::table::Rows;

/// Numbers of cells to try.
pub const POINTS: [usize; 3] = [25, 50, 100];

/// Steps per cycle to try.
pub const STEPS: [u32; 3] = [12, 25, 50];

/// Tolerances of jumps to try, the finest last.
const TOLERANCES: [f64; 5] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5];

/// Steps per cycle with jumps, for all methods except the best.
const STEPS_UNDER_JUMPS: u32 = 50;

/// Runs are repeated until they have taken this long, s; their median time counts.
const LONG_ENOUGH: f64 = 0.03;

/// Maximum number of repetitions.
const REPETITIONS: usize = 25;

/// A method, its scheme, and its resolution.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// The transforms; they determine the grid.
    pub method: AbelMethod,
    /// The time-stepping scheme.
    pub scheme: Scheme,
    /// Cells, steps and jumps.
    pub level: Level,
}

impl Display for Candidate {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let Level { points, steps, .. } = self.level;
        write!(f, "{}, N = {points}, {steps} steps", self.method)
    }
}

impl Candidate {
    fn set(&self, numerics: &mut Numerics) {
        (numerics.method, numerics.scheme) = (Some(self.method), Some(self.scheme));
        self.level.set(numerics);
    }

    /// The scenario computed so.
    ///
    /// # Errors
    /// If the scenario's shape does not allow the method or this many cells.
    pub fn of_scenario(&self, scenario: &Scenario) -> Result<Scenario, Refusal> {
        scenario.edited(|spec| self.set(&mut spec.numerics))
    }

    /// Estimates the work per cycle, in kernel values.
    fn effort(&self) -> f64 {
        let nodes = self.level.points as f64;
        f64::from(self.level.steps) * (nodes * nodes + 60.0 * nodes + 1500.0)
    }

    /// Returns the same as options of `run`.
    pub fn assignments(&self) -> Vec<String> {
        let mut spec = Spec::default();
        self.set(&mut spec.numerics);
        let keys = Spec::default().diff(&spec).into_iter();
        let set =
            |(key, value): (Key, value::Value)| format!("--set {}={}", key.path, value.bare());
        keys.map(set).collect()
    }

    /// Runs `scenario` with this setting over `cycles`, while `go_on`, called at every step, returns true, and often
    /// enough for the clock. Returns its end and its time, s.
    ///
    /// # Errors
    /// If the run stops, or is [interrupted](SessionError::Interrupted).
    pub fn run(
        &self,
        scenario: &Scenario,
        cycles: f64,
        go_on: &dyn Fn() -> bool,
    ) -> Result<(Session, f64), SessionError> {
        let scenario = self.of_scenario(scenario)?;
        let mut times = Vec::new();
        loop {
            let start = Instant::now();
            let session = refinement::run(&scenario, cycles, go_on)?;
            times.push(start.elapsed().as_secs_f64());
            if times.iter().sum::<f64>() >= LONG_ENOUGH || times.len() == REPETITIONS {
                times.sort_by(f64::total_cmp);
                return Ok((session, times[times.len() / 2]));
            }
        }
    }
}

/// Returns all settings of these methods, cells and steps, the cheapest first. If cycles are alike, the best method is
/// also tried with jumps; a scenario that asks for jumps is not tried without.
pub fn settings(
    scenario: &Scenario,
    methods: &[AbelMethod],
    points: &[usize],
    steps: &[u32],
) -> Vec<Candidate> {
    let setup = scenario.setup();
    let wants_jumps = wants_jumps(scenario);
    let repeats = setup.drive.repeats_after().is_some() && setup.wear.is_some();
    let mut settings = Vec::new();
    let known = AbelMethod::for_geometry(setup.geometry);
    let of_method = |&method| Scheme::ALL.map(|scheme| (method, scheme));
    for (method, scheme) in methods
        .iter()
        .filter(|of| known.contains(of))
        .flat_map(of_method)
    {
        let is_best = method == AbelMethod::default() && scheme == Scheme::Trapezoid;
        let mut tolerances = if wants_jumps { vec![] } else { vec![None] };
        if repeats && (is_best || wants_jumps) {
            tolerances.extend(TOLERANCES.map(Some));
        }
        for tolerance in tolerances {
            let steps = match tolerance {
                Some(_) if !is_best => &[STEPS_UNDER_JUMPS],
                _ => steps,
            };
            for &steps in steps {
                settings.extend(points.iter().map(|&points| Candidate {
                    method,
                    scheme,
                    level: Level::new(points, steps, tolerance),
                }));
            }
        }
    }
    settings.sort_by(|a, b| a.effort().total_cmp(&b.effort()));
    settings
}

/// Returns the scenario with the best method and scheme, leaving cells and steps open to a search.
///
/// # Errors
/// If its shape does not allow that method.
pub fn by_the_best(scenario: &Scenario) -> Result<Scenario, Refusal> {
    scenario.edited(|spec| {
        spec.numerics.method = Some(AbelMethod::default());
        spec.numerics.scheme = Some(Scheme::Trapezoid);
    })
}

/// Describes the run that settings are compared with, whose own error is known.
pub fn describe_reference(reference: &Reached) -> String {
    let Level { points, steps, .. } = reference.rung.level;
    format!(
        "N = {points}, {steps} steps per cycle, found in {:.1e} s; its own error is {:.1e} at worst",
        reference.seconds,
        reference.error.promised()
    )
}

/// Whether the user asks for jumps; jumps chosen by an accuracy do not count.
fn wants_jumps(scenario: &Scenario) -> bool {
    scenario.setup().integrator != Integrator::Direct
        && scenario.spec().numerics.integrator.is_some()
}

/// One setting and its performance.
#[derive(Debug, Clone)]
pub struct Trial {
    /// The setting.
    pub setting: Candidate,
    /// Time including set-up, s, and an upper bound on its error: the worst one against the reference plus the
    /// reference's own; `None` unless the run reached its end and passes its own checks.
    pub point: Option<[f64; 2]>,
    /// Its row, up to the mark of the Pareto front.
    row: Vec<Value>,
}

/// A trial with its time and its worst error.
pub type Timed<'a> = (&'a Trial, [f64; 2]);

impl Trial {
    /// Judges a run with `setting`. Checks that fail in the `reference` as well do not count, since the setting is not
    /// their cause.
    pub fn new(
        setting: Candidate,
        ended: Result<(Session, f64), SessionError>,
        reference: &Reached,
    ) -> Self {
        let (level, tolerance) = (&setting.level, setting.level.tolerance);
        let mut row: Vec<Value> = vec![
            setting.method.name().into(),
            setting.scheme.name().into(),
            Integrator::NAMES[usize::from(tolerance.is_some())].into(),
            level.points.into(),
            level.steps.into(),
            tolerance.into(),
        ];
        let mut point = None;
        match ended {
            Err(error) => {
                row.resize(row.len() + 3, Value::Null);
                // Replaces the errors and the checks.
                row.push(error.to_string().into());
                row.resize(row.len() + 5, Value::Null);
            }
            Ok((session, seconds)) => {
                let errors =
                    Outcome::from_session(&session).difference_from(&reference.rung.outcome);
                let complaints = complaints(&session, &reference.rung.session);
                if complaints.is_empty() && errors.promised().is_finite() {
                    point = Some([seconds, errors.promised() + reference.error.promised()]);
                }
                let simulation = session.simulation();
                let (moment, exact) = (
                    simulation.moment(),
                    reference.rung.session.simulation().moment(),
                );
                let radius = |of: &Moment| of.permanent_stick_radius.unwrap_or(f64::NAN);
                // In contact radii; not counted towards the worst error.
                let stick = (radius(&moment) - radius(&exact)).abs() / exact.contact_radius;
                row.push(seconds.into());
                row.push(simulation.steps().into());
                row.push(simulation.stats().transforms.into());
                let finite = |error: f64| Some(error).filter(|error| error.is_finite());
                let quantities = [
                    Quantity::WornDepth,
                    Quantity::Volume,
                    Quantity::Energy,
                    Quantity::Force,
                ];
                let quantities = quantities.into_iter().map(|of| errors[of]);
                row.extend(quantities.chain([stick]).map(|error| finite(error).into()));
                row.push(if complaints.is_empty() {
                    "ok".into()
                } else {
                    complaints.join(", ").into()
                });
            }
        }
        Self {
            setting,
            point,
            row,
        }
    }
}

/// Returns the checks that fail in a run, but not in the reference.
fn complaints(session: &Session, reference: &Session) -> Vec<String> {
    let failing = |session: &Session| {
        let checks = session.checks().into_iter();
        checks.filter(|check| !check.holds())
    };
    let common: Vec<CheckSubject> = failing(reference).map(|check| check.subject).collect();
    let own = failing(session).filter(|check| !common.contains(&check.subject));
    own.map(|check| check.complaint()).collect()
}

/// Returns the trials that no other one beats in both time and error, the fastest first.
pub fn front<'a>(trials: impl IntoIterator<Item = &'a Trial>) -> Vec<Timed<'a>> {
    let timed = |trial: &'a Trial| Some((trial, trial.point?));
    let mut sorted: Vec<Timed> = trials.into_iter().filter_map(timed).collect();
    sorted.sort_by(|(_, a), (_, b)| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut best = f64::INFINITY;
    sorted.retain(|(_, [_, error])| {
        let is_better = *error < best;
        best = best.min(*error);
        is_better
    });
    sorted
}

/// Returns the fastest trial whose worst error is at most `accuracy`.
pub fn cheapest(trials: &[Trial], accuracy: f64) -> Option<Timed<'_>> {
    let mut front = front(trials).into_iter();
    front.find(|(_, [_, error])| *error <= accuracy)
}

/// Makes a table with one row per trial of `shown`, marking those on the front of `all`.
pub fn table<'a>(shown: impl IntoIterator<Item = &'a Trial>, all: &[Trial]) -> Rows {
    let of_run =
        "method scheme integrator points steps_per_cycle tolerance time_s steps transforms";
    let errors = "error_rms volume_error work_error force_error stick_error";
    let mut table = Rows::with_columns(&[
        ("", of_run),
        ("against the reference", errors),
        ("", "checks front"),
    ]);
    let front = front(all);
    for trial in shown {
        let is_on_it = front.iter().any(|(other, _)| std::ptr::eq(*other, trial));
        let mark = if is_on_it { "*" } else { "" };
        table.push([&trial.row[..], &[mark.into()]].concat());
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studies::refinement::{Difference, Rung, Verdict};

    fn trial(points: usize, seconds: f64, worst: f64) -> Trial {
        Trial {
            setting: Candidate {
                method: AbelMethod::A,
                scheme: Scheme::Euler,
                level: Level::new(points, 100, None),
            },
            point: Some([seconds, worst]),
            row: vec![Value::Null; 15],
        }
    }

    fn reference(session: Session) -> Reached {
        Reached {
            rung: Rung {
                outcome: Outcome::from_session(&session),
                level: Level::from_scenario(session.scenario()),
                session,
                seconds: 0.0,
            },
            error: Difference::default(),
            verdict: Verdict::Met,
            seconds: 0.0,
        }
    }

    #[test]
    fn the_front_is_what_nothing_beats() {
        let session = Session::start(Scenario::load("hertz", &[]).expect("a preset"));
        let reference = reference(session.expect("a session"));
        let judged = |points, ended| Trial::new(trial(points, 0.0, 0.0).setting, ended, &reference);
        let trials = [
            trial(1, 1.0, 1e-2),
            trial(2, 0.5, 3e-2),
            trial(3, 2.0, 2e-2),
            trial(4, 3.0, 1e-3),
            trial(5, 3.0, 2e-3),
            judged(6, Err(SessionError::Unfinished("broke".into()))),
            // The fastest and most accurate trial, which fails its own checks.
            Trial {
                point: None,
                ..trial(7, 0.01, 1e-6)
            },
        ];
        let points = |(trial, _): Timed| trial.setting.level.points;
        let found: Vec<usize> = front(&trials).into_iter().map(points).collect();
        assert_eq!(found, [2, 1, 4]);
        assert_eq!(cheapest(&trials, 1e-2).map(points), Some(1));
        assert_eq!(cheapest(&trials, 5e-3).map(points), Some(4));
        assert!(cheapest(&trials, 1e-4).is_none());
        let table = table(&trials, &trials);
        let rows = &table.rows;
        let stars = rows.iter().filter(|row| row[15] == "*");
        assert_eq!(stars.count(), 3);
        assert!(table.text(2).contains("broke"));
        // Without tangential motion there is no stick radius; errors of a missing scar do not count.
        let judged = judged(8, Ok((reference.rung.session.clone(), 0.1)));
        assert_eq!(judged.row[13], Value::Null);
    }

    #[test]
    fn what_the_reference_fails_too_is_not_held_against_a_setting() {
        let scenario = Scenario::load("li2019-fig3", &["numerics.points=20".into()]);
        let scenario = scenario.expect("a preset");
        let setting = &settings(&scenario, &[AbelMethod::Benad], &[20], &[4])[0];
        let run = |cycles: f64| setting.run(&scenario, cycles, &|| true).expect("a run");
        let (coarse, unworn) = (run(3.0), run(0.0).0);
        let judged = |against| Trial::new(setting.clone(), Ok(coarse.clone()), &reference(against));
        let alone = judged(unworn);
        assert!(alone.point.is_none());
        let said = alone.row.last().and_then(Value::as_str).expect("words");
        assert!(said.starts_with("energy off by "), "{said}");
        let again = judged(coarse.0.clone());
        assert_eq!(again.row.last(), Some(&Value::from("ok")));
        assert!(again.point.is_some());
    }
}

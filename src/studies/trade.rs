//! Speed against accuracy, measured: one scenario computed in many ways, each against a reference.
//!
//! A run is judged by the worst of its errors: of the worn depth (rms over the scar, in largest depths), of V and
//! E_d (relative), and of F_x (in μF_z). A run that fails its own checks is not recommended, whatever its errors.
//! The reference is the best method, twice as fine as the finest setting tried; its own distance from half as fine
//! is reported with it. The cost of `numerics.accuracy`, which finds its own level, is measured as well.

use std::fmt::{self, Display, Formatter};
use std::time::Instant;

use crate::math::abel::AbelMethod;
use crate::reading::{Check, Subject};
use crate::scenario::Scenario;
use crate::scenario::session::{Session, SessionError};
use crate::simulation::{Integrator, Scheme};
use crate::studies::refinement::{self, Difference, Level, Outcome};
use crate::studies::table::{Cell, Format, Table};

/// Numbers of cells that are tried.
pub const POINTS: [usize; 3] = [25, 50, 100];

/// Steps per cycle that are tried.
pub const STEPS: [u32; 3] = [12, 25, 50];

/// Tolerances of jumps that are tried.
const TOLERANCES: [f64; 5] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5];

/// Steps per cycle under jumps by any but the best method.
const STEPS_UNDER_JUMPS: u32 = 50;

/// A run on the front is repeated until it has taken this long, s, and its median time counts.
const LONG_ENOUGH: f64 = 0.06;

/// The most repetitions.
const REPETITIONS: usize = 25;

/// A method, its scheme, and how fine.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// The transforms; the grid is the one that goes with them.
    pub method: AbelMethod,
    /// How a step is taken.
    pub scheme: Scheme,
    /// Cells, steps and jumps.
    pub level: Level,
}

impl Display for Setting {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let Level { points, steps, .. } = self.level;
        write!(f, "{}, N = {points}, {steps} steps", self.method)
    }
}

impl Setting {
    /// The keys of a scenario and their values.
    pub fn keys(&self) -> Vec<(&'static str, String)> {
        let mut keys = vec![
            ("numerics.method", self.method.name().to_owned()),
            ("numerics.scheme", self.scheme.name().to_owned()),
        ];
        keys.extend(self.level.keys());
        keys
    }

    /// An estimate of the work of a run of `cycles`, in kernel values.
    pub fn effort(&self, cycles: f64) -> f64 {
        let cycles = match self.level.tolerance {
            // What a jump looks at hardly depends on how far it goes.
            Some(tolerance) => cycles.min(60.0 * tolerance.powf(-0.25)),
            None => cycles,
        };
        let nodes = self.level.points as f64;
        cycles * f64::from(self.level.steps) * (nodes * nodes + 60.0 * nodes + 1500.0)
    }

    /// Runs `scenario` so over `cycles`, as long as `go_on`, which is asked at every step, says so; its end, and the
    /// time it took, s.
    ///
    /// # Errors
    /// If the run stops, or is [interrupted](SessionError::Interrupted).
    pub fn run(
        &self,
        scenario: &Scenario,
        cycles: f64,
        go_on: &dyn Fn() -> bool,
    ) -> Result<(Session, f64), SessionError> {
        let scenario = scenario.with_all(&self.keys())?;
        let start = Instant::now();
        let session = refinement::run(&scenario, cycles, go_on)?;
        Ok((session, start.elapsed().as_secs_f64()))
    }
}

/// Every setting of these methods, cells and steps, the cheapest first. Where cycles are alike they are tried with
/// jumps as well, by the best method; a scenario that asks for jumps is not tried without.
pub fn settings(
    scenario: &Scenario,
    methods: &[AbelMethod],
    points: &[usize],
    steps: &[u32],
) -> Vec<Setting> {
    let setup = scenario.setup();
    let wants_jumps = wants_jumps(scenario);
    let repeats = setup.drive.repeats_after().is_some() && setup.wear.is_some();
    let schemes = |method: &AbelMethod| Scheme::ALL.map(|scheme| (*method, scheme));
    let mut settings = Vec::new();
    for (method, scheme) in methods.iter().flat_map(schemes) {
        let is_best = method == AbelMethod::Product && scheme == Scheme::Trapezoid;
        let mut ways: Vec<(u32, Option<f64>)> = Vec::new();
        if !wants_jumps {
            ways.extend(steps.iter().map(|&steps| (steps, None)));
        }
        if repeats && (is_best || wants_jumps) {
            let steps = if is_best { steps } else { &[STEPS_UNDER_JUMPS] };
            let jumps = |&steps| TOLERANCES.map(|tolerance| (steps, Some(tolerance)));
            ways.extend(steps.iter().flat_map(jumps));
        }
        for (steps, tolerance) in ways {
            let level = |&points| level(points, steps, tolerance);
            settings.extend(points.iter().map(level).map(|level| Setting {
                method,
                scheme,
                level,
            }));
        }
    }
    settings.sort_by(|a, b| a.effort(1.0).total_cmp(&b.effort(1.0)));
    settings
}

/// The reference: twice as fine as the finest of these cells and steps, by the best method.
pub fn reference(scenario: &Scenario, points: &[usize], steps: &[u32]) -> Setting {
    let points = points.iter().copied().max().unwrap_or(100);
    let steps = steps.iter().copied().max().unwrap_or(100);
    let finest = TOLERANCES.into_iter().fold(1.0, f64::min);
    let tolerance = wants_jumps(scenario).then_some(0.1 * finest);
    Setting {
        method: AbelMethod::Product,
        scheme: Scheme::Trapezoid,
        level: level(2 * points, 2 * steps, tolerance),
    }
}

fn level(points: usize, steps: u32, tolerance: Option<f64>) -> Level {
    Level {
        points,
        steps,
        tolerance,
        nodes: None,
    }
}

/// Whether the user asks for jumps; an accuracy that chooses them does not.
fn wants_jumps(scenario: &Scenario) -> bool {
    scenario.setup().integrator != Integrator::Direct
        && scenario.value("numerics.integrator").is_some()
}

/// One setting, and how it did.
#[derive(Debug, Clone)]
pub struct Trial {
    /// The setting.
    pub setting: Setting,
    /// What came of the run, or why nothing did.
    ended: Result<Ended, String>,
}

/// A run that reached its end.
#[derive(Debug, Clone)]
struct Ended {
    /// Time with its set-up, s.
    seconds: f64,
    /// How far it is from the reference.
    errors: Difference,
    /// Whether it passes its own checks.
    is_sound: bool,
    /// Its results as cells of the table.
    cells: Vec<Cell>,
}

impl Trial {
    /// Judges how a run by `setting` ended. Checks that fail in the `reference` too do not count: the setting is not
    /// their cause.
    pub fn new(
        setting: Setting,
        ended: Result<(Session, f64), SessionError>,
        reference: &Session,
    ) -> Self {
        let failing = |session: &Session| {
            let checks = session.simulation().checks().into_iter();
            checks.filter(|check| !check.holds())
        };
        let common: Vec<Subject> = failing(reference).map(|check| check.subject).collect();
        let ended = ended.map(|(session, seconds)| {
            let failing = failing(&session).filter(|check| !common.contains(&check.subject));
            let failing: Vec<Check> = failing.collect();
            let errors = Outcome::of(&session).against(&Outcome::of(reference));
            Ended {
                seconds,
                errors,
                is_sound: failing.is_empty(),
                cells: results(&session, reference, &errors, &failing),
            }
        });
        Self {
            setting,
            ended: ended.map_err(|error| error.to_string()),
        }
    }

    /// Time and worst error of a run that reached its end and passes its own checks.
    pub fn point(&self) -> Option<[f64; 2]> {
        let ended = self.ended.as_ref().ok()?;
        let worst = ended.errors.worst();
        (ended.is_sound && worst.is_finite()).then_some([ended.seconds, worst])
    }

    /// Repeats the run of `cycles` as often as a clock needs, and takes the median time.
    pub fn time_well(&mut self, scenario: &Scenario, cycles: f64, go_on: &dyn Fn() -> bool) {
        let Ok(ended) = &mut self.ended else {
            return;
        };
        let mut times = vec![ended.seconds];
        while times.iter().sum::<f64>() < LONG_ENOUGH && times.len() < REPETITIONS {
            match self.setting.run(scenario, cycles, go_on) {
                Ok((_, seconds)) => times.push(seconds),
                Err(_) => break,
            }
        }
        times.sort_by(f64::total_cmp);
        ended.seconds = times[times.len() / 2];
    }
}

/// A trial with its time and its worst error.
pub type Timed<'a> = (&'a Trial, [f64; 2]);

/// The trials that no other one beats in both time and error, the fastest first.
pub fn front<'a>(trials: impl IntoIterator<Item = &'a Trial>) -> Vec<Timed<'a>> {
    let timed = |trial: &'a Trial| Some((trial, trial.point()?));
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

/// The fastest trial whose worst error is at most `accuracy`.
pub fn cheapest(trials: &[Trial], accuracy: f64) -> Option<Timed<'_>> {
    let mut front = front(trials).into_iter();
    front.find(|(_, [_, error])| *error <= accuracy)
}

/// A heading over the columns of errors.
const ERRORS: &str = "against the reference";

/// The columns: a heading over some of them, names, and how they are written.
const COLUMNS: [(&str, &str, Format); 6] = [
    ("", "method scheme integrator", Format::Words),
    ("", "points steps_per_cycle", Format::Count),
    ("", "tolerance time_s", Format::Rough),
    ("", "steps transforms", Format::Count),
    (
        ERRORS,
        "error_rms volume_error work_error force_error stick_error",
        Format::Rough,
    ),
    ("", "checks front", Format::Words),
];

/// One row per trial of `shown`, with a mark if it is on the front of all.
pub fn table<'a>(shown: impl IntoIterator<Item = &'a Trial>, all: &[Trial]) -> Table {
    let mut table = Table::of(&COLUMNS);
    let front = front(all);
    for trial in shown {
        let level = &trial.setting.level;
        let jumps = usize::from(level.tolerance.is_some());
        let mut row = vec![
            trial.setting.method.name().into(),
            trial.setting.scheme.name().into(),
            Integrator::NAMES[jumps].into(),
            level.points.into(),
            (level.steps as usize).into(),
            level.tolerance.into(),
        ];
        match &trial.ended {
            Ok(ended) => {
                let is_on_it = front.iter().any(|(other, _)| std::ptr::eq(*other, trial));
                row.push(ended.seconds.into());
                row.extend(ended.cells.iter().cloned());
                row.push(if is_on_it { "*" } else { "" }.into());
            }
            Err(reason) => {
                row.extend([Cell::Missing, Cell::Missing, Cell::Missing]);
                row.push(Cell::Across(reason.clone()));
            }
        }
        table.push(row);
    }
    table
}

/// The cells from `steps` to `checks`. The permanent stick radius, in contact radii, does not count towards the worst.
fn results(
    session: &Session,
    reference: &Session,
    errors: &Difference,
    failing: &[Check],
) -> Vec<Cell> {
    let simulation = session.simulation();
    let stick = |session: &Session| session.simulation().moment().permanent_stick_radius;
    let stick_error = stick(session)
        .zip(stick(reference))
        .map(|(here, there)| (here - there).abs() / reference.simulation().moment().contact_radius);
    let complaints: Vec<String> = failing.iter().map(Check::complaint).collect();
    let Difference {
        worn_depth,
        volume,
        work,
        force,
        ..
    } = *errors;
    let errors = [worn_depth, volume, work, force].map(Some);
    let errors = errors.into_iter().chain([stick_error]);
    let mut row = vec![
        Cell::Count(simulation.steps() as usize),
        Cell::Count(simulation.stats().transforms as usize),
    ];
    row.extend(errors.map(|error| error.filter(|error| error.is_finite()).into()));
    row.push(match complaints.is_empty() {
        true => "ok".into(),
        false => Cell::Words(complaints.join(", ")),
    });
    row
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trial(points: usize, seconds: f64, worst: f64) -> Trial {
        let session = Session::start(Scenario::load("hertz", &[]).expect("a preset"));
        let session = session.expect("a session");
        let errors = Difference {
            worn_depth: 0.5 * worst,
            volume: worst,
            ..Difference::NONE
        };
        let cells = results(&session, &session, &errors, &[]);
        Trial {
            setting: Setting {
                method: AbelMethod::A,
                scheme: Scheme::Euler,
                level: level(points, 100, None),
            },
            ended: Ok(Ended {
                seconds,
                errors,
                is_sound: true,
                cells,
            }),
        }
    }

    #[test]
    fn the_front_is_what_nothing_beats() {
        let mut trials = vec![
            trial(1, 1.0, 1e-2),
            trial(2, 0.5, 3e-2),
            trial(3, 2.0, 2e-2),
            trial(4, 3.0, 1e-3),
            trial(5, 3.0, 2e-3),
            trial(6, 0.1, f64::NAN),
        ];
        trials.push(Trial {
            ended: Err("broke".into()),
            ..trial(7, 0.0, 0.0)
        });
        // The fastest and best of all fails its own checks.
        let mut unsound = trial(8, 0.01, 1e-6);
        if let Ok(ended) = &mut unsound.ended {
            ended.is_sound = false;
        }
        trials.push(unsound);
        let points = |(trial, _): Timed| trial.setting.level.points;
        let found: Vec<usize> = front(&trials).into_iter().map(points).collect();
        assert_eq!(found, [2, 1, 4]);
        assert_eq!(cheapest(&trials, 1e-2).map(points), Some(1));
        assert_eq!(cheapest(&trials, 5e-3).map(points), Some(4));
        assert!(cheapest(&trials, 1e-4).is_none());
        let table = table(&trials, &trials);
        let rows = table.rows();
        let stars = rows.iter().filter(|row| row[15] == Cell::from("*"));
        assert_eq!(stars.count(), 3);
        assert!(table.text().contains("broke"));
        // No tangential motion, no stick radius.
        assert_eq!(rows[0][13], Cell::Missing);
    }

    #[test]
    fn what_the_reference_fails_too_is_not_held_against_a_setting() {
        let scenario = Scenario::load("li2019-fig3", &["numerics.points=20".into()]);
        let scenario = scenario.expect("a preset");
        let setting = &settings(&scenario, &[AbelMethod::Benad], &[20], &[4])[0];
        let run = |cycles: f64| setting.run(&scenario, cycles, &|| true).expect("a run");
        let (coarse, unworn) = (run(3.0), run(0.0).0);
        let judged =
            |reference: &Session| Trial::new(setting.clone(), Ok(coarse.clone()), reference);
        let alone = judged(&unworn);
        assert!(alone.ended.is_ok_and(|ended| !ended.is_sound));
        let energy = Check {
            subject: Subject::Energy,
            error: 0.04,
        };
        let results = results(&unworn, &unworn, &Difference::NONE, &[energy]);
        assert_eq!(results.last(), Some(&Cell::from("energy off by 4.0 %")));
        let judged = judged(&coarse.0);
        assert!(judged.ended.is_ok_and(|ended| ended.is_sound));
    }
}

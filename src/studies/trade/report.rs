//! Results of a trade study: rows, the Pareto front, the cheapest setting for an accuracy.

use super::{Judged, Trial};
use crate::reading::Check;
use crate::studies::table::{Cell, Column, Format, Table};

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

/// The fastest trial whose error is at most `accuracy`.
pub fn cheapest(trials: &[Trial], accuracy: f64) -> Option<Timed<'_>> {
    let mut front = front(trials).into_iter();
    front.find(|(_, [_, error])| *error <= accuracy)
}

/// A heading over the columns of errors.
const ERRORS: &str = "against the reference";

/// The columns: a heading over some of them, the name, and how it is written.
const COLUMNS: [(&str, &str, Format); 16] = [
    ("", "method", Format::Words),
    ("", "scheme", Format::Words),
    ("", "integrator", Format::Words),
    ("", "points", Format::Count),
    ("", "steps_per_cycle", Format::Count),
    ("", "tolerance", Format::Rough),
    ("", "time_s", Format::Rough),
    ("", "steps", Format::Count),
    ("", "transforms", Format::Count),
    (ERRORS, "error_rms", Format::Rough),
    (ERRORS, "volume_error", Format::Rough),
    (ERRORS, "work_error", Format::Rough),
    (ERRORS, "force_error", Format::Rough),
    (ERRORS, "stick_error", Format::Rough),
    ("", "checks", Format::Words),
    ("", "front", Format::Words),
];

/// One row per trial of `shown`, with a mark if it is on the front of all.
pub fn table<'a>(shown: impl IntoIterator<Item = &'a Trial>, all: &[Trial]) -> Table {
    let columns = COLUMNS.map(|(group, name, format)| Column::grouped(group, name, format));
    let mut table = Table::new(columns.to_vec());
    let front = front(all);
    for trial in shown {
        let setting = &trial.setting;
        let mut row = vec![
            words(setting.method.name()),
            words(setting.scheme.name()),
            words(setting.integrator()),
            Cell::Count(setting.points),
            Cell::Count(setting.steps as usize),
            setting.tolerance.into(),
        ];
        match &trial.outcome {
            Ok(judged) => {
                row.extend(results(judged));
                let is_on_it = front.iter().any(|(other, _)| std::ptr::eq(*other, trial));
                row.push(words(if is_on_it { "*" } else { "" }));
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

/// The cells from `time_s` to `checks`.
fn results(
    Judged {
        sample,
        errors,
        stick_error,
    }: &Judged,
) -> Vec<Cell> {
    let complaints: Vec<String> = sample.failing.iter().map(Check::complaint).collect();
    let checks = match complaints.is_empty() {
        true => "ok".to_owned(),
        false => complaints.join(", "),
    };
    let errors = [
        errors.worn_depth,
        errors.volume,
        errors.work,
        errors.force,
        *stick_error,
    ];
    let mut row = vec![
        Cell::Number(sample.seconds),
        Cell::Count(sample.steps as usize),
        Cell::Count(sample.transforms as usize),
    ];
    row.extend(errors.map(|error| Some(error).filter(|error| error.is_finite()).into()));
    row.push(Cell::Words(checks));
    row
}

fn words(text: &str) -> Cell {
    Cell::Words(text.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::abel::AbelMethod;
    use crate::reading::Subject;
    use crate::scenario::Scenario;
    use crate::scenario::session::Session;
    use crate::simulation::Scheme;
    use crate::studies::refinement::{Difference, Outcome};
    use crate::studies::trade::{Sample, Setting};

    fn unworn() -> Outcome {
        let scenario = Scenario::load("hertz", &[]).expect("a preset");
        Outcome::of(&Session::start(scenario).expect("a session"))
    }

    fn trial(points: usize, seconds: f64, worst: f64) -> Trial {
        let sample = Sample {
            stick_radius: 1.0,
            contact_radius: 1.0,
            failing: Vec::new(),
            outcome: unworn(),
            seconds,
            transforms: 4,
            steps: 1,
        };
        let judged = Judged {
            sample,
            errors: Difference {
                worn_depth: 0.5 * worst,
                volume: worst,
                ..Difference::NONE
            },
            stick_error: f64::NAN,
        };
        Trial {
            setting: Setting {
                method: AbelMethod::A,
                scheme: Scheme::Euler,
                points,
                steps: 100,
                tolerance: None,
            },
            outcome: Ok(judged),
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
            outcome: Err("broke".into()),
            ..trial(7, 0.0, 0.0)
        });
        // The fastest and best of all fails its own checks.
        let mut unsound = trial(8, 0.01, 1e-6);
        if let Ok(judged) = &mut unsound.outcome {
            judged.sample.failing = vec![Check {
                subject: Subject::Energy,
                error: 0.04,
            }];
        }
        trials.push(unsound);
        let points = |(trial, _): Timed| trial.setting.points;
        let found: Vec<usize> = front(&trials).into_iter().map(points).collect();
        assert_eq!(found, [2, 1, 4]);
        assert_eq!(cheapest(&trials, 1e-2).map(points), Some(1));
        assert_eq!(cheapest(&trials, 5e-3).map(points), Some(4));
        assert_eq!(cheapest(&trials, 1e-4), None);
        let table = table(&trials, &trials);
        let stars = table
            .rows()
            .iter()
            .filter(|row| row[15] == Cell::Words("*".into()));
        assert_eq!(stars.count(), 3);
        assert!(table.text().contains("broke") && table.text().contains("energy off by 4.0 %"));
        assert_eq!(table.rows()[0][13], Cell::Missing);
    }
}

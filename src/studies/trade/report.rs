//! Results of a trade study: rows, the Pareto front, the cheapest setting for an accuracy.

use super::{Errors, Sample, Setting};
use crate::reading::Check;
use crate::studies::table::{Cell, Column, Format, Table};

/// One setting, and how it did.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// The setting.
    pub setting: Setting,
    /// The run and its errors, or why there is none.
    pub outcome: Result<(Sample, Errors), String>,
}

impl Trial {
    /// Time and worst error of a run that reached its end and passes its own checks.
    pub fn point(&self) -> Option<[f64; 2]> {
        let (sample, errors) = self.outcome.as_ref().ok()?;
        let is_sound = sample.failing.is_empty() && errors.worst().is_finite();
        is_sound.then(|| [sample.seconds, errors.worst()])
    }
}

/// A trial with its time and its worst error.
pub type Timed<'a> = (&'a Trial, [f64; 2]);

/// The trials that no other one beats in both time and error, the fastest first.
pub fn front<'a>(trials: impl IntoIterator<Item = &'a Trial>) -> Vec<Timed<'a>> {
    let trials = trials.into_iter();
    let mut sorted: Vec<Timed> = trials
        .filter_map(|trial| Some((trial, trial.point()?)))
        .collect();
    sorted.sort_by(|(_, a), (_, b)| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut best = f64::INFINITY;
    sorted.retain(|(_, [_, error])| {
        let better = *error < best;
        best = best.min(*error);
        better
    });
    sorted
}

/// The fastest trial whose error is at most `accuracy`.
pub fn cheapest(trials: &[Trial], accuracy: f64) -> Option<Timed<'_>> {
    let mut front = front(trials).into_iter();
    front.find(|(_, [_, error])| *error <= accuracy)
}

/// One row per trial of `shown`, with a mark if it is on the front of all.
pub fn table<'a>(shown: impl IntoIterator<Item = &'a Trial>, all: &[Trial]) -> Table {
    let mut table = Table::new(vec![
        Column::new("method", Format::Words),
        Column::new("scheme", Format::Words),
        Column::new("integrator", Format::Words),
        Column::new("points", Format::Count),
        Column::new("steps_per_cycle", Format::Count),
        Column::new("tolerance", Format::Rough),
        Column::new("time_s", Format::Rough),
        Column::new("steps", Format::Count),
        Column::new("transforms", Format::Count),
        Column::grouped("against the reference", "error_rms", Format::Rough),
        Column::grouped("against the reference", "volume_error", Format::Rough),
        Column::grouped("against the reference", "work_error", Format::Rough),
        Column::grouped("against the reference", "force_error", Format::Rough),
        Column::grouped("against the reference", "stick_error", Format::Rough),
        Column::new("checks", Format::Words),
        Column::new("front", Format::Words),
    ]);
    let front = front(all);
    let stands = |trial: &Trial| front.iter().any(|(other, _)| std::ptr::eq(*other, trial));
    for trial in shown {
        let setting = &trial.setting;
        let words = |text: &str| Cell::Words(text.to_owned());
        let mut row = vec![
            words(setting.method.name()),
            words(setting.scheme.name()),
            words(setting.integrator()),
            Cell::Count(setting.points),
            Cell::Count(setting.steps as usize),
            setting.tolerance.into(),
        ];
        match &trial.outcome {
            Ok((sample, errors)) => row.extend([
                Cell::Number(sample.seconds),
                Cell::Count(sample.steps as usize),
                Cell::Count(sample.transforms as usize),
                finite(errors.of_run.worn_depth),
                finite(errors.of_run.volume),
                finite(errors.of_run.work),
                finite(errors.of_run.force),
                finite(errors.stick_radius),
                words(&complaints(sample)),
                words(if stands(trial) { "*" } else { "" }),
            ]),
            Err(reason) => {
                row.resize(9, Cell::Missing);
                row.push(Cell::Across(reason.clone()));
                row.resize(16, Cell::Missing);
            }
        }
        table.push(row);
    }
    table
}

/// What is wrong with a run, in words.
fn complaints(sample: &Sample) -> String {
    let complaints: Vec<String> = sample.failing.iter().map(Check::complaint).collect();
    match complaints.is_empty() {
        true => "ok".to_owned(),
        false => complaints.join(", "),
    }
}

fn finite(value: f64) -> Cell {
    Some(value).filter(|value| value.is_finite()).into()
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
        let errors = Errors {
            of_run: Difference {
                worn_depth: 0.5 * worst,
                volume: worst,
                ..Difference::NONE
            },
            stick_radius: f64::NAN,
        };
        Trial {
            setting: Setting {
                method: AbelMethod::A,
                scheme: Scheme::Euler,
                points,
                steps: 100,
                tolerance: None,
            },
            outcome: Ok((sample, errors)),
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
        if let Ok((sample, _)) = &mut unsound.outcome {
            sample.failing = vec![Check {
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

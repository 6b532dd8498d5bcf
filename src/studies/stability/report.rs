//! Results of a stability study: one map per method, the runs, and the boundaries.

use std::fmt::Write;

use super::{Ending, Limit, Variant};
use crate::scenario::scalars::Value;
use crate::studies::table::Rows;

impl Ending {
    /// Returns the word in tables, and the mark in maps.
    fn words(&self) -> (&'static str, char) {
        match (&self.exploded, self.sawtooth) {
            (Some(_), _) => ("exploded", '#'),
            (None, Some(_)) => ("sawtooth", '~'),
            (None, None) => ("stable", '.'),
        }
    }
}

impl Limit {
    /// Returns the observed boundary relative to the predicted one.
    pub fn ratio(&self) -> Option<f64> {
        Some(self.seen? / self.predicted?)
    }
}

fn guard(line: &Limit) -> &'static str {
    if line.setting.guard { "on" } else { "off" }
}

/// Makes a table with one row per run.
pub fn runs(lines: &[Limit]) -> Rows {
    let of_run = "method guard points steps_per_cycle wear_number outcome";
    let found = "exploded_at_cycle sawtooth predicted_wear_number reason";
    let mut table = Rows::with_columns(&[("", of_run), ("", found)]);
    for line in lines {
        for (wear_number, outcome) in &line.outcomes {
            let (cycle, reason) = outcome.exploded.clone().unzip();
            let steps = Value::from(line.setting.steps);
            let of_run = [steps, (*wear_number).into(), outcome.words().0.into()];
            let found = [cycle.into(), outcome.sawtooth.into(), line.predicted.into()];
            let row = key(line).into_iter().chain(of_run).chain(found);
            table.push(row.chain([reason.into()]).collect::<Vec<_>>());
        }
    }
    table
}

/// Makes a table with one row per method and grid: the predicted and the observed boundary.
pub fn boundaries(lines: &[Limit]) -> Rows {
    let critical = ("critical K", "predicted seen ratio");
    let mut table = Rows::with_columns(&[("", "method guard points"), critical]);
    for line in lines {
        let found = [line.predicted, line.seen, line.ratio()].map(Value::from);
        table.push(key(line).into_iter().chain(found).collect::<Vec<_>>());
    }
    table
}

fn key(line: &Limit) -> [Value; 3] {
    let Variant { method, points, .. } = line.setting;
    [method.name().into(), guard(line).into(), points.into()]
}

/// Width of a rung in a map.
const RUNG: usize = 7;

/// Draws one map per method and guard: a row per grid, a column per wear number, `|` at the predicted boundary.
pub fn maps(lines: &[Limit]) -> String {
    let mut text = String::new();
    let kind = |line: &Limit| (line.setting.method, line.setting.guard);
    for group in lines.chunk_by(|a, b| kind(a) == kind(b)) {
        let Some(first) = group.iter().max_by_key(|line| line.outcomes.len()) else {
            continue;
        };
        let _ = writeln!(text, "{}, guard {}", first.setting.method, guard(first));
        for line in group {
            let (points, strip) = (line.setting.points, strip(line));
            let _ = writeln!(text, "{points:>6} {}", strip.trim_end());
        }
        let rungs = first.outcomes.iter().map(|(k, _)| format!("{k:<RUNG$}"));
        let rungs: String = rungs.collect();
        let _ = writeln!(text, "  N  K={}", rungs.trim_end());
        if let Some(sawtooth) = first.setting.method.traits().sawtooth {
            let measured =
                "Measured, not derived: the sawtooth grows with K x cycles at any step size";
            let _ = writeln!(text, "  {measured};\n  {}.", sawtooth.why);
        }
        text.push('\n');
    }
    text
}

/// Draws one row of a map.
fn strip(line: &Limit) -> String {
    let rung = |mark| std::iter::repeat_n(mark, RUNG - 1).chain([' ']);
    let outcomes = line.outcomes.iter();
    let rungs = outcomes.flat_map(|(_, outcome)| rung(outcome.words().1));
    let mut strip: Vec<char> = rungs.collect();
    if let Some(predicted) = line.predicted {
        let place = line.outcomes.windows(2).enumerate().find_map(|(i, pair)| {
            let (low, high) = (pair[0].0, pair[1].0);
            let share = (predicted / low).ln() / (high / low).ln();
            let is_here = (0.0..1.0).contains(&share);
            is_here.then(|| i * RUNG + (share * RUNG as f64) as usize)
        });
        if let Some(place) = place {
            strip[place] = '|';
        }
    }
    strip.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::abel::AbelMethod;

    fn line() -> Limit {
        let sawtooth = Ending {
            sawtooth: Some(0.5),
            ..Ending::default()
        };
        let exploded = Ending {
            exploded: Some((2.5, "it blew, up".into())),
            ..Ending::default()
        };
        Limit {
            setting: Variant {
                method: AbelMethod::A,
                points: 50,
                steps: 100,
                guard: false,
            },
            outcomes: vec![
                (1.0, Ending::default()),
                (10.0, sawtooth),
                (100.0, exploded),
            ],
            predicted: Some(8.0),
            seen: Some(4.0),
        }
    }

    #[test]
    fn a_map_marks_each_rung_and_the_prediction() {
        let expected = "a, guard off\n    50 ......|~~~~~~ ######\n  N  K=1      10     100\n\n";
        assert_eq!(maps(&[line()]), expected);
        assert_eq!(line().ratio(), Some(0.5));
    }

    #[test]
    fn a_map_says_in_words_where_the_limit_is_measured() {
        let mut line = line();
        assert!(!maps(&[line.clone()]).contains("Measured"));
        for method in [AbelMethod::B, AbelMethod::Benad] {
            line.setting.method = method;
            assert!(maps(&[line.clone()]).contains("\n  Measured, not derived: the sawtooth "));
        }
    }

    #[test]
    fn tables_tell_when_and_why() {
        let csv = runs(&[line()]).csv();
        assert!(
            csv.contains("a,off,50,100,100,exploded,2.5,,8,\"it blew, up\"\n"),
            "{csv}"
        );
        assert!(boundaries(&[line()]).text(2).contains("0.50"));
    }
}

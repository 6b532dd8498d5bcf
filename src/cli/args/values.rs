//! Types of command-line values: choices, and numbers within limits.

use std::ops::RangeInclusive;
use std::str::FromStr;
use std::time::Duration;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Arg, ValueEnum};
use serde::{Deserialize, Serialize};

use crate::math::abel::MOST_DENSE_CELLS;
use crate::math::grid::MIN_CELLS;
use crate::scenario::{MOST_CYCLES, units};

/// Which moments `history.csv` records.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum HistoryChoice {
    /// The end of every cycle.
    Cycle,
    /// Every step.
    EveryStep,
}

/// When colour is used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ColorChoice {
    /// Unless NO_COLOR is set.
    Auto,
    /// Always.
    Always,
    /// Never.
    Never,
}

impl ColorChoice {
    /// Whether to use colours; `None` if the environment decides.
    pub fn is_colored(self) -> Option<bool> {
        match self {
            Self::Auto => None,
            Self::Always => Some(true),
            Self::Never => Some(false),
        }
    }
}

/// Parses the seconds between two checkpoints; 0 means only at the end.
pub(super) fn interval(text: &str) -> Result<Duration, String> {
    match text.parse() {
        Ok(seconds) if seconds == 0.0 || (1e-3..=1e6).contains(&seconds) => {
            Ok(Duration::from_secs_f64(seconds))
        }
        _ => Err("an interval is 0, or from 0.001 to 1000000 seconds, e.g. 60".into()),
    }
}

/// A cycle as it was typed; it becomes part of the file's name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CycleAsGiven(pub String);

impl CycleAsGiven {
    /// Returns the cycle as a number.
    pub fn cycle(&self) -> f64 {
        self.0.parse().unwrap_or(f64::NAN)
    }
}

impl FromStr for CycleAsGiven {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        cycles(text.trim())?;
        Ok(Self(text.trim().to_owned()))
    }
}

/// Parses a time in seconds, as `60`, `60s`, `5min` or `1h`.
pub(super) fn budget(text: &str) -> Result<f64, String> {
    let with_unit = units::in_unit(text, "s").and_then(Result::ok);
    let seconds = with_unit.or_else(|| text.trim().parse().ok());
    let seconds = seconds.filter(|seconds| (0.0..f64::INFINITY).contains(seconds));
    seconds.ok_or_else(|| "a budget is a time of 0 or more, e.g. 60s, 5min or 1h".into())
}

/// Parses a force, as `30`, `30 N` or `30mN`.
pub(super) fn load(text: &str) -> Result<f64, String> {
    let with_unit = units::in_unit(text, "N").and_then(Result::ok);
    let force = with_unit
        .or_else(|| text.trim().parse().ok())
        .filter(|force: &f64| *force > 0.0 && force.is_finite());
    force.ok_or_else(|| "a load is a force greater than 0, e.g. 30N".into())
}

/// Parses a number of cycles.
pub fn cycles(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (0.0..=MOST_CYCLES).contains(&value) => Ok(value),
        Ok(value) if value > MOST_CYCLES && value.is_finite() => {
            Err(format!("a run has at most {MOST_CYCLES:e} cycles"))
        }
        _ => Err("cycles are a number of 0 or more, e.g. 199.24".into()),
    }
}

/// Lets an option with a value named `X,...` take a list. The value of such an option, or of a number `X`, may begin
/// with a dash, so that its own parser can reject it.
pub(super) fn listed(arg: Arg) -> Arg {
    let names = arg.get_value_names().unwrap_or_default();
    let is_list = names.iter().any(|name| name.ends_with(",..."));
    match names {
        _ if is_list => arg.value_delimiter(',').allow_hyphen_values(true),
        [name] if name == "X" => arg.allow_hyphen_values(true),
        _ => arg,
    }
}

/// Parses a number within a range; the error is `rule`.
pub(super) fn number_within<T: FromStr + PartialOrd>(
    range: RangeInclusive<T>,
    rule: impl Into<String>,
) -> impl Fn(&str) -> Result<T, String> + Clone
where
    RangeInclusive<T>: Clone,
{
    let rule = rule.into();
    move |text| {
        let value = text.trim().parse().ok();
        let value = value.filter(|value| range.contains(value));
        value.ok_or_else(|| rule.clone())
    }
}

pub(super) fn points() -> impl Fn(&str) -> Result<usize, String> + Clone {
    let (least, most) = (MIN_CELLS, MOST_DENSE_CELLS);
    let rule = format!("points are whole numbers from {least} to {most}, e.g. 100,1000");
    number_within(least..=most, rule)
}

/// Parses one of these values by its name.
pub(super) fn by_name<T: Copy + Send + Sync + 'static>(
    all: Vec<T>,
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(all.iter().map(|one| name(*one))).try_map(move |given| {
        let found = all.iter().find(|one| name(**one) == given);
        found.copied().ok_or("no such name")
    })
}

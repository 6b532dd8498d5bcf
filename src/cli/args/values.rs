//! Types of command-line values: choices, and numbers within limits.

use std::str::FromStr;
use std::time::Duration;

use clap::ValueEnum;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use serde::{Deserialize, Serialize};

use crate::math::abel::{AbelMethod, MOST_DENSE_CELLS};
use crate::math::grid::MIN_CELLS;
use crate::scenario::MOST_CYCLES;
use crate::studies::verify::Problem;

/// Which moments `history.csv` records.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum HistoryChoice {
    /// The end of every cycle.
    Cycle,
    /// Every step.
    EveryStep,
}

/// When colour is used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ColorChoice {
    /// Unless NO_COLOR is set.
    Auto,
    /// Always.
    Always,
    /// Never.
    Never,
}

impl ColorChoice {
    /// Whether colours are used; `None` where the environment decides.
    pub fn is_colored(self) -> Option<bool> {
        match self {
            Self::Auto => None,
            Self::Always => Some(true),
            Self::Never => Some(false),
        }
    }
}

/// Time between two checkpoints; `None`: only at the end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval(pub Option<Duration>);

pub(super) fn interval(text: &str) -> Result<Interval, String> {
    match text.parse::<f64>() {
        Ok(0.0) => Ok(Interval(None)),
        Ok(seconds) if (1e-3..=1e6).contains(&seconds) => {
            Ok(Interval(Some(Duration::from_secs_f64(seconds))))
        }
        _ => Err("an interval is 0, or from 0.001 to 1000000 seconds, e.g. 60".into()),
    }
}

/// A cycle and its spelling, which names the file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct CycleAsGiven {
    /// The cycle.
    pub cycle: f64,
    /// As typed.
    pub spelling: String,
}

impl From<CycleAsGiven> for String {
    fn from(cycle: CycleAsGiven) -> Self {
        cycle.spelling
    }
}

impl TryFrom<String> for CycleAsGiven {
    type Error = String;

    fn try_from(spelling: String) -> Result<Self, String> {
        spelling.parse()
    }
}

impl FromStr for CycleAsGiven {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let spelling = text.trim().to_owned();
        Ok(Self {
            cycle: cycles(&spelling)?,
            spelling,
        })
    }
}

/// Seconds, as `60`, `60s`, `5min` or `1h`.
pub(super) fn budget(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let unit = match &text[digits.len()..] {
        "" | "s" => Some(1.0),
        "m" | "min" => Some(60.0),
        "h" => Some(3600.0),
        _ => None,
    };
    match (digits.trim().parse::<f64>(), unit) {
        (Ok(number), Some(unit)) if number >= 0.0 && number.is_finite() => Ok(number * unit),
        _ => Err("a budget is a time of 0 or more, e.g. 60s, 5min or 1h".into()),
    }
}

pub(super) fn cycles(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (0.0..=MOST_CYCLES).contains(&value) => Ok(value),
        Ok(value) if value > MOST_CYCLES && value.is_finite() => {
            Err(format!("a run has at most {MOST_CYCLES:e} cycles"))
        }
        _ => Err("cycles are a number of 0 or more, e.g. 199.24".into()),
    }
}

pub(super) fn points(text: &str) -> Result<usize, String> {
    match text.trim().parse::<usize>() {
        Ok(points) if (MIN_CELLS..=MOST_DENSE_CELLS).contains(&points) => Ok(points),
        _ => Err(format!(
            "points are whole numbers from {MIN_CELLS} to {MOST_DENSE_CELLS}, e.g. 100,1000"
        )),
    }
}

pub(super) fn wear_number(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value > 0.0 && value <= 1e6 => Ok(value),
        _ => Err("wear numbers are greater than 0 and at most 1e6, e.g. 0.3,3,30".into()),
    }
}

pub(super) fn accuracy(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value <= 1.0 => Ok(value),
        _ => Err(
            "an accuracy is greater than 0 and at most 1, relative to the largest depth, e.g. \
                1e-3"
                .into(),
        ),
    }
}

pub(super) fn method_parser() -> impl TypedValueParser<Value = AbelMethod> {
    PossibleValuesParser::new(AbelMethod::ALL.map(AbelMethod::name))
        .try_map(|name| name.parse::<AbelMethod>())
}

pub(super) fn problem_parser() -> impl TypedValueParser<Value = Problem> {
    PossibleValuesParser::new(Problem::ALL.map(Problem::name))
        .try_map(|name| name.parse::<Problem>())
}

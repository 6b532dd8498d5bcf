//! The errors that a run states of itself, in the headers of its files.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use strum::EnumCount;

use super::Quantity;

/// Stated errors of a run, one for each quantity, with two digits.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Errors {
    /// The accuracy that was asked for.
    pub accuracy: Option<f64>,
    /// The error of each [`Quantity`], in their order.
    pub of: [Option<f64>; Quantity::COUNT],
    /// What the user should know of them, on one line.
    pub warning: Option<String>,
}

/// Names of the two that are of no quantity.
const ACCURACY: &str = "accuracy";
const WARNING: &str = "warning";

/// Separates entries in one line.
const BETWEEN: &str = " | ";

impl Errors {
    /// States the error of each quantity that has one.
    pub fn new(of: impl Fn(Quantity) -> Option<f64>) -> Self {
        let rounded = |error: f64| format!("{error:.1e}").parse().unwrap_or(error);
        Self {
            of: std::array::from_fn(|k| of(Quantity::ALL[k]).map(rounded)),
            ..Self::default()
        }
    }

    /// Returns the error of a quantity, if it is stated.
    pub fn get(&self, of: Quantity) -> Option<f64> {
        self.of[of as usize]
    }

    /// Whether an error was measured.
    pub fn are_measured(&self) -> bool {
        self.of.iter().any(Option::is_some)
    }

    /// Returns the lines of headers, keys and values.
    pub fn entries(&self) -> impl Iterator<Item = (&'static str, String)> {
        let accuracy = self.accuracy.map(|of| (ACCURACY, format!("{of:e}")));
        let errors = Quantity::ALL.iter();
        let errors =
            errors.filter_map(|&of| Some((of.column().name(), format!("{:.1e}", self.get(of)?))));
        let warning = self.warning.clone().map(|text| (WARNING, text));
        accuracy.into_iter().chain(errors).chain(warning)
    }
}

/// All entries in one line.
impl fmt::Display for Errors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let entries = self.entries();
        let entries =
            entries.map(|(key, value)| format!("{key}: {}", value.replace(BETWEEN, ", ")));
        f.write_str(&entries.collect::<Vec<_>>().join(BETWEEN))
    }
}

/// Reads them back.
impl FromStr for Errors {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let mut errors = Self::default();
        for entry in text.split(BETWEEN) {
            let (key, value) = entry.split_once(": ").ok_or(())?;
            let is_key = |of: &&Quantity| of.column().name() == key;
            match (key, Quantity::ALL.iter().find(is_key)) {
                (WARNING, _) => errors.warning = Some(value.to_owned()),
                (ACCURACY, _) => errors.accuracy = value.parse().ok(),
                (_, Some(&of)) => errors.of[of as usize] = value.parse().ok(),
                _ => return Err(()),
            }
        }
        Ok(errors)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_line_reads_back_as_the_same_errors() {
        let errors = Errors {
            accuracy: Some(1e-2),
            warning: Some("not reached: 1 | 2".into()),
            ..Errors::new(|of| (!of.is_of_wear()).then_some(1.23456e-3))
        };
        assert_eq!(errors.get(Quantity::Force), Some(1.2e-3));
        assert!(errors.are_measured() && !Errors::default().are_measured());
        let again: Errors = errors.to_string().parse().expect("errors");
        let warning = Some("not reached: 1, 2".into());
        assert_eq!(again, Errors { warning, ..errors });
    }
}

//! Scenario errors: one line that says what is wrong, where, and what would be right.

use std::fmt::Display;

use thiserror::Error;

use super::bounded_read::{self, Unread};
use super::escape::echo;

/// Maximum number of errors reported at once.
pub(super) const MOST_ERRORS: usize = 20;

/// Wrong user input, in one line: its place, its value, and what would be right. For a scenario, all its errors, one
/// per line.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{}", .lines.join("\n"))]
pub struct Refusal {
    lines: Vec<String>,
    /// Whether the system failed rather than the user.
    is_failure: bool,
}

impl Refusal {
    /// Refuses the input at `place`: a file, an option, a key.
    pub fn new(place: impl Display, rule: impl Display) -> Self {
        format!("{place}: {rule}").into()
    }

    /// Refuses the file at `place`, which could not be read.
    pub fn unread(place: impl Display, why: &Unread) -> Self {
        Self {
            is_failure: matches!(why, Unread::Io(cause) if !bounded_read::is_avoidable(cause)),
            ..Self::new(place, why)
        }
    }

    /// Refuses `value` at `place`, shortened if it is long.
    pub fn of_value(place: impl Display, value: impl Display, rule: impl Display) -> Self {
        let value = echo(&value.to_string());
        format!("{place} = {value}: {rule}").into()
    }

    /// Reports that `origin` lacks a value at `path`, which means `meaning`.
    pub fn missing(origin: impl Display, path: &str, meaning: impl Display) -> Self {
        Self::new(origin, format!("{path} is missing: {meaning}"))
    }

    /// Adds another option for the user.
    #[must_use]
    pub fn or(self, hint: impl Display) -> Self {
        Self {
            is_failure: self.is_failure,
            ..format!("{self}; {hint}").into()
        }
    }

    /// Combines errors into one; `None` if there are none. Only the first of many are reported.
    pub(super) fn all(errors: impl IntoIterator<Item = Self>) -> Option<Self> {
        let mut is_failure = false;
        let lines = errors.into_iter().flat_map(|error| {
            is_failure |= error.is_failure;
            error.lines
        });
        let mut all: Vec<String> = lines.collect();
        if all.len() > MOST_ERRORS {
            let more = all.split_off(MOST_ERRORS - 1).len();
            all.push(format!("and {more} more errors"));
        }
        (!all.is_empty()).then_some(Self {
            lines: all,
            is_failure,
        })
    }

    /// The errors, one per line.
    pub fn lines(&self) -> &[String] {
        &self.lines
    }

    /// Whether the system failed, so that no other input would have helped.
    pub fn is_failure(&self) -> bool {
        self.is_failure
    }
}

/// Makes a refusal of a line that already names place and rule.
impl From<String> for Refusal {
    fn from(line: String) -> Self {
        Self {
            lines: vec![line],
            is_failure: false,
        }
    }
}

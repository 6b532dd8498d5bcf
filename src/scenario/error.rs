//! Scenario errors: one line that says what is wrong, where, and what would be right.

use std::collections::BTreeSet;
use std::fmt::Display;

use thiserror::Error;

use super::bounded_read::{self, Unread};
use super::escape::{echo, printable};

/// Maximum number of errors reported at once.
const MOST_ERRORS: usize = 20;

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

/// The errors of a scenario and the keys they blame.
#[derive(Debug, Default)]
pub(super) struct Faults {
    errors: Vec<Refusal>,
    /// Number of errors beyond the reported ones.
    more: usize,
    blamed: BTreeSet<String>,
}

impl Faults {
    /// Notes an error caused by the key at `path`, if it is that
    /// key's first. Errors beyond the maximum are only counted.
    pub fn note(&mut self, path: &str, error: impl FnOnce() -> Refusal) {
        if !self.blamed.insert(path.to_owned()) {
            return;
        }
        if self.is_full() {
            self.more += 1;
        } else {
            self.errors.push(error());
        }
    }

    /// Whether the maximum number of errors is reached.
    pub fn is_full(&self) -> bool {
        self.errors.len() >= MOST_ERRORS
    }

    /// Notes that an existing error already covers the key at `path`.
    pub fn blame(&mut self, path: &str) {
        self.blamed.insert(path.to_owned());
    }

    /// Whether an error covers the key at `path` or a table that contains it.
    pub fn covers(&self, path: &str) -> bool {
        let tables = path.match_indices('.').map(|(end, _)| &path[..end]);
        tables.chain([path]).any(|path| self.blamed.contains(path))
    }

    /// Combines all errors into one; `None` if there are none.
    pub fn into_error(mut self) -> Option<Refusal> {
        if self.more > 0 {
            // The last line gives the number of errors left out.
            let more = self.more + self.errors.split_off(MOST_ERRORS - 1).len();
            self.errors.push(format!("and {more} more errors").into());
        }
        Refusal::all(self.errors)
    }
}

/// Where the values of a scenario came from, so that an error points at what the user wrote.
#[derive(Debug, Clone)]
pub(super) struct Origin {
    name: String,
    /// Paths assigned after the text was read, and the assignments as written.
    assigned: Vec<(String, String)>,
    /// Values as they were given.
    shown: Vec<(&'static str, toml::Value)>,
}

impl Origin {
    /// Names a text.
    pub fn new(name: &str) -> Self {
        Self {
            name: printable(name),
            assigned: Vec::new(),
            shown: Vec::new(),
        }
    }

    /// Remembers that `path` was assigned as `written`.
    pub fn assign(&mut self, path: &str, written: &str) {
        self.assigned.push((path.to_owned(), written.to_owned()));
    }

    /// Remembers a value as it was given.
    pub fn show(&mut self, path: &'static str, raw: toml::Value) {
        self.shown.push((path, raw));
    }

    /// The value of a key as it was given here.
    pub fn shown(&self, path: &str) -> Option<String> {
        let found = self.shown.iter().find(|(known, _)| *known == path);
        found.map(|(_, raw)| super::values::show(raw))
    }

    /// Whether `path` was assigned after the text was read.
    pub fn assigns(&self, path: &str) -> bool {
        self.assigned.iter().any(|(key, _)| key == path)
    }

    /// Returns the name of the text, printable on one line.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Returns the place of a value: the assignment that gave it, or the origin with path and value.
    pub fn place(&self, path: &str, value: &str) -> String {
        let last = self.assigned.iter().rev().find(|(key, _)| key == path);
        match last {
            Some((_, written)) => written.clone(),
            None => format!("{}: {path} = {value}", self.name),
        }
    }

    /// Refuses the value at `path`.
    pub fn refuse(&self, path: &str, value: &str, rule: impl Display) -> Refusal {
        Refusal::new(self.place(path, value), rule)
    }

    /// Reports that the value at `path`, which means `meaning`, is missing.
    pub fn missing(&self, path: &str, meaning: impl Display) -> Refusal {
        Refusal::missing(&self.name, path, meaning)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_assignment_hides_the_place_in_the_text() {
        let mut origin = Origin::new("a.toml");
        assert_eq!(origin.place("x.y", "1"), "a.toml: x.y = 1");
        origin.assign("x.y", "--set x.y=2");
        assert_eq!(origin.place("x.y", "2"), "--set x.y=2");
    }
}

//! Scenario errors: one line that says what is wrong, where, and what would be right.

use std::collections::BTreeSet;
use std::fmt::Display;

use thiserror::Error;

use super::bounded_read::{self, Unread};
use super::escape::{echo, printable};

/// The most errors that are told at once.
const MOST_ERRORS: usize = 20;

/// Wrong input of a user: where it stands, with its value, and what would be right, in one line; of a scenario all that
/// is wrong with it, a line each.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{}", .lines.join("\n"))]
pub struct Refusal {
    lines: Vec<String>,
    /// Whether the system failed, not the user.
    is_failure: bool,
}

impl Refusal {
    /// Refuses what stands at `place`: a file, an option, a key.
    pub fn new(place: impl Display, rule: impl Display) -> Self {
        format!("{place}: {rule}").into()
    }

    /// Refuses the file at `place`, which cannot be read.
    pub fn unread(place: impl Display, why: &Unread) -> Self {
        Self {
            is_failure: matches!(why, Unread::Io(cause) if !bounded_read::is_avoidable(cause)),
            ..Self::new(place, why)
        }
    }

    /// Refuses `value` at `place`; a long one is cut.
    pub fn of_value(place: impl Display, value: impl Display, rule: impl Display) -> Self {
        let value = echo(&value.to_string());
        format!("{place} = {value}: {rule}").into()
    }

    /// The error that `origin` gives no value at `path`, which means `meaning`.
    pub fn missing(origin: impl Display, path: &str, meaning: impl Display) -> Self {
        Self::new(origin, format!("{path} is missing: {meaning}"))
    }

    /// The same with what else the user can do.
    #[must_use]
    pub fn or(self, hint: impl Display) -> Self {
        Self {
            is_failure: self.is_failure,
            ..format!("{self}; {hint}").into()
        }
    }

    /// Errors as one; `None` where there are none. Of a long list only the first are told.
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

    /// What is wrong, one by one.
    pub fn lines(&self) -> &[String] {
        &self.lines
    }

    /// Whether the system failed, so that no other input would have helped.
    pub fn is_failure(&self) -> bool {
        self.is_failure
    }
}

/// A line that says place and rule already.
impl From<String> for Refusal {
    fn from(line: String) -> Self {
        Self {
            lines: vec![line],
            is_failure: false,
        }
    }
}

/// The keys of a scenario that errors blame, and the errors.
#[derive(Debug, Default)]
pub(super) struct Faults {
    errors: Vec<Refusal>,
    /// The number of errors beyond those that are told.
    more: usize,
    blamed: BTreeSet<String>,
}

impl Faults {
    /// Notes an error that is due to the key at `path`, if it is the first one. Of too many it is not even made.
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

    /// Whether there are more errors than are told.
    pub fn is_full(&self) -> bool {
        self.errors.len() >= MOST_ERRORS
    }

    /// Notes that the key at `path` is dealt with by an error that is there already.
    pub fn blame(&mut self, path: &str) {
        self.blamed.insert(path.to_owned());
    }

    /// Whether an error deals with the key at `path`, or with the whole table that it stands in.
    pub fn covers(&self, path: &str) -> bool {
        let tables = path.match_indices('.').map(|(end, _)| &path[..end]);
        tables.chain([path]).any(|path| self.blamed.contains(path))
    }

    /// The keys that errors deal with.
    pub fn paths(&self) -> impl Iterator<Item = &str> {
        self.blamed.iter().map(String::as_str)
    }

    /// All errors as one; `None` where there are none.
    pub fn into_error(mut self) -> Option<Refusal> {
        if self.more > 0 {
            // The last line tells how many are left out.
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
    /// Paths that were assigned after the text was read, and how the assignment was written.
    assigned: Vec<(String, String)>,
}

impl Origin {
    /// A text called `name`.
    pub fn new(name: &str) -> Self {
        Self {
            name: printable(name),
            assigned: Vec::new(),
        }
    }

    /// Remembers that `path` was assigned as `written`.
    pub fn assign(&mut self, path: &str, written: &str) {
        self.assigned.push((path.to_owned(), written.to_owned()));
    }

    /// Whether `path` was assigned after the text was read.
    pub fn assigns(&self, path: &str) -> bool {
        self.assigned.iter().any(|(key, _)| key == path)
    }

    /// The text's name, fit for a line.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Where a value stands: the assignment that gave it, or the origin with path and value.
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

    /// The error that there is no value at `path`, which means `meaning`.
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

//! Scenario errors: one line that says what is wrong, where, and what would be right.

use std::fmt::Display;

use thiserror::Error;

/// Maximum number of characters of a user's text in an error.
const LONGEST_ECHO: usize = 60;

/// The most errors that are told at once.
const MOST_ERRORS: usize = 20;

/// Wrong input of a user: where it stands, with its value, and what would be right, in one line; of a scenario all that
/// is wrong with it, a line each.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{}", .0.join("\n"))]
pub struct Refusal(Vec<String>);

impl Refusal {
    /// Refuses what stands at `place`: a file, an option, a key.
    pub fn new(place: impl Display, rule: impl Display) -> Self {
        format!("{place}: {rule}").into()
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
        format!("{self}; {hint}").into()
    }

    /// Errors as one; `None` where there are none. Of a long list only the first are told.
    pub(super) fn all(errors: impl IntoIterator<Item = Self>) -> Option<Self> {
        let mut all: Vec<String> = errors.into_iter().flat_map(|error| error.0).collect();
        if all.len() > MOST_ERRORS {
            let more = all.split_off(MOST_ERRORS - 1).len();
            all.push(format!("and {more} more errors"));
        }
        (!all.is_empty()).then_some(Self(all))
    }

    /// What is wrong, one by one.
    pub fn lines(&self) -> &[String] {
        &self.0
    }
}

/// A line that says place and rule already.
impl From<String> for Refusal {
    fn from(line: String) -> Self {
        Self(vec![line])
    }
}

/// The keys of a scenario that errors blame, each with its error, unless one that is there already deals with it.
#[derive(Debug, Default)]
pub(super) struct Faults(Vec<(String, Option<Refusal>)>);

impl Faults {
    /// Notes an error that is due to the key at `path`. A key is blamed once.
    pub fn note(&mut self, path: &str, error: Refusal) {
        if self.paths().all(|blamed| blamed != path) {
            self.0.push((path.to_owned(), Some(error)));
        }
    }

    /// Notes that the key at `path` is dealt with by an error that is there already.
    pub fn blame(&mut self, path: &str) {
        self.0.push((path.to_owned(), None));
    }

    /// Whether an error deals with the key at `path`, or with the whole table that it stands in.
    pub fn covers(&self, path: &str) -> bool {
        let mut rest = self.paths().filter_map(|blamed| path.strip_prefix(blamed));
        rest.any(|rest| rest.is_empty() || rest.starts_with('.'))
    }

    /// The keys that errors deal with.
    pub fn paths(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|(path, _)| path.as_str())
    }

    /// All errors as one; `None` where there are none.
    pub fn into_error(self) -> Option<Refusal> {
        Refusal::all(self.0.into_iter().filter_map(|(_, error)| error))
    }
}

/// `text` on one line, whatever it holds: control and invisible characters become escapes.
pub fn printable(text: &str) -> String {
    // Quotes and backslashes are harmless, and would only be harder to read as escapes.
    ["\"", "'", "\\"]
        .iter()
        .fold(text.escape_debug().to_string(), |line, plain| {
            line.replace(&format!("\\{plain}"), plain)
        })
}

/// [`printable`], cut where it grows too long for a line.
pub(super) fn echo(text: &str) -> String {
    let mut start: String = text.chars().take(LONGEST_ECHO).collect();
    let cut = start.len() < text.len();
    start = printable(&start);
    if cut {
        start.push_str("...");
    }
    start
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
    fn user_text_stays_on_its_line() {
        assert_eq!(printable("a\nb\u{1b}[31m"), "a\\nb\\u{1b}[31m");
        assert_eq!(printable("\u{202e}x\u{0}"), "\\u{202e}x\\0");
        assert_eq!(printable(r#"it's "C:\x""#), r#"it's "C:\x""#);
        assert_eq!(printable("caf\u{e9} cafe\u{301}"), "caf\u{e9} cafe\u{301}");
        assert_eq!(echo(&"x".repeat(100)).len(), LONGEST_ECHO + 3);
    }

    #[test]
    fn an_assignment_hides_the_place_in_the_text() {
        let mut origin = Origin::new("a.toml");
        assert_eq!(origin.place("x.y", "1"), "a.toml: x.y = 1");
        origin.assign("x.y", "--set x.y=2");
        assert_eq!(origin.place("x.y", "2"), "--set x.y=2");
    }
}

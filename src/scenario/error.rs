//! Scenario errors: one line that says what is wrong, where, and what would be right.

use std::fmt::Display;

use thiserror::Error;

/// Maximum number of characters of a user's text in an error.
const LONGEST_ECHO: usize = 60;

/// The most errors that are told at once.
const MOST_ERRORS: usize = 20;

/// Wrong input of a user, in one line: where it stands, with its value, and what would be right.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0}")]
pub struct Refusal(String);

impl Refusal {
    /// Refuses what stands at `place`: a file, an option, a key.
    pub fn new(place: impl Display, rule: impl Display) -> Self {
        Self(format!("{place}: {rule}"))
    }

    /// Refuses `value` at `place`; a long one is cut.
    pub fn of_value(place: impl Display, value: impl Display, rule: impl Display) -> Self {
        let value = echo(&value.to_string());
        Self(format!("{place} = {value}: {rule}"))
    }

    /// The same with what else the user can do.
    #[must_use]
    pub fn or(self, hint: impl Display) -> Self {
        Self(format!("{self}; {hint}"))
    }
}

/// A line that says place and rule already.
impl From<String> for Refusal {
    fn from(line: String) -> Self {
        Self(line)
    }
}

/// A scenario that cannot be run. Each displays as one line, and several as one each.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ScenarioError {
    /// A name that is neither a preset's nor a path.
    #[error("{name}: no such preset; {hint}")]
    UnknownPreset {
        /// The name as given.
        name: String,
        /// The nearest preset, or all of them.
        hint: String,
    },
    /// A file that cannot be read as text.
    #[error("{origin}: {reason}")]
    Unreadable {
        /// The path as given.
        origin: String,
        /// Why, and what would be right.
        reason: String,
    },
    /// Text that is not TOML.
    #[error("{origin}: line {line}, column {column}: {message}")]
    Syntax {
        /// Where the text came from.
        origin: String,
        /// Counted from 1.
        line: usize,
        /// In characters, counted from 1.
        column: usize,
        /// The parser's message.
        message: String,
    },
    /// `--set` without a key or without a value.
    #[error("{given}: must be KEY=VALUE, as in numerics.points=400")]
    NotAnAssignment {
        /// The text as given.
        given: String,
    },
    /// An unknown key.
    #[error("{place}: unknown key {key}; {hint}")]
    UnknownKey {
        /// The origin, or the assignment that named the key.
        place: String,
        /// The key's dotted path.
        key: String,
        /// The nearest key, or the keys that its table takes.
        hint: String,
    },
    /// A required key that is missing.
    #[error("{origin}: {path} is missing: {meaning}")]
    Missing {
        /// Where the scenario came from.
        origin: String,
        /// The key's dotted path.
        path: String,
        /// What it means, and its unit.
        meaning: String,
    },
    /// More than one of the others, a line each.
    #[error("{}", lines(.0))]
    Several(Vec<ScenarioError>),
    /// What is left out of a long list of them.
    #[error("and {0} more errors")]
    More(usize),
    /// A value that breaks a rule.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

/// The errors found in a scenario, and which keys they blame.
#[derive(Debug, Default)]
pub(super) struct Faults {
    errors: Vec<ScenarioError>,
    paths: Vec<String>,
}

impl Faults {
    /// Notes an error that is due to the key at `path`. A key is blamed once.
    pub fn note(&mut self, path: &str, error: ScenarioError) {
        if !self.blames(path) {
            self.errors.push(error);
            self.blame(path);
        }
    }

    /// Notes that the key at `path` is dealt with by an error that is there already.
    pub fn blame(&mut self, path: &str) {
        self.paths.push(path.to_owned());
    }

    /// Whether an error deals with the key at `path`.
    pub fn blames(&self, path: &str) -> bool {
        self.paths.iter().any(|blamed| blamed == path)
    }

    /// Whether an error deals with the key at `path`, or with the whole table that it stands in.
    pub fn covers(&self, path: &str) -> bool {
        let mut rest = self
            .paths
            .iter()
            .filter_map(|blamed| path.strip_prefix(blamed.as_str()));
        rest.any(|rest| rest.is_empty() || rest.starts_with('.'))
    }

    /// The keys that errors deal with.
    pub fn paths(&self) -> impl Iterator<Item = &str> {
        self.paths.iter().map(String::as_str)
    }

    /// All errors as one; `None` where there are none.
    pub fn into_error(self) -> Option<ScenarioError> {
        (!self.errors.is_empty()).then(|| ScenarioError::several(self.errors))
    }
}

impl ScenarioError {
    /// Errors as one.
    pub(super) fn several(mut errors: Vec<Self>) -> Self {
        if errors.len() > MOST_ERRORS {
            let more = errors.split_off(MOST_ERRORS - 1).len();
            errors.push(Self::More(more));
        }
        match errors.pop() {
            Some(only) if errors.is_empty() => only,
            last => {
                errors.extend(last);
                Self::Several(errors)
            }
        }
    }
}

fn lines(errors: &[ScenarioError]) -> String {
    let lines: Vec<String> = errors.iter().map(ScenarioError::to_string).collect();
    lines.join("\n")
}

/// `text` on one line, whatever it holds: control and invisible characters become escapes.
pub fn printable(text: &str) -> String {
    const PLAIN: [char; 3] = ['"', '\'', '\\'];
    let mut line = String::with_capacity(text.len());
    // Quotes and backslashes are harmless, and would only be harder to read as escapes.
    for piece in text.split_inclusive(PLAIN) {
        let (body, plain) = match piece.char_indices().next_back() {
            Some((at, last)) if PLAIN.contains(&last) => (&piece[..at], Some(last)),
            _ => (piece, None),
        };
        line.extend(body.escape_debug());
        line.extend(plain);
    }
    line
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
    pub fn refuse(&self, path: &str, value: &str, rule: impl Into<String>) -> ScenarioError {
        Refusal::new(self.place(path, value), rule.into()).into()
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

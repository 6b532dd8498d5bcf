//! Scenario errors: one line that says what is wrong, where, and what would be right.

use thiserror::Error;

/// Maximum number of characters of a user's text in an error.
const LONGEST_ECHO: usize = 60;

/// A scenario that cannot be run. Each displays as one line.
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
    /// A value that breaks a rule.
    #[error("{place}: {rule}")]
    Refused {
        /// Origin, dotted path and value.
        place: String,
        /// What would be right.
        rule: String,
    },
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
        ScenarioError::Refused {
            place: self.place(path, value),
            rule: rule.into(),
        }
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

//! One key that changes during a run, and one that is planned to.

use std::fmt;

use toml::Value as Raw;

use super::error::Refusal;
use super::key::{Key, Kind};
use super::typed::is_large_whole;
use super::value::Value;

/// Maximum number of changes of a run. Each is checked by assembling the scenario that results.
pub const MOST_CHANGES: usize = 1_000;

/// `[[changes]]`: one key that was changed during the run.
#[derive(Debug, Clone, PartialEq)]
pub struct Change {
    /// Cycles since the start.
    pub at_cycle: f64,
    /// The key.
    pub key: Key,
    /// Its new value.
    pub value: Value,
}

impl Change {
    /// Reads `KEY = VALUE`, with the value as TOML or as a bare word, in SI units.
    ///
    /// # Errors
    ///
    /// If the text is no assignment, or the key cannot have the value, or not during a run.
    pub fn parse(at_cycle: f64, set: &str) -> Result<Self, Refusal> {
        Planned::read(at_cycle, set, set.to_owned())?.change(false)
    }
}

/// `KEY = VALUE`.
impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {}", self.key.path, self.value.literal())
    }
}

/// A change as it was given: what its value means depends on the scenario that it changes.
pub(super) struct Planned {
    pub at_cycle: f64,
    pub key: Key,
    pub raw: Raw,
    /// Where it was given, for messages.
    pub place: String,
}

impl Planned {
    /// Reads `KEY = VALUE`.
    pub fn read(at_cycle: f64, set: &str, place: String) -> Result<Self, Refusal> {
        let (key, text) = split(set, &place)?;
        Self::new(at_cycle, key, |key| parsed(key, text), place)
    }

    /// Plans a change of the key at `path`.
    pub fn new(
        at_cycle: f64,
        path: &str,
        raw: impl FnOnce(Key) -> Raw,
        place: String,
    ) -> Result<Self, Refusal> {
        let key = Key::named(path, &place)?;
        if let Some(because) = key.fixed {
            let rule = format!("{path} cannot change during a run: {because}");
            return Err(Refusal::new(place, rule));
        }
        let raw = raw(key);
        Ok(Self {
            at_cycle,
            key,
            raw,
            place,
        })
    }

    /// Reads the value, in a motion that prescribes a force or a displacement.
    pub fn change(&self, is_force: bool) -> Result<Change, Refusal> {
        let value = Value::read(&mut self.raw.clone(), self.key, is_force);
        Ok(Change {
            at_cycle: self.at_cycle,
            key: self.key,
            value: value.map_err(|rule| Refusal::new(&self.place, rule))?,
        })
    }
}

/// Parses the value of an assignment as TOML, or takes the bare text.
pub(super) fn parsed(key: Key, text: &str) -> Raw {
    if key.kind == Kind::Number && is_large_whole(text) {
        let number = text.parse();
        return number.map_or_else(|_| Raw::String(text.to_owned()), Raw::Float);
    }
    match (key.kind, text.parse::<Raw>()) {
        (Kind::Text | Kind::Choice(_), Ok(Raw::String(text))) => Raw::String(text),
        (Kind::Text | Kind::Choice(_), _) | (_, Err(_)) => Raw::String(text.to_owned()),
        (_, Ok(raw)) => raw,
    }
}

/// Splits `KEY=VALUE`, found at `place`.
pub(crate) fn split<'a>(text: &'a str, place: &str) -> Result<(&'a str, &'a str), Refusal> {
    let (key, value) = text.split_once('=').unwrap_or_default();
    let (key, value) = (key.trim(), value.trim());
    let rule = "must be KEY=VALUE, as in numerics.points=400";
    let whole = (!key.is_empty() && !value.is_empty()).then_some((key, value));
    whole.ok_or_else(|| Refusal::new(place, rule))
}

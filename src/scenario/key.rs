//! The keys of a scenario.
//!
//! `keys.toml` describes each key once. To add a key: its block there, and a field of that name in [`spec`](super::spec);
//! what is made of it, in `setup`. The table serves the reader, the errors and their hints, `--set`, the form of
//! the explorer, completion, written scenarios, the axes of figures and the documentation.

use std::collections::BTreeMap;
use std::fmt;
use std::ops::Deref;
use std::sync::LazyLock;

use serde::Deserialize;

pub use super::kind::{Default, Kind, Range, Word};
use crate::math::abel::AbelMethod;

/// A key of a scenario.
#[derive(Clone, Copy)]
pub struct Key(&'static Parameter);

/// What the table says of a key.
#[derive(Debug, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Parameter {
    /// The dotted path, as for `--set`.
    pub path: &'static str,
    /// The unit; empty for a pure number or a word.
    pub unit: &'static str,
    /// Its meaning, in one line.
    pub meaning: &'static str,
    /// Its name on an axis of a figure, if its meaning is too long.
    pub label: Option<&'static str>,
    /// The effect of a greater value, or of another word, on the contact; empty if it cannot change during a run.
    pub effect: &'static str,
    /// Why it cannot change during a run; `None` if it can.
    pub fixed: Option<&'static str>,
    /// The kind of its value.
    pub kind: Kind,
    /// The allowed numbers.
    pub range: Range,
    /// Maximum number of entries of a list; `None` for any number.
    pub(super) most: Option<usize>,
    /// Its default.
    pub default: Default,
    /// The words of other keys with which the key is used; empty for all.
    pub used_by: BTreeMap<&'static str, Vec<&'static str>>,
    /// A textbook's letter or another program's words for it.
    pub(super) also: Vec<&'static str>,
    /// Remark after its name in a hint, if one of these words was given.
    pub(super) remark: &'static str,
}

impl Parameter {
    /// Returns the table that contains the key: everything before the last dot.
    pub fn section(&self) -> &'static str {
        split(self.path).0
    }

    /// Returns the key within its table: everything after the last dot.
    pub fn key(&self) -> &'static str {
        split(self.path).1
    }

    /// Returns its meaning, with the unit.
    pub fn described(&self) -> String {
        match (self.kind, self.unit) {
            (Kind::Choice(_), _) => format!("{}, {}", self.meaning, self.kind.wanted()),
            (_, "") => self.meaning.to_owned(),
            (_, unit) => format!("{}, {unit}", self.meaning),
        }
    }

    /// Returns the only shapes of the indenter that take the key, if not all do.
    pub(super) fn shapes(&self) -> Option<&Vec<&'static str>> {
        self.used_by.get("indenter.shape")
    }

    /// Returns the meaning of `word` as its value; `None` for words that it does not accept.
    pub fn meaning_of(&self, word: &str) -> Option<&'static str> {
        let Kind::Choice(words) = self.kind else {
            return None;
        };
        if let ("method", Ok(method)) = (self.key(), word.parse()) {
            return Some(AbelMethod::traits(method).description);
        }
        let known = words.iter().find(|known| known.word == word)?;
        Some(known.meaning)
    }

    /// Describes the range, to follow the name of the kind; empty if every number is allowed.
    pub fn allowed(&self) -> String {
        match (self.kind, self.range) {
            (_, Range::Any) => String::new(),
            (Kind::Numbers, range) => format!(", each {range}"),
            (_, Range::NotNegative) => " of 0 or greater".into(),
            (_, range) => format!(" {range}"),
        }
    }
}

/// Keys that exclude each other: each of the first excludes each of the others.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Exclusive {
    pub keys: Vec<&'static str>,
    pub others: Vec<&'static str>,
    /// Completes "conflicts with"; `{}` stands for the other key.
    pub rule: &'static str,
    /// Whether they have the same meaning, so that assigning one replaces the others.
    #[serde(default, rename = "twins")]
    pub are_twins: bool,
}

/// Keys whose assignment makes another key stale, which is then dropped.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Stale {
    pub keys: Vec<&'static str>,
    pub dropped: &'static str,
}

/// A list of numbers in a scenario, and the name of its column in a file.
type List = (&'static str, &'static str);

/// A key that names a file, and its two columns. Of alternative names for a column, the first in the file counts.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Embedded {
    pub key: &'static str,
    pub lists: [Vec<List>; 2],
}

/// Contents of `keys.toml`.
#[derive(Deserialize)]
#[serde(bound(deserialize = "'de: 'static"))]
pub(super) struct Schema {
    #[serde(rename = "key")]
    keys: Vec<Parameter>,
    pub exclusive: Vec<Exclusive>,
    pub stale: Vec<Stale>,
    #[serde(rename = "file")]
    pub files: Vec<Embedded>,
}

pub(super) static SCHEMA: LazyLock<Schema> = LazyLock::new(|| {
    toml::from_str(include_str!("keys.toml")).expect("the table of keys is whole")
});

impl Key {
    /// Iterates over all keys, in the order of written scenarios.
    pub fn all() -> impl Iterator<Item = Self> + Clone {
        SCHEMA.keys.iter().map(Self)
    }

    /// Finds the key with this dotted path.
    pub fn find(path: &str) -> Option<Self> {
        Self::all().find(|key| key.path == path)
    }

    /// Returns a key that must exist.
    pub(super) fn known(path: &str) -> Self {
        Self::find(path).expect("a key of the table")
    }

    /// Iterates over the keys that an assignment to this one replaces or makes stale.
    pub(super) fn displaces(self) -> impl Iterator<Item = Self> {
        let twins = SCHEMA.exclusive.iter().filter(|of| of.are_twins);
        let sides = twins.flat_map(|of| [(&of.keys, &of.others), (&of.others, &of.keys)]);
        let sides = sides.filter(move |(keys, _)| keys.contains(&self.path));
        let stale = SCHEMA.stale.iter();
        let stale = stale.filter(move |of| of.keys.contains(&self.path));
        let replaced = sides.flat_map(|(_, others)| others);
        replaced
            .chain(stale.map(|of| &of.dropped))
            .map(|path| Self::known(path))
    }
}

impl Deref for Key {
    type Target = Parameter;

    fn deref(&self) -> &Parameter {
        self.0
    }
}

impl PartialEq for Key {
    fn eq(&self, other: &Self) -> bool {
        self.path == other.path
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.path)
    }
}

impl fmt::Debug for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// Whether `path` is a table that contains keys, directly or in sub-tables.
pub(super) fn is_section(path: &str) -> bool {
    Key::all().any(|key| {
        let rest = key.path.strip_prefix(path);
        rest.is_some_and(|rest| rest.starts_with('.'))
    })
}

/// Returns the dotted path of a key in the table at `path`.
pub(crate) fn join(path: &str, key: &str) -> String {
    match path {
        "" => key.to_owned(),
        path => format!("{path}.{key}"),
    }
}

/// Splits a dotted path into its table and its key.
pub(crate) fn split(path: &str) -> (&str, &str) {
    path.rsplit_once('.').unwrap_or(("", path))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::indenter::Shape;
    use crate::math::grid::{MAX_CELLS, MIN_CELLS};
    use crate::scenario::units::PRESCRIBED;
    use crate::scenario::{MOST_CYCLES, MOST_SNAPSHOTS};
    use crate::simulation::waveform::Wave;
    use crate::simulation::{Integrator, Scheme, Spacing, Stability};
    use crate::wear::Law;
    use strum::VariantNames;

    #[test]
    fn every_key_says_what_it_means_and_stands_once() {
        for (i, parameter) in Key::all().enumerate() {
            assert!(!parameter.meaning.is_empty(), "{}", parameter.path);
            assert!(
                Key::all().take(i).all(|other| other.path != parameter.path),
                "{} stands twice",
                parameter.path
            );
            for (path, words) in &parameter.used_by {
                let known = Key::known(path).kind.words().expect("words");
                assert!(words.iter().all(|word| known.contains(word)));
            }
            let changes = !["", "run", "changes"].contains(&parameter.section());
            assert_eq!(!parameter.effect.is_empty(), changes, "{}", parameter.path);
            assert!(parameter.effect.chars().count() <= 76, "{}", parameter.path);
        }
    }

    #[test]
    fn defaults_are_values_of_their_own_key() {
        for parameter in Key::all() {
            if let Some(value) = parameter.default.value() {
                let value =
                    crate::scenario::value::Value::read(&mut value.clone(), parameter, false);
                assert!(value.is_ok(), "{}", parameter.path);
            }
        }
    }

    #[test]
    fn every_word_of_every_choice_has_a_meaning() {
        for parameter in Key::all() {
            if let Kind::Choice(words) = parameter.kind {
                for Word { word, .. } in words {
                    let meaning = parameter.meaning_of(word).unwrap_or_default();
                    let length = meaning.chars().count();
                    assert!((1..=66).contains(&length), "{}: {word}", parameter.path);
                }
            }
        }
    }

    #[test]
    fn the_table_is_that_of_the_program() {
        for (path, names) in [
            ("indenter.shape", Shape::VARIANTS),
            ("motion.normal.waveform", Wave::VARIANTS),
            ("motion.tangential.waveform", Wave::VARIANTS),
            ("wear.law", Law::VARIANTS),
            ("numerics.method", AbelMethod::VARIANTS),
            ("numerics.grid", Spacing::VARIANTS),
            ("numerics.scheme", Scheme::VARIANTS),
            ("numerics.stability", Stability::VARIANTS),
            ("numerics.integrator", Integrator::NAMES),
        ] {
            let known = Key::find(path).expect("a key");
            assert_eq!(known.kind.words().as_deref(), Some(names), "{path}");
        }
        let key = Key::find("numerics.method").expect("a key");
        let method = key.default.value().and_then(|word| word.as_str());
        assert_eq!(method, Some(AbelMethod::default().name()));
        let points = Key::find("numerics.points").expect("a key").range;
        assert_eq!(points, Range::Within(MIN_CELLS as f64, MAX_CELLS as f64));
        let cycles = Key::find("run.cycles").expect("a key").range;
        assert_eq!(cycles, Range::Within(0.0, MOST_CYCLES));
        let snapshots = Key::find("run.snapshot_at").expect("a key").most;
        assert_eq!(snapshots, Some(MOST_SNAPSHOTS));
        // Both directions of the motion have the same keys, except for the rig and the gauge.
        let of = |section: &'static str| {
            let keys = Key::all().filter(move |known| known.section() == section);
            keys.filter(|known| !["rig_stiffness", "gauge_length"].contains(&known.key()))
        };
        for (normal, tangential) in of("motion.normal").zip(of("motion.tangential")) {
            assert_eq!(normal.key(), tangential.key());
            assert_eq!(normal.unit, tangential.unit);
            assert_eq!(normal.kind, tangential.kind);
            assert_eq!(normal.range, tangential.range);
        }
        assert_eq!(
            Key::find("motion.normal.mean").map(|known| known.unit),
            Some(PRESCRIBED)
        );
    }
}

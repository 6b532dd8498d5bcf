//! The description of a scenario key, and the look-up of keys.
//!
//! `keys.toml` describes each key once. That table feeds the reader, the errors and their hints, `--set`, the form of
//! the explorer, completion, written scenarios, the axes of figures and the documentation.

use std::str::FromStr;
use std::sync::LazyLock;

use serde::Deserialize;
use serde::de::DeserializeOwned;
use toml::{Table, Value};

pub use super::kind::{Default, Kind, Range, Word};
use super::values::{at, number, split};
use crate::math::abel::AbelMethod;

/// One key of a scenario.
#[derive(Debug, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Parameter {
    /// The dotted path, as `--set` takes it.
    pub path: &'static str,
    /// The unit, or nothing for a pure number or a word.
    pub unit: &'static str,
    /// What it means, in one line.
    pub meaning: &'static str,
    /// Its name on an axis of a figure, where its meaning is too long for one.
    pub label: Option<&'static str>,
    /// What a greater value, or another word, does to the contact; empty where it cannot change
    /// during a run.
    pub effect: &'static str,
    /// Why it cannot change during a run; `None` where it can.
    pub fixed: Option<&'static str>,
    /// What its value looks like.
    pub kind: Kind,
    /// The numbers that are allowed.
    pub range: Range,
    /// How many entries a list may have; `None`: any number.
    pub(super) most: Option<usize>,
    /// What holds where it is not given.
    pub default: Default,
    /// The indenter shapes that take the key; empty where the shape does not matter.
    pub shapes: Vec<&'static str>,
    /// A textbook's letter or another program's words for it.
    pub(super) also: Vec<&'static str>,
    /// What stands behind its name where it is meant by one of these.
    pub(super) remark: &'static str,
}

impl Parameter {
    /// The table the key stands in: everything before the last dot.
    pub fn section(&self) -> &'static str {
        split(self.path).0
    }

    /// The key within its table: everything after the last dot.
    pub fn key(&self) -> &'static str {
        split(self.path).1
    }

    /// What it means, with the unit.
    pub fn described(&self) -> String {
        match (self.kind, self.unit) {
            (Kind::Choice(_), _) => format!("{}, {}", self.meaning, self.kind.wanted()),
            (_, "") => self.meaning.to_owned(),
            (_, unit) => format!("{}, {unit}", self.meaning),
        }
    }

    /// Whether an indenter of this shape takes the key.
    pub(super) fn is_of(&self, shape: &str) -> bool {
        self.shapes.is_empty() || self.shapes.contains(&shape)
    }

    /// What `word` means as its value; `None` for words that it does not take.
    pub fn meaning_of(&self, word: &str) -> Option<&'static str> {
        let Kind::Choice(words) = self.kind else {
            return None;
        };
        if let ("method", Ok(method)) = (self.key(), word.parse()) {
            return Some(AbelMethod::description(method));
        }
        let known = words.iter().find(|known| known.word == word)?;
        Some(known.meaning)
    }

    /// Some value that is allowed, to see what else a scenario lacks; `None` for texts and lists.
    pub(super) fn any_value(&self) -> Option<Value> {
        let number = match self.range {
            Range::Within(least, most) => 1f64.clamp(least, most),
            Range::UpTo(most) => most.min(1.0),
            _ => 1.0,
        };
        match self.kind {
            Kind::Number => Some(Value::Float(number)),
            Kind::Whole => Some(Value::Integer(number as i64)),
            Kind::Flag => Some(Value::Boolean(true)),
            Kind::Choice(words) => Some(words.first()?.word.into()),
            Kind::Text | Kind::Numbers => None,
        }
    }

    /// The range, to follow the name of the kind; empty where every number is allowed.
    pub fn allowed(&self) -> String {
        match (self.kind, self.range) {
            (_, Range::Any) => String::new(),
            (Kind::Numbers, range) => format!(", each {range}"),
            (_, Range::NotNegative) => " of 0 or greater".into(),
            (_, range) => format!(" {range}"),
        }
    }

    /// Whether every number in `value`, which is of the right kind, is allowed.
    pub(super) fn allows(&self, value: &Value) -> bool {
        let within = |value: &Value| number(value).is_none_or(|number| self.range.holds(number));
        match value {
            Value::Array(list) => list.iter().all(within),
            value => within(value),
        }
    }
}

/// Keys that exclude each other: each of the first, each of the others.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Exclusive {
    pub keys: Vec<&'static str>,
    pub others: Vec<&'static str>,
    /// What one of the keys conflicts with, `{}` for the one of the others, and what would be right.
    pub rule: &'static str,
    /// Whether they stand for the same thing, so that an assignment to one takes the place of the others.
    #[serde(default, rename = "twins")]
    pub are_twins: bool,
}

/// Keys whose assignment makes another one stale, which is dropped.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Stale {
    pub keys: Vec<&'static str>,
    pub dropped: &'static str,
}

/// A list of numbers in a scenario, and the name of the column that it is read from.
type List = (&'static str, &'static str);

/// A key that names a file, and its two columns; of those that may stand for each, the first that the file has.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Embedded {
    pub key: &'static str,
    pub lists: [Vec<List>; 2],
}

/// What `keys.toml` says.
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

/// All keys, in the order in which a scenario is written.
pub fn parameters() -> impl Iterator<Item = &'static Parameter> + Clone {
    SCHEMA.keys.iter()
}

/// The description of a key that the program names.
pub(super) fn known(path: &str) -> &'static Parameter {
    find(path).expect("a key of the table")
}

/// The parameter with this dotted path.
pub fn find(path: &str) -> Option<&'static Parameter> {
    parameters().find(|parameter| parameter.path == path)
}

/// Whether `path` is a table that holds parameters, directly or in tables of its own.
pub(super) fn is_section(path: &str) -> bool {
    parameters().any(|parameter| {
        let rest = parameter.path.strip_prefix(path);
        rest.is_some_and(|rest| rest.starts_with('.'))
    })
}

/// The value of a key or a whole section in `table` as a `T`, where one of that type is given.
pub(super) fn read<T: DeserializeOwned>(table: &Table, path: &str) -> Option<T> {
    debug_assert!(find(path).is_some() || is_section(path), "{path} is known");
    at(table, path)?.clone().try_into().ok()
}

/// What the word of a key in `table` names, where one is given.
pub(super) fn named<T: FromStr>(table: &Table, path: &str) -> Option<T> {
    read::<String>(table, path)?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::grid::{MAX_CELLS, MIN_CELLS};
    use crate::scenario::units::PRESCRIBED;
    use crate::scenario::{MOST_CYCLES, MOST_SNAPSHOTS};
    use crate::simulation::{Integrator, Scheme, Spacing, Stability};
    use strum::VariantNames;

    #[test]
    fn every_key_says_what_it_means_and_stands_once() {
        let shapes = known("indenter.shape").kind.words().expect("words");
        for (i, parameter) in parameters().enumerate() {
            assert!(!parameter.meaning.is_empty(), "{}", parameter.path);
            assert!(
                parameters()
                    .take(i)
                    .all(|other| other.path != parameter.path),
                "{} stands twice",
                parameter.path
            );
            assert!(parameter.shapes.iter().all(|shape| shapes.contains(shape)));
            let changes = !["", "run", "changes"].contains(&parameter.section());
            assert_eq!(!parameter.effect.is_empty(), changes, "{}", parameter.path);
            assert!(parameter.effect.chars().count() <= 76, "{}", parameter.path);
        }
    }

    #[test]
    fn defaults_are_values_of_their_own_key() {
        for parameter in parameters() {
            if let Some(value) = parameter.default.value() {
                assert!(parameter.kind.fits(value), "{}", parameter.path);
                assert!(parameter.allows(value), "{}", parameter.path);
            }
        }
    }

    #[test]
    fn every_word_of_every_choice_has_a_meaning() {
        for parameter in parameters() {
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
            ("numerics.method", AbelMethod::VARIANTS),
            ("numerics.grid", Spacing::VARIANTS),
            ("numerics.scheme", Scheme::VARIANTS),
            ("numerics.stability", Stability::VARIANTS),
            ("numerics.integrator", Integrator::NAMES),
        ] {
            let known = find(path).expect("a key");
            assert_eq!(known.kind.words().as_deref(), Some(names), "{path}");
        }
        let points = find("numerics.points").expect("a key").range;
        assert_eq!(points, Range::Within(MIN_CELLS as f64, MAX_CELLS as f64));
        let cycles = find("run.cycles").expect("a key").range;
        assert_eq!(cycles, Range::Within(0.0, MOST_CYCLES));
        let snapshots = find("run.snapshot_at").expect("a key").most;
        assert_eq!(snapshots, Some(MOST_SNAPSHOTS));
        // Both directions of the motion have the same keys, but for the rig and the gauge.
        let of = |section: &'static str| {
            let keys = parameters().filter(move |known| known.section() == section);
            keys.filter(|known| !["rig_stiffness", "gauge_length"].contains(&known.key()))
        };
        for (normal, tangential) in of("motion.normal").zip(of("motion.tangential")) {
            assert_eq!(normal.key(), tangential.key());
            assert_eq!(normal.unit, tangential.unit);
            assert_eq!(normal.kind, tangential.kind);
            assert_eq!(normal.range, tangential.range);
        }
        assert_eq!(
            find("motion.normal.mean").map(|known| known.unit),
            Some(PRESCRIBED)
        );
    }
}

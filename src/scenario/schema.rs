//! The description of a scenario key, and the look-up of keys and of their values.
//!
//! [`keys`](super::keys) lists the keys themselves. That table feeds the reader, the errors,
//! `--set`, the form of the explorer, completion, written scenarios and the documentation.

use std::fmt;
use std::str::FromStr;

use toml::{Table, Value};

use super::keys::PARAMETERS;

/// The type of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A finite number.
    Number,
    /// A whole number.
    Whole,
    /// `true` or `false`.
    Flag,
    /// Any text.
    Text,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// A list of finite numbers.
    Numbers,
}

impl Kind {
    /// The rule as words after "must be".
    pub fn wanted(self) -> String {
        match self {
            Self::Number => "a finite number".into(),
            Self::Whole => "a whole number".into(),
            Self::Flag => "true or false".into(),
            Self::Text => "a text".into(),
            Self::Choice([only]) => format!("\"{only}\""),
            Self::Choice(words) => {
                let words: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
                format!("one of {}", words.join(", "))
            }
            Self::Numbers => "a list of finite numbers".into(),
        }
    }

    /// Whether `value` is of this kind. Numbers must be finite, words known.
    pub fn fits(self, value: &Value) -> bool {
        match self {
            Self::Number => number(value).is_some(),
            Self::Whole => value.is_integer(),
            Self::Flag => value.is_bool(),
            Self::Text => value.is_str(),
            Self::Choice(words) => value.as_str().is_some_and(|word| words.contains(&word)),
            Self::Numbers => numbers(value).is_some(),
        }
    }
}

/// The numbers that are allowed; for a list, each of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Range {
    /// Every finite number, and whatever is no number.
    Any,
    /// Greater than 0.
    Positive,
    /// 0 or greater.
    NotNegative,
    /// From the first to the second, both included.
    Within(f64, f64),
    /// Greater than 0, at most this.
    UpTo(f64),
    /// An angle of a flank: greater than 0 and less than π/2.
    Acute,
}

impl Range {
    /// Whether the number is allowed.
    pub fn holds(self, number: f64) -> bool {
        match self {
            Self::Any => true,
            Self::Positive => number > 0.0,
            Self::NotNegative => number >= 0.0,
            Self::Within(least, most) => (least..=most).contains(&number),
            Self::UpTo(most) => number > 0.0 && number <= most,
            Self::Acute => number > 0.0 && number < std::f64::consts::FRAC_PI_2,
        }
    }
}

/// As it stands after "must be"; nothing where every number is allowed.
impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Any => Ok(()),
            Self::Positive => f.write_str("greater than 0"),
            Self::NotNegative => f.write_str("0 or greater"),
            Self::Within(least, most) if *least > 0.0 && *least < 1e-3 => {
                write!(f, "from {least:e} to {most}")
            }
            Self::Within(least, most) => write!(f, "from {least} to {most}"),
            Self::UpTo(most) => write!(f, "greater than 0, at most {most}"),
            Self::Acute => f.write_str("greater than 0 and less than pi/2"),
        }
    }
}

/// The default of a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Default {
    /// Nothing: the key must be given where it is needed.
    None,
    /// This TOML value, written into a scenario that is saved, since it may change between versions.
    Written(&'static str),
    /// This TOML value.
    Implied(&'static str),
    /// Depends on the rest of the scenario, as described.
    Derived(&'static str),
}

/// One key of a scenario.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameter {
    /// The dotted path, as `--set` takes it.
    pub path: &'static str,
    /// The unit, or nothing for a pure number or a word.
    pub unit: &'static str,
    /// What it means, in one line.
    pub meaning: &'static str,
    /// What a greater value, or another word, does to the contact; empty where it cannot change
    /// during a run.
    pub effect: &'static str,
    /// What its value looks like.
    pub kind: Kind,
    /// The numbers that are allowed.
    pub range: Range,
    /// What holds where it is not given.
    pub default: Default,
    /// The indenter shapes that take the key; empty where the shape does not matter.
    pub shapes: &'static [&'static str],
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
        let range = match self.kind {
            Kind::Choice(_) => format!(", {}", self.kind.wanted()),
            _ => String::new(),
        };
        match self.unit {
            "" => format!("{}{range}", self.meaning),
            unit => format!("{}, {unit}", self.meaning),
        }
    }

    /// Whether an indenter of this shape takes the key.
    pub(super) fn is_of(&self, shape: &str) -> bool {
        self.shapes.is_empty() || self.shapes.contains(&shape)
    }

    /// Why it cannot change during a run; `None` where it can.
    pub fn fixed(&self) -> Option<&'static str> {
        let because = match self.path {
            "title" | "description" => "it names the whole run",
            "numerics.accuracy" => {
                "it has chosen points and steps before the run: change those, or use < and >"
            }
            "wear.share" => "what has worn so far was shared by it",
            path if path.starts_with("run.") => "it plans the whole run",
            path if path.starts_with("wear.initial") => "the run began with it",
            path if path.ends_with(".file") => "it was read before the run",
            _ => return None,
        };
        Some(because)
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
            Kind::Choice(words) => words.first().map(|word| Value::String((*word).to_owned())),
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

/// A key together with the type that it is read as.
#[derive(Debug, Clone, Copy)]
pub struct Key<T: 'static> {
    /// Its description.
    pub parameter: Parameter,
    read: fn(&Value) -> Option<T>,
}

impl<T> Key<T> {
    /// The value in `table`, where one of the right kind is given.
    pub fn get(&self, table: &Table) -> Option<T> {
        at(table, self.parameter.path).and_then(self.read)
    }

    /// The value in `table`, or the default, if the key has one that can be written down.
    pub fn get_or_default(&self, table: &Table) -> Option<T> {
        let default = || match self.parameter.default {
            Default::Written(text) | Default::Implied(text) => text.parse().ok(),
            Default::None | Default::Derived(_) => None,
        };
        self.get(table)
            .or_else(|| default().as_ref().and_then(self.read))
    }

    /// The dotted path.
    pub const fn path(&self) -> &'static str {
        self.parameter.path
    }

    const fn within(mut self, unit: &'static str, range: Range) -> Self {
        self.parameter.unit = unit;
        self.parameter.range = range;
        self
    }

    /// What the key does, to be told where it can be changed.
    pub(super) const fn effect(mut self, effect: &'static str) -> Self {
        self.parameter.effect = effect;
        self
    }

    /// The default.
    pub(super) const fn default(mut self, default: Default) -> Self {
        self.parameter.default = default;
        self
    }

    /// The shapes of the indenter that take the key.
    pub(super) const fn of_shapes(mut self, shapes: &'static [&'static str]) -> Self {
        self.parameter.shapes = shapes;
        self
    }
}

/// A key of a type.
const fn key<T>(
    path: &'static str,
    kind: Kind,
    read: fn(&Value) -> Option<T>,
    meaning: &'static str,
) -> Key<T> {
    let parameter = Parameter {
        path,
        unit: "",
        meaning,
        effect: "",
        kind,
        range: Range::Any,
        default: Default::None,
        shapes: &[],
    };
    Key { parameter, read }
}

/// A number with a unit and a range.
pub(super) const fn quantity(
    path: &'static str,
    unit: &'static str,
    range: Range,
    meaning: &'static str,
) -> Key<f64> {
    let key = key(path, Kind::Number, number, meaning);
    key.within(unit, range)
}

/// A list of numbers.
pub(super) const fn quantities(
    path: &'static str,
    unit: &'static str,
    range: Range,
    meaning: &'static str,
) -> Key<Vec<f64>> {
    let key = key(path, Kind::Numbers, numbers, meaning);
    key.within(unit, range)
}

/// A whole number.
pub(super) const fn count(path: &'static str, range: Range, meaning: &'static str) -> Key<u32> {
    key(path, Kind::Whole, whole, meaning).within("", range)
}

/// Yes or no.
pub(super) const fn flag(path: &'static str, meaning: &'static str) -> Key<bool> {
    key(path, Kind::Flag, Value::as_bool, meaning)
}

/// A text.
pub(super) const fn text(path: &'static str, meaning: &'static str) -> Key<String> {
    key(path, Kind::Text, word, meaning)
}

/// One of some words, which `T` is read from.
pub(super) const fn choice<T: FromStr>(
    path: &'static str,
    words: &'static [&'static str],
    meaning: &'static str,
) -> Key<T> {
    key(path, Kind::Choice(words), word, meaning)
}

/// A finite number, whole or not.
pub(super) fn number(value: &Value) -> Option<f64> {
    match value {
        Value::Integer(whole) => Some(*whole as f64),
        Value::Float(number) => Some(*number).filter(|number| number.is_finite()),
        _ => None,
    }
}

fn numbers(value: &Value) -> Option<Vec<f64>> {
    value.as_array()?.iter().map(number).collect()
}

fn whole(value: &Value) -> Option<u32> {
    value.as_integer()?.try_into().ok()
}

fn word<T: FromStr>(value: &Value) -> Option<T> {
    value.as_str()?.parse().ok()
}

/// The value at a dotted path.
pub(super) fn at<'a>(table: &'a Table, path: &str) -> Option<&'a Value> {
    match path.split_once('.') {
        None => table.get(path),
        Some((first, rest)) => at(table.get(first)?.as_table()?, rest),
    }
}

/// Writes the value, making the tables on the way. Where something else stands in the way of a
/// table, it stays, and the check of all keys will find it.
pub(super) fn insert(table: &mut Table, path: &str, value: Value) {
    match path.split_once('.') {
        None => {
            table.insert(path.to_owned(), value);
        }
        Some((first, rest)) => {
            let entry = table
                .entry(first)
                .or_insert_with(|| Value::Table(Table::new()));
            if let Value::Table(inner) = entry {
                insert(inner, rest, value);
            }
        }
    }
}

/// Takes the value at a dotted path away.
pub(super) fn remove(table: &mut Table, path: &str) -> Option<Value> {
    match path.split_once('.') {
        None => table.remove(path),
        Some((first, rest)) => remove(table.get_mut(first)?.as_table_mut()?, rest),
    }
}

/// The dotted path of a key in the table at `path`.
pub(super) fn join(path: &str, key: &str) -> String {
    match path {
        "" => key.to_owned(),
        path => format!("{path}.{key}"),
    }
}

/// Splits a dotted path into its table and its key.
pub(super) fn split(path: &str) -> (&str, &str) {
    path.rsplit_once('.').unwrap_or(("", path))
}

/// The parameter with this dotted path.
pub fn find(path: &str) -> Option<&'static Parameter> {
    PARAMETERS.iter().find(|parameter| parameter.path == path)
}

/// Whether `path` is a table that holds parameters, directly or in tables of its own.
pub(super) fn is_section(path: &str) -> bool {
    PARAMETERS.iter().any(|parameter| {
        let rest = parameter.path.strip_prefix(path);
        rest.is_some_and(|rest| rest.starts_with('.'))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::keys::SHAPES;

    #[test]
    fn every_key_says_what_it_means_and_stands_once() {
        for (i, parameter) in PARAMETERS.iter().enumerate() {
            assert!(!parameter.meaning.is_empty(), "{}", parameter.path);
            assert!(
                PARAMETERS[..i]
                    .iter()
                    .all(|other| other.path != parameter.path),
                "{} stands twice",
                parameter.path
            );
            assert!(parameter.shapes.iter().all(|shape| SHAPES.contains(shape)));
            let changes = !["", "run", "changes"].contains(&parameter.section());
            assert_eq!(!parameter.effect.is_empty(), changes, "{}", parameter.path);
            assert!(parameter.effect.chars().count() <= 76, "{}", parameter.path);
        }
    }

    #[test]
    fn defaults_are_values_of_their_own_key() {
        for parameter in PARAMETERS {
            if let Default::Written(text) | Default::Implied(text) = parameter.default {
                let value: Value = text.parse().expect("a TOML value");
                assert!(parameter.kind.fits(&value), "{}", parameter.path);
                assert!(parameter.allows(&value), "{}", parameter.path);
            }
        }
    }
}

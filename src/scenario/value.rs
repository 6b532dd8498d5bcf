//! The value of a key, and the fields of a scenario that hold values.

use toml::Value as Raw;

use super::hints;
use super::schema::{Kind, Parameter};
use super::units;
use super::values::{self, number};

/// The value of a key, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A finite number.
    Number(f64),
    /// A whole number.
    Whole(i64),
    /// `true` or `false`.
    Flag(bool),
    /// A text.
    Text(String),
    /// A word of the key's list.
    Word(&'static str),
    /// A list of finite numbers.
    Numbers(Vec<f64>),
}

impl Value {
    /// Reads what a user wrote for `key`: a number with a unit becomes one in SI units.
    ///
    /// # Errors
    /// The rule that it breaks.
    pub(super) fn read(raw: &mut Raw, key: &Parameter, is_force: bool) -> Result<Self, String> {
        let text = raw.as_str().unwrap_or_default();
        match units::quantity(text, key, is_force) {
            Some(Ok(number)) => *raw = Raw::Float(number),
            Some(Err(rule)) => {
                return Err(units::of_other_control(text, key).map_or(rule, str::to_owned));
            }
            None => {}
        }
        let Some(value) = Self::of_kind(raw, key.kind) else {
            let instead = hints::suggest(key, raw);
            return Err(format!(
                "must be {}{}{instead}",
                key.kind.wanted(),
                key.allowed()
            ));
        };
        value.check(key).map(|()| value)
    }

    fn of_kind(raw: &Raw, kind: Kind) -> Option<Self> {
        Some(match kind {
            Kind::Number => Self::Number(number(raw)?),
            Kind::Whole => Self::Whole(raw.as_integer()?),
            Kind::Flag => Self::Flag(raw.as_bool()?),
            Kind::Text => Self::Text(raw.as_str()?.to_owned()),
            Kind::Choice(words) => {
                let known = words.iter().find(|known| Some(known.word) == raw.as_str());
                Self::Word(known?.word)
            }
            Kind::Numbers => {
                Self::Numbers(raw.as_array()?.iter().map(number).collect::<Option<_>>()?)
            }
        })
    }

    /// Checks the range of its numbers, and their count.
    pub(super) fn check(&self, key: &Parameter) -> Result<(), String> {
        let finite = |number: &f64| number.is_finite();
        let (numbers, each) = match self {
            Self::Number(number) => (std::slice::from_ref(number), ""),
            Self::Whole(whole) if key.range.holds(*whole as f64) => return Ok(()),
            Self::Whole(_) => return Err(format!("must be {}", key.range)),
            Self::Numbers(list) => (list.as_slice(), "each "),
            _ => return Ok(()),
        };
        if !numbers.iter().all(finite) {
            return Err(format!("must be {}{}", key.kind.wanted(), key.allowed()));
        }
        if let Some(most) = key.most.filter(|most| numbers.len() > *most) {
            return Err(format!(
                "must have at most {most} entries, not {}",
                numbers.len()
            ));
        }
        if numbers.iter().all(|number| key.range.holds(*number)) {
            Ok(())
        } else {
            Err(format!("{each}must be {}", key.range))
        }
    }

    /// Formats it as it may follow `=`.
    pub fn literal(&self) -> String {
        match self {
            Self::Number(number) => values::literal(&Raw::Float(*number)),
            Self::Whole(whole) => whole.to_string(),
            Self::Flag(flag) => flag.to_string(),
            Self::Text(text) => values::literal(&Raw::String(text.clone())),
            Self::Word(word) => format!("\"{word}\""),
            Self::Numbers(list) => {
                let list = list
                    .iter()
                    .map(|number| values::literal(&Raw::Float(*number)));
                format!("[{}]", list.collect::<Vec<_>>().join(", "))
            }
        }
    }
}

/// A type that a field can hold.
pub trait Held: Sized {
    /// As a value.
    fn value(&self) -> Value;
    /// Of a value of the kind of its key.
    fn held(value: Value) -> Option<Self>;
}

macro_rules! held {
    ($($type:ty: $variant:ident, $($as:ty)?;)*) => {$(
        impl Held for $type {
            fn value(&self) -> Value {
                Value::$variant(self.clone() $(as $as)?)
            }
            fn held(value: Value) -> Option<Self> {
                let Value::$variant(value) = value else { return None };
                value.try_into().ok()
            }
        }
    )*};
}

held! { f64: Number,; usize: Whole, i64; u32: Whole, i64; bool: Flag,; String: Text,; Vec<f64>: Numbers,; }

macro_rules! words {
    ($($type:ty),* $(,)?) => {$(
        impl Held for $type {
            fn value(&self) -> Value {
                Value::Word((*self).into())
            }
            fn held(value: Value) -> Option<Self> {
                let Value::Word(word) = value else { return None };
                word.parse().ok()
            }
        }
    )*};
}
pub(super) use words;

/// A field that holds the value of a key, or none.
pub trait Field {
    /// The value.
    fn get(&self) -> Option<Value>;
    /// Replaces it.
    fn put(&mut self, value: Option<Value>);
}

impl<T: Held> Field for Option<T> {
    fn get(&self) -> Option<Value> {
        self.as_ref().map(Held::value)
    }

    fn put(&mut self, value: Option<Value>) {
        *self = value.map(|value| Held::held(value).expect("a value of the key's kind"));
    }
}

impl Field for Vec<f64> {
    fn get(&self) -> Option<Value> {
        (!self.is_empty()).then(|| Value::Numbers(self.clone()))
    }

    fn put(&mut self, value: Option<Value>) {
        *self = value.and_then(Held::held).unwrap_or_default();
    }
}

/// Keys of one table.
pub trait Section {
    /// The field of a key.
    fn field(&self, key: &str) -> Option<&dyn Field>;
    /// The same, to be changed.
    fn field_mut(&mut self, key: &str) -> Option<&mut dyn Field>;
}

/// Declares the struct of a table: its keys by their names, then what it holds beside them.
macro_rules! section {
    ($(#[$meta:meta])* $name:ident { $($(#[$doc:meta])* $key:ident: $type:ty,)* }
     $({ $($(#[$more:meta])* $other:ident: $held:ty,)* })?) => {
        $(#[$meta])*
        #[derive(Debug, Clone, PartialEq, Default)]
        pub struct $name {
            $($(#[$doc])* pub $key: $type,)*
            $($($(#[$more])* pub $other: $held,)*)?
        }

        fields! { $name { $($key),* } }
    };
}

/// Finds the fields of a struct by the names of their keys.
macro_rules! fields {
    ($name:ident { $($key:ident),* }) => {
        impl Section for $name {
            fn field(&self, key: &str) -> Option<&dyn Field> {
                match key {
                    $(stringify!($key) => Some(&self.$key),)*
                    _ => None,
                }
            }

            fn field_mut(&mut self, key: &str) -> Option<&mut dyn Field> {
                match key {
                    $(stringify!($key) => Some(&mut self.$key),)*
                    _ => None,
                }
            }
        }
    };
}
pub(super) use {fields, section};

//! The value of a key, how it is read and written, and the fields that hold values.

use toml::Value as Raw;

use super::escape::{echo, printable};
use super::key::{Key, Kind};
use super::{hint, units};

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
    pub fn read(raw: &mut Raw, key: Key, is_force: bool) -> Result<Self, String> {
        let text = raw.as_str().unwrap_or_default();
        match units::quantity(text, &key, is_force) {
            Some(Ok(number)) => *raw = Raw::Float(number),
            Some(Err(rule)) => {
                return Err(units::of_other_control(text, &key).map_or(rule, str::to_owned));
            }
            None => {}
        }
        let Some(value) = Self::of_kind(raw, key.kind) else {
            let instead = hint::suggest(key.kind, raw.as_str());
            let (wanted, allowed) = (key.kind.wanted(), key.allowed());
            return Err(format!("must be {wanted}{allowed}{instead}"));
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
    pub(super) fn check(&self, key: Key) -> Result<(), String> {
        let one = self.number();
        let (numbers, each) = match self {
            Self::Numbers(list) => (list.as_slice(), "each "),
            _ => (one.as_slice(), ""),
        };
        let (count, most) = (numbers.len(), key.most.unwrap_or(usize::MAX));
        if numbers.iter().any(|number| !number.is_finite()) {
            Err(format!("must be {}{}", key.kind.wanted(), key.allowed()))
        } else if count > most {
            Err(format!("must have at most {most} entries, not {count}"))
        } else if numbers.iter().all(|number| key.range.holds(*number)) {
            Ok(())
        } else {
            Err(format!("{each}must be {}", key.range))
        }
    }

    /// Returns it as a number, if it is one.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            Self::Whole(whole) => Some(*whole as f64),
            _ => None,
        }
    }

    /// Formats it as TOML, as it may follow `=`.
    pub fn literal(&self) -> String {
        literal(&self.into())
    }

    /// Formats it as a user types it: words and texts without quotes.
    pub fn bare(&self) -> String {
        match self {
            Self::Word(word) => (*word).to_owned(),
            Self::Text(text) => text.clone(),
            other => other.literal(),
        }
    }
}

impl From<&Value> for Raw {
    fn from(value: &Value) -> Self {
        match value {
            Value::Number(number) => (*number).into(),
            Value::Whole(whole) => (*whole).into(),
            Value::Flag(flag) => (*flag).into(),
            Value::Text(text) => text.as_str().into(),
            Value::Word(word) => (*word).into(),
            Value::Numbers(list) => list.clone().into(),
        }
    }
}

/// Returns a finite number, whole or not.
pub(crate) fn number(value: &Raw) -> Option<f64> {
    match value {
        Raw::Integer(whole) => Some(*whole as f64),
        Raw::Float(number) => Some(*number).filter(|number| number.is_finite()),
        _ => None,
    }
}

/// Formats one value as it may follow `=`.
pub(crate) fn literal(value: &Raw) -> String {
    match value {
        Raw::Float(number) => float(*number),
        Raw::Array(list) => {
            let list: Vec<String> = list.iter().map(literal).collect();
            format!("[{}]", list.join(", "))
        }
        Raw::String(text) if text.chars().any(is_unprintable) => escaped(text),
        other => other.to_string(),
    }
}

/// Whether a terminal or a header line would not show a character unchanged: controls, invisible spaces and marks, and
/// characters that change the direction of text.
fn is_unprintable(c: char) -> bool {
    !matches!(c, '"' | '\'' | '\\') && printable(&String::from_iter(['a', c])).chars().count() > 2
}

/// Formats a basic string on one line, escaping special characters: TOML has the escapes of JSON.
fn escaped(text: &str) -> String {
    let escaped = |c| {
        if is_unprintable(c) {
            format!("\\U{:08X}", u32::from(c))
        } else {
            c.to_string()
        }
    };
    let quoted = serde_json::Value::from(text).to_string();
    quoted.chars().map(escaped).collect()
}

/// Returns the shortest form that reads back to the same bits, and as a float.
fn float(number: f64) -> String {
    let size = number.abs();
    if number != 0.0 && number.is_finite() && !(1e-3..1e6).contains(&size) {
        format!("{number:e}")
    } else if number.is_nan() {
        "nan".to_owned()
    } else {
        format!("{number:?}")
    }
}

/// Formats a length of a measured profile for an error, with three digits.
pub(super) fn length(value: f64) -> String {
    let rounded = format!("{value:.2e}").parse().unwrap_or(value);
    show(&Raw::Float(rounded))
}

/// Formats a value for an error.
pub(super) fn show(value: &Raw) -> String {
    match value {
        Raw::Table(_) => "{...}".to_owned(),
        Raw::String(text) => format!("\"{}\"", echo(text)),
        other => echo(&literal(other)),
    }
}

/// A field that holds the value of a key, or none.
pub trait KeyField {
    /// Returns the value.
    fn get(&self) -> Option<Value>;
    /// Replaces it; a value of another kind is none.
    fn put(&mut self, value: Option<Value>);
}

macro_rules! values {
    ($($type:ty: $variant:ident, $($as:ty)?;)*) => {$(
        impl KeyField for Option<$type> {
            fn get(&self) -> Option<Value> {
                self.clone().map(|value| Value::$variant(value $(as $as)?))
            }
            fn put(&mut self, value: Option<Value>) {
                *self = match value {
                    Some(Value::$variant(value)) => value.try_into().ok(),
                    _ => None,
                };
            }
        }
    )*};
}

values! { f64: Number,; usize: Whole, i64; u32: Whole, i64; bool: Flag,; String: Text,; Vec<f64>: Numbers,; }

macro_rules! words {
    ($($type:ty),* $(,)?) => {$(
        impl KeyField for Option<$type> {
            fn get(&self) -> Option<Value> {
                self.map(|word| Value::Word(word.into()))
            }
            fn put(&mut self, value: Option<Value>) {
                *self = match value {
                    Some(Value::Word(word)) => word.parse().ok(),
                    _ => None,
                };
            }
        }
    )*};
}
pub(super) use words;

impl KeyField for Vec<f64> {
    fn get(&self) -> Option<Value> {
        (!self.is_empty()).then(|| Value::Numbers(self.clone()))
    }

    fn put(&mut self, value: Option<Value>) {
        *self = match value {
            Some(Value::Numbers(list)) => list,
            _ => Vec::new(),
        };
    }
}

/// Keys of one table.
pub trait Section {
    /// The field of a key.
    fn field(&self, key: &str) -> Option<&dyn KeyField>;
    /// The same, to be changed.
    fn field_mut(&mut self, key: &str) -> Option<&mut dyn KeyField>;
}

/// Declares the struct of a table: its keys by their names, then tables in it, then structs with further keys of it.
macro_rules! section {
    ($(#[$meta:meta])* $name:ident { $($(#[$doc:meta])* $key:ident: $type:ty,)* }
     $(tables { $($(#[$more:meta])* $table:ident: $held:ty,)* })?
     $(parts { $($(#[$of:meta])* $part:ident: $keys:ty,)* })?) => {
        $(#[$meta])*
        #[derive(Debug, Clone, PartialEq, Default)]
        pub struct $name {
            $($(#[$doc])* pub $key: $type,)*
            $($($(#[$more])* pub $table: $held,)*)?
            $($($(#[$of])* pub $part: $keys,)*)?
        }

        fields! { $name { $($key),* } $(parts { $($part),* })? }
    };
}

/// Finds the fields of a struct by the names of their keys.
macro_rules! fields {
    ($name:ty { $($key:ident),* } $(parts { $($part:ident),* })?) => {
        impl Section for $name {
            fn field(&self, key: &str) -> Option<&dyn KeyField> {
                match key {
                    $(stringify!($key) => Some(&self.$key),)*
                    _ => None$($(.or_else(|| self.$part.field(key)))*)?,
                }
            }

            fn field_mut(&mut self, key: &str) -> Option<&mut dyn KeyField> {
                match key {
                    $(stringify!($key) => Some(&mut self.$key),)*
                    _ => None$($(.or_else(|| self.$part.field_mut(key)))*)?,
                }
            }
        }
    };
}
pub(super) use {fields, section};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rude_text_reads_back_and_harms_no_terminal() {
        let text = "a\u{9b}2J\u{202e}\u{1b}\n\"\\\u{2066}\u{7f}b";
        let shown = literal(&Raw::String(text.into()));
        assert!(!shown.chars().any(is_unprintable), "{shown:?}");
        let read = shown.parse::<Raw>().expect("a TOML value");
        assert_eq!(read.as_str(), Some(text));
    }

    #[test]
    fn numbers_read_back_as_the_same_floats() {
        for (given, shown) in [
            (0.0, "0.0"),
            (-0.0, "-0.0"),
            (1.0, "1.0"),
            (1e-7, "1e-7"),
            (2.3077e11, "2.3077e11"),
            (0.1 + 0.2, "0.30000000000000004"),
            (5e-324, "5e-324"),
            (f64::MAX, "1.7976931348623157e308"),
            (123_456.789, "123456.789"),
        ] {
            assert_eq!(float(given), shown);
            let read = shown.parse::<Raw>().expect("a TOML value");
            assert_eq!(
                read.as_float().map(f64::to_bits),
                Some(given.to_bits()),
                "{shown}"
            );
        }
    }
}

//! What a key accepts: the kind of its value, its range, its default.

use std::fmt;

use serde::{Deserialize, Deserializer};
use toml::Value;

/// The type of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case", bound(deserialize = "'de: 'static"))]
pub enum Kind {
    /// A finite number.
    #[default]
    Number,
    /// A whole number.
    Whole,
    /// `true` or `false`.
    Flag,
    /// Any text.
    Text,
    /// One of these words.
    Choice(#[serde(deserialize_with = "leaked")] &'static [Word]),
    /// A list of finite numbers.
    Numbers,
}

/// A word that a value can be.
#[derive(Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Word {
    /// The word.
    pub word: &'static str,
    /// Its meaning, in one line.
    #[serde(default)]
    pub(super) meaning: &'static str,
    /// What people write instead.
    #[serde(default)]
    pub(super) also: Vec<&'static str>,
}

/// Leaks a list, so that it lives as long as the table of keys.
fn leaked<'de: 'static, D: Deserializer<'de>>(list: D) -> Result<&'static [Word], D::Error> {
    Ok(Vec::deserialize(list)?.leak())
}

impl Kind {
    /// Returns the rule as words after "must be".
    pub fn wanted(self) -> String {
        match self {
            Self::Number => "a finite number".into(),
            Self::Whole => "a whole number".into(),
            Self::Flag => "true or false".into(),
            Self::Text => "a text".into(),
            Self::Choice(words) => {
                let words = words.iter().map(|known| format!("\"{}\"", known.word));
                format!("one of {}", words.collect::<Vec<_>>().join(", "))
            }
            Self::Numbers => "a list of finite numbers".into(),
        }
    }

    /// Returns the words to choose from, if the value is one of a list.
    pub fn words(self) -> Option<Vec<&'static str>> {
        match self {
            Self::Choice(words) => Some(words.iter().map(|known| known.word).collect()),
            Self::Flag => Some(vec!["true", "false"]),
            _ => None,
        }
    }
}

/// The allowed numbers; in a list, each entry.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Range {
    /// Every finite number, and any value that is not a number.
    #[default]
    Any,
    /// Greater than 0.
    Positive,
    /// 0 or greater.
    NotNegative,
    /// From the first to the second, both included.
    Within(f64, f64),
    /// Greater than 0, at most this.
    UpTo(f64),
    /// The angle of a flank: greater than 0 and less than π/2.
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

/// The rule as it follows "must be"; empty if every number is allowed.
impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Any => Ok(()),
            Self::Positive => f.write_str("greater than 0"),
            Self::NotNegative => f.write_str("0 or greater"),
            Self::Within(least, most) => {
                let short = |end: f64| {
                    if end == 0.0 || (1e-3..1e9).contains(&end) {
                        end.to_string()
                    } else {
                        format!("{end:e}")
                    }
                };
                write!(f, "from {} to {}", short(*least), short(*most))
            }
            Self::UpTo(most) => write!(f, "greater than 0, at most {most}"),
            Self::Acute => f.write_str("greater than 0 and less than pi/2"),
        }
    }
}

/// The default of a key.
#[derive(Debug, PartialEq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Default {
    /// None: the key must be given wherever it is needed.
    #[default]
    None,
    /// This TOML value, written into saved scenarios, since it may change between versions.
    Written(Value),
    /// This TOML value.
    Implied(Value),
    /// Depends on the rest of the scenario, as described.
    Derived(&'static str),
}

impl Default {
    /// Returns the value that can be written down, if there is one.
    pub fn value(&self) -> Option<&Value> {
        match self {
            Self::Written(value) | Self::Implied(value) => Some(value),
            Self::None | Self::Derived(_) => None,
        }
    }
}

//! An axis as a study writes it, and its values in SI units.

use serde::Deserialize;
use toml::{Table, Value};

use super::axis::{self, StudyAxis};
use super::design::{self, MOST_POINTS};
use super::refuse::{Result, ensure, error, refuse};
use super::study::Study;
use crate::math::scale::Scale;
use crate::scenario::blocks::flatten;
use crate::scenario::key::Key;
use crate::scenario::{units, value};

/// An axis as written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WrittenAxis {
    key: String,
    values: Option<Vec<Value>>,
    linspace: Option<Vec<Value>>,
    logspace: Option<Vec<Value>>,
    scale: Option<Scale>,
    #[serde(default)]
    tied: Table,
}

/// The number of samples of a design that draws them, and its seed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Samples {
    pub count: usize,
    pub seed: u32,
}

impl WrittenAxis {
    /// Reads it as axis number `at` of a study.
    pub fn read(self, at: usize, study: &Study, samples: Option<Samples>) -> Result<StudyAxis> {
        let place = format!("axis[{at}]");
        let key = Key::named(&self.key, &place)?;
        let (name, list, spread) = match (self.values, self.linspace, self.logspace) {
            (Some(list), None, None) => ("values", list, self.scale.unwrap_or(Scale::Linear)),
            (None, Some(list), None) => ("linspace", list, Scale::Linear),
            (None, None, Some(list)) => ("logspace", list, Scale::Log),
            _ => {
                let rule = "must have one of values, linspace and logspace";
                return error(format!("{place} ({key}): {rule}"));
            }
        };
        let why = format!("{place}.scale: goes with values, not with {name}");
        ensure(self.scale.is_none() || name == "values", why)?;
        let named = format!("{place}.{name}");
        let quantities = list
            .into_iter()
            .map(|value| quantity(key, value, study, &named));
        let list: Vec<Value> = quantities.collect::<Result<_>>()?;
        let values = match name {
            "values" if list.is_empty() => {
                return refuse(&named, "[]", "must be a list of one value or more");
            }
            "values" => list.into_iter().map(|value| normal(key, value)).collect(),
            _ => {
                let (ends, count) = ends_and_count(&named, &list, spread, samples)?;
                match samples {
                    None => axis::spaced(key, ends, count, spread),
                    Some(Samples { seed, .. }) => {
                        let shares = (0..count).map(|index| design::sample(index, at, seed));
                        axis::at_shares(key, ends, spread, shares)
                    }
                }
            }
        };
        Ok(StudyAxis {
            tied: read_tied_keys(&self.tied, &format!("{place}.tied"), &values)?,
            key,
            values,
            spread,
        })
    }
}

/// Converts a text that is a number with a unit to SI, and refuses lists and tables.
pub(super) fn quantity(key: Key, value: Value, study: &Study, place: &str) -> Result<Value> {
    if matches!(value, Value::Array(_) | Value::Table(_)) {
        return refuse(place, value, "must be a number, a text or a flag");
    }
    let text = value.as_str().unwrap_or_default();
    match units::quantity(text, &key, study.is_force(key)) {
        Some(Ok(number)) => Ok(Value::Float(number)),
        Some(Err(rule)) => refuse(place, value, rule),
        None => Ok(value),
    }
}

/// Writes whole numbers alike: 100 and 100.0 are one value.
pub(super) fn normal(key: Key, value: Value) -> Value {
    match value {
        Value::Integer(whole) => axis::value_of(key, whole as f64),
        value => value,
    }
}

/// Reads the ends of an axis and the number of its values: [from, to, number], or [from, to] for samples.
fn ends_and_count(
    place: &str,
    list: &[Value],
    spread: Scale,
    samples: Option<Samples>,
) -> Result<([f64; 2], usize)> {
    let refuse = |rule: &str| refuse(place, Value::from(list.to_vec()), rule);
    let (from, to, number) = match (list, samples) {
        ([from, to], Some(samples)) => (from, to, Some(samples.count)),
        (_, Some(_)) => return refuse("must be [from, to]; samples gives the number"),
        ([from, to, number], None) => {
            let number = number.as_integer();
            (from, to, number.and_then(|number| number.try_into().ok()))
        }
        (_, None) => return refuse("must be [from, to, number]"),
    };
    let (Some(from), Some(to)) = (value::number(from), value::number(to)) else {
        return refuse("must begin with two finite numbers");
    };
    if spread == Scale::Log && from.min(to) <= 0.0 {
        return refuse("must begin with two numbers greater than 0");
    }
    match number.filter(|number| (1..=MOST_POINTS).contains(number)) {
        Some(number) => Ok(([from, to], number)),
        None => {
            let rule = format!("the third must be a whole number from 1 to {MOST_POINTS}");
            refuse(&rule)
        }
    }
}

fn read_tied_keys(table: &Table, place: &str, axis: &[Value]) -> Result<Vec<(Key, f64)>> {
    let are_numbers = axis.iter().all(|value| value::number(value).is_some());
    let why = format!("{place}: needs an axis of numbers");
    ensure(table.is_empty() || are_numbers, why)?;
    let factors = flat(place, table)?.into_iter();
    let factors = factors.map(|(key, value)| match value::number(&value) {
        Some(factor) => Ok((key, factor)),
        None => refuse(&format!("{place}.{key}"), value, "must be a finite factor"),
    });
    factors.collect()
}

/// Returns the scenario keys of a table at `place` and their values, from dotted keys and nested tables alike.
pub(super) fn flat(place: &str, table: &Table) -> Result<Vec<(Key, Value)>> {
    let mut found = Vec::new();
    for (key, value) in table {
        flatten(key, value, &mut found);
    }
    let found = found.into_iter();
    let found = found.map(|(key, value)| Ok((Key::named(&key, place)?, value)));
    found.collect()
}

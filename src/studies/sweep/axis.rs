//! An axis: a key of the scenario with its values, and the keys tied to it.

use toml::Value;

use crate::math::number::exact;
use crate::math::scale::Scale;
use crate::scenario::key::{Key, Kind};
use crate::scenario::value;

/// A key that a study varies.
#[derive(Debug, Clone, PartialEq)]
pub struct StudyAxis {
    /// The key.
    pub key: Key,
    /// Its values: numbers, words or flags, in order.
    pub values: Vec<Value>,
    /// Their scale.
    pub spread: Scale,
    /// Keys that move with it, each with its value relative to the axis's.
    pub tied: Vec<(Key, f64)>,
}

impl StudyAxis {
    /// Makes an axis of `count` values at equal distances on its scale.
    pub fn between(key: Key, ends: [f64; 2], count: usize, spread: Scale) -> Self {
        Self {
            key,
            values: spaced(key, ends, count, spread),
            spread,
            tied: Vec::new(),
        }
    }

    /// Returns the number of values.
    pub fn count(&self) -> usize {
        self.values.len()
    }

    /// Returns the value at `index` as for `--set` and in its column: numbers in the shortest form that reads back to
    /// the same bits, words bare.
    pub fn text(&self, index: usize) -> String {
        text(&self.values[index])
    }

    /// Returns the value at `index` as a number, if it is one.
    pub fn number(&self, index: usize) -> Option<f64> {
        value::number(&self.values[index])
    }

    /// Returns the place of a value on the axis, between the indices of its neighbours, on the axis's scale. `None`
    /// outside, and without numbers.
    pub fn place_of(&self, value: f64) -> Option<f64> {
        let of = |value: f64| self.spread.spread(value);
        (1..self.count()).find_map(|index| {
            let (low, high) = (self.number(index - 1)?, self.number(index)?);
            let inside = (low.min(high)..=low.max(high)).contains(&value) && low != high;
            let share = (of(value) - of(low)) / (of(high) - of(low));
            (inside && share.is_finite()).then(|| (index - 1) as f64 + share)
        })
    }

    /// Returns the value at a place between indices, on the axis's scale: the inverse of [`place_of`](Self::place_of).
    pub fn value_at(&self, place: f64) -> Option<f64> {
        let index = (place.floor() as usize).min(self.count().saturating_sub(2));
        let next = (index + 1).min(self.count() - 1);
        let (low, high) = (self.number(index)?, self.number(next)?);
        Some(between(self.spread, low, high, place - index as f64))
    }

    /// Returns the assignments for `value`: the key's own value, then the tied keys' values.
    pub fn assignments(&self, value: &Value) -> Vec<(&'static str, String)> {
        let own = (self.key.path, text(value));
        let number = value::number(value);
        let tied = self
            .tied
            .iter()
            .filter_map(|(key, factor)| Some((key.path, text(&value_of(*key, number? * factor)))));
        std::iter::once(own).chain(tied).collect()
    }
}

/// Formats a value as for `--set`.
pub(super) fn text(value: &Value) -> String {
    match value {
        Value::Float(value) => exact(*value),
        Value::String(word) => word.clone(),
        other => other.to_string(),
    }
}

/// Converts a number to a value of `key`: an integer if the key takes whole numbers.
pub(super) fn value_of(key: Key, value: f64) -> Value {
    match key.kind {
        Kind::Whole => Value::Integer(value.round() as i64),
        _ => Value::Float(value),
    }
}

/// Returns `count` values of `key` at equal distances on a scale.
pub(super) fn spaced(key: Key, ends: [f64; 2], count: usize, spread: Scale) -> Vec<Value> {
    let last = (count - 1).max(1) as f64;
    at_shares(
        key,
        ends,
        spread,
        (0..count).map(|index| index as f64 / last),
    )
}

/// Returns values of `key` at `shares` (0 to 1) of the way between two ends on a scale.
pub(super) fn at_shares(
    key: Key,
    [from, to]: [f64; 2],
    spread: Scale,
    shares: impl Iterator<Item = f64>,
) -> Vec<Value> {
    let values = shares.map(|share| value_of(key, between(spread, from, to, share)));
    values.collect()
}

/// Returns the value a `share` (0 to 1) of the way from `from` to `to`; both ends are exact.
pub(super) fn between(spread: Scale, from: f64, to: f64, share: f64) -> f64 {
    if share <= 0.0 {
        return from;
    }
    if share >= 1.0 {
        return to;
    }
    match spread {
        Scale::Linear => from + (to - from) * share,
        // The system's pow differs in the last digit between machines, and shards of one study must not.
        Scale::Log => from * libm::pow(to / from, share),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(path: &str) -> Key {
        Key::find(path).expect("a key")
    }

    #[test]
    fn both_ends_are_met_to_the_bit() {
        for spread in [Scale::Linear, Scale::Log] {
            assert_eq!(between(spread, 0.1, 0.7, 0.0), 0.1);
            assert_eq!(between(spread, 0.1, 0.7, 1.0), 0.7);
        }
        let middle = between(Scale::Log, 1e-8, 1e-6, 0.5);
        assert!((middle / 1e-7 - 1.0).abs() < 1e-14, "{middle:e}");
    }

    #[test]
    fn values_between_points_lie_between_places() {
        let values = [1e-8, 1e-7, 1e-6].map(Value::Float).to_vec();
        let axis = |spread| StudyAxis {
            key: key("wear.coefficient"),
            values: values.clone(),
            spread,
            tied: Vec::new(),
        };
        let log = axis(Scale::Log);
        assert_eq!(log.place_of(1e-7), Some(1.0));
        let place = log.place_of(10f64.powf(-6.5)).expect("a place");
        assert!((place - 1.5).abs() < 1e-12);
        let place = axis(Scale::Linear).place_of(5.5e-8).expect("a place");
        assert!((place - 0.5).abs() < 1e-12);
        let value = log.value_at(1.5).expect("a value");
        assert!((value / 10f64.powf(-6.5) - 1.0).abs() < 1e-12);
        assert_eq!(log.value_at(2.0), Some(1e-6));
        assert_eq!(log.place_of(2e-6), None);
    }

    #[test]
    fn tied_keys_follow_by_their_factor_and_whole_keys_are_rounded() {
        let axis = StudyAxis {
            key: key("motion.normal.mean"),
            values: vec![Value::Float(2e-6)],
            spread: Scale::Linear,
            tied: vec![
                (key("motion.normal.amplitude"), 0.25),
                (key("numerics.points"), 50.2e6),
            ],
        };
        let set = axis.assignments(&axis.values[0]);
        assert_eq!(set[0], ("motion.normal.mean", "2e-6".to_owned()));
        assert_eq!(set[1], ("motion.normal.amplitude", "5e-7".to_owned()));
        assert_eq!(set[2], ("numerics.points", "100".to_owned()));
        assert_eq!(value_of(key("numerics.points"), 9.7), Value::Integer(10));
    }
}

//! A value that a constructor refuses: names the value and the rule it broke.

use std::ops::RangeInclusive;

use thiserror::Error;

/// A refused value. Higher layers add its location (a TOML path, an option of the command line).
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{field} = {value}: {rule}")]
pub struct Invalid {
    /// Name of the value, as in scenarios.
    pub field: &'static str,
    /// The value as given.
    pub value: String,
    /// The rule it must satisfy.
    pub rule: String,
}

impl Invalid {
    /// Refuses `value` of `field` because of `rule`.
    pub fn new(field: &'static str, value: impl ToString, rule: impl Into<String>) -> Self {
        Self {
            field,
            value: value.to_string(),
            rule: rule.into(),
        }
    }
}

/// Why something cannot be made of the keys of a scenario.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Unmade {
    /// This key is not given.
    #[error("{0} is missing")]
    Missing(&'static str),
    /// A value is not allowed.
    #[error(transparent)]
    Invalid(#[from] Invalid),
}

/// Passes the value of a key.
///
/// # Errors
/// If it is not given.
pub fn need<T>(key: &'static str, value: Option<T>) -> Result<T, Unmade> {
    value.ok_or(Unmade::Missing(key))
}

/// Passes a finite number, refuses NaN and infinities.
pub fn finite(field: &'static str, value: f64) -> Result<f64, Invalid> {
    checked(field, value, true, "must be a finite number")
}

/// Passes a finite number greater than zero.
pub fn positive(field: &'static str, value: f64) -> Result<f64, Invalid> {
    checked(field, value, value > 0.0, "must be greater than 0")
}

/// Passes a finite number that is zero or greater.
pub fn non_negative(field: &'static str, value: f64) -> Result<f64, Invalid> {
    checked(field, value, value >= 0.0, "must be 0 or greater")
}

fn checked(field: &'static str, value: f64, holds: bool, rule: &str) -> Result<f64, Invalid> {
    if value.is_finite() && holds {
        Ok(value)
    } else {
        Err(Invalid::new(field, value, rule))
    }
}

/// Passes two named columns that form a function: an allowed `number` of rows, all finite, the first column increasing.
///
/// # Errors
/// Names the offending column and its value.
pub fn check_table(
    (x, xs): (&'static str, &[f64]),
    (y, ys): (&'static str, &[f64]),
    number: RangeInclusive<usize>,
) -> Result<(), Invalid> {
    let rows = xs.len();
    if !number.contains(&rows) {
        let rule = format!("must be from {} to {} points", number.start(), number.end());
        return Err(Invalid::new(x, rows, rule));
    }
    if ys.len() != rows {
        let rule = format!("must be {rows} numbers, as many as {x}");
        return Err(Invalid::new(y, ys.len(), rule));
    }
    for row in 0..rows {
        finite(x, xs[row])?;
        finite(y, ys[row])?;
    }
    match xs.windows(2).find(|pair| pair[0] >= pair[1]) {
        Some(pair) => {
            let rule = format!("must increase, and follows {:e}", pair[0]);
            Err(Invalid::new(x, pair[1], rule))
        }
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_refusal_names_field_value_and_rule() {
        let refusal = positive("radius", -1.0).expect_err("a negative radius");
        assert_eq!(refusal.to_string(), "radius = -1: must be greater than 0");
    }

    #[test]
    fn nothing_that_is_not_finite_passes() {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(finite("x", value).is_err());
            assert!(positive("x", value).is_err());
            assert!(non_negative("x", value).is_err());
        }
        assert_eq!(non_negative("x", 0.0), Ok(0.0));
        assert!(positive("x", 0.0).is_err());
    }
}

//! Refusals of a study's text.

use std::fmt::Display;

use crate::scenario::Refusal;

pub(super) type Result<T> = std::result::Result<T, Refusal>;

/// Refuses with one line.
pub(super) fn error<T>(why: impl Display) -> Result<T> {
    Err(Refusal::from(why.to_string()))
}

/// Refuses what does not hold.
pub(super) fn ensure(holds: bool, why: impl Display) -> Result<()> {
    if holds { Ok(()) } else { error(why) }
}

/// Refuses the value at a place by a rule.
pub(super) fn refuse<T>(place: &str, value: impl Display, rule: impl Display) -> Result<T> {
    Err(Refusal::of_value(place, value, rule))
}

//! Running in: friction and wear coefficients as functions of accumulated cycles or dissipated
//! energy, and an energy threshold below which nothing wears.
//!
//! Each step uses the values at its start. Cycles are jumped only after the values have settled.

use std::sync::Arc;

use crate::contact::material::Material;
use crate::math::invalid::{Invalid, check_table, non_negative, positive};
use crate::wear::WearLaw;

/// Closer to its end than this share of its way, an exponential counts as settled.
const SETTLED: f64 = 1e-6;

/// The most rows of a table.
const MOST_ROWS: usize = 10_000_000;

/// What a value runs in over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Over {
    /// Cycles since the start.
    Cycles,
    /// Work of friction since the start, J.
    Energy,
}

/// How a value changes.
#[derive(Debug, Clone, PartialEq)]
pub enum Course {
    /// last + (first − last) exp(−x/constant).
    Exponential {
        /// The value at first.
        first: f64,
        /// The value that it approaches.
        last: f64,
        /// Cycles or J after which it is nearer by a factor of e.
        constant: f64,
        /// What x is.
        over: Over,
    },
    /// Straight lines between the rows of a table; beyond its ends the values there.
    Table {
        /// x and the value, by x.
        rows: Arc<[(f64, f64)]>,
        /// What x is.
        over: Over,
    },
}

/// Everything that changes with use.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RunningIn {
    /// μ; none: it stays as it is.
    pub friction: Option<Course>,
    /// k; none: it stays as it is, or follows friction.
    pub wear: Option<Course>,
    /// kμ, 1/Pa: k follows friction, which is then always greater than 0. None: it does not.
    pub wear_per_load: Option<f64>,
    /// The friction work below which nothing wears, J.
    pub threshold: f64,
}

impl Course {
    /// From `first` to `last`, both 0 or greater, nearer by a factor of e after each `constant`.
    ///
    /// # Errors
    /// The field `settled`, or `constant`, is out of range.
    pub fn exponential(first: f64, last: f64, constant: f64, over: Over) -> Result<Self, Invalid> {
        Ok(Self::Exponential {
            first,
            last: non_negative("settled", last)?,
            constant: positive("constant", constant)?,
            over,
        })
    }

    /// Through `values` (0 or greater) at increasing `at`.
    ///
    /// # Errors
    /// The field is `at_cycle`, `at_energy` or `values`.
    pub fn table(at: &[f64], values: &[f64], over: Over) -> Result<Self, Invalid> {
        check_table((over.column(), at), ("values", values), 1..=MOST_ROWS)?;
        for &value in values {
            non_negative("values", value)?;
        }
        let rows = at.iter().copied().zip(values.iter().copied());
        Ok(Self::Table {
            rows: rows.collect(),
            over,
        })
    }

    /// The least of its values.
    pub fn least(&self) -> f64 {
        match self {
            Self::Exponential { first, last, .. } => first.min(*last),
            Self::Table { rows, .. } => rows.iter().map(|row| row.1).fold(f64::INFINITY, f64::min),
        }
    }

    /// The value after `cycles` cycles and `energy` J.
    pub fn after(&self, cycles: f64, energy: f64) -> f64 {
        match self {
            Self::Exponential {
                first,
                last,
                constant,
                over,
            } => last + (first - last) * (-over.of(cycles, energy) / constant).exp(),
            Self::Table { rows, over } => {
                let x = over.of(cycles, energy);
                let k = rows.partition_point(|row| row.0 <= x);
                match (k.checked_sub(1).map(|k| rows[k]), rows.get(k)) {
                    (Some(before), Some(next)) => {
                        let share = (x - before.0) / (next.0 - before.0);
                        before.1 + share * (next.1 - before.1)
                    }
                    (Some(end), None) | (None, Some(&end)) => end.1,
                    (None, None) => 0.0,
                }
            }
        }
    }

    /// Whether it does not change any more.
    fn is_settled(&self, cycles: f64, energy: f64) -> bool {
        match self {
            Self::Exponential { constant, over, .. } => {
                (-over.of(cycles, energy) / constant).exp() < SETTLED
            }
            Self::Table { rows, over } => rows
                .last()
                .is_none_or(|last| over.of(cycles, energy) >= last.0),
        }
    }
}

impl Over {
    /// The name of the column of a table over it.
    fn column(self) -> &'static str {
        match self {
            Self::Cycles => "at_cycle",
            Self::Energy => "at_energy",
        }
    }

    fn of(self, cycles: f64, energy: f64) -> f64 {
        match self {
            Self::Cycles => cycles,
            Self::Energy => energy,
        }
    }
}

impl RunningIn {
    /// Sets friction and wear to their values after the given cycles and energy (J).
    pub(super) fn apply(
        &self,
        cycles: f64,
        energy: f64,
        material: &mut Material,
        wear: &mut Option<WearLaw>,
    ) {
        if let Some(course) = &self.friction {
            *material = material.with_friction(course.after(cycles, energy));
        }
        let Some(law) = wear else { return };
        let coefficient = match (&self.wear, self.wear_per_load) {
            _ if energy < self.threshold => 0.0,
            (Some(course), _) => course.after(cycles, energy),
            (None, Some(per_load)) => per_load / material.friction(),
            (None, None) => return,
        };
        *law = law.with_coefficient(coefficient);
    }

    /// Whether nothing changes any more, so that cycles are alike.
    pub(super) fn is_settled(&self, cycles: f64, energy: f64) -> bool {
        let courses = [&self.friction, &self.wear];
        let mut courses = courses.into_iter().flatten();
        energy >= self.threshold && courses.all(|course| course.is_settled(cycles, energy))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn courses_go_from_their_first_value_to_their_last() {
        let course = Course::exponential(0.9, 0.7, 100.0, Over::Cycles).expect("a course");
        assert_eq!(course.after(0.0, 5.0), 0.9);
        assert!((course.after(100.0, 5.0) - (0.7 + 0.2 / std::f64::consts::E)).abs() < 1e-15);
        assert!(!course.is_settled(100.0, 0.0) && course.is_settled(2000.0, 0.0));
        let rows = ([0.0, 2.0, 6.0], [0.2, 0.6, 0.4]);
        let table = Course::table(&rows.0, &rows.1, Over::Energy).expect("a course");
        for (energy, value) in [(0.0, 0.2), (1.0, 0.4), (4.0, 0.5), (9.0, 0.4)] {
            assert!((table.after(1e9, energy) - value).abs() < 1e-15, "{energy}");
        }
        assert!(!table.is_settled(1e9, 5.0) && table.is_settled(0.0, 6.0));
        assert_eq!((course.least(), table.least()), (0.7, 0.2));
    }

    #[test]
    fn wear_per_load_follows_friction() {
        let rows = ([0.0, 2.0, 6.0], [0.2, 0.6, 0.4]);
        let friction = Course::table(&rows.0, &rows.1, Over::Energy).expect("a course");
        let running_in = RunningIn {
            friction: Some(friction),
            wear_per_load: Some(0.3),
            ..RunningIn::default()
        };
        let mut material = Material::new(1.0, 0.3, 0.2).expect("a material");
        let mut law = WearLaw::archard(1.5).ok();
        running_in.apply(0.0, 1.0, &mut material, &mut law);
        let k = law.expect("a law").coefficient();
        assert!((material.friction() - 0.4).abs() < 1e-15 && (k - 0.75).abs() < 1e-15);
        assert!(!running_in.is_settled(1e9, 5.0) && running_in.is_settled(0.0, 6.0));
    }

    #[test]
    fn impossible_courses_are_refused() {
        assert!(Course::exponential(0.9, -0.1, 1.0, Over::Cycles).is_err());
        assert!(Course::exponential(0.9, 0.7, 0.0, Over::Cycles).is_err());
        assert!(Course::table(&[0.0, 0.0], &[0.1, 0.2], Over::Cycles).is_err());
        assert!(Course::table(&[0.0], &[-0.1], Over::Cycles).is_err());
        assert!(Course::table(&[], &[], Over::Cycles).is_err());
    }
}

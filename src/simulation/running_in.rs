//! Running in: friction and wear coefficients as functions of accumulated cycles or dissipated energy, and an energy
//! threshold for wear.
//!
//! A step is of second order in them: springs slip by the friction at its end, and the step wears by the mean friction
//! and the mean k. The work of a step is known before its wear, so the mean of k over energy is exact, even if a
//! threshold is passed within the step: V = k(E_d − E_th) holds over the whole run. Jumps over cycles integrate the work
//! along with the wear, and end before the next row of a table and before the threshold.

use std::sync::Arc;

use crate::contact::material::Material;
use crate::math::invalid::{Invalid, check_table, non_negative, positive};
use crate::wear::WearLaw;

/// An exponential counts as settled within this fraction of its range from its end.
const SETTLED: f64 = 1e-6;

/// Maximum number of rows of a table.
const MOST_ROWS: usize = 10_000_000;

/// The variable over which a value runs in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Over {
    /// Cycles since the start.
    Cycles,
    /// Work of friction since the start, J.
    Energy,
}

/// The history of the contact at the two ends of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stretch {
    /// Cycles since the start.
    pub cycles: [f64; 2],
    /// Work of friction since the start, J.
    pub energy: [f64; 2],
}

impl Stretch {
    /// Makes a moment, after `cycles` and `energy` (J).
    pub fn moment(cycles: f64, energy: f64) -> Self {
        Self {
            cycles: [cycles; 2],
            energy: [energy; 2],
        }
    }

    /// Returns its end.
    pub fn end(&self) -> Self {
        Self::moment(self.cycles[1], self.energy[1])
    }

    fn is_moment(&self) -> bool {
        [self.cycles, self.energy]
            .iter()
            .all(|[from, until]| from == until)
    }
}

/// How a value changes.
#[derive(Debug, Clone, PartialEq)]
pub enum Course {
    /// last + (first − last) exp(−x/constant).
    Exponential {
        /// Initial value.
        first: f64,
        /// Value that it approaches.
        last: f64,
        /// Cycles or J after which the distance falls by a factor of e.
        constant: f64,
        /// The variable x.
        over: Over,
    },
    /// Straight lines between the rows of a table, constant beyond its ends.
    Table {
        /// x and the value, sorted by x.
        rows: Arc<[(f64, f64)]>,
        /// The variable x.
        over: Over,
    },
}

/// Everything that changes with use.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RunningIn {
    /// μ; `None` if constant.
    pub friction: Option<Course>,
    /// k; `None` if constant, or if it follows friction.
    pub wear: Option<Course>,
    /// kμ, 1/Pa, if k follows friction, which is then always greater than 0.
    pub wear_per_load: Option<f64>,
    /// Friction work below which nothing wears, J.
    pub threshold: f64,
}

impl Course {
    /// Makes an exponential from `first` to `last`, both 0 or greater, whose distance falls by a factor of e per
    /// `constant`.
    ///
    /// # Errors
    /// If the field `settled`, or `constant`, is out of range.
    pub fn exponential(first: f64, last: f64, constant: f64, over: Over) -> Result<Self, Invalid> {
        Ok(Self::Exponential {
            first,
            last: non_negative("settled", last)?,
            constant: positive("constant", constant)?,
            over,
        })
    }

    /// Makes a table of `values` (0 or greater) at increasing `at`.
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

    /// Returns the smallest value.
    pub fn least(&self) -> f64 {
        match self {
            Self::Exponential { first, last, .. } => first.min(*last),
            Self::Table { rows, .. } => rows.iter().map(|row| row.1).fold(f64::INFINITY, f64::min),
        }
    }

    /// Returns the value after `cycles` cycles and `energy` J.
    pub fn after(&self, cycles: f64, energy: f64) -> f64 {
        match self {
            Self::Exponential {
                first,
                last,
                constant,
                over,
            } => last + (first - last) * (-over.pick(cycles, energy) / constant).exp(),
            Self::Table { rows, over } => {
                let x = over.pick(cycles, energy);
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

    /// Returns the mean value over a stretch, by Simpson's rule.
    fn mean(&self, stretch: Stretch) -> f64 {
        if stretch.is_moment() {
            return self.after(stretch.cycles[0], stretch.energy[0]);
        }
        let at = |share: f64| {
            let [cycles, energy] =
                [stretch.cycles, stretch.energy].map(|[from, until]| from + share * (until - from));
            self.after(cycles, energy)
        };
        (at(0.0) + 4.0 * at(0.5) + at(1.0)) / 6.0
    }

    fn over(&self) -> Over {
        match self {
            Self::Exponential { over, .. } | Self::Table { over, .. } => *over,
        }
    }

    /// Returns the first corner of a table over cycles after `from` and up to `until`, ignoring rows closer together
    /// than `apart` cycles.
    fn corner(&self, from: f64, until: f64, apart: f64) -> Option<f64> {
        let Self::Table {
            rows,
            over: Over::Cycles,
        } = self
        else {
            return None;
        };
        let first = rows.partition_point(|row| row.0 <= from);
        let near = rows[first..]
            .iter()
            .map(|row| row.0)
            .take_while(|&cycle| cycle <= until);
        let is_apart = |k: usize| k == 0 || k >= rows.len() || rows[k].0 - rows[k - 1].0 > apart;
        let mut corners = near.enumerate().map(|(i, cycle)| (first + i, cycle));
        corners
            .find(|&(k, _)| is_apart(k) && is_apart(k + 1))
            .map(|(_, cycle)| cycle)
    }

    /// Returns the cycle and the work (J) of the next row of a table; infinite where none is.
    fn next_row(&self, cycles: f64, energy: f64) -> [f64; 2] {
        let Self::Table { rows, over } = self else {
            return [f64::INFINITY; 2];
        };
        let now = over.pick(cycles, energy);
        let next = rows.get(rows.partition_point(|row| row.0 <= now));
        let next = next.map_or(f64::INFINITY, |row| row.0);
        match over {
            Over::Cycles => [next, f64::INFINITY],
            Over::Energy => [f64::INFINITY, next],
        }
    }

    /// Whether it no longer changes.
    fn is_settled(&self, cycles: f64, energy: f64) -> bool {
        match self {
            Self::Exponential { constant, over, .. } => {
                (-over.pick(cycles, energy) / constant).exp() < SETTLED
            }
            Self::Table { rows, over } => rows
                .last()
                .is_none_or(|last| over.pick(cycles, energy) >= last.0),
        }
    }
}

impl Over {
    /// Returns the name of the column of this variable in a table.
    fn column(self) -> &'static str {
        match self {
            Self::Cycles => "at_cycle",
            Self::Energy => "at_energy",
        }
    }

    fn pick(self, cycles: f64, energy: f64) -> f64 {
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
        let now = Stretch::moment(cycles, energy);
        self.set_friction(now, material);
        let Some(law) = wear else { return };
        let coefficient = self.coefficient(now, material).unwrap_or(law.coefficient());
        let is_above = energy >= self.threshold;
        *law = law.with_coefficient(if is_above { coefficient } else { 0.0 });
    }

    /// Sets friction to its mean over a stretch.
    pub(super) fn set_friction(&self, stretch: Stretch, material: &mut Material) {
        if let Some(course) = &self.friction {
            *material = material.with_friction(course.mean(stretch));
        }
    }

    /// Whether the friction at the end of a step that begins after `energy` (J) depends on the work of that step.
    pub(super) fn friction_follows_work(&self, energy: f64) -> bool {
        let course = self.friction.as_ref();
        course
            .is_some_and(|course| course.over() == Over::Energy && !course.is_settled(0.0, energy))
    }

    /// Sets k of a law to its mean over the work of a stretch, counting 0 for work below the threshold; `material` has
    /// the mean friction.
    pub(super) fn set_wear(&self, stretch: Stretch, material: &Material, law: &mut WearLaw) {
        let [from, until] = stretch.energy;
        let work = until - from;
        let below = match (self.threshold - from).max(0.0) {
            left if left < work => left / work,
            left if left > 0.0 => return *law = law.with_coefficient(0.0),
            _ => 0.0,
        };
        let [start, end] = stretch.cycles;
        let above = Stretch {
            cycles: [start + below * (end - start), end],
            energy: [from + below * work, until],
        };
        let coefficient = self
            .coefficient(above, material)
            .unwrap_or(law.coefficient());
        *law = law.with_coefficient((1.0 - below) * coefficient);
    }

    /// Returns the mean of k over a stretch above the threshold, 1/Pa; `None` if it does not change.
    fn coefficient(&self, stretch: Stretch, material: &Material) -> Option<f64> {
        match (&self.wear, self.wear_per_load) {
            (Some(course), _) => Some(course.mean(stretch)),
            (None, Some(per_load)) => Some(per_load / material.friction()),
            (None, None) => None,
        }
    }

    /// Iterates over the values that change.
    fn courses(&self) -> impl Iterator<Item = &Course> {
        [&self.friction, &self.wear].into_iter().flatten()
    }

    /// Returns the first cycle after `from` and up to `until` at which friction or wear has a corner, if steps of
    /// length `apart` resolve it.
    pub(super) fn corner(&self, from: f64, until: f64, apart: f64) -> Option<f64> {
        let corners = (self.courses()).filter_map(|course| course.corner(from, until, apart));
        corners.reduce(f64::min)
    }

    /// Returns how many cycles and how much work (J) are left until a value has a corner.
    pub(super) fn smooth_for(&self, cycles: f64, energy: f64) -> [f64; 2] {
        let threshold = [f64::INFINITY, self.threshold];
        let corners = (self.courses()).map(|course| course.next_row(cycles, energy));
        let now = [cycles, energy];
        corners
            .chain([threshold])
            .fold([f64::INFINITY; 2], |least, corner| {
                std::array::from_fn(|k| {
                    let left = corner[k] - now[k];
                    if left > 0.0 {
                        least[k].min(left)
                    } else {
                        least[k]
                    }
                })
            })
    }

    /// Whether nothing changes any more, so that cycles are alike.
    pub(super) fn is_settled(&self, cycles: f64, energy: f64) -> bool {
        energy >= self.threshold
            && self
                .courses()
                .all(|course| course.is_settled(cycles, energy))
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

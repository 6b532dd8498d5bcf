//! Axes: quantity, unit, bounds and scale.

use std::borrow::Cow;

use super::step::Step;
use super::units::{AxisUnit, axis_unit};
pub use crate::math::scale::Scale;

/// Values smaller than this in the unit of the expected value get a unit that suits themselves.
const LEAST: f64 = 1e-3;

/// What an axis shows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Axis {
    /// The quantity's symbol or name, as in `p`.
    pub label: Cow<'static, str>,
    /// The unit of the data without prefix, as in `Pa`; empty for pure numbers.
    pub unit: &'static str,
    /// The values at the two ends, in `unit`; `None` takes them from the data.
    pub bounds: Option<[f64; 2]>,
    /// A value that bounds from the data always include.
    pub holds: Option<f64>,
    /// The value that the data are expected to reach, in their unit; 0 if unknown. It decides the unit before the data
    /// do.
    pub expects: f64,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// Whether bounds from the data are symmetric about zero, on a screen.
    pub is_symmetric: bool,
    /// Whether the ordinate grows downwards, on paper.
    pub downwards: bool,
}

impl Axis {
    /// A linear axis that takes its bounds from the data.
    pub fn new(label: impl Into<Cow<'static, str>>, unit: &'static str) -> Self {
        Axis {
            label: label.into(),
            unit,
            ..Axis::default()
        }
    }

    /// The same axis from `bounds[0]` to `bounds[1]` (in the data's unit).
    #[must_use]
    pub fn bounds(mut self, bounds: [f64; 2]) -> Self {
        self.bounds = Some(bounds);
        self
    }

    /// The same axis, always including zero, for volumes and radii that grow from there.
    #[must_use]
    pub fn from_zero(mut self) -> Self {
        self.holds = Some(0.0);
        self
    }

    /// The same axis, expected to reach `value`.
    #[must_use]
    pub fn expecting(mut self, value: f64) -> Self {
        self.expects = value;
        self
    }

    /// The same axis with bounds taken from the data.
    #[must_use]
    pub fn unbounded(self) -> Self {
        Self {
            bounds: None,
            ..self
        }
    }

    /// Returns the unit to label a range with: the expected value's, unless the numbers would be too small in it.
    pub fn unit_for(&self, [low, high]: [f64; 2]) -> AxisUnit {
        let most = low.abs().max(high.abs());
        let expected = axis_unit(self.expects.max(most), self.unit);
        if most >= LEAST * expected.factor {
            expected
        } else {
            axis_unit(most, self.unit)
        }
    }

    /// The same axis with the given scale.
    #[must_use]
    pub fn scale(self, scale: Scale) -> Self {
        Axis { scale, ..self }
    }

    /// Returns the label with the unit of the data, as in `r (m)`.
    pub fn in_data_units(&self) -> String {
        titled(&self.label, self.unit, ['(', ')'])
    }

    /// Returns the values halfway between neighbouring `places`, and as far beyond the first and the last one.
    pub fn edges(&self, places: &[f64]) -> Vec<f64> {
        let at = places.iter().map(|&place| self.scale.spread(place));
        let at: Vec<f64> = at.collect();
        let step = |a: usize, b: usize| match at[b] - at[a] {
            0.0 => at[a].abs().max(1e-300),
            step => step,
        };
        let last = at.len() - 1;
        let before = at[0] - step(0, last.min(1));
        let beyond = at[last] + step(last.saturating_sub(1), last);
        let all = [&[before], &at[..], &[beyond]].concat();
        let middles = all.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        middles.map(|edge| self.scale.unspread(edge)).collect()
    }

    /// Extends `bounds` by `share` of their distance on either side.
    pub fn with_margin(&self, [low, high]: [f64; 2], share: f64) -> [f64; 2] {
        let [low, high] = [low, high].map(|bound| self.scale.spread(bound));
        let more = share * (high - low);
        [low - more, high + more].map(|bound| self.scale.unspread(bound))
    }

    /// Returns the bounds to draw with: the given ones if they make sense, else the bounds of the `data`, rounded
    /// outwards to the tick grid if `round` is set. They are always finite, increasing, and positive on a log axis.
    pub fn resolve(&self, data: Option<[f64; 2]>, round: bool) -> [f64; 2] {
        // Zeros alone say nothing about the size.
        let ends = self.bounds.filter(|ends| *ends != [0.0, 0.0]);
        let ends = ends.filter(|ends| ends.iter().all(|end| self.scale.has(*end)));
        match (ends, data, self.scale) {
            (Some([a, b]), ..) => widened(a, b, 1e-9),
            (None, None | Some([0.0, 0.0]), Scale::Linear) if self.expects > 0.0 => {
                nice_bounds(0.0, self.expects)
            }
            (None, Some([lo, hi]), Scale::Linear) if round => nice_bounds(lo, hi),
            (None, Some([lo, hi]), Scale::Linear) => widened(lo, hi, 1e-9),
            (None, Some([lo, hi]), Scale::Log) => log_bounds(lo, hi, round),
            (None, None, Scale::Linear) => [0.0, 1.0],
            (None, None, Scale::Log) if self.expects > 0.0 => {
                log_bounds(LEAST * self.expects, self.expects, round)
            }
            (None, None, Scale::Log) => [0.1, 10.0],
        }
    }
}

/// Formats a quantity with its unit in brackets, `p [MPa]`; either may be empty.
pub fn titled(label: &str, unit: &str, [open, close]: [char; 2]) -> String {
    match (label, unit) {
        (label, "") => label.to_owned(),
        ("", unit) => format!("{open}{unit}{close}"),
        (label, unit) => format!("{label} {open}{unit}{close}"),
    }
}

/// Widens `lo..hi` by a tenth of its size to both sides if it is narrower than `least` times its size.
fn widened(lo: f64, hi: f64, least: f64) -> [f64; 2] {
    let [lo, hi] = [lo.min(hi), lo.max(hi)].map(|v| v.clamp(-1e300, 1e300));
    let size = lo.abs().max(hi.abs());
    if size < 1e-300 {
        [0.0, 1.0]
    } else if hi - lo < least * size {
        let middle = lo / 2.0 + hi / 2.0;
        [middle - 0.1 * size, middle + 0.1 * size]
    } else {
        [lo, hi]
    }
}

/// Rounds `min..max` outwards to the 1-2-5 grid with 4 to 10 steps across the data, so that the view does not jump in
/// every frame. If all data are equal, they lie in the middle; without finite data, returns 0 to 1.
pub fn nice_bounds(min: f64, max: f64) -> [f64; 2] {
    if !(min.is_finite() && max.is_finite()) {
        return [0.0, 1.0];
    }
    let [lo, hi] = widened(min, max, 1e-6);
    let step = Step::at_most((hi - lo) / 4.0);
    let first = (lo / step.value() + 1e-9).floor();
    let last = (hi / step.value() - 1e-9).ceil();
    [step.multiple(first), step.multiple(last)]
}

/// Returns bounds for a live run, in the data's unit. Keeps `previous` as long as the data (`data_min` to `data_max`)
/// stay inside and fill at least half of it, else returns new [`nice_bounds`] with some room in the direction in which
/// the data went.
pub fn sticky_bounds(previous: Option<[f64; 2]>, data_min: f64, data_max: f64) -> [f64; 2] {
    let Some([lo, hi]) = previous.filter(|[lo, hi]| hi - lo > 0.0 && (hi - lo).is_finite()) else {
        return nice_bounds(data_min, data_max);
    };
    if !(data_min.is_finite() && data_max.is_finite()) {
        return [lo, hi];
    }
    let [min, max] = widened(data_min, data_max, 1e-6);
    let inside = data_min.min(data_max) >= lo && data_max.max(data_min) <= hi;
    let flat = max - min > (data_max - data_min).abs() * 1.5;
    let filled = max - min >= 0.5 * (hi - lo) || (flat && nice_bounds(min, max) == [lo, hi]);
    if inside && filled {
        return [lo, hi];
    }
    let (below, above) = (data_min < lo, data_max > hi);
    let room = (max - min) * if below && above { 0.125 } else { 0.25 };
    let lower = if below && !flat { min - room } else { min };
    let upper = if above && !flat { max + room } else { max };
    // Extra room must not add a side of zero on which there are no data.
    nice_bounds(
        if min >= 0.0 { lower.max(0.0) } else { lower },
        if max <= 0.0 { upper.min(0.0) } else { upper },
    )
}

/// Returns bounds of a log axis for positive data: full decades if `round` is set, at most 18 of them.
fn log_bounds(min: f64, max: f64, round: bool) -> [f64; 2] {
    let hi = max.clamp(1e-299, 1e299);
    let lo = min.clamp(hi * 1e-18, hi).max(1e-300);
    let [mut a, mut b] = [lo.log10(), hi.log10()];
    if round {
        [a, b] = [(a + 1e-9).floor(), (b - 1e-9).ceil()];
    }
    if b - a < 1e-6 {
        [a, b] = [a - 0.5, b + 0.5];
    }
    [10f64.powf(a), 10f64.powf(b)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nice_bounds_hold_the_data_and_little_more() {
        assert_eq!(nice_bounds(0.02, 0.97), [0.0, 1.0]);
        assert_eq!(nice_bounds(-3.0, 12.0), [-4.0, 12.0]);
        assert_eq!(nice_bounds(0.0, 0.0), [0.0, 1.0]);
        assert_eq!(nice_bounds(f64::NAN, 1.0), [0.0, 1.0]);
        let mut seed = 7u64;
        for _ in 0..20_000 {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1);
            let a = ((seed >> 33) as f64 / 2e9 - 1.0) * 10f64.powi((seed % 581) as i32 - 290);
            let b = a * (1.0 + (seed >> 40) as f64 / 1e6);
            let [lo, hi] = nice_bounds(a, b);
            let slack = 1e-8 * (hi - lo);
            let [min, max] = [a.min(b), a.max(b)];
            assert!(lo <= min + slack && hi >= max - slack, "{a} {b}: {lo} {hi}");
            assert!(lo < hi && lo.is_finite() && hi.is_finite());
            if max - min > 1e-5 * max.abs().max(min.abs())
                && max.abs() < 1e299
                && max - min > 1e-299
            {
                assert!(max - min >= 0.6 * (hi - lo), "{a} {b}: {lo} {hi}");
            }
        }
    }

    #[test]
    fn sticky_bounds_stay_until_they_must_go() {
        let first = sticky_bounds(None, 0.0, 0.9);
        assert_eq!(first, [0.0, 1.0]);
        assert_eq!(sticky_bounds(Some(first), 0.0, 0.99), first);
        assert_eq!(sticky_bounds(Some(first), 0.2, 0.75), first);
        let grown = sticky_bounds(Some(first), 0.0, 1.01);
        assert_eq!(grown[0], 0.0);
        assert!(grown[1] >= 1.2);
        assert_eq!(sticky_bounds(Some(first), 0.0, 0.3), nice_bounds(0.0, 0.3));
        assert_eq!(sticky_bounds(Some(first), f64::NAN, 0.3), first);
        assert_eq!(sticky_bounds(Some([f64::NAN, 1.0]), 0.0, 0.9), first);
    }

    #[test]
    fn sticky_bounds_come_to_rest() {
        let mut changes = 0;
        let mut bounds = None;
        for i in 0..20_000 {
            let [min, max] = [0.0, 1e-9 * (1.0 + f64::from(i) / 20.0)];
            let next = sticky_bounds(bounds, min, max);
            assert_eq!(sticky_bounds(Some(next), min, max), next, "{min} {max}");
            changes += i32::from(Some(next) != bounds);
            bounds = Some(next);
        }
        assert!(
            changes < 40,
            "a thousandfold growth moved the axis {changes} times"
        );
        for previous in [[0.0, 1.0], [-5.0, 2.0], [3.0, 3.1], [-1e300, 1e300]] {
            for (min, max) in [
                (5.0, 5.0),
                (0.0, 0.0),
                (-7.0, 9.0),
                (1.0, 1.0 + 1e-9),
                (-2.0, -1.0),
            ] {
                let next = sticky_bounds(Some(previous), min, max);
                assert_eq!(
                    sticky_bounds(Some(next), min, max),
                    next,
                    "{previous:?} {min} {max}"
                );
                assert!(next[0] <= min && next[1] >= max);
            }
        }
    }

    #[test]
    fn senseless_bounds_give_way_to_the_data() {
        let data = Some([1.0, 9.0]);
        let axis = || Axis::new("x", "m");
        assert_eq!(axis().bounds([4.0, 2.0]).resolve(data, false), [2.0, 4.0]);
        assert_eq!(
            axis().bounds([f64::NAN, 2.0]).resolve(data, false),
            [1.0, 9.0]
        );
        assert_eq!(
            axis()
                .bounds([0.0, 2.0])
                .scale(Scale::Log)
                .resolve(data, true),
            [1.0, 10.0]
        );
        assert_eq!(axis().resolve(None, true), [0.0, 1.0]);
        let zeros = axis().bounds([0.0, 0.0]).expecting(3e-7);
        let [lo, hi] = zeros.resolve(Some([0.0, 0.0]), true);
        assert!(lo == 0.0 && (3e-7..4e-7).contains(&hi));
        let [lo, hi] = axis().bounds([3.0, 3.0]).resolve(data, false);
        assert!(lo < 3.0 && hi > 3.0);
    }
}

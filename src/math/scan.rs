//! Searches and reductions over a row of nodal values.

use std::ops::Range;

/// Returns the largest of `values`, or 0 if none is positive; skips NaN.
///
/// Keeps eight maxima, so that no comparison waits for the previous one.
#[inline(always)]
pub fn largest(values: &[f64]) -> f64 {
    let larger = |a: f64, b: f64| if b > a { b } else { a };
    let (eights, rest) = values.as_chunks::<8>();
    let mut maxima = [0.0; 8];
    for eight in eights {
        for (maximum, &value) in maxima.iter_mut().zip(eight) {
            *maximum = larger(*maximum, value);
        }
    }
    maxima.iter().chain(rest).copied().fold(0.0, larger)
}

/// Returns the smallest and the largest of `values`; `None` if there are none.
pub fn range(values: impl IntoIterator<Item = f64>) -> Option<[f64; 2]> {
    let ends = values.into_iter().map(|value| [value; 2]);
    ends.reduce(|[low, high], [value, _]| [low.min(value), high.max(value)])
}

/// Counts how many of `values` have a property before the first that does not.
///
/// Tests eight at a time, without a branch between them.
#[inline(always)]
pub fn leading<T>(values: &[T], has: impl Fn(&T) -> bool) -> usize {
    let (eights, _) = values.as_chunks::<8>();
    let all = |eight: &&[T; 8]| eight.iter().fold(true, |all, value| all & has(value));
    let whole = 8 * eights.iter().take_while(all).count();
    whole
        + values[whole..]
            .iter()
            .take_while(|value| has(value))
            .count()
}

/// Counts how many of `values` have a property after the last that does not.
#[inline(always)]
pub fn trailing<T>(values: &[T], has: impl Fn(&T) -> bool) -> usize {
    let (_, eights) = values.as_rchunks::<8>();
    let all = |eight: &&[T; 8]| eight.iter().fold(true, |all, value| all & has(value));
    let whole = 8 * eights.iter().rev().take_while(all).count();
    let rest = values[..values.len() - whole].iter().rev();
    whole + rest.take_while(|value| has(value)).count()
}

/// Finds where a row changes its `kind`: the first index behind each change.
pub fn changes<T, K: PartialEq>(
    values: &[T],
    kind: impl Fn(&T) -> K,
) -> impl Iterator<Item = usize> {
    let mut at = 0;
    std::iter::from_fn(move || {
        let now = kind(values.get(at)?);
        at += leading(&values[at..], |value| kind(value) == now);
        (at < values.len()).then_some(at)
    })
}

/// Returns |f″| at the points `x` by second differences; the end points take their neighbours' values. 0 for fewer than
/// three points.
pub fn second_differences(x: &[f64], f: &[f64]) -> Vec<f64> {
    if x.len() < 3 {
        return vec![0.0; x.len()];
    }
    let slope = |k: usize| (f[k + 1] - f[k]) / (x[k + 1] - x[k]);
    let inner = (0..x.len()).map(|i| i.clamp(1, x.len() - 2));
    inner
        .map(|i| ((slope(i) - slope(i - 1)) / (0.5 * (x[i + 1] - x[i - 1]))).abs())
        .collect()
}

/// Returns the smallest range outside which `values` are zero.
#[inline(always)]
pub fn support(values: &[f64]) -> Range<usize> {
    let end = values.len() - trailing(values, |&value| value == 0.0);
    leading(&values[..end], |&value| value == 0.0)..end
}

/// Returns the ordinate at `x` of the line through points, linearly interpolated in the first segment that contains
/// `x`. `None` in gaps, where a point is not finite, and outside.
pub fn value_at(xs: &[f64], ys: &[f64], x: f64) -> Option<f64> {
    let mut previous: Option<(f64, f64)> = None;
    for (&x1, &y1) in xs.iter().zip(ys) {
        let point = (x1.is_finite() && y1.is_finite()).then_some((x1, y1));
        if point.is_some() && x1 == x {
            return Some(y1);
        }
        if let (Some((x0, y0)), Some(_)) = (previous, point)
            && (x0.min(x1)..=x0.max(x1)).contains(&x)
        {
            let share = (x / 2.0 - x0 / 2.0) / (x1 / 2.0 - x0 / 2.0);
            return Some(y0 * (1.0 - share) + y1 * share);
        }
        previous = point;
    }
    None
}

/// Returns how far an axis must reach for weighted sizes: to the largest, but at most to 1.5 times the size below which
/// 95 % of the weight lies. A local singularity then does not flatten everything else. Sizes of zero do not count.
pub fn robust_top(sizes: impl Iterator<Item = [f64; 2]>) -> f64 {
    let is_there = |[size, weight]: &[f64; 2]| *size > 0.0 && size.is_finite() && *weight > 0.0;
    let mut sizes: Vec<[f64; 2]> = sizes.filter(is_there).collect();
    sizes.sort_unstable_by(|a, b| b[0].total_cmp(&a[0]));
    let Some(&[largest, _]) = sizes.first().filter(|_| sizes.len() >= FEW) else {
        return sizes.first().map_or(0.0, |[size, _]| *size);
    };
    let mut left = 0.05 * sizes.iter().map(|[_, weight]| weight).sum::<f64>();
    let quantile = sizes.iter().find(|[_, weight]| {
        left -= weight;
        left < 0.0
    });
    largest.min(1.5 * quantile.map_or(largest, |[size, _]| *size))
}

/// Minimum number of sizes for a meaningful distribution.
const FEW: usize = 20;

/// Returns the element `places` after `now`, wrapping around at the ends.
pub fn shifted<T: Copy + PartialEq>(all: &[T], now: T, places: isize) -> T {
    let at = all.iter().position(|one| *one == now).unwrap_or(0) as isize;
    all[(at + places).rem_euclid(all.len() as isize) as usize]
}

/// Returns the root mean square; 0 if there are no values.
pub fn rms(values: &[f64]) -> f64 {
    let squares: f64 = values.iter().map(|value| value * value).sum();
    (squares / values.len().max(1) as f64).sqrt()
}

/// Returns the last of `values` and others at even distances before it, in their order: at most `most` of them.
pub fn thinned<T>(values: &[T], most: usize) -> Vec<&T> {
    let every = values.len().div_ceil(most).max(1);
    let mut kept: Vec<&T> = values.iter().rev().step_by(every).collect();
    kept.reverse();
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_is_found_wherever_it_stands() {
        for count in [1, 7, 8, 9, 30] {
            for at in 0..count {
                let mut values = vec![-1.0; count];
                values[at] = 2.0;
                assert_eq!(largest(&values), 2.0);
                values[(at + 1) % count] = f64::NAN;
                assert_eq!(largest(&values), if count > 1 { 2.0 } else { 0.0 });
                values[at] = f64::INFINITY;
                assert_eq!(largest(&values), f64::INFINITY);
            }
        }
        assert_eq!(largest(&[-1.0, f64::NAN]), 0.0);
        assert_eq!(largest(&[]), 0.0);
    }

    #[test]
    fn elements_go_around() {
        assert_eq!(shifted(&[1, 2, 3], 3, 1), 1);
        assert_eq!(shifted(&[1, 2, 3], 1, -1), 3);
    }

    #[test]
    fn the_last_is_kept_and_no_more_than_asked_for() {
        assert_eq!(thinned(&[1, 2, 3, 4, 5], 2), [&2, &5]);
        assert_eq!(thinned(&[1, 2, 3], 3), [&1, &2, &3]);
        assert!(thinned::<u8>(&[], 3).is_empty());
    }

    #[test]
    fn every_change_is_found() {
        let row: Vec<bool> = (0..40).map(|i| [3, 4, 20, 39].contains(&i)).collect();
        let ends: Vec<usize> = changes(&row, |&value| value).collect();
        assert_eq!(ends, [3, 5, 20, 21, 39]);
        assert_eq!(changes(&row[5..20], |&value| value).next(), None);
        assert_eq!(changes(&row[..0], |&value| value).next(), None);
    }

    #[test]
    fn the_support_ends_where_only_zeros_follow() {
        assert_eq!(support(&[0.0, 1.0, 0.0, f64::NAN, -0.0]), 1..4);
        assert_eq!(support(&[3.0]), 0..1);
        assert_eq!(support(&[0.0; 4]), 0..0);
        assert_eq!(support(&[]), 0..0);
        for (first, last) in [(0, 39), (3, 11), (8, 15), (17, 17), (31, 38)] {
            let mut values = [0.0; 40];
            (values[first], values[last]) = (1.0, 1.0);
            assert_eq!(support(&values), first..last + 1);
        }
    }
}

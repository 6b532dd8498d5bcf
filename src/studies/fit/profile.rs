//! Intervals by the profile of the likelihood, for keys whose error is no symmetric one: a scar at its limit says that k
//! is at least so much, and nothing more.
//!
//! The other keys follow at their best, and the interval ends where Σz² has risen by 2²: S. S. Wilks (1938), Ann. Math.
//! Stat. 9, 60–62.

use super::report::Fitted;
use super::search::{Found, Search};

/// Keys whose logarithm has a larger standard error get an interval.
const VAGUE: f64 = 0.15;

/// Σz² rises by the square of this, in units of the variance of z, at two standard errors.
const RISE: f64 = 2.0;

/// The first step away from the minimum, in e-folds: further ones double it, to the end of the range.
const FIRST: f64 = 0.2;

/// An end is known to so much, in e-folds, and better where the root of the rise is straight.
const KNOWN: f64 = 0.2;

/// Adds the intervals of keys that need them.
pub(super) fn add_intervals(search: &Search, found: &Found, fitted: &mut Fitted) {
    let vague = |i: &usize| {
        let (value, free) = (&fitted.values[*i], &search.fit.free[*i]);
        let is_vague = |error: f64| error > VAGUE * free.value(found.theta[*i]).abs();
        free.is_positive() && value.stderr.is_none_or(is_vague)
    };
    let vague: Vec<usize> = (0..fitted.values.len()).filter(vague).collect();
    if vague.is_empty() {
        return;
    }
    let search = &search.on_finest();
    let Ok((theta, least)) = search.least_squares(&found.theta, None) else {
        return;
    };
    let freedom = (found.z.len() - found.theta.len()).max(1) as f64;
    let variance = least / freedom;
    for i in vague {
        let ends = [-1.0, 1.0].map(|sense| end(search, &theta, i, sense, (least, variance)));
        let free = &search.fit.free[i];
        let interval = ends.map(|end| end.map(|theta| free.value(theta)));
        // What is fitted nowhere else has no interval either.
        let value = &mut fitted.values[i];
        value.interval = Some(interval);
        let unit = value.unit;
        let key = &value.key;
        let place = fitted
            .remarks
            .iter()
            .position(|remark| remark.contains(key.as_str()) && remark.contains("determine"));
        let word = match interval {
            [Some(low), None] => {
                format!("the data give {key} a lower limit alone: {key} ≥ {low:.3e} {unit} (2 σ)")
            }
            [None, Some(high)] => {
                format!("the data give {key} an upper limit alone: {key} ≤ {high:.3e} {unit} (2 σ)")
            }
            [Some(low), Some(high)] => {
                format!("{key} lies between {low:.3e} and {high:.3e} {unit} (2 σ)")
            }
            [None, None] => continue,
        };
        if let Some(place) = place {
            fitted.remarks.remove(place);
        }
        fitted.remarks.push(word);
    }
}

/// Where the profile of key `i` has risen enough in one direction; `None` if it does not.
fn end(
    search: &Search,
    theta: &[f64],
    i: usize,
    sense: f64,
    (least, variance): (f64, f64),
) -> Option<f64> {
    let mut from = theta.to_vec();
    let place = |step: f64| search.fit.free[i].moved(theta[i], sense * step);
    // Where no run ends, it is not the data that set the limit.
    let mut rise_at = |step: f64| {
        from[i] = place(step);
        let (best, sum) = search.least_squares(&from, Some(i)).ok()?;
        from = best;
        Some(((sum - least).max(0.0) / variance).sqrt())
    };
    let (mut near, mut far) = ((0.0, 0.0), (FIRST, rise_at(FIRST)?));
    while far.1 < RISE {
        if place(2.0 * far.0) == place(far.0) {
            return None;
        }
        (near, far) = (far, (2.0 * far.0, rise_at(2.0 * far.0)?));
    }
    while far.0 - near.0 > KNOWN {
        let middle = 0.5 * (near.0 + far.0);
        let rise = rise_at(middle)?;
        let end = if rise < RISE { &mut near } else { &mut far };
        *end = (middle, rise);
    }
    let share = (RISE - near.1) / (far.1 - near.1);
    Some(place(near.0 + share * (far.0 - near.0)))
}

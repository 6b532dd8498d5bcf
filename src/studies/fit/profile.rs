//! Intervals by the profile of the likelihood, for keys whose error is no symmetric one: a scar at its limit says that k
//! is at least so much, and nothing more.
//!
//! The other keys follow at their best, and the interval ends where Σz² has risen by 2²: S. S. Wilks (1938), Ann. Math.
//! Stat. 9, 60–62.

use super::report::Fitted;
use super::search::{Found, Search};

/// Keys whose logarithm has a larger standard error get an interval.
const VAGUE: f64 = 0.15;

/// The rise of Σz² at two standard errors, in units of the variance of z.
const RISE: f64 = 4.0;

/// Steps away from the minimum, in e-folds; a key without a limit up to the last one has none.
const STEPS: [f64; 6] = [0.2, 0.5, 1.1, 2.2, 3.4, 4.6];

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
    let Some((theta, least)) = search.least_squares(&found.theta, None) else {
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
    let mut rise_at = |step: f64| {
        from[i] = search.fit.free[i].moved(theta[i], sense * step);
        let (best, sum) = search.least_squares(&from, Some(i))?;
        from = best;
        Some((sum - least) / variance)
    };
    let mut before = (0.0, 0.0);
    for step in STEPS {
        // If the contact cannot be computed, it cannot have been measured.
        let Some(rise) = rise_at(step) else {
            return Some(search.fit.free[i].moved(theta[i], sense * step));
        };
        if rise > RISE {
            // √rise is nearly straight.
            let mut ends = [before, (step, rise.sqrt())];
            for _ in 0..2 {
                let [low, high] = ends;
                let middle = low.0 + (RISE.sqrt() - low.1) / (high.1 - low.1) * (high.0 - low.0);
                let Some(found) = rise_at(middle).map(|rise| rise.max(0.0).sqrt()) else {
                    break;
                };
                ends = if found > RISE.sqrt() {
                    [low, (middle, found)]
                } else {
                    [(middle, found), high]
                };
            }
            let [low, high] = ends;
            let middle = low.0 + (RISE.sqrt() - low.1) / (high.1 - low.1) * (high.0 - low.0);
            return Some(search.fit.free[i].moved(theta[i], sense * middle));
        }
        before = (step, rise.max(0.0).sqrt());
    }
    None
}

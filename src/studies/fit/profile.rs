//! Intervals by the profile of the likelihood, for keys whose error is no symmetric one: a scar at its limit says that k
//! is at least so much, and nothing more.
//!
//! The other keys follow at their best, and the interval ends where Σz² has risen by 2²: S. S. Wilks (1938), Ann. Math.
//! Stat. 9, 60–62.

use super::errors::ErrorAnalysis;
use super::search::{Found, Search};

/// Keys whose logarithm has a larger standard error get an interval, unless it ends near two standard errors on both
/// sides, to this part.
const VAGUE: f64 = 0.05;
const SYMMETRIC: f64 = 0.25;

/// Σz² rises by the square of this, in units of the variance of z, at two standard errors.
const RISE: f64 = 2.0;

/// The first step away from the minimum, in e-folds: further ones double it, to the end of the range.
const FIRST: f64 = 0.3;

/// An end is known to so much, in e-folds, and better where the root of the rise is straight.
const KNOWN: f64 = 0.06;

/// The ends of two standard errors; an end is `None` if the data set none.
pub(super) type Interval = [Option<f64>; 2];

/// Returns the interval of each key that needs one.
pub(super) fn intervals(
    search: &Search,
    found: &Found,
    errors: &ErrorAnalysis,
) -> Vec<Option<Interval>> {
    let keys = search.fit.free.iter().enumerate();
    let is_vague = keys.map(|(i, free)| {
        let error = errors.standard_error(i);
        free.is_positive() && !(error > 0.0 && error <= VAGUE)
    });
    let is_vague: Vec<bool> = is_vague.collect();
    let mut none = vec![None; is_vague.len()];
    if !is_vague.contains(&true) {
        return none;
    }
    let Ok((theta, least)) = search.least_squares(&found.theta, None) else {
        return none;
    };
    let mut profile = LikelihoodProfile {
        search,
        theta,
        least,
        freedom: (found.z.len() - found.theta.len()).max(1) as f64,
    };
    for (i, interval) in none.iter_mut().enumerate().filter(|(i, _)| is_vague[*i]) {
        let high = profile.end(i, 1.0);
        let ends = [profile.end(i, -1.0), high];
        let two = RISE * errors.standard_error(i);
        let is_near = |end: &Option<f64>| {
            end.is_some_and(|end| ((end - profile.theta[i]).abs() / two - 1.0).abs() < SYMMETRIC)
        };
        let value = |theta: f64| search.fit.free[i].value(theta);
        let is_plain = ends.iter().all(is_near);
        *interval = (!is_plain).then(|| ends.map(|end| end.map(value)));
    }
    none
}

/// The profile of Σz² around its minimum.
struct LikelihoodProfile<'a> {
    search: &'a Search<'a>,
    theta: Vec<f64>,
    /// The least Σz² so far: a plateau may fall slightly.
    least: f64,
    freedom: f64,
}

impl LikelihoodProfile<'_> {
    /// Where the profile of key `i` has risen enough in one direction; `None` if it does not.
    fn end(&mut self, i: usize, sense: f64) -> Option<f64> {
        let (free, start) = (&self.search.fit.free[i], self.theta[i]);
        let mut from = self.theta.clone();
        let place = |step: f64| free.moved(start, sense * step);
        // Where no run ends, it is not the data that set the limit.
        let mut rise_at = |step: f64| {
            from[i] = place(step);
            let (best, sum) = self.search.least_squares(&from, Some(i)).ok()?;
            from = best;
            self.least = self.least.min(sum);
            let variance = self.least / self.freedom;
            Some(((sum - self.least) / variance).sqrt())
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
}

//! The levels of numerics of a fit: a coarse one for the search, finer ones at the minimum.
//!
//! A finer level is run once at the minimum so far, which tells how far it moves the keys; then the search goes on there,
//! until the next level would move them by much less than their errors. No fit ends on a coarser level than the third: a
//! border of slip between few cells moves in steps.

use anyhow::Result;

use super::coarse::FINER;
use super::errors::ErrorAnalysis;
use super::search::{Found, Search};
use super::solver::Free;
use crate::studies::refinement::{Level, difference_per_error};

/// How much smaller its tolerance of jumps is: their errors add up to this to the power of two thirds.
const LESS_TOLERANT: f64 = 2.0;

/// An error is small if it is less than this fraction of the statistical one.
const SMALL: f64 = 0.3;

/// Maximum number of levels, and of cells times steps of a level that is refined although the accuracy is met.
const MOST_LEVELS: usize = 5;
const MOST_WORK: f64 = 5e5;

/// Moves a minimum to finer levels. Returns its uncertainty and the numerical errors of the keys; none where no finer
/// level could be run. A level that the scenario names is kept, and a finer one only tells its error.
///
/// # Errors
/// If the scenario does not allow a finer level.
pub(super) fn refine(
    search: &mut Search,
    found: &mut Found,
) -> Result<(ErrorAnalysis, Option<Vec<f64>>)> {
    let accuracy = search.fit.scenario.accuracy();
    let mut errors = search.uncertainty(found, &[]);
    let mut numerical = None;
    for round in 0..MOST_LEVELS {
        let level = Level::from_scenario(&search.scenario);
        let level = Level {
            tolerance: level.tolerance.map(|tolerance| tolerance / LESS_TOLERANT),
            ..level.scaled(FINER, FINER)
        };
        let scenario = level.of_scenario(&search.scenario)?;
        let Ok((changes, steps)) = search.changes_on(&scenario, found) else {
            break;
        };
        let moved = errors.newton_step(&search.in_errors(&changes));
        let error_on = |finer: f64| {
            let per_error = difference_per_error(finer);
            moved.iter().map(|moved| moved.abs() / per_error).collect()
        };
        let Some(accuracy) = accuracy else {
            return Ok((errors, Some(error_on(FINER.recip()))));
        };
        let left: Vec<f64> = error_on(FINER);
        let is_less = |(i, free): (usize, &Free)| {
            let met = accuracy * free.size(found.theta[i]);
            // What the data do not determine needs no finer level.
            let error = errors.standard_error(i);
            [error == 0.0 || left[i] <= SMALL * error, left[i] <= met]
        };
        let keys = search.fit.free.iter().enumerate().map(is_less);
        let [is_small, is_met] =
            keys.fold([true; 2], |all, one| [all[0] & one[0], all[1] & one[1]]);
        let is_costly = steps as f64 * level.points as f64 > MOST_WORK;
        numerical = Some(left);
        let is_last = round > 0 && (is_small || is_met && is_costly);
        let before = search.clone();
        search.move_to(scenario);
        let better = search.descend(&found.theta).ok();
        let better = better.map(|found| (search.uncertainty(&found, &[]), found));
        // What the end of the time has cut off tells nothing.
        let Some(better) = better.filter(|_| search.is_in_time()) else {
            *search = before;
            break;
        };
        (errors, *found) = better;
        if is_last {
            break;
        }
    }
    Ok((errors, numerical))
}

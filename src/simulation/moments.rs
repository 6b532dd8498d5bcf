//! When steps end: at multiples of 1/steps-per-cycle, and where the motion turns.

use super::Setup;
use super::choices::Scheme;

/// A turning point this close to a regular moment, in steps, takes its place.
const SLIVER: f64 = 0.1;

/// Cycles that are less than this apart are the same moment.
pub(super) fn rounding(setup: &Setup, cycle: f64) -> f64 {
    let steps = f64::from(setup.steps_per_cycle);
    (1e-6 / steps).max(8.0 * f64::EPSILON * cycle)
}

/// The end of the step that begins at the cycle `now`, and whether the motion turns there: the next
/// multiple of 1/steps-per-cycle, or before it the next turning point, if the scheme minds. Only a run
/// `under_way` passes over a multiple that is very near.
pub(super) fn next(setup: &Setup, now: f64, under_way: bool) -> (f64, bool) {
    let steps = f64::from(setup.steps_per_cycle);
    let rounding = rounding(setup, now);
    // The tolerance outgrows the rounding of late cycles, so that every step gets on.
    let multiple = ((now + rounding) * steps).floor() + 1.0;
    let regular = multiple / steps;
    if setup.scheme == Scheme::Euler {
        return (regular, false);
    }
    let (drive, ratio) = (&setup.drive, setup.material.stick_ratio());
    let sliver = SLIVER / steps;
    // The end of a cycle is never passed over: histories count on it.
    let passable = |moment: f64| moment.fract() != 0.0;
    let next = |regular: f64| {
        let turn = drive.turning_point(ratio, now + rounding, regular + sliver);
        match turn {
            Some(turn) if (turn - regular).abs() <= rounding => (regular, true),
            Some(turn) if turn < regular || passable(regular) => (turn, true),
            _ => (regular, false),
        }
    };
    if regular - now < sliver && passable(regular) && under_way {
        return next((multiple + 1.0) / steps);
    }
    next(regular)
}

/// The ends of all steps of one period of the motion, in cycles from its beginning.
pub(super) fn of_period(setup: &Setup, cycles: u32) -> Vec<f64> {
    let end = f64::from(cycles);
    let mut moments = Vec::new();
    let mut now = 0.0;
    while now < end {
        now = next(setup, now, true).0.min(end);
        moments.push(now);
    }
    moments
}

//! When steps end: at equal fractions of a period of the faster motion, where the motion reverses,
//! and where contact is made or lost.

use std::sync::Arc;

use super::Setup;
use super::choices::Scheme;
use super::drive::Targets;
use super::state::State;

/// A turning point this close to a regular moment, in steps, takes its place.
const SLIVER: f64 = 0.1;

/// What the contact has to do with when the motion turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Touch {
    /// κ.
    stick_ratio: f64,
    /// What an amplitude of each direction is in displacement.
    yields: [f64; 2],
    /// The lowest point of the 1D profile, m; −∞ where the motion never comes up to the axis.
    tip: f64,
}

impl Touch {
    /// That of the contact after a step, on the 1D profile `g` (m), from the axis outwards.
    pub fn on(setup: &Setup, state: &State, mut g: impl Iterator<Item = f64>) -> Self {
        let axis = g.next().unwrap_or(f64::INFINITY);
        // What never leaves the axis never leaves a lower point.
        let tip = if setup.drive.normal().oscillation().lowest() > axis {
            f64::NEG_INFINITY
        } else {
            g.fold(axis, f64::min)
        };
        let radius = state.contact.normal.radius;
        Self {
            stick_ratio: setup.material.stick_ratio(),
            yields: setup.drive.yields(&setup.material, radius),
            tip,
        }
    }
}

/// Cycles that are less than this apart are the same moment.
pub(super) fn rounding(setup: &Setup, cycle: f64) -> f64 {
    (1e-6 / setup.steps_in_a_cycle()).max(8.0 * f64::EPSILON * cycle)
}

/// The end of the step that begins at the cycle `now`, and whether the motion turns or touches there: the next
/// even part of a cycle, or before it the next such point, if the scheme minds. Only a run `under_way` passes
/// over a part that is very near.
pub(super) fn next(setup: &Setup, touch: Touch, now: f64, under_way: bool) -> (f64, bool) {
    let steps = setup.steps_in_a_cycle();
    let rounding = rounding(setup, now);
    // The tolerance outgrows the rounding of late cycles, so that every step gets on.
    let multiple = ((now + rounding) * steps).floor() + 1.0;
    let regular = multiple / steps;
    if setup.scheme == Scheme::Euler {
        return (regular, false);
    }
    let sliver = SLIVER / steps;
    // The end of a cycle is never passed over: histories count on it.
    let passable = |moment: f64| moment.fract() != 0.0;
    let next = |regular: f64| {
        let turn = turn(setup, touch, now + rounding, regular + sliver);
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

/// The first point at which the motion turns, or contact is made or lost.
fn turn(setup: &Setup, touch: Touch, from: f64, until: f64) -> Option<f64> {
    let drive = &setup.drive;
    let turn = drive.turning_point(touch.stick_ratio, touch.yields, from, until);
    let touching = drive.touching_point(touch.tip, from, turn.unwrap_or(until));
    touching.or(turn)
}

/// The ends of all steps of a period of the motion, in cycles from its beginning, and what the motion asks for there:
/// found once as long as the contact leaves the turns where they are.
#[derive(Debug, Clone, Default)]
pub(super) struct Period {
    touch: Option<Touch>,
    moments: Arc<[(f64, Targets)]>,
}

impl Period {
    /// Those of a period of `cycles`.
    pub fn moments(&mut self, setup: &Setup, touch: Touch, cycles: f64) -> Arc<[(f64, Targets)]> {
        if self.touch != Some(touch) {
            let after =
                |&now: &f64| (now < cycles).then(|| next(setup, touch, now, true).0.min(cycles));
            let moments = std::iter::successors(after(&0.0), after);
            let moments = moments.map(|moment| (moment, setup.drive.targets(moment)));
            (self.touch, self.moments) = (Some(touch), moments.collect());
        }
        Arc::clone(&self.moments)
    }
}

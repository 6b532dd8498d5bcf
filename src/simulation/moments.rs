//! When steps end: at equal fractions of a period of the faster motion, where the motion reverses,
//! where contact is made or lost, and where friction or wear bends on its course over cycles.

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
    /// What says where the motion turns: κ, and what an amplitude of each direction is in displacement.
    turning: (f64, [f64; 2]),
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
        let (material, radius) = (&setup.material, state.contact.normal.radius);
        Self {
            turning: (material.stick_ratio(), setup.drive.yields(material, radius)),
            tip,
        }
    }

    /// The lowest point of the 1D profile, m; −∞ where the motion never comes up to the axis.
    pub fn tip(self) -> f64 {
        self.tip
    }

    /// The first turning point after `from` and up to `until`.
    pub fn turning_point(self, setup: &Setup, from: f64, until: f64) -> Option<f64> {
        let (stick_ratio, yields) = self.turning;
        (setup.drive).turning_point(stick_ratio, yields, from, until)
    }
}

/// Cycles that are less than this apart are the same moment.
pub(super) fn rounding(setup: &Setup, cycle: f64) -> f64 {
    (1e-6 / setup.steps_in_a_cycle()).max(8.0 * f64::EPSILON * cycle)
}

/// The end of the step that begins at the cycle `now`, and whether the motion turns or touches there: the next
/// even part of a cycle, or before it the next such point, if the scheme minds; `turning` finds the first of the turning
/// points after a moment and up to another one. Only a run `under_way` passes over a part that is very near.
pub(super) fn next(
    setup: &Setup,
    touch: Touch,
    now: f64,
    under_way: bool,
    turning: impl Fn(f64, f64) -> Option<f64>,
) -> (f64, bool) {
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
        let (from, until) = (now + rounding, regular + sliver);
        let turn = turning(from, until);
        let before = turn.unwrap_or(until);
        let bending = setup.running_in.as_ref();
        let bend = bending.and_then(|all| all.corner(from, before, steps.recip()));
        let before = bend.unwrap_or(before);
        let touching = setup.drive.touching_point(touch.tip, from, before);
        match touching.or(bend).or(turn) {
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

/// The ends of all steps of a period of the motion, in cycles from its beginning, and what the motion asks for there:
/// found once as long as the contact leaves the turns where they are.
#[derive(Debug, Clone, Default)]
pub(super) struct Period {
    touch: Option<Touch>,
    /// Where the motion turns, in cycles: where contact is lost, only the touches move.
    turns: Vec<f64>,
    moments: Arc<[(f64, Targets)]>,
}

impl Period {
    /// Those of a period of `cycles`.
    pub fn moments(&mut self, setup: &Setup, touch: Touch, cycles: f64) -> Arc<[(f64, Targets)]> {
        let before = self.touch.replace(touch);
        if before.map(|before| before.turning) != Some(touch.turning) {
            let end = cycles + SLIVER;
            let after = |&now: &f64| touch.turning_point(setup, now + rounding(setup, now), end);
            self.turns = std::iter::successors(after(&0.0), after).collect();
        }
        if before != Some(touch) {
            let turning = |from, until| {
                let next = self.turns.partition_point(|&turn| turn <= from);
                self.turns.get(next).copied().filter(|&turn| turn <= until)
            };
            let after = |&now: &f64| {
                (now < cycles).then(|| next(setup, touch, now, true, turning).0.min(cycles))
            };
            let moments = std::iter::successors(after(&0.0), after);
            let moments = moments.map(|moment| (moment, setup.drive.targets(moment)));
            self.moments = moments.collect();
        }
        Arc::clone(&self.moments)
    }
}

//! When steps end: at equal fractions of a period of the faster motion, where the motion reverses,
//! where contact is made or lost, and where friction or wear bends on its course over cycles.

use std::sync::Arc;

use super::Setup;
use super::choices::Scheme;
use super::drive::Targets;
use super::state::State;

/// A turning point this close to a regular moment, in steps, replaces it.
const SLIVER: f64 = 0.1;

/// The properties of the contact that determine when the motion turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Touch {
    /// What determines turning points: κ, and the displacement per amplitude of each direction.
    turning: (f64, [f64; 2]),
    /// Lowest point of the 1D profile, m; −∞ if the motion never rises to the axis.
    tip: f64,
}

impl Touch {
    /// Reads them from the contact after a step, on the 1D profile `g` (m), from the axis outwards.
    pub fn new(setup: &Setup, state: &State, mut g: impl Iterator<Item = f64>) -> Self {
        let axis = g.next().unwrap_or(f64::INFINITY);
        // If the motion never leaves the axis, it never leaves a lower point.
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

    /// Returns the lowest point of the 1D profile, m; −∞ if the motion never rises to the axis.
    pub fn tip(self) -> f64 {
        self.tip
    }

    /// Returns the first turning point after `from` and up to `until`.
    pub fn turning_point(self, setup: &Setup, from: f64, until: f64) -> Option<f64> {
        let (stick_ratio, yields) = self.turning;
        (setup.drive).turning_point(stick_ratio, yields, from, until)
    }
}

/// Returns the difference in cycles below which two moments count as the same.
pub(super) fn rounding(setup: &Setup, cycle: f64) -> f64 {
    (1e-6 / setup.steps_in_a_cycle()).max(8.0 * f64::EPSILON * cycle)
}

/// Returns the end of the step that begins at the cycle `now`, and whether the motion turns or touches there: the next
/// regular fraction of a cycle, or a turning or touching point before it, unless the scheme ignores those. `turning`
/// finds the first turning point after one moment and up to another. Only a run `under_way` skips a fraction that is
/// very near.
pub(super) fn next(
    setup: &Setup,
    touch: Touch,
    now: f64,
    under_way: bool,
    turning: impl Fn(f64, f64) -> Option<f64>,
) -> (f64, bool) {
    let steps = setup.steps_in_a_cycle();
    let rounding = rounding(setup, now);
    // The tolerance exceeds the rounding of late cycles, so that every step advances.
    let multiple = ((now + rounding) * steps).floor() + 1.0;
    let regular = multiple / steps;
    if setup.scheme == Scheme::Euler {
        return (regular, false);
    }
    let sliver = SLIVER / steps;
    // The end of a cycle is never skipped: histories rely on it.
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

/// The ends of all steps in a period of the motion, in cycles from its beginning, with the targets there; reused while
/// the contact leaves the turning points unchanged.
#[derive(Debug, Clone, Default)]
pub(super) struct Period {
    touch: Option<Touch>,
    /// Turning points, in cycles: if contact is lost, only the touching points move.
    turns: Vec<f64>,
    moments: Arc<[(f64, Targets)]>,
}

impl Period {
    /// Returns the moments of a period of `cycles`.
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

//! Finds where the motion turns, and where it makes or loses contact: slip begins or ends there, and so does a step.

use std::f64::consts::TAU;

use super::{Control, Drive};
use crate::math::root;

/// Number of pieces of a cycle in the search for turning points.
const PIECES_OF_A_CYCLE: f64 = 64.0;

/// Distance from a corner at which its second side is evaluated, in cycles.
const BEHIND_CORNER: f64 = 1e-9;

impl Drive {
    /// Returns the first cycle after `from` and up to `until` at which d + κu_x or d − κu_x turns, where slip ends or
    /// begins. κ is the [stick ratio](crate::contact::material::Material::stick_ratio), and `yields` come from
    /// [`yields`](Self::yields).
    ///
    /// Corners of a waveform at which the rate of either changes sign, becomes zero or stops being zero count as
    /// turning points.
    pub fn turning_point(
        &self,
        stick_ratio: f64,
        yields: [f64; 2],
        from: f64,
        until: f64,
    ) -> Option<f64> {
        let normal = self.normal.oscillation();
        let tangential = self.tangential.as_ref()?.oscillation();
        let (down, along) = (
            yields[0] * normal.amplitude(),
            yields[1] * tangential.amplitude(),
        );
        let ratio = self.frequency_ratio();
        // Without friction nothing sticks; with very high friction, only the shift determines turning points.
        let (normal_weight, tangential_weight) = if stick_ratio > 1.0 {
            (down * ratio / stick_ratio, along)
        } else {
            (down * ratio, along * stick_ratio)
        };
        let rates = |cycles: f64| {
            let down = normal.rate(cycles * ratio);
            let along = tangential.rate(cycles);
            (normal_weight * down, tangential_weight * along)
        };
        let next_corner = |after: f64| {
            let of_normal = normal.next_corner(after * ratio).map(|turns| turns / ratio);
            let corners = [of_normal, tangential.next_corner(after)];
            let next = corners.into_iter().flatten().reduce(f64::min);
            next.filter(|&corner| corner <= until)
        };
        let turns_at = |corner: f64| {
            let behind = BEHIND_CORNER.max(8.0 * f64::EPSILON * corner);
            let (before, after) = (rates(corner - behind), rates(corner + behind));
            [1.0, -1.0].into_iter().any(|sign| {
                let (before, after) = (before.0 + sign * before.1, after.0 + sign * after.1);
                before * after <= 0.0 && before != after
            })
        };
        let mut start = from;
        loop {
            let corner = next_corner(start);
            let end = corner.unwrap_or(until);
            let smooth =
                Self::smooth_turn(rates, (normal_weight, tangential_weight), ratio, start, end);
            match corner {
                _ if smooth.is_some() => return smooth,
                None => return None,
                Some(corner) if turns_at(corner) => return Some(corner),
                Some(corner) => start = corner + BEHIND_CORNER.max(8.0 * f64::EPSILON * corner),
            }
        }
    }

    /// Returns the first turning point after `from` and up to `until`, if no waveform has a corner in between.
    fn smooth_turn(
        rates: impl Fn(f64) -> (f64, f64),
        (normal_weight, tangential_weight): (f64, f64),
        ratio: f64,
        from: f64,
        until: f64,
    ) -> Option<f64> {
        let rate = |sign: f64, cycles: f64| {
            let (down, along) = rates(cycles);
            down + sign * along
        };
        let steepest = TAU * (normal_weight * ratio + tangential_weight);
        let (down, along) = rates(0.5 * (from + until));
        [1.0, -1.0]
            .into_iter()
            .filter(|&sign| may_cross(down + sign * along, steepest, from, until))
            .filter_map(|sign| first_crossing(|cycles| rate(sign, cycles), ratio, from, until))
            .reduce(f64::min)
    }

    /// Returns the first cycle after `from` and up to `until` at which contact is made or lost: the normal force
    /// crosses zero, or the depth passes the lowest point of the profile, `tip` (m).
    pub fn touching_point(&self, tip: f64, from: f64, until: f64) -> Option<f64> {
        let threshold = match self.normal {
            Control::Displacement(_) => tip,
            Control::Force(_) => 0.0,
        };
        let normal = self.normal.oscillation();
        if normal.lowest() > threshold || normal.highest() < threshold {
            return None;
        }
        let ratio = self.frequency_ratio();
        let above = |cycles: f64| normal.after_turns(cycles * ratio) - threshold;
        let steepest = normal.greatest_speed() * self.period();
        may_cross(above(0.5 * (from + until)), steepest, from, until)
            .then(|| first_crossing(above, ratio, from, until))?
    }

    /// Returns g at the border of the permanent stick zone, m, if the motion of the springs is prescribed: a spring
    /// that shakes down never slips again. ½{min(d + κu_x) + min(d − κu_x)}; 0 or less means that everything slips in
    /// every cycle.
    ///
    /// E. Melan's theorem for springs with friction: J. R. Barber, A. Klarbring, M. Ciavarella (2008),
    /// Int. J. Solids Struct. 45, 4577–4596.
    pub fn shakedown_depth(&self, stick_ratio: f64) -> Option<f64> {
        let normal = self.depth_of_springs()?;
        let tangential = self.shift_of_springs()?;
        // The rig's share depends on its force, which wear changes.
        if self.has_rig() {
            return None;
        }
        if !stick_ratio.is_finite() {
            return Some(f64::NEG_INFINITY);
        }
        let Some(cycles) = self.repeats_after() else {
            return Some(normal.lowest() - stick_ratio * tangential.amplitude());
        };
        let value = |sign: f64, turns: f64| {
            normal.after_turns(turns * self.frequency_ratio())
                + sign * stick_ratio * tangential.after_turns(turns)
        };
        let lowest = |sign: f64| {
            let end = f64::from(cycles);
            let mut smallest = value(sign, 0.0);
            let mut from = 0.0;
            while let Some(turn) = self.turning_point(stick_ratio, [1.0; 2], from, end) {
                smallest = smallest.min(value(sign, turn));
                from = turn + 1e-6;
            }
            smallest
        };
        Some(0.5 * (lowest(1.0) + lowest(-1.0)))
    }
}

/// Whether a function with the value `middle` in the middle of a step may cross zero in it. In most steps it cannot, as
/// its steepest rate, per cycle, is too small to reach zero between the middle and an end.
fn may_cross(middle: f64, steepest: f64, from: f64, until: f64) -> bool {
    middle.abs() <= 1.001 * steepest * 0.5 * (until - from)
}

/// Returns where `function` first crosses zero after `from` and up to `until`, in cycles with `ratio` turns of the
/// normal motion each.
fn first_crossing(function: impl Fn(f64) -> f64, ratio: f64, from: f64, until: f64) -> Option<f64> {
    let pieces = (PIECES_OF_A_CYCLE * ratio.max(1.0) * (until - from)).ceil();
    let pieces = pieces.max(4.0);
    let mut low = (from, function(from));
    (1..=pieces as u32).find_map(|i| {
        let at = from + (until - from) * f64::from(i) / pieces;
        let high = (at, function(at));
        let low = std::mem::replace(&mut low, high);
        if high.1 == 0.0 && low.1 != 0.0 {
            return Some(at);
        }
        if low.1 * high.1 >= 0.0 {
            return None;
        }
        root::bracketed(&function, low.0, at, 4.0 * f64::EPSILON * at.abs())
    })
}

#[cfg(test)]
mod tests {
    use super::super::tests::drive;
    use super::super::{Oscillation, Prescribed};
    use super::*;

    #[test]
    fn turning_points_are_where_the_rates_vanish() {
        let drive = drive(1.0);
        let first = drive
            .turning_point(8.0, [1.0; 2], 0.0, 1.0)
            .expect("a turn");
        let value = |cycles: f64| {
            let targets = drive.targets(cycles);
            let (Prescribed::Displacement(d), Some(Prescribed::Displacement(u))) =
                (targets.normal, targets.tangential)
            else {
                panic!("displacements")
            };
            [d + 8.0 * u, d - 8.0 * u]
        };
        let h = 1e-6;
        let (left, here, right) = (value(first - h), value(first), value(first + h));
        assert!((0..2).any(|i| (here[i] - left[i]) * (right[i] - here[i]) <= 0.0));
        let mut from = 0.0;
        let mut turns = 0;
        while let Some(turn) = drive.turning_point(8.0, [1.0; 2], from, 1.0) {
            (from, turns) = (turn + 1e-6, turns + 1);
        }
        assert_eq!(turns, 4);
    }

    /// F_z = 1 + 2 sin and d = 1 + 2 sin lose contact where the sine is −1/2.
    #[test]
    fn contact_is_made_and_lost_where_nothing_presses() {
        let motion = Oscillation::new(1.0, 2.0, 5.0, 0.0).expect("a motion");
        for control in [
            Control::Force(motion.clone()),
            Control::Displacement(motion.clone()),
        ] {
            let drive = Drive::new(control, None);
            let lost = drive
                .touching_point(0.0, 0.0, 1.0)
                .expect("contact is lost");
            assert!((lost - 7.0 / 12.0).abs() < 1e-12, "{lost}");
            let made = drive
                .touching_point(0.0, lost + 1e-9, 1.0)
                .expect("made again");
            assert!((made - 11.0 / 12.0).abs() < 1e-12, "{made}");
            assert_eq!(drive.touching_point(0.0, made + 1e-9, 1.0), None);
        }
        // A worn tip touches later.
        let drive = Drive::new(Control::Displacement(motion), None);
        let lost = drive
            .touching_point(1.0, 0.1, 0.9)
            .expect("contact is lost");
        assert!((lost - 0.5).abs() < 1e-12, "{lost}");
        assert_eq!(drive.touching_point(-1.5, 0.0, 1.0), None);
    }

    #[test]
    fn the_shakedown_depth_of_equal_frequencies_is_the_closed_form() {
        // Physics of the dual oscillation: d₀ − ½[√(Δd²+κ²Δu²+2κΔdΔu cos φ) + √(… − …)].
        let (dd, ku, phi) = (1e-7f64, 8.0 * 1e-7, 0.5f64);
        let branch = |sign: f64| (dd * dd + ku * ku + sign * 2.0 * ku * dd * phi.cos()).sqrt();
        let expected = 1e-6 - 0.5 * (branch(1.0) + branch(-1.0));
        let depth = drive(1.0).shakedown_depth(8.0).expect("a depth");
        assert!((depth / expected - 1.0).abs() < 1e-9, "{depth} {expected}");
        // Incommensurate: d₀ − Δd − κΔu.
        let depth = drive(2f64.sqrt()).shakedown_depth(8.0).expect("a depth");
        assert!((depth - (1e-6 - 1e-7 - 8e-7)).abs() < 1e-18);
    }
}

//! The motion of the indenter, Eq. (14) of the paper: here time appears first.
//!
//! Time is counted in *cycles*: one period of the tangential motion, or of the normal motion where
//! there is no tangential one.

use std::f64::consts::TAU;

use crate::math::invalid::{Invalid, finite, non_negative, positive};

/// The most cycles that are looked through for a common period of both directions.
pub const LONGEST_REPEAT: u32 = 20;

/// Into how many pieces a cycle is cut where turning points are looked for.
const PIECES_OF_A_CYCLE: f64 = 64.0;

/// mean + amplitude · sin(ωt + φ), of a displacement in m or of a force in N.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Oscillation {
    mean: f64,
    amplitude: f64,
    angular_frequency: f64,
    phase: f64,
}

impl Oscillation {
    /// With an amplitude of 0 or more, ω greater than 0 in rad/s and φ in rad.
    pub fn new(
        mean: f64,
        amplitude: f64,
        angular_frequency: f64,
        phase: f64,
    ) -> Result<Self, Invalid> {
        Ok(Self {
            mean: finite("mean", mean)?,
            amplitude: non_negative("amplitude", amplitude)?,
            angular_frequency: positive("angular_frequency", angular_frequency)?,
            phase: finite("phase", phase)?,
        })
    }

    /// The value around which the motion swings.
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// Half the way from the lowest to the highest value.
    pub fn amplitude(&self) -> f64 {
        self.amplitude
    }

    /// ω, rad/s.
    pub fn angular_frequency(&self) -> f64 {
        self.angular_frequency
    }

    /// φ, rad.
    pub fn phase(&self) -> f64 {
        self.phase
    }

    /// The highest value.
    pub fn highest(&self) -> f64 {
        self.mean + self.amplitude
    }

    /// The lowest value.
    pub fn lowest(&self) -> f64 {
        self.mean - self.amplitude
    }

    /// The value after `turns` of this oscillation. Only the fraction of a turn is given to the
    /// sine, so that the millionth turn is like the first.
    fn after_turns(&self, turns: f64) -> f64 {
        self.mean + self.amplitude * (TAU * turns.fract() + self.phase).sin()
    }
}

/// How one direction is driven.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Control {
    /// The displacement of the indenter, m, is prescribed.
    Displacement(Oscillation),
    /// The force on the indenter, N, is prescribed.
    Force(Oscillation),
}

impl Control {
    /// The oscillation of whatever is prescribed.
    pub fn oscillation(&self) -> &Oscillation {
        match self {
            Self::Displacement(oscillation) | Self::Force(oscillation) => oscillation,
        }
    }
}

/// A prescribed value at one moment: displacement in m or force in N.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Target {
    /// m.
    Displacement(f64),
    /// N.
    Force(f64),
}

/// Both directions of the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drive {
    normal: Control,
    tangential: Option<Control>,
}

impl Drive {
    /// The normal motion, and the tangential one where there is one.
    pub fn new(normal: Control, tangential: Option<Control>) -> Self {
        Self { normal, tangential }
    }

    /// The normal motion.
    pub fn normal(&self) -> &Control {
        &self.normal
    }

    /// The tangential motion; without it there are no tangential springs, no slip and no wear.
    pub fn tangential(&self) -> Option<&Control> {
        self.tangential.as_ref()
    }

    /// The length of one cycle, s.
    pub fn period(&self) -> f64 {
        TAU / self.leading().angular_frequency
    }

    fn leading(&self) -> &Oscillation {
        self.tangential
            .as_ref()
            .unwrap_or(&self.normal)
            .oscillation()
    }

    /// ω₁/ω₂: turns of the normal motion in one cycle.
    pub fn frequency_ratio(&self) -> f64 {
        self.normal.oscillation().angular_frequency / self.leading().angular_frequency
    }

    /// After how many cycles the motion of both directions repeats, where it does within
    /// [`LONGEST_REPEAT`]; none for incommensurate frequencies. A direction that stands still always repeats.
    pub fn repeats_after(&self) -> Option<u32> {
        if self.normal.oscillation().amplitude == 0.0 {
            return Some(1);
        }
        let ratio = self.frequency_ratio();
        (1..=LONGEST_REPEAT).find(|&cycles| {
            let turns = f64::from(cycles) * ratio;
            turns.round() > 0.0 && (turns - turns.round()).abs() < 1e-9 * turns
        })
    }

    /// The first cycle after `from` and up to `until` at which d + κu_x or d − κu_x turns, where both
    /// displacements are prescribed: there slip ends or begins. κ is the [stick
    /// ratio](crate::contact::material::Material::stick_ratio).
    pub fn turning_point(&self, stick_ratio: f64, from: f64, until: f64) -> Option<f64> {
        let (Control::Displacement(normal), Some(Control::Displacement(tangential))) =
            (&self.normal, &self.tangential)
        else {
            return None;
        };
        let ratio = self.frequency_ratio();
        // Without friction nothing sticks; with very much, the shift alone turns things.
        let (normal_weight, tangential_weight) = if stick_ratio > 1.0 {
            (normal.amplitude * ratio / stick_ratio, tangential.amplitude)
        } else {
            (normal.amplitude * ratio, tangential.amplitude * stick_ratio)
        };
        let rates = |cycles: f64| {
            let down = (TAU * (cycles * ratio).fract() + normal.phase).cos();
            let along = (TAU * cycles.fract() + tangential.phase).cos();
            (normal_weight * down, tangential_weight * along)
        };
        let rate = |sign: f64, cycles: f64| {
            let (down, along) = rates(cycles);
            down + sign * along
        };
        // Most steps lie so far from every turn that the steepest rate does not reach zero within them.
        let steepest = TAU * (normal_weight * ratio + tangential_weight);
        let reach = 1.001 * steepest * (until - from);
        let pieces = (PIECES_OF_A_CYCLE * ratio.max(1.0) * (until - from))
            .ceil()
            .max(4.0);
        let (down, along) = rates(from);
        [1.0, -1.0]
            .into_iter()
            .filter(|&sign| (down + sign * along).abs() <= reach)
            .filter_map(|sign| {
                let at = |i: u32| from + (until - from) * f64::from(i) / pieces;
                let mut low = (at(0), rate(sign, at(0)));
                (1..=pieces as u32).find_map(|i| {
                    let high = (at(i), rate(sign, at(i)));
                    let low = std::mem::replace(&mut low, high);
                    sign_change(|cycles| rate(sign, cycles), low, high)
                })
            })
            .reduce(f64::min)
    }

    /// g at the border of the permanent stick zone, m, where both displacements are prescribed: a
    /// spring that shakes down never slips again. ½{min(d + κu_x) + min(d − κu_x)}; 0 or less means
    /// that everything slips in every cycle.
    ///
    /// E. Melan's theorem for springs with friction: J. R. Barber, A. Klarbring, M. Ciavarella (2008),
    /// Int. J. Solids Struct. 45, 4577–4596.
    pub fn shakedown_depth(&self, stick_ratio: f64) -> Option<f64> {
        let (Control::Displacement(normal), Some(Control::Displacement(tangential))) =
            (&self.normal, &self.tangential)
        else {
            return None;
        };
        if !stick_ratio.is_finite() {
            return Some(f64::NEG_INFINITY);
        }
        let Some(cycles) = self.repeats_after() else {
            return Some(normal.lowest() - stick_ratio * tangential.amplitude);
        };
        let value = |sign: f64, turns: f64| {
            normal.after_turns(turns * self.frequency_ratio())
                + sign * stick_ratio * tangential.after_turns(turns)
        };
        let lowest = |sign: f64| {
            let end = f64::from(cycles);
            let mut smallest = value(sign, 0.0);
            let mut from = 0.0;
            while let Some(turn) = self.turning_point(stick_ratio, from, end) {
                smallest = smallest.min(value(sign, turn));
                from = turn + 1e-6;
            }
            smallest
        };
        Some(0.5 * (lowest(1.0) + lowest(-1.0)))
    }

    /// What the normal direction is asked for after `cycles`.
    pub fn normal_at(&self, cycles: f64) -> Target {
        at(&self.normal, cycles * self.frequency_ratio())
    }

    /// What the tangential direction is asked for after `cycles`.
    pub fn tangential_at(&self, cycles: f64) -> Option<Target> {
        self.tangential.as_ref().map(|control| at(control, cycles))
    }
}

/// Where `function` crosses zero between two points given with their values, the second included.
fn sign_change(
    function: impl Fn(f64) -> f64,
    (mut low, at_low): (f64, f64),
    (mut high, at_high): (f64, f64),
) -> Option<f64> {
    if at_high == 0.0 && at_low != 0.0 {
        return Some(high);
    }
    if at_low * at_high >= 0.0 {
        return None;
    }
    loop {
        let middle = 0.5 * (low + high);
        // No number lies between the two.
        if middle == low || middle == high {
            return Some(high);
        }
        if function(middle) * at_low > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
}

fn at(control: &Control, turns: f64) -> Target {
    match control {
        Control::Displacement(oscillation) => Target::Displacement(oscillation.after_turns(turns)),
        Control::Force(oscillation) => Target::Force(oscillation.after_turns(turns)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drive(ratio: f64) -> Drive {
        let normal = Oscillation::new(1e-6, 1e-7, 100.0 * ratio, 0.0).expect("a motion");
        let tangential = Oscillation::new(0.0, 1e-7, 100.0, 0.5).expect("a motion");
        Drive::new(
            Control::Displacement(normal),
            Some(Control::Displacement(tangential)),
        )
    }

    #[test]
    fn the_values_are_those_of_eq_14() {
        let drive = drive(2.0);
        let cycles = 3.3;
        let time = cycles * drive.period();
        let expected = 1e-6 + 1e-7 * (200.0 * time).sin();
        let Target::Displacement(depth) = drive.normal_at(cycles) else {
            panic!("a displacement")
        };
        assert!((depth - expected).abs() < 1e-20);
        let expected = 1e-7 * (100.0 * time + 0.5).sin();
        let Some(Target::Displacement(shift)) = drive.tangential_at(cycles) else {
            panic!("a displacement")
        };
        assert!((shift - expected).abs() < 1e-20);
    }

    #[test]
    fn the_ten_millionth_cycle_is_like_the_first() {
        let drive = drive(1.0);
        assert_eq!(
            drive.tangential_at(0.25),
            drive.tangential_at(10_000_000.25)
        );
    }

    #[test]
    fn turning_points_are_where_the_rates_vanish() {
        let drive = drive(1.0);
        let first = drive.turning_point(8.0, 0.0, 1.0).expect("a turn");
        let value = |cycles: f64| {
            let (Target::Displacement(d), Some(Target::Displacement(u))) =
                (drive.normal_at(cycles), drive.tangential_at(cycles))
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
        while let Some(turn) = drive.turning_point(8.0, from, 1.0) {
            (from, turns) = (turn + 1e-6, turns + 1);
        }
        assert_eq!(turns, 4);
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

    #[test]
    fn common_periods_are_found() {
        for (ratio, cycles) in [
            (1.0, Some(1)),
            (2.0, Some(1)),
            (0.5, Some(2)),
            (1.5, Some(2)),
            (2f64.sqrt(), None),
        ] {
            assert_eq!(drive(ratio).repeats_after(), cycles, "{ratio}");
        }
    }

    #[test]
    fn without_tangential_motion_the_normal_one_sets_the_cycle() {
        let normal = Oscillation::new(1e-6, 0.0, 10.0, 0.0).expect("a motion");
        let drive = Drive::new(Control::Displacement(normal), None);
        assert_eq!(drive.period(), TAU / 10.0);
        assert_eq!(drive.tangential_at(1.0), None);
    }

    #[test]
    fn impossible_motions_are_refused() {
        assert!(Oscillation::new(f64::NAN, 0.0, 1.0, 0.0).is_err());
        assert!(Oscillation::new(0.0, -1.0, 1.0, 0.0).is_err());
        assert!(Oscillation::new(0.0, 1.0, 0.0, 0.0).is_err());
    }
}

//! The motion of the indenter, Eq. (14) of the paper: the lowest layer that knows time.
//!
//! Time is counted in *cycles*: periods of the tangential motion, or of the normal motion if there
//! is no tangential one.

use std::f64::consts::{FRAC_2_PI, TAU};

use crate::contact::material::Material;
use crate::math::geometry::Geometry;
use crate::math::invalid::{Invalid, positive};

mod oscillation;
mod turning;

pub use oscillation::{Oscillation, SpringMotion};

/// The most cycles, and where they are more than `FEW_CYCLES` the most turns of the normal motion, of a common
/// period of both directions.
pub const LONGEST_REPEAT: u32 = 1000;

/// So few cycles may hold any number of turns.
const FEW_CYCLES: u32 = 20;

/// Cycles after which a motion without a common period has come close to everything that it does.
const WITHOUT_REPEAT: u32 = 20;

/// Pieces of Simpson's rule for the mean of a power of the rate in a step.
const PIECES_OF_A_STEP: u32 = 16;

/// How one direction is driven.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Control<T = Oscillation> {
    /// The displacement of the indenter, m, is prescribed.
    Displacement(T),
    /// The force on the indenter, N, is prescribed.
    Force(T),
}

impl Plane {
    /// That of a strip of the half-width a (m) that sticks, N/m.
    fn stiffness(self, half_width: f64) -> f64 {
        let logarithm = (2.0 * self.gauge / half_width).ln();
        (FRAC_2_PI * self.compliance * logarithm).recip()
    }
}

/// A prescribed value at one moment.
pub type Target = Control<f64>;

/// What both directions are asked for at one moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Targets {
    /// The normal direction.
    pub normal: Target,
    /// The tangential one, where it moves.
    pub tangential: Option<Target>,
}

impl Control {
    /// The oscillation of whatever is prescribed.
    pub fn oscillation(&self) -> &Oscillation {
        match self {
            Self::Displacement(oscillation) | Self::Force(oscillation) => oscillation,
        }
    }

    /// That of a displacement; none of a force.
    pub fn displacement(&self) -> Option<&Oscillation> {
        match self {
            Self::Displacement(oscillation) => Some(oscillation),
            Self::Force(_) => None,
        }
    }

    /// The prescribed displacement or force after this many turns of the oscillation.
    fn at(&self, turns: f64) -> Target {
        let value = self.oscillation().after_turns(turns);
        match self {
            Self::Displacement(_) => Target::Displacement(value),
            Self::Force(_) => Target::Force(value),
        }
    }
}

/// Both directions of the motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Drive {
    normal: Control,
    tangential: Option<Control>,
    /// Of the rig between actuator and contact, m/N; 0 for a stiff one.
    compliance: f64,
    /// Of a line contact.
    plane: Option<Plane>,
}

/// What forces and displacements are to a line contact.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Plane {
    /// 1/(E*L): how far a force moves the springs, m/N.
    compliance: f64,
    /// How deep the point lies that displacements are told against, m.
    gauge: f64,
}

impl Drive {
    /// The normal motion, and the tangential one where there is one, on a stiff rig.
    pub fn new(normal: Control, tangential: Option<Control>) -> Self {
        Self {
            normal,
            tangential,
            compliance: 0.0,
            plane: None,
        }
    }

    /// The same on a contact of this `geometry` and `material`. In the plane the displacement of one body is told against
    /// a point of the other, `gauge` (m) deep: against infinity there is none.
    #[must_use]
    pub fn on(self, geometry: Geometry, material: &Material, gauge: f64) -> Self {
        let plane = geometry.length().map(|length| Plane {
            compliance: (material.normal_modulus() * length).recip(),
            gauge,
        });
        Self { plane, ..self }
    }

    /// How deep the point lies that the displacements of a line contact are told against, m.
    pub fn gauge_length(&self) -> Option<f64> {
        self.plane.map(|plane| plane.gauge)
    }

    /// The motion of the springs in the normal direction, where it is prescribed.
    pub fn depth_of_springs(&self) -> Option<SpringMotion<'_>> {
        self.of_springs(&self.normal)
    }

    /// The motion of the springs in the tangential direction, where it is prescribed.
    pub fn shift_of_springs(&self) -> Option<SpringMotion<'_>> {
        self.of_springs(self.tangential.as_ref()?)
    }

    fn of_springs<'a>(&self, control: &'a Control) -> Option<SpringMotion<'a>> {
        let (of, yields) = match (control, self.plane) {
            (Control::Displacement(of), None) => (of, 1.0),
            (Control::Force(of), Some(plane)) => (of, plane.compliance),
            _ => return None,
        };
        Some(SpringMotion { of, yields })
    }

    /// Whether a rig lies between what is prescribed and the contact.
    pub fn has_rig(&self) -> bool {
        self.compliance > 0.0 && !matches!(self.tangential, Some(Control::Force(_)))
    }

    /// The same with a rig of the tangential `stiffness` (N/m) in series with the contact: a prescribed
    /// displacement is that of the actuator, U, and the contact gets u = U − F_x/stiffness.
    pub fn with_rig(self, stiffness: f64) -> Result<Self, Invalid> {
        let compliance = positive("rig_stiffness", stiffness)?.recip();
        Ok(Self { compliance, ..self })
    }

    /// The tangential compliance of the rig, m/N; 0 if it is stiff.
    pub fn rig_compliance(&self) -> f64 {
        self.compliance
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
        TAU / self.leading().angular_frequency()
    }

    fn leading(&self) -> &Oscillation {
        self.tangential
            .as_ref()
            .unwrap_or(&self.normal)
            .oscillation()
    }

    /// ω₁/ω₂: turns of the normal motion in one cycle.
    pub fn frequency_ratio(&self) -> f64 {
        self.normal.oscillation().angular_frequency() / self.leading().angular_frequency()
    }

    /// After how many cycles the motion of both directions repeats, where it does within
    /// [`LONGEST_REPEAT`]; none for incommensurate frequencies. A direction that stands still always repeats.
    pub fn repeats_after(&self) -> Option<u32> {
        if self.normal.oscillation().amplitude() == 0.0 {
            return Some(1);
        }
        let ratio = self.frequency_ratio();
        (1..=LONGEST_REPEAT).find(|&cycles| {
            let turns = f64::from(cycles) * ratio;
            let fits = cycles <= FEW_CYCLES || turns < f64::from(LONGEST_REPEAT) + 0.5;
            fits && turns.round() > 0.0 && (turns - turns.round()).abs() < 1e-9 * turns
        })
    }

    /// Cycles after which the permanent stick radius is read anew: the common period of the motion.
    pub fn cycles_to_settle(&self) -> u32 {
        self.repeats_after().unwrap_or(WITHOUT_REPEAT)
    }

    /// How many times faster than the cycle the faster of the two motions is, rounded up; 1 where that is the
    /// tangential one, or where the normal direction stands still.
    pub fn turns_of_the_faster(&self) -> u32 {
        if self.normal.oscillation().amplitude() == 0.0 {
            return 1;
        }
        // A ratio that is whole but for rounding is whole.
        (self.frequency_ratio() * (1.0 - 1e-9)).ceil().max(1.0) as u32
    }

    /// What an amplitude of each direction is in displacement, m per m or m per N: a force moves a contact of the
    /// radius a by 1/(2E*a) and 1/(2G*a), the springs of a line by 1/(E*L) both, and a rig of the compliance C leaves it 1/(1 + 2G*aC) of its actuator's
    /// motion, as long as nothing slips; where the motion turns, nothing does.
    pub fn yields(&self, material: &Material, contact_radius: f64) -> [f64; 2] {
        let stiffness = |modulus: f64| 2.0 * modulus * contact_radius;
        let yields = |control: Option<&Control>, modulus: f64, compliance: f64| match control {
            Some(Control::Force(_)) => stiffness(modulus).recip(),
            _ => (1.0 + stiffness(modulus) * compliance).recip(),
        };
        let (tangential, modulus) = (self.tangential.as_ref(), material.tangential_modulus());
        let yields = match self.plane {
            None => [
                yields(Some(&self.normal), material.normal_modulus(), 0.0),
                yields(tangential, modulus, self.compliance),
            ],
            Some(plane) => {
                let own = plane.stiffness(contact_radius).recip();
                let of_tangential = match tangential {
                    Some(Control::Displacement(_)) => plane.compliance / (own + self.compliance),
                    _ => plane.compliance,
                };
                [plane.compliance, of_tangential]
            }
        };
        if yields.iter().all(|yields| yields.is_finite()) {
            return yields;
        }
        // Out of contact nothing turns that matters.
        [1.0; 2]
    }

    /// The tangential stiffness, N/m, of a contact of the radius or half-width a (m) that sticks: 2G*a, or in the plane,
    /// against the gauge, that of a punch, (π/2)E*L/ln(2ℓ/a).
    pub fn stiffness(&self, material: &Material, contact_radius: f64) -> f64 {
        match self.plane {
            None => 2.0 * material.tangential_modulus() * contact_radius,
            Some(plane) => plane.stiffness(contact_radius),
        }
    }

    /// The mean of |u̇_x|ⁿ between two cycles over the n-th power of the mean rate: by how much a law with the n-th
    /// power of the slip rate wears more in a step whose rate changes. 1 where the tangential motion is not
    /// prescribed as a displacement, or turns in between.
    pub fn unevenness(&self, exponent: f64, from: f64, until: f64) -> f64 {
        let Some(shift) = self.shift_of_springs() else {
            return 1.0;
        };
        let rate = |i: u32| {
            let share = f64::from(i) / f64::from(PIECES_OF_A_STEP);
            shift.rate(from + (until - from) * share)
        };
        let (mut power, mut mean) = (0.0, 0.0);
        let mut signs = [false; 2];
        for i in 0..=PIECES_OF_A_STEP {
            let weight = match i {
                0 | PIECES_OF_A_STEP => 1.0,
                _ if i % 2 == 1 => 4.0,
                _ => 2.0,
            };
            let rate = rate(i);
            // An end of the step that is a turning point but for rounding has no sign.
            signs[usize::from(rate < 0.0)] |= rate.abs() > 1e-6;
            power += weight * rate.abs().powf(exponent);
            mean += weight * rate.abs();
        }
        let whole = 3.0 * f64::from(PIECES_OF_A_STEP);
        let unevenness = power / whole / (mean / whole).powf(exponent);
        if signs == [true; 2] || !unevenness.is_finite() {
            return 1.0;
        }
        unevenness
    }

    /// What both directions are asked for after `cycles`.
    pub fn targets(&self, cycles: f64) -> Targets {
        let tangential = self.tangential.as_ref();
        Targets {
            normal: self.normal.at(cycles * self.frequency_ratio()),
            tangential: tangential.map(|control| control.at(cycles)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two displacements, the normal one `ratio` times faster.
    pub(super) fn drive(ratio: f64) -> Drive {
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
        let Target::Displacement(depth) = drive.targets(cycles).normal else {
            panic!("a displacement")
        };
        assert!((depth - expected).abs() < 1e-20);
        let expected = 1e-7 * (100.0 * time + 0.5).sin();
        let Some(Target::Displacement(shift)) = drive.targets(cycles).tangential else {
            panic!("a displacement")
        };
        assert!((shift - expected).abs() < 1e-20);
    }

    #[test]
    fn the_ten_millionth_cycle_is_like_the_first() {
        let drive = drive(1.0);
        assert_eq!(
            drive.targets(0.25).tangential,
            drive.targets(10_000_000.25).tangential
        );
    }

    /// F_z = 1 + 2 sin and d = 1 + 2 sin lose contact where the sine is −1/2.
    /// The mean of cosⁿ over a quarter of a turn, over (2/π)ⁿ.
    #[test]
    fn a_rate_that_changes_wears_by_the_mean_of_its_power() {
        let motion = |phase| Oscillation::new(0.0, 1.0, 1.0, phase).expect("a motion");
        let still = Control::Displacement(Oscillation::new(1.0, 0.0, 1.0, 0.0).expect("a motion"));
        let of = |phase| Drive::new(still.clone(), Some(Control::Displacement(motion(phase))));
        let quarter = of(0.0).unevenness(2.0, 0.0, 0.25);
        let expected = 0.5 * (std::f64::consts::PI / 2.0).powi(2);
        assert!(
            (quarter / expected - 1.0).abs() < 1e-5,
            "{quarter} {expected}"
        );
        assert!((of(0.3).unevenness(1.0, 0.1, 0.13) - 1.0).abs() < 1e-14);
        // From the turning point on the rate grows like t: the mean of tⁿ is 1/(n+1), over 2⁻ⁿ.
        let short = of(0.0).unevenness(0.7, 0.25, 0.251);
        assert!(
            (short / (2f64.powf(0.7) / 1.7) - 1.0).abs() < 2e-3,
            "{short}"
        );
        assert_eq!(of(0.0).unevenness(0.7, 0.2, 0.3), 1.0);
    }

    /// A rig as stiff as the sticking contact leaves it half of the motion; a force knows of no rig.
    #[test]
    fn a_rig_leaves_a_part_of_the_motion_to_what_sticks() {
        let material = Material::new(2.0, 0.0, 0.1).expect("a material");
        let stiffness = 2.0 * material.tangential_modulus() * 3.0;
        let swing = Oscillation::new(0.0, 1.0, 1.0, 0.0).expect("a motion");
        let on_rig = |tangential: Control| {
            let drive = Drive::new(Control::Displacement(swing.clone()), Some(tangential));
            drive
                .with_rig(stiffness)
                .expect("a rig")
                .yields(&material, 3.0)
        };
        assert_eq!(on_rig(Control::Displacement(swing.clone())), [1.0, 0.5]);
        assert_eq!(
            on_rig(Control::Force(swing.clone())),
            [1.0, stiffness.recip()]
        );
        let stiff = Drive::new(
            Control::Displacement(swing.clone()),
            Some(Control::Displacement(swing.clone())),
        );
        assert_eq!(stiff.yields(&material, 3.0), [1.0; 2]);
    }

    #[test]
    fn common_periods_are_found() {
        for (ratio, cycles) in [
            (1.0, Some(1)),
            (2.0, Some(1)),
            (0.5, Some(2)),
            (1.5, Some(2)),
            (0.02, Some(50)),
            (0.001, Some(1000)),
            (999.0 / 1000.0, Some(1000)),
            (617.5, Some(2)),
            (2f64.sqrt(), None),
            (std::f64::consts::PI, None),
        ] {
            assert_eq!(drive(ratio).repeats_after(), cycles, "{ratio}");
        }
    }

    #[test]
    fn without_tangential_motion_the_normal_one_sets_the_cycle() {
        let normal = Oscillation::new(1e-6, 0.0, 10.0, 0.0).expect("a motion");
        let drive = Drive::new(Control::Displacement(normal), None);
        assert_eq!(drive.period(), TAU / 10.0);
        assert_eq!(drive.targets(1.0).tangential, None);
    }
}

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

/// Maximum number of cycles, and beyond `FEW_CYCLES` also of turns
/// of the normal motion, in a common period of both directions.
pub const LONGEST_REPEAT: u32 = 1000;

/// Up to this many cycles may hold any number of turns.
const FEW_CYCLES: u32 = 20;

/// Cycles within which a motion without a common period comes close to everything it does.
const WITHOUT_REPEAT: u32 = 20;

/// Pieces of Simpson's rule for the mean power of the rate in a step.
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
    /// Returns the stiffness of a sticking strip of half-width a (m), N/m.
    fn stiffness(self, half_width: f64) -> f64 {
        let logarithm = (2.0 * self.gauge / half_width).ln();
        (FRAC_2_PI * self.compliance * logarithm).recip()
    }
}

/// A prescribed value at one moment.
pub type Prescribed = Control<f64>;

/// The targets of both directions at one moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Targets {
    /// The normal direction.
    pub normal: Prescribed,
    /// The tangential direction, if it moves.
    pub tangential: Option<Prescribed>,
}

impl Control {
    /// Returns the prescribed oscillation, of a displacement or a force.
    pub fn oscillation(&self) -> &Oscillation {
        match self {
            Self::Displacement(oscillation) | Self::Force(oscillation) => oscillation,
        }
    }

    /// Returns the prescribed displacement; `None` for a force.
    pub fn displacement(&self) -> Option<&Oscillation> {
        match self {
            Self::Displacement(oscillation) => Some(oscillation),
            Self::Force(_) => None,
        }
    }

    /// The prescribed displacement or force after this many turns of the oscillation.
    fn at(&self, turns: f64) -> Prescribed {
        let value = self.oscillation().after_turns(turns);
        match self {
            Self::Displacement(_) => Prescribed::Displacement(value),
            Self::Force(_) => Prescribed::Force(value),
        }
    }
}

/// Both directions of the motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Drive {
    normal: Control,
    tangential: Option<Control>,
    /// Compliance of the rig between actuator and contact, m/N; 0 for a stiff one.
    compliance: f64,
    /// Properties of a line contact.
    plane: Option<Plane>,
}

/// How forces and displacements act on a line contact.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Plane {
    /// 1/(E*L): how far a force moves the springs, m/N.
    compliance: f64,
    /// Depth of the reference point for displacements, m.
    gauge: f64,
}

impl Drive {
    /// Combines the normal motion and the tangential one, if any, on a stiff rig.
    pub fn new(normal: Control, tangential: Option<Control>) -> Self {
        Self {
            normal,
            tangential,
            compliance: 0.0,
            plane: None,
        }
    }

    /// Returns the same drive on a contact of this `geometry` and `material`. In plane strain the displacement of one
    /// body is measured against a point of the other, `gauge` (m) deep: against infinity it does not exist.
    #[must_use]
    pub fn in_geometry(self, geometry: Geometry, material: &Material, gauge: f64) -> Self {
        let plane = geometry.length().map(|length| Plane {
            compliance: (material.normal_modulus() * length).recip(),
            gauge,
        });
        Self { plane, ..self }
    }

    /// Returns the depth of the reference point for displacements of a line contact, m.
    pub fn gauge_length(&self) -> Option<f64> {
        self.plane.map(|plane| plane.gauge)
    }

    /// Returns the motion of the springs in the normal direction, if it is prescribed.
    pub fn depth_of_springs(&self) -> Option<SpringMotion<'_>> {
        self.of_springs(&self.normal)
    }

    /// Returns the motion of the springs in the tangential direction, if it is prescribed.
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

    /// Whether a rig lies between the prescribed motion and the contact.
    pub fn has_rig(&self) -> bool {
        self.compliance > 0.0 && !matches!(self.tangential, Some(Control::Force(_)))
    }

    /// Returns the same drive with a rig of tangential `stiffness` (N/m) in series with the contact: a prescribed
    /// displacement is the actuator's, U, and the contact gets u = U − F_x/stiffness.
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

    /// Returns the tangential motion; without it there are no tangential springs, no slip and no wear.
    pub fn tangential(&self) -> Option<&Control> {
        self.tangential.as_ref()
    }

    /// Returns the length of one cycle, s.
    pub fn period(&self) -> f64 {
        TAU / self.leading().angular_frequency()
    }

    fn leading(&self) -> &Oscillation {
        self.tangential
            .as_ref()
            .unwrap_or(&self.normal)
            .oscillation()
    }

    /// Returns ω₁/ω₂: turns of the normal motion in one cycle.
    pub fn frequency_ratio(&self) -> f64 {
        self.normal.oscillation().angular_frequency() / self.leading().angular_frequency()
    }

    /// Returns the number of cycles after which the motion of both directions repeats, if at most [`LONGEST_REPEAT`];
    /// `None` for incommensurate frequencies. A direction at rest always repeats.
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

    /// Returns the cycles after which the permanent stick radius is read again: the common period of the motion.
    pub fn cycles_to_settle(&self) -> u32 {
        self.repeats_after().unwrap_or(WITHOUT_REPEAT)
    }

    /// Returns how many times faster than the cycle the faster of the two motions is, rounded up; 1 if that is the
    /// tangential one, or if the normal direction is at rest.
    pub fn turns_of_the_faster(&self) -> u32 {
        if self.normal.oscillation().amplitude() == 0.0 {
            return 1;
        }
        // A ratio that is whole except for rounding is whole.
        (self.frequency_ratio() * (1.0 - 1e-9)).ceil().max(1.0) as u32
    }

    /// Returns the displacement per amplitude of each direction, m per m or m per N. A force
    /// moves a contact of radius a by 1/(2E*a) and 1/(2G*a), the springs of a line contact
    /// by 1/(E*L) in both directions. A rig of compliance C leaves the contact 1/(1 + 2G*aC)
    /// of its actuator's motion while nothing slips, which holds where the motion turns.
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
        // Without contact, turning points do not matter.
        [1.0; 2]
    }

    /// Returns the tangential stiffness, N/m, of a sticking contact of radius or half-width a (m): 2G*a, or in plane
    /// strain, against the gauge, the stiffness of a punch, (π/2)E*L/ln(2ℓ/a).
    pub fn stiffness(&self, material: &Material, contact_radius: f64) -> f64 {
        match self.plane {
            None => 2.0 * material.tangential_modulus() * contact_radius,
            Some(plane) => plane.stiffness(contact_radius),
        }
    }

    /// Returns the mean of |u̇_x|ⁿ between two cycles divided by the n-th power of the mean rate: the factor on the
    /// wear by the n-th power of the slip rate in a step whose rate changes. 1 unless the tangential motion is a
    /// prescribed displacement that does not turn in between.
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
            // An end of the step that is a turning point except for rounding has no sign.
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

    /// Returns the targets of both directions after `cycles`.
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
        let Prescribed::Displacement(depth) = drive.targets(cycles).normal else {
            panic!("a displacement")
        };
        assert!((depth - expected).abs() < 1e-20);
        let expected = 1e-7 * (100.0 * time + 0.5).sin();
        let Some(Prescribed::Displacement(shift)) = drive.targets(cycles).tangential else {
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

    /// The mean of cosⁿ over a quarter of a turn, divided by (2/π)ⁿ.
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
        // From the turning point on the rate grows like t: the mean of tⁿ is 1/(n+1), divided by 2⁻ⁿ.
        let short = of(0.0).unevenness(0.7, 0.25, 0.251);
        assert!(
            (short / (2f64.powf(0.7) / 1.7) - 1.0).abs() < 2e-3,
            "{short}"
        );
        assert_eq!(of(0.0).unevenness(0.7, 0.2, 0.3), 1.0);
    }

    /// A rig as stiff as the sticking contact leaves it half of the motion; a prescribed force ignores the rig.
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

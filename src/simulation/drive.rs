//! The motion of the indenter, Eq. (14) of the paper: the lowest layer that knows time.
//!
//! Time is counted in *cycles*: periods of the tangential motion, or of the normal motion if there
//! is no tangential one.

use std::f64::consts::TAU;

use super::waveform::Waveform;
use crate::contact::material::Material;
use crate::math::invalid::{Invalid, finite, non_negative, positive};
use crate::math::root;

/// The most cycles, and where they are more than [`FEW_CYCLES`] the most turns of the normal motion, of a common
/// period of both directions.
pub const LONGEST_REPEAT: u32 = 1000;

/// So few cycles may hold any number of turns.
const FEW_CYCLES: u32 = 20;

/// Cycles after which a motion without a common period has come close to everything that it does.
pub const WITHOUT_REPEAT: u32 = 20;

/// Pieces of Simpson's rule for the mean of a power of the rate in a step.
const PIECES_OF_A_STEP: u32 = 16;

/// Into how many pieces a cycle is cut where turning points are looked for.
const PIECES_OF_A_CYCLE: f64 = 64.0;

/// How far behind a corner its second side is looked at, in cycles.
const BEHIND_CORNER: f64 = 1e-9;

/// mean + amplitude · sin(ωt + φ), of a displacement in m or of a force in N; another [`Waveform`] may
/// stand in the sine's place.
#[derive(Debug, Clone, PartialEq)]
pub struct Oscillation {
    mean: f64,
    amplitude: f64,
    angular_frequency: f64,
    phase: f64,
    waveform: Waveform,
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
            waveform: Waveform::Sine,
        })
    }

    /// The same with another waveform.
    #[must_use]
    pub fn with_waveform(self, waveform: Waveform) -> Self {
        Self { waveform, ..self }
    }

    /// How it swings.
    pub fn waveform(&self) -> &Waveform {
        &self.waveform
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
    /// waveform, so that the millionth turn is like the first.
    pub fn after_turns(&self, turns: f64) -> f64 {
        let swing = match &self.waveform {
            Waveform::Sine => (TAU * turns.fract() + self.phase).sin(),
            Waveform::Polyline(line) => line.at(self.line_phase(turns)),
        };
        self.mean + self.amplitude * swing
    }

    /// The rate of the waveform after `turns`, of which a sine has 1 at most.
    fn rate(&self, turns: f64) -> f64 {
        match &self.waveform {
            Waveform::Sine => (TAU * turns.fract() + self.phase).cos(),
            Waveform::Polyline(line) => line.rate(self.line_phase(turns)) / TAU,
        }
    }

    /// Whether it moves upwards at the beginning, or did so before it came to rest there.
    pub fn rises_at_start(&self) -> bool {
        match &self.waveform {
            Waveform::Sine => self.phase.cos() >= 0.0,
            Waveform::Polyline(line) => line.last_rate(self.line_phase(0.0)) >= 0.0,
        }
    }

    /// The greatest speed, per second.
    pub fn greatest_speed(&self) -> f64 {
        self.amplitude * self.angular_frequency * self.waveform.fastest()
    }

    /// Turns of the first corner after `turns`, if the waveform has corners.
    fn next_corner(&self, turns: f64) -> Option<f64> {
        match &self.waveform {
            Waveform::Sine => None,
            Waveform::Polyline(line) => Some(turns + line.to_next_corner(self.line_phase(turns))),
        }
    }

    /// The phase of a polyline, from 0 to below 1.
    fn line_phase(&self, turns: f64) -> f64 {
        let phase = (turns.fract() + self.phase / TAU).rem_euclid(1.0);
        if phase < 1.0 { phase } else { 0.0 }
    }
}

/// How one direction is driven.
#[derive(Debug, Clone, PartialEq)]
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
#[derive(Debug, Clone, PartialEq)]
pub struct Drive {
    normal: Control,
    tangential: Option<Control>,
    /// Of the rig between actuator and contact, m/N; 0 for a stiff one.
    compliance: f64,
}

impl Drive {
    /// The normal motion, and the tangential one where there is one, on a stiff rig.
    pub fn new(normal: Control, tangential: Option<Control>) -> Self {
        Self {
            normal,
            tangential,
            compliance: 0.0,
        }
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
            let fits = cycles <= FEW_CYCLES || turns < f64::from(LONGEST_REPEAT) + 0.5;
            fits && turns.round() > 0.0 && (turns - turns.round()).abs() < 1e-9 * turns
        })
    }

    /// How many times faster than the cycle the faster of the two motions is, rounded up; 1 where that is the
    /// tangential one, or where the normal direction stands still.
    pub fn turns_of_the_faster(&self) -> u32 {
        if self.normal.oscillation().amplitude == 0.0 {
            return 1;
        }
        // A ratio that is whole but for rounding is whole.
        (self.frequency_ratio() * (1.0 - 1e-9)).ceil().max(1.0) as u32
    }

    /// What an amplitude of each direction is in displacement, m per m or m per N: a force moves a contact of the
    /// radius a by 1/(2E*a) and 1/(2G*a), and a rig of the compliance C leaves it 1/(1 + 2G*aC) of its actuator's
    /// motion, as long as nothing slips; where the motion turns, nothing does.
    pub fn yields(&self, material: &Material, contact_radius: f64) -> [f64; 2] {
        let stiffness = |modulus: f64| 2.0 * modulus * contact_radius;
        let yields = |control: Option<&Control>, modulus: f64, compliance: f64| match control {
            Some(Control::Force(_)) => stiffness(modulus).recip(),
            _ => (1.0 + stiffness(modulus) * compliance).recip(),
        };
        let (tangential, modulus) = (self.tangential.as_ref(), material.tangential_modulus());
        let yields = [
            yields(Some(&self.normal), material.normal_modulus(), 0.0),
            yields(tangential, modulus, self.compliance),
        ];
        if yields.iter().all(|yields| yields.is_finite()) {
            return yields;
        }
        // Out of contact nothing turns that matters.
        [1.0; 2]
    }

    /// The first cycle after `from` and up to `until` at which d + κu_x or d − κu_x turns: there slip ends or
    /// begins. κ is the [stick ratio](crate::contact::material::Material::stick_ratio), and `yields` are those of
    /// [`yields`](Self::yields).
    ///
    /// Corners of a waveform at which the rate of either changes its sign, or to zero or from it, are
    /// turning points as well.
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
            yields[0] * normal.amplitude,
            yields[1] * tangential.amplitude,
        );
        let ratio = self.frequency_ratio();
        // Without friction nothing sticks; with very much, the shift alone turns things.
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

    /// The first turning point after `from` and up to `until`, between which no waveform has a corner.
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
        // What a rig leaves to the contact depends on its force, which wear changes.
        if self.compliance > 0.0 {
            return None;
        }
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
            while let Some(turn) = self.turning_point(stick_ratio, [1.0; 2], from, end) {
                smallest = smallest.min(value(sign, turn));
                from = turn + 1e-6;
            }
            smallest
        };
        Some(0.5 * (lowest(1.0) + lowest(-1.0)))
    }

    /// The first cycle after `from` and up to `until` at which contact is made or lost: the normal force crosses
    /// zero, or the depth that of the lowest point of the profile, `tip` (m).
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
        let pieces = (PIECES_OF_A_CYCLE * ratio.max(1.0) * (until - from)).ceil();
        let pieces = pieces.max(4.0);
        let mut low = (from, above(from));
        (1..=pieces as u32).find_map(|i| {
            let at = from + (until - from) * f64::from(i) / pieces;
            let high = (at, above(at));
            let low = std::mem::replace(&mut low, high);
            sign_change(above, low, high)
        })
    }

    /// The mean of |u̇_x|ⁿ between two cycles over the n-th power of the mean rate: by how much a law with the n-th
    /// power of the slip rate wears more in a step whose rate changes. 1 where the tangential motion is not
    /// prescribed as a displacement, or turns in between.
    pub fn unevenness(&self, exponent: f64, from: f64, until: f64) -> f64 {
        let Some(Control::Displacement(shift)) = &self.tangential else {
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
    (low, at_low): (f64, f64),
    (high, at_high): (f64, f64),
) -> Option<f64> {
    if at_high == 0.0 && at_low != 0.0 {
        return Some(high);
    }
    if at_low * at_high >= 0.0 {
        return None;
    }
    root::bracketed(function, low, high, 4.0 * f64::EPSILON * high.abs())
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
        let first = drive
            .turning_point(8.0, [1.0; 2], 0.0, 1.0)
            .expect("a turn");
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
        assert_eq!(drive.tangential_at(1.0), None);
    }

    #[test]
    fn impossible_motions_are_refused() {
        assert!(Oscillation::new(f64::NAN, 0.0, 1.0, 0.0).is_err());
        assert!(Oscillation::new(0.0, -1.0, 1.0, 0.0).is_err());
        assert!(Oscillation::new(0.0, 1.0, 0.0, 0.0).is_err());
    }
}

//! Wear laws: how fast the surface recedes under a stress and a slip rate.

use std::hint::select_unpredictable as select;

use crate::math::invalid::{Invalid, non_negative, positive};

/// A local wear law, written as a rate so that the result does not depend on the step size.
///
/// Archard's law, Eq. (15) of the paper: Δf = k τ Δs, wear proportional to frictional work. Or a power law, see
/// [`Powers`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WearLaw {
    /// k, 1/Pa.
    coefficient: f64,
    /// `None` for Archard's law.
    powers: Option<Powers>,
}

/// Δf = k τ_ref (τ/τ_ref)^m v_ref (|ṡ|/v_ref)^n Δt.
///
/// The power applies to the slip *rate*: a power n ≠ 1 of the slip increment itself would change the wear by 2^(n−1)
/// when the step is halved. m = n = 1 is Archard's law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Powers {
    /// The exponent m of the stress.
    pub stress_exponent: f64,
    /// The exponent n of the slip rate.
    pub slip_rate_exponent: f64,
    /// τ_ref, Pa.
    pub reference_stress: f64,
    /// v_ref, m/s.
    pub reference_slip_rate: f64,
}

impl WearLaw {
    /// Archard's law with k in 1/Pa; k = 0 wears nothing.
    pub fn archard(coefficient: f64) -> Result<Self, Invalid> {
        Ok(Self {
            coefficient: non_negative("coefficient", coefficient)?,
            powers: None,
        })
    }

    /// The power law; exponents from 0.1 to 10, references greater than 0.
    pub fn power(coefficient: f64, powers: Powers) -> Result<Self, Invalid> {
        let exponent = |field, value: f64| {
            if (0.1..=10.0).contains(&value) {
                Ok(value)
            } else {
                Err(Invalid::new(field, value, "must be from 0.1 to 10"))
            }
        };
        let archard = Self::archard(coefficient)?;
        exponent("stress_exponent", powers.stress_exponent)?;
        exponent("slip_rate_exponent", powers.slip_rate_exponent)?;
        positive("reference_stress", powers.reference_stress)?;
        positive("reference_slip_rate", powers.reference_slip_rate)?;
        Ok(Self {
            powers: Some(powers),
            ..archard
        })
    }

    /// Returns the name used in scenarios.
    pub fn name(&self) -> &'static str {
        match self.powers {
            None => "archard",
            Some(_) => "power",
        }
    }

    /// k, 1/Pa.
    pub fn coefficient(&self) -> f64 {
        self.coefficient
    }

    /// Returns the same law with another k, 1/Pa, 0 or greater.
    #[must_use]
    pub fn with_coefficient(self, coefficient: f64) -> Self {
        Self {
            coefficient,
            ..self
        }
    }

    /// Returns the exponents and references; `None` for Archard's law.
    pub fn powers(&self) -> Option<Powers> {
        self.powers
    }

    /// Whether wear is k times the frictional work, so that V = k E_d can be checked.
    pub fn follows_energy(&self) -> bool {
        self.powers.is_none()
    }

    /// Returns m, the exponent of the stress.
    pub fn stress_exponent(&self) -> f64 {
        self.powers.map_or(1.0, |powers| powers.stress_exponent)
    }

    /// Returns n, the exponent of the slip rate.
    pub fn slip_rate_exponent(&self) -> f64 {
        self.powers.map_or(1.0, |powers| powers.slip_rate_exponent)
    }

    /// Writes ∂Δf/∂τ of one step, m/Pa, into `answers`: how strongly the wear of each node depends on its stress `tau`
    /// (Pa), at the slip `slip` (m) that has `worn` it (m); 0 where no work is done. A power law gives m Δf/|τ|.
    #[inline(always)]
    pub fn sensitivity(&self, tau: &[f64], slip: &[f64], worn: &[f64], answers: &mut [f64]) {
        let points = answers
            .iter_mut()
            .zip(tau.iter().zip(slip.iter().zip(worn)));
        let (k, m, is_power) = (
            self.coefficient,
            self.stress_exponent(),
            self.powers.is_some(),
        );
        for (answer, (&tau, (&slip, &worn))) in points {
            let slope = select(is_power, m * worn / tau.abs(), k * slip.abs());
            *answer = select((tau != 0.0) & (slip != 0.0), slope, 0.0);
        }
    }

    /// Writes the wear (m) of one step into `wear`, from the stress `tau` (Pa) and the slip `slip` (m) at the nodes
    /// over `duration` (s).
    ///
    /// Friction resists slip, so τ·s is never negative; where rounding
    /// or the error of a transform makes it so, nothing wears.
    #[inline(always)]
    pub fn wear(&self, tau: &[f64], slip: &[f64], duration: f64, wear: &mut [f64]) {
        let points = wear.iter_mut().zip(tau.iter().zip(slip));
        let k = self.coefficient;
        let Some(by) = self.powers else {
            for (worn, (tau, slip)) in points {
                *worn = k * positive_part(tau * slip);
            }
            return;
        };
        let scale = k * by.reference_stress * by.reference_slip_rate * duration;
        let per_rate = (by.reference_slip_rate * duration).recip();
        for (worn, (tau, slip)) in points {
            *worn = 0.0;
            if tau * slip > 0.0 {
                let stress = tau.abs() / by.reference_stress;
                *worn = scale
                    * stress.powf(by.stress_exponent)
                    * (slip.abs() * per_rate).powf(by.slip_rate_exponent);
            } else if !(tau * slip).is_finite() {
                *worn = f64::NAN;
            }
        }
    }
}

/// max(v, 0), but NaN stays NaN, so that a broken state shows.
#[inline(always)]
fn positive_part(value: f64) -> f64 {
    if value < 0.0 { 0.0 } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// k = 1e-12/Pa with the powers m and n.
    fn power(m: f64, n: f64) -> Result<WearLaw, Invalid> {
        let powers = Powers {
            stress_exponent: m,
            slip_rate_exponent: n,
            reference_stress: 3e7,
            reference_slip_rate: 2e-5,
        };
        WearLaw::power(1e-12, powers)
    }

    fn worn(law: WearLaw, steps: usize) -> f64 {
        let mut wear = [0.0];
        let (slip, duration) = (1e-7 / steps as f64, 1e-3 / steps as f64);
        law.wear(&[2e8], &[slip], duration, &mut wear);
        wear[0] * steps as f64
    }

    #[test]
    fn a_power_law_of_one_is_archard() {
        let archard = WearLaw::archard(1e-12).expect("a law");
        let power = power(1.0, 1.0).expect("a law");
        assert!((worn(archard, 1) - 2e-11).abs() < 1e-24);
        assert!((worn(power, 1) / worn(archard, 1) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn no_law_depends_on_the_size_of_the_step() {
        for exponent in [0.5, 1.0, 2.0] {
            let law = power(1.5, exponent).expect("a law");
            assert!(
                (worn(law, 1) / worn(law, 64) - 1.0).abs() < 1e-12,
                "n = {exponent}"
            );
        }
    }

    #[test]
    fn the_sensitivity_is_the_derivative() {
        for law in [WearLaw::archard(1e-12), power(1.5, 0.7)] {
            let law = law.expect("a law");
            let at = |tau: f64| {
                let mut wear = [0.0];
                law.wear(&[tau], &[1e-7], 1e-3, &mut wear);
                wear[0]
            };
            let slope = (at(2.0001e8) - at(1.9999e8)) / 2e4;
            let (tau, slip) = ([2e8, 0.0, 2e8], [1e-7, 1e-7, 0.0]);
            let (mut worn, mut answers) = ([f64::NAN; 3], [f64::NAN; 3]);
            law.wear(&tau, &slip, 1e-3, &mut worn);
            law.sensitivity(&tau, &slip, &worn, &mut answers);
            assert!((answers[0] / slope - 1.0).abs() < 1e-6);
            assert_eq!(answers[1..], [0.0; 2]);
        }
    }

    #[test]
    fn wear_is_never_negative_and_never_hides_a_broken_state() {
        for law in [WearLaw::archard(1e-12), power(1.5, 0.7)] {
            let law = law.expect("a law");
            let mut wear = [0.0; 4];
            law.wear(
                &[1.0, -1.0, -1.0, f64::NAN],
                &[-1.0, 1.0, -1.0, 1.0],
                1.0,
                &mut wear,
            );
            assert_eq!(wear[..2], [0.0, 0.0]);
            assert!(wear[2] > 0.0);
            assert!(wear[3].is_nan());
        }
    }

    #[test]
    fn impossible_laws_are_refused() {
        assert!(WearLaw::archard(-1.0).is_err());
        assert!(power(0.0, 1.0).is_err());
        assert!(power(1.0, 11.0).is_err());
    }
}

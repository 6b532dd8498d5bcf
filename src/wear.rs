//! Wear laws: how much the surface recedes where a stress slips.

use std::hint::select_unpredictable as select;

use crate::math::invalid::{Invalid, non_negative, positive};

/// A local law of wear, written as a rate so that the result does not depend on the step's size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum WearLaw {
    /// Eq. (15) of the paper: Δf = k τ Δs, wear in proportion to frictional work.
    Archard {
        /// k, 1/Pa.
        coefficient: f64,
    },
    /// Δf = k τ_ref (τ/τ_ref)^m v_ref (|ṡ|/v_ref)^n Δt.
    ///
    /// A power of the slip *rate*: a power n ≠ 1 of the slip increment itself would change the wear
    /// by 2^(n−1) when the step is halved. m = n = 1 is Archard's law.
    Power {
        /// k, 1/Pa.
        coefficient: f64,
        /// m.
        stress_exponent: f64,
        /// n.
        slip_rate_exponent: f64,
        /// τ_ref, Pa.
        reference_stress: f64,
        /// v_ref, m/s.
        reference_slip_rate: f64,
    },
}

impl WearLaw {
    /// Archard's law with k in 1/Pa; k = 0 wears nothing.
    pub fn archard(coefficient: f64) -> Result<Self, Invalid> {
        non_negative("coefficient", coefficient).map(|coefficient| Self::Archard { coefficient })
    }

    /// The power law; exponents from 0.1 to 10, references greater than 0.
    pub fn power(
        coefficient: f64,
        stress_exponent: f64,
        slip_rate_exponent: f64,
        reference_stress: f64,
        reference_slip_rate: f64,
    ) -> Result<Self, Invalid> {
        let exponent = |field, value: f64| {
            if (0.1..=10.0).contains(&value) {
                Ok(value)
            } else {
                Err(Invalid::new(field, value, "must be from 0.1 to 10"))
            }
        };
        Ok(Self::Power {
            coefficient: non_negative("coefficient", coefficient)?,
            stress_exponent: exponent("stress_exponent", stress_exponent)?,
            slip_rate_exponent: exponent("slip_rate_exponent", slip_rate_exponent)?,
            reference_stress: positive("reference_stress", reference_stress)?,
            reference_slip_rate: positive("reference_slip_rate", reference_slip_rate)?,
        })
    }

    /// The law's name, as a scenario spells it.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Archard { .. } => "archard",
            Self::Power { .. } => "power",
        }
    }

    /// k, 1/Pa.
    pub fn coefficient(&self) -> f64 {
        match *self {
            Self::Archard { coefficient } | Self::Power { coefficient, .. } => coefficient,
        }
    }

    /// The same law with another k, 1/Pa, 0 or greater.
    #[must_use]
    pub fn with_coefficient(mut self, k: f64) -> Self {
        let (Self::Archard { coefficient } | Self::Power { coefficient, .. }) = &mut self;
        *coefficient = k;
        self
    }

    /// Whether wear is k times the frictional work, so that V = k E_d can be watched.
    pub fn follows_energy(&self) -> bool {
        matches!(self, Self::Archard { .. })
    }

    /// By which power of the stress a surface wears: m.
    pub fn stress_exponent(&self) -> f64 {
        match *self {
            Self::Archard { .. } => 1.0,
            Self::Power {
                stress_exponent, ..
            } => stress_exponent,
        }
    }

    /// By which power of the slip rate a surface wears: n.
    pub fn slip_rate_exponent(&self) -> f64 {
        match *self {
            Self::Archard { .. } => 1.0,
            Self::Power {
                slip_rate_exponent, ..
            } => slip_rate_exponent,
        }
    }

    /// ∂Δf/∂τ of one step, m/Pa, into `answers`: how strongly the wear of each node answers to its
    /// stress `tau` (Pa) at a slip `slip` (m) over `duration` (s); 0 where nothing works.
    #[inline(always)]
    pub fn sensitivity(&self, tau: &[f64], slip: &[f64], duration: f64, answers: &mut [f64]) {
        let points = answers.iter_mut().zip(tau.iter().zip(slip));
        let works = |tau: f64, slip: f64| (tau != 0.0) & (slip != 0.0);
        match *self {
            Self::Archard { coefficient } => {
                for (answer, (&tau, &slip)) in points {
                    *answer = select(works(tau, slip), coefficient * slip.abs(), 0.0);
                }
            }
            Self::Power {
                coefficient,
                stress_exponent,
                slip_rate_exponent,
                reference_stress,
                reference_slip_rate,
            } => {
                for (answer, (&tau, &slip)) in points {
                    *answer = 0.0;
                    if works(tau, slip) {
                        *answer = coefficient
                            * reference_slip_rate
                            * duration
                            * stress_exponent
                            * (tau.abs() / reference_stress).powf(stress_exponent - 1.0)
                            * (slip.abs() / (reference_slip_rate * duration))
                                .powf(slip_rate_exponent);
                    }
                }
            }
        }
    }

    /// Writes the wear (m) of one step into `wear`: stress `tau` (Pa) and slip `slip` (m) at the nodes,
    /// over a time of `duration` (s).
    ///
    /// Friction resists slip, so τ·s is never negative; where rounding or a transform's own error
    /// makes it so, nothing wears.
    #[inline(always)]
    pub fn wear(&self, tau: &[f64], slip: &[f64], duration: f64, wear: &mut [f64]) {
        let points = wear.iter_mut().zip(tau.iter().zip(slip));
        match *self {
            Self::Archard { coefficient } => {
                for (worn, (tau, slip)) in points {
                    *worn = coefficient * positive_part(tau * slip);
                }
            }
            Self::Power {
                coefficient,
                stress_exponent,
                slip_rate_exponent,
                reference_stress,
                reference_slip_rate,
            } => {
                let scale = coefficient * reference_stress * reference_slip_rate * duration;
                let per_rate = (reference_slip_rate * duration).recip();
                for (worn, (tau, slip)) in points {
                    *worn = 0.0;
                    if tau * slip > 0.0 {
                        *worn = scale
                            * (tau.abs() / reference_stress).powf(stress_exponent)
                            * (slip.abs() * per_rate).powf(slip_rate_exponent);
                    } else if !(tau * slip).is_finite() {
                        *worn = f64::NAN;
                    }
                }
            }
        }
    }
}

/// max(v, 0), but NaN stays NaN: a broken state must be seen, not hidden.
#[inline(always)]
fn positive_part(value: f64) -> f64 {
    if value < 0.0 { 0.0 } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn worn(law: WearLaw, steps: usize) -> f64 {
        let mut wear = [0.0];
        let (slip, duration) = (1e-7 / steps as f64, 1e-3 / steps as f64);
        law.wear(&[2e8], &[slip], duration, &mut wear);
        wear[0] * steps as f64
    }

    #[test]
    fn a_power_law_of_one_is_archard() {
        let archard = WearLaw::archard(1e-12).expect("a law");
        let power = WearLaw::power(1e-12, 1.0, 1.0, 3e7, 2e-5).expect("a law");
        assert!((worn(archard, 1) - 2e-11).abs() < 1e-24);
        assert!((worn(power, 1) / worn(archard, 1) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn no_law_depends_on_the_size_of_the_step() {
        for exponent in [0.5, 1.0, 2.0] {
            let law = WearLaw::power(1e-12, 1.5, exponent, 3e7, 2e-5).expect("a law");
            assert!(
                (worn(law, 1) / worn(law, 64) - 1.0).abs() < 1e-12,
                "n = {exponent}"
            );
        }
    }

    #[test]
    fn the_sensitivity_is_the_derivative() {
        for law in [
            WearLaw::archard(1e-12),
            WearLaw::power(1e-12, 1.5, 0.7, 3e7, 2e-5),
        ] {
            let law = law.expect("a law");
            let at = |tau: f64| {
                let mut wear = [0.0];
                law.wear(&[tau], &[1e-7], 1e-3, &mut wear);
                wear[0]
            };
            let slope = (at(2.0001e8) - at(1.9999e8)) / 2e4;
            let mut answers = [f64::NAN; 3];
            law.sensitivity(&[2e8, 0.0, 2e8], &[1e-7, 1e-7, 0.0], 1e-3, &mut answers);
            assert!((answers[0] / slope - 1.0).abs() < 1e-6);
            assert_eq!(answers[1..], [0.0; 2]);
        }
    }

    #[test]
    fn wear_is_never_negative_and_never_hides_a_broken_state() {
        for law in [
            WearLaw::archard(1e-12),
            WearLaw::power(1e-12, 1.5, 0.7, 3e7, 2e-5),
        ] {
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
        assert!(WearLaw::power(1.0, 0.0, 1.0, 1.0, 1.0).is_err());
        assert!(WearLaw::power(1.0, 1.0, 1.0, 0.0, 1.0).is_err());
    }
}

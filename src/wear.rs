//! Wear laws: how fast the surface recedes under a stress and a slip rate.
//!
//! To add a law: a variant of [`LawForm`], which does not compile until [`WearLaw::new`], [`traits`](WearLaw::traits),
//! [`wear`](WearLaw::wear), [`sensitivity`](WearLaw::sensitivity) and the tests below have its answers; its word, and its
//! keys, in `keys.toml`, each with a field of [`LawParameters`].

use std::hint::select_unpredictable as select;

use strum::EnumDiscriminants;

use crate::math::invalid::{Invalid, Unmade, need, non_negative, positive};

/// A local wear law, written as a rate so that the result does not depend on the step size. Linear in k.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WearLaw {
    /// k, 1/Pa.
    coefficient: f64,
    form: LawForm,
}

/// The form of a wear law, with its parameters. [`Law`] names it without them, by its word in scenarios.
#[derive(Debug, Clone, Copy, PartialEq, EnumDiscriminants)]
#[strum_discriminants(
    name(Law),
    doc = "A law of wear, by its word in scenarios.",
    derive(
        strum::EnumString,
        strum::IntoStaticStr,
        strum::VariantArray,
        strum::VariantNames
    ),
    strum(serialize_all = "kebab-case")
)]
pub enum LawForm {
    /// Archard's law, Eq. (15) of the paper: Δf = k τ Δs, wear proportional to frictional work.
    Archard,
    /// By powers of stress and slip rate.
    Power(Powers),
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

/// What the rest of the program may assume of a law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawTraits {
    /// Whether it asks for [`Surface::pressure`], which takes two transforms more where springs slip inside the outer slip
    /// zone.
    pub needs_pressure: bool,
    /// Whether V = k E_d, so that the worn volume can be checked.
    pub explained_by_work: bool,
    /// Whether Δf = k τ Δs wherever it wears.
    pub linear_in_work: bool,
    /// Whether Δf ∝ |Δs| at any duration, so that a cycle at constant depth needs no steps.
    pub linear_in_slip: bool,
    /// Whether wear goes on as long as a node under pressure slips, up to the limiting profile.
    pub reaches_limit: bool,
    /// Whether Δf has no jump in τ and p; implicit jumps over cycles need its derivative.
    pub is_continuous: bool,
    /// The exponent m of the stress, where it wears.
    pub stress_exponent: f64,
    /// The exponent n of the slip rate, where it wears.
    pub slip_rate_exponent: f64,
}

/// Keys of the laws as a scenario gives them; `None`: not given.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[expect(missing_docs, reason = "keys.toml describes each key")]
pub struct LawParameters {
    pub stress_exponent: Option<f64>,
    pub slip_rate_exponent: Option<f64>,
    pub reference_stress: Option<f64>,
    pub reference_slip_rate: Option<f64>,
}

/// What keys that are not given may follow from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct References {
    /// Mean pressure of the unworn contact, Pa.
    pub pressure: f64,
    /// μ times that, Pa.
    pub stress: f64,
    /// The greatest tangential velocity, m/s.
    pub slip_rate: f64,
}

impl LawParameters {
    /// Returns these, with the values of `usual` for keys that are not given.
    #[must_use]
    pub fn or(self, usual: Self) -> Self {
        Self {
            stress_exponent: self.stress_exponent.or(usual.stress_exponent),
            slip_rate_exponent: self.slip_rate_exponent.or(usual.slip_rate_exponent),
            reference_stress: self.reference_stress.or(usual.reference_stress),
            reference_slip_rate: self.reference_slip_rate.or(usual.reference_slip_rate),
        }
    }

    /// Returns the defaults that follow from the contact.
    pub fn usual_for(contact: References) -> Self {
        Self {
            reference_stress: Some(contact.stress),
            reference_slip_rate: Some(contact.slip_rate),
            stress_exponent: None,
            slip_rate_exponent: None,
        }
    }
}

/// The nodes that may wear in a step.
#[derive(Debug, Clone, Copy)]
pub struct Surface<'a> {
    /// τ, Pa.
    pub tau: &'a [f64],
    /// Δs, m.
    pub slip: &'a [f64],
    /// p before and after the step, Pa, linear in between; `None` unless the law [needs it](LawTraits::needs_pressure).
    pub pressure: Option<[&'a [f64]; 2]>,
    /// Duration of the step, s.
    pub seconds: f64,
}

impl<'a> Surface<'a> {
    /// Iterates over p before and after the step at each node, Pa.
    ///
    /// # Panics
    ///
    /// If the traits of the law do not ask for it.
    pub fn pressures(&self) -> impl Iterator<Item = (f64, f64)> + use<'a> {
        let [before, after] = self.pressure.expect("the traits of the law ask for p");
        before.iter().copied().zip(after.iter().copied())
    }
}

impl WearLaw {
    /// Makes a law with k in 1/Pa.
    ///
    /// # Errors
    ///
    /// If one of its keys is not given or not allowed.
    pub fn new(law: Law, coefficient: f64, given: &LawParameters) -> Result<Self, Unmade> {
        let law = match law {
            Law::Archard => Self::archard(coefficient),
            Law::Power => {
                let powers = Powers {
                    stress_exponent: need("stress_exponent", given.stress_exponent)?,
                    slip_rate_exponent: need("slip_rate_exponent", given.slip_rate_exponent)?,
                    reference_stress: need("reference_stress", given.reference_stress)?,
                    reference_slip_rate: need("reference_slip_rate", given.reference_slip_rate)?,
                };
                Self::power(coefficient, powers)
            }
        };
        Ok(law?)
    }

    /// Archard's law with k in 1/Pa; k = 0 wears nothing.
    pub fn archard(coefficient: f64) -> Result<Self, Invalid> {
        Self::of(LawForm::Archard, coefficient)
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
        let law = Self::of(LawForm::Power(powers), coefficient)?;
        exponent("stress_exponent", powers.stress_exponent)?;
        exponent("slip_rate_exponent", powers.slip_rate_exponent)?;
        positive("reference_stress", powers.reference_stress)?;
        positive("reference_slip_rate", powers.reference_slip_rate)?;
        Ok(law)
    }

    fn of(form: LawForm, coefficient: f64) -> Result<Self, Invalid> {
        let coefficient = non_negative("coefficient", coefficient)?;
        Ok(Self { coefficient, form })
    }

    /// Returns its name in scenarios.
    pub fn name(&self) -> &'static str {
        Law::from(self.form).into()
    }

    /// Returns the keys of its form.
    pub fn parameters(&self) -> LawParameters {
        match self.form {
            LawForm::Archard => LawParameters::default(),
            LawForm::Power(powers) => LawParameters {
                stress_exponent: Some(powers.stress_exponent),
                slip_rate_exponent: Some(powers.slip_rate_exponent),
                reference_stress: Some(powers.reference_stress),
                reference_slip_rate: Some(powers.reference_slip_rate),
            },
        }
    }

    /// Returns its form.
    pub fn form(&self) -> LawForm {
        self.form
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

    /// Returns what may be assumed of it.
    pub const fn traits(&self) -> LawTraits {
        match self.form {
            LawForm::Archard => LawTraits {
                needs_pressure: false,
                explained_by_work: true,
                linear_in_work: true,
                linear_in_slip: true,
                reaches_limit: self.coefficient > 0.0,
                is_continuous: true,
                stress_exponent: 1.0,
                slip_rate_exponent: 1.0,
            },
            LawForm::Power(powers) => LawTraits {
                needs_pressure: false,
                explained_by_work: false,
                linear_in_work: false,
                linear_in_slip: false,
                reaches_limit: self.coefficient > 0.0,
                is_continuous: true,
                stress_exponent: powers.stress_exponent,
                slip_rate_exponent: powers.slip_rate_exponent,
            },
        }
    }

    /// Writes the wear (m) of one step into `wear`.
    ///
    /// Friction resists slip, so τ·s is never negative; where rounding
    /// or the error of a transform makes it so, nothing wears.
    #[inline(always)]
    pub fn wear(&self, surface: &Surface<'_>, wear: &mut [f64]) {
        let points = wear.iter_mut().zip(surface.tau.iter().zip(surface.slip));
        let k = self.coefficient;
        match self.form {
            LawForm::Archard => {
                for (worn, (tau, slip)) in points {
                    *worn = k * positive_part(tau * slip);
                }
            }
            LawForm::Power(by) => {
                let duration = surface.seconds;
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
    }

    /// Writes ∂Δf/∂τ of one step that has `worn` each node (m), in m/Pa, into `answers`: how strongly the wear of each
    /// node depends on its stress; 0 where no work is done. A power law gives m Δf/|τ|.
    #[inline(always)]
    pub fn sensitivity(&self, surface: &Surface<'_>, worn: &[f64], answers: &mut [f64]) {
        let points = surface.tau.iter().zip(surface.slip.iter().zip(worn));
        let (k, m) = (self.coefficient, self.traits().stress_exponent);
        let by_slip = match self.form {
            LawForm::Archard => true,
            LawForm::Power(_) => false,
        };
        for (answer, (&tau, (&slip, &worn))) in answers.iter_mut().zip(points) {
            let slope = select(by_slip, k * slip.abs(), m * worn / tau.abs());
            *answer = select((tau != 0.0) & (slip != 0.0), slope, 0.0);
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
    use strum::VariantArray;

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

    /// A law of every form.
    fn laws() -> impl Iterator<Item = WearLaw> {
        Law::VARIANTS.iter().map(|law| {
            let law = match law {
                Law::Archard => WearLaw::archard(1e-12),
                Law::Power => power(1.5, 0.7),
            };
            law.expect("a law")
        })
    }

    /// What nodes under a stress `tau` (Pa) and the pressures before and after a step (Pa) wear in it, m, by as much `slip`
    /// (m) in so many seconds.
    fn worn_at(law: WearLaw, tau: f64, pressure: [f64; 2], slip: f64, seconds: f64) -> f64 {
        let mut wear = [0.0];
        let [before, after] = pressure.map(|p| [p]);
        let asked = law.traits().needs_pressure;
        let surface = Surface {
            tau: &[tau],
            slip: &[slip],
            pressure: asked.then_some([&before, &after]),
            seconds,
        };
        law.wear(&surface, &mut wear);
        wear[0]
    }

    fn worn(law: WearLaw, steps: usize) -> f64 {
        let part = 1.0 / steps as f64;
        worn_at(law, 2e8, [2e9; 2], 1e-7 * part, 1e-3 * part) * steps as f64
    }

    fn same(one: f64, other: f64) -> bool {
        (one - other).abs() <= 1e-12 * one.abs().max(other.abs())
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
        let powers = [0.5, 1.0, 2.0].map(|n| power(1.5, n).expect("a law"));
        for law in laws().chain(powers) {
            assert!(same(worn(law, 1), worn(law, 64)), "{law:?}");
        }
    }

    /// The traits of each law against what it wears from 1e-4 to 10 times a stress, with p = 10 τ.
    #[test]
    fn the_traits_are_those_of_the_law() {
        let (seconds, slip, k) = (1e-3, 1e-7, 1e-12);
        let stresses: Vec<f64> = (0..=5000)
            .map(|i| 3e4 * 1e5f64.powf(i as f64 / 5e3))
            .collect();
        for law in laws() {
            let LawTraits {
                needs_pressure,
                explained_by_work,
                linear_in_work,
                linear_in_slip,
                reaches_limit,
                is_continuous,
                stress_exponent,
                slip_rate_exponent,
            } = law.traits();
            let name = law.name();
            assert_eq!(name.parse(), Ok(Law::from(law.form())));
            let at = |tau: f64| worn_at(law, tau, [10.0 * tau; 2], slip, seconds);
            let wears = |tau: &&f64| at(**tau) > 0.0;
            let every =
                |holds: &dyn Fn(f64) -> bool| stresses.iter().filter(wears).all(|tau| holds(*tau));
            let by_pressure = !every(&|tau| {
                let under = |p: f64| worn_at(law, tau, [p; 2], slip, seconds);
                same(under(10.0 * tau), under(1e-3 * tau))
            });
            assert_eq!(by_pressure, needs_pressure, "{name}");
            let all = stresses.iter().filter(wears).count() == stresses.len();
            assert_eq!(all, reaches_limit, "{name}");
            let by_work = every(&|tau| same(at(tau), k * tau * slip));
            assert_eq!(by_work, linear_in_work, "{name}");
            assert_eq!(by_work && all, explained_by_work, "{name}");
            let by_slip = every(&|tau| {
                let half = |seconds| worn_at(law, tau, [10.0 * tau; 2], 0.5 * slip, seconds);
                same(0.5 * at(tau), half(seconds)) && same(half(seconds), half(3.0 * seconds))
            });
            assert_eq!(by_slip, linear_in_slip, "{name}");
            let is_smooth = stresses
                .windows(2)
                .all(|pair| at(pair[1]) - at(pair[0]) <= 0.1 * at(pair[1]));
            assert_eq!(is_smooth, is_continuous, "{name}");
            assert!(
                every(&|tau| {
                    let p = [10.0 * tau; 2];
                    let [one, stronger, faster] = [(1.0, 1.0), (2.0, 1.0), (1.0, 2.0)]
                        .map(|(stress, rate)| worn_at(law, stress * tau, p, rate * slip, seconds));
                    same(stronger, one * 2f64.powf(stress_exponent))
                        && same(faster, one * 2f64.powf(slip_rate_exponent))
                }),
                "{name}"
            );
            assert!(!law.with_coefficient(0.0).traits().reaches_limit, "{name}");
            let twice = law.with_coefficient(2.0 * k);
            assert!(same(worn(twice, 1), 2.0 * worn(law, 1)), "{name}");
        }
    }

    #[test]
    fn the_sensitivity_is_the_derivative() {
        for law in laws() {
            let at = |tau: f64| worn_at(law, tau, [2e9; 2], 1e-7, 1e-3);
            let slope = (at(2.0001e8) - at(1.9999e8)) / 2e4;
            let (tau, slip, p) = ([2e8, 0.0, 2e8], [1e-7, 1e-7, 0.0], [2e9; 3]);
            let surface = Surface {
                tau: &tau,
                slip: &slip,
                pressure: law.traits().needs_pressure.then_some([&p, &p]),
                seconds: 1e-3,
            };
            let (mut worn, mut answers) = ([f64::NAN; 3], [f64::NAN; 3]);
            law.wear(&surface, &mut worn);
            law.sensitivity(&surface, &worn, &mut answers);
            assert!((answers[0] / slope - 1.0).abs() < 1e-6);
            assert_eq!(answers[1..], [0.0; 2]);
        }
    }

    #[test]
    fn wear_is_never_negative_and_never_hides_a_broken_state() {
        for law in laws() {
            let [tau, slip] = [[1.0, -1.0, -1.0, f64::NAN], [-1.0, 1.0, -1.0, 1.0]];
            let wear = [0, 1, 2, 3].map(|j| worn_at(law, tau[j], [2e9; 2], slip[j], 1.0));
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
        let missing = WearLaw::new(Law::Power, 1.0, &LawParameters::default());
        assert_eq!(missing, Err(Unmade::Missing("stress_exponent")));
    }
}

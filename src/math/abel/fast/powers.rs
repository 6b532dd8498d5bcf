//! The kernels as sums of powers, fitted when a plan is made.
//!
//! # Formula
//!
//! Seen from row j, all that the transforms ask of a cell at t_k = x_k² is the ratio v = t_k/t_j (v = t_j/t_k
//! for the stress). Their kernels, as densities over v or over s = √v,
//!
//! ```text
//! profile, stress   (1 − v)^(−1/2)                       over dv
//! displacement      (2/π) acos √v                        over dv
//! worn depth        s/√(1 − s²) + acos s                 over ds
//! ```
//!
//! are smooth in ln v away from v = 1, so that for v ≤ exp(−y_min) each is Σ A_m v^(ν_m). What a kink needs (see
//! [`super::kink`](super::super::kink)) is the integral,
//!
//! ```text
//! ∫ᵥ¹ = κ − Σ a_m v^(μ_m),   a = A/(ν + 1), μ = ν + 1    (over ds: a = A/(2ν + 1), μ = ν + ½)
//! ```
//!
//! with the exact κ = ∫₀¹: 2 for profile, stress and worn depth, 1/2 for the displacement.
//!
//! # Exponents
//!
//! But for their constant, all three kernels (the second with its sign turned) are power series with positive
//! terms only, from c_n = (2n)!/(4ⁿ n!²):
//!
//! ```text
//! profile, stress   1 + Σ_{n≥1} c_n vⁿ
//! displacement      1 − (2/π) Σ_{n≥0} c_n/(2n+1) v^(n+½)
//! worn depth        π/2 + Σ_{n≥1} c_n 2n/(2n+1) v^(n+½)
//! ```
//!
//! With v = e^(−y) such a series is the impulse response of a symmetric system, b′ exp(−y diag ν) b with
//! b = √w, and balanced truncation gives the few modes that matter for y ≥ y_min (B. C. Moore (1981), IEEE
//! Trans. Autom. Control 26, 17–32, doi 10.1109/TAC.1981.1102568): with the eigenvectors V of its Gramian
//!
//! ```text
//! P_ik = b_i b_k/(ν_i + ν_k),   b_i² = w_i exp(−ν_i y_min),
//! ```
//!
//! taken from the largest eigenvalue on, the new exponents are the eigenvalues of V′ diag(ν) V. The norm is that over dy,
//! which for a kernel like y^(−1/2) is that of the relative error over ln y; the displacement is weighted like
//! its derivative. Terms far out in the series are gathered beforehand, those of each octave by Gauss's rule. The
//! A_m are then those of least squares over ln v of the kernel itself. K exponents leave an error near
//! that of the best ones, exp(−π²K/ln(8/y_min)) (D. Braess, W. Hackbusch (2009), in Multiscale, Nonlinear and
//! Adaptive Approximation, Springer, doi 10.1007/978-3-642-03413-8_3), with no table and no search.

use std::f64::consts::{FRAC_1_PI, FRAC_2_PI, PI};

use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// Exponents come in groups of this many: one vector register.
pub(super) const LANES: usize = 4;

/// The most groups: enough for 1e-12 at N = 1e5.
pub(super) const MOST_GROUPS: usize = 14;

/// Sample points of the fit over ln v, a number a unit of its logarithm.
const SAMPLES: usize = 24;

/// ln v beyond which every power but ν = 0 has died.
const FARTHEST: f64 = 60.0;

/// Terms of the series that are taken one by one.
const SINGLE: usize = 32;

/// Terms whose exponent times y_min is beyond this are left out.
const LAST: f64 = 30.0;

/// Points and weights of Gauss's rule on (−1, 1), those right of the middle.
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_47),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

/// A kernel to be fitted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kernel {
    /// Eqs. (1) and (3).
    Root,
    /// Eq. (2).
    Arc,
    /// Eq. (1) on the worn depth outside the border.
    Worn,
}

impl Kernel {
    /// κ: the integral of the whole kernel.
    fn whole(self) -> f64 {
        match self {
            Self::Root | Self::Worn => 2.0,
            Self::Arc => 0.5,
        }
    }

    /// The density at v = exp(−y).
    fn density(self, y: f64) -> f64 {
        let (root, grown) = ((-(-y).exp_m1()).sqrt(), y.exp_m1().sqrt());
        match self {
            Self::Root => 1.0 / root,
            Self::Arc => FRAC_2_PI * grown.atan(),
            Self::Worn => 1.0 / grown + grown.atan(),
        }
    }

    /// What an error is measured against: the density, or 1 where that vanishes at v = 1.
    fn scale(self, y: f64) -> f64 {
        match self {
            Self::Arc => 1.0,
            _ => self.density(y),
        }
    }

    /// The integral from v to 1, of v = s² and 1 − v = c², both at hand without cancellation.
    pub fn kink(self, s: f64, c: f64) -> f64 {
        match self {
            Self::Root => 2.0 * c,
            Self::Arc => FRAC_2_PI * ((0.5 - s * s) * c.atan2(s) + 0.5 * s * c),
            Self::Worn => 2.0 * c - s * c.atan2(s),
        }
    }

    /// The term n of the power series, its constant apart: the exponent and its weight for the truncation.
    fn term(self, n: f64) -> (f64, f64) {
        // c_n by Stirling's series; the exponents need no more than a few digits of it.
        let c = if n < 1.0 {
            1.0
        } else {
            let inverse = 1.0 / n;
            (1.0 - inverse * (0.125 - inverse * 0.007_812_5)) / (PI * n).sqrt()
        };
        match self {
            Self::Root => (n, c),
            Self::Arc => (n + 0.5, c * FRAC_1_PI),
            Self::Worn => (n + 0.5, c * n / (n + 0.5)),
        }
    }

    /// a and μ from A and ν.
    fn integrated(self, exponent: f64, factor: f64) -> (f64, f64) {
        match self {
            Self::Worn => (factor / (2.0 * exponent + 1.0), exponent + 0.5),
            _ => (factor / (exponent + 1.0), exponent + 1.0),
        }
    }
}

/// Σ a_m v^(μ_m), κ among the a.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Powers {
    /// The kernel that they stand for.
    pub kernel: Kernel,
    /// They do so for v ≤ exp(−this).
    pub nearest: f64,
    /// μ, a multiple of [`LANES`] of them.
    pub exponents: Vec<f64>,
    /// a of each.
    pub factors: Vec<f64>,
}

/// The fewest powers that hold `kernel` to `tolerance` for v ≤ exp(−`nearest`).
///
/// None if [`MOST_GROUPS`] do not suffice.
pub(super) fn fit(kernel: Kernel, nearest: f64, tolerance: f64) -> Option<Powers> {
    let decades = (FARTHEST / nearest).ln();
    let points = |number: f64| {
        let number = number.ceil();
        (0..=number as usize)
            .map(|i| nearest * (decades * i as f64 / number).exp())
            .collect::<Vec<f64>>()
    };
    let samples = points(SAMPLES as f64 * decades);
    // Elsewhere than where it was fitted.
    let checks = points(1.37 * SAMPLES as f64 * decades);
    let balanced = balanced(kernel, nearest);
    (2..=MOST_GROUPS).find_map(|groups| {
        let exponents = truncated(&balanced, groups * LANES - 2)?;
        let factors = least_squares(kernel, &exponents, &samples)?;
        let worst = residual(kernel, &exponents, &factors, &checks);
        // The nearest kinks are exact, those behind them are not: what that breaks off the integral is as much again.
        (2.0 * worst <= tolerance).then(|| {
            let pairs = exponents.iter().zip(&factors);
            let powers = pairs.map(|(&nu, &a)| kernel.integrated(nu, -a));
            let (factors, exponents) = powers.chain([(kernel.whole(), 0.0)]).unzip();
            Powers {
                kernel,
                nearest,
                exponents,
                factors,
            }
        })
    })
}

/// V′ diag(ν) V of all modes, the weightiest first.
fn balanced(kernel: Kernel, nearest: f64) -> DMatrix<f64> {
    let first = usize::from(kernel != Kernel::Arc);
    let mut terms: Vec<(f64, f64)> = (first..SINGLE).map(|n| kernel.term(n as f64)).collect();
    let mut from = SINGLE as f64 - 0.5;
    while from * nearest < LAST {
        let half = 0.5 * from;
        for (point, weight) in GAUSS {
            for side in [-point, point] {
                let (exponent, factor) = kernel.term(from + half * (1.0 + side));
                terms.push((exponent, factor * weight * half));
            }
        }
        from *= 2.0;
    }
    let root = |(exponent, weight): (f64, f64)| (weight * (-exponent * nearest).exp()).sqrt();
    let gramian = DMatrix::from_fn(terms.len(), terms.len(), |i, k| {
        root(terms[i]) * root(terms[k]) / (terms[i].0 + terms[k].0)
    });
    let eigen = SymmetricEigen::new(gramian);
    let mut order: Vec<usize> = (0..terms.len()).collect();
    order.sort_by(|&i, &k| eigen.eigenvalues[k].total_cmp(&eigen.eigenvalues[i]));
    let modes = eigen.eigenvectors.select_columns(&order);
    let mut weighted = modes.clone();
    for (mut row, (exponent, _)) in weighted.row_iter_mut().zip(&terms) {
        row *= *exponent;
    }
    modes.tr_mul(&weighted)
}

/// The exponents of the first `number` modes, and 0; `None` if there are fewer modes.
fn truncated(balanced: &DMatrix<f64>, number: usize) -> Option<Vec<f64>> {
    if number > balanced.nrows() {
        return None;
    }
    let block = balanced.view((0, 0), (number, number)).into_owned();
    let mut exponents: Vec<f64> = block.symmetric_eigenvalues().iter().copied().collect();
    exponents.push(0.0);
    exponents.sort_by(f64::total_cmp);
    Some(exponents)
}

/// A_m of least squares at the points y of `samples`, in units of the kernel's scale.
fn least_squares(kernel: Kernel, exponents: &[f64], samples: &[f64]) -> Option<Vec<f64>> {
    let terms = DMatrix::from_fn(samples.len(), exponents.len(), |i, m| {
        (-exponents[m] * samples[i]).exp() / kernel.scale(samples[i])
    });
    let target = samples.iter().map(|&y| kernel.density(y) / kernel.scale(y));
    let qr = terms.qr();
    let rotated = qr
        .q()
        .tr_mul(&DVector::from_iterator(samples.len(), target));
    let solution = qr.r().solve_upper_triangular(&rotated)?;
    Some(solution.iter().copied().collect())
}

/// The largest error at the points, in units of the kernel's scale.
fn residual(kernel: Kernel, exponents: &[f64], factors: &[f64], points: &[f64]) -> f64 {
    let errors = points.iter().map(|&y| {
        let pairs = exponents.iter().zip(factors);
        let sum: f64 = pairs.map(|(nu, a)| a * (-nu * y).exp()).sum();
        ((sum - kernel.density(y)) / kernel.scale(y)).abs()
    });
    errors.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_impossible_is_refused() {
        assert_eq!(fit(Kernel::Root, 3e-4, 1e-16), None);
    }

    #[test]
    fn the_tolerance_is_kept_over_a_ladder() {
        for tolerance in [1e-4, 1e-7, 1e-9, 1e-11] {
            for nearest in [0.3, 0.03, 3e-3, 3e-4] {
                if tolerance < 1e-10 && nearest < 1e-3 {
                    continue;
                }
                for kernel in [Kernel::Root, Kernel::Arc, Kernel::Worn] {
                    let powers = fit(kernel, nearest, tolerance)
                        .unwrap_or_else(|| panic!("no fit to {tolerance:e} at {nearest}"));
                    assert!(powers.exponents.len() <= MOST_GROUPS * LANES);
                    // The kinks, which the densities add up to, at places of their own.
                    for i in 0..400 {
                        let y = nearest * 1.02_f64.powi(i);
                        let (s, c) = ((-0.5 * y).exp(), (-(-y).exp_m1()).sqrt());
                        let pairs = powers.exponents.iter().zip(&powers.factors);
                        let sum: f64 = pairs.map(|(mu, a)| a * (-mu * y).exp()).sum();
                        let error = sum - kernel.kink(s, c);
                        // ∫₀¹ of the kernel's scale is at most 2.
                        assert!(
                            error.abs() <= 2.0 * tolerance + 1e-14,
                            "{kernel:?} {y}: {error:e}"
                        );
                    }
                }
            }
        }
    }
}

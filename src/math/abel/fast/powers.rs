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
//! are smooth in ln v away from v = 1, so that for v ≤ exp(−y_min) each is Σ A_m v^(ν_m), on one set of
//! exponents: 0, 1/2 and 1, with which their series about v = 0 begin, the others in geometric
//! progression up to about 10/y_min. The A_m are those of least squares over ln v. What a bend needs (see [`super::bend`](super::super::bend)) is the integral,
//!
//! ```text
//! ∫ᵥ¹ = κ − Σ a_m v^(μ_m),   a = A/(ν + 1), μ = ν + 1    (over ds: a = A/(2ν + 1), μ = ν + ½)
//! ```
//!
//! with the exact κ = ∫₀¹: 2 for profile, stress and worn depth, 1/2 for the displacement.
//!
//! Geometric exponents are within a few of the fewest possible (D. Braess, W. Hackbusch (2009), On the
//! efficient computation of high-dimensional integrals and the approximation by exponential sums, in
//! Multiscale, Nonlinear and Adaptive Approximation, Springer, doi 10.1007/978-3-642-03413-8_3: an error that falls
//! like exp(−π²K/ln(8/y_min))), and need no table and no nonlinear search.

use std::f64::consts::FRAC_2_PI;

use nalgebra::{DMatrix, DVector};

/// Exponents come in groups of this many: one vector register.
pub(super) const LANES: usize = 4;

/// The most groups: enough for 1e-12 at N = 1e5.
pub(super) const MOST_GROUPS: usize = 14;

/// Sample points of the fit over ln v, a number a unit of its logarithm.
const SAMPLES: usize = 24;

/// ln v beyond which every power but ν = 0 has died.
const FARTHEST: f64 = 60.0;

/// The exponents with which the series of the kernels about v = 0 begin.
const FIRST: [f64; 3] = [0.0, 0.5, 1.0];

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
    pub fn whole(self) -> f64 {
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
    pub fn bend(self, s: f64, c: f64) -> f64 {
        match self {
            Self::Root => 2.0 * c,
            Self::Arc => FRAC_2_PI * ((0.5 - s * s) * c.atan2(s) + 0.5 * s * c),
            Self::Worn => 2.0 * c - s * c.atan2(s),
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

/// κ − Σ a_m v^(μ_m), for several kernels on one set of exponents.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Powers {
    /// μ, a multiple of [`LANES`] of them.
    pub exponents: Vec<f64>,
    /// a, for each kernel.
    pub factors: Vec<Vec<f64>>,
}

/// The fewest powers that hold every kernel to `tolerance` for v ≤ exp(−`nearest`).
///
/// None if [`MOST_GROUPS`] do not suffice. The kernels must integrate alike.
pub(super) fn fit(kernels: &[Kernel], nearest: f64, tolerance: f64) -> Option<Powers> {
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
    let digits = -tolerance.ln();
    for groups in 2..=MOST_GROUPS {
        let ends = [1.3, 1.5, 2.0].map(|low| [0.35, 0.45, 0.55].map(|high| (low, high)));
        for (smallest, largest) in ends.into_iter().flatten() {
            let free = groups * LANES - FIRST.len();
            let ratio = (largest * digits / nearest / smallest).ln() / (free - 1) as f64;
            let others = (0..free).map(|i| smallest * (ratio * i as f64).exp());
            let exponents: Vec<f64> = FIRST.into_iter().chain(others).collect();
            let fitted: Option<Vec<Vec<f64>>> = kernels
                .iter()
                .map(|&kernel| {
                    let factors = least_squares(kernel, &exponents, &samples)?;
                    let worst = residual(kernel, &exponents, &factors, &checks);
                    (worst <= tolerance).then_some(factors)
                })
                .collect();
            if let (Some(fitted), Some(&first)) = (fitted, kernels.first()) {
                let integrated = |kernel: Kernel, factors: &[f64]| -> Vec<f64> {
                    let pairs = exponents.iter().zip(factors);
                    pairs.map(|(&nu, &a)| kernel.integrated(nu, a).0).collect()
                };
                return Some(Powers {
                    factors: kernels
                        .iter()
                        .zip(&fitted)
                        .map(|(&kernel, factors)| integrated(kernel, factors))
                        .collect(),
                    exponents: exponents
                        .iter()
                        .map(|&nu| first.integrated(nu, 0.0).1)
                        .collect(),
                });
            }
        }
    }
    None
}

fn least_squares(kernel: Kernel, exponents: &[f64], samples: &[f64]) -> Option<Vec<f64>> {
    let mut matrix = DMatrix::from_fn(samples.len(), exponents.len(), |i, m| {
        (-exponents[m] * samples[i]).exp() / kernel.scale(samples[i])
    });
    let norms: Vec<f64> = matrix.column_iter().map(|column| column.norm()).collect();
    for (mut column, norm) in matrix.column_iter_mut().zip(&norms) {
        column /= *norm;
    }
    let target = DVector::from_iterator(
        samples.len(),
        samples.iter().map(|&y| kernel.density(y) / kernel.scale(y)),
    );
    let qr = matrix.qr();
    let mut rotated = target;
    qr.q_tr_mul(&mut rotated);
    let head = rotated.rows(0, exponents.len()).into_owned();
    let solution = qr.r().solve_upper_triangular(&head)?;
    Some(
        solution
            .iter()
            .zip(&norms)
            .map(|(x, norm)| x / norm)
            .collect(),
    )
}

/// The largest error at the points, in units of the kernel's scale.
fn residual(kernel: Kernel, exponents: &[f64], factors: &[f64], points: &[f64]) -> f64 {
    points
        .iter()
        .map(|&y| {
            let pairs = exponents.iter().zip(factors);
            let sum: f64 = pairs.map(|(nu, a)| a * (-nu * y).exp()).sum();
            ((sum - kernel.density(y)) / kernel.scale(y)).abs()
        })
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_impossible_is_refused() {
        assert_eq!(fit(&[Kernel::Root], 3e-4, 1e-16), None);
    }

    #[test]
    fn the_tolerance_is_kept_over_a_ladder() {
        for tolerance in [1e-4, 1e-7, 1e-9, 1e-11] {
            for nearest in [0.3, 0.03, 3e-3, 3e-4] {
                if tolerance < 1e-10 && nearest < 1e-3 {
                    continue;
                }
                let kernels = [Kernel::Root, Kernel::Arc];
                let powers = fit(&kernels, nearest, tolerance)
                    .unwrap_or_else(|| panic!("no fit to {tolerance:e} at {nearest}"));
                assert!(powers.exponents.len() <= MOST_GROUPS * LANES);
                // The bends, which the densities add up to, at places of their own.
                for (kernel, factors) in kernels.iter().zip(&powers.factors) {
                    for i in 0..400 {
                        let y = nearest * 1.02_f64.powi(i);
                        let (s, c) = ((-0.5 * y).exp(), (-(-y).exp_m1()).sqrt());
                        let pairs = powers.exponents.iter().zip(factors);
                        let sum: f64 = pairs.map(|(mu, a)| a * (-mu * y).exp()).sum();
                        let error = kernel.whole() - sum - kernel.bend(s, c);
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

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
//! which for a kernel like y^(−1/2) is that of the relative error over ln y; all three have w_n = c_n, the displacement
//! that of its derivative. Terms far out in the series are gathered in bunches beforehand. The A_m are then those of
//! least squares over ln v of the kernel itself. K exponents leave an error near that of the best ones,
//! exp(−π²K/ln(8/y_min)) (D. Braess, W. Hackbusch (2009), in Multiscale, Nonlinear and Adaptive Approximation, Springer,
//! doi 10.1007/978-3-642-03413-8_3), with no table and no search.

use std::f64::consts::{FRAC_2_PI, PI};

use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// Exponents come in groups of this many: one vector register.
pub(super) const LANES: usize = 4;

/// The most groups: enough for 1e-12 at N = 1e5.
pub(super) const MOST_GROUPS: usize = 14;

/// Sample points of the fit over ln v, a number a unit of its logarithm.
const SAMPLES: f64 = 24.0;

/// ln v beyond which every power but ν = 0 has died.
const FARTHEST: f64 = 60.0;

/// Terms of the series far out are gathered in bunches of this part of their number.
const BUNCH: f64 = 0.07;

/// Terms whose exponent times y_min is beyond this are left out.
const LAST: f64 = 30.0;

/// A kernel to be fitted.
#[derive(Debug, Clone, Copy)]
pub(in super::super) struct Kernel {
    /// κ: the integral of the whole kernel.
    whole: f64,
    /// The density of v = s² and 1 − v = c², both at hand without cancellation.
    density: fn(f64, f64) -> f64,
    /// Whether errors are relative to the density: where that vanishes at v = 1, they are not.
    is_relative: bool,
    /// The integral from v to 1, of s and c.
    pub kink: fn(f64, f64) -> f64,
    /// The first term of the power series but its constant, n.
    first: f64,
    /// The exponent of the term n less n.
    shift: f64,
    /// How many times ln v the logarithm of the variable is that the density is over: 1 of v, 2 of s.
    per_logarithm: f64,
}

/// Eqs. (1) and (3).
pub(in super::super) const ROOT: Kernel = Kernel {
    whole: 2.0,
    density: |_, c| 1.0 / c,
    is_relative: true,
    kink: |_, c| 2.0 * c,
    first: 1.0,
    shift: 0.0,
    per_logarithm: 1.0,
};

/// Eq. (2).
pub(in super::super) const ARC: Kernel = Kernel {
    whole: 0.5,
    density: |s, c| FRAC_2_PI * c.atan2(s),
    is_relative: false,
    kink: |s, c| FRAC_2_PI * ((0.5 - s * s) * c.atan2(s) + 0.5 * s * c),
    first: 0.0,
    shift: 0.5,
    per_logarithm: 1.0,
};

/// Eq. (1) on the worn depth outside the border.
pub(super) const WORN: Kernel = Kernel {
    whole: 2.0,
    density: |s, c| s / c + c.atan2(s),
    is_relative: true,
    kink: |s, c| 2.0 * c - s * c.atan2(s),
    first: 1.0,
    shift: 0.5,
    per_logarithm: 2.0,
};

/// Σ a_m v^(μ_m), κ among the a.
#[derive(Debug, Clone)]
pub(in super::super) struct Powers {
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
    let range = (FARTHEST / nearest).ln();
    // What is fitted, and a check between.
    let [samples, checks] = [SAMPLES, 1.37 * SAMPLES].map(|density| {
        let number = (density * range).ceil();
        let points = (0..=number as usize).map(|i| nearest * (range * i as f64 / number).exp());
        points.collect::<Vec<f64>>()
    });
    let density = |y: f64| (kernel.density)((-0.5 * y).exp(), (-(-y).exp_m1()).sqrt());
    let scale = |y: f64| if kernel.is_relative { density(y) } else { 1.0 };
    let target = |points: &[f64]| {
        let values = points.iter().map(|&y| density(y) / scale(y));
        DVector::from_iterator(points.len(), values)
    };
    let balanced = balanced(kernel, nearest);
    (2..=MOST_GROUPS).find_map(|groups| {
        let exponents = truncated(&balanced, groups * LANES - 2)?;
        let powers = |points: &[f64]| {
            DMatrix::from_fn(points.len(), exponents.len(), |i, m| {
                (-exponents[m] * points[i]).exp() / scale(points[i])
            })
        };
        let qr = powers(&samples).qr();
        let factors = qr
            .r()
            .solve_upper_triangular(&qr.q().tr_mul(&target(&samples)))?;
        let worst = (powers(&checks) * &factors - target(&checks)).amax();
        // The nearest kinks are exact, those behind them are not: what that breaks off the integral is as much again.
        (2.0 * worst <= tolerance).then(|| {
            let per = kernel.per_logarithm;
            let pairs = exponents.iter().zip(&factors);
            let powers = pairs.map(|(nu, a)| (-a / (per * nu + 1.0), nu + 1.0 / per));
            let (factors, exponents) = powers.chain([(kernel.whole, 0.0)]).unzip();
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
    // ν and b of every bunch of terms.
    let mut terms: Vec<(f64, f64)> = Vec::new();
    let mut from = kernel.first;
    while from * nearest < LAST {
        let count = (BUNCH * from).floor().max(1.0);
        let n = from + 0.5 * (count - 1.0);
        // c_n by Stirling's series; the exponents need no more than a few digits of it.
        let c = if n < 1.0 {
            1.0
        } else {
            (1.0 - (0.125 - 0.007_812_5 / n) / n) / (PI * n).sqrt()
        };
        let exponent = n + kernel.shift;
        let weight = count * c * (-exponent * nearest).exp();
        terms.push((exponent, weight.sqrt()));
        from += count;
    }
    let gramian = DMatrix::from_fn(terms.len(), terms.len(), |i, k| {
        terms[i].1 * terms[k].1 / (terms[i].0 + terms[k].0)
    });
    let eigen = SymmetricEigen::new(gramian);
    let mut order: Vec<usize> = (0..terms.len()).collect();
    order.sort_by(|&i, &k| eigen.eigenvalues[k].total_cmp(&eigen.eigenvalues[i]));
    let modes = eigen.eigenvectors.select_columns(&order);
    let exponents = DVector::from_iterator(terms.len(), terms.iter().map(|term| term.0));
    modes.tr_mul(&(DMatrix::from_diagonal(&exponents) * &modes))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_impossible_is_refused() {
        assert!(fit(ROOT, 3e-4, 1e-16).is_none());
    }

    #[test]
    fn the_tolerance_is_kept_over_a_ladder() {
        for tolerance in [1e-4, 1e-7, 1e-9, 1e-11] {
            for nearest in [0.3, 0.03, 3e-3, 3e-4] {
                if tolerance < 1e-10 && nearest < 1e-3 {
                    continue;
                }
                for kernel in [ROOT, ARC, WORN] {
                    let powers = fit(kernel, nearest, tolerance)
                        .unwrap_or_else(|| panic!("no fit to {tolerance:e} at {nearest}"));
                    assert!(powers.exponents.len() <= MOST_GROUPS * LANES);
                    // The kinks, which the densities add up to, at places of their own.
                    for i in 0..400 {
                        let y = nearest * 1.02_f64.powi(i);
                        let (s, c) = ((-0.5 * y).exp(), (-(-y).exp_m1()).sqrt());
                        let pairs = powers.exponents.iter().zip(&powers.factors);
                        let sum: f64 = pairs.map(|(mu, a)| a * (-mu * y).exp()).sum();
                        let error = sum - (kernel.kink)(s, c);
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

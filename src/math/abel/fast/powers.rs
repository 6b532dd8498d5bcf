//! Fits sums of powers to the kernels when a plan is made.
//!
//! # Formula
//!
//! Seen from row j, the transforms need only the ratio v = t_k/t_j of a kink at t_k = x_k² (v = t_j/t_k for the
//! stress). The image of a kink (see [`super::kink`](super::super::kink)), as a function of v or of s = √v, is
//!
//! ```text
//! profile, stress   2 √(1 − v)                                = 2 − v − Σ_{n≥2} c_n vⁿ
//! displacement      (2/π) { (½ − v) acos s + ½ s √(1 − v) }   = ½ − v + Σ_{n≥1} c_n v^(n+½)
//! worn depth        2 √(1 − v) − s acos s                     = 2 − (π/2) s − Σ_{n≥2} c_n vⁿ
//! ```
//!
//! with c_n > 0. Away from v = 1 it is smooth in ln v, so a sum Σ a_m v^(μ_m) can replace it for v ≤ exp(−y_min).
//!
//! # Exponents
//!
//! The two terms before the sum keep their exponents. With v = e^(−y) the rest is the impulse
//! response of a symmetric system, b′ exp(−y diag μ) b with b = √c, and balanced truncation
//! gives the few modes that matter for y ≥ y_min (B. C. Moore (1981), IEEE Trans. Autom.
//! Control 26, 17–32, doi 10.1109/TAC.1981.1102568): with the eigenvectors V of its Gramian
//!
//! ```text
//! P_ik = b_i b_k/(μ_i + μ_k),   b_i² = c_i exp(−μ_i y_min),
//! ```
//!
//! taken from the largest eigenvalue on, the new exponents are the eigenvalues of V′ diag(μ) V. This only needs c_n to
//! fall as n^(−3/2) or faster; for the displacement it falls faster, and takes as few exponents. Terms far out in the
//! series are bunched beforehand. The a_m are then fitted by least squares over ln v to the image itself. The error of
//! K exponents is near the best possible, exp(−π²K/ln(8/y_min)) (D. Braess, W. Hackbusch (2009), in Multiscale,
//! Nonlinear and Adaptive Approximation, Springer, doi 10.1007/978-3-642-03413-8_3), without a table or a search.

use std::f64::consts::FRAC_2_PI;

use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// Exponents per group: one vector register.
pub(super) const LANES: usize = 4;

/// Maximum number of groups: enough for 1e-12 at N = 1e5.
pub(super) const MOST_GROUPS: usize = 14;

/// Sample points of the fit per unit of ln(−ln v).
const SAMPLES: f64 = 32.0;

/// −ln v beyond which every power but v⁰ has died out.
const FARTHEST: f64 = 60.0;

/// Safety factor on the tolerance of a kink. The two kinks of a cell nearly cancel, their errors less so; with this
/// factor the cells of smooth data, jumps and noise meet the tolerance.
const RESERVE: f64 = 32.0;

/// Width of a bunch of far terms, relative to the exponent at which it begins.
const BUNCH: f64 = 0.07;

/// Drops terms whose exponent times y_min exceeds this.
const LAST: f64 = 30.0;

/// A kernel to be fitted.
#[derive(Debug, Clone, Copy)]
pub(in super::super) struct Kernel {
    /// Image of a kink as a function of s = √v and c = √(1 − v); taking both avoids cancellation.
    pub kink: fn(f64, f64) -> f64,
    /// Second exponent of its series; the first is 0.
    second: f64,
    /// Third exponent; the following ones rise in steps of 1.
    third: f64,
}

/// Eqs. (1) and (3).
pub(in super::super) const ROOT: Kernel = Kernel {
    kink: |_, c| 2.0 * c,
    second: 1.0,
    third: 2.0,
};

/// Eq. (2).
pub(in super::super) const ARC: Kernel = Kernel {
    kink: |s, c| FRAC_2_PI * ((0.5 - s * s) * c.atan2(s) + 0.5 * s * c),
    second: 1.0,
    third: 1.5,
};

/// Eq. (1) on the worn depth outside the border.
pub(super) const WORN: Kernel = Kernel {
    kink: |s, c| 2.0 * c - s * c.atan2(s),
    second: 0.5,
    third: 2.0,
};

/// Σ a_m v^(μ_m).
#[derive(Debug, Clone)]
pub(in super::super) struct PowerSum {
    /// Kernel that they approximate.
    pub kernel: Kernel,
    /// They approximate it for v ≤ exp(−`nearest`).
    pub nearest: f64,
    /// Exponents μ, a multiple of [`LANES`] in number.
    pub exponents: Vec<f64>,
    /// Factor a of each power.
    pub factors: Vec<f64>,
}

/// Fits the fewest powers that hold `kernel` to `tolerance` for v ≤ exp(−`nearest`).
///
/// `None` if [`MOST_GROUPS`] do not suffice.
pub(super) fn fit(kernel: Kernel, nearest: f64, tolerance: f64) -> Option<PowerSum> {
    let range = (FARTHEST / nearest).ln();
    let last = (SAMPLES * range).ceil();
    let samples = DVector::from_fn(last as usize + 1, |i, _| {
        nearest * (range * i as f64 / last).exp()
    });
    let kinks = samples.map(|y| (kernel.kink)((-0.5 * y).exp(), (-(-y).exp_m1()).sqrt()));
    let balanced = balanced(kernel, nearest);
    (2..=MOST_GROUPS).find_map(|groups| {
        let mut exponents = truncated(&balanced, groups * LANES - 2)?;
        exponents.extend([0.0, kernel.second]);
        let powers = DMatrix::from_fn(samples.len(), exponents.len(), |i, m| {
            (-exponents[m] * samples[i]).exp()
        });
        let qr = powers.clone().qr();
        let factors = qr.r().solve_upper_triangular(&qr.q().tr_mul(&kinks))?;
        let worst = (powers * &factors - &kinks).amax();
        (RESERVE * worst <= tolerance).then(|| PowerSum {
            kernel,
            nearest,
            exponents,
            factors: factors.as_slice().to_vec(),
        })
    })
}

/// Returns V′ diag(μ) V of all modes, the weightiest first.
fn balanced(kernel: Kernel, nearest: f64) -> DMatrix<f64> {
    // μ and b of every bunch of terms.
    let mut terms: Vec<(f64, f64)> = Vec::new();
    let mut from = kernel.third;
    while from * nearest < LAST {
        let count = (BUNCH * from).floor().max(1.0);
        let exponent = from + 0.5 * (count - 1.0);
        let weight = count * exponent.powf(-1.5) * (-exponent * nearest).exp();
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

/// Returns the exponents of the first `number` modes; `None` if there are fewer modes.
fn truncated(balanced: &DMatrix<f64>, number: usize) -> Option<Vec<f64>> {
    (number <= balanced.nrows()).then(|| {
        let block = balanced.view((0, 0), (number, number)).into_owned();
        block.symmetric_eigenvalues().iter().copied().collect()
    })
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
                    // Checks the kinks, which the densities add up to, between the samples of the fit.
                    for i in 0..400 {
                        let y = nearest * 1.02_f64.powi(i);
                        let (s, c) = ((-0.5 * y).exp(), (-(-y).exp_m1()).sqrt());
                        let pairs = powers.exponents.iter().zip(&powers.factors);
                        let sum: f64 = pairs.map(|(mu, a)| a * (-mu * y).exp()).sum();
                        let error = sum - (kernel.kink)(s, c);
                        // ∫₀¹ of the kernel, at most 2, scales the error.
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

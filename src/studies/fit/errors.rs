//! Errors of the keys at the minimum: standard errors, correlations,
//! and how many points each data set spends on the keys.
//!
//! # Formula
//!
//! ```text
//! J = ∂z/∂θ,  z = (measured − simulated)/σ      by central differences
//! Φ = (JᵀJ)⁻¹
//! h = diag(J Φ Jᵀ)                              Σh over all points is p, the number of keys
//! ν = points − Σh                               of each data set
//! σ² = Σ(measured − simulated)²/ν
//! Λ = Σ (2/ν) Φ (A − AΦA) Φ,  A = JᵀJ           over the data sets whose σ is not given
//! covariance = s² (Φ + 2Λ),  s² = Σz²/(n − p)
//! ```
//!
//! σ² is W. Förstner's estimate of variance components (1979, Allg. Vermessungs-Nachr. 86, 446–453). The mean
//! square alone is too small for the set that determines the keys: 17 points of a scar that determine two keys
//! leave ν = 15, and a loop of 20 points next to it all of its 20. Since the σ are estimated, so are the weights of
//! the sets; Λ is what that adds to the variance of the keys, and by as much Φ of estimated weights is too small:
//! M. G. Kenward, J. H. Roger (1997), Biometrics 53, 983–997. One set has nothing to be weighed against, Λ = 0.
//!
//! With the robust loss ρ = 2(√(1 + z²) − 1), ψ = z/√(1 + z²), s² is Σψ²/(n − p)/(mean ψ′)²:
//! P. J. Huber (1981), *Robust Statistics*, ch. 7.6.

use std::ops::Range;

use nalgebra::DMatrix;

/// A key that moves the deviations by less than this per e-fold moves them by rounding alone.
const NO_INFLUENCE: f64 = 1e-6;

/// Error analysis at a minimum.
#[derive(Debug)]
pub(super) struct ErrorAnalysis {
    /// Covariance of the keys; 0 for a key that the data do not determine.
    pub covariance: DMatrix<f64>,
    /// h of every point: how far the keys follow it.
    pub leverages: Vec<f64>,
    /// Φ Jᵀ: the motion of a key for a change of z; 0 for a key that the data do not determine.
    gain: DMatrix<f64>,
}

impl ErrorAnalysis {
    /// Computes the errors from z at the minimum, its derivatives by each key, `None` for a held key, and the points of
    /// each data set whose σ is estimated.
    pub fn new(
        z: &[f64],
        derivatives: &[Option<Vec<f64>>],
        estimated: &[Range<usize>],
        robust: bool,
    ) -> Self {
        let keys = derivatives.len();
        let norm = |column: &Vec<f64>| column.iter().map(|d| d * d).sum::<f64>().sqrt();
        let columns = derivatives.iter();
        let norms = columns.map(|column| column.as_ref().map_or(0.0, norm));
        let norms: Vec<f64> = norms.collect();
        let seen: Vec<usize> = (0..keys).filter(|&i| norms[i] > NO_INFLUENCE).collect();
        // Columns of length 1: keys may differ by many powers of ten.
        let jacobian = DMatrix::from_fn(z.len(), seen.len(), |row, i| {
            let column = derivatives[seen[i]].as_deref().unwrap_or_default();
            column.get(row).copied().unwrap_or(0.0) / norms[seen[i]]
        });
        let normal = jacobian.transpose() * &jacobian;
        let mut errors = Self {
            covariance: DMatrix::zeros(keys, keys),
            leverages: vec![0.0; z.len()],
            gain: DMatrix::zeros(keys, z.len()),
        };
        let Some(inverse) = normal.cholesky().map(|factors| factors.inverse()) else {
            return errors;
        };
        for (row, leverage) in errors.leverages.iter_mut().enumerate() {
            let row = jacobian.row(row);
            *leverage = (row * &inverse * row.transpose())[(0, 0)];
        }
        let gain = &inverse * jacobian.transpose();
        for (i, &of) in seen.iter().enumerate() {
            errors.gain.set_row(of, &(gain.row(i) / norms[of]));
        }
        let mut covariance = inverse.clone();
        for points in estimated {
            let spent: f64 = errors.leverages[points.clone()].iter().sum();
            let rows = jacobian.rows(points.start, points.len());
            let information = rows.transpose() * rows;
            let weighed = &information - &information * &inverse * &information;
            let freedom = degrees_of_freedom(points.len(), spent);
            covariance += (4.0 / freedom) * (&inverse * weighed * &inverse);
        }
        covariance *= variance(z, seen.len(), robust);
        for (i, &of) in seen.iter().enumerate() {
            for (j, &and) in seen.iter().enumerate() {
                errors.covariance[(of, and)] = covariance[(i, j)] / (norms[of] * norms[and]);
            }
        }
        errors
    }

    /// The standard error of a key; 0 where the data do not determine it.
    pub fn standard_error(&self, key: usize) -> f64 {
        self.covariance[(key, key)].sqrt()
    }

    /// How far the minimum moves where z changes by `dz`.
    pub fn newton_step(&self, dz: &[f64]) -> Vec<f64> {
        let dot = |row: usize| {
            self.gain
                .row(row)
                .iter()
                .zip(dz)
                .map(|(gain, dz)| gain * dz)
                .sum::<f64>()
        };
        (0..self.gain.nrows()).map(|row| -dot(row)).collect()
    }
}

/// Returns ν of a data set of `points` that has `spent` Σh on the keys; at least 1, since a set that the keys fit at
/// every point says nothing about its error.
pub(super) fn degrees_of_freedom(points: usize, spent: f64) -> f64 {
    (points as f64 - spent).max(1.0)
}

/// Returns s², the variance of z estimated from its size at the minimum of `keys`.
fn variance(z: &[f64], keys: usize, robust: bool) -> f64 {
    let freedom = (z.len() - keys.min(z.len() - 1)) as f64;
    if !robust {
        return z.iter().map(|z| z * z).sum::<f64>() / freedom;
    }
    let root = |z: f64| z.hypot(1.0);
    let squares: f64 = z.iter().map(|&z| (z / root(z)).powi(2)).sum();
    let slopes: f64 = z.iter().map(|&z| root(z).powi(-3)).sum();
    squares / freedom / (slopes / z.len() as f64).powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A straight line y = a + b x through x = 1 … 5: var b = s²/Σ(x − x̄)² = s²/10.
    #[test]
    fn a_straight_line_has_the_errors_of_the_textbook() {
        let z = [0.1, -0.2, 0.2, -0.2, 0.1];
        let x: Vec<f64> = (1..=5).map(f64::from).collect();
        // A single set has no weight relative to others.
        let set = 0..5;
        let estimated = std::slice::from_ref(&set);
        let errors =
            ErrorAnalysis::new(&z, &[Some(vec![1.0; 5]), Some(x.clone())], estimated, false);
        let variance = 0.14 / 3.0;
        let close = |found: f64, exact: f64| assert!((found / exact - 1.0).abs() < 1e-12);
        close(errors.covariance[(1, 1)], variance / 10.0);
        close(errors.covariance[(0, 0)], variance * (0.2 + 9.0 / 10.0));
        close(errors.covariance[(0, 1)], -variance * 3.0 / 10.0);
        for (h, x) in errors.leverages.iter().zip(x) {
            close(*h, 0.2 + (x - 3.0).powi(2) / 10.0);
        }
        close(errors.leverages.iter().sum(), 2.0);
        // z + 3 + 2x has a minimum that is lower by 3 and 2.
        let dz: Vec<f64> = (1..=5).map(|x| 3.0 + 2.0 * f64::from(x)).collect();
        let step = errors.newton_step(&dz);
        close(step[0], -3.0);
        close(step[1], -2.0);
    }

    #[test]
    fn a_key_without_influence_has_no_covariance() {
        let z = [0.1, -0.2, 0.2, -0.2];
        let errors = ErrorAnalysis::new(
            &z,
            &[Some(vec![1.0; 4]), Some(vec![0.0; 4]), None],
            &[],
            false,
        );
        assert!(errors.covariance[(0, 0)] > 0.0);
        assert_eq!(errors.covariance[(1, 1)], 0.0);
        assert_eq!(errors.covariance[(2, 2)], 0.0);
        let twins = ErrorAnalysis::new(&z, &[Some(vec![1.0; 4]), Some(vec![1.0; 4])], &[], false);
        assert_eq!(twins.covariance[(0, 0)], 0.0);
    }

    /// The mean of two sets of m and n values: h = 1/(m + n) and A − AΦA = mn/(m + n) of either.
    #[test]
    fn weights_that_are_estimated_add_to_the_variance() {
        let z = [0.3, -0.3, 0.3, -0.3, 0.3, -0.3, 0.3, -0.3];
        let ones = [Some(vec![1.0; 8])];
        let given = ErrorAnalysis::new(&z, &ones, &[], false).covariance[(0, 0)];
        let weighed = ErrorAnalysis::new(&z, &ones, &[0..2, 2..8], false).covariance[(0, 0)];
        let (m, n) = (2.0, 6.0);
        let freedom = |points: f64| points - points / 8.0;
        let added = 4.0 * (1.0 / freedom(m) + 1.0 / freedom(n)) * (m * n / 8.0) / 8.0;
        assert!(
            (weighed / given - 1.0 - added).abs() < 1e-12,
            "{weighed} {given}"
        );
    }

    /// Small z: ρ is z², and the robust errors equal the errors of least squares.
    #[test]
    fn the_robust_variance_of_small_residuals_is_the_plain_one() {
        let z: Vec<f64> = (1..40).map(|i| 1e-3 * f64::from(i).sin()).collect();
        let ratio = variance(&z, 2, true) / variance(&z, 2, false);
        assert!((ratio - 1.0).abs() < 1e-5, "{ratio}");
    }
}

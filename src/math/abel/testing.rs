//! What the tests of several methods share.

use nalgebra::{DMatrix, DVector};

/// The product of weights and nodal values.
pub(super) fn apply(weights: &DMatrix<f64>, values: &[f64]) -> Vec<f64> {
    (weights * DVector::from_column_slice(values))
        .iter()
        .copied()
        .collect()
}

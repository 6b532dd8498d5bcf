//! Helpers shared by the tests of several methods.

use nalgebra::{DMatrix, DVector};

/// Multiplies weights and nodal values.
pub(super) fn apply(weights: &DMatrix<f64>, values: &[f64]) -> Vec<f64> {
    (weights * DVector::from_column_slice(values))
        .iter()
        .copied()
        .collect()
}

/// Applies an operator to nodal values.
pub(super) fn image(values: &[f64], of: impl Fn(&[f64], &mut [f64])) -> Vec<f64> {
    let mut out = vec![f64::NAN; values.len()];
    of(values, &mut out);
    out
}

/// Builds an operator's matrix column by column, from its images of unit vectors.
pub(super) fn matrix(size: usize, of: impl Fn(&[f64], &mut [f64])) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(size, size);
    for (i, mut column) in matrix.column_iter_mut().enumerate() {
        let mut one = vec![0.0; size];
        one[i] = 1.0;
        column.copy_from_slice(&image(&one, &of));
    }
    matrix
}

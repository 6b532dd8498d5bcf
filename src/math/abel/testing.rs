//! Helpers shared by the tests of several methods.

use nalgebra::{DMatrix, DVector};

use super::kink::{self, Kink};

/// The product of weights and nodal values.
pub(super) fn apply(weights: &DMatrix<f64>, values: &[f64]) -> Vec<f64> {
    (weights * DVector::from_column_slice(values))
        .iter()
        .copied()
        .collect()
}

/// The cell in which a load on nodes with the squares `t` ends, at a = 1, and its kinks there.
pub(super) fn ending_at_one(t: &[f64], load: &[f64]) -> (usize, Vec<Kink>) {
    let cell = t.partition_point(|&t| t <= 1.0) - 1;
    let mut kinks = Vec::new();
    let (ends, values) = ([t[cell], t[cell + 1]], [load[cell], 0.0]);
    kink::polyline(ends, values, &[(1.0, 0.0)], &mut kinks);
    (cell, kinks)
}

//! What the tests of several methods share.

use nalgebra::{DMatrix, DVector};

use crate::math::grid::RadialGrid;

/// The product of weights and nodal values.
pub(super) fn apply(weights: &DMatrix<f64>, values: &[f64]) -> Vec<f64> {
    (weights * DVector::from_column_slice(values))
        .iter()
        .copied()
        .collect()
}

/// Worn flat between c and b, unworn beyond: falling in t to a rim, where it ends.
pub(super) fn kinked(grid: &RadialGrid, rim: f64) -> Vec<f64> {
    let length = grid.radius();
    grid.squares()
        .iter()
        .map(|t| length * (0.1 * (rim - t / (length * length))).max(0.0))
        .collect()
}

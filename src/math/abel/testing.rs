//! What the tests of several methods share.

use nalgebra::{DMatrix, DVector};

use super::bend::{self, Bend};
use crate::math::grid::RadialGrid;

/// The product of weights and nodal values.
pub(super) fn apply(weights: &DMatrix<f64>, values: &[f64]) -> Vec<f64> {
    (weights * DVector::from_column_slice(values))
        .iter()
        .copied()
        .collect()
}

/// The cell in which a load on nodes with the squares `t` ends, at a = 1, and its breaks there.
pub(super) fn ending_at_one(t: &[f64], load: &[f64]) -> (usize, Vec<Bend>) {
    let cell = t.partition_point(|&t| t <= 1.0) - 1;
    let mut breaks = Vec::new();
    let (ends, values) = ([t[cell], t[cell + 1]], [load[cell], 0.0]);
    bend::polyline(ends, values, &[(1.0, 0.0)], &mut breaks);
    (cell, breaks)
}

/// Worn flat between c and b, unworn beyond: falling in t to a rim, where it ends.
pub(super) fn kinked(grid: &RadialGrid, rim: f64) -> Vec<f64> {
    let length = grid.radius();
    grid.squares()
        .iter()
        .map(|t| length * (0.1 * (rim - t / (length * length))).max(0.0))
        .collect()
}

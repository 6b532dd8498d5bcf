//! Method A of the paper: weakens the singularity of Eq. (2) by splitting u in two.
//!
//! # Formula
//!
//! Eq. (7), after V. I. Krylov (1962): with u = x u′ + (u − x u′) in each cell and u′ by forward
//! differences,
//!
//! ```text
//! w_j = (2/π) Σ_{k<j} { u′_k [√(r_j² − x_k²) − √(r_j² − x_{k+1}²)]
//!                     + (u_k − u′_k x_k) [asin(x_{k+1}/r_j) − asin(x_k/r_j)] }
//! ```
//!
//! This integrates the piecewise linear u exactly. For Eqs. (1) and (3) see [`benad`](super::benad).
//!
//! - **Order**, in the largest error over smooth data: 2. At a kink that falls between nodes: 3/2.
//! - **At r = 0**: w = u(0).
//! - **At the contact edge**: nothing special, since u is a displacement and has no jump.
//! - **Known failure**: none in fretting; the row sums are one, so a rigid shift maps to itself.

use std::f64::consts::FRAC_2_PI;

use nalgebra::DMatrix;

use super::kernel::{asin_step, displacement_by_cells, root_step};

/// Eq. (2): weights of the surface displacement.
pub fn displacement(nodes: &[f64]) -> DMatrix<f64> {
    displacement_by_cells(nodes, |a, b, r| {
        let arc = asin_step(a, b, r);
        // ∫ (x − a)/(b − a) dx/√(r² − x²): the right node's share.
        let right = (root_step(a, b, r) - a * arc) / (b - a);
        [FRAC_2_PI * (arc - right), FRAC_2_PI * right]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_exact_and_a_shift_maps_to_itself() {
        let nodes: Vec<f64> = (0..=30).map(|i| f64::from(i) / 30.0).collect();
        let weights = displacement(&nodes);
        for (j, &r) in nodes.iter().enumerate() {
            let shift: f64 = weights.row(j).iter().sum();
            assert!((shift - 1.0).abs() < 1e-14);
            let line: f64 = weights.row(j).iter().zip(&nodes).map(|(w, x)| w * x).sum();
            assert!((line - FRAC_2_PI * r).abs() < 1e-14);
        }
    }
}

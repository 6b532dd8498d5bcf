//! Method B of the paper: takes the kernel under the differential, the rest by trapezoids.
//!
//! # Formula
//!
//! Eqs. (11) to (13). The factor before the sum of (11) is x_j; the paper's x_k is a misprint:
//!
//! ```text
//! g_j = f_0 + x_j Σ_{k≤j} ½(f′_{k−1} + f′_k) [asin(r_k/x_j) − asin(r_{k−1}/x_j)]
//! w_j = (2/π) Σ_{k≤j} ½(u_{k−1} + u_k) [asin(x_k/r_j) − asin(x_{k−1}/r_j)]
//! p_j = −(1/π) Σ_{k>j} ½(q′_{k−1} + q′_k) [acosh(x_k/r_j) − acosh(x_{k−1}/r_j)]
//! ```
//!
//! First derivatives by central differences, zero at r = 0 (everything is even in r), one-sided at
//! the domain's edge.
//!
//! - **Order**, in the largest error over smooth data: 3/2 in g, p and w; 1 in g of a cone, whose slope
//!   at the tip is taken as zero. At a kink that falls between nodes: ½ in g and p, 3/2 in w.
//! - **At r = 0**: g = f(0), w = u(0); in p the first cell takes q′ ∝ x, so the integral is finite.
//! - **At the contact edge**: the central difference smears the edge over two cells.
//! - **Known failure**: a central difference reaches one node across the stick border, so wear outside it
//!   changes g inside, and the worn ring grows into the permanent stick zone. The response of p to f has
//!   near-null modes, so a sawtooth grows at large wear coefficients.

use std::f64::consts::{FRAC_1_PI, FRAC_2_PI};

use nalgebra::DMatrix;

use super::kernel::{
    acosh_step, add_jump_at_rim, asin_step, central_difference, displacement_by_cells,
};

/// Eq. (11): weights of the 1D profile.
pub fn profile(nodes: &[f64]) -> DMatrix<f64> {
    let mut weights = DMatrix::zeros(nodes.len(), nodes.len());
    for (j, &x) in nodes.iter().enumerate() {
        weights[(j, 0)] = 1.0;
        for k in 1..=j {
            let half = 0.5 * x * asin_step(nodes[k - 1], nodes[k], x);
            for end in [k - 1, k] {
                for (i, difference) in central_difference(nodes, end) {
                    weights[(j, i)] += half * difference;
                }
            }
        }
    }
    weights
}

/// Eq. (12): weights of the surface displacement.
pub fn displacement(nodes: &[f64]) -> DMatrix<f64> {
    displacement_by_cells(nodes, |a, b, r| [0.5 * FRAC_2_PI * asin_step(a, b, r); 2])
}

/// Eq. (13): weights of the stress. The line load ends at the last node.
pub fn stress(nodes: &[f64]) -> DMatrix<f64> {
    let last = nodes.len() - 1;
    let mut weights = DMatrix::zeros(nodes.len(), nodes.len());
    for (j, &r) in nodes.iter().enumerate() {
        for k in j + 1..=last {
            let (a, b) = (nodes[k - 1], nodes[k]);
            // In the first cell at r = 0: q′ = q′_1 x/x_1, and ∫ q′/x dx = q′_1, where q′_0 = 0.
            let half = if a == 0.0 && r == 0.0 {
                1.0
            } else {
                0.5 * acosh_step(a, b, r)
            };
            for end in [k - 1, k] {
                for (i, difference) in central_difference(nodes, end) {
                    weights[(j, i)] -= FRAC_1_PI * half * difference;
                }
            }
        }
    }
    add_jump_at_rim(&mut weights, nodes);
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_paraboloid_has_exact_derivatives_and_a_shift_maps_to_itself() {
        let nodes: Vec<f64> = (0..=50).map(|i| f64::from(i) / 50.0).collect();
        let weights = profile(&nodes);
        for (j, &x) in nodes.iter().enumerate().skip(5).take(40) {
            let shift: f64 = weights.row(j).iter().sum();
            assert!((shift - 1.0).abs() < 1e-12);
            let bowl: f64 = weights
                .row(j)
                .iter()
                .zip(&nodes)
                .map(|(w, r)| w * r * r)
                .sum();
            // f = r² gives g = 2x²; the trapezoidal error remains, of order 3/2.
            let bound = 0.3 * (nodes[1] / x).powf(1.5);
            assert!((bowl / (2.0 * x * x) - 1.0).abs() < bound, "{x}: {bowl}");
        }
    }
}

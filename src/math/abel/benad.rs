//! Integration by parts: integrates the singular kernel once more and differentiates the data.
//!
//! J. Benad (2018), Fast numerical implementation of the MDR transformations, Facta Univ. Mech.
//! Eng. 16(2), 127–138: the paper's reference 9.
//!
//! # Formula
//!
//! ```text
//! g(x) = x [ (π/2) f′(x) − ∫₀ˣ f″(r) asin(r/x) dr ]
//! w(r) = u(r) − (2/π) ∫₀ʳ u′(x) asin(x/r) dx
//! p(r) = (1/π) [ ∫ᵣᵃ q″(x) acosh(x/r) dx − q′(a⁻) acosh(a/r) ]
//! ```
//!
//! With central second differences and trapezoids, Benad's g and p equal the exact integral of the piecewise linear
//! interpolant (summation by parts), and are computed in that form:
//!
//! ```text
//! g_j = f_0 + x_j Σ_{k<j} (Δf_k/Δr_k) [asin(r_{k+1}/x_j) − asin(r_k/x_j)]
//! p_j = −(1/π) Σ_{k≥j} (Δq_k/Δx_k) [acosh(x_{k+1}/r_j) − acosh(x_k/r_j)]
//! ```
//!
//! His w is computed as published: u′ by central differences, the integral by trapezoids.
//!
//! - **Order**, in the largest error over smooth data: 3/2 in g, p and w (1 in p at r = 0). At a kink
//!   that falls between nodes: ½ in g and p, 1 in w.
//! - **At r = 0**: g = f(0), w = u(0). In p the first cell takes q as linear in x² (q′ = O(x)), since
//!   the integral would diverge otherwise; for a cone, whose p(0) is infinite, the result is finite and
//!   grows like ln N.
//! - **At the contact edge**: q falls linearly to zero in the cell that contains the edge.
//! - **Known failure**: w looks one node ahead and inverts g badly: the round trip f → g → f has a
//!   spectral radius that grows with N (13, 19, 28 at N = 50, 100, 200), so fretting runs diverge.

use std::f64::consts::{FRAC_1_PI, FRAC_2_PI, FRAC_PI_2};

use nalgebra::DMatrix;

use super::kernel::{acosh_step, asin_step, central_difference, profile_by_steps, stress_by_steps};

/// Eq. (1): weights of the 1D profile.
pub fn profile(nodes: &[f64]) -> DMatrix<f64> {
    profile_by_steps(nodes, |a, b, x| x * asin_step(a, b, x) / (b - a))
}

/// Eq. (2): weights of the surface displacement.
pub fn displacement(nodes: &[f64]) -> DMatrix<f64> {
    let mut weights = DMatrix::zeros(nodes.len(), nodes.len());
    weights[(0, 0)] = 1.0;
    for (j, &r) in nodes.iter().enumerate().skip(1) {
        weights[(j, j)] = 1.0;
        for k in 1..=j {
            let left = nodes[k] - nodes[k - 1];
            let right = if k < j { nodes[k + 1] - nodes[k] } else { 0.0 };
            let arc = if k == j {
                FRAC_PI_2
            } else {
                (nodes[k] / r).asin()
            };
            let weight = FRAC_2_PI * 0.5 * (left + right) * arc;
            for (i, difference) in central_difference(nodes, k) {
                weights[(j, i)] -= weight * difference;
            }
        }
    }
    weights
}

/// Eq. (3): weights of the stress. The line load ends at the last node; if it is not zero there, it jumps, as at the
/// rim of a punch.
pub fn stress(nodes: &[f64]) -> DMatrix<f64> {
    stress_by_steps(nodes, |a, b, r| {
        // ∫ q′ dx/√(x² − r²) over the cell, with q linear in x, or in x² where r = a = 0.
        let integral = if b > 0.0 && a == 0.0 && r == 0.0 {
            2.0
        } else {
            acosh_step(a, b, r)
        };
        FRAC_1_PI * integral / (b - a)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn uniform(cells: usize) -> Vec<f64> {
        (0..=cells).map(|i| i as f64 / cells as f64).collect()
    }

    /// Compares the formula as Benad prints it, with f″ by central differences, with the summed form.
    #[test]
    fn summation_by_parts_changes_nothing() {
        let nodes = uniform(40);
        let h = nodes[1];
        let f: Vec<f64> = nodes.iter().map(|r| (3.0 * r).sin() + r * r).collect();
        let x = nodes[25];
        let mut printed = FRAC_PI_2 * (f[25] - f[24]) / h;
        for k in 1..25 {
            let second = (f[k + 1] - 2.0 * f[k] + f[k - 1]) / (h * h);
            printed -= h * second * (nodes[k] / x).asin();
        }
        let ours: f64 = profile(&nodes)
            .row(25)
            .iter()
            .zip(&f)
            .map(|(weight, value)| weight * value)
            .sum();
        assert!((ours - f[0] - x * printed).abs() < 1e-13);
    }

    /// §3 of the physics notes gives 13, 19, 28: why the method fails in fretting.
    #[test]
    fn the_round_trip_has_a_growing_spectral_radius() {
        for (cells, expected) in [(50, 13.0), (100, 19.0), (200, 28.0)] {
            let nodes = uniform(cells);
            let round_trip = displacement(&nodes) * profile(&nodes);
            let radius = round_trip
                .complex_eigenvalues()
                .iter()
                .map(|value| value.re.hypot(value.im))
                .fold(0.0, f64::max);
            assert!((radius - expected).abs() < 1.0, "N = {cells}: {radius}");
        }
    }
}

//! The largest stiffness that each method tolerates, known before a step is taken.
//!
//! # Formula
//!
//! The pressure responds to a worn depth δ by −E* M δ, with M the matrix of Eq. (3) after Eq. (1).
//! With its largest eigenvalue ρ/h, h the cell width, and the response ∂Δf/∂τ of wear to stress,
//! the feedback is z = ρ μ E* ∂Δf/∂τ/h. A step multiplies the stiffest error by the largest root λ
//! of
//!
//! ```text
//! Euler:      λ = 1 − z                                       stable for z < 2
//! trapezoid:  λ³ − λ² + ½z (2λ² + λ − 1) = 0                  stable for z < 2/√3
//! ```
//!
//! the second for the mean of two stresses, each on an extrapolated profile. For the methods product, a, a+b and benad,
//! all eigenvalues of M are positive; for method b some are close to 0.
//!
//! ρ also holds on graded cells with the actual slip of a step: the largest eigenvalue of diag(∂Δf/∂τ) μE*M on the grid
//! of a run is 0.9 to 1.05 of the largest z of its nodes, unworn and worn (Fig. 3, methods product and a).

use super::choices::Scheme;

/// Returns the largest z of a stable step.
pub fn limit(scheme: Scheme) -> f64 {
    match scheme {
        Scheme::Euler => 2.0,
        Scheme::Trapezoid => 2.0 / 3.0_f64.sqrt(),
    }
}

#[cfg(test)]
mod tests {
    use crate::math::abel::{AbelMethod, AbelPlan};
    use crate::math::grid::RadialGrid;
    use nalgebra::DMatrix;

    /// Returns M h on equal cells, with a contact of three quarters of them; leaves out r = 0, which never wears.
    fn response_matrix(method: AbelMethod, cells: usize) -> DMatrix<f64> {
        let grid = RadialGrid::uniform(cells, 1.0).expect("a grid");
        let plan = AbelPlan::new(method, &grid);
        let (nodes, contact) = (grid.len(), cells * 3 / 4);
        let mut matrix = DMatrix::zeros(contact - 1, contact - 1);
        let (mut load, mut stress) = (vec![0.0; nodes], vec![0.0; nodes]);
        for j in 1..contact {
            let mut worn = vec![0.0; nodes];
            worn[j] = 1.0;
            plan.profile(&worn, &mut load);
            load[contact..].fill(0.0);
            plan.stress(&load, &mut stress);
            for i in 1..contact {
                matrix[(i - 1, j - 1)] = stress[i] / cells as f64;
            }
        }
        matrix
    }

    #[test]
    fn the_response_is_the_largest_eigenvalue_of_each_method() {
        for method in AbelMethod::ALL {
            let eigenvalues = response_matrix(method, 100).complex_eigenvalues();
            let largest = eigenvalues
                .iter()
                .map(|z| z.re.hypot(z.im))
                .fold(0.0, f64::max);
            let error = (method.traits().response / largest - 1.0).abs();
            assert!(error < 0.02, "{method}: {largest}");
            let smallest = eigenvalues
                .iter()
                .map(|z| z.re)
                .fold(f64::INFINITY, f64::min);
            assert_eq!(
                smallest > 1e-3,
                method != AbelMethod::B,
                "{method}: {smallest}"
            );
        }
    }
}

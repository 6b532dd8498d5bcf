//! The stiffness that each method tolerates, known before the step is taken.
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
//! the second for the mean of two stresses, each on an extrapolated profile. For methods product,
//! a, a+b and benad, all eigenvalues of M are positive; for method b some are close to 0.
//!
//! ρ holds on graded cells with the slip of a step as it is: the largest eigenvalue of diag(∂Δf/∂τ) μE*M on the grid
//! of a run is 0.9 to 1.05 of the largest z of its nodes, unworn and worn (Fig. 3, methods product and a).
//!
//! Methods b and benad develop a sawtooth that no step limit explains, once the contact has worn by
//! [this depth](sawtooth_from).

use nalgebra::Matrix3;

use super::Setup;
use super::choices::Scheme;
use crate::math::abel::AbelMethod;

/// ρ: the largest eigenvalue of the response of p to wear, times the cell's width.
pub fn response(method: AbelMethod) -> f64 {
    match method {
        AbelMethod::Product | AbelMethod::A | AbelMethod::APlusB | AbelMethod::Benad => 1.51,
        AbelMethod::B => 0.34,
    }
}

/// Why even the shortest steps do not keep a method from a sawtooth; `None` if they do.
pub fn beyond_steps(method: AbelMethod) -> Option<&'static str> {
    match method {
        AbelMethod::Product | AbelMethod::A | AbelMethod::APlusB => None,
        AbelMethod::B => Some(
            "its differences reach across the stick border and wear the \
            permanent stick zone",
        ),
        AbelMethod::Benad => Some("its Eq. (2) adds the unevenness of the springs in every cycle"),
    }
}

/// The wear at which a method shows a sawtooth whatever the step, at the rate of a cycle of the unworn contact and
/// relative to the largest depth. `None` if short steps prevent it.
///
/// Measured, not derived: on the motion of Fig. 3 with 20 cycles, at N from 25 to 200 and 50 to 400 steps a
/// cycle, 0.38 to 0.44 with b and 0.038 to 0.055 with benad. The eigenvalues of what a cycle wears by a given profile
/// are those of the other methods with b, and change fourfold with N with benad, so that they tell neither.
/// On other motions they may be off by more than 1.5.
pub fn sawtooth_from(method: AbelMethod) -> Option<f64> {
    match method {
        AbelMethod::Product | AbelMethod::A | AbelMethod::APlusB => None,
        AbelMethod::B => Some(0.4),
        AbelMethod::Benad => Some(0.045),
    }
}

/// G for p = 1 Pa: a spring that slips holds u = μq/G*, so that wear by δ lets the surface slip by μE*δ/G* more,
/// and that wears G = kμ²pE*/G* times δ. None under a law that is not in proportion to friction work.
pub fn gain(setup: &Setup) -> Option<f64> {
    let law = setup.wear.filter(|law| law.follows_energy())?;
    let (material, friction) = (&setup.material, setup.material.friction());
    let moduli = material.normal_modulus() / material.tangential_modulus();
    Some(law.coefficient() * friction * friction * moduli)
}

/// The largest z of a stable step.
pub fn limit(scheme: Scheme) -> f64 {
    match scheme {
        Scheme::Euler => 2.0,
        Scheme::Trapezoid => 2.0 / 3.0_f64.sqrt(),
    }
}

/// By how much a step of the stiffness z multiplies the stiffest error.
pub fn amplification(scheme: Scheme, z: f64) -> f64 {
    match scheme {
        Scheme::Euler => (1.0 - z).abs(),
        Scheme::Trapezoid => {
            let companion = Matrix3::new(1.0 - z, -0.5 * z, 0.5 * z, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0);
            let roots = companion.complex_eigenvalues();
            roots.iter().map(|root| root.norm()).fold(0.0, f64::max)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::abel::AbelPlan;
    use crate::math::grid::RadialGrid;
    use nalgebra::DMatrix;

    /// M h on equal cells, within a contact of three quarters of them; r = 0, which never wears, left out.
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
            let largest = eigenvalues.iter().map(|z| z.norm()).fold(0.0, f64::max);
            let error = (response(method) / largest - 1.0).abs();
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

    #[test]
    fn errors_grow_beyond_the_limit_and_not_before() {
        for scheme in Scheme::ALL {
            let limit = limit(scheme);
            assert!(
                (amplification(scheme, limit) - 1.0).abs() < 1e-9,
                "{scheme}"
            );
            assert!(amplification(scheme, 0.99 * limit) < 1.0, "{scheme}");
            assert!(amplification(scheme, 1.01 * limit) > 1.0, "{scheme}");
        }
    }
}

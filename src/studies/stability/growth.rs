//! Whether errors grow over a cycle.

use nalgebra::Matrix3;

use crate::math::scan::largest;
use crate::simulation::Scheme;
use crate::simulation::stability::limit;

/// Number of steps of one percent in the search for the boundary, from where the stiffest step has its limit.
const REACH: i32 = 300;

/// Returns the smallest factor on the stiffness z of every step
/// for which errors grow over a cycle; `None` if there is none.
pub(super) fn growing_from(scheme: Scheme, stiffness: &[f64]) -> Option<f64> {
    let stiffest = largest(stiffness);
    if stiffest <= 0.0 {
        return None;
    }
    let at_limit = limit(scheme) / stiffest;
    let factor = |rung: i32| at_limit * 1.01_f64.powi(rung);
    let grows = |rung: i32| {
        let logs = stiffness.iter();
        let logs = logs.map(|z| amplification(scheme, factor(rung) * z).ln());
        logs.sum::<f64>() > 0.0
    };
    (0..REACH).find(|&rung| grows(rung)).map(factor)
}

/// Returns the factor by which a step of stiffness z multiplies the stiffest error: the largest root λ of the
/// [polynomial of its scheme](crate::simulation::stability).
fn amplification(scheme: Scheme, z: f64) -> f64 {
    match scheme {
        Scheme::Euler => (1.0 - z).abs(),
        Scheme::Trapezoid => {
            let companion = Matrix3::new(1.0 - z, -0.5 * z, 0.5 * z, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0);
            let roots = companion.complex_eigenvalues();
            let sizes = roots.iter().map(|root| root.re.hypot(root.im));
            sizes.fold(0.0, f64::max)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_steps_grow_from_their_limit() {
        for scheme in Scheme::ALL {
            for z in [1e-3, 1.0] {
                let factor = growing_from(scheme, &[z; 10]).expect("a factor");
                assert!((factor * z / limit(scheme) - 1.0).abs() < 0.02, "{scheme}");
            }
        }
    }

    #[test]
    fn steps_that_damp_make_up_for_others() {
        let mixed = growing_from(Scheme::Euler, &[1.0, 0.3, 0.3]).expect("a factor");
        assert!(mixed > 2.02, "{mixed}");
        assert_eq!(growing_from(Scheme::Euler, &[0.0, 0.0]), None);
        assert_eq!(growing_from(Scheme::Euler, &[]), None);
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

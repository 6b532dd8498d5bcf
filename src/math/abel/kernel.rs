//! Integrates the Abel kernels over one cell without cancellation, and gives difference formulas.

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2};

use nalgebra::DMatrix;

/// √(b² − a²) for 0 ≤ a ≤ b.
pub(super) fn leg(a: f64, b: f64) -> f64 {
    ((b - a) * (b + a)).sqrt()
}

/// ∫ₐᵇ dx/√(r² − x²) = asin(b/r) − asin(a/r), for 0 ≤ a ≤ b ≤ r.
///
/// Uses the addition theorem: the sine of the difference is
/// (b² − a²)/(b√(r²−a²) + a√(r²−b²)), in which nothing cancels.
pub(super) fn asin_step(a: f64, b: f64, r: f64) -> f64 {
    if a == 0.0 {
        return if b == r { FRAC_PI_2 } else { (b / r).asin() };
    }
    let (to_a, to_b) = (leg(a, r), leg(b, r));
    let sine = (b - a) * (b + a) / (b * to_a + a * to_b);
    let cosine = (a * b + to_a * to_b) / (r * r);
    sine.atan2(cosine)
}

/// ∫ₐᵇ x dx/√(r² − x²) = √(r² − a²) − √(r² − b²), for 0 ≤ a ≤ b ≤ r.
pub(super) fn root_step(a: f64, b: f64, r: f64) -> f64 {
    (b - a) * (b + a) / (leg(a, r) + leg(b, r))
}

/// ∫ₐᵇ dx/√(x² − r²) = acosh(b/r) − acosh(a/r), for 0 ≤ r ≤ a < b; at r = 0 it is ln(b/a).
pub(super) fn acosh_step(a: f64, b: f64, r: f64) -> f64 {
    ((b - a) * (b + a) / (b * leg(r, a) + a * leg(r, b))).asinh()
}

/// ∫ₐᵇ (x² − a²) dx/√(r² − x²) = (r²/2 − a²) [asin(b/r) − asin(a/r)] − ½ [b√(r²−b²) − a√(r²−a²)],
/// for 0 ≤ a ≤ b ≤ r. Callers already have `arc`, the [`asin_step`] of the three; they pass it in.
pub(super) fn square_step(a: f64, b: f64, r: f64, arc: f64) -> f64 {
    let ends = (b - a) * leg(b, r) - a * root_step(a, b, r);
    (0.5 * r * r - a * a) * arc - 0.5 * ends
}

/// ∫ₐᵇ x dx/√(x² − r²) = √(b² − r²) − √(a² − r²), for 0 ≤ r ≤ a < b.
pub(super) fn outer_root_step(a: f64, b: f64, r: f64) -> f64 {
    (b - a) * (b + a) / (leg(r, a) + leg(r, b))
}

/// Makes weights of Eq. (1) from the steps of the profile over the cells [a, b] inside x, each with a `weight(a, b, x)`.
pub(super) fn profile_by_steps(
    nodes: &[f64],
    weight: impl Fn(f64, f64, f64) -> f64,
) -> DMatrix<f64> {
    let mut weights = DMatrix::zeros(nodes.len(), nodes.len());
    for (j, &x) in nodes.iter().enumerate() {
        weights[(j, 0)] = 1.0;
        for k in 0..j {
            let weight = weight(nodes[k], nodes[k + 1], x);
            weights[(j, k)] -= weight;
            weights[(j, k + 1)] += weight;
        }
    }
    weights
}

/// Makes weights of Eq. (2) from the weights `ends(a, b, r)` of the two ends of each cell [a, b] inside r.
pub(super) fn displacement_by_cells(
    nodes: &[f64],
    ends: impl Fn(f64, f64, f64) -> [f64; 2],
) -> DMatrix<f64> {
    let mut weights = DMatrix::zeros(nodes.len(), nodes.len());
    weights[(0, 0)] = 1.0;
    for (j, &r) in nodes.iter().enumerate().skip(1) {
        for k in 0..j {
            let [left, right] = ends(nodes[k], nodes[k + 1], r);
            weights[(j, k)] += left;
            weights[(j, k + 1)] += right;
        }
    }
    weights
}

/// Makes weights of Eq. (3) from the steps of the load over the cells [a, b] outside r, each with a `weight(a, b, r)`. The
/// load jumps to zero behind the last node.
pub(super) fn stress_by_steps(
    nodes: &[f64],
    weight: impl Fn(f64, f64, f64) -> f64,
) -> DMatrix<f64> {
    let mut weights = DMatrix::zeros(nodes.len(), nodes.len());
    for (j, &r) in nodes.iter().enumerate() {
        for k in j..nodes.len() - 1 {
            let weight = weight(nodes[k], nodes[k + 1], r);
            weights[(j, k)] += weight;
            weights[(j, k + 1)] -= weight;
        }
    }
    add_jump_at_rim(&mut weights, nodes);
    weights
}

/// Adds to the weights of Eq. (3) the effect of a jump of the line load from q to zero at the last node,
/// q/(π√(a² − r²)). It is infinite at the rim itself, where the mean over the last cell replaces it.
pub(super) fn add_jump_at_rim(weights: &mut DMatrix<f64>, nodes: &[f64]) {
    let last = nodes.len() - 1;
    let rim = nodes[last];
    for (j, &r) in nodes[..last].iter().enumerate() {
        weights[(j, last)] += FRAC_1_PI / leg(r, rim);
    }
    weights[(last, last)] += 2.0 * FRAC_1_PI / leg(nodes[last - 1], rim);
}

/// Returns the first derivative at node k as weights of nodal values: central differences inside, zero at r = 0 (every
/// profile is even in r), one-sided at the domain's edge.
///
/// Uses the three-point formula for unequal cells; on a uniform grid it is (v_{k+1} − v_{k−1})/2h.
pub(super) fn central_difference(nodes: &[f64], k: usize) -> [(usize, f64); 3] {
    let last = nodes.len() - 1;
    if k == 0 {
        return [(0, 0.0); 3];
    }
    if k == last {
        let width = nodes[last] - nodes[last - 1];
        return [(last - 1, -1.0 / width), (last, 1.0 / width), (last, 0.0)];
    }
    let (left, right) = (nodes[k] - nodes[k - 1], nodes[k + 1] - nodes[k]);
    let lower = -right / (left * (left + right));
    let upper = left / (right * (left + right));
    [(k - 1, lower), (k, -lower - upper), (k + 1, upper)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_the_differences_they_stand_for() {
        let (a, b, r): (f64, f64, f64) = (0.3, 0.45, 0.5);
        assert!((asin_step(a, b, r) - ((b / r).asin() - (a / r).asin())).abs() < 1e-15);
        assert!((root_step(a, b, r) - (leg(a, r) - leg(b, r))).abs() < 1e-15);
        let r = 0.2;
        assert!((acosh_step(a, b, r) - ((b / r).acosh() - (a / r).acosh())).abs() < 1e-15);
        assert!((acosh_step(a, b, 0.0) - (b / a).ln()).abs() < 1e-15);
        assert_eq!(asin_step(0.0, 0.5, 0.5), FRAC_PI_2);
        assert!((outer_root_step(a, b, r) - (leg(r, b) - leg(r, a))).abs() < 1e-15);
    }

    #[test]
    fn the_square_step_is_its_integral() {
        let (a, b, r): (f64, f64, f64) = (0.3, 0.45, 0.5);
        let (cells, mut sum) = (4000, 0.0);
        for i in 0..cells {
            let x = a + (b - a) * (f64::from(i) + 0.5) / f64::from(cells);
            sum += (x - a) * (x + a) / leg(x, r) * (b - a) / f64::from(cells);
        }
        assert!((square_step(a, b, r, asin_step(a, b, r)) - sum).abs() < 1e-9);
        // Over the whole quarter circle, ∫₀ʳ x² dx/√(r² − x²) = πr²/4.
        assert!((square_step(0.0, r, r, FRAC_PI_2) - 0.5 * FRAC_PI_2 * r * r).abs() < 1e-16);
    }

    #[test]
    fn differences_are_exact_on_parabolas() {
        let nodes = [0.0, 0.1, 0.3, 0.35, 1.0];
        for k in 1..4 {
            let slope: f64 = central_difference(&nodes, k)
                .iter()
                .map(|&(i, weight)| weight * (nodes[i] * nodes[i] - 2.0 * nodes[i]))
                .sum();
            assert!((slope - (2.0 * nodes[k] - 2.0)).abs() < 1e-13);
        }
    }
}

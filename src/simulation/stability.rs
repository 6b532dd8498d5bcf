//! How harsh a step each method bears: known before the step is taken.
//!
//! # Formula
//!
//! The pressure answers to a worn depth δ by −E* M δ, M the matrix of Eq. (3) after Eq. (1). With its
//! largest eigenvalue ρ/h, h the width of a cell, wear that answers to the stress by ∂Δf/∂τ feeds back
//! by z = ρ μ E* ∂Δf/∂τ/h. Explicit Euler multiplies the stiffest error by 1 − z in a step, and so holds
//! for z < 2.

use super::choices::Scheme;
use crate::math::abel::AbelMethod;

/// ρ: the largest eigenvalue of the response of p to wear, times the cell's width.
pub fn response(method: AbelMethod) -> f64 {
    match method {
        // 1.51 on equal cells, a little less on graded ones.
        AbelMethod::Product => 1.48,
        AbelMethod::A | AbelMethod::APlusB | AbelMethod::Benad => 1.51,
        AbelMethod::B => 0.34,
    }
}

/// The largest z of a stable step.
pub fn limit(method: AbelMethod, scheme: Scheme) -> f64 {
    let euler = match method {
        AbelMethod::Product | AbelMethod::A | AbelMethod::APlusB | AbelMethod::Benad => 2.0,
        AbelMethod::B => 2.0,
    };
    match scheme {
        Scheme::Euler => euler,
        Scheme::Trapezoid => 0.5 * euler,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::abel::AbelPlan;
    use crate::math::grid::RadialGrid;
    use nalgebra::DMatrix;

    fn matrix(method: AbelMethod, cells: usize) -> DMatrix<f64> {
        let grid = RadialGrid::uniform(cells, 1.0).expect("a grid");
        let plan = AbelPlan::new(method, &grid);
        let n = grid.len();
        let mut m = DMatrix::zeros(n, n);
        let (mut g, mut p) = (vec![0.0; n], vec![0.0; n]);
        let contact = n * 3 / 4;
        for j in 0..n {
            let mut f = vec![0.0; n];
            f[j] = 1.0;
            plan.profile(&f, &mut g);
            for k in contact..n {
                g[k] = 0.0;
            }
            plan.stress(&g, &mut p);
            for i in 0..n {
                m[(i, j)] = p[i] / cells as f64;
            }
        }
        m.view((1, 1), (contact - 1, contact - 1)).into_owned()
    }

    #[test]
    fn eig() {
        for method in AbelMethod::ALL {
            for cells in [50, 100, 200] {
                let m = matrix(method, cells);
                let e = m.complex_eigenvalues();
                let mx = e.iter().map(|z| z.norm()).fold(0.0, f64::max);
                let re = e.iter().map(|z| z.re).fold(0.0, f64::max);
                let im = e.iter().map(|z| z.im).fold(0.0, f64::max);
                let mi = e.iter().map(|z| z.re).fold(f64::INFINITY, f64::min);
                let lim = e
                    .iter()
                    .map(|z| 2.0 * z.re / z.norm_sqr())
                    .fold(f64::INFINITY, f64::min);
                eprintln!(
                    "{method} {cells}: |l| {mx:.4} re {re:.4} min re {mi:.3e} im {im:.4} strict limit {:.3e}",
                    lim * re
                );
            }
        }
    }
}

//! The cone in a load with a cusp at the tip, taken off before Eq. (3) and put back in closed form.
//!
//! # Formula
//!
//! The load of a cone, A (x − a) up to the contact's edge a and nothing beyond, has the stress
//!
//! ```text
//! p(r) = −(A/π) ∫ᵣᵃ dx/√(x² − r²) = −(A/π) acosh(a/r),     A the slope of the load at the tip
//! ```
//!
//! What is left of a load without its own cone has no cusp, and [`product::stress`](super::product::stress) is linear
//! in t = x² there as everywhere: the two together are the product rule with its cusp ended at a.
//!
//! - **Order**: exact for paraboloid, cone and their sum, wherever the edge falls.
//! - **Cost**: a logarithm a node in contact.
//! - **At r = 0**: infinite for a cone; of the first cell the line in t stands for it, 2A/π.

use std::f64::consts::FRAC_1_PI;

use super::kernel::leg;
use super::kink::{self, Kink};
use crate::math::grid::RadialGrid;

/// The cone that is in a line load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cone {
    /// A, the slope of the load (N/m) at the tip, N/m².
    pub slope: f64,
    /// a, m, beyond the second node.
    pub edge: f64,
}

/// A load without its cone.
#[derive(Debug, Clone, Default)]
pub struct Rest {
    /// N/m, nodal.
    pub load: Vec<f64>,
    /// What its kinks are beside those of the whole load, N/m.
    pub kinks: Vec<Kink>,
}

impl Cone {
    /// Takes the cone off a `load` (N/m, nodal) into `rest`.
    pub fn take_off(&self, grid: &RadialGrid, load: &[f64], rest: &mut Rest) {
        let (x, t) = (grid.nodes(), grid.squares());
        rest.load.clear();
        rest.kinks.clear();
        rest.load.extend_from_slice(load);
        let inside = x.partition_point(|&x| x < self.edge);
        for (load, x) in rest.load[..inside].iter_mut().zip(x) {
            *load += self.slope * (self.edge - x);
        }
        if inside < x.len() {
            // The line to the next node kinks where the cone ends.
            let cell = [t[inside - 1], t[inside]];
            let height = self.slope * (self.edge - x[inside - 1]);
            let edge = (self.edge * self.edge, 0.0);
            kink::polyline(cell, [height, 0.0], &[edge], &mut rest.kinks);
        }
    }

    /// Eq. (3): adds the stress of the cone to `p` (N/m²).
    pub fn add_to_stress(&self, grid: &RadialGrid, p: &mut [f64]) {
        let x = grid.nodes();
        let factor = FRAC_1_PI * self.slope;
        p[0] -= factor * (2.0 + (self.edge / x[1]).ln());
        for (p, &r) in p.iter_mut().zip(x).skip(1) {
            if r >= self.edge {
                break;
            }
            // acosh(a/r) = ln(1 + (a − r + √(a² − r²))/r)
            *p -= factor * ((self.edge - r + leg(r, self.edge)) / r).ln_1p();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::cusp::Tip;
    use super::super::testing::ending_at_one;
    use super::super::{AbelMethod, AbelPlan};
    use super::*;

    /// A cone and a paraboloid, in the dense and in the fast form, with the edge within a cell.
    #[test]
    fn the_two_parts_have_the_stress_of_the_whole() {
        for (cells, bound) in [(8, 1e-13), (60, 1e-13), (150, 1e-13), (3000, 1e-8)] {
            for grid in [
                RadialGrid::uniform(cells, 1.3),
                RadialGrid::graded(cells, 0.4, 1.3),
            ] {
                let grid = grid.expect("a grid");
                let (x, t) = (grid.nodes(), grid.squares());
                let load = |x: f64| 0.7 * (1.0 - x) + 0.2 * (1.0 - x * x);
                let q: Vec<f64> = x.iter().map(|&x| load(x).max(0.0)).collect();
                let (_, kinks) = ending_at_one(t, &q);
                let slope = Tip::new(x).slope(&q);
                assert!((slope + 0.7).abs() < 1e-9, "{slope}");
                let (cone, mut rest) = (Cone { slope, edge: 1.0 }, Rest::default());
                cone.take_off(&grid, &q, &mut rest);
                assert!(Tip::new(x).slope(&rest.load).abs() < 1e-9);

                let mut p = vec![f64::NAN; x.len()];
                AbelPlan::new(AbelMethod::Product, &grid).stress(&rest.load, &mut p);
                kink::add_to_stress(&kinks, t, &mut p);
                kink::add_to_stress(&rest.kinks, t, &mut p);
                cone.add_to_stress(&grid, &mut p);
                for (p, &r) in p.iter().zip(x).skip(1) {
                    let root = (1.0 - r * r).max(0.0).sqrt();
                    let exact = FRAC_1_PI * (0.7 * (root / r).asinh() + 0.4 * root);
                    assert!((p - exact).abs() < bound, "{cells}, {r}: {p} {exact}");
                }
                // At the tip the first cell is a line in t.
                let tip = FRAC_1_PI * (0.7 * (2.0 - x[1].ln()) + 0.4);
                assert!((p[0] - tip).abs() < bound, "{cells}: {} {tip}", p[0]);
            }
        }
    }
}

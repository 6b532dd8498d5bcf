//! A nodal field with its singular parts, and its images.
//!
//! Line loads and spring displacements are linear in t = x² between nodes, except for singular
//! parts between two of them: [kinks](super::kink) at the stick border and at the contact's edge,
//! and the [cusp](super::cone) of a load at the tip, which ends at that edge. A [`Field`] owns
//! these parts, so that every image and integral has them.
//!
//! The published methods use nodal values only: their images ignore the singular parts.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::cone::{Cone, Rest};
use super::kink::{self, Kink};
use super::{AbelMethod, AbelPlan};
use crate::math::grid::RadialGrid;

/// Values at the nodes of a grid, and the kinks between them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Field {
    /// One value a node, N + 1 of them; none of a field that a scene does not have.
    pub nodal: Vec<f64>,
    /// In the unit of the values per m², from the tip outwards, hat by hat.
    pub kinks: Vec<Kink>,
}

/// Where a line load ends: its cusp with it, and all its stress.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct End {
    /// The slope of the load at the tip, per m; 0 where it has no cusp.
    pub cusp: f64,
    /// The contact radius a, m.
    pub radius: f64,
    /// The nodes within it.
    pub nodes: usize,
}

impl Field {
    /// Zero on `nodes` nodes.
    pub fn zeros(nodes: usize) -> Self {
        Self {
            nodal: vec![0.0; nodes],
            kinks: Vec::new(),
        }
    }

    /// Eq. (2): the surface displacement `w` (m, N + 1 values) of springs that stand at the field's values (m).
    pub fn displacement(&self, plan: &AbelPlan, grid: &RadialGrid, w: &mut [f64]) {
        plan.displacement(&self.nodal, w);
        if has_singular_parts(plan) {
            kink::add_to_displacement(&self.kinks, grid, w);
        }
    }

    /// Eq. (3): the stress `p` (N/m², N + 1 values) of the line load (N/m), and nothing beyond its end. Of use on
    /// the nodes `rows` alone; those further in are zero. `rest` is overwritten where the load has a cusp.
    pub fn stress(
        &self,
        plan: &AbelPlan,
        grid: &RadialGrid,
        end: End,
        rows: Range<usize>,
        rest: &mut Rest,
        p: &mut [f64],
    ) {
        let first = rows.start;
        p[..first].fill(0.0);
        if !has_singular_parts(plan) {
            plan.stress_rows(&self.nodal, p, rows);
            return;
        }
        let squares = grid.squares();
        if end.cusp == 0.0 || end.radius >= grid.radius() {
            plan.stress_rows(&self.nodal, p, rows);
        } else {
            let cone = Cone {
                slope: end.cusp,
                edge: end.radius,
            };
            cone.take_off(grid, &self.nodal, rest);
            plan.stress_rows(&rest.load, p, rows);
            kink::add_to_stress(&rest.kinks, &squares[first..], &mut p[first..]);
            cone.add_to_stress(grid, p);
        }
        kink::add_to_stress(&self.kinks, &squares[first..], &mut p[first..]);
        // The cusp's operator is not causal to the last bit.
        p[end.nodes..].fill(0.0);
    }

    /// ∫ dx of what the kinks add to the chords between the nodes, from the tip to `radius` (m).
    pub fn between_nodes(&self, radius: f64) -> f64 {
        kink::line_integral(&self.kinks, radius)
    }
}

/// Whether a method takes more than nodal values into account.
pub fn has_singular_parts(plan: &AbelPlan) -> bool {
    plan.method() == AbelMethod::Product
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_1_PI;

    /// q = 1 − x² + 0.5 (1 − x) up to a = 1, between two nodes: a paraboloid's and a cone's at once.
    fn load(grid: &RadialGrid) -> (Field, End) {
        let (x, t) = (grid.nodes(), grid.squares());
        let load = |x: f64| (1.0 - x * x + 0.5 * (1.0 - x)).max(0.0);
        let mut field = Field {
            nodal: x.iter().map(|&x| load(x)).collect(),
            kinks: Vec::new(),
        };
        let nodes = x.partition_point(|&x| x < 1.0);
        let (cell, values) = ([nodes - 1, nodes], &field.nodal);
        kink::polyline(
            cell.map(|j| t[j]),
            cell.map(|j| values[j]),
            &[(1.0, 0.0)],
            &mut field.kinks,
        );
        let cusp = -0.5;
        let radius = 1.0;
        (
            field,
            End {
                cusp,
                radius,
                nodes,
            },
        )
    }

    #[test]
    fn a_load_with_a_cusp_and_an_edge_has_its_stress() {
        let grid = RadialGrid::graded(90, 0.4, 1.37).expect("a grid");
        let plan = AbelPlan::new(AbelMethod::Product, &grid);
        let (field, end) = load(&grid);
        let mut p = vec![f64::NAN; grid.len()];
        field.stress(
            &plan,
            &grid,
            end,
            0..grid.len(),
            &mut Rest::default(),
            &mut p,
        );
        for (&r, p) in grid.nodes().iter().zip(&p).skip(1) {
            let root = (1.0 - r * r).max(0.0).sqrt();
            let exact = FRAC_1_PI * (0.5 * (root / r).asinh() + 2.0 * root);
            assert!((p - exact).abs() < 1e-13, "{r}: {p} {exact}");
        }
        assert!(p[end.nodes..].iter().all(|&p| p == 0.0));
    }

    #[test]
    fn published_methods_see_the_nodes_alone() {
        let grid = RadialGrid::uniform(40, 1.37).expect("a grid");
        let plan = AbelPlan::new(AbelMethod::A, &grid);
        let (field, end) = load(&grid);
        let [mut p, mut nodal] = [const { Vec::new() }; 2].map(|mut p: Vec<f64>| {
            p.resize(grid.len(), f64::NAN);
            p
        });
        field.stress(
            &plan,
            &grid,
            end,
            0..grid.len(),
            &mut Rest::default(),
            &mut p,
        );
        plan.stress(&field.nodal, &mut nodal);
        assert_eq!(p, nodal);
    }
}

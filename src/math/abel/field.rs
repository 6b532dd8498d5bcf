//! A nodal field with its kinks, and its images.
//!
//! Line loads and spring displacements are linear in t = x² between nodes, except for [kinks](super::kink) between two
//! of them, at the stick border and at the contact's edge. A [`Field`] owns them, so that every image and integral has
//! them.
//!
//! The published methods use nodal values only: their images ignore the kinks.

use serde::{Deserialize, Serialize};

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
        if has_kinks(plan) {
            kink::add_to_displacement(&self.kinks, grid, w);
        }
    }

    /// Eq. (3): the stress `p` (N/m², N + 1 values) of the line load (N/m), and nothing beyond the first `touching`
    /// nodes.
    pub fn stress(&self, plan: &AbelPlan, grid: &RadialGrid, touching: usize, p: &mut [f64]) {
        self.stress_from(0, plan, grid, touching, p);
    }

    /// The same from the node `first` on, or from one before it, which is returned.
    pub fn stress_from(
        &self,
        first: usize,
        plan: &AbelPlan,
        grid: &RadialGrid,
        touching: usize,
        p: &mut [f64],
    ) -> usize {
        let first = plan.stress_from(first, &self.nodal, p);
        if has_kinks(plan) && first < p.len() {
            let (within, beyond) = p.split_at_mut(touching.max(first));
            kink::add_to_stress(&self.kinks, &grid.squares()[first..], &mut within[first..]);
            // Kinks cancel there but for rounding.
            beyond.fill(0.0);
        }
        first
    }

    /// ∫ dx of what the kinks add to the chords between the nodes, from the tip to `radius` (m).
    pub fn between_nodes(&self, radius: f64) -> f64 {
        kink::line_integral(&self.kinks, radius)
    }
}

/// Whether a method takes more than nodal values into account.
fn has_kinks(plan: &AbelPlan) -> bool {
    plan.method() == AbelMethod::Product
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_2_PI;

    /// q = 1 − x² up to a = 1, between two nodes, and the nodes that touch.
    fn load(grid: &RadialGrid) -> (Field, usize) {
        let (x, t) = (grid.nodes(), grid.squares());
        let mut field = Field {
            nodal: t.iter().map(|t| (1.0 - t).max(0.0)).collect(),
            kinks: Vec::new(),
        };
        let touching = x.partition_point(|&x| x < 1.0);
        let (cell, values) = ([touching - 1, touching], &field.nodal);
        kink::polyline(
            cell.map(|j| t[j]),
            cell.map(|j| values[j]),
            &[(1.0, 0.0)],
            &mut field.kinks,
        );
        (field, touching)
    }

    #[test]
    fn a_load_with_an_edge_between_nodes_has_its_stress() {
        let grid = RadialGrid::graded(90, 0.4, 1.37).expect("a grid");
        let plan = AbelPlan::new(AbelMethod::Product, &grid);
        let (field, touching) = load(&grid);
        let mut p = vec![f64::NAN; grid.len()];
        field.stress(&plan, &grid, touching, &mut p);
        for (&t, p) in grid.squares().iter().zip(&p) {
            let exact = FRAC_2_PI * (1.0 - t).max(0.0).sqrt();
            assert!((p - exact).abs() < 1e-13, "{t}: {p} {exact}");
        }
        assert!(p[touching..].iter().all(|&p| p == 0.0));
    }

    #[test]
    fn published_methods_see_the_nodes_alone() {
        let grid = RadialGrid::uniform(40, 1.37).expect("a grid");
        let plan = AbelPlan::new(AbelMethod::A, &grid);
        let (field, touching) = load(&grid);
        let [mut p, mut nodal] = [const { Vec::new() }; 2].map(|mut p: Vec<f64>| {
            p.resize(grid.len(), f64::NAN);
            p
        });
        field.stress(&plan, &grid, touching, &mut p);
        plan.stress(&field.nodal, &mut nodal);
        assert_eq!(p, nodal);
    }
}

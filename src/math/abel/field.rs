//! A nodal field with its kinks and its dome, and its transforms.
//!
//! Line loads and spring displacements are linear in t = x² between nodes, except for [kinks](super::kink) inside a
//! cell, at the stick border and at the contact's edge, and for a [dome](super::dome), the shape in which they end at
//! the edge of a scar. A [`Field`] owns both, so every transform and integral includes them.
//!
//! The published methods use nodal values only: they ignore kinks and dome.

use serde::{Deserialize, Serialize};

use super::dome::Dome;
use super::kink::{self, Kink};
use super::{AbelPlan, line};
use crate::math::grid::RadialGrid;

/// Values at the nodes of a grid, and the kinks between them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Field {
    /// One value per node, N + 1 in all; empty if the scene has no such field.
    pub nodal: Vec<f64>,
    /// In the unit of the values per m², from the tip outwards, one hat after another.
    pub kinks: Vec<Kink>,
    /// How the values fall to zero at the end of a scar, if they do so like a root.
    pub dome: Option<Dome>,
}

impl Field {
    /// Returns a field of zeros on `nodes` nodes.
    pub fn zeros(nodes: usize) -> Self {
        Self {
            nodal: vec![0.0; nodes],
            kinks: Vec::new(),
            dome: None,
        }
    }

    /// Eq. (2): computes the surface displacement `w` (m, N + 1 values) of springs displaced by the field's values (m).
    pub fn displacement(&self, plan: &AbelPlan, grid: &RadialGrid, w: &mut [f64]) {
        let (dome, mut rest) = (self.dome_for(plan), Vec::new());
        plan.displacement(self.without(dome, grid, &mut rest), w);
        let is_line = plan.geometry().is_line();
        let add_kinks = |kinks: &[Kink], w: &mut [f64]| {
            if is_line {
                line::add_to_displacement(kinks, grid.squares(), w)
            } else {
                kink::add_to_displacement(kinks, grid, w)
            }
        };
        if plan.method().traits().follows_kinks {
            add_kinks(&self.kinks, w);
        }
        if let Some(dome) = dome {
            let hat = dome.scaled(-1.0).hat(grid.squares());
            add_kinks(&hat, w);
            for (w, &t) in w.iter_mut().zip(grid.squares()) {
                *w += if is_line {
                    line::of_dome(&dome, t)
                } else {
                    dome.displacement(t)
                };
            }
        }
    }

    /// Eq. (3): computes the stress `p` (N/m²) of the line load (N/m) from the node
    /// `first` on, or from slightly before it, and returns the node where it began;
    /// zero beyond the first `touching` nodes. Overwrites `rest`, whatever its length.
    pub fn stress_from(
        &self,
        first: usize,
        plan: &AbelPlan,
        grid: &RadialGrid,
        touching: usize,
        (p, rest): (&mut [f64], &mut Vec<f64>),
    ) -> usize {
        let dome = self.dome_for(plan);
        let first = plan.stress_from(first, self.without(dome, grid, rest), p);
        if plan.method().traits().follows_kinks && first < p.len() {
            let (within, beyond) = p.split_at_mut(touching.max(first));
            let (squares, within) = (&grid.squares()[first..], &mut within[first..]);
            kink::add_to_stress(&self.kinks, squares, within);
            if let Some(dome) = dome {
                let hat = dome.scaled(-1.0).hat(grid.squares());
                kink::add_to_stress(&hat, squares, within);
                within.iter_mut().for_each(|p| *p += dome.stress());
            }
            // Kinks cancel there except for rounding.
            beyond.fill(0.0);
        }
        first
    }

    /// Returns ∫ dx of the kinks and the dome beyond the chords between the nodes, from the tip to `radius` (m).
    pub fn between_nodes(&self, radius: f64) -> f64 {
        kink::line_integral(&self.kinks, radius) + self.dome.map_or(0.0, |dome| dome.beyond)
    }

    /// Returns the dome if the method supports one.
    fn dome_for(&self, plan: &AbelPlan) -> Option<Dome> {
        self.dome.filter(|_| plan.method().traits().follows_kinks)
    }

    /// Returns the nodal values minus the dome, in `rest` if there is one.
    fn without<'a>(
        &'a self,
        dome: Option<Dome>,
        grid: &RadialGrid,
        rest: &'a mut Vec<f64>,
    ) -> &'a [f64] {
        let Some(dome) = dome else {
            return &self.nodal;
        };
        dome.subtract_from(&self.nodal, grid.squares(), rest);
        rest
    }
}

#[cfg(test)]
mod tests {
    use super::super::AbelMethod;
    use super::*;
    use std::f64::consts::FRAC_2_PI;

    /// q = 1 − x² up to a = 1, between two nodes, and the number of nodes that touch.
    fn load(grid: &RadialGrid) -> (Field, usize) {
        let (x, t) = (grid.nodes(), grid.squares());
        let mut field = Field {
            nodal: t.iter().map(|t| (1.0 - t).max(0.0)).collect(),
            kinks: Vec::new(),
            dome: None,
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
        let mut rest = Vec::new();
        field.stress_from(0, &plan, &grid, touching, (&mut p, &mut rest));
        for (&t, p) in grid.squares().iter().zip(&p) {
            let exact = FRAC_2_PI * (1.0 - t).max(0.0).sqrt();
            assert!((p - exact).abs() < 1e-13, "{t}: {p} {exact}");
        }
        assert!(p[touching..].iter().all(|&p| p == 0.0));
    }

    /// A uniform and a Hertzian pressure, up to an edge between two nodes.
    #[test]
    fn a_load_with_a_dome_has_its_images() {
        let grid = RadialGrid::graded(90, 0.4, 1.37).expect("a grid");
        let (mut field, touching) = load(&grid);
        let squares = grid.squares();
        for (q, t) in field.nodal.iter_mut().zip(squares) {
            *q += 0.3 * (1.0 - t).max(0.0).sqrt();
        }
        let inner = field.nodal[touching - 1];
        let cell = [touching - 1, touching].map(|j| squares[j]);
        field.kinks = kink::hat(cell, inner, 1.0).to_vec();
        field.dome = Dome::fit(&field.nodal[..touching], squares, 1.0);
        let plan = AbelPlan::new(AbelMethod::Product, &grid);
        let (mut p, mut w) = (vec![f64::NAN; grid.len()], vec![f64::NAN; grid.len()]);
        field.stress_from(0, &plan, &grid, touching, (&mut p, &mut Vec::new()));
        field.displacement(&plan, &grid, &mut w);
        for ((&t, p), w) in squares.iter().zip(&p).zip(&w) {
            let inside = FRAC_2_PI * (1.0 - t).max(0.0).sqrt() + if t < 1.0 { 0.15 } else { 0.0 };
            assert!((p - inside).abs() < 1e-12, "{t}: {p} {inside}");
            let hertz = match t < 1.0 {
                true => 1.0 - 0.5 * t,
                false => {
                    let root = (t - 1.0).sqrt();
                    FRAC_2_PI * ((1.0 - 0.5 * t) * root.recip().atan() + 0.5 * root)
                }
            };
            let dome = Dome {
                height: 0.3,
                edge: 1.0,
                last: 0,
                beyond: 0.0,
            };
            let exact = hertz + dome.displacement(t);
            assert!((w - exact).abs() < 1e-12, "{t}: {w} {exact}");
        }
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
        let mut rest = Vec::new();
        field.stress_from(0, &plan, &grid, touching, (&mut p, &mut rest));
        plan.stress(&field.nodal, &mut nodal);
        assert_eq!(p, nodal);
    }
}

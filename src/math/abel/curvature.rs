//! Corrects the stress at the nodes for the curvature of the line load between them.
//!
//! # Formula
//!
//! A load that is linear in t = x² in each cell has its curvature κ = q″(t) gathered in jumps J of the
//! slope at the nodes, and Eq. (3) becomes a sum p_j = (2/π) Σ_{m>j} J_m √(t_m − t_j). As a quadrature
//! of ∫κ√(t − t_j) dt it is the trapezoidal rule on a root, which falls short by −ζ(−½) h^{3/2} κ
//! whatever lies further out (I. Navot 1961, J. Math. Phys. 40, 271–276: Euler and Maclaurin's sum at a
//! branch point). So
//!
//! ```text
//! p_j += (2/π) 0.2079 h_j^{3/2} κ_j,   κ_j = 2J_j/(h_{j−1} + h_j),   h_j = t_{j+1} − t_j
//! ```
//!
//! and where the load kinks in the cell behind the node, at t_b, the rule has one cell:
//! (t_b − t_j)^{3/2}/6 in place of 0.2079 h^{3/2}.
//!
//! The pressure within a cell, averaged, never had this error; its values at the nodes did. In a
//! fretting run of N = 100 they were low by 0.3 % wherever the worn contact is curved, and so was the
//! wear.
//!
//! - **Order**: lifts that of p from 3/2 to 2, but for the nodes next to an edge (r⁴ at N = 100: rms error
//!   1.9e-4 of the mean pressure, 1.3e-3 without). Exact data of [`product`](super::product) stay exact:
//!   they have no curvature.
//! - **Cost**: O(N), one square root a node.
//! - **At r = 0**: nothing is added there and at the next node: the cells in t grow threefold from
//!   one to the next, too uneven for this rule; the term would flip the sign of the response of the
//!   pressure to wear.
//! - **At a stick border**: a worn contact drops its load like a root behind the permanent stick
//!   zone. A second difference across its border is not a curvature, and would let the stick zone
//!   act on the slip zone and cause endless wear there: the caller says where the load is smooth.
//! - **Known failure**: next to a kink between nodes that is not given as a [`Kink`], the jump at
//!   the nodes is not due to curvature. The error there is of order ½ with this term and without.

use std::f64::consts::FRAC_2_PI;
use std::ops::Range;

use super::kink::Kink;
use crate::math::grid::RadialGrid;
use crate::math::scan::leading;
use crate::math::vector::vectorized;

/// −ζ(−½).
const ENDLESS: f64 = 0.207_886_224_977_354_57;

/// The same of a single cell: ⅔ − ½.
const SINGLE: f64 = 1.0 / 6.0;

/// The first node at which anything is added.
const FIRST: usize = 2;

/// What the term takes from the grid, computed once.
#[derive(Debug, Clone, PartialEq)]
pub struct Curvature {
    grid: RadialGrid,
    /// 1/h_j of the cell behind each node, 1/m².
    per_cell: Vec<f64>,
    /// 0.2079 h_j^{3/2} of the cell behind each node, m³.
    lacks: Vec<f64>,
    /// [`per_pair`] times that, m; 0 at the tip, which has no cell before.
    factors: Vec<f64>,
}

impl Curvature {
    /// For loads on the nodes of a grid.
    pub fn new(grid: &RadialGrid) -> Self {
        let squares = grid.squares();
        let cells = || squares.windows(2).map(|t| t[1] - t[0]);
        let lacks: Vec<f64> = cells().map(|cell| root_cubed(cell) * ENDLESS).collect();
        let factors = (1..lacks.len()).map(|j| per_pair(squares, j) * lacks[j]);
        Self {
            grid: grid.clone(),
            per_cell: cells().map(f64::recip).collect(),
            factors: std::iter::once(0.0).chain(factors).collect(),
            lacks,
        }
    }

    /// Eq. (3): what the curvature of a `load` (N/m) does to the stress (N/m²) of some `nodes` in contact, beside
    /// [`product::stress`](super::product::stress) and the `kinks` of the load (N/m, from the tip outwards). It is
    /// written into `terms`, one a node of the grid, and of use only where the load is smooth from the node before
    /// to the one behind. `cusp` is the slope of the load at the tip, which is no curvature.
    pub fn terms(
        &self,
        load: &[f64],
        cusp: f64,
        kinks: &[Kink],
        nodes: Range<usize>,
        terms: &mut [f64],
    ) {
        terms[nodes.clone()].fill(0.0);
        let nodes = nodes.start.max(FIRST)..nodes.end.min(self.per_cell.len());
        if nodes.is_empty() {
            return;
        }
        if cusp == 0.0 {
            self.write_smooth(load, nodes.clone(), terms);
        } else {
            for j in nodes.clone() {
                terms[j] = self.factors[j] * self.jump(load, cusp, j);
            }
        }
        self.bend(load, cusp, kinks, nodes, terms);
    }

    /// The terms of a load without a cusp, as if it had no kinks.
    fn write_smooth(&self, load: &[f64], nodes: Range<usize>, terms: &mut [f64]) {
        vectorized(
            #[inline(always)]
            || {
                let chords = load[nodes.start - 1..].windows(3);
                let cells = self.per_cell[nodes.start - 1..].windows(2);
                let factors = &self.factors[nodes.clone()];
                for (((term, q), per_cell), factor) in
                    terms[nodes].iter_mut().zip(chords).zip(cells).zip(factors)
                {
                    let slopes = [(q[1] - q[0]) * per_cell[0], (q[2] - q[1]) * per_cell[1]];
                    *term = factor * (slopes[1] - slopes[0]);
                }
            },
        );
    }

    /// By how much the slope of the load jumps at the node `j`, but for its cusp.
    fn jump(&self, load: &[f64], cusp: f64, j: usize) -> f64 {
        let x = self.grid.nodes();
        let slope = |cell: usize| {
            (load[cell + 1] - load[cell]) * self.per_cell[cell] - cusp / (x[cell] + x[cell + 1])
        };
        slope(j) - slope(j - 1)
    }

    /// Writes anew the terms of those `nodes` that have a kink in their place or in the cell behind.
    fn bend(
        &self,
        load: &[f64],
        cusp: f64,
        mut kinks: &[Kink],
        nodes: Range<usize>,
        terms: &mut [f64],
    ) {
        let t = self.grid.squares();
        while let Some(first) = kinks.first() {
            let next = t.partition_point(|&t| t <= first.at);
            let end = t.get(next).copied().unwrap_or(f64::INFINITY);
            let (bent, further) = kinks.split_at(leading(kinks, |kink| kink.at < end));
            kinks = further;
            let j = next - 1;
            if !nodes.contains(&j) {
                continue;
            }
            let (in_place, in_cell) = bent.split_at(leading(bent, |kink| kink.at == t[j]));
            let jump = in_place
                .iter()
                .fold(self.jump(load, cusp, j), |jump, kink| jump + kink.jump);
            let lack = match in_cell.first() {
                Some(kink) => root_cubed(kink.at - t[j]) * SINGLE,
                None => self.lacks[j],
            };
            terms[j] = per_pair(t, j) * lack * jump;
        }
    }
}

/// (2/π) 2/(h_{j−1} + h_j), 1/m².
fn per_pair(t: &[f64], j: usize) -> f64 {
    FRAC_2_PI * 2.0 / (t[j + 1] - t[j - 1])
}

fn root_cubed(width: f64) -> f64 {
    width * width.sqrt()
}

#[cfg(test)]
mod tests {
    use super::super::kink;
    use super::super::product;
    use super::super::testing::{apply, ending_at_one, matrix};
    use super::super::worn;
    use super::super::{AbelMethod, AbelPlan};
    use super::*;
    use crate::math::vector::add_to;

    /// q = 1 − t², as under f ∝ r⁴, that ends at a = 1 between nodes: the stress with its edge.
    fn quartic(cells: usize, corrected: bool) -> Vec<(f64, f64)> {
        // a = 1 a third of a cell behind a node, for every N.
        let domain = cells as f64 / ((2 * cells / 3) as f64 + 1.0 / 3.0);
        let grid = RadialGrid::uniform(cells, domain).expect("a grid");
        let t = grid.squares();
        let load: Vec<f64> = t.iter().map(|t| (1.0 - t * t).max(0.0)).collect();
        let (cell, kinks) = ending_at_one(t, &load);
        let mut p = apply(&product::stress(grid.nodes()), &load);
        kink::add_to_stress(&kinks, t, &mut p);
        if corrected {
            let mut terms = vec![f64::NAN; t.len()];
            Curvature::new(&grid).terms(&load, 0.0, &kinks, 0..t.len(), &mut terms);
            add_to(&mut p, &terms);
        }
        let exact = |s: f64| FRAC_2_PI * (1.0 - s).sqrt() * ((1.0 - s) / 1.5 + 2.0 * s);
        let inside = t.iter().zip(&p).take(cell + 1);
        inside.map(|(&s, p)| (s, p - exact(s))).collect()
    }

    fn worst(errors: &[(f64, f64)], within: f64) -> f64 {
        let inside = errors.iter().filter(|(s, _)| *s < within);
        inside.map(|(_, error)| error.abs()).fold(0.0, f64::max)
    }

    #[test]
    fn a_curved_load_has_its_stress_to_second_order() {
        let order = |corrected: bool| {
            let errors = [50, 100, 200, 400].map(|cells| worst(&quartic(cells, corrected), 0.8));
            eprintln!("{corrected}: {errors:?}");
            (errors[0] / errors[3]).log2() / 3.0
        };
        assert!(order(true) > 1.95);
        assert!(order(false) < 1.6);
        let (with, without) = (quartic(100, true), quartic(100, false));
        for within in [0.8, 1.0] {
            let (with, without) = (worst(&with, within), worst(&without, within));
            assert!(with < without / 3.0, "{within}: {with} {without}");
        }
    }

    #[test]
    fn what_is_exact_stays_exact() {
        let grid = RadialGrid::graded(80, 0.4, 1.5).expect("a grid");
        let (nodes, t) = (grid.nodes(), grid.squares());
        let load: Vec<f64> = nodes
            .iter()
            .map(|x| (1.0 - 0.3 * x - 0.7 * x * x).max(0.0))
            .collect();
        let (cell, kinks) = ending_at_one(t, &load);
        let mut p = vec![f64::NAN; t.len()];
        let curvature = Curvature::new(&grid);
        curvature.terms(&load, -0.3, &kinks, 0..t.len(), &mut p);
        // The cusp is not linear in t in the edge's cell.
        assert!(p[..cell].iter().all(|p| p.abs() < 1e-13), "{p:?}");
        let mut q = vec![f64::NAN; t.len()];
        curvature.terms(&load, 0.0, &kinks, 0..t.len(), &mut q);
        assert!(q[1..cell].iter().any(|p| p.abs() > 1e-6));
    }

    /// No sawtooth, as without it: each mode of worn depth lowers its own pressure.
    #[test]
    fn the_response_of_the_pressure_keeps_its_spectrum() {
        for grid in [
            RadialGrid::graded(50, 0.767, 1.5).expect("a grid"),
            RadialGrid::graded(100, 0.42, 1.5).expect("a grid"),
            RadialGrid::graded(60, 0.17, 1.5).expect("a grid"),
            RadialGrid::uniform(60, 1.5).expect("a grid"),
        ] {
            let plan = AbelPlan::dense(AbelMethod::Product, &grid);
            let mut stress = matrix(grid.len(), |q, p| plan.stress(q, p));
            let curvature = Curvature::new(&grid);
            for (i, mut column) in stress.column_iter_mut().enumerate() {
                let mut load = vec![0.0; grid.len()];
                load[i] = 1.0;
                let outside = grid.border().map_or(0, |border| border + 2);
                let mut terms = vec![f64::NAN; grid.len()];
                curvature.terms(&load, 0.0, &[], 0..grid.len(), &mut terms);
                for j in outside..grid.len() {
                    column[j] += terms[j];
                }
            }
            // What wears: the nodes outside the border, up to the last but one.
            let response = stress * worn::profile(&grid);
            let from = grid.border().unwrap_or(0) + 1;
            let size = grid.len() - 1 - from;
            let wearing = response.view((from, from), (size, size)).into_owned();
            let values = wearing.complex_eigenvalues();
            let largest = values.iter().map(|value| value.re).fold(0.0, f64::max);
            for value in &values {
                assert!(value.re > 0.0, "{value}");
                assert!(value.im.abs() < 0.35 * largest, "{value} {largest}");
            }
        }
    }
}

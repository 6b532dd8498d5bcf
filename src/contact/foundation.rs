//! The Winkler foundation: the row of springs that stands for the half-space.

use crate::math::abel::bend::{self, Bend};
use crate::math::abel::product;
use crate::math::grid::RadialGrid;
use crate::math::quadrature::{line_weights, weighted};

/// A cusp that changes the load by less than this part of it over two cells is rounding.
const NO_CUSP: f64 = 1e-9;

/// Where the springs stand, and how loads on them add up.
///
/// Loads are taken as linear in x² between springs, and broken where the contact or the stick zone
/// ends between two of them: [`Bend`]s hold those breaks.
#[derive(Debug, Clone, PartialEq)]
pub struct Foundation {
    nodes: Vec<f64>,
    squares: Vec<f64>,
    weights: Vec<f64>,
}

impl Foundation {
    /// Springs at the nodes of a grid.
    pub fn new(grid: &RadialGrid) -> Self {
        Self {
            nodes: grid.nodes().to_vec(),
            squares: grid.squares().to_vec(),
            weights: line_weights(grid.nodes()),
        }
    }

    /// x, m.
    pub fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// x², m².
    pub fn squares(&self) -> &[f64] {
        &self.squares
    }

    /// 2∫ q dx over the row: the force (N) of a line load (N/m) with its breaks, that ends at `edge` (m).
    ///
    /// A load with a cusp at the tip, as under a cone, is linear in x and not in x²: what that adds is
    /// added.
    pub fn force(&self, load: &[f64], breaks: &[Bend], edge: f64) -> f64 {
        let end = self.nodes[self.nodes.len() - 1];
        let smooth = weighted(&self.weights, load) + bend::line_integral(breaks, end);
        2.0 * (smooth + self.cusp(load, edge) * self.cusp_integral(edge))
    }

    /// The slope of `values` at the tip, x → 0, where there is a cusp worth the name and the contact
    /// goes on beyond it; 0 else.
    pub fn cusp(&self, values: &[f64], edge: f64) -> f64 {
        if edge <= self.nodes[3] {
            return 0.0;
        }
        let cusp = product::cusp(&self.nodes[..3], &values[..3]);
        let rounding = NO_CUSP * values[0].abs();
        if (cusp * self.nodes[2]).abs() > rounding {
            cusp
        } else {
            0.0
        }
    }

    /// ∫ of what a cusp of slope one adds to a load linear in x² up to `edge`, m².
    fn cusp_integral(&self, edge: f64) -> f64 {
        let bubble = |a: f64, b: f64| (b - a).powi(3) / (6.0 * (a + b));
        let whole = self.nodes.windows(2).take_while(|cell| cell[1] <= edge);
        let inside: f64 = whole.map(|cell| bubble(cell[0], cell[1])).sum();
        let last = self.nodes.partition_point(|&x| x <= edge) - 1;
        if edge > self.nodes[last] {
            inside + bubble(self.nodes[last], edge)
        } else {
            inside
        }
    }
}

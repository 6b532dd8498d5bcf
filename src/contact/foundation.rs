//! The Winkler foundation: the row of springs that stands for the half-space.

use crate::math::abel::bend::{self, Bend};
use crate::math::grid::RadialGrid;
use crate::math::quadrature::{line_weights, weighted};

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

    /// 2∫ q dx over the row: the force (N) of a line load (N/m) with its breaks.
    pub fn force(&self, load: &[f64], bends: &[Bend]) -> f64 {
        let edge = self.nodes[self.nodes.len() - 1];
        2.0 * (weighted(&self.weights, load) + bend::line_integral(bends, edge))
    }
}

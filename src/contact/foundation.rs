//! The Winkler foundation: the row of springs that represents the half-space.

use crate::math::abel::cusp::Tip;
use crate::math::abel::field::Field;
use crate::math::abel::kink::Kink;
use crate::math::grid::RadialGrid;
use crate::math::quadrature::{ProductWeights, gauss, line_weights, weighted_first};
use crate::math::scan::{leading, trailing};

/// Where the contact ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// The contact radius a, m.
    pub radius: f64,
    /// How many springs lie within it: what is further out carries nothing.
    pub nodes: usize,
}

/// Where the springs stand, and how loads on them add up.
///
/// Loads are taken as linear in x² between springs, and kinked where the contact or the stick zone
/// ends between two of them: the kinks of a [`Field`] say where.
#[derive(Debug, Clone, PartialEq)]
pub struct WinklerFoundation {
    grid: RadialGrid,
    weights: Vec<f64>,
    tip: Tip,
    /// Of ∫ q s dx in each cell.
    products: ProductWeights,
    /// ∫ of what a cusp of slope one adds to a load linear in x², from the tip to each node, m².
    bubbles: Vec<f64>,
}

impl WinklerFoundation {
    /// Springs at the nodes of a grid.
    pub fn new(grid: &RadialGrid) -> Self {
        let mut products = ProductWeights::new(grid.nodes());
        if let Some(border) = grid.border() {
            // A worn contact carries its load up to the border of the permanent stick zone and drops
            // it there: what slips behind the border bears nothing, however the chords cross.
            let mixed = std::mem::take(&mut products.mixed[border]);
            products.inner[border] += mixed;
            products.outer[border] += mixed;
        }
        Self {
            grid: grid.clone(),
            weights: line_weights(grid.nodes()),
            tip: Tip::new(grid.nodes()),
            products,
            bubbles: bubbles(grid.nodes()),
        }
    }

    /// x, m.
    pub fn nodes(&self) -> &[f64] {
        self.grid.nodes()
    }

    /// x², m².
    pub fn squares(&self) -> &[f64] {
        self.grid.squares()
    }

    /// 2∫ q dx over the row: the force (N) of a line load (N/m) with its kinks, that ends at `edge`.
    ///
    /// A load with a cusp at the tip, as under a cone, is linear in x and not in x²: what that adds is
    /// added.
    pub fn force(&self, load: &Field, edge: Edge) -> f64 {
        let nodal = weighted_first(&self.weights, &load.nodal, edge.nodes);
        let kinked = nodal + load.between_nodes(self.grid.radius());
        2.0 * (kinked + self.cusp_integral(&load.nodal, edge))
    }

    /// What no force (N) of a line load of up to `strongest` (N/m) exceeds: finite where an f64 holds the force.
    pub fn most_force(&self, strongest: f64) -> f64 {
        // Cusps are integrated by their bubbles: 0 · ∞ is none.
        2.0 * strongest * self.grid.radius() + 0.0 * self.bubbles[self.bubbles.len() - 1]
    }

    /// 2∫ q |s| dx over the row: the work (J) of a line load (N/m) that ends at `edge` on a slip (m).
    /// Both are linear in x² in each cell; the slip has `kinks` inside cells besides, each with its cell.
    pub fn work(&self, load: &[f64], slip: &[f64], kinks: &[(usize, Kink)], edge: Edge) -> f64 {
        let (xs, squares) = (self.nodes(), self.squares());
        // Most springs stick or carry nothing.
        let first = leading(slip, |&slip| slip == 0.0).saturating_sub(1);
        let end = load.len() + 1 - trailing(load, |&load| load == 0.0);
        let end = end.min(load.len()).saturating_sub(1).max(first);
        let smooth = self.products.integral(first..end, load, slip);
        let kinked: f64 = kinks
            .iter()
            .map(|&(k, kink)| {
                let (t, width) = (squares[k], squares[k + 1] - squares[k]);
                let sign = (slip[k] + slip[k + 1]).signum();
                let slope = (load[k + 1] - load[k]) / width;
                sign * kink.jump
                    * gauss(kink.at.sqrt(), xs[k + 1], |x| {
                        (load[k] + slope * (x * x - t)) * (x * x - kink.at)
                    })
            })
            .sum();
        let cusp = self.cusp_integral(load, edge) * slip[0].abs();
        2.0 * (smooth + kinked + cusp)
    }

    /// The slope of `values` at the tip, x → 0, if there is a cusp and the contact extends beyond it; otherwise 0.
    pub fn cusp(&self, values: &[f64], edge: f64) -> f64 {
        if edge > self.nodes()[3] {
            self.tip.slope(values)
        } else {
            0.0
        }
    }

    /// ∫ of what the cusp of `values` adds to them up to `edge`, in their unit times m.
    fn cusp_integral(&self, values: &[f64], edge: Edge) -> f64 {
        let cusp = self.cusp(values, edge.radius);
        if cusp == 0.0 {
            return 0.0;
        }
        let last = edge.nodes - 1;
        let inner = self.nodes()[last];
        cusp * (self.bubbles[last] + bubble(inner, edge.radius))
    }
}

/// ∫ of the bubble of a cusp of slope one over a cell, m².
fn bubble(a: f64, b: f64) -> f64 {
    (b - a).powi(3) / (6.0 * (a + b))
}

/// The same from the tip to each node.
fn bubbles(nodes: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let whole = nodes.windows(2).map(|cell| {
        sum += bubble(cell[0], cell[1]);
        sum
    });
    std::iter::once(0.0).chain(whole).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::abel::kink;

    /// A Hertzian load on a slip that sets in between two springs, of either sign.
    #[test]
    fn the_work_on_a_kinked_slip_is_exact() {
        let grid = RadialGrid::uniform(20, 1.0).expect("a grid");
        let row = WinklerFoundation::new(&grid);
        let squares = grid.squares();
        let load: Vec<f64> = squares.iter().map(|t| 1.0 - t).collect();
        let border: f64 = 0.52;
        for sign in [1.0, -1.0] {
            let slip: Vec<f64> = squares
                .iter()
                .map(|t| sign * (t - border).max(0.0))
                .collect();
            let k = squares.partition_point(|&t| t <= border) - 1;
            let mut kinks = Vec::new();
            let ends = [squares[k], squares[k + 1]];
            kink::polyline(ends, [slip[k], slip[k + 1]], &[(border, 0.0)], &mut kinks);
            let kinks: Vec<(usize, Kink)> = kink::by_cell(&kinks, squares).collect();
            assert!(kinks.iter().all(|&(cell, _)| cell == k), "{kinks:?}");
            // ∫ (1 − x²)(x² − b) dx from √b to 1.
            let primitive =
                |x: f64| -x.powi(5) / 5.0 + (1.0 + border) * x.powi(3) / 3.0 - border * x;
            let exact = 2.0 * (primitive(1.0) - primitive(border.sqrt()));
            let edge = Edge {
                radius: 1.0,
                nodes: grid.cells(),
            };
            let found = row.work(&load, &slip, &kinks, edge);
            assert!((found / exact - 1.0).abs() < 1e-12, "{found} {exact}");
            let without = row.work(&load, &slip, &[], edge);
            assert!((without / exact - 1.0).abs() > 1e-4);
        }
    }
}

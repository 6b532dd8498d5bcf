//! The Winkler foundation: the row of springs that represents the half-space.

use std::f64::consts::FRAC_2_PI;

use serde::{Deserialize, Serialize};

use crate::math::abel::dome::Dome;
use crate::math::abel::field::Field;
use crate::math::abel::kink;
use crate::math::abel::line;
use crate::math::geometry::Geometry;
use crate::math::grid::RadialGrid;
use crate::math::quadrature::{
    ProductWeights, line_weights, weighted, weighted_each, weighted_first,
};
use crate::math::scan::{leading, trailing};

/// Result of pressing a profile to a depth, besides the line load itself.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct NormalContact {
    /// The largest load of a spring, N/m; NaN if any load is not finite.
    pub strongest: f64,
    /// The contact radius a, m; 0 without contact.
    pub radius: f64,
    /// Number of springs within the contact radius, counted from r = 0; springs further out carry nothing.
    pub nodes: usize,
}

/// The positions of the springs, and the rules for adding up loads on them.
///
/// Loads are linear in x² between springs, with kinks where the contact or the stick zone ends between two of them: the
/// kinks of a [`Field`] say where, and its dome how a load ends at the edge of a scar.
#[derive(Debug, Clone, PartialEq)]
pub struct WinklerFoundation {
    geometry: Geometry,
    grid: RadialGrid,
    weights: Vec<f64>,
    tip: Tip,
    /// Weights of the work of q on the slip in each cell.
    products: ProductWeights,
    /// ∫ of the excess over a load linear in x² for a cusp of slope one, from the tip to each node, m².
    bubbles: Vec<f64>,
    /// Weights of ∫ (−u′) ln(R/s) ds, with R the grid's radius; empty for a round contact.
    logs: Vec<f64>,
}

impl WinklerFoundation {
    /// Places the springs of a round contact at the nodes of a grid.
    pub fn new(grid: &RadialGrid) -> Self {
        Self::for_geometry(Geometry::Round, grid)
    }

    /// Places the springs of a contact of this `geometry` at the nodes of a grid.
    pub fn for_geometry(geometry: Geometry, grid: &RadialGrid) -> Self {
        Self {
            geometry,
            grid: grid.clone(),
            weights: line_weights(grid.nodes()),
            tip: Tip::new(grid.nodes()),
            products: ProductWeights::new(grid.nodes(), |x| geometry.measure(x)),
            bubbles: bubbles(grid.nodes()),
            logs: match geometry {
                Geometry::Round => Vec::new(),
                Geometry::Line { .. } => log_weights(grid),
            },
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

    /// Returns the force (N) of a line load (N/m) with its kinks, which ends at the edge of the `contact`: 2∫ q dx over
    /// the row. In a line contact the spring at the centre gives the force, L q(0).
    ///
    /// A load with a cusp at the tip, as under a cone, is linear in x and not in x²; the difference is added.
    pub fn force(&self, load: &Field, contact: NormalContact) -> f64 {
        if let Some(length) = self.geometry.length() {
            return length * load.nodal[0];
        }
        let nodal = weighted_first(&self.weights, &load.nodal, contact.nodes);
        let kinked = nodal + load.between_nodes(self.grid.radius());
        2.0 * (kinked + self.cusp_integral(&load.nodal, contact))
    }

    /// The compression of the first `touching` springs that carries as much as `values` do.
    pub fn mean(&self, values: &[f64], touching: usize) -> f64 {
        if self.geometry.is_line() {
            return values[0];
        }
        let all: f64 = self.weights[..touching].iter().sum();
        weighted_first(&self.weights, values, touching) / all
    }

    /// A dome with the difference between its integral and its polyline's.
    pub fn measured(&self, dome: Dome) -> Dome {
        let Dome { edge, last, .. } = dome;
        if self.geometry.is_line() {
            let beyond = line::beyond_polyline(&dome, self.squares());
            return Dome { beyond, ..dome };
        }
        let (weights, squares) = (&self.weights[..=last], &self.squares()[..=last]);
        let nodal = weighted_each(
            weights,
            squares,
            #[inline(always)]
            move |t| (edge - t).max(0.0).sqrt(),
        );
        let hat = kink::line_integral(&dome.hat(self.squares()), self.grid.radius());
        let beyond = dome.line_integral() - dome.height * nodal - hat;
        Dome { beyond, ..dome }
    }

    /// Returns an upper bound on the force (N) of line loads up
    /// to `strongest` (N/m); finite if an f64 can hold the force.
    pub fn most_force(&self, strongest: f64) -> f64 {
        if let Some(length) = self.geometry.length() {
            return length * strongest;
        }
        // Cusps are integrated by their bubbles: if those overflow, 0 · ∞ makes the bound NaN.
        2.0 * strongest * self.grid.radius() + 0.0 * self.bubbles[self.bubbles.len() - 1]
    }

    /// Returns the work (J) of a line load (N/m), which ends at the edge of the `contact`, on a slip (m): 2∫ q |s| dx
    /// over the row, both linear in x² in each cell. In a line contact this is the work on the slip beyond the rigid
    /// one, plus the force times the rigid slip: see [`Geometry`].
    pub fn work(&self, load: &[f64], slip: &[f64], contact: NormalContact) -> f64 {
        let rigid = self.rigid_slip(slip);
        // Skip the springs that stick or carry nothing: most of them.
        let first = leading(slip, |&slip| slip == 0.0).saturating_sub(1);
        let end = load.len() + 1 - trailing(load, |&load| load == 0.0);
        let end = end.min(load.len()).saturating_sub(1).max(first);
        let smooth = self.products.integral(first..end, load, slip, rigid);
        if let Some(length) = self.geometry.length() {
            return 2.0 * smooth + length * load[0] * rigid;
        }
        let cusp = self.cusp_integral(load, contact) * slip[0].abs();
        2.0 * (smooth + cusp)
    }

    /// Returns half of the work (J) per slip (m) that the kinks of a load (N/m) add between the springs.
    pub fn between_springs(&self, load: &Field) -> f64 {
        let radius = self.grid.radius();
        match self.geometry {
            Geometry::Round => load.between_nodes(radius),
            Geometry::Line { .. } => {
                let dome = load.dome.map_or(0.0, |dome| dome.beyond);
                let kinks = line::log_integral(&load.kinks, radius);
                self.geometry.measure(1.0) * (kinks + dome)
            }
        }
    }

    /// Returns how far (m) the springs of a line contact, displaced by `spring` (m), move the body against a point of
    /// the half-plane at a depth `gauge` (m) far below the contact:
    ///
    /// ```text
    /// (2/π) ∫ (−u′) arcosh(L/s) ds ≈ (2/π) [u(0) ln(2L/R) + ∫ (−u′) ln(R/s) ds]
    /// ```
    ///
    /// L is the gauge, R the grid's radius.
    pub fn shift_against(&self, gauge: f64, spring: &Field) -> f64 {
        let radius = self.grid.radius();
        let nodal = weighted(&self.logs, &spring.nodal);
        let kinked: f64 = spring
            .kinks
            .iter()
            .map(|kink| kink.jump * log_moment(kink.at))
            .sum();
        FRAC_2_PI * (spring.nodal[0] * (2.0 * gauge / radius).ln() + nodal + kinked)
    }

    /// Returns how far the spring `k` slips beyond the rigid slip, m.
    pub fn beyond_rigid(&self, slip: &[f64], k: usize) -> f64 {
        slip[k].abs() - self.rigid_slip(slip)
    }

    /// Returns how far the bodies slip as a whole, m, which the half-plane of a line contact does not resist.
    fn rigid_slip(&self, slip: &[f64]) -> f64 {
        match self.geometry {
            Geometry::Round => 0.0,
            Geometry::Line { .. } => slip[0].abs(),
        }
    }

    /// Returns the slope of `values` at the tip, x → 0, if there
    /// is a cusp and the contact extends beyond it; otherwise 0.
    pub fn cusp(&self, values: &[f64], edge: f64) -> f64 {
        if edge > self.nodes()[3] {
            self.tip.slope(values)
        } else {
            0.0
        }
    }

    /// Returns ∫ of the excess due to the cusp of `values` within the `contact`, in their unit times m.
    fn cusp_integral(&self, values: &[f64], contact: NormalContact) -> f64 {
        let cusp = self.cusp(values, contact.radius);
        if cusp == 0.0 {
            return 0.0;
        }
        let last = contact.nodes - 1;
        let inner = self.nodes()[last];
        cusp * (self.bubbles[last] + bubble(inner, contact.radius))
    }
}

/// Weights of ∫ (−u′) ln(R/s) ds for nodal values u that are linear in t = s².
fn log_weights(grid: &RadialGrid) -> Vec<f64> {
    let edge = grid.radius() * grid.radius();
    let mut weights = vec![0.0; grid.len()];
    for (k, cell) in grid.squares().windows(2).enumerate() {
        let [a, b] = [cell[0], cell[1]];
        let logs = 0.5 * edge.ln() + (log_moment(b) - log_moment(a)) / (b - a);
        weights[k] += logs;
        weights[k + 1] -= logs;
    }
    weights
}

/// Returns ∫ −ln √t dt from 0 to `t`.
fn log_moment(t: f64) -> f64 {
    if t > 0.0 {
        0.5 * t * (1.0 - t.ln())
    } else {
        0.0
    }
}

/// Returns ∫ of the bubble of a cusp of slope one over a cell, m².
fn bubble(a: f64, b: f64) -> f64 {
    (b - a).powi(3) / (6.0 * (a + b))
}

/// Sums the bubbles from the tip to each node.
fn bubbles(nodes: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let whole = nodes.windows(2).map(|cell| {
        sum += bubble(cell[0], cell[1]);
        sum
    });
    std::iter::once(0.0).chain(whole).collect()
}

/// A smaller relative change of the load over two cells is rounding, not a cusp.
const NO_CUSP: f64 = 1e-9;

/// The first three springs, which give the cusp of a load at the tip: a cone's load is linear in x and not in x².
///
/// On every cell (x_k, x_{k+1}) a load with the cusp A is its chord in x² plus A (x − x_k)(x_{k+1} − x)/X_k,
///
/// ```text
/// A = (σ_0 − σ_1) / (1/X_0 − 1/X_1),   X_k = x_k + x_{k+1},   σ = Δq/Δ(x²)
/// ```
///
/// An even smooth load has A = O(h³).
#[derive(Debug, Clone, Copy, PartialEq)]
struct Tip {
    /// A = Σ weight × value.
    weights: [f64; 3],
    /// x₂.
    reach: f64,
}

impl Tip {
    fn new(nodes: &[f64]) -> Self {
        let (first, second) = (nodes[1], nodes[1] + nodes[2]);
        let scale = 1.0 / (1.0 / first - 1.0 / second);
        let inner = scale / (first * first);
        let outer = scale / ((nodes[2] - nodes[1]) * second);
        Self {
            weights: [-inner, inner + outer, -outer],
            reach: nodes[2],
        }
    }

    /// Returns the cusp A of nodal `values`: their slope d/dx at the tip, x → 0; 0 if it is mere rounding.
    fn slope(&self, values: &[f64]) -> f64 {
        let tip = || self.weights.iter().zip(values);
        let slope: f64 = tip().map(|(weight, value)| weight * value).sum();
        let size = tip().fold(0.0, |size: f64, (_, value)| size.max(value.abs()));
        let is_none = (slope * self.reach).abs() <= NO_CUSP * size;
        if is_none { 0.0 } else { slope }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// q = 1 − x and 1 − x², and their sum, up to a = 1 between two springs.
    #[test]
    fn the_force_of_cone_and_paraboloid_is_exact() {
        let grid = RadialGrid::uniform(37, 1.3).expect("a grid");
        let row = WinklerFoundation::new(&grid);
        let (x, t) = (grid.nodes(), grid.squares());
        let nodes = x.partition_point(|&x| x < 1.0);
        let contact = NormalContact {
            strongest: 1.0,
            radius: 1.0,
            nodes,
        };
        for (cone, square) in [(1.0, 0.0), (0.0, 1.0), (0.7, 0.4)] {
            let q = |x: f64| (cone * (1.0 - x) + square * (1.0 - x * x)).max(0.0);
            let mut load = Field::zeros(x.len());
            load.nodal = x.iter().map(|&x| q(x)).collect();
            // For a cone, the chord in x² of the last cell replaces its straight line.
            let last = [nodes - 1, nodes];
            let cusp = row.cusp(&load.nodal, 1.0);
            assert!((cusp + cone).abs() < 1e-9, "{cusp} {cone}");
            kink::polyline(
                last.map(|j| t[j]),
                last.map(|j| load.nodal[j]),
                &[(1.0, 0.0)],
                &mut load.kinks,
            );
            let exact = 2.0 * (cone / 2.0 + square * 2.0 / 3.0);
            let force = row.force(&load, contact);
            assert!((force / exact - 1.0).abs() < 1e-9, "{force} {exact}");
        }
    }
}

//! How a scar is curved between its last nodes, where it lies against an even pressure that ends there.
//!
//! # Formula
//!
//! In contact the scar has the shape of the surface under its pressure, whose slope grows without bound towards the edge a
//! of an even pressure p₀: the [displacement](super::dome) of a dome of the height h = 2p₀ is
//!
//! ```text
//! u(r) − u(a) = −(h/(2πa E*)) ε ln ε + smooth,                          ε = a² − t, t = r²
//! ```
//!
//! of round and line contacts alike. A line in t between nodes takes off too much in the last cells, and the springs
//! answer with a pressure that is wrong by a tenth there, up to a half just after a node has touched, on grids as
//! fine as you like. Eq. (1) of what the curve has less than its chords is, from a node t₀ outwards, ε₀ = a² − t₀,
//!
//! ```text
//! Δg(x) = −(h/(πa E*)) x [2b atan(v₀/b) − v₀ − Σ m_k (v_k − v_{k+1})],    b² = a² − x², v_k² = x² − t_k
//! m_k   = mean of ln(ε/ε₀) + 1 over the cell k
//! ```
//!
//! - **Order**: of an even pressure, what is left of the error is a tenth of it at N = 60, and falls with the cells.
//! - **Cost**: a logarithm, an arc tangent and a few square roots for each of the last nodes.
//! - **At the contact edge**: nodes outside it stay unchanged.
//! - **Known failure**: of a line contact, r is taken for x, which are nearly the same in the last cells.

use std::f64::consts::PI;

/// Number of cells at the edge in which the curve differs from its chords.
const CELLS: usize = 8;

/// The curve −A ε ln ε of a scar at its edge, A = h/(2πa E*).
#[derive(Debug, Clone, Copy)]
pub struct EdgeCurve {
    /// A, 1/m.
    steepness: f64,
    /// a², m².
    edge: f64,
}

impl EdgeCurve {
    /// Makes the curve at the `edge` a² (m²) under a dome of the `height` h/E*.
    pub fn new(height: f64, edge: f64) -> Self {
        let steepness = height / (2.0 * PI * edge.sqrt());
        Self { steepness, edge }
    }

    /// How far the surface at r² = `square` (m²) is pressed below its edge, m, without the smooth part.
    pub fn at(&self, square: f64) -> f64 {
        -self.steepness * self.times_log(square, self.edge)
    }

    /// Adds to the 1D profile `g` (m) what the curve lacks to its chords up to the node `last`, the last one inside.
    pub fn add_to_profile(&self, squares: &[f64], last: usize, g: &mut [f64]) {
        let first = last.saturating_sub(CELLS);
        let whole = self.edge - squares[first];
        let log = |square: f64| self.times_log(square, whole);
        let mut means = [0.0; CELLS];
        for (mean, cell) in means.iter_mut().zip(squares[first..=last].windows(2)) {
            *mean = (log(cell[0]) - log(cell[1])) / (cell[1] - cell[0]);
        }
        for j in first + 1..=last {
            let root = |from: f64, to: f64| (to - from).max(0.0).sqrt();
            let (mut inner, left) = (
                root(squares[first], squares[j]),
                root(squares[j], self.edge),
            );
            let mut sum = 2.0 * left * inner.atan2(left) - inner;
            for (mean, &square) in means.iter().zip(&squares[first + 1..=j]) {
                let outer = root(square, squares[j]);
                sum -= mean * (inner - outer);
                inner = outer;
            }
            g[j] -= 2.0 * self.steepness * squares[j].sqrt() * sum;
        }
    }

    /// ε ln(ε/unit) at r² = `square`, m²; 0 beyond the edge.
    fn times_log(&self, square: f64, unit: f64) -> f64 {
        let left = self.edge - square;
        if left > 0.0 {
            left * (left / unit).ln()
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::abel::dome::Dome;
    use crate::math::abel::kink;
    use crate::math::abel::{AbelMethod, AbelPlan};
    use crate::math::grid::RadialGrid;

    /// f = −u of a dome has the image g = −q: between nodes a chord makes a tenth of that wrong at the last node.
    #[test]
    fn the_image_of_an_even_pressure_is_its_load() {
        let grid = RadialGrid::uniform(60, 1.3).expect("a grid");
        let plan = AbelPlan::new(AbelMethod::Product, &grid);
        let squares = grid.squares();
        for share in [0.05, 0.3, 0.9] {
            let edge = ((46.0 + share) * 1.3 / 60.0_f64).powi(2);
            let dome = Dome {
                height: 1.0,
                edge,
                last: 46,
                beyond: 0.0,
            };
            let sunk = |square: f64| (dome.displacement(square) - dome.displacement(edge)).max(0.0);
            let profile: Vec<f64> = squares.iter().map(|&t| -sunk(t.min(edge))).collect();
            let mut g = vec![0.0; 61];
            plan.image(&profile, &mut g);
            let cell = [squares[46], squares[47]];
            for kink in kink::hat(cell, profile[46], edge) {
                for (g, &t) in g.iter_mut().zip(squares) {
                    *g += 2.0 * kink.jump * t.sqrt() * (t - kink.at).max(0.0).sqrt();
                }
            }
            let exact = |j: usize| dome.displacement(edge) - dome.at(squares[j]);
            let chord = g[46] - exact(46);
            EdgeCurve::new(1.0, edge).add_to_profile(squares, 46, &mut g);
            let [last, before] = [46, 45].map(|j| g[j] - exact(j));
            assert!(
                last.abs() < 0.15 * chord.abs() && before.abs() < 0.15 * chord.abs(),
                "{share}: {chord:e} {last:e} {before:e}"
            );
        }
    }
}

//! The line load of a uniform pressure: how the load ends at the edge of a scar in gross slip.
//!
//! # Formula
//!
//! Wear makes the pressure uniform up to the edge a of a scar, so the load falls to zero there like the square root
//! D(x) = h √(a² − x²), not linearly in t = x². Its images are closed forms:
//!
//! ```text
//! (2)  w(r) = (2/π) h a E(r²/a²)                                     for r < a
//!           = (2/π) h [r E(a²/r²) − (r² − a²)/r K(a²/r²)]            for r > a
//! (3)  p(r) = h/2                                                    for r < a
//!      ∫ D dx = π h a²/4
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | h, a | height and edge of the dome | unit of the data per m, m |
//! | K, E | complete elliptic integrals of the parameter m = k² | |
//!
//! A [`Field`](super::field::Field) with a dome transforms the *rest*, its values minus the dome, which ends linearly
//! in t, and adds these images.
//!
//! While the edge of the scar moves, dδ/dn ∝ p, the pressure falls like (a − r)^θ, with θ = 0.015 and 0.003 in gross
//! slip after 20,000 and 200,000 cycles of a ball on a flat: nearly a step. Lines in t alone would put a spike of 3 to
//! 16 times the mean pressure on the last node, which never wears off.
//!
//! - **Order**: exact for a dome and a polyline in t on top of it.
//! - **Cost**: N square roots for the rest.
//! - **At r = 0**: w = h a, p = h/2.
//! - **At the contact edge**: p ends with a step.
//! - **Known failure**: if the load oscillates, p rises towards the edge of the largest contact; neither a line nor a
//!   root represents that.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_4};

use serde::{Deserialize, Serialize};

use super::kink::{self, Kink};
use crate::math::vector::write_each;

/// D(x) = h √(a² − x²) up to the edge a, 0 beyond. Nodal values include it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Dome {
    /// h, in the unit of the values per m.
    pub height: f64,
    /// a², m².
    pub edge: f64,
    /// Last node inside; at least one more node follows it.
    pub last: usize,
    /// ∫ dx of the dome from 0 to a minus the same of its polyline in t, in the unit of the values times m.
    pub beyond: f64,
}

impl Dome {
    /// Fits the height so that the last two of the `touching` values are h √(a² − x²) + c (a² − x²);
    /// `None` unless h > 0. `squares` holds r² of the nodes and `edge` is a², both in m².
    pub fn fit(touching: &[f64], squares: &[f64], edge: f64) -> Option<Self> {
        let last = touching.len().checked_sub(1).filter(|&last| last > 0)?;
        let [inner, outer] = [last - 1, last].map(|j| edge - squares[j]);
        let steep = touching[last] * inner - touching[last - 1] * outer;
        let height = steep / ((inner * outer).sqrt() * (inner.sqrt() - outer.sqrt()));
        Self::of_height(height, edge, last)
    }

    /// Fits the height so that the last two `values` are
    /// h √(a² − x²) + c, with a at the last node; `None` unless h > 0.
    pub fn at_rim(values: &[f64], squares: &[f64]) -> Option<Self> {
        let last = values.len().checked_sub(2)?;
        let edge = squares[last + 1];
        let height = (values[last] - values[last + 1]) / (edge - squares[last]).sqrt();
        Self::of_height(height, edge, last)
    }

    fn of_height(height: f64, edge: f64, last: usize) -> Option<Self> {
        let beyond = 0.0;
        let dome = Self {
            height,
            edge,
            last,
            beyond,
        };
        (height > 0.0 && height.is_finite()).then_some(dome)
    }

    /// Checks that a dome read from a file lies on the grid with these `squares`.
    pub fn fits(&self, squares: &[f64]) -> bool {
        let cell = squares.get(self.last).zip(squares.get(self.last + 1));
        let is_inside = cell.is_some_and(|(&from, &to)| (from..=to).contains(&self.edge));
        is_inside && self.height.is_finite() && self.beyond.is_finite()
    }

    /// Returns the same dome, `times` as high.
    pub fn scaled(self, times: f64) -> Self {
        Self {
            height: times * self.height,
            beyond: times * self.beyond,
            ..self
        }
    }

    /// Returns its value at x² = `square`.
    pub fn at(&self, square: f64) -> f64 {
        self.height * (self.edge - square).max(0.0).sqrt()
    }

    /// Writes the `rest`: nodal `values` minus the dome.
    pub fn subtract_from(&self, values: &[f64], squares: &[f64], rest: &mut Vec<f64>) {
        let Self { height, edge, .. } = *self;
        rest.resize(values.len(), 0.0);
        write_each(
            rest,
            values,
            squares,
            #[inline(always)]
            move |value, t| value - height * (edge - t).max(0.0).sqrt(),
        );
    }

    /// Returns the kinks that end its polyline in t at a.
    pub fn hat(&self, squares: &[f64]) -> [Kink; 3] {
        let cell = [squares[self.last], squares[self.last + 1]];
        kink::hat(cell, self.at(cell[0]), self.edge)
    }

    /// Returns ∫ D dx from 0 to a, in the unit of the values times m.
    pub fn line_integral(&self) -> f64 {
        FRAC_PI_4 * self.height * self.edge
    }

    /// Eq. (3): returns its stress at the nodes inside, in the unit of the values per m.
    pub fn stress(&self) -> f64 {
        0.5 * self.height
    }

    /// Eq. (2): returns its surface displacement at r² = `square`, in the unit of the values.
    pub fn displacement(&self, square: f64) -> f64 {
        let edge = self.edge;
        let per_height = if square < edge {
            edge.sqrt() * elliptic(square / edge)[1]
        } else {
            let [first, second] = elliptic(edge / square);
            let beyond = square - edge;
            // (r² − a²) K → 0 at the edge.
            let lost = if beyond > 0.0 { beyond * first } else { 0.0 };
            (square * second - lost) / square.sqrt()
        };
        FRAC_2_PI * self.height * per_height
    }
}

/// Returns K(m) and E(m) for 0 ≤ m ≤ 1, by the arithmetic-geometric mean: DLMF 19.8.5 and 19.8.6.
fn elliptic(m: f64) -> [f64; 2] {
    if m >= 1.0 {
        return [f64::INFINITY, 1.0];
    }
    let (mut a, mut b, mut sum, mut weight) = (1.0, (1.0 - m).sqrt(), 0.5 * m, 0.5);
    while a - b > 1e-15 * a {
        let half = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        weight *= 2.0;
        sum += weight * half * half;
    }
    let first = 0.5 * std::f64::consts::PI / a;
    [first, first * (1.0 - sum)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::grid::RadialGrid;
    use crate::math::quadrature::gauss_in_pieces;

    const DOME: Dome = Dome {
        height: 0.7,
        edge: 0.81,
        last: 0,
        beyond: 0.0,
    };

    /// The substitution x = min(a, r) sin φ removes the nearer of the two roots from Eq. (2).
    #[test]
    fn the_displacement_is_equation_2() {
        let a2 = DOME.edge;
        for square in [0.0_f64, 0.2, 0.8, 0.82, 1.7, 40.0] {
            let inner = square.min(a2);
            let w = gauss_in_pieces([0.0, std::f64::consts::FRAC_PI_2], |phi| {
                let x2 = inner * phi.sin().powi(2);
                match square < a2 {
                    true => (a2 - x2).sqrt(),
                    false => (a2 * phi.cos().powi(2)) / (square - x2).sqrt(),
                }
            });
            let exact = FRAC_2_PI * DOME.height * w;
            let found = DOME.displacement(square);
            assert!(
                (found / exact - 1.0).abs() < 1e-12,
                "{square}: {found} {exact}"
            );
        }
        let at_edge = DOME.displacement(a2);
        assert!((at_edge - FRAC_2_PI * 0.7 * 0.9).abs() < 1e-15, "{at_edge}");
    }

    #[test]
    fn two_values_tell_the_dome() {
        let grid = RadialGrid::uniform(40, 1.0).expect("a grid");
        let squares = grid.squares();
        let (root, line) = (|t: f64| 0.7 * (0.81 - t).sqrt(), |t: f64| 0.2 * (0.81 - t));
        let touching: Vec<f64> = squares[..36].iter().map(|&t| root(t) + line(t)).collect();
        let dome = Dome::fit(&touching, squares, 0.81).expect("a dome");
        assert!((dome.height - 0.7).abs() < 1e-12 && dome.last == 35);
        let mut rest = Vec::new();
        dome.subtract_from(&touching, &squares[..36], &mut rest);
        let is_line = |(rest, &t): (&f64, &f64)| (rest - line(t)).abs() < 1e-12;
        assert!(rest.iter().zip(squares).all(is_line));
        let rising: Vec<f64> = squares.iter().map(|&t| t * t).collect();
        assert_eq!(Dome::at_rim(&rising, squares), None);
        let falling: Vec<f64> = squares
            .iter()
            .map(|t| 0.4 + 0.3 * (1.0 - t).sqrt())
            .collect();
        let dome = Dome::at_rim(&falling, squares).expect("a dome");
        assert!((dome.height - 0.3).abs() < 1e-12 && dome.fits(squares));
    }
}

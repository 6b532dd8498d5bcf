//! The end of the contact in the cell that holds the rim of the worn zone.
//!
//! The contact ends just outside the [rim](super::rim), in the same cell, while q is still finite at it. That end is
//! taken in closed form, as a square root.
//!
//! # Formula
//!
//! Up to the rim the compression q = d − g runs on with the slope of the cell before. If it meets
//! zero there, that is the edge. Else q_b > 0 is left at the rim, and
//!
//! ```text
//! q = q_b − C_b √(x² − t_b)   for t_b < x² < t_a = t_b + (q_b/C_b)²
//! p += (C_b/π) asinh √((t_a − t_b)/(t_b − r²))   for r² < t_b
//! ```
//!
//! - **Order**: exact for a profile that is linear in r² on both sides of b.
//! - **Cost**: two square roots a node within the contact.
//! - **Known failure**: the [rim](super::rim)'s.

use std::f64::consts::FRAC_1_PI;

use serde::{Deserialize, Serialize};

use super::bend::{self, Bend, CLOSEST};
use super::rim::{Rim, three_bends};
use crate::math::grid::RadialGrid;

/// The end of the contact in the cell that holds the [`Rim`].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RimEdge {
    /// The contact edge, t_a = a², m².
    pub at: f64,
    /// The bends of the compression (m) for the stress. With a tail they leave q_b
    /// beyond the rim, which the tail takes away again.
    pub bends: [Bend; 3],
    cell: [f64; 2],
    first: f64,
    tail: Option<Tail>,
}

/// q = q_b − C_b √(x² − t_b).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Tail {
    /// t_b, m².
    rim: f64,
    /// q_b, m.
    compression: f64,
    /// C_b.
    steepness: f64,
}

/// The contact edge, if it lies in the rim's cell. `compression` gives d − g (m), of
/// either sign, at a node.
///
/// None means that the edge is an ordinary one, to be found by interpolation.
pub fn edge_at_rim(
    rim: &Rim,
    grid: &RadialGrid,
    compression: impl Fn(usize) -> f64,
) -> Option<RimEdge> {
    let cell = rim.cell;
    let (before, first, behind) = (
        compression(cell - 1),
        compression(cell),
        compression(cell + 1),
    );
    if !(before > 0.0 && first > 0.0 && behind <= 0.0) {
        return None;
    }
    let squares = grid.squares();
    let t = [squares[cell], squares[cell + 1]];
    let width = t[1] - t[0];
    let slope = (first - before) / (t[0] - squares[cell - 1]);
    let chord = -first / width;
    let at_rim = first + slope * (rim.at - t[0]);
    let edge = |at: f64, bend: f64, tail: Option<Tail>| RimEdge {
        at,
        bends: three_bends(t, bend, [chord, slope, 0.0]),
        cell: [grid.nodes()[cell], grid.nodes()[cell + 1]],
        first,
        tail,
    };
    if at_rim <= 0.0 {
        let at = t[0] - first / slope;
        return (at > t[0] + CLOSEST * width).then(|| edge(at, at, None));
    }
    let reach = at_rim / rim.steepness;
    let at = rim.at + reach * reach;
    (at < t[1]).then(|| {
        let tail = Tail {
            rim: rim.at,
            compression: at_rim,
            steepness: rim.steepness,
        };
        edge(at, rim.at, Some(tail))
    })
}

impl RimEdge {
    /// The bends as those of the line load, N/m; `modulus` (Pa) makes a load of the compression.
    pub fn load_bends(&self, modulus: f64) -> [Bend; 3] {
        self.bends.map(|Bend { at, jump }| Bend {
            at,
            jump: modulus * jump,
        })
    }

    /// Adds the edge's part of the stress (N/m²) to `p` on nodes with the given `squares` (m²), beside
    /// Eq. (3) on the nodal line load; `modulus` (Pa) makes a load of the compression.
    pub fn add_to_stress(&self, modulus: f64, squares: &[f64], p: &mut [f64]) {
        bend::add_to_stress(&self.load_bends(modulus), squares, p);
        if let Some(tail) = self.tail {
            let length = self.at - tail.rim;
            let weight = modulus * tail.steepness * FRAC_1_PI;
            let end = squares.partition_point(|&t| t < tail.rim);
            for (value, &t) in p[..end].iter_mut().zip(squares) {
                *value += weight * asinh_root(length / (tail.rim - t));
            }
        }
    }

    /// What the tail adds to the [stress beyond](bend::stress_beyond) the square `t`, beside that of the
    /// bends.
    pub fn tail_beyond(&self, modulus: f64, t: f64, origin: f64) -> [f64; 2] {
        let Some(tail) = self.tail.filter(|_| t < self.at) else {
            return [0.0; 2];
        };
        let length = self.at - tail.rim;
        let ([sum, arm], side) = if t < tail.rim {
            let [sum, arm] = asinh_moments(length, tail.rim - t);
            ([sum + length, arm - length * length / 3.0], -1.0)
        } else {
            (acosh_moments(length, t - tail.rim), 1.0)
        };
        let weight = modulus * tail.steepness * FRAC_1_PI;
        [sum, (tail.rim - origin) * sum + side * arm].map(|moment| weight * moment)
    }

    /// ∫ of the compression dx over the cell (m²), less that of the chord from its value at the
    /// first node to zero at the second.
    ///
    /// The tail's q_b (t_a − t_b)/3 in t becomes one in x at the tail's centre of gravity.
    pub fn line_integral(&self) -> f64 {
        let [a, b] = self.cell;
        let straight = |slope: f64, end: f64| {
            let width = end - a;
            self.first * width + slope * width * width * (end + 2.0 * a) / 3.0
        };
        let chord = -self.first / ((b - a) * (b + a));
        let slope = chord + self.bends[0].jump;
        let inside = straight(slope, self.bends[1].at.sqrt());
        let beyond = self.tail.map_or(0.0, |tail| {
            let length = self.at - tail.rim;
            tail.compression * length / 6.0 / (tail.rim + 0.3 * length).sqrt()
        });
        inside + beyond - straight(chord, b)
    }
}

/// asinh √z; by its series at all but the few nodes next to the rim, where z is not small.
fn asinh_root(z: f64) -> f64 {
    if z > 0.01 {
        return (z.sqrt() + z / (1.0 + (1.0 + z).sqrt())).ln_1p();
    }
    let terms = [
        -1.0 / 6.0,
        3.0 / 40.0,
        -5.0 / 112.0,
        35.0 / 1152.0,
        -63.0 / 2816.0,
        231.0 / 13312.0,
    ];
    let sum = terms.iter().rfold(0.0, |sum, term| z * (term + sum));
    z.sqrt() * (1.0 + sum)
}

/// ∫₀ʸ asinh √(L/y) dy and ∫₀ʸ y asinh √(L/y) dy.
fn asinh_moments(length: f64, y: f64) -> [f64; 2] {
    let arc = asinh_root(length / y);
    let root = (length * (y + length)).sqrt();
    [
        y * arc + root - length,
        0.5 * y * y * arc + root * (y - 2.0 * length) / 6.0 + length * length / 3.0,
    ]
}

/// The integrals of acosh √(L/y) and of y acosh √(L/y) from y to L.
fn acosh_moments(length: f64, y: f64) -> [f64; 2] {
    let arc = match y {
        0.0 => 0.0,
        y => (length / y).sqrt().acosh(),
    };
    let root = (length * (length - y)).sqrt();
    [
        root - y * arc,
        root * (y + 2.0 * length) / 6.0 - 0.5 * y * y * arc,
    ]
}

#[cfg(test)]
mod tests {
    use super::super::product;
    use super::super::rim::find_rim;
    use super::super::testing::{apply, kinked};
    use super::*;

    fn graded() -> RadialGrid {
        RadialGrid::graded(80, 0.5, 1.5).expect("a grid")
    }

    /// q even up to the rim, then q_b − C_b √(x² − t_b): against quadrature of Eq. (3) and of q.
    #[test]
    fn the_tail_of_the_pressure_is_exact() {
        let grid = graded();
        let wear = kinked(&grid, 0.633);
        let rim = find_rim(&grid, &wear).expect("a rim");
        let squares = grid.squares();
        let (next, slope) = (squares[rim.cell + 1], -0.07);
        let at_rim = rim.steepness * (0.4 * (next - rim.at)).sqrt();
        let compression: Vec<f64> = squares
            .iter()
            .map(|&t| {
                if t < rim.at {
                    at_rim + slope * (t - rim.at)
                } else {
                    rim.at - t
                }
            })
            .collect();
        let edge = edge_at_rim(&rim, &grid, |j| compression[j]).expect("an edge");
        assert!((edge.at - (0.6 * rim.at + 0.4 * next)).abs() < 1e-14);

        let modulus = 3.0;
        let load: Vec<f64> = compression.iter().map(|q| modulus * q.max(0.0)).collect();
        let mut p = apply(&product::stress(grid.nodes()), &load);
        edge.add_to_stress(modulus, squares, &mut p);
        for (found, &t) in p.iter().zip(squares) {
            let exact = if t < rim.at {
                let straight = -2.0 * slope * (rim.at - t).sqrt();
                // ∫ C_b dt/(2√(t − t_b)√(t − s)), with t = t_b + y².
                let (reach, cells, mut sum) = ((edge.at - rim.at).sqrt(), 2000, 0.0);
                for i in 0..cells {
                    let y = reach * (f64::from(i) + 0.5) / f64::from(cells);
                    sum += reach / f64::from(cells) / (rim.at + y * y - t).sqrt();
                }
                modulus * FRAC_1_PI * (straight + rim.steepness * sum)
            } else {
                0.0
            };
            assert!((found - exact).abs() < 1e-7, "{t}: {found} {exact}");
        }
        // The tail's stress beyond the rim has no node: its closed form, besides that of the bends.
        for cell in [[0.5 * rim.at, 0.8 * rim.at], [squares[rim.cell], next]] {
            let (parts, width) = (400_000, cell[1] - cell[0]);
            let (mut sum, mut first) = (0.0, 0.0);
            for i in 0..parts {
                let t = cell[0] + width * (f64::from(i) + 0.5) / f64::from(parts);
                let ratio = ((edge.at - rim.at) / (t - rim.at).abs()).sqrt();
                let arc = if t < rim.at {
                    ratio.asinh()
                } else {
                    ratio.max(1.0).acosh()
                };
                let p = modulus * FRAC_1_PI * rim.steepness * arc * width / f64::from(parts);
                sum += p;
                first += p * (t - cell[0]);
            }
            let [inner, outer] = cell.map(|t| edge.tail_beyond(modulus, t, cell[0]));
            let found = [inner[0] - outer[0], inner[1] - outer[1]];
            assert!((found[0] / sum - 1.0).abs() < 1e-4, "{found:?} {sum}");
            assert!((found[1] / first - 1.0).abs() < 1e-4, "{found:?} {first}");
        }

        let (from, to, cells) = (grid.nodes()[rim.cell], grid.nodes()[rim.cell + 1], 200_000);
        let chord = compression[rim.cell] / (next - squares[rim.cell]);
        let mut missing = 0.0;
        for i in 0..cells {
            let x = from + (to - from) * (f64::from(i) + 0.5) / f64::from(cells);
            let t = x * x;
            let q = if t < rim.at {
                at_rim + slope * (t - rim.at)
            } else {
                at_rim - rim.steepness * (t - rim.at).sqrt()
            };
            missing += (q.max(0.0) - chord * (next - t)) * (to - from) / f64::from(cells);
        }
        let found = edge.line_integral();
        assert!((found / missing - 1.0).abs() < 1e-5, "{found} {missing}");
    }

    #[test]
    fn the_series_goes_on_where_the_function_ends() {
        for z in [0.0, 1e-9, 1e-4, 0.003, 0.01, 0.011, 2.0] {
            let exact = f64::sqrt(z).asinh();
            assert!((asinh_root(z) - exact).abs() <= 4e-16 * exact, "{z}");
        }
    }

    #[test]
    fn an_edge_before_the_rim_is_a_plain_bend() {
        let grid = graded();
        let wear = kinked(&grid, 0.633);
        let rim = find_rim(&grid, &wear).expect("a rim");
        let squares = grid.squares();
        let zero = 0.5 * (squares[rim.cell] + rim.at);
        let compression: Vec<f64> = squares.iter().map(|t| 0.2 * (zero - t)).collect();
        let edge = edge_at_rim(&rim, &grid, |j| compression[j]).expect("an edge");
        assert!((edge.at - zero).abs() < 1e-13);
        let hats = bend::line_integral(&edge.bends, grid.radius());
        assert!((edge.line_integral() - hats).abs() < 1e-14);
        let away: Vec<f64> = squares.iter().map(|t| 0.2 * (0.5 * zero - t)).collect();
        assert_eq!(edge_at_rim(&rim, &grid, |j| away[j]), None);
    }
}

//! Kinks between nodes: corrects the three transforms where the data kink inside a cell.
//!
//! # Formula
//!
//! A profile that is linear in t = x² between nodes, but has a kink inside a cell, differs from its
//! chord by a hat: a sum of kinks J (t − t_m)₊ at both ends of the cell and at the kink, with ΣJ = 0
//! and ΣJ t_m = 0. The transforms of one kink are closed forms:
//!
//! ```text
//! (1)  g(x) = 2x J √(x² − t_m)₊
//! (2)  w(r) = (2/π) J [(r²/2 − t_m) acos(x_m/r) + ½ x_m √(r² − t_m)]    for r > x_m
//! (3)  p(r) = (2/π) J √(t_m − r²)₊
//!      ∫₀ᴸ dx = J (L − x_m)² (L + 2x_m)/3
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | t_m, x_m = √t_m | place of the kink | m², m |
//! | J | jump of the slope d/dt there | unit of the data per m² |
//!
//! This form is ours. Unlike the subtraction of a singular part it is local and bounded: the data are known on both
//! sides of the kink, so nothing is extrapolated. With the stick border and the contact edge given as kinks, Cattaneo's
//! shear stress of a paraboloid is right to 2e-14 of its peak at N = 100 (2e-2 to 6e-2 without).
//!
//! - **Order**: exact for polylines in t.
//! - **Cost**: O(N) square roots per kink, and arc cosines in (2).
//! - **At r = 0**: g and w of a kink vanish there; p is (2/π) J x_m.
//! - **At the contact edge**: the edge is one of the inner points, with the value 0.
//! - **Known failure**: (3) takes the load to be even about the far field; only hats, whose kinks cancel beyond
//!   their cell, leave the end of the load in place.

use std::f64::consts::FRAC_2_PI;

use serde::{Deserialize, Serialize};

use crate::math::grid::RadialGrid;
use crate::math::vector::vectorized;

/// Kinks closer to a node than this share of the cell count as on the node.
const CLOSEST: f64 = 1e-9;

/// One kink J (t − t_m)₊ of a profile over t = x².
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Kink {
    /// Position t_m = x_m², m².
    pub at: f64,
    /// The jump J of the slope d/dt, in the unit of the profile per m².
    pub jump: f64,
}

/// Pushes the kinks of the cell from `t[0]` to `t[1]`, relative to the chord. The profile takes the values `v` at the
/// ends and runs straight in t through the `inner` points (t, value).
///
/// Skips points outside the cell, points not beyond the previous one, and points within 1e-9 of the cell from a node.
/// Without inner points it pushes nothing.
pub fn polyline(t: [f64; 2], v: [f64; 2], inner: &[(f64, f64)], kinks: &mut Vec<Kink>) {
    let least = CLOSEST * (t[1] - t[0]);
    let chord = (v[1] - v[0]) / (t[1] - t[0]);
    let (mut at, mut value, mut slope) = (t[0], v[0], chord);
    let mut bend = |at, jump| kinks.push(Kink { at, jump });
    for &(next, height) in inner {
        if !(next > at + least && next < t[1] - least) {
            continue;
        }
        let steepness = (height - value) / (next - at);
        bend(at, steepness - slope);
        (at, value, slope) = (next, height, steepness);
    }
    if at > t[0] {
        let steepness = (v[1] - value) / (t[1] - at);
        bend(at, steepness - slope);
        bend(t[1], chord - steepness);
    }
}

/// Returns the kinks, relative to the chord, of a cell from `t[0]` to `t[1]` whose profile falls from `height` to zero
/// at `end` and stays zero; they have no jumps if `end` is on a node.
pub fn hat(t: [f64; 2], height: f64, end: f64) -> [Kink; 3] {
    let least = CLOSEST * (t[1] - t[0]);
    let is_inside = end > t[0] + least && end < t[1] - least;
    let chord = -height / (t[1] - t[0]);
    let falls = if is_inside {
        -height / (end - t[0])
    } else {
        chord
    };
    let last = if is_inside { 0.0 } else { chord };
    let jumps = [
        (t[0], falls - chord),
        (end, last - falls),
        (t[1], chord - last),
    ];
    jumps.map(|(at, jump)| Kink { at, jump })
}

/// Checks that kinks read from a file are hats on this grid: each begins inside the grid and ends at the outer node of
/// its cell at the latest.
pub fn are_hats(kinks: &[Kink], squares: &[f64]) -> bool {
    let mut hat = None;
    kinks.iter().all(|kink| {
        let end = hat.or_else(|| {
            let next = squares.partition_point(|&t| t <= kink.at);
            squares.get(next).copied()
        });
        hat = end.filter(|&end| kink.at < end);
        kink.at >= 0.0 && kink.jump.is_finite() && end.is_some_and(|end| kink.at <= end)
    })
}

/// Eq. (2): adds the effect of kinks of u to the surface displacement `w`.
pub fn add_to_displacement(kinks: &[Kink], grid: &RadialGrid, w: &mut [f64]) {
    let squares = grid.squares();
    for kink in kinks {
        let first = squares.partition_point(|&t| t <= kink.at);
        let x = kink.at.sqrt();
        for (value, &t) in w[first..].iter_mut().zip(&squares[first..]) {
            let root = (t - kink.at).sqrt();
            let arc = root.atan2(x);
            *value += FRAC_2_PI * kink.jump * ((0.5 * t - kink.at) * arc + 0.5 * x * root);
        }
    }
}

/// Eq. (3): adds the effect of kinks of q (N/m) to the stress `p` (N/m²) on nodes with the given `squares`.
pub fn add_to_stress(kinks: &[Kink], squares: &[f64], p: &mut [f64]) {
    vectorized(
        #[inline(always)]
        || {
            // Copied by value: the loop writes, and would otherwise reload them for every node.
            for &Kink { at, jump } in kinks {
                let weight = FRAC_2_PI * jump;
                // Zero behind the kink.
                for (value, &t) in p.iter_mut().zip(squares) {
                    *value += weight * (at - t).max(0.0).sqrt();
                }
            }
        },
    );
}

/// Returns ∫ of the kinks dx from x = 0 to `radius`, half of what they add to the force of the springs.
pub fn line_integral(kinks: &[Kink], radius: f64) -> f64 {
    let integral = |kink: &Kink| {
        let x = kink.at.sqrt();
        let width = (radius - x).max(0.0);
        kink.jump * width * width * (radius + 2.0 * x) / 3.0
    };
    kinks.iter().map(integral).sum()
}

#[cfg(test)]
mod tests {
    use super::super::testing::apply;

    use super::super::product;
    use super::*;

    /// A polyline in t with kinks at t = 0.3 and 0.33, inside one coarse cell, and zero beyond 0.7.
    fn bent(t: f64) -> f64 {
        let through = [(0.0, 1.0), (0.3, 0.8), (0.33, 0.2), (0.7, 0.0), (9.0, 0.0)];
        let k = through.partition_point(|&(at, _)| at <= t).clamp(1, 4);
        let ((a, va), (b, vb)) = (through[k - 1], through[k]);
        va + (vb - va) * (t - a) / (b - a)
    }

    /// Compares hats on a coarse grid with a grid that has nodes at the kinks.
    #[test]
    fn hats_are_as_good_as_nodes() {
        let grid = RadialGrid::uniform(12, 1.2).expect("a grid");
        let squares = grid.squares();
        let values: Vec<f64> = squares.iter().map(|&t| bent(t)).collect();
        let mut kinks = Vec::new();
        for k in 0..grid.cells() {
            let ends = [squares[k], squares[k + 1]];
            let inner = [0.3, 0.33, 0.7].map(|t| (t, bent(t)));
            polyline(ends, [values[k], values[k + 1]], &inner, &mut kinks);
        }
        assert_eq!(kinks.len(), 4 + 3);
        let mut nodes = grid.nodes().to_vec();
        nodes.extend([0.3_f64, 0.33, 0.7].map(f64::sqrt));
        nodes.sort_by(f64::total_cmp);
        let fine: Vec<f64> = nodes.iter().map(|x| bent(x * x)).collect();
        let check = |found: Vec<f64>, exact: Vec<f64>| {
            for (x, found) in grid.nodes().iter().zip(found) {
                let at = nodes.partition_point(|node| node < x);
                assert!(
                    (found - exact[at]).abs() < 1e-13,
                    "{x}: {found} {}",
                    exact[at]
                );
            }
        };

        // Eq. (1) of the kinks; profiles in a run have no kinks.
        let mut g = apply(&product::profile(grid.nodes()), &values);
        for (g, &t) in g.iter_mut().zip(squares) {
            let behind = kinks.iter().filter(|kink| kink.at < t);
            *g += behind
                .map(|kink| 2.0 * kink.jump * (t * (t - kink.at)).sqrt())
                .sum::<f64>();
        }
        check(g, apply(&product::profile(&nodes), &fine));

        let mut w = apply(&product::displacement(grid.nodes()), &values);
        add_to_displacement(&kinks, &grid, &mut w);
        check(w, apply(&product::displacement(&nodes), &fine));

        let mut p = apply(&product::stress(grid.nodes()), &values);
        add_to_stress(&kinks, squares, &mut p);
        check(p, apply(&product::stress(&nodes), &fine));

        let integral = |nodes: &[f64], values: &[f64]| -> f64 {
            (0..nodes.len() - 1)
                .map(|k| {
                    let (a, b) = (nodes[k], nodes[k + 1]);
                    let slope = (values[k + 1] - values[k]) / (b * b - a * a);
                    (values[k] - slope * a * a) * (b - a) + slope * (b * b * b - a * a * a) / 3.0
                })
                .sum()
        };
        let hats = line_integral(&kinks, grid.radius());
        let missing = integral(&nodes, &fine) - integral(grid.nodes(), &values);
        assert!((hats - missing).abs() < 1e-14, "{hats} {missing}");
    }

    #[test]
    fn a_hat_is_a_polyline_to_zero() {
        for end in [1.2, 1.0, 2.0, 2.5] {
            let mut kinks = Vec::new();
            polyline([1.0, 2.0], [0.7, 0.0], &[(end, 0.0)], &mut kinks);
            let hat = hat([1.0, 2.0], 0.7, end);
            if kinks.is_empty() {
                assert!(hat.iter().all(|kink| kink.jump == 0.0));
            } else {
                assert_eq!(kinks, hat);
            }
        }
    }

    #[test]
    fn points_outside_the_cell_or_on_its_ends_bend_nothing() {
        let mut kinks = Vec::new();
        let inner = [
            (0.5, 7.0),
            (1.0 + 1e-10, 7.0),
            (2.0 - 1e-10, 7.0),
            (3.0, 7.0),
        ];
        polyline([1.0, 2.0], [0.0, 1.0], &inner, &mut kinks);
        assert_eq!(kinks, []);
        polyline(
            [1.0, 2.0],
            [0.0, 1.0],
            &[(1.5, 1.0), (1.25, 9.0)],
            &mut kinks,
        );
        let jumps: Vec<(f64, f64)> = kinks.iter().map(|kink| (kink.at, kink.jump)).collect();
        assert_eq!(jumps, [(1.0, 1.0), (1.5, -2.0), (2.0, 1.0)]);
    }
}

//! Kinks between nodes: what the three transforms lack where the data bend inside a cell.
//!
//! # Formula
//!
//! A profile that is linear in t = x² between nodes, but has a kink inside a cell, differs from its
//! chord by a hat: a sum of bends J (t − t_m)₊ at both ends of the cell and at the kink, with ΣJ = 0
//! and ΣJ t_m = 0. The transforms of one bend are closed forms:
//!
//! ```text
//! (1)  g(x) = 2x J √(x² − t_m)₊
//! (2)  w(r) = (2/π) J [(r²/2 − t_m) acos(x_m/r) + ½ x_m √(r² − t_m)]    for r > x_m
//! (3)  p(r) = (2/π) J √(t_m − r²)₊
//!      ∫ p dt = (4/3π) J (t_m − t)₊^{3/2}  from t to t_m
//!      ∫₀ᴸ dx = J (L − x_m)² (L + 2x_m)/3
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | t_m, x_m = √t_m | place of the bend | m², m |
//! | J | jump of the slope d/dt there | unit of the data per m² |
//!
//! This is ours. Against the subtraction of a singular part it has the merit that it is local and
//! bounded: the data are known on both sides of the kink and nothing is extrapolated. With the stick
//! border and the contact edge given so, Cattaneo's shear stress of a paraboloid is right to 2e-14 of
//! its peak at N = 100 (2e-2 to 6e-2 without).
//!
//! - **Order**: exact for polylines in t.
//! - **Cost**: O(N) square roots a bend, and arc cosines in (2).
//! - **At r = 0**: g and w of a bend vanish there; p is (2/π) J x_m.
//! - **At the contact edge**: the edge is one of the inner points, with the value 0.
//! - **Known failure**: (3) takes the load as even about the far field it is given: only hats, whose
//!   bends cancel beyond their cell, leave the load's end where it was.

use std::f64::consts::{FRAC_1_PI, FRAC_2_PI};

use serde::{Deserialize, Serialize};

use crate::math::grid::RadialGrid;
use crate::math::vector::vectorized;

/// A break point closer to a node than this share of its cell is taken to be the node.
pub(super) const CLOSEST: f64 = 1e-9;

/// One bend J (t − t_m)₊ of a profile over t = x².
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Bend {
    /// Where: t_m = x_m², m².
    pub at: f64,
    /// The jump J of the slope d/dt, in the unit of the profile per m².
    pub jump: f64,
}

/// Pushes the bends of a cell from `t[0]` to `t[1]`, with the values `v` at its ends, whose profile
/// runs straight in t through the `inner` points (t, value), relative to the chord.
///
/// Points that do not lie inside the cell, or not beyond the point before, are passed over; so are
/// those that stand on a node as near as makes no difference (1e-9 of the cell). Without inner
/// points nothing is pushed.
pub fn polyline(t: [f64; 2], v: [f64; 2], inner: &[(f64, f64)], bends: &mut Vec<Bend>) {
    let least = CLOSEST * (t[1] - t[0]);
    let chord = (v[1] - v[0]) / (t[1] - t[0]);
    let (mut at, mut value, mut slope) = (t[0], v[0], chord);
    for &(next, height) in inner {
        if !(next > at + least && next < t[1] - least) {
            continue;
        }
        let steepness = (height - value) / (next - at);
        bends.push(Bend {
            at,
            jump: steepness - slope,
        });
        (at, value, slope) = (next, height, steepness);
    }
    if at > t[0] {
        let steepness = (v[1] - value) / (t[1] - at);
        bends.push(Bend {
            at,
            jump: steepness - slope,
        });
        bends.push(Bend {
            at: t[1],
            jump: chord - steepness,
        });
    }
}

/// The bends of hats, each with the cell (between nodes k and k + 1) that its hat fills.
pub fn by_cell<'a>(
    bends: &'a [Bend],
    squares: &'a [f64],
) -> impl Iterator<Item = (usize, Bend)> + 'a {
    let mut hat = None;
    bends.iter().map(move |&bend| {
        let cell = hat.unwrap_or_else(|| squares.partition_point(|&t| t <= bend.at) - 1);
        // A hat ends on the outer node of its cell.
        hat = (bend.at < squares[cell + 1]).then_some(cell);
        (cell, bend)
    })
}

/// Whether [`by_cell`] can tell the cells of bends that come from a file: each hat begins inside the grid and
/// goes on to the outer node of its cell at most.
pub fn are_hats(bends: &[Bend], squares: &[f64]) -> bool {
    let mut hat = None;
    bends.iter().all(|bend| {
        let end = hat.or_else(|| {
            let next = squares.partition_point(|&t| t <= bend.at);
            squares.get(next).copied()
        });
        hat = end.filter(|&end| bend.at < end);
        bend.at >= 0.0 && bend.jump.is_finite() && end.is_some_and(|end| bend.at <= end)
    })
}

/// Eq. (1): adds what bends of f do to the 1D profile `g` on nodes with the given `squares` (m²).
pub fn add_to_profile(bends: &[Bend], squares: &[f64], g: &mut [f64]) {
    vectorized(
        #[inline(always)]
        || {
            for bend in bends {
                let first = squares.partition_point(|&t| t <= bend.at);
                for (value, &t) in g[first..].iter_mut().zip(&squares[first..]) {
                    *value += 2.0 * bend.jump * (t * (t - bend.at)).sqrt();
                }
            }
        },
    );
}

/// Eq. (2): adds what bends of u do to the surface displacement `w`.
pub fn add_to_displacement(bends: &[Bend], grid: &RadialGrid, w: &mut [f64]) {
    let squares = grid.squares();
    for bend in bends {
        let first = squares.partition_point(|&t| t <= bend.at);
        let x = bend.at.sqrt();
        for (value, &t) in w[first..].iter_mut().zip(&squares[first..]) {
            let root = (t - bend.at).sqrt();
            let arc = root.atan2(x);
            *value += FRAC_2_PI * bend.jump * ((0.5 * t - bend.at) * arc + 0.5 * x * root);
        }
    }
}

/// Eq. (3): adds what bends of q (N/m) do to the stress `p` (N/m²) on nodes with the given `squares`.
pub fn add_to_stress(bends: &[Bend], squares: &[f64], p: &mut [f64]) {
    vectorized(
        #[inline(always)]
        || {
            for bend in bends {
                let weight = FRAC_2_PI * bend.jump;
                let end = squares.partition_point(|&t| t < bend.at);
                for (value, &t) in p[..end].iter_mut().zip(squares) {
                    *value += weight * (bend.at - t).sqrt();
                }
            }
        },
    );
}

/// ∫ p dt and ∫ p (t − t₀) dt, N and N m², beyond the square `t` (m²), of the stress p of Eq. (3) that bends of
/// q (N/m) make; `origin` is t₀. A cell has the difference between its ends.
pub fn stress_beyond(bends: impl IntoIterator<Item = Bend>, t: f64, origin: f64) -> [f64; 2] {
    let (mut sum, mut first) = (0.0, 0.0);
    for bend in bends {
        let far = (bend.at - t).max(0.0);
        let area = bend.jump * far * far.sqrt();
        sum += area;
        first += area * (bend.at - origin - 0.6 * far);
    }
    [sum, first].map(|moment| FRAC_2_PI * 2.0 / 3.0 * moment)
}

/// The same of the stress q_b/(π√(t_b − r²)) that a load makes which ends with the value `load` (N/m), at the
/// square `end`.
pub fn jump_beyond(end: f64, load: f64, t: f64, origin: f64) -> [f64; 2] {
    let far = (end - t).max(0.0);
    let sum = 2.0 * FRAC_1_PI * load * far.sqrt();
    [sum, sum * (end - origin - far / 3.0)]
}

/// ∫ of the bends dx from x = 0 to `radius`, half of what they add to the force of the springs.
pub fn line_integral(bends: &[Bend], radius: f64) -> f64 {
    let integral = |bend: &Bend| {
        let x = bend.at.sqrt();
        let width = (radius - x).max(0.0);
        bend.jump * width * width * (radius + 2.0 * x) / 3.0
    };
    bends.iter().map(integral).sum()
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

    #[test]
    fn the_stress_of_a_cell_sums_to_its_moments() {
        let bends = [(0.25, 1.3), (0.4, -0.7), (0.46, 0.4), (0.9, -0.2)];
        let bends = bends.map(|(at, jump)| Bend { at, jump });
        for cell in [[0.1, 0.2], [0.3, 0.5], [0.41, 0.44], [0.9, 1.0]] {
            let (parts, width) = (20_000, cell[1] - cell[0]);
            let middles =
                (0..parts).map(|i| cell[0] + width * (f64::from(i) + 0.5) / f64::from(parts));
            let squares: Vec<f64> = middles.collect();
            let mut p = vec![0.0; squares.len()];
            add_to_stress(&bends, &squares, &mut p);
            let step = width / f64::from(parts);
            let sum: f64 = p.iter().map(|p| p * step).sum();
            let arm = squares.iter().map(|t| t - cell[0]);
            let first: f64 = arm.zip(&p).map(|(arm, p)| arm * p * step).sum();
            let [inner, outer] = cell.map(|t| stress_beyond(bends, t, cell[0]));
            let found = [inner[0] - outer[0], inner[1] - outer[1]];
            assert!((found[0] - sum).abs() < 1e-7, "{cell:?}: {found:?} {sum}");
            assert!(
                (found[1] - first).abs() < 1e-8,
                "{cell:?}: {found:?} {first}"
            );
        }
    }

    /// With y = √(t_b − t) the stress of the jump has no singularity left.
    #[test]
    fn the_stress_of_a_jump_at_the_rim_sums_to_its_moments() {
        let (end, load, origin) = (0.81_f64, 1.7, 0.3);
        for t in [0.3, 0.6, 0.8, 0.81] {
            let (parts, far) = (1000, (end - t).sqrt());
            let step = far / f64::from(parts);
            let stress_by_y = 2.0 * FRAC_1_PI * load * step;
            let (mut sum, mut first) = (0.0, 0.0);
            for i in 0..parts {
                let y = step * (f64::from(i) + 0.5);
                sum += stress_by_y;
                first += stress_by_y * (end - y * y - origin);
            }
            let found = jump_beyond(end, load, t, origin);
            assert!((found[0] - sum).abs() < 1e-12, "{t}: {found:?} {sum}");
            assert!((found[1] - first).abs() < 1e-6, "{t}: {found:?} {first}");
        }
    }

    /// The coarse grid with hats against a grid that has nodes at the kinks.
    #[test]
    fn hats_are_as_good_as_nodes() {
        let grid = RadialGrid::uniform(12, 1.2).expect("a grid");
        let squares = grid.squares();
        let values: Vec<f64> = squares.iter().map(|&t| bent(t)).collect();
        let mut bends = Vec::new();
        for k in 0..grid.cells() {
            let ends = [squares[k], squares[k + 1]];
            let inner = [0.3, 0.33, 0.7].map(|t| (t, bent(t)));
            polyline(ends, [values[k], values[k + 1]], &inner, &mut bends);
        }
        assert_eq!(bends.len(), 4 + 3);
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

        let mut g = apply(&product::profile(grid.nodes()), &values);
        add_to_profile(&bends, squares, &mut g);
        check(g, apply(&product::profile(&nodes), &fine));

        let mut w = apply(&product::displacement(grid.nodes()), &values);
        add_to_displacement(&bends, &grid, &mut w);
        check(w, apply(&product::displacement(&nodes), &fine));

        let mut p = apply(&product::stress(grid.nodes()), &values);
        add_to_stress(&bends, squares, &mut p);
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
        let hats = line_integral(&bends, grid.radius());
        let missing = integral(&nodes, &fine) - integral(grid.nodes(), &values);
        assert!((hats - missing).abs() < 1e-14, "{hats} {missing}");
    }

    #[test]
    fn points_outside_the_cell_or_on_its_ends_bend_nothing() {
        let mut bends = Vec::new();
        let inner = [
            (0.5, 7.0),
            (1.0 + 1e-10, 7.0),
            (2.0 - 1e-10, 7.0),
            (3.0, 7.0),
        ];
        polyline([1.0, 2.0], [0.0, 1.0], &inner, &mut bends);
        assert_eq!(bends, []);
        polyline(
            [1.0, 2.0],
            [0.0, 1.0],
            &[(1.5, 1.0), (1.25, 9.0)],
            &mut bends,
        );
        let jumps: Vec<(f64, f64)> = bends.iter().map(|bend| (bend.at, bend.jump)).collect();
        assert_eq!(jumps, [(1.0, 1.0), (1.5, -2.0), (2.0, 1.0)]);
    }
}

//! The rim of the worn zone, where a worn profile has a kink.
//!
//! Late in a run the worn depth δ falls to nothing at a rim b with a finite slope. The rim lies between
//! two nodes, and g rises like √(x² − b²) behind it. The kink is taken in closed form, as bends of f, and so is the
//! contact's edge beside it: see [`rim_edge`](super::rim_edge). Without them the error of f in a fretting run is
//! three times as large.
//!
//! - **Order**: exact for a profile that is linear in r² on both sides of b.
//! - **Cost**: one square root a node.
//! - **Known failure**: next to b the pressure in the rim's cell is steeper than its nodes say, so the
//!   rim lags by up to 0.15 of a cell, and the volume under the profile leaps when it passes a node. From
//!   N = 200 on this is the largest part of the error of f.

use std::f64::consts::PI;

use super::bend::Bend;
use crate::math::grid::RadialGrid;
use crate::math::scan::largest;

/// A node counts as worn from this share of the deepest wear on.
const WORN: f64 = 1e-12;

/// A rim closer to a node than this share of its cell is taken to be the node.
const CLOSEST_RIM: f64 = 1e-6;

/// The kink of the worn profile at the rim of the worn zone, between two nodes.
///
/// # Formula
///
/// The lines in t through the last two nodes before and the first two nodes behind the cell meet at
/// t_b inside it, the left one with the lesser slope. Beyond the rim g rises like C_b √(x² − t_b),
/// C_b = 2 √t_b (right slope − left slope).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rim {
    /// The cell that holds the rim: between nodes `cell` and `cell` + 1.
    pub cell: usize,
    /// Where: t_b = b², m².
    pub at: f64,
    /// The worn depth at the rim above the chord of the cell, m; negative where the profile is hollow.
    pub height: f64,
    /// C_b, the factor of the square root in g beyond the rim, dimensionless.
    pub steepness: f64,
}

/// Looks for the rim of the worn zone, in the cell behind the last worn node and in the one before.
///
/// Without it a fretting run errs three to four times as much.
pub fn find_rim(grid: &RadialGrid, wear: &[f64]) -> Option<Rim> {
    let t = grid.squares();
    let deepest = largest(wear);
    let worn = wear.iter().rposition(|&depth| depth > WORN * deepest)?;
    if worn < 3 || worn + 2 > grid.cells() {
        return None;
    }
    let slope = |k: usize| (wear[k + 1] - wear[k]) / (t[k + 1] - t[k]);
    [worn, worn - 1].into_iter().find_map(|cell| {
        let (left, right) = (slope(cell - 1), slope(cell + 1));
        let width = t[cell + 1] - t[cell];
        let distance = (wear[cell + 1] - right * width - wear[cell]) / (left - right);
        let inside = distance > CLOSEST_RIM * width && distance < (1.0 - CLOSEST_RIM) * width;
        (left < right && inside).then(|| {
            let at = t[cell] + distance;
            Rim {
                cell,
                at,
                height: (left - slope(cell)) * distance,
                steepness: 2.0 * at.sqrt() * (right - left),
            }
        })
    })
}

impl Rim {
    /// The bends that the rim adds to the worn profile: for [`add_to_profile`](super::bend::add_to_profile).
    pub fn bends(&self, grid: &RadialGrid, wear: &[f64]) -> [Bend; 3] {
        let t = [grid.squares()[self.cell], grid.squares()[self.cell + 1]];
        let v = [wear[self.cell], wear[self.cell + 1]];
        let chord = (v[1] - v[0]) / (t[1] - t[0]);
        let left = chord + self.height / (self.at - t[0]);
        let right = chord - self.height / (t[1] - self.at);
        three_bends(t, self.at, [chord, left, right])
    }

    /// The volume (m³) that the rim adds to [`volume_weights`](super::worn::volume_weights): a triangle over the chord in t.
    pub fn volume(&self, grid: &RadialGrid) -> f64 {
        let nodes = &grid.nodes()[self.cell..=self.cell + 1];
        0.5 * PI * self.height * (nodes[1] - nodes[0]) * (nodes[1] + nodes[0])
    }
}

/// The bends of a cell with slope `slopes[1]` before `at` and `slopes[2]` behind it, over a chord of
/// slope `slopes[0]`.
pub(super) fn three_bends(t: [f64; 2], at: f64, slopes: [f64; 3]) -> [Bend; 3] {
    let [chord, left, right] = slopes;
    [
        (t[0], left - chord),
        (at, right - left),
        (t[1], chord - right),
    ]
    .map(|(at, jump)| Bend { at, jump })
}

#[cfg(test)]
mod tests {
    use super::super::bend::polyline;
    use super::super::testing::kinked;
    use super::*;

    #[test]
    fn the_rim_is_found_where_the_profile_bends() {
        for scale in [1e-12, 1.0] {
            let grid = RadialGrid::graded(80, 0.5 * scale, 1.5 * scale).expect("a grid");
            let wear = kinked(&grid, 0.633);
            let rim = find_rim(&grid, &wear).expect("a rim");
            let area = 2.25 * scale * scale;
            assert!((rim.at / (0.633 * area) - 1.0).abs() < 1e-12);
            assert!(rim.height < 0.0);
            let steepness = 2.0 * 0.633_f64.sqrt() * 0.1;
            assert!(
                (rim.steepness / steepness - 1.0).abs() < 1e-9,
                "{}",
                rim.steepness
            );
            let sum: f64 = rim.bends(&grid, &wear).iter().map(|bend| bend.jump).sum();
            assert!(sum.abs() < 1e-12 * rim.steepness / scale);
            assert!(rim.volume(&grid) < 0.0);
            let mut bends = Vec::new();
            let t = [grid.squares()[rim.cell], grid.squares()[rim.cell + 1]];
            let v = [wear[rim.cell], wear[rim.cell + 1]];
            polyline(t, v, &[(rim.at, 0.0)], &mut bends);
            for (own, other) in rim.bends(&grid, &wear).iter().zip(&bends) {
                assert!(
                    (own.jump - other.jump).abs() * scale < 1e-11,
                    "{own:?} {other:?}"
                );
            }
        }
        let grid = RadialGrid::graded(80, 0.5, 1.5).expect("a grid");
        assert_eq!(find_rim(&grid, &vec![0.0; grid.len()]), None);
        assert_eq!(find_rim(&grid, &vec![0.1; grid.len()]), None);
    }
}

//! Places the nodes of a run according to the worn depth of a coarser one.
//!
//! # Formula
//!
//! A run cannot be more accurate than the interpolation on its cells. The worn depth w is linear in t = r² between
//! nodes, so cells with equal shares of the integral of a monitor,
//!
//! ```text
//! M = |d²w/dt²|^(2/5)                        equal shares of ∫M dt: least error of P1 in the L2 norm
//! ```
//!
//! have the least error for their number (C. de Boor 1973, Good approximation by splines with variable knots; W. Huang,
//! R. D. Russell 2011, Adaptive Moving Mesh Methods, §2.2). M comes from second differences of w at the nodes of the
//! coarser run, smoothed once by [¼ ½ ¼]. Half of the cells follow it, and half are uniform in r: not all error is due
//! to interpolation, and regions that the coarser run did not resolve still get cells.
//!
//! - **Order**: second in N where w has an integrable monitor: also next to the stick border, where w rises like a root.
//! - **Known failure**: if the coarser run has too few cells to show the scar (8 or so), cells are placed at random.

use crate::contact::indenter::Indenter;
use crate::math::grid::RadialGrid;
use crate::math::scan::second_differences;

/// Share of the cells that follow the monitor; the others are uniform. Shares of 0.4 to 0.65 take 6 to 25 % more time
/// over 200 random scenarios at 1e-2.
const FOLLOWING: f64 = 0.5;

/// Width of the narrowest cell, in units of the radius: 1/N^1.4, so that a few narrow cells do not force every step
/// into sub-steps, but at least 1/15000, below which the rounding of w would show in M.
const NARROWEST_POWER: f64 = 1.4;
const NARROWEST: f64 = 1.0 / 15_000.0;

/// Returns the grid of `cells` cells for a scar like `wear` (m) on the coarser `grid`. The edge of a flat tip of the
/// `indenter` gets a node. `None` if nothing has worn.
pub(crate) fn place(
    grid: &RadialGrid,
    wear: &[f64],
    cells: usize,
    indenter: &Indenter,
) -> Option<RadialGrid> {
    let shares = shares(grid, wear)?;
    let (nodes, radius) = (grid.nodes(), grid.radius());
    let narrowest = (cells as f64).powf(-NARROWEST_POWER).max(NARROWEST);
    let mut sum = vec![0.0];
    for (share, pair) in shares.iter().zip(nodes.windows(2)) {
        let width = (pair[1] - pair[0]) / radius;
        let wanted = FOLLOWING * share + (1.0 - FOLLOWING) * width;
        sum.push(sum[sum.len() - 1] + wanted.min(width / (narrowest * cells as f64)));
    }
    let total = sum[sum.len() - 1];
    let mut placed: Vec<f64> = (0..=cells)
        .map(|i| inverse(&sum, nodes, total * i as f64 / cells as f64))
        .collect();
    (placed[0], placed[cells]) = (0.0, radius);
    let tip = indenter.tip_radius();
    if tip > 0.0 && tip < radius {
        let after = placed.partition_point(|&r| r < tip).clamp(2, cells - 1);
        let nearest = if tip - placed[after - 1] < placed[after] - tip {
            after - 1
        } else {
            after
        };
        placed[nearest] = tip;
    }
    RadialGrid::restored(placed, None).ok()
}

/// Returns each cell's share of ∫M dt.
fn shares(grid: &RadialGrid, wear: &[f64]) -> Option<Vec<f64>> {
    let (t, cells) = (grid.squares(), grid.cells());
    let second = second_differences(t, wear).into_iter();
    let monitor: Vec<f64> = second.map(|second| second.powf(0.4)).collect();
    let of_cell = |k: usize| 0.5 * (monitor[k] + monitor[k + 1]) * (t[k + 1] - t[k]);
    let smoothed = (0..cells).map(|k| {
        let (left, right) = (k.saturating_sub(1), (k + 1).min(cells - 1));
        0.25 * of_cell(left) + 0.5 * of_cell(k) + 0.25 * of_cell(right)
    });
    let shares: Vec<f64> = smoothed.collect();
    let total: f64 = shares.iter().sum();
    (total > 0.0 && total.is_finite()).then(|| shares.iter().map(|one| one / total).collect())
}

/// Returns the radius at which the growing `sum` over `nodes` reaches a value.
fn inverse(sum: &[f64], nodes: &[f64], value: f64) -> f64 {
    let k = sum.partition_point(|&s| s <= value).clamp(1, sum.len() - 1) - 1;
    let within = ((value - sum[k]) / (sum[k + 1] - sum[k])).clamp(0.0, 1.0);
    nodes[k] + within * (nodes[k + 1] - nodes[k])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn paraboloid() -> Indenter {
        Indenter::paraboloid(1.0).expect("a shape")
    }

    /// A worn depth that rises like a root at c = 0.4 and ends with a kink at 1.
    fn root(r: f64) -> f64 {
        let scar = (0.4..1.0).contains(&r);
        if scar {
            (r * r - 0.16).sqrt() * (1.0 - r * r)
        } else {
            0.0
        }
    }

    /// Returns the rms difference between the interpolant on `grid` and the truth.
    fn error(grid: &RadialGrid) -> f64 {
        let on: Vec<f64> = grid.nodes().iter().map(|&r| root(r)).collect();
        let squares = (0..4000).map(|i| f64::from(i) / 4000.0 * 1.2);
        let squares = squares.map(|r| (grid.interpolate(&on, r) - root(r)).powi(2));
        (squares.sum::<f64>() / 4000.0).sqrt()
    }

    #[test]
    fn cells_go_where_the_wear_is_curved() {
        let mut grid = RadialGrid::uniform(25, 1.2).expect("a grid");
        let mut last = error(&grid);
        for cells in [50, 100, 200, 400] {
            let wear: Vec<f64> = grid.nodes().iter().map(|&r| root(r)).collect();
            grid = place(&grid, &wear, cells, &paraboloid()).expect("a scar");
            let uniform = error(&RadialGrid::uniform(cells, 1.2).expect("a grid"));
            let placed = error(&grid);
            assert!(
                placed < 0.6 * uniform || cells == 50,
                "{cells}: {placed} {uniform}"
            );
            // Second order, while uniform cells have less than first.
            assert!(placed < 0.45 * last, "{cells}: {placed} after {last}");
            last = placed;
        }
    }

    #[test]
    fn a_node_stands_on_a_flat_tip_and_the_ends_are_exact() {
        let tip = Indenter::truncated_paraboloid(1.0, 0.37).expect("a shape");
        let grid = RadialGrid::uniform(20, 1.2).expect("a grid");
        let wear: Vec<f64> = grid.nodes().iter().map(|&r| root(r)).collect();
        for cells in [8, 33, 500, 5000] {
            let placed = place(&grid, &wear, cells, &tip).expect("a scar");
            assert!(placed.nodes().contains(&0.37), "{cells}");
            assert_eq!((placed.cells(), placed.radius()), (cells, 1.2));
            let narrowest = placed.nodes().windows(2).map(|r| r[1] - r[0]);
            assert!(narrowest.fold(1.0, f64::min) > 1e-6);
        }
        assert_eq!(place(&grid, &[0.0; 21], 50, &tip), None);
    }
}

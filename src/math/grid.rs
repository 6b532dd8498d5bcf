//! The radial grid: the only maker of nodes.
//!
//! One grid serves the radius r of the 3D contact and the coordinate x of the 1D contact
//! (r_i = x_i, §2 of the paper). Node 0 is always r = 0 exactly and the last node is the
//! edge of the domain exactly, so that no other file has to ask what happens there.

use super::invalid::{Invalid, positive};

/// The fewest cells a grid may have.
pub const MIN_CELLS: usize = 4;

/// The most cells a grid may have: three dense triangular operators of this size take about 0.8 GB.
pub const MAX_CELLS: usize = 8192;

/// Nodes r₀ = 0 < r₁ < … < r_N = L, in metres or in any other unit of length.
#[derive(Debug, Clone, PartialEq)]
pub struct RadialGrid {
    nodes: Vec<f64>,
}

impl RadialGrid {
    /// N = `cells` cells of equal width from r = 0 to r = `radius`: the grid of the paper.
    pub fn uniform(cells: usize, radius: f64) -> Result<Self, Invalid> {
        Self::check(cells, radius)?;
        let nodes = (0..=cells)
            .map(|i| radius * (i as f64 / cells as f64))
            .collect();
        Ok(Self { nodes })
    }

    fn check(cells: usize, radius: f64) -> Result<(), Invalid> {
        if !(MIN_CELLS..=MAX_CELLS).contains(&cells) {
            return Err(Invalid::new(
                "points",
                cells,
                format!("must be from {MIN_CELLS} to {MAX_CELLS}"),
            ));
        }
        positive("domain_radius", radius).map(|_| ())
    }

    /// All nodes, r = 0 and the domain's edge included.
    pub fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// The number of nodes, N + 1.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Never true: a grid has at least [`MIN_CELLS`] cells. Stands beside [`len`](Self::len) by custom.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The number of cells, N.
    pub fn cells(&self) -> usize {
        self.nodes.len() - 1
    }

    /// The domain's edge L.
    pub fn radius(&self) -> f64 {
        self.nodes[self.cells()]
    }

    /// Linear interpolation of nodal `values` at `r`, constant beyond the domain's edge.
    pub fn interpolate(&self, values: &[f64], r: f64) -> f64 {
        let upper = self.nodes.partition_point(|&node| node < r);
        if upper == 0 {
            return values[0];
        }
        if upper >= self.len() {
            return values[self.cells()];
        }
        let (left, right) = (self.nodes[upper - 1], self.nodes[upper]);
        let weight = (r - left) / (right - left);
        values[upper - 1] + weight * (values[upper] - values[upper - 1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_are_exact() {
        for cells in [4, 7, 100, 8192] {
            let grid = RadialGrid::uniform(cells, 1.4832396974191326e-4).expect("a grid");
            assert_eq!(grid.nodes()[0], 0.0);
            assert_eq!(grid.radius(), 1.4832396974191326e-4);
            assert_eq!(grid.cells(), cells);
            assert!(grid.nodes().windows(2).all(|pair| pair[0] < pair[1]));
        }
    }

    #[test]
    fn absurd_sizes_are_refused_before_memory_is_taken() {
        for cells in [0, 1, 3, 8193, 1_000_000_000_000] {
            let refusal = RadialGrid::uniform(cells, 1.0).expect_err("an absurd size");
            assert_eq!(refusal.field, "points");
        }
        for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let refusal = RadialGrid::uniform(10, radius).expect_err("an absurd radius");
            assert_eq!(refusal.field, "domain_radius");
        }
    }

    #[test]
    fn interpolation_is_exact_on_lines_and_at_nodes() {
        let grid = RadialGrid::uniform(10, 2.0).expect("a grid");
        let line: Vec<f64> = grid.nodes().iter().map(|r| 3.0 * r - 1.0).collect();
        for r in [0.0, 0.05, 0.2, 1.999, 2.0] {
            assert!((grid.interpolate(&line, r) - (3.0 * r - 1.0)).abs() < 1e-14);
        }
        assert_eq!(grid.interpolate(&line, 7.0), 5.0);
    }
}

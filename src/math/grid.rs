//! The radial grid; nodes are made nowhere else.
//!
//! One grid serves the radius r of the 3D contact and the coordinate x of the 1D contact (r_i =
//! x_i, §2 of the paper). Node 0 is exactly r = 0 and the last node is exactly the edge of the domain, so other modules
//! need no special cases there.

use std::sync::Arc;

use super::invalid::{Invalid, positive};

/// Minimum number of cells.
pub const MIN_CELLS: usize = 4;

/// Maximum number of cells. Methods without a form in O(N) take fewer: see
/// [`AbelMethod::most_cells`](super::abel::AbelMethod::most_cells).
pub const MAX_CELLS: usize = 100_000;

/// Share of the cells of a graded grid that lie inside its border.
const SHARE_INSIDE: f64 = 0.18;

/// Exponent with which the cells of a graded grid shrink towards its border.
const GRADING: f64 = 1.5;

/// Intended minimum width of a cell of a graded grid, in units of the radius: 1e-4 contact radii for a domain of 1.5
/// contact radii.
const NARROWEST: f64 = 1e-4 / 1.5;

/// Nodes r₀ = 0 < r₁ < … < r_N = L, in metres or in any other unit of length. Clones share them.
#[derive(Debug, Clone, PartialEq)]
pub struct RadialGrid {
    nodes: Arc<[f64]>,
    squares: Arc<[f64]>,
    border: Option<usize>,
}

impl RadialGrid {
    /// Makes N = `cells` cells of equal width from r = 0 to r = `radius`: the grid of the paper.
    pub fn uniform(cells: usize, radius: f64) -> Result<Self, Invalid> {
        Self::check(cells, radius)?;
        let nodes = (0..=cells)
            .map(|i| radius * (i as f64 / cells as f64))
            .collect();
        Ok(Self::from_nodes(nodes, None))
    }

    /// Makes N = `cells` cells from r = 0 to L = `radius` that shrink
    /// from both sides towards a node at exactly c = `border`.
    ///
    /// # Formula
    ///
    /// ```text
    /// inside   r = c − c (1 − i/n)^γ            i = 0 … n
    /// outside  r = c + (L − c) (i/(N − n))^γ    i = 1 … N − n
    /// ```
    ///
    /// 18 % of the cells lie inside, where nothing wears, and at least two on either side. γ = 3/2, since the worn
    /// profile rises like √(r − c) outside a permanent stick zone of radius c. On each side γ is lowered, to 1 at the
    /// least, if the cell next to c would be narrower than 1e-4/1.5 of L: narrower cells magnify rounding and the
    /// uncertainty of c itself.
    pub fn graded(cells: usize, border: f64, radius: f64) -> Result<Self, Invalid> {
        Self::check(cells, radius)?;
        positive("border", border)?;
        let inside = ((SHARE_INSIDE * cells as f64).round() as usize).clamp(2, cells - 2);
        let outside = cells - inside;
        let power = |width: f64, cells: usize| exponent(width, cells, NARROWEST * radius);
        Self::around(
            border,
            (inside, power(border, inside)),
            &[(radius, outside, power(radius - border, outside))],
        )
    }

    /// Makes N = `cells` cells from r = 0 to L = `radius`, `within` of them in the ring from c = `border` to
    /// a = `edge`, where they shrink towards c; the others grow away from the ring on both sides. c and a are nodes.
    ///
    /// Resolves rings of slip so thin that a [graded](Self::graded) grid of as many cells would miss them.
    pub fn ringed(
        cells: usize,
        [border, edge]: [f64; 2],
        within: usize,
        radius: f64,
    ) -> Result<Self, Invalid> {
        Self::check(cells, radius)?;
        positive("border", border)?;
        let ordered = border < edge && edge < radius;
        if !ordered || within == 0 || within + 4 > cells {
            return Err(Invalid::new(
                "edge",
                edge,
                format!("must lie between {border} and {radius}, with cells to spare"),
            ));
        }
        let inside = (cells - within).div_ceil(2);
        let outside = cells - within - inside;
        // Makes the cells next to the ring about as wide as its own.
        let cell = (edge - border) / within as f64;
        let power = |width: f64, n: usize| ((width / cell).ln() / (n as f64).ln()).max(1.0);
        Self::around(
            border,
            (inside, power(border, inside)),
            &[
                (edge, within, GRADING),
                (radius, outside, power(radius - edge, outside)),
            ],
        )
    }

    /// Makes cells that shrink towards the `border` from inside, and towards the inner end of every piece outside it.
    /// `inside` holds the number of cells and the exponent of their growth; each piece of `outwards` also its outer
    /// end, first.
    fn around(
        border: f64,
        inside: (usize, f64),
        outwards: &[(f64, usize, f64)],
    ) -> Result<Self, Invalid> {
        let (inside, power) = inside;
        let mut nodes: Vec<f64> = growing([border, 0.0], inside, power).collect();
        nodes.reverse();
        let mut from = border;
        for &(to, cells, power) in outwards {
            nodes.extend(growing([from, to], cells, power).skip(1));
            from = to;
        }
        Self::restored(nodes, Some(inside)).map_err(|_| {
            let rule = format!("leaves no room for nodes between 0 and {from}");
            Invalid::new("border", border, rule)
        })
    }

    /// Stretches all cells to end at another `radius` (m). No node counts as a border.
    pub fn widened(&self, radius: f64) -> Result<Self, Invalid> {
        Self::check(self.cells(), radius)?;
        let factor = radius / self.radius();
        let mut nodes: Vec<f64> = self.nodes.iter().map(|r| r * factor).collect();
        nodes[self.cells()] = radius;
        Self::restored(nodes, None)
    }

    /// Returns the same nodes, none of which counts as a border.
    #[must_use]
    pub fn without_border(&self) -> Self {
        Self {
            border: None,
            ..self.clone()
        }
    }

    /// Restores the grid that had these nodes and this [`border`](Self::border), bit for bit.
    pub fn restored(nodes: Vec<f64>, border: Option<usize>) -> Result<Self, Invalid> {
        let refuse = |rule: &str| Invalid::new("nodes", format!("{} of them", nodes.len()), rule);
        let (Some(&first), Some(&radius)) = (nodes.first(), nodes.last()) else {
            return Err(refuse("must be there"));
        };
        Self::check(nodes.len() - 1, radius)?;
        let ascends = nodes.windows(2).all(|pair| pair[0] < pair[1]);
        if first.to_bits() != 0 || !ascends {
            return Err(refuse("must ascend from 0"));
        }
        if border.is_some_and(|at| at == 0 || at >= nodes.len() - 1) {
            return Err(refuse(
                "must hold the border between the first and the last",
            ));
        }
        Ok(Self::from_nodes(nodes, border))
    }

    /// Returns the same spacing with another number of cells, by linear interpolation of the nodes over their indices.
    ///
    /// # Errors
    /// If a grid cannot have that many cells, or that few.
    pub fn resampled(&self, cells: usize) -> Result<Self, Invalid> {
        Self::check(cells, self.radius())?;
        let before = &self.nodes;
        let at = |i: usize| {
            let place = i as f64 * self.cells() as f64 / cells as f64;
            let k = (place as usize).min(self.cells() - 1);
            before[k] + (place - k as f64) * (before[k + 1] - before[k])
        };
        let mut nodes: Vec<f64> = (0..=cells).map(at).collect();
        nodes[cells] = self.radius();
        Self::restored(nodes, None)
    }

    fn from_nodes(nodes: Vec<f64>, border: Option<usize>) -> Self {
        let squares = nodes.iter().map(|r| r * r).collect();
        Self {
            nodes: nodes.into(),
            squares,
            border,
        }
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

    /// All nodes, including r = 0 and the domain's edge.
    pub fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// Squares of all nodes, t = r²: the variable in which even profiles are smooth.
    pub fn squares(&self) -> &[f64] {
        &self.squares
    }

    /// Index of the node on the border towards which the cells shrink; `None` on a uniform grid.
    pub fn border(&self) -> Option<usize> {
        self.border
    }

    /// The number of nodes, N + 1.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Never true: a grid has at least [`MIN_CELLS`] cells. Accompanies [`len`](Self::len) by convention.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The number of cells, N.
    pub fn cells(&self) -> usize {
        self.nodes.len() - 1
    }

    /// Returns the width of the cell around each node, half the distance between its neighbours; the end nodes take the
    /// width of the end cells.
    pub fn widths(&self) -> impl Iterator<Item = f64> {
        let (nodes, end) = (&self.nodes, self.cells());
        (0..=end).map(move |j| match j {
            0 => nodes[1],
            j if j == end => nodes[end] - nodes[end - 1],
            j => 0.5 * (nodes[j + 1] - nodes[j - 1]),
        })
    }

    /// The domain's edge L.
    pub fn radius(&self) -> f64 {
        self.nodes[self.cells()]
    }

    /// Interpolates nodal `values` at `r`; constant beyond the domain's edge.
    ///
    /// Linear in r² between the nodes, since every profile here
    /// is even in r: exact for a constant and for a paraboloid.
    pub fn interpolate(&self, values: &[f64], r: f64) -> f64 {
        interpolate(&self.nodes, values, r)
    }
}

/// Interpolates nodal `values` at `r`, linear in r² between `nodes`, constant beyond the last one.
pub fn interpolate(nodes: &[f64], values: &[f64], r: f64) -> f64 {
    let upper = nodes.partition_point(|&node| node < r);
    if upper == 0 {
        return values[0];
    }
    if upper >= nodes.len() {
        return values[nodes.len() - 1];
    }
    let (left, right) = (nodes[upper - 1], nodes[upper]);
    let weight = (r - left) * (r + left) / ((right - left) * (right + left));
    values[upper - 1] + weight * (values[upper] - values[upper - 1])
}

/// Returns the ends of `cells` cells between two radii; cell ends grow with a `power` of their index.
fn growing([from, to]: [f64; 2], cells: usize, power: f64) -> impl Iterator<Item = f64> {
    let within = move |i: usize| from + (to - from) * (i as f64 / cells as f64).powf(power);
    (0..cells).map(within).chain([to])
}

/// Returns the exponent that shrinks `cells` cells over `width` to no less than `narrowest`.
fn exponent(width: f64, cells: usize, narrowest: f64) -> f64 {
    ((width / narrowest).ln() / (cells as f64).ln()).clamp(1.0, GRADING)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_are_exact() {
        for cells in [4, 7, 100, 8192, MAX_CELLS] {
            let grid = RadialGrid::uniform(cells, 1.4832396974191326e-4).expect("a grid");
            assert_eq!(grid.nodes()[0], 0.0);
            assert_eq!(grid.radius(), 1.4832396974191326e-4);
            assert_eq!(grid.cells(), cells);
            assert!(grid.nodes().windows(2).all(|pair| pair[0] < pair[1]));
        }
    }

    #[test]
    fn a_thin_ring_has_its_cells() {
        for (ring, cells) in [
            (0.1, 100),
            (5e-4, 100),
            (1e-6, 100),
            (1e-5, 30),
            (1e-3, 1000),
        ] {
            let grid = RadialGrid::ringed(cells, [1.0, 1.0 + ring], 20, 1.5).expect("a grid");
            let inside = |r: f64| r > 1.0 && r <= 1.0 + ring;
            let count = grid.nodes().iter().filter(|&&r| inside(r)).count();
            assert_eq!((count, grid.cells()), (20, cells), "{ring}");
            assert_eq!(grid.nodes()[grid.border().expect("a border")], 1.0);
            let widths: Vec<f64> = grid.nodes().windows(2).map(|r| r[1] - r[0]).collect();
            for pair in widths.windows(2) {
                let ratio = pair[1] / pair[0];
                assert!((1e-3..=1e3).contains(&ratio), "{ring}: {ratio}");
            }
        }
        assert!(RadialGrid::ringed(22, [1.0, 1.1], 20, 1.5).is_err());
        assert!(RadialGrid::ringed(100, [1.0, 1.6], 20, 1.5).is_err());
    }

    #[test]
    fn absurd_sizes_are_refused_before_memory_is_taken() {
        for cells in [0, 1, 3, MAX_CELLS + 1, 1_000_000_000_000] {
            let refusal = RadialGrid::uniform(cells, 1.0).expect_err("an absurd size");
            assert_eq!(refusal.field, "points");
        }
        for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let refusal = RadialGrid::uniform(10, radius).expect_err("an absurd radius");
            assert_eq!(refusal.field, "domain_radius");
        }
    }

    #[test]
    fn a_graded_grid_has_its_border_on_a_node() {
        for scale in [1e-12, 1e-4, 1.0] {
            for cells in [4, 7, 25, 100, 400, 800, 8192, MAX_CELLS] {
                for fraction in [1e-3, 0.05, 0.3, 0.76, 0.99] {
                    let (border, radius) = (fraction * scale * 1.37, scale * 1.37);
                    let grid = RadialGrid::graded(cells, border, radius).expect("a grid");
                    let at = grid.border().expect("a border");
                    assert_eq!(grid.nodes()[at], border);
                    assert_eq!(grid.nodes()[0], 0.0);
                    assert_eq!(grid.radius(), radius);
                    assert_eq!(grid.cells(), cells);
                    assert!(at >= 2 && cells - at >= 2);
                    assert!(grid.nodes().windows(2).all(|pair| pair[0] < pair[1]));
                    let squares = grid.squares().iter().zip(grid.nodes());
                    assert!(squares.into_iter().all(|(t, r)| *t == r * r));
                }
            }
        }
    }

    #[test]
    fn grading_stops_before_the_cells_are_too_narrow() {
        for cells in [100, 800, 4000] {
            let grid = RadialGrid::graded(cells, 0.5, 1.5).expect("a grid");
            let at = grid.border().expect("a border");
            let width = grid.nodes()[at + 1] - grid.nodes()[at];
            let free = (cells - at) as f64;
            let expected = free.powf(-1.5).max(1e-4);
            assert!((width / expected - 1.0).abs() < 1e-9, "{cells}: {width}");
        }
    }

    #[test]
    fn another_number_of_cells_keeps_the_spacing() {
        let grid = RadialGrid::graded(60, 0.5, 1.5).expect("a grid");
        let finer = grid.resampled(120).expect("a grid");
        assert_eq!(
            finer.nodes().iter().step_by(2).collect::<Vec<_>>(),
            grid.nodes().iter().collect::<Vec<_>>()
        );
        assert_eq!(finer.resampled(60).expect("a grid"), grid.without_border());
        assert_eq!(grid.resampled(77).expect("a grid").radius(), 1.5);
        assert!(grid.resampled(0).is_err());
    }

    #[test]
    fn a_border_outside_the_domain_is_refused() {
        for border in [0.0, -0.1, 1.0, 1.5, f64::NAN, f64::INFINITY, 1.0 - 1e-16] {
            let refusal = RadialGrid::graded(100, border, 1.0).expect_err("an absurd border");
            assert_eq!(refusal.field, "border");
        }
    }

    #[test]
    fn interpolation_is_exact_on_paraboloids_and_at_nodes() {
        for grid in [
            RadialGrid::uniform(10, 2.0).expect("a grid"),
            RadialGrid::graded(10, 0.7, 2.0).expect("a grid"),
        ] {
            let even: Vec<f64> = grid.nodes().iter().map(|r| 3.0 * r * r - 1.0).collect();
            for r in [0.0, 0.05, 0.2, 1.999, 2.0] {
                assert!((grid.interpolate(&even, r) - (3.0 * r * r - 1.0)).abs() < 1e-14);
            }
            assert_eq!(grid.interpolate(&even, 7.0), 11.0);
        }
    }
}

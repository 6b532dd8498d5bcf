//! The worn depth between the nodes of a run, so that it moves smoothly with the keys.
//!
//! At the edge of a scar the depth falls like a root, as the pressure does, or like a straight line where the scar has
//! grown; outside a permanent stick zone it rises like a root. Straight lines between nodes are off by a tenth of the depth
//! in the cell of the edge, and jump when a node passes it, which leaves minima of their own. Therefore what is
//! interpolated is the depth without these factors:
//!
//! ```text
//! w = √(t − c) (b − t)^(1/q) F(t),  t = r²,  F linear between nodes
//! ```
//!
//! c is the last node before the scar, b the zero of w^q on a line through the last two worn nodes, and q = 1 or 2,
//! whichever predicts the last node better from the two before. Of Cattaneo and Mindlin's scar on 40 cells that leaves
//! 4e-3 of the depth at the points of a trace, where lines leave 2e-2.

use crate::math::abel::worn;
use crate::math::grid::RadialGrid;
use crate::math::scan::largest;

/// Minimum number of worn nodes for the factors.
const FEWEST: usize = 4;

/// Minimum distance of the edge from the last worn node, in cells.
const INTO_CELL: f64 = 1e-3;

/// The worn depth as a function of the radius.
#[derive(Debug, Clone)]
pub(super) struct WornDepth {
    grid: RadialGrid,
    /// At the nodes, m.
    worn: Vec<f64>,
    /// The largest of them, m.
    deepest: f64,
    shape: Option<ScarShape>,
}

/// The factors of the depth, over t = r².
#[derive(Debug, Clone)]
struct ScarShape {
    /// Where it begins; `None` if the middle is worn.
    start: Option<f64>,
    /// Where it ends.
    end: f64,
    /// 1/q.
    power: f64,
    /// t and F at the worn nodes.
    nodes: Vec<(f64, f64)>,
}

impl WornDepth {
    /// Interpolates the depths `worn`, m, at the nodes of a grid.
    pub fn new(grid: RadialGrid, worn: Vec<f64>) -> Self {
        let shape = ScarShape::new(&grid, &worn);
        let deepest = largest(&worn);
        Self {
            grid,
            worn,
            deepest,
            shape,
        }
    }

    /// Returns the depth at a radius, m; nothing wears outside the grid.
    pub fn at(&self, r: f64) -> f64 {
        match &self.shape {
            Some(shape) if shape.start.is_none_or(|start| r * r > start) => shape.at(r * r),
            _ if r > self.grid.radius() => 0.0,
            _ => self.grid.interpolate(&self.worn, r),
        }
    }

    /// Returns whether nothing to speak of has worn at a radius.
    pub fn is_unworn(&self, r: f64) -> bool {
        self.at(r) <= 0.01 * self.deepest
    }
}

impl ScarShape {
    /// `None` for a scar without an edge, or on too few nodes.
    fn new(grid: &RadialGrid, worn: &[f64]) -> Option<Self> {
        let ([first, last], t) = (worn::scar(worn)?, grid.squares());
        let next = *t.get(last + 1)?;
        if last + 1 < first + FEWEST {
            return None;
        }
        let slope = |k: usize, q: i32| (worn[k].powi(q) - worn[k - 1].powi(q)) / (t[k] - t[k - 1]);
        let step = t[last] - t[last - 1];
        let miss = |q: i32| {
            let predicted = worn[last - 1].powi(q) + slope(last - 1, q) * step;
            (predicted.max(0.0).powf(1.0 / f64::from(q)) - worn[last]).abs()
        };
        let q = if miss(1) <= miss(2) { 1 } else { 2 };
        let fall = -slope(last, q);
        let zero = if fall > 0.0 {
            t[last] + worn[last].powi(q) / fall
        } else {
            next
        };
        let mut shape = Self {
            start: first.checked_sub(1).map(|before| t[before]),
            end: zero.clamp(t[last] + INTO_CELL * (next - t[last]), next),
            power: 1.0 / f64::from(q),
            nodes: Vec::new(),
        };
        let rest = |k: usize| (t[k], worn[k] / shape.factors(t[k]));
        shape.nodes = (first..=last).map(rest).collect();
        Some(shape)
    }

    fn factors(&self, t: f64) -> f64 {
        let rise = self.start.map_or(1.0, |start| (t - start).max(0.0).sqrt());
        rise * (self.end - t).max(0.0).powf(self.power)
    }

    fn at(&self, t: f64) -> f64 {
        // Beyond the last node on the line through the last two, before the first one constant.
        let above = self.nodes.partition_point(|node| node.0 < t);
        let above = above.clamp(1, self.nodes.len() - 1);
        let [(left, a), (right, b)] = [self.nodes[above - 1], self.nodes[above]];
        let share = ((t - left) / (right - left)).max(0.0);
        self.factors(t) * (a + share * (b - a)).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::scan::rms;

    /// The rms error of a closed form over the scar, relative to the deepest place, by lines and without the factors.
    fn errors(reach: f64, depth: impl Fn(f64) -> f64) -> [f64; 2] {
        let grid = RadialGrid::uniform(40, reach).expect("a grid");
        let worn: Vec<f64> = grid.nodes().iter().map(|&r| depth(r)).collect();
        let curve = WornDepth::new(grid.clone(), worn.clone());
        let places = (0..400).map(|i| reach * f64::from(i) / 400.0);
        let errors =
            places.map(|r| [grid.interpolate(&worn, r), curve.at(r)].map(|found| found - depth(r)));
        let errors: Vec<[f64; 2]> = errors.collect();
        [0, 1]
            .map(|k| rms(&errors.iter().map(|error| error[k]).collect::<Vec<_>>()) / largest(&worn))
    }

    #[test]
    fn scars_are_found_between_their_nodes() {
        // In contact radii: a cycle of Cattaneo and Mindlin wears like p s, and what endless fretting leaves.
        let leg = |a: f64, b: f64| ((a - b) * (a + b)).max(0.0).sqrt();
        let around = |c: f64, r: f64| leg(r, c).atan2(c);
        let partial = errors(2.0, |r| {
            let c = 0.5;
            let slip = (r * r - 2.0 * c * c) * around(c, r) + c * leg(r, c);
            leg(1.0, r) * if r > c { slip } else { 0.0 }
        });
        let limit = errors(1.4, |r| {
            let c = 0.7;
            ((2.0 - r * r) * around(c, r) - c * leg(r, c)).max(0.0)
        });
        // A dome, as gross slip leaves it.
        let dome = errors(1.37, |r| (1.0 - r * r).max(0.0));
        for [lines, found] in [partial, limit, dome] {
            assert!(
                found < 0.03 && found < 0.7 * lines,
                "{partial:?} {limit:?} {dome:?}"
            );
        }
    }
}

//! The product method in O(N): the same discrete operators as [`product`](super::product) and
//! [`worn`](super::worn), with the far field as a sum of powers.
//!
//! # Formula
//!
//! A profile that is linear in t = x² between nodes is a sum of kinks J_k (t − t_k)₊, where J_k is the jump of its
//! slope. The image of a kink is a closed form (see [`kink`](super::kink)): a factor of the row times a function of the
//! ratio v of the two t. Away from v = 1, a sum Σ a_m v^(μ_m) approximates that function to the tolerance, and one
//! multiplication carries each power from row to row:
//!
//! ```text
//! g_j = f_0 + t_j Σ_m a_m S_m,   S_m = Σ_{k<j} J_k (t_k/t_j)^(μ_m)
//! w_j = u_0 + t_j Σ_m a_m S_m    with other powers
//! p_j = (1/π) Σ_m a_m S_m,       S_m = Σ_{k>j} J_k x_k (t_j/t_k)^(μ_m)
//! ```
//!
//! The nearest nodes (at most 8) get extra weights, the exact kernel minus what the powers give. The worn depth outside
//! its border has the same form in z = √(r² − c²), with the kinks z (z − z_k)₊:
//!
//! ```text
//! g_j = g(δ within c) + x_j { (π/2) F_1 + Z_j Σ_m a_m S_m }
//! ```
//!
//! The kernels depend on ratios only, so scale, grading and position on the grid do not matter; the number of powers
//! grows like ln N.
//!
//! - **Accuracy**: the tolerance bounds the relative error of the kernel (for w: the error relative to its largest
//!   value), and so the error of a result relative to the same sum of absolute values. Rounding adds about 1e-15 N^½
//!   of that sum. The tests hold every operator to it.
//! - **Cost**: 2K + 8 multiply-adds per node, K = 12 … 28 from N = 100 to 100 000; O(N) to set up.
//! - **Memory**: O(N): K + 8 numbers per node and operator.
//! - **Causality**: strict, as in the dense form: what is zero up to a node stays zero up to it, and no row reads its
//!   own kink.
//!   at its own kink.
//! - **At r = 0**: g = f(0), w = u(0), p = (2/π) Σ J_k x_k.
//! - **Limit**: below a few hundred nodes the dense form is faster.

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2};

use super::Transform;
use super::kernel::leg;
use crate::math::grid::RadialGrid;
use crate::math::vector::vectorized;

mod causal;
mod powers;
#[cfg(test)]
mod tests;

use causal::{BLOCK, Causal, REACH, log_distance};
pub(super) use powers::{ARC, ROOT};
use powers::{Kernel, PowerSum, WORN, fit};

/// Tolerance of the kernels in a run.
pub const TOLERANCE: f64 = 1e-8;

/// Tolerances to try in turn where cells are too narrow for the first.
pub(super) const TOLERANCES: [f64; 4] = [TOLERANCE, 1e-7, 1e-6, 1e-5];

/// Fits the powers for rows at `radii` to a relative `tolerance` of the kernel;
/// they cover all but the nearest neighbours. `None` if that is out of reach:
/// below about 1e-12 on ordinary grids, earlier on grids with very narrow cells.
pub(super) fn powers(radii: &[f64], kernel: Kernel, tolerance: f64) -> Option<PowerSum> {
    let pairs = radii.iter().zip(&radii[REACH.min(radii.len() - 1)..]);
    let pairs = pairs.filter(|(inner, _)| **inner > 0.0);
    let least = pairs.map(|(&a, &b)| log_distance(a, b)).fold(1.0, f64::min);
    // Neighbours at exactly this distance count as far.
    fit(kernel, least * (1.0 - 1e-9), tolerance)
}

/// 1/Δ of consecutive values.
fn inverse_widths(values: &[f64]) -> Vec<f64> {
    values
        .windows(2)
        .map(|pair| 1.0 / (pair[1] - pair[0]))
        .collect()
}

/// Writes the slope jumps of the first `values`, given the `inverse` widths of their cells. The values are flat before
/// and behind them.
fn write_jumps(values: &[f64], inverse: &[f64], jumps: &mut [f64]) {
    let (within, behind) = jumps.split_at_mut(inverse.len().min(jumps.len() - 1));
    vectorized(
        #[inline(always)]
        || {
            let mut before = 0.0;
            for (jump, (pair, inverse)) in within.iter_mut().zip(values.windows(2).zip(inverse)) {
                let slope = (pair[1] - pair[0]) * inverse;
                *jump = slope - before;
                before = slope;
            }
            behind.fill(0.0);
            behind[0] = -before;
        },
    );
}

/// Eq. (1) or (2): the first value and the sums, each times the square of its radius.
#[derive(Debug)]
pub(super) struct Outwards {
    squares: Vec<f64>,
    /// 1/Δt of the cells in which the values vary.
    inverse: Vec<f64>,
    sums: Causal,
}

impl Outwards {
    /// Plans the transform of values that are flat behind the first `cells`.
    pub fn new(grid: &RadialGrid, cells: usize, powers: &PowerSum) -> Self {
        Self {
            squares: grid.squares().to_vec(),
            inverse: inverse_widths(&grid.squares()[..=cells]),
            sums: Causal::new(grid.nodes(), powers),
        }
    }
}

impl Transform for Outwards {
    fn apply_from(&self, _: usize, values: &[f64], image: &mut [f64]) -> usize {
        write_jumps(values, &self.inverse, image);
        let mut pass = self.sums.pass();
        for (rows, squares) in image.chunks_mut(BLOCK).zip(self.squares.chunks(BLOCK)) {
            pass.sum(rows);
            vectorized(
                #[inline(always)]
                || {
                    for (row, square) in rows.iter_mut().zip(squares) {
                        *row = values[0] + square * *row;
                    }
                },
            );
        }
        0
    }
}

/// Eq. (3).
#[derive(Debug)]
pub(super) struct Inwards {
    nodes: Vec<f64>,
    /// 1/Δt of the cells.
    inverse: Vec<f64>,
    sums: Causal,
}

impl Inwards {
    pub fn new(grid: &RadialGrid, roots: &PowerSum) -> Self {
        let nodes = grid.nodes();
        let inwards: Vec<f64> = nodes.iter().rev().copied().collect();
        Self {
            nodes: nodes.to_vec(),
            inverse: inverse_widths(grid.squares()),
            sums: Causal::new(&inwards, roots),
        }
    }
}

impl Transform for Inwards {
    fn apply_from(&self, first: usize, q: &[f64], p: &mut [f64]) -> usize {
        let last = self.nodes.len() - 1;
        if first > last {
            return first;
        }
        let (p, nodes) = (&mut p[first..], &self.nodes[first..]);
        // The first of these rows does not use its own jump.
        write_jumps(&q[first..], &self.inverse[first..], p);
        let mut pass = self.sums.pass();
        for (rows, nodes) in p.rchunks_mut(BLOCK).zip(nodes.rchunks(BLOCK)) {
            vectorized(
                #[inline(always)]
                || {
                    for (row, x) in rows.iter_mut().zip(nodes) {
                        *row *= FRAC_1_PI * x;
                    }
                    rows.reverse();
                },
            );
            pass.sum(rows);
            rows.reverse();
        }
        let jump = FRAC_1_PI * q[last];
        if jump != 0.0 {
            let (rim, rows) = (self.nodes[last], last - first);
            for (p, &r) in p[..rows].iter_mut().zip(nodes) {
                *p += jump / leg(r, rim);
            }
            p[rows] += 2.0 * jump / leg(self.nodes[last - 1], rim);
        }
        first
    }
}

/// Eq. (1) on the worn depth, on a grid with a border.
#[derive(Debug)]
pub(super) struct WornTransform {
    border: usize,
    inner: Outwards,
    /// x and z of the nodes from the border on, and 1/Δz of their cells.
    x: Vec<f64>,
    z: Vec<f64>,
    inverse_z: Vec<f64>,
    outer: Causal,
}

impl WornTransform {
    /// Plans it with the `roots` of Eq. (1) and separate powers to the `tolerance`; `None` if that is out of reach.
    pub fn new(grid: &RadialGrid, border: usize, roots: &PowerSum, tolerance: f64) -> Option<Self> {
        let x = &grid.nodes()[border..];
        let z: Vec<f64> = x.iter().map(|&r| leg(x[0], r)).collect();
        Some(Self {
            border,
            inner: Outwards::new(grid, border, roots),
            x: x.to_vec(),
            inverse_z: inverse_widths(&z),
            outer: Causal::new(&z, &powers(&z, WORN, tolerance)?),
            z,
        })
    }
}

impl Transform for WornTransform {
    fn apply_from(&self, _: usize, depth: &[f64], g: &mut [f64]) -> usize {
        self.inner.apply_from(0, depth, g);
        // F = (δ − δ_c)/z; at the border it takes the next node's value: flat in the first cell.
        let beyond = &depth[self.border..];
        let share = |i: usize| (beyond[i] - beyond[0]) / self.z[i];
        let slope = |i: usize| match self.inverse_z.get(i) {
            Some(inverse) if i > 0 => (share(i + 1) - share(i)) * inverse,
            _ => 0.0,
        };
        let start = FRAC_PI_2 * share(1);
        let g = &mut g[self.border..];
        let mut pass = self.outer.pass();
        let (mut block, mut before) = ([0.0; BLOCK], 0.0);
        for (first, rows) in (0..).step_by(BLOCK).zip(g.chunks_mut(BLOCK)) {
            let sums = &mut block[..rows.len()];
            for (jump, i) in sums.iter_mut().zip(first..) {
                let slope = slope(i);
                *jump = slope - before;
                before = slope;
            }
            pass.sum(sums);
            for ((row, sum), i) in rows.iter_mut().zip(sums).zip(first..) {
                // The border itself gets nothing.
                if i > 0 {
                    *row += self.x[i] * (start + self.z[i] * *sum);
                }
            }
        }
        0
    }
}

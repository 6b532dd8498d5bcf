//! The product method in O(N): the same discrete operators as [`product`](super::product) and
//! [`worn`](super::worn), with the far field as a sum of powers.
//!
//! # Formula
//!
//! A profile that is linear in t = x² between nodes is a sum of kinks J_k (t − t_k)₊, J_k the jump of its
//! slope, and the image of a kink is a closed form (see [`kink`](super::kink)): a factor of the row times a function
//! of the ratio v of the two t alone. Away from v = 1 that function is κ − Σ a_m v^(μ_m) to the
//! tolerance; and a power is carried from row to row by one multiplication:
//!
//! ```text
//! g_j = f_0 + t_j { 2σ_{j−1} − Σ_m S_m },   S_m = Σ_{k<j} a_m J_k (t_k/t_j)^(μ_m)
//! w_j = u_0 + t_j { ½σ_{j−1} − Σ_m S_m }    with factors a_m of its own
//! p_j = (1/π) { 2 Σ_{k>j} J_k x_k − Σ_m S_m },   S_m = Σ_{k>j} a_m J_k x_k (t_j/t_k)^(μ_m)
//! ```
//!
//! each with the nearest nodes (at most 8) put right by weights of their own, exact less what the
//! powers give. The worn depth outside its border is the same in z = √(r² − c²), whose kinks are z (z − z_k)₊:
//!
//! ```text
//! g_j = g(δ within c) + x_j { (π/2) F_1 + Z_j [2b_{j−1} − Σ_m S_m] },   b = ΔF/Δz
//! ```
//!
//! The kernels depend on ratios only, so the form is independent of scale, grading and position on
//! the grid; the number of powers grows like ln N.
//!
//! - **Accuracy**: the tolerance bounds the relative error of the kernel (for w: the error in units of its
//!   largest value), so that of a result in units of the same sum with all signs made alike. Rounding
//!   adds about 1e-15 N^½ of that. The tests hold every operator to it.
//! - **Cost**: K multiply-adds twice and 8 more a node, K = 12 … 28 from N = 100 to 100 000; O(N) to set up.
//! - **Memory**: O(N): 2 K + 31 numbers a node for the three operators. A sweep reads K + 13 of them a node.
//! - **Causality**: strict, as that of the dense form: what is zero up to a node stays zero up to it, and row j looks at
//!   its own kink by rounding alone.
//! - **At r = 0**: g = f(0), w = u(0), p = (2/π) Σ J_k x_k.
//! - **Known failure**: none; below some hundred nodes the dense form is faster.

use std::f64::consts::{FRAC_1_PI, FRAC_PI_2};

use super::kernel::leg;
use crate::math::grid::RadialGrid;

mod near;
mod powers;
mod propagator;
mod recurrence;
mod sweep;
#[cfg(test)]
mod tests;

use near::REACH;
use powers::{Kernel, fit};
use propagator::Propagator;
use sweep::{Data, Inward, Outward};

/// The tolerance of a run. Errors of a result are about a thirtieth of it.
pub const TOLERANCE: f64 = 1e-8;

/// Tolerances to try in turn, should neighbouring nodes be so close that the first takes too many powers.
pub(super) const TOLERANCES: [f64; 4] = [TOLERANCE, 1e-7, 1e-6, 1e-5];

/// The three operators of the product method in O(N).
#[derive(Debug, PartialEq)]
pub struct FastProduct {
    nodes: Vec<f64>,
    /// 1/Δt of every cell.
    inverse: Vec<f64>,
    /// Of the powers of profile and stress, and of the displacement.
    root: Propagator,
    arc: Propagator,
    profile: Outward,
    displacement: Outward,
    stress: Inward,
}

/// The image of the worn depth in O(N), on a grid with a border.
#[derive(Debug, PartialEq)]
pub struct FastWorn {
    /// t up to the border, for the part within.
    inner: FastInner,
    border: usize,
    /// From the border on: z, x, 1/z (0 at the border) and 1/Δz.
    x: Vec<f64>,
    inverse_z: Vec<f64>,
    inverse: Vec<f64>,
    propagator: Propagator,
    outer: Outward,
}

/// Eq. (1) alone, on all nodes.
#[derive(Debug, PartialEq)]
struct FastInner {
    inverse: Vec<f64>,
    propagator: Propagator,
    profile: Outward,
}

/// ln (t_j/t_k) beyond which the powers serve: less than that of any two nodes [`REACH`] apart.
fn nearest(radii: &[f64]) -> f64 {
    let apart = |inner: f64, outer: f64| 2.0 * ((outer - inner) / inner).ln_1p();
    let pairs = radii.iter().zip(&radii[REACH.min(radii.len() - 1)..]);
    let least = pairs
        .filter(|(inner, _)| **inner > 0.0)
        .map(|(&inner, &outer)| apart(inner, outer))
        .fold(1.0, f64::min);
    least * (1.0 - 1e-9)
}

/// 1/Δt of every cell.
fn inverse_widths(nodes: &[f64]) -> Vec<f64> {
    let cells = nodes.windows(2);
    cells
        .map(|cell| 1.0 / ((cell[1] - cell[0]) * (cell[1] + cell[0])))
        .collect()
}

/// Nodal values with the slopes of their cells, and the constant that a sweep adds to.
struct Nodal<'a> {
    values: &'a [f64],
    /// 1/Δt of every cell.
    inverse: &'a [f64],
    constant: f64,
}

impl Data for Nodal<'_> {
    #[inline(always)]
    fn slopes(&self, first: usize, slopes: &mut [f64]) {
        write_slopes(&self.values[first..], &self.inverse[first..], slopes);
    }

    #[inline(always)]
    fn begin(&self, _: usize, rows: &mut [f64]) {
        rows.fill(self.constant);
    }
}

/// Writes (values_{k+1} − values_k) × inverse_k.
#[inline(always)]
fn write_slopes(values: &[f64], inverse: &[f64], slopes: &mut [f64]) {
    let pairs = values.windows(2).zip(inverse);
    for (slope, (pair, inverse)) in slopes.iter_mut().zip(pairs) {
        *slope = (pair[1] - pair[0]) * inverse;
    }
}

impl FastProduct {
    /// Plans the operators; none if the tolerance asks for more powers than there is room for.
    pub fn new(grid: &RadialGrid, tolerance: f64) -> Option<Self> {
        let nodes = grid.nodes().to_vec();
        let nearest = nearest(&nodes);
        let [root, arc] = [Kernel::Root, Kernel::Arc].map(|kernel| {
            let powers = fit(kernel, nearest, tolerance)?;
            Some((Propagator::new(&nodes, &powers.exponents), powers))
        });
        let ((root, roots), (arc, arcs)) = (root?, arc?);
        let squares = grid.squares().to_vec();
        Some(Self {
            inverse: inverse_widths(&nodes),
            profile: Outward::new(&nodes, squares.clone(), &roots, &root, nearest),
            displacement: Outward::new(&nodes, squares, &arcs, &arc, nearest),
            stress: Inward::new(&nodes, &roots, &root, nearest),
            nodes,
            root,
            arc,
        })
    }

    /// Eq. (1), as [`product::profile`](super::product::profile).
    pub fn profile(&self, f: &[f64], g: &mut [f64]) {
        let data = self.data(f, f[0]);
        self.profile.apply(&self.root, &data, g);
    }

    /// Eq. (2), as [`product::displacement`](super::product::displacement).
    ///
    pub fn displacement(&self, u: &[f64], w: &mut [f64]) {
        let data = self.data(u, u[0]);
        self.displacement.apply(&self.arc, &data, w);
    }

    /// Eq. (3), as [`product::stress`](super::product::stress).
    ///
    pub fn stress(&self, q: &[f64], p: &mut [f64]) {
        let data = self.data(q, 0.0);
        self.stress.apply(&self.nodes, &self.root, &data, p);
        let last = self.nodes.len() - 1;
        let jump = FRAC_1_PI * q[last];
        if jump != 0.0 {
            let rim = self.nodes[last];
            for (p, &r) in p[..last].iter_mut().zip(&self.nodes) {
                *p += jump / leg(r, rim);
            }
            p[last] += 2.0 * jump / leg(self.nodes[last - 1], rim);
        }
    }

    /// What a sweep needs of nodal values.
    fn data<'a>(&'a self, values: &'a [f64], constant: f64) -> Nodal<'a> {
        Nodal {
            values,
            inverse: &self.inverse,
            constant,
        }
    }
}

impl FastWorn {
    /// Plans the operator; none without a border, or if the tolerance asks for more powers than there
    /// is room for.
    pub fn new(grid: &RadialGrid, tolerance: f64) -> Option<Self> {
        let border = grid.border()?;
        let nodes = grid.nodes();
        let inner = {
            let nearest = nearest(nodes);
            let powers = fit(Kernel::Root, nearest, tolerance)?;
            let propagator = Propagator::new(nodes, &powers.exponents);
            let scale = grid.squares().to_vec();
            FastInner {
                inverse: inverse_widths(&nodes[..=border]),
                profile: Outward::new(nodes, scale, &powers, &propagator, nearest),
                propagator,
            }
        };
        let x = nodes[border..].to_vec();
        let z: Vec<f64> = x.iter().map(|&r| leg(x[0], r)).collect();
        let nearest = nearest(&z);
        let powers = fit(Kernel::Worn, nearest, tolerance)?;
        let propagator = Propagator::new(&z, &powers.exponents);
        let scale = x.iter().zip(&z).map(|(x, z)| x * z).collect();
        Some(Self {
            inner,
            border,
            inverse_z: z
                .iter()
                .map(|&z| if z > 0.0 { 1.0 / z } else { 0.0 })
                .collect(),
            inverse: z.windows(2).map(|cell| 1.0 / (cell[1] - cell[0])).collect(),
            outer: Outward::new(&z, scale, &powers, &propagator, nearest),
            propagator,
            x,
        })
    }

    /// Eq. (1) on the worn depth, as [`worn::profile`](super::worn::profile).
    pub fn profile(&self, depth: &[f64], g: &mut [f64]) {
        let (border, inner) = (self.border, &self.inner);
        let within = Within {
            depth: &depth[..=border],
            inverse: &inner.inverse,
        };
        inner.profile.apply(&inner.propagator, &within, g);
        let outside = Outside {
            depth: &depth[border..],
            first: (depth[border + 1] - depth[border]) * self.inverse_z[1],
            worn: self,
        };
        self.outer
            .apply(&self.propagator, &outside, &mut g[border..]);
    }
}

/// The worn depth up to the border, and none beyond.
struct Within<'a> {
    depth: &'a [f64],
    inverse: &'a [f64],
}

impl Data for Within<'_> {
    #[inline(always)]
    fn slopes(&self, first: usize, slopes: &mut [f64]) {
        let cells = self.inverse.len().saturating_sub(first).min(slopes.len());
        let (inside, outside) = slopes.split_at_mut(cells);
        if !inside.is_empty() {
            write_slopes(&self.depth[first..], &self.inverse[first..], inside);
        }
        outside.fill(0.0);
    }

    #[inline(always)]
    fn begin(&self, _: usize, rows: &mut [f64]) {
        rows.fill(self.depth[0]);
    }
}

/// F = (depth − that at the border)/z from the border on, and there that of the next node.
struct Outside<'a> {
    depth: &'a [f64],
    first: f64,
    worn: &'a FastWorn,
}

impl Data for Outside<'_> {
    #[inline(always)]
    fn slopes(&self, from: usize, slopes: &mut [f64]) {
        let shares = self.depth[from..].windows(2);
        let shares = shares.zip(self.worn.inverse_z[from..].windows(2));
        for ((slope, inverse), (depth, share)) in slopes
            .iter_mut()
            .zip(&self.worn.inverse[from..])
            .zip(shares)
        {
            let left = (depth[0] - self.depth[0]) * share[0];
            let right = (depth[1] - self.depth[0]) * share[1];
            *slope = (right - left) * inverse;
        }
        // F at the border is that of the next node: flat.
        if from == 0 {
            slopes[0] = 0.0;
        }
    }

    #[inline(always)]
    fn begin(&self, from: usize, rows: &mut [f64]) {
        // Nothing at the border itself.
        let border = usize::from(from == 0);
        let radii = &self.worn.x[from + border..];
        for (row, x) in rows[border..].iter_mut().zip(radii) {
            *row += FRAC_PI_2 * self.first * x;
        }
    }
}

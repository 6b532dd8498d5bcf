//! The cusp of nodal values at the tip, which an interpolant that is linear in t = x² lacks, and its three images.
//!
//! # Formula
//!
//! A cone is smooth in x and not in t. It gets one number A for the whole profile: on every cell (x_k, x_{k+1})
//!
//! ```text
//! u(x) = u_k + σ_k (x² − x_k²) + (A/X_k) (x − x_k)(x_{k+1} − x),   X_k = x_k + x_{k+1}
//! A    = (σ_0 − σ_1) / (1/X_0 − 1/X_1),   σ = Δu/Δt
//! ```
//!
//! The bubbles of A = 1 are x less its own interpolant in t, so their images are those of x, in closed form, less those of
//! that interpolant:
//!
//! ```text
//! g = (π/2) x − g(chords),   w = (2/π) r − w(chords),   p = −(1/π) acosh(L/r) − p(chords)
//! ```
//!
//! They are added outside both forms of the [product method](super::product). Where a load ends before the grid does, its
//! cusp is a [cone](super::cone) that ends there.
//!
//! - **Order**: an even smooth profile has A = O(h³).
//! - **At r = 0**: in p the bubble of the first cell is left out, or the integral would be infinite, as a cone's p(0) is.
//!   With the finite half of it alone, wear of the tip would raise the pressure there, and the tip would run away.

use std::f64::consts::{FRAC_1_PI, FRAC_2_PI, FRAC_PI_2};
use std::ops::Range;

use super::kernel::acosh_step;
use crate::math::vector::vectorized;

/// A cusp that changes the values by less than this part of them over two cells is rounding.
const NONE: f64 = 1e-9;

/// The first three nodes, which tell the cusp.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tip {
    /// A = Σ weight × value.
    weights: [f64; 3],
    /// x₂.
    reach: f64,
}

impl Tip {
    /// That of a grid with these `nodes`.
    pub fn new(nodes: &[f64]) -> Self {
        let (first, second) = (nodes[1], nodes[1] + nodes[2]);
        let scale = 1.0 / (1.0 / first - 1.0 / second);
        let inner = scale / (first * first);
        let outer = scale / ((nodes[2] - nodes[1]) * second);
        Self {
            weights: [-inner, inner + outer, -outer],
            reach: nodes[2],
        }
    }

    /// The cusp A of nodal `values`: their slope d/dx at the tip, x → 0; 0 where it is rounding.
    pub fn slope(&self, values: &[f64]) -> f64 {
        let tip = || self.weights.iter().zip(values);
        let slope: f64 = tip().map(|(weight, value)| weight * value).sum();
        let size = tip().fold(0.0, |size: f64, (_, value)| size.max(value.abs()));
        let is_none = (slope * self.reach).abs() <= NONE * size;
        if is_none { 0.0 } else { slope }
    }
}

/// An image of a cusp of slope one, beside that of the chords between the nodes.
#[derive(Debug, PartialEq)]
pub(super) struct Cusp {
    tip: Tip,
    image: Vec<f64>,
}

impl Cusp {
    /// That of Eq. (1), where `chords` computes it for a profile on `nodes` without a cusp.
    pub fn of_profile(nodes: &[f64], chords: impl Fn(&[f64], &mut [f64])) -> Self {
        Self::of(nodes, 0.0, chords, |x| FRAC_PI_2 * x)
    }

    /// That of Eq. (2).
    pub fn of_displacement(nodes: &[f64], chords: impl Fn(&[f64], &mut [f64])) -> Self {
        Self::of(nodes, 0.0, chords, |r| FRAC_2_PI * r)
    }

    /// That of Eq. (3).
    pub fn of_stress(nodes: &[f64], chords: impl Fn(&[f64], &mut [f64])) -> Self {
        let (last, radius) = (nodes.len() - 1, nodes[nodes.len() - 1]);
        // Of a load that ends with the grid: no jump has to cancel another one.
        let mut cusp = Self::of(nodes, radius, chords, |r| match r {
            0.0 => 0.0,
            r => -FRAC_1_PI * acosh_step(r, radius, r),
        });
        let pairs = nodes[1..].windows(2);
        let behind: f64 = pairs
            .map(|cell| 2.0 * (cell[1] - cell[0]) / (cell[1] + cell[0]))
            .sum();
        cusp.image[0] = -FRAC_1_PI * ((radius / nodes[1]).ln() - behind);
        cusp.image[last] = 0.0;
        cusp
    }

    /// The image `of_cone` of x less what `chords` makes of x − `from`.
    fn of(
        nodes: &[f64],
        from: f64,
        chords: impl Fn(&[f64], &mut [f64]),
        of_cone: impl Fn(f64) -> f64,
    ) -> Self {
        let cone: Vec<f64> = nodes.iter().map(|x| x - from).collect();
        let mut image = vec![0.0; nodes.len()];
        chords(&cone, &mut image);
        for (image, &x) in image.iter_mut().zip(nodes) {
            *image = of_cone(x) - *image;
        }
        Self {
            tip: Tip::new(nodes),
            image,
        }
    }

    /// Adds the image of the cusp of nodal `values` to some `rows` of `out`.
    pub fn add(&self, values: &[f64], rows: Range<usize>, out: &mut [f64]) {
        let slope = self.tip.slope(values);
        if slope == 0.0 {
            return;
        }
        let (out, images) = (&mut out[rows.clone()], &self.image[rows]);
        vectorized(
            #[inline(always)]
            || {
                for (out, image) in out.iter_mut().zip(images) {
                    *out += slope * image;
                }
            },
        );
    }
}

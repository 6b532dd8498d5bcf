//! Corrects the sum of powers for near neighbours.

use fearless_simd::{f64x4, prelude::*};

use super::powers::{LANES, Powers};
use super::propagator::Propagator;

/// A node's near neighbours are at most this many.
pub(super) const REACH: usize = 8;

/// Weights of the kinks at the nearest nodes, exact less what the powers give: by strips of four rows and there by
/// distance, so that the rows of a strip lie side by side. Memory: at most 8 N numbers.
#[derive(Debug, PartialEq)]
pub(super) struct Near {
    /// Where the weights of each strip begin, and where those of the last one end.
    starts: Vec<usize>,
    weights: Vec<[f64; LANES]>,
}

/// Which side of a row its kinks lie on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// Nearer to the origin.
    Inside,
    /// Farther out.
    Outside,
}

impl Near {
    /// For nodes at `radii`, the first of them 0, and neighbours whose ln v is less than `nearest`.
    pub fn new(
        radii: &[f64],
        side: Side,
        powers: &Powers,
        propagator: &Propagator,
        nearest: f64,
    ) -> Self {
        let mut near = Self {
            starts: vec![0],
            weights: Vec::new(),
        };
        let mut left = vec![0.0; powers.factors.len()];
        for first in (0..radii.len()).step_by(LANES) {
            let strip: [Vec<f64>; LANES] = std::array::from_fn(|lane| match first + lane {
                j if j < radii.len() => row(radii, side, powers, propagator, nearest, j, &mut left),
                _ => Vec::new(),
            });
            let reach = strip.iter().map(Vec::len).max().unwrap_or_default();
            near.weights.extend((0..reach).map(|distance| {
                let weight = |row: &Vec<f64>| row.get(distance).copied().unwrap_or(0.0);
                strip.each_ref().map(weight)
            }));
            near.starts.push(near.weights.len());
        }
        near
    }

    /// The weights of a strip at distance 1, then 2, …
    #[inline(always)]
    pub fn strip<S: Simd>(&self, simd: S, strip: usize) -> impl Iterator<Item = f64x4<S>> {
        let weights = &self.weights[self.starts[strip]..self.starts[strip + 1]];
        weights.iter().map(
            #[inline(always)]
            move |weights| f64x4::from_slice(simd, weights),
        )
    }
}

/// The weights of row `j`, from the nearest neighbour on.
fn row(
    radii: &[f64],
    side: Side,
    powers: &Powers,
    propagator: &Propagator,
    nearest: f64,
    j: usize,
    left: &mut [f64],
) -> Vec<f64> {
    left.copy_from_slice(&powers.factors);
    let mut weights = Vec::with_capacity(REACH);
    for distance in 1..=REACH {
        let (inner, outer, row) = match side {
            Side::Inside if distance <= j => (j - distance, j, j + 1 - distance),
            Side::Outside if j + distance < radii.len() => (j, j + distance, j + distance),
            _ => break,
        };
        let (inner, outer) = (radii[inner], radii[outer]);
        let apart = (outer - inner) * (outer + inner) / (outer * outer);
        if inner == 0.0 || -(-apart).ln_1p() >= nearest {
            break;
        }
        propagator.carry(row, left);
        let kernel = powers.kernel;
        let served = kernel.whole() - left.iter().sum::<f64>();
        weights.push(kernel.kink(inner / outer, apart.sqrt()) - served);
    }
    weights
}

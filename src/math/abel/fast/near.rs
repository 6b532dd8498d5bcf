//! What the sum of powers lacks between near neighbours.

use super::decay::Decay;
use super::powers::{LANES, Powers};

/// Rows are worked on in blocks of this many.
pub(super) const BLOCK: usize = 32;

/// A node's near neighbours are at most this many.
pub(super) const REACH: usize = 8;

/// Weights of the bends at the nearest nodes, exact less what the powers give, by blocks and there by
/// distance, so that the rows of a block lie side by side. Memory: at most 8 N numbers.
#[derive(Debug, PartialEq)]
pub(super) struct Near {
    /// Where the weights of each block begin; one entry more than there are blocks.
    starts: Vec<usize>,
    weights: Vec<f64>,
}

/// Which side of a row its bends lie on.
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
        decay: &Decay,
        nearest: f64,
    ) -> Self {
        let mut near = Self {
            starts: vec![0],
            weights: Vec::new(),
        };
        let nodes = radii.len();
        let mut left = vec![0.0; powers.factors.len()];
        for first in (0..nodes).step_by(BLOCK) {
            let end = (first + BLOCK).min(nodes);
            let mut block = Vec::new();
            let mut reach = 0;
            for j in first..end {
                left.copy_from_slice(&powers.factors);
                for distance in 1..=REACH {
                    let (inner, outer, row) = match side {
                        Side::Inside if distance <= j => (j - distance, j, j + 1 - distance),
                        Side::Outside if j + distance < nodes => (j, j + distance, j + distance),
                        _ => break,
                    };
                    let (inner, outer) = (radii[inner], radii[outer]);
                    let apart = (outer - inner) * (outer + inner) / (outer * outer);
                    if inner == 0.0 || -(-apart).ln_1p() >= nearest {
                        break;
                    }
                    for (lanes, row) in left.chunks_exact_mut(LANES).zip(decay.row(row)) {
                        for (left, decay) in lanes.iter_mut().zip(row) {
                            *left *= decay;
                        }
                    }
                    if distance > reach {
                        reach = distance;
                        block.resize(reach * BLOCK, 0.0);
                    }
                    let kernel = powers.kernel;
                    let served = kernel.whole() - left.iter().sum::<f64>();
                    block[(distance - 1) * BLOCK + j - first] =
                        kernel.bend(inner / outer, apart.sqrt()) - served;
                }
            }
            near.weights.extend(block);
            near.starts.push(near.weights.len());
        }
        near
    }

    /// Multiplies the weights of row j by `scale[j]`.
    pub fn scaled(mut self, scale: &[f64]) -> Self {
        for (block, rows) in scale.chunks(BLOCK).enumerate() {
            let (start, end) = (self.starts[block], self.starts[block + 1]);
            for weights in self.weights[start..end].chunks_exact_mut(BLOCK) {
                for (weight, scale) in weights.iter_mut().zip(rows) {
                    *weight *= scale;
                }
            }
        }
        self
    }

    /// The weights of a block: those at distance 1, then 2, …, each [`BLOCK`] rows.
    pub fn block(&self, block: usize) -> impl Iterator<Item = &[f64; BLOCK]> {
        let (start, end) = (self.starts[block], self.starts[block + 1]);
        self.weights[start..end].as_chunks::<BLOCK>().0.iter()
    }
}

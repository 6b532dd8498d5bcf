//! What the sum of powers lacks between near neighbours.

use super::decay::Decay;
use super::powers::{LANES, Powers};

/// A node's near neighbours are at most this many.
pub(super) const REACH: usize = 8;

/// Weights of the bends at the nearest nodes, exact less what the powers give, by strips of four rows and
/// there by distance, so that the rows of a strip lie side by side. Memory: at most 8 N numbers.
#[derive(Debug, PartialEq)]
pub(super) struct Near {
    /// Where the weights of each strip begin; one entry more than there are strips.
    starts: Vec<usize>,
    weights: Vec<[f64; LANES]>,
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
    pub fn new(radii: &[f64], side: Side, powers: &Powers, decay: &Decay, nearest: f64) -> Self {
        let mut near = Self {
            starts: vec![0],
            weights: Vec::new(),
        };
        let nodes = radii.len();
        let mut left = vec![0.0; powers.factors.len()];
        for first in (0..nodes).step_by(LANES) {
            let end = (first + LANES).min(nodes);
            let mut strip = Vec::new();
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
                    decay.carry(row, &mut left);
                    if distance > reach {
                        reach = distance;
                        strip.resize(reach, [0.0; LANES]);
                    }
                    let kernel = powers.kernel;
                    let served = kernel.whole() - left.iter().sum::<f64>();
                    strip[distance - 1][j - first] =
                        kernel.bend(inner / outer, apart.sqrt()) - served;
                }
            }
            near.weights.extend(strip);
            near.starts.push(near.weights.len());
        }
        near
    }

    /// The weights of a strip: those at distance 1, then 2, …, each for its four rows.
    #[inline(always)]
    pub fn strip(&self, strip: usize) -> &[[f64; LANES]] {
        &self.weights[self.starts[strip]..self.starts[strip + 1]]
    }
}

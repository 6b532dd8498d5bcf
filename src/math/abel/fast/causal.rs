//! Sums over all kinks on one side of every row, in O(N).
//!
//! # Formula
//!
//! ```text
//! out_j = Σ_{k before j} J_k K(v_jk),   K(v) = Σ_m a_m v^(μ_m) away from v = 1
//! S_m ← (S_m + J_{j−1}) (t_{j−1}/t_j)^μ_m,   out_j = Σ_m a_m S_m + Σ of the nearest J by weights of their own
//! ```
//!
//! "Before" is nearer to the origin, or farther out: the order in which the radii are given. The weights of the nearest
//! rows are exact less what the powers give. A row adds nothing of its own kink: what is zero so far stays zero.
//!
//! The last digits differ between CPUs with and without fused multiply-add; on one machine they are always the same.

use super::powers::{LANES, MOST_GROUPS, Powers};
use crate::math::vector::{Fusing, vectorized, with_widest};

/// A row's nearest rows are at most this many.
pub(super) const REACH: usize = 8;

/// Rows that are taken at a time, all that belongs to them in the innermost cache.
const BLOCK: usize = 64;

/// The operator. Memory: K + 8 numbers a row for K powers.
#[derive(Debug, PartialEq)]
pub(super) struct Causal {
    /// a of every power.
    factors: Vec<[f64; LANES]>,
    /// (t_{j−1}/t_j)^μ of every row and power.
    decays: Vec<[f64; LANES]>,
    /// Weights of the nearest rows before each, the farthest first.
    near: Vec<[f64; REACH]>,
}

/// How far apart two radii are: ln of the ratio of their squares; infinite if one is 0.
pub(super) fn apart(one: f64, other: f64) -> f64 {
    let (inner, outer) = (one.min(other), one.max(other));
    2.0 * ((outer - inner) / inner).ln_1p()
}

impl Causal {
    /// For rows at `radii`, in rising or in falling order, with weights of their own where the `powers` do not reach.
    pub fn new(radii: &[f64], powers: &Powers) -> Self {
        let decay = |step: f64, exponent: f64| match exponent {
            0.0 => 1.0,
            _ => (-exponent * step).exp(),
        };
        let decays_of = |j: usize| {
            let step = match j {
                0 => 0.0,
                _ => apart(radii[j - 1], radii[j]),
            };
            let exponents = powers.exponents.iter();
            exponents.map(move |&exponent| decay(step, exponent))
        };
        let decays: Vec<f64> = (0..radii.len()).flat_map(decays_of).collect();
        let count = powers.factors.len();
        let near_of = |j: usize| {
            let mut weights = [0.0; REACH];
            let mut left = powers.factors.clone();
            for distance in 1..=REACH.min(j) {
                let (one, other) = (radii[j - distance], radii[j]);
                if one.min(other) == 0.0 || apart(one, other) >= powers.nearest {
                    break;
                }
                let row = &decays[(j + 1 - distance) * count..][..count];
                left.iter_mut()
                    .zip(row)
                    .for_each(|(left, decay)| *left *= decay);
                let (inner, outer) = (one.min(other), one.max(other));
                let sine = ((outer - inner) * (outer + inner)).sqrt() / outer;
                let exact = (powers.kernel.kink)(inner / outer, sine);
                weights[REACH - distance] = exact - left.iter().sum::<f64>();
            }
            weights
        };
        Self {
            factors: powers.factors.as_chunks().0.to_vec(),
            near: (0..radii.len()).map(near_of).collect(),
            decays: decays.as_chunks().0.to_vec(),
        }
    }

    /// Asks for the `jumps` of some rows and hands over their `sums`, block by block, each with the first row, until
    /// `count` rows are done. Before the first jump all sums are zero.
    #[inline(always)]
    pub fn apply(
        &self,
        count: usize,
        jumps: impl Fn(usize, &mut [f64]),
        mut sums: impl FnMut(usize, &mut [f64]),
    ) {
        let mut state = [[0.0; LANES]; MOST_GROUPS];
        let mut window = [0.0; REACH + BLOCK];
        let mut lanes = [[0.0; LANES]; BLOCK];
        let mut is_idle = true;
        for first in (0..count).step_by(BLOCK) {
            let rows = BLOCK.min(self.near.len() - first);
            window.copy_within(BLOCK.., 0);
            vectorized(
                #[inline(always)]
                || jumps(first, &mut window[REACH..][..rows]),
            );
            is_idle &= window[REACH..][..rows].iter().all(|&jump| jump == 0.0);
            if is_idle {
                sums(first, &mut [0.0; BLOCK][..rows]);
                continue;
            }
            self.block(first, &window, &mut state, &mut lanes[..rows]);
            vectorized(
                #[inline(always)]
                || {
                    let mut block = [0.0; BLOCK];
                    for (sum, [a, b, c, d]) in block.iter_mut().zip(&lanes) {
                        *sum = (a + b) + (c + d);
                    }
                    sums(first, &mut block[..rows]);
                },
            );
        }
    }

    /// The number of groups is fixed at compile time, so that the state stays in registers.
    fn block(
        &self,
        first: usize,
        window: &[f64; REACH + BLOCK],
        state: &mut [[f64; LANES]; MOST_GROUPS],
        lanes: &mut [[f64; LANES]],
    ) {
        macro_rules! by_groups {
            ($($groups:literal),*) => {
                match self.factors.len() {
                    $($groups => with_widest(
                        #[inline(always)]
                        |fusing| self.groups::<$groups>(fusing, first, window, state, lanes),
                    ),)*
                    // A fit has from 2 to MOST_GROUPS groups.
                    _ => unreachable!("no such number of groups"),
                }
            };
        }
        by_groups!(2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14);
    }

    #[inline(always)]
    fn groups<const GROUPS: usize>(
        &self,
        fusing: Fusing,
        first: usize,
        window: &[f64; REACH + BLOCK],
        state: &mut [[f64; LANES]; MOST_GROUPS],
        lanes: &mut [[f64; LANES]],
    ) {
        let factors: &[_; GROUPS] = &self.factors.as_chunks().0[0];
        let mut powers: [_; GROUPS] = std::array::from_fn(|group| state[group]);
        let (decays, _) = self.decays[first * GROUPS..].as_chunks::<GROUPS>();
        let rows = decays
            .iter()
            .zip(&self.near[first..])
            .zip(window.windows(REACH + 1));
        for (lanes, ((decays, near), window)) in lanes.iter_mut().zip(rows) {
            let (near, before) = (near.as_chunks().0, window.as_chunks().0);
            let mut row = product(&near[0], &before[0]);
            row = fusing.multiply_add(&near[1], &before[1], &row);
            let own = window[REACH];
            for group in 0..GROUPS {
                let decayed = product(&decays[group], &powers[group]);
                row = fusing.multiply_add(&factors[group], &decayed, &row);
                powers[group] = decayed.map(|decayed| decayed + own);
            }
            *lanes = row;
        }
        state[..GROUPS].copy_from_slice(&powers);
    }
}

#[inline(always)]
fn product(a: &[f64; LANES], b: &[f64; LANES]) -> [f64; LANES] {
    std::array::from_fn(|i| a[i] * b[i])
}

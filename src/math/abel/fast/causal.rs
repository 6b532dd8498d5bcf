//! Sums all kinks on one side of every row, in O(N).
//!
//! # Formula
//!
//! ```text
//! out_j = Σ_{k before j} J_k K(v_jk),   K(v) = Σ_m a_m v^(μ_m) away from v = 1
//! S_m ← (S_m + J_{j−1}) (t_{j−1}/t_j)^μ_m,   out_j = Σ_m a_m S_m + Σ weight × J over the nearest rows
//! ```
//!
//! "Before" means nearer to the origin or farther out, depending on the order of the radii. The weights of the nearest
//! rows are the exact kernel minus what the powers give. A row never adds its own kink: leading zeros stay zero.
//!
//! The last digits differ between CPUs with and without fused multiply-add, but never between runs on one machine.

use super::powers::{LANES, MOST_GROUPS, PowerSum};
use crate::math::vector::{Fusing, with_widest};

/// Maximum number of nearest rows.
pub(super) const REACH: usize = 8;

/// Rows processed together, so that their data fit in the innermost cache.
pub(super) const BLOCK: usize = 64;

/// The operator. Memory: K + 8 numbers per row for K powers.
#[derive(Debug, PartialEq)]
pub(super) struct Causal {
    /// Factors a of the powers.
    factors: Vec<[f64; LANES]>,
    /// Decays (t_{j−1}/t_j)^μ per row and power.
    decays: Vec<[f64; LANES]>,
    /// Weights of the nearest rows before each row, the farthest first.
    near: Vec<[f64; REACH]>,
}

/// Returns the distance between two radii: ln of the ratio of their squares; infinite if one is 0.
pub(super) fn log_distance(one: f64, other: f64) -> f64 {
    let (inner, outer) = (one.min(other), one.max(other));
    2.0 * ((outer - inner) / inner).ln_1p()
}

impl Causal {
    /// Plans the sums for rows at `radii`, rising or falling, with separate weights where the `powers` do not reach.
    pub fn new(radii: &[f64], powers: &PowerSum) -> Self {
        let decay = |step: f64, exponent: f64| match exponent {
            0.0 => 1.0,
            _ => (-exponent * step).exp(),
        };
        let decays_of = |j: usize| {
            let step = j
                .checked_sub(1)
                .map_or(0.0, |i| log_distance(radii[i], radii[j]));
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
                if one.min(other) == 0.0 || log_distance(one, other) >= powers.nearest {
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

    /// Starts a pass over the rows.
    pub fn pass(&self) -> Pass<'_> {
        Pass {
            operator: self,
            first: 0,
            powers: [[0.0; LANES]; MOST_GROUPS],
            window: [0.0; REACH + BLOCK],
            is_idle: true,
        }
    }
}

/// A pass over the rows of an operator, block by block.
pub(super) struct Pass<'a> {
    operator: &'a Causal,
    /// Next row.
    first: usize,
    /// S of every power.
    powers: [[f64; LANES]; MOST_GROUPS],
    /// Jumps of the last rows and of the present block.
    window: [f64; REACH + BLOCK],
    /// True until the first jump.
    is_idle: bool,
}

impl Pass<'_> {
    /// Replaces the jumps in the next `rows` with their sums. `rows` is a whole [`BLOCK`] or the remainder.
    pub fn sum(&mut self, rows: &mut [f64]) {
        self.is_idle &= rows.iter().all(|&jump| jump == 0.0);
        self.window.copy_within(BLOCK.., 0);
        self.window[REACH..][..rows.len()].copy_from_slice(rows);
        // Before the first jump all sums are zero.
        if !self.is_idle {
            self.sum_by_groups(rows);
        }
        self.first += rows.len();
    }

    /// Fixes the number of groups at compile time, so that the powers stay in registers.
    fn sum_by_groups(&mut self, rows: &mut [f64]) {
        macro_rules! by_groups {
            ($($groups:literal),*) => {
                match self.operator.factors.len() {
                    $($groups => with_widest(
                        #[inline(always)]
                        |fusing| self.sum_groups::<$groups>(fusing, rows),
                    ),)*
                    // A fit has from 2 to MOST_GROUPS groups.
                    _ => unreachable!("no such number of groups"),
                }
            };
        }
        by_groups!(2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14);
    }

    #[inline(always)]
    fn sum_groups<const GROUPS: usize>(&mut self, fusing: Fusing, rows: &mut [f64]) {
        let (operator, first) = (self.operator, self.first);
        let factors: &[_; GROUPS] = &operator.factors.as_chunks().0[0];
        let mut powers: [_; GROUPS] = std::array::from_fn(|group| self.powers[group]);
        let (decays, _) = operator.decays[first * GROUPS..].as_chunks::<GROUPS>();
        let inputs = decays.iter().zip(&operator.near[first..]);
        let inputs = inputs.zip(self.window.windows(REACH + 1));
        for (sum, ((decays, near), window)) in rows.iter_mut().zip(inputs) {
            let (near, before) = (near.as_chunks().0, window.as_chunks().0);
            let mut row = product(&near[0], &before[0]);
            row = fusing.multiply_add(&near[1], &before[1], &row);
            let own = window[REACH];
            for group in 0..GROUPS {
                let decayed = product(&decays[group], &powers[group]);
                row = fusing.multiply_add(&factors[group], &decayed, &row);
                powers[group] = decayed;
                for power in &mut powers[group] {
                    *power += own;
                }
            }
            let [a, b, c, d] = row;
            *sum = (a + b) + (c + d);
        }
        self.powers[..GROUPS].copy_from_slice(&powers);
    }
}

#[inline(always)]
fn product(a: &[f64; LANES], b: &[f64; LANES]) -> [f64; LANES] {
    let mut product = *a;
    for lane in 0..LANES {
        product[lane] *= b[lane];
    }
    product
}

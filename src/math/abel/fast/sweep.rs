//! The sweep: one recurrence a power, block by block, outwards or inwards.
//!
//! A pass takes [`BLOCK`] rows at a time, all of it in the innermost cache: what the rows begin with and the jumps
//! of the slope, then the [recurrences](super::recurrence) and the near field, then the part of κ.
//!
//! The last digits differ between CPUs with and without fused multiply-add; on one machine they are
//! always the same.

use std::f64::consts::FRAC_1_PI;

use fearless_simd::{Level, dispatch};

use super::near::{Near, REACH, Side};
use super::powers::{LANES, MOST_GROUPS, Powers};
use super::propagator::{BLOCK, Propagator};
use super::recurrence::{Factors, State, powers_block};

/// Sums over the kinks inside of every row:
/// T_j Σ_{k<j} J_k (κ − Σ a v^μ), J_k = slope_k − slope_{k−1}.
#[derive(Debug, PartialEq)]
pub(super) struct Outward {
    whole: f64,
    factors: Factors,
    scale: Vec<f64>,
    near: Near,
}

/// Sums over the kinks outside of every row: Σ_{k>j} J_k x_k (κ − Σ a v^μ)/π, up to the last node, where
/// the slope falls to zero.
#[derive(Debug, PartialEq)]
pub(super) struct Inward {
    whole: f64,
    factors: Factors,
    near: Near,
}

/// What a sweep works on, piece by piece.
pub(super) trait Data {
    /// Writes the slopes of the cells from the given one on.
    fn slopes(&self, first: usize, slopes: &mut [f64]);

    /// Makes the rows from the given one on what they are before the sums are added.
    fn begin(&self, first: usize, rows: &mut [f64]);
}

impl Outward {
    /// For nodes at `radii`, the first of them 0, and row factors T_j in `scale`.
    pub fn new(
        radii: &[f64],
        scale: Vec<f64>,
        powers: &Powers,
        propagator: &Propagator,
        nearest: f64,
    ) -> Self {
        Self {
            whole: powers.kernel.whole(),
            factors: Factors::of(powers),
            scale,
            near: Near::new(radii, Side::Inside, powers, propagator, nearest),
        }
    }

    /// Begins the rows of `output` and adds the sums.
    pub fn apply(&self, propagator: &Propagator, data: &impl Data, output: &mut [f64]) {
        let level = Level::new();
        let nodes = self.scale.len();
        let mut state: State = [[0.0; LANES]; MOST_GROUPS];
        let mut jumps = [0.0; REACH + BLOCK];
        // One slope more: that of the cell before the block.
        let mut slope = [0.0; BLOCK + 1];
        let mut sums = [0.0; BLOCK];
        let mut quiet = true;
        for (block, output) in output[..nodes].chunks_mut(BLOCK).enumerate() {
            let (first, rows) = (block * BLOCK, output.len());
            slope[0] = slope[BLOCK];
            // The last node has no cell behind it.
            let cells = rows.min(nodes - 1 - first);
            slope[cells + 1..].fill(0.0);
            jumps.copy_within(BLOCK.., 0);
            dispatch!(level, _simd => {
                data.begin(first, output);
                data.slopes(first, &mut slope[1..=cells]);
                for (jump, pair) in jumps[REACH..].iter_mut().zip(slope.windows(2)) {
                    *jump = pair[1] - pair[0];
                }
            });
            let mut first_source = None;
            if quiet {
                first_source = jumps[REACH..].iter().position(|&jump| jump != 0.0);
                if first_source.is_none() {
                    continue;
                }
                quiet = false;
            }
            let padded = rows.next_multiple_of(LANES);
            powers_block::<false>(
                level,
                &mut state,
                block,
                (propagator, &self.factors, &self.near),
                &jumps,
                &mut sums[..padded],
            );
            // The first source is nothing to its own row, not even by rounding: what is zero up to it stays so.
            if let Some(row) = first_source {
                sums[row] = 0.0;
            }
            dispatch!(level, _simd => self.finish(first, &slope, &sums, output));
        }
    }

    /// Adds the sums of one block with the part of κ.
    #[inline(always)]
    fn finish(&self, first: usize, slope: &[f64], sums: &[f64], output: &mut [f64]) {
        let scale = &self.scale[first..first + output.len()];
        let rows = slope.iter().zip(sums).zip(scale);
        for (out, ((slope, sum), scale)) in output.iter_mut().zip(rows) {
            *out += scale * (self.whole * slope + sum);
        }
    }
}

impl Inward {
    /// For nodes at `radii`, the first of them 0.
    pub fn new(radii: &[f64], powers: &Powers, propagator: &Propagator, nearest: f64) -> Self {
        Self {
            whole: powers.kernel.whole(),
            factors: Factors::of(powers),
            near: Near::new(radii, Side::Outside, powers, propagator, nearest),
        }
    }

    /// Begins the rows of `output` and adds the sums.
    pub fn apply(
        &self,
        radii: &[f64],
        propagator: &Propagator,
        data: &impl Data,
        output: &mut [f64],
    ) {
        let level = Level::new();
        let nodes = radii.len();
        let mut state: State = [[0.0; LANES]; MOST_GROUPS];
        let mut moments = [0.0; BLOCK + REACH];
        // slope[i + 1] is that of the cell behind row i, slope[0] that of the cell before the block.
        let mut slope = [0.0; BLOCK + 1];
        let mut sums = [0.0; BLOCK];
        let mut total = 0.0;
        let mut quiet = true;
        for (block, output) in output[..nodes].chunks_mut(BLOCK).enumerate().rev() {
            let (first, rows) = (block * BLOCK, output.len());
            // The last node has no cell behind it, the first none before it.
            let cells = rows.min(nodes - 1 - first);
            let before = usize::from(first > 0);
            slope.fill(0.0);
            moments.copy_within(..REACH, BLOCK);
            moments[rows..BLOCK].fill(0.0);
            let radii = &radii[first..first + rows];
            dispatch!(level, _simd => {
                data.begin(first, output);
                data.slopes(first - before, &mut slope[1 - before..=cells]);
                let jumps = slope.windows(2).map(|pair| pair[1] - pair[0]);
                for ((moment, jump), radius) in moments.iter_mut().zip(jumps).zip(radii) {
                    *moment = jump * radius;
                }
            });
            let mut first_source = None;
            if quiet {
                first_source = moments[..BLOCK].iter().rposition(|&moment| moment != 0.0);
                if first_source.is_none() {
                    continue;
                }
                quiet = false;
            }
            let padded = rows.next_multiple_of(LANES);
            powers_block::<true>(
                level,
                &mut state,
                block,
                (propagator, &self.factors, &self.near),
                &moments,
                &mut sums[..padded],
            );
            // The first source is nothing to its own row, not even by rounding: what is zero up to it stays so.
            if let Some(row) = first_source {
                sums[row] = 0.0;
            }
            dispatch!(level, _simd => self.finish(&mut total, &moments, &sums, output));
        }
    }

    /// Adds the sums of one block with the part of κ; `total` is the sum of the moments outside of it.
    #[inline(always)]
    fn finish(
        &self,
        total: &mut f64,
        moments: &[f64; BLOCK + REACH],
        sums: &[f64; BLOCK],
        output: &mut [f64],
    ) {
        // The only part in sequence: four rows at a time.
        let mut beyond = [0.0; BLOCK];
        let (fours, _) = moments[..BLOCK].as_chunks::<4>();
        let rows = beyond.as_chunks_mut::<4>().0.iter_mut().zip(fours);
        for (beyond, &[a, b, c, d]) in rows.rev() {
            let two = c + d;
            *beyond = [*total + (b + two), *total + two, *total + d, *total];
            *total += (a + b) + two;
        }
        for (out, (beyond, sum)) in output.iter_mut().zip(beyond.iter().zip(sums)) {
            *out += FRAC_1_PI * (self.whole * beyond + sum);
        }
    }
}

//! The sweep: one recurrence a power, block by block, outwards or inwards.
//!
//! # Formula
//!
//! ```text
//! S_m ← (t_{j−1}/t_j)^μ_m S_m,   sum_j = Σ_m S_m,   S_m ← S_m + a_m source_j
//! ```
//!
//! Row j is read before its own source is added, so that causality is strict.
//!
//! The instructions are those of the processor that runs it. Where it fuses multiplication and
//! addition, the last digits differ from one where it does not; on one machine they are always the same.

use fearless_simd::{Level, dispatch, f64x4, prelude::*};

use super::decay::Decay;
use super::near::{BLOCK, Near, REACH, Side};
use super::powers::{LANES, MOST_GROUPS, Powers};

/// S of every power.
type State = [[f64; LANES]; MOST_GROUPS];

/// Sums over the bends inside of every row:
/// T_j Σ_{k<j} J_k (κ − Σ a v^μ), J_k = slope_k − slope_{k−1}.
#[derive(Debug, PartialEq)]
pub(super) struct Outward {
    whole: f64,
    factors: Vec<[f64; LANES]>,
    scale: Vec<f64>,
    near: Near,
}

/// Sums over the bends outside of every row: Σ_{k>j} J_k x_k (κ − Σ a v^μ)/π, up to the last node, where
/// the slope falls to zero.
#[derive(Debug, PartialEq)]
pub(super) struct Inward {
    whole: f64,
    factors: Vec<[f64; LANES]>,
    near: Near,
}

fn grouped(factors: &[f64], scale: f64) -> Vec<[f64; LANES]> {
    let (groups, _) = factors.as_chunks::<LANES>();
    groups
        .iter()
        .map(|group| group.map(|a| a * scale))
        .collect()
}

impl Outward {
    /// For nodes at `radii`, the first of them 0, and row factors T_j in `scale`. 
    pub fn new(
        radii: &[f64],
        scale: Vec<f64>,
        powers: &Powers,
        decay: &Decay,
        nearest: f64,
    ) -> Self {
        let near = Near::new(radii, Side::Inside, powers, decay, nearest);
        Self {
            whole: powers.kernel.whole(),
            factors: grouped(&powers.factors, 1.0),
            near: near.scaled(&scale),
            scale,
        }
    }

    /// Adds the sums to `output`. `slopes` writes the slopes of the cells from the given one on.
    pub fn add(&self, decay: &Decay, slopes: impl Fn(usize, &mut [f64]), output: &mut [f64]) {
        let level = Level::new();
        let nodes = self.scale.len();
        let mut state: State = [[0.0; LANES]; MOST_GROUPS];
        let mut jumps = [0.0; REACH + BLOCK];
        // One slope more: that of the cell before the block.
        let mut slope = [0.0; BLOCK + 1];
        let mut quiet = true;
        for (block, output) in output[..nodes].chunks_mut(BLOCK).enumerate() {
            let (first, rows) = (block * BLOCK, output.len());
            slope[0] = slope[BLOCK];
            slope[1..].fill(0.0);
            // The last node has no cell behind it.
            let cells = rows.min(nodes - 1 - first);
            slopes(first, &mut slope[1..=cells]);
            jumps.copy_within(BLOCK.., 0);
            for (jump, pair) in jumps[REACH..].iter_mut().zip(slope.windows(2)) {
                *jump = pair[1] - pair[0];
            }
            quiet = quiet && jumps[REACH..].iter().all(|&jump| jump == 0.0);
            if quiet {
                continue;
            }
            let mut sums = [0.0; BLOCK];
            powers_block::<false>(
                level,
                &mut state,
                decay.rows(first, first + rows),
                &self.factors,
                &jumps[REACH..REACH + rows],
                &mut sums[..rows],
            );
            dispatch!(level, simd => finish_outward(
                simd,
                self, block, &slope, &jumps, &sums, output,
            ));
        }
    }
}

/// The near field and the part of κ of one block.
#[inline(always)]
fn finish_outward<S: Simd>(
    simd: S,
    sweep: &Outward,
    block: usize,
    slope: &[f64; BLOCK + 1],
    jumps: &[f64; REACH + BLOCK],
    sums: &[f64; BLOCK],
    output: &mut [f64],
) {
    let first = block * BLOCK;
    let near = near_field(simd, &sweep.near, block, |distance| {
        &jumps[REACH - distance..][..BLOCK]
    });
    let scale = &sweep.scale[first..first + output.len()];
    for (i, (out, scale)) in output.iter_mut().zip(scale).enumerate() {
        *out += scale * (sweep.whole * slope[i] - sums[i]) + near[i];
    }
}

impl Inward {
    /// For nodes at `radii`, the first of them 0.
    pub fn new(
        radii: &[f64],
        powers: &Powers,
        decay: &Decay,
        nearest: f64,
    ) -> Self {
        let inverse = std::f64::consts::FRAC_1_PI;
        let near = Near::new(radii, Side::Outside, powers, decay, nearest);
        Self {
            whole: powers.kernel.whole() * inverse,
            factors: grouped(&powers.factors, inverse),
            near: near.scaled(&vec![inverse; radii.len()]),
        }
    }

    /// Adds the sums to `output`. `slopes` writes the slopes of the cells from the given one on.
    pub fn add(
        &self,
        radii: &[f64],
        decay: &Decay,
        slopes: impl Fn(usize, &mut [f64]),
        output: &mut [f64],
    ) {
        let level = Level::new();
        let nodes = radii.len();
        let mut state: State = [[0.0; LANES]; MOST_GROUPS];
        let mut moments = [0.0; BLOCK + REACH];
        // slope[i + 1] is that of the cell behind row i, slope[0] that of the cell before the block.
        let mut slope = [0.0; BLOCK + 1];
        let mut total = 0.0;
        let mut quiet = true;
        for (block, output) in output[..nodes].chunks_mut(BLOCK).enumerate().rev() {
            let (first, rows) = (block * BLOCK, output.len());
            slope.fill(0.0);
            // The last node has no cell behind it.
            let cells = rows.min(nodes - 1 - first);
            if first > 0 {
                slopes(first - 1, &mut slope[..=cells]);
            } else {
                slopes(0, &mut slope[1..=cells]);
            }
            moments.copy_within(..REACH, BLOCK);
            moments[..BLOCK].fill(0.0);
            let radii = &radii[first..first + rows];
            for ((moment, pair), radius) in moments.iter_mut().zip(slope.windows(2)).zip(radii) {
                *moment = (pair[1] - pair[0]) * radius;
            }
            quiet = quiet && moments[..BLOCK].iter().all(|&moment| moment == 0.0);
            if quiet {
                continue;
            }
            let mut sums = [0.0; BLOCK];
            powers_block::<true>(
                level,
                &mut state,
                decay.rows(first + 1, first + rows + 1),
                &self.factors,
                &moments[..rows],
                &mut sums[..rows],
            );
            dispatch!(level, simd => finish_inward(
                simd,
                self, block, &mut total, &moments, &sums, output,
            ));
        }
    }
}

/// The near field and the part of κ of one block.
#[inline(always)]
fn finish_inward<S: Simd>(
    simd: S,
    sweep: &Inward,
    block: usize,
    total: &mut f64,
    moments: &[f64; BLOCK + REACH],
    sums: &[f64; BLOCK],
    output: &mut [f64],
) {
    let near = near_field(simd, &sweep.near, block, |distance| {
        &moments[distance..][..BLOCK]
    });
    // Σ_{k>j} of the block, the only part in sequence.
    let mut beyond = [0.0; BLOCK];
    for (beyond, moment) in beyond.iter_mut().zip(moments).rev() {
        *beyond = *total;
        *total += moment;
    }
    for (i, out) in output.iter_mut().enumerate() {
        *out += sweep.whole * beyond[i] - sums[i] + near[i];
    }
}

/// Weights times the sources at every distance, for the rows of one block side by side.
#[inline(always)]
fn near_field<'a, S: Simd>(
    simd: S,
    near: &Near,
    block: usize,
    sources: impl Fn(usize) -> &'a [f64],
) -> [f64; BLOCK] {
    let mut sums = [f64x4::splat(simd, 0.0); BLOCK / LANES];
    for (distance, weights) in (1..).zip(near.block(block)) {
        let (weights, _) = weights.as_chunks::<LANES>();
        let (sources, _) = sources(distance).as_chunks::<LANES>();
        for ((sum, weight), source) in sums.iter_mut().zip(weights).zip(sources) {
            let weight = f64x4::from_slice(simd, weight);
            *sum = weight.mul_add(f64x4::from_slice(simd, source), *sum);
        }
    }
    let mut rows = [0.0; BLOCK];
    for (lanes, sum) in rows.as_chunks_mut::<LANES>().0.iter_mut().zip(&sums) {
        sum.store_slice(lanes);
    }
    rows
}

/// The recurrences over one block of rows, from its end if `REVERSED`; the number of groups is fixed
/// at compile time, so that the state stays in registers.
fn powers_block<const REVERSED: bool>(
    level: Level,
    state: &mut State,
    decay: &[[f64; LANES]],
    factors: &[[f64; LANES]],
    sources: &[f64],
    sums: &mut [f64],
) {
    macro_rules! by_groups {
        ($($groups:literal),*) => {
            match factors.len() {
                $($groups => dispatch!(level, simd => {
                    groups_block::<_, $groups, REVERSED>(simd, state, decay, factors, sources, sums)
                }),)*
                // A fit has from 2 to MOST_GROUPS groups.
                _ => unreachable!("no such number of groups"),
            }
        };
    }
    by_groups!(2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14)
}

#[inline(always)]
fn groups_block<S: Simd, const GROUPS: usize, const REVERSED: bool>(
    simd: S,
    state: &mut State,
    decay: &[[f64; LANES]],
    factors: &[[f64; LANES]],
    sources: &[f64],
    sums: &mut [f64],
) {
    let load = |lanes: &[f64; LANES]| f64x4::from_slice(simd, lanes);
    let mut powers: [f64x4<S>; GROUPS] = std::array::from_fn(|group| load(&state[group]));
    let factors: [f64x4<S>; GROUPS] = std::array::from_fn(|group| load(&factors[group]));
    let rows = decay.as_chunks::<GROUPS>().0.iter();
    let rows = rows.zip(sources).zip(sums);
    let step = |((decay, source), row): ((&[[f64; LANES]; GROUPS], &f64), &mut f64)| {
        let source = f64x4::splat(simd, *source);
        let mut sum = [f64x4::splat(simd, 0.0); 2];
        for group in 0..GROUPS {
            let decayed = load(&decay[group]) * powers[group];
            sum[group % 2] += decayed;
            powers[group] = factors[group].mul_add(source, decayed);
        }
        *row = simd.reduce_sum_f64x4(sum[0] + sum[1]);
    };
    if REVERSED {
        rows.rev().for_each(step);
    } else {
        rows.for_each(step);
    }
    for (lanes, power) in state.iter_mut().zip(&powers) {
        power.store_slice(lanes);
    }
}

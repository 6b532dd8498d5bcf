//! The sweep: one recurrence a power, block by block, outwards or inwards.
//!
//! # Formula
//!
//! ```text
//! S_m ← (t_{j−1}/t_j)^μ_m S_m + source_j,   sum_j = Σ_m a_m S_m − source_j Σ_m a_m
//! ```
//!
//! Two operations a power. A row looks at its own source by rounding alone, and the first row with a source not even
//! by that: what is zero up to there stays zero, so that causality is strict.
//!
//! A pass takes [`BLOCK`] rows at a time, all of it in the innermost cache: what the rows begin with and the jumps
//! of the slope, then the recurrences with the near field in their shade, then the part of κ. Four rows share the
//! sum over the lanes.
//!
//! The instructions are those of the processor that runs it. Where it fuses multiplication and
//! addition, the last digits differ from one where it does not; on one machine they are always the same.

use std::f64::consts::FRAC_1_PI;
use std::ops::Range;

use fearless_simd::{Level, dispatch, f64x4, prelude::*};

use super::cubic::{BLOCK, place};
use super::decay::{self, Decay};
use super::near::{self, Near, REACH, Side, Weights};
use super::powers::{LANES, MOST_GROUPS, Powers};

/// a of every power.
#[derive(Debug, PartialEq)]
struct Factors {
    groups: Vec<[f64; LANES]>,
    /// Σ a.
    total: f64,
}

/// S of every power.
type State = [[f64; LANES]; MOST_GROUPS];

/// Sums over the bends inside of every row:
/// T_j Σ_{k<j} J_k (κ − Σ a v^μ), J_k = slope_k − slope_{k−1}.
#[derive(Debug, PartialEq)]
pub(super) struct Outward {
    whole: f64,
    factors: Factors,
    scale: Vec<f64>,
    near: Near,
}

/// Sums over the bends outside of every row: Σ_{k>j} J_k x_k (κ − Σ a v^μ)/π, up to the last node, where
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

impl Factors {
    fn of(powers: &Powers) -> Self {
        Self {
            groups: powers.factors.as_chunks::<LANES>().0.to_vec(),
            total: powers.factors.iter().sum(),
        }
    }
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
        Self {
            whole: powers.kernel.whole(),
            factors: Factors::of(powers),
            scale,
            near: Near::new(radii, Side::Inside, powers, decay, nearest),
        }
    }

    /// Begins the `rows` of `output` and adds the sums; those farther out become zero.
    pub fn apply(&self, decay: &Decay, data: &impl Data, output: &mut [f64], rows: Range<usize>) {
        let level = Level::new();
        let nodes = self.scale.len();
        let mut state: State = [[0.0; LANES]; MOST_GROUPS];
        let mut jumps = [0.0; REACH + BLOCK];
        // One slope more: that of the cell before the block.
        let mut slope = [0.0; BLOCK + 1];
        let mut sums = [0.0; BLOCK];
        let mut quiet = true;
        for (block, output) in output[..nodes].chunks_mut(BLOCK).enumerate() {
            if block * BLOCK >= rows.end {
                output.fill(0.0);
                continue;
            }
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
            let first_source = jumps[REACH..].iter().position(|&jump| jump != 0.0);
            if quiet && first_source.is_none() {
                continue;
            }
            let padded = rows.next_multiple_of(LANES);
            powers_block::<false>(
                level,
                &mut state,
                decay.piece(block),
                &self.factors,
                self.near.piece(block),
                &jumps,
                &mut sums[..padded],
            );
            if let Some(row) = first_source.filter(|_| quiet) {
                sums[row] = 0.0;
            }
            quiet = false;
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
    pub fn new(radii: &[f64], powers: &Powers, decay: &Decay, nearest: f64) -> Self {
        Self {
            whole: powers.kernel.whole(),
            factors: Factors::of(powers),
            near: Near::new(radii, Side::Outside, powers, decay, nearest),
        }
    }

    /// Begins the `rows` of `output` and adds the sums; those nearer to the origin become zero.
    pub fn apply(
        &self,
        radii: &[f64],
        decay: &Decay,
        data: &impl Data,
        output: &mut [f64],
        rows: Range<usize>,
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
            if (block + 1) * BLOCK <= rows.start {
                output.fill(0.0);
                continue;
            }
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
            let first_source = moments[..BLOCK].iter().rposition(|&moment| moment != 0.0);
            if quiet && first_source.is_none() {
                continue;
            }
            let padded = rows.next_multiple_of(LANES);
            powers_block::<true>(
                level,
                &mut state,
                decay.piece(block),
                &self.factors,
                self.near.piece(block),
                &moments,
                &mut sums[..padded],
            );
            if let Some(row) = first_source.filter(|_| quiet) {
                sums[row] = 0.0;
            }
            quiet = false;
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

/// Near field less recurrences over one block of rows, from its end if `REVERSED`; the number of groups is fixed
/// at compile time, so that the state stays in registers. The sources have those of [`REACH`] more rows on the side
/// where they come from.
fn powers_block<const REVERSED: bool>(
    level: Level,
    state: &mut State,
    decay: decay::Piece,
    factors: &Factors,
    near: near::Piece,
    sources: &[f64; REACH + BLOCK],
    sums: &mut [f64],
) {
    let (rows, near) = match (decay, near) {
        (decay::Piece::Rows(rows), near::Piece::Table(table)) => {
            // Inwards the decay is that towards the node before.
            let first = if REVERSED { factors.groups.len() } else { 0 };
            (&rows[first..], table)
        }
        (decay::Piece::Cubics(cubics), near::Piece::Table(near)) => {
            return dispatch!(level, simd => cubics_block::<_, _, REVERSED>(
                simd, state, cubics, factors, near, sources, sums
            ));
        }
        (decay::Piece::Cubics(cubics), near::Piece::Cubics(near)) => {
            return dispatch!(level, simd => cubics_block::<_, _, REVERSED>(
                simd, state, cubics, factors, near, sources, sums
            ));
        }
        (decay::Piece::Rows(_), near::Piece::Cubics(_)) => {
            unreachable!("a block with a table of decays has one of weights")
        }
    };
    macro_rules! by_groups {
        ($($groups:literal),*) => {
            match factors.groups.len() {
                $($groups => dispatch!(level, simd => groups_block::<_, $groups, REVERSED>(
                    simd, state, rows, factors, near, sources, sums
                )),)*
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
    factors: &Factors,
    near: near::Table,
    sources: &[f64; REACH + BLOCK],
    sums: &mut [f64],
) {
    let load = |lanes: &[f64; LANES]| f64x4::from_slice(simd, lanes);
    let mut powers: [f64x4<S>; GROUPS] = std::array::from_fn(|group| load(&state[group]));
    let total = factors.total;
    let factors: [f64x4<S>; GROUPS] = std::array::from_fn(|group| load(&factors.groups[group]));
    let (decay, _) = decay.as_chunks::<GROUPS>();
    let (decay, _) = decay.as_chunks::<LANES>();
    each_strip::<_, _, REVERSED>(
        simd,
        total,
        near,
        sources,
        sums,
        #[inline(always)]
        |strip, own| {
            let mut rows = [f64x4::splat(simd, 0.0); LANES];
            for i in 0..LANES {
                let i = if REVERSED { LANES - 1 - i } else { i };
                let source = f64x4::splat(simd, own[i]);
                for group in 0..GROUPS {
                    powers[group] = load(&decay[strip][i][group]).mul_add(powers[group], source);
                    rows[i] = factors[group].mul_add(powers[group], rows[i]);
                }
            }
            rows
        },
    );
    for (lanes, power) in state.iter_mut().zip(&powers) {
        power.store_slice(lanes);
    }
}

/// The same with decays from cubics, group by group through the same four rows: more arithmetic, and
/// hardly a number to be read.
#[inline(always)]
fn cubics_block<S: Simd, N: Weights, const REVERSED: bool>(
    simd: S,
    state: &mut State,
    cubics: &[[[f64; LANES]; 4]],
    factors: &Factors,
    near: N,
    sources: &[f64; REACH + BLOCK],
    sums: &mut [f64],
) {
    let load = |lanes: &[f64; LANES]| f64x4::from_slice(simd, lanes);
    each_strip::<_, _, REVERSED>(
        simd,
        factors.total,
        near,
        sources,
        sums,
        #[inline(always)]
        |strip, own| {
            let places: [f64x4<S>; LANES] = std::array::from_fn(|i| {
                f64x4::splat(simd, place(strip * LANES + i + usize::from(REVERSED)))
            });
            let mut rows = [f64x4::splat(simd, 0.0); LANES];
            for ((power, group), factor) in state.iter_mut().zip(cubics).zip(&factors.groups) {
                let (a, b, c, d) = (
                    load(&group[0]),
                    load(&group[1]),
                    load(&group[2]),
                    load(&group[3]),
                );
                let (mut lanes, factor) = (load(power), load(factor));
                let a = a + f64x4::splat(simd, 1.0);
                for i in 0..LANES {
                    let i = if REVERSED { LANES - 1 - i } else { i };
                    let u = places[i];
                    let decay = d.mul_add(u, c).mul_add(u, b).mul_add(u, a);
                    lanes = decay.mul_add(lanes, f64x4::splat(simd, own[i]));
                    rows[i] = factor.mul_add(lanes, rows[i]);
                }
                lanes.store_slice(power);
            }
            rows
        },
    );
}

/// Goes through a block four rows at a time: `recurrences` gives the powers of the four, lane by lane, from their number
/// in the block and their own sources, which are in them by the factor `total`; near field less those becomes their
/// sums.
#[inline(always)]
fn each_strip<S: Simd, N: Weights, const REVERSED: bool>(
    simd: S,
    total: f64,
    near: N,
    sources: &[f64; REACH + BLOCK],
    sums: &mut [f64],
    mut recurrences: impl FnMut(usize, &[f64]) -> [f64x4<S>; LANES],
) {
    let (sums, _) = sums.as_chunks_mut::<LANES>();
    for strip in 0..sums.len() {
        let strip = if REVERSED {
            sums.len() - 1 - strip
        } else {
            strip
        };
        // Four rows together, and their neighbours on the one side.
        let window = &sources[strip * LANES..][..REACH + LANES];
        let own = if REVERSED { window } else { &window[REACH..] };
        let rows = recurrences(strip, own);
        let weights = near.strip(simd, strip);
        let near = near_field::<_, REVERSED>(simd, weights, window);
        let own = f64x4::from_slice(simd, &own[..LANES]);
        let far = sum_lanes(simd, rows) - own * f64x4::splat(simd, total);
        (near - far).store_slice(&mut sums[strip]);
    }
}

/// Weights by distance times the sources, for four rows; `window` holds their own sources and those of their neighbours
/// on the one side.
#[inline(always)]
fn near_field<S: Simd, const REVERSED: bool>(
    simd: S,
    weights: impl Iterator<Item = f64x4<S>>,
    window: &[f64],
) -> f64x4<S> {
    let mut sum = f64x4::splat(simd, 0.0);
    let add = |(weights, sources): (f64x4<S>, &[f64])| {
        sum = weights.mul_add(f64x4::from_slice(simd, sources), sum);
    };
    if REVERSED {
        weights.zip(window[1..].windows(LANES)).for_each(add);
    } else {
        let inner = window[..REACH + LANES - 1].windows(LANES).rev();
        weights.zip(inner).for_each(add);
    }
    sum
}

/// The sum over the lanes of each of four.
#[inline(always)]
fn sum_lanes<S: Simd>(simd: S, [a, b, c, d]: [f64x4<S>; LANES]) -> f64x4<S> {
    // Lanes a, b, a, b and c, d, c, d.
    let first = simd.zip_low_f64x4(a, b) + simd.zip_high_f64x4(a, b);
    let second = simd.zip_low_f64x4(c, d) + simd.zip_high_f64x4(c, d);
    let ((ab, ba), (cd, dc)) = (simd.split_f64x4(first), simd.split_f64x4(second));
    simd.combine_f64x2(ab, cd) + simd.combine_f64x2(ba, dc)
}

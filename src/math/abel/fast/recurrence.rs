//! The recurrences of all powers over one block of rows, and the near field beside them.
//!
//! # Formula
//!
//! ```text
//! S_m ← (t_{j−1}/t_j)^μ_m S_m + source_j,   sum_j = Σ_m a_m S_m − source_j Σ_m a_m
//! ```
//!
//! Two operations per power. A row sees its own source only by rounding.
//!
//! Four rows share the sum over the lanes, and the near field is computed in the shade of the recurrences.

use fearless_simd::{Level, dispatch, f64x4, prelude::*};

use super::near::{Near, REACH};
use super::powers::{LANES, MOST_GROUPS, Powers};
use super::propagator::{BLOCK, Propagator};

/// a of every power.
#[derive(Debug, PartialEq)]
pub(super) struct Factors {
    groups: Vec<[f64; LANES]>,
    /// Σ a.
    total: f64,
}

/// S of every power.
pub(super) type State = [[f64; LANES]; MOST_GROUPS];

impl Factors {
    pub fn of(powers: &Powers) -> Self {
        Self {
            groups: powers.factors.as_chunks::<LANES>().0.to_vec(),
            total: powers.factors.iter().sum(),
        }
    }
}

/// Near field less recurrences over one `block` of rows, from its end if `REVERSED`; the number of groups is fixed
/// at compile time, so that the state stays in registers. The sources have those of [`REACH`] more rows on the side
/// where they come from.
pub(super) fn powers_block<const REVERSED: bool>(
    level: Level,
    state: &mut State,
    block: usize,
    (propagator, factors, near): (&Propagator, &Factors, &Near),
    sources: &[f64; REACH + BLOCK],
    sums: &mut [f64],
) {
    // Inwards the propagator is that towards the node before.
    let first = if REVERSED { factors.groups.len() } else { 0 };
    let (rows, strips) = (&propagator.block(block)[first..], block * BLOCK / LANES);
    macro_rules! by_groups {
        ($($groups:literal),*) => {
            match factors.groups.len() {
                $($groups => dispatch!(level, simd => groups_block::<_, $groups, REVERSED>(
                    simd, state, rows, factors, (near, strips), sources, sums
                )),)*
                // A fit has from 2 to MOST_GROUPS groups.
                _ => unreachable!("no such number of groups"),
            }
        };
    }
    by_groups!(2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14)
}

/// Goes through a block four rows at a time: near field less what the powers give becomes their sums. The weights of
/// its first strip are those of the strip `first_strip`.
#[inline(always)]
fn groups_block<S: Simd, const GROUPS: usize, const REVERSED: bool>(
    simd: S,
    state: &mut State,
    propagator: &[[f64; LANES]],
    factors: &Factors,
    (near, first_strip): (&Near, usize),
    sources: &[f64; REACH + BLOCK],
    sums: &mut [f64],
) {
    let load = |lanes: &[f64; LANES]| f64x4::from_slice(simd, lanes);
    let mut powers: [f64x4<S>; GROUPS] = std::array::from_fn(|group| load(&state[group]));
    let total = f64x4::splat(simd, factors.total);
    let factors: [f64x4<S>; GROUPS] = std::array::from_fn(|group| load(&factors.groups[group]));
    let (propagator, _) = propagator.as_chunks::<GROUPS>();
    let (propagator, _) = propagator.as_chunks::<LANES>();
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
        let mut rows = [f64x4::splat(simd, 0.0); LANES];
        for i in 0..LANES {
            let i = if REVERSED { LANES - 1 - i } else { i };
            let source = f64x4::splat(simd, own[i]);
            for group in 0..GROUPS {
                powers[group] = load(&propagator[strip][i][group]).mul_add(powers[group], source);
                rows[i] = factors[group].mul_add(powers[group], rows[i]);
            }
        }
        let weights = near.strip(simd, first_strip + strip);
        let near = near_field::<_, REVERSED>(simd, weights, window);
        let own = f64x4::from_slice(simd, &own[..LANES]);
        let far = sum_lanes(simd, rows) - own * total;
        (near - far).store_slice(&mut sums[strip]);
    }
    for (lanes, power) in state.iter_mut().zip(&powers) {
        power.store_slice(lanes);
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

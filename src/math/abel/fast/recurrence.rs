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

use super::cubic::{BLOCK, place};
use super::near::{self, REACH, Weights};
use super::powers::{LANES, MOST_GROUPS, Powers};
use super::propagator;

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

/// Near field less recurrences over one block of rows, from its end if `REVERSED`; the number of groups is fixed
/// at compile time, so that the state stays in registers. The sources have those of [`REACH`] more rows on the side
/// where they come from.
pub(super) fn powers_block<const REVERSED: bool>(
    level: Level,
    state: &mut State,
    propagator: propagator::Piece,
    factors: &Factors,
    near: near::Piece,
    sources: &[f64; REACH + BLOCK],
    sums: &mut [f64],
) {
    let (rows, near) = match (propagator, near) {
        (propagator::Piece::Rows(rows), near::Piece::Table(table)) => {
            // Inwards the propagator is that towards the node before.
            let first = if REVERSED { factors.groups.len() } else { 0 };
            (&rows[first..], table)
        }
        (propagator::Piece::Cubics(cubics), near::Piece::Table(near)) => {
            return dispatch!(level, simd => cubics_block::<_, _, REVERSED>(
                simd, state, cubics, factors, near, sources, sums
            ));
        }
        (propagator::Piece::Cubics(cubics), near::Piece::Cubics(near)) => {
            return dispatch!(level, simd => cubics_block::<_, _, REVERSED>(
                simd, state, cubics, factors, near, sources, sums
            ));
        }
        (propagator::Piece::Rows(_), near::Piece::Cubics(_)) => {
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
    propagator: &[[f64; LANES]],
    factors: &Factors,
    near: near::Table,
    sources: &[f64; REACH + BLOCK],
    sums: &mut [f64],
) {
    let load = |lanes: &[f64; LANES]| f64x4::from_slice(simd, lanes);
    let mut powers: [f64x4<S>; GROUPS] = std::array::from_fn(|group| load(&state[group]));
    let total = factors.total;
    let factors: [f64x4<S>; GROUPS] = std::array::from_fn(|group| load(&factors.groups[group]));
    let (propagator, _) = propagator.as_chunks::<GROUPS>();
    let (propagator, _) = propagator.as_chunks::<LANES>();
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
                    powers[group] =
                        load(&propagator[strip][i][group]).mul_add(powers[group], source);
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
                    let propagator = d.mul_add(u, c).mul_add(u, b).mul_add(u, a);
                    lanes = propagator.mul_add(lanes, f64x4::splat(simd, own[i]));
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

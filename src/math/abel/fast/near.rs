//! Corrects the sum of powers for near neighbours.

use fearless_simd::{f64x4, prelude::*};

use super::cubic::{BLOCK, SHARE, place, through, value};
use super::powers::{LANES, Powers};
use super::propagator::{self, Propagator};

/// A node's near neighbours are at most this many.
pub(super) const REACH: usize = 8;

/// Weights of the kinks at the nearest nodes, exact less what the powers give, block by block. Memory: at most 8 N numbers.
#[derive(Debug, PartialEq)]
pub(super) struct Near {
    blocks: Vec<Place>,
    /// Where the weights of each strip begin, and where those of its block end.
    starts: Vec<usize>,
    weights: Vec<[f64; LANES]>,
    cubics: Vec<[f64; 4]>,
}

/// Where a block is found.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Place {
    /// Its first strip in the starts.
    Table(usize),
    /// Its cubics: the first, and how many.
    Cubics(usize, usize),
}

/// The weights of a block.
#[derive(Debug, Clone, Copy)]
pub(super) enum Piece<'a> {
    Table(Table<'a>),
    Cubics(Cubics<'a>),
}

/// Weights of the rows of a block.
pub(super) trait Weights: Copy {
    /// Those of a strip of four rows at distance 1, then 2, …
    fn strip<S: Simd>(self, simd: S, strip: usize) -> impl Iterator<Item = f64x4<S>>;
}

/// By strips of four rows and there by distance, so that the rows of a strip lie side by side.
#[derive(Debug, Clone, Copy)]
pub(super) struct Table<'a> {
    starts: &'a [usize],
    weights: &'a [[f64; LANES]],
}

impl Weights for Table<'_> {
    #[inline(always)]
    fn strip<S: Simd>(self, simd: S, strip: usize) -> impl Iterator<Item = f64x4<S>> {
        let weights = &self.weights[self.starts[strip]..self.starts[strip + 1]];
        weights.iter().map(
            #[inline(always)]
            move |weights| f64x4::from_slice(simd, weights),
        )
    }
}

/// For every distance the coefficients in powers of the [`place`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Cubics<'a>(&'a [[f64; 4]]);

impl Weights for Cubics<'_> {
    #[inline(always)]
    fn strip<S: Simd>(self, simd: S, strip: usize) -> impl Iterator<Item = f64x4<S>> {
        let places: [f64; LANES] = std::array::from_fn(|i| place(strip * LANES + i));
        let u = f64x4::from_slice(simd, &places);
        self.0.iter().map(
            #[inline(always)]
            move |cubic| {
                let [a, b, c, d] = cubic.map(|number| f64x4::splat(simd, number));
                d.mul_add(u, c).mul_add(u, b).mul_add(u, a)
            },
        )
    }
}

/// Which side of a row its kinks lie on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// Nearer to the origin.
    Inside,
    /// Farther out.
    Outside,
}

/// A weight, and the size of what it puts right.
#[derive(Debug, Clone, Copy)]
struct Weight {
    value: f64,
    exact: f64,
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
            blocks: Vec::new(),
            starts: Vec::new(),
            weights: Vec::new(),
            cubics: Vec::new(),
        };
        let mut left = vec![0.0; powers.factors.len()];
        for (block, first) in (0..radii.len()).step_by(BLOCK).enumerate() {
            let rows = first..(first + BLOCK).min(radii.len());
            let rows: Vec<Vec<Weight>> = rows
                .map(|j| row(radii, side, powers, propagator, nearest, j, &mut left))
                .collect();
            let smooth = matches!(propagator.piece(block), propagator::Piece::Cubics(_));
            let cubics = smooth.then(|| cubics(&rows, SHARE * powers.tolerance));
            near.push(&rows, cubics.flatten());
        }
        near
    }

    /// Keeps the weights of a block.
    fn push(&mut self, rows: &[Vec<Weight>], cubics: Option<Vec<[f64; 4]>>) {
        if let Some(cubics) = cubics {
            let place = Place::Cubics(self.cubics.len(), cubics.len());
            self.blocks.push(place);
            self.cubics.extend(cubics);
            return;
        }
        self.blocks.push(Place::Table(self.starts.len()));
        for strip in rows.chunks(LANES) {
            self.starts.push(self.weights.len());
            let reach = strip.iter().map(Vec::len).max().unwrap_or_default();
            self.weights.extend((0..reach).map(|distance| {
                let weight = |row: &Vec<Weight>| row.get(distance).map_or(0.0, |w| w.value);
                std::array::from_fn(|lane| strip.get(lane).map_or(0.0, weight))
            }));
        }
        self.starts.push(self.weights.len());
    }

    /// The weights of a block.
    #[inline(always)]
    pub fn piece(&self, block: usize) -> Piece<'_> {
        match self.blocks[block] {
            Place::Table(start) => Piece::Table(Table {
                starts: &self.starts[start..],
                weights: &self.weights,
            }),
            Place::Cubics(start, count) => {
                Piece::Cubics(Cubics(&self.cubics[start..start + count]))
            }
        }
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
) -> Vec<Weight> {
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
        let exact = kernel.kink(inner / outer, apart.sqrt());
        weights.push(Weight {
            value: exact - served,
            exact,
        });
    }
    weights
}

/// A cubic for every distance, if the rows have the same ones and no cubic is off by more than `tolerance` of what
/// its weights put right.
fn cubics(rows: &[Vec<Weight>], tolerance: f64) -> Option<Vec<[f64; 4]>> {
    let reach = rows[0].len();
    if rows.iter().any(|row| row.len() != reach) {
        return None;
    }
    (0..reach)
        .map(|distance| {
            let weights = || rows.iter().map(|row| row[distance]);
            let values: Vec<f64> = weights().map(|weight| weight.value).collect();
            let cubic = through(&values);
            let fits = |(i, weight): (usize, Weight)| {
                // Weights are differences of numbers near κ, and rounded like those.
                let allowed = tolerance * weight.exact.abs() + 16.0 * f64::EPSILON;
                (value(cubic, place(i)) - weight.value).abs() <= allowed
            };
            weights().enumerate().all(fits).then_some(cubic)
        })
        .collect()
}

//! The decay of every power from one node to the next.
//!
//! (t_{j−1}/t_j)^μ for every node j and exponent μ, nodes counted from the origin, whose own row and the next
//! are zero, as are those beyond the last. On many nodes a table of these would take 8 K bytes a node: there, what a
//! power loses, 1 − (t_{j−1}/t_j)^μ, is a [cubic](super::cubic) over a block, and no power is wrong by more than
//! the relative error of that, however many nodes it is carried over.

use super::cubic::{BLOCK, CACHED, SHARE, place, through, value};
use super::powers::LANES;

/// Where a block is found.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Place {
    Rows(usize),
    Cubics(usize),
}

/// The decays of a block and of the first node behind it.
#[derive(Debug, Clone, Copy)]
pub(super) enum Piece<'a> {
    /// [`BLOCK`] + 1 rows of all groups.
    Rows(&'a [[f64; LANES]]),
    /// For every group the coefficients of propagator − 1 in powers of the [`place`].
    Cubics(&'a [[[f64; LANES]; 4]]),
}

/// The decays of all powers, a row a node or a cubic a block. Memory: up to N K numbers.
#[derive(Debug, PartialEq)]
pub(super) struct Propagator {
    groups: usize,
    places: Vec<Place>,
    rows: Vec<[f64; LANES]>,
    cubics: Vec<[[f64; LANES]; 4]>,
}

impl Propagator {
    /// For nodes at `radii`, the first of them 0, and powers that hold to `tolerance`.
    pub fn new(radii: &[f64], exponents: &[f64], tolerance: f64) -> Self {
        let (groups, _) = exponents.as_chunks::<LANES>();
        let mut propagator = Self {
            groups: groups.len(),
            places: Vec::with_capacity(radii.len().div_ceil(BLOCK)),
            rows: Vec::new(),
            cubics: Vec::new(),
        };
        for first in (0..radii.len()).step_by(BLOCK) {
            // ln (t_j/t_{j−1}), infinite at the origin and beyond the last node.
            let steps: [f64; BLOCK + 1] = std::array::from_fn(|i| match first + i {
                j if j > 1 && j < radii.len() => {
                    2.0 * ((radii[j] - radii[j - 1]) / radii[j - 1]).ln_1p()
                }
                _ => f64::INFINITY,
            });
            let smooth = radii.len() > CACHED && steps.iter().all(|step| step.is_finite());
            let cubics: Option<Vec<_>> = groups
                .iter()
                .map(|group| smooth.then(|| cubics(&steps, group, SHARE * tolerance))?)
                .collect();
            if let Some(cubics) = cubics {
                propagator
                    .places
                    .push(Place::Cubics(propagator.cubics.len()));
                propagator.cubics.extend(cubics);
            } else {
                propagator.places.push(Place::Rows(propagator.rows.len()));
                let rows = steps.iter().flat_map(|step| {
                    let row = groups.iter();
                    row.map(move |group| group.map(|exponent| (-exponent * step).exp()))
                });
                propagator.rows.extend(rows);
            }
        }
        propagator
    }

    /// The decays of one block.
    pub fn piece(&self, block: usize) -> Piece<'_> {
        match self.places[block] {
            Place::Rows(start) => Piece::Rows(&self.rows[start..start + (BLOCK + 1) * self.groups]),
            Place::Cubics(start) => Piece::Cubics(&self.cubics[start..start + self.groups]),
        }
    }

    /// Multiplies powers by their decays from node − 1 to `node`.
    pub fn carry(&self, node: usize, powers: &mut [f64]) {
        let (powers, _) = powers.as_chunks_mut::<LANES>();
        let i = node % BLOCK;
        match self.piece(node / BLOCK) {
            Piece::Rows(rows) => {
                let rows = rows[i * self.groups..].iter();
                for (power, propagator) in powers.as_flattened_mut().iter_mut().zip(rows.flatten())
                {
                    *power *= propagator;
                }
            }
            Piece::Cubics(cubics) => {
                for (powers, group) in powers.iter_mut().zip(cubics) {
                    for (lane, power) in powers.iter_mut().enumerate() {
                        *power += *power * value(group.map(|lanes| lanes[lane]), place(i));
                    }
                }
            }
        }
    }
}

/// The cubics of one group over steps ln (t_j/t_{j−1}), if none is off by more than `tolerance` of what it
/// stands for.
fn cubics(
    steps: &[f64; BLOCK + 1],
    exponents: &[f64; LANES],
    tolerance: f64,
) -> Option<[[f64; LANES]; 4]> {
    let mut group = [[0.0; LANES]; 4];
    for (lane, exponent) in exponents.iter().enumerate() {
        let losses = steps.map(|step| (-exponent * step).exp_m1());
        let cubic = through(&losses);
        let mut nodes = losses.iter().zip(steps).enumerate();
        if nodes.any(|(i, (loss, step))| {
            // The places of the nodes are themselves rounded.
            let rounding = 2.0 * f64::EPSILON / step;
            (value(cubic, place(i)) - loss).abs() > (tolerance + rounding) * loss.abs()
        }) {
            return None;
        }
        for (lanes, coefficient) in group.iter_mut().zip(cubic) {
            lanes[lane] = coefficient;
        }
    }
    Some(group)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cubics where the nodes are smooth, tables at the origin, around a border and at the end; both propagator alike.
    #[test]
    fn cubics_stand_for_the_table() {
        let nodes = 3 * CACHED;
        let radii: Vec<f64> = (0..nodes)
            .map(|j| j as f64 + if j > nodes / 2 { 0.5 } else { 0.0 })
            .collect();
        let exponents = [1.0, 2.5, 300.0, nodes as f64];
        let propagator = Propagator::new(&radii, &exponents, 1e-8);
        let is_table = |block: usize| matches!(propagator.places[block], Place::Rows(_));
        let tables = (0..propagator.places.len()).filter(|&block| is_table(block));
        let tables = tables.count();
        assert!(is_table(0) && is_table(nodes / 2 / BLOCK) && is_table(nodes / BLOCK - 1));
        assert!(3 * tables < propagator.places.len(), "{tables}");
        for j in [
            2,
            63,
            64,
            20_000,
            nodes / 2,
            nodes / 2 + 1,
            30_016,
            nodes - 1,
        ] {
            let mut powers = [1.0; LANES];
            propagator.carry(j, &mut powers);
            for (power, exponent) in powers.iter().zip(exponents) {
                let exact = 2.0 * exponent * (radii[j - 1] / radii[j]).ln();
                assert!((power - exact.exp()).abs() < 1.1e-9 * -exact.exp_m1() + 1e-15);
            }
        }
    }
}

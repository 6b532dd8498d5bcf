//! The decay of every power from one node to the next.
//!
//! (t_{j−1}/t_j)^μ for every node j and exponent μ, nodes counted from the origin, whose own row and the next
//! are zero, as are those beyond the last. A table of 8 K bytes a node: on 20 000 to 100 000 nodes, where it no longer
//! fits the caches, cubics in its place would make a step up to 1.4 times faster at the end and slower before.

use super::powers::LANES;

/// Rows that a sweep takes at a time.
pub(super) const BLOCK: usize = 64;

/// The decays of all powers, a row a node. Memory: N K numbers.
#[derive(Debug, PartialEq)]
pub(super) struct Propagator {
    groups: usize,
    rows: Vec<[f64; LANES]>,
}

impl Propagator {
    /// For nodes at `radii`, the first of them 0.
    pub fn new(radii: &[f64], exponents: &[f64]) -> Self {
        let (groups, _) = exponents.as_chunks::<LANES>();
        // The row behind the last block is read along with it.
        let padded = radii.len().next_multiple_of(BLOCK) + 1;
        let rows = (0..padded).flat_map(|j| {
            // ln (t_j/t_{j−1}), infinite at the origin and beyond the last node.
            let step = match j {
                j if j > 1 && j < radii.len() => {
                    2.0 * ((radii[j] - radii[j - 1]) / radii[j - 1]).ln_1p()
                }
                _ => f64::INFINITY,
            };
            let row = groups.iter();
            row.map(move |group| group.map(|exponent| (-exponent * step).exp()))
        });
        Self {
            groups: groups.len(),
            rows: rows.collect(),
        }
    }

    /// The decays of one block and of the first node behind it: [`BLOCK`] + 1 rows of all groups.
    pub fn block(&self, block: usize) -> &[[f64; LANES]] {
        &self.rows[block * BLOCK * self.groups..][..(BLOCK + 1) * self.groups]
    }

    /// Multiplies powers by their decays from node − 1 to `node`.
    pub fn carry(&self, node: usize, powers: &mut [f64]) {
        let row = self.rows[node * self.groups..].as_flattened();
        for (power, decay) in powers.iter_mut().zip(row) {
            *power *= decay;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_node_has_its_decay() {
        let radii: Vec<f64> = (0..150).map(|j| 0.3 * f64::from(j)).collect();
        let exponents = [1.0, 2.5, 300.0, 1000.0];
        let propagator = Propagator::new(&radii, &exponents);
        for j in [0, 1, 2, 63, 64, 65, 128, 149, 150, 192] {
            let mut powers = [1.0; LANES];
            propagator.carry(j, &mut powers);
            for (power, exponent) in powers.iter().zip(exponents) {
                let exact = match j {
                    2..150 => (radii[j - 1] / radii[j]).powf(2.0 * exponent),
                    _ => 0.0,
                };
                assert!((power - exact).abs() < 1e-12, "{j}: {power} {exact}");
            }
        }
        let last = propagator.block(2);
        assert_eq!(last.len(), BLOCK + 1);
    }
}

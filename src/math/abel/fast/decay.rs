//! By how much every power decays from one node to the next.

use super::powers::LANES;

/// (t_{j−1}/t_j)^μ for every node j and exponent μ, a row a node; nodes counted from the origin, whose
/// own row and the next are zero, as are those beyond the last. Memory: N K numbers.
#[derive(Debug, PartialEq)]
pub(super) struct Decay {
    groups: usize,
    rows: Vec<[f64; LANES]>,
}

impl Decay {
    /// For nodes at `radii`, the first of them 0.
    pub fn new(radii: &[f64], exponents: &[f64]) -> Self {
        let mut rows = Vec::with_capacity(radii.len() * exponents.len() / LANES);
        for j in 0..radii.len() {
            let inner = if j > 0 { radii[j - 1] } else { 0.0 };
            // ln (t_j/t_{j−1}), infinite at the origin.
            let step = if inner > 0.0 {
                2.0 * ((radii[j] - inner) / inner).ln_1p()
            } else {
                f64::INFINITY
            };
            for group in exponents.chunks_exact(LANES) {
                let mut lanes = [0.0; LANES];
                for (lane, exponent) in lanes.iter_mut().zip(group) {
                    *lane = (-exponent * step).exp();
                }
                rows.push(lanes);
            }
        }
        // Nothing comes in from beyond the last node; rows are worked on four at a time.
        let groups = exponents.len() / LANES;
        let padded = radii.len().next_multiple_of(LANES) + 1;
        rows.resize(padded * groups, [0.0; LANES]);
        Self { groups, rows }
    }

    /// The rows of nodes `first` to `end`.
    pub fn rows(&self, first: usize, end: usize) -> &[[f64; LANES]] {
        &self.rows[first * self.groups..end * self.groups]
    }

    /// The row of one node.
    pub fn row(&self, node: usize) -> &[[f64; LANES]] {
        self.rows(node, node + 1)
    }
}

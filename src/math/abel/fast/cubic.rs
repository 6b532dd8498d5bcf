//! Represents what varies smoothly over a block of nodes by a cubic.
//!
//! On many nodes a table of weights is read from the main memory in every sweep, which takes longer
//! than the arithmetic. Where the nodes are smoothly spaced, four numbers represent a [`BLOCK`] of
//! them: relative to the value the error at node j of a uniform grid is near (32/j)⁴/8. A block for
//! which that is not small against the tolerance keeps its table.

/// Nodes of a block.
pub(super) const BLOCK: usize = 64;

/// Up to this many nodes the tables fit into the caches and are quicker than cubics.
pub(super) const CACHED: usize = 16_384;

/// Error of a cubic relative to the tolerance.
pub(super) const SHARE: f64 = 0.1;

/// The nodes of a block that its cubics go through, near Chebyshev's.
const THROUGH: [usize; 4] = [2, 20, 44, 62];

/// Where node `i` of a block stands, between −1 and 1: the argument of the cubics.
#[inline(always)]
pub(super) fn place(i: usize) -> f64 {
    let half = BLOCK as f64 / 2.0;
    (i as f64 - half) / half
}

/// The cubic at `u`.
pub(super) fn value(coefficients: [f64; 4], u: f64) -> f64 {
    let [a, b, c, d] = coefficients;
    ((d * u + c) * u + b) * u + a
}

/// The cubic through the values at [`THROUGH`], by Newton's differences.
pub(super) fn through(values: &[f64]) -> [f64; 4] {
    let at = THROUGH.map(place);
    let mut newton = THROUGH.map(|i| values[i]);
    for order in 1..4 {
        for i in (order..4).rev() {
            newton[i] = (newton[i] - newton[i - 1]) / (at[i] - at[i - order]);
        }
    }
    let mut cubic = [0.0; 4];
    for (difference, at) in newton.iter().zip(at).rev() {
        let [a, b, c, _] = cubic;
        cubic = [
            difference - at * a,
            a - at * b,
            b - at * c,
            c - at * cubic[3],
        ];
    }
    cubic
}

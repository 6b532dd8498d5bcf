//! Integrates nodal values in one dimension: no singular kernel, no physics.

use std::ops::Range;

use super::vector::vectorized;

/// Returns ∫ y dx from x₀ to the last node by the trapezoidal rule: exact for a piecewise linear y.
pub fn trapezoid(xs: &[f64], ys: &[f64]) -> f64 {
    xs.windows(2)
        .zip(ys.windows(2))
        .map(|(x, y)| 0.5 * (x[1] - x[0]) * (y[0] + y[1]))
        .sum()
}

/// Returns weights of ∫₀ᴸ y dx for nodal values y that are linear in x² between nodes: exact for a Hertzian line load.
pub fn line_weights(xs: &[f64]) -> Vec<f64> {
    let mut weights = vec![0.0; xs.len()];
    for (k, cell) in xs.windows(2).enumerate() {
        let [a, b] = [cell[0], cell[1]];
        // ∫ₐᵇ (x² − a²)/(b² − a²) dx: the right node's share.
        let right = (b - a) * (2.0 * a + b) / (3.0 * (a + b));
        weights[k] += (b - a) - right;
        weights[k + 1] += right;
    }
    weights
}

/// Returns ∫ₐᵇ y dx by three-point Gauss quadrature: exact for polynomials up to degree five.
pub fn gauss(a: f64, b: f64, y: impl Fn(f64) -> f64) -> f64 {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let off = 0.6_f64.sqrt() * half;
    half / 9.0 * (5.0 * (y(middle - off) + y(middle + off)) + 8.0 * y(middle))
}

/// Number of pieces in [`gauss_in_pieces`].
const PIECES: u32 = 64;

/// Returns ∫ y dx over an interval by [`gauss`] in 64 equal pieces.
pub fn gauss_in_pieces([from, to]: [f64; 2], y: impl Fn(f64) -> f64) -> f64 {
    let at = |i: u32| from + (to - from) * f64::from(i) / f64::from(PIECES);
    (0..PIECES).map(|i| gauss(at(i), at(i + 1), &y)).sum()
}

/// Weights of ∫ y z m dx in each cell, with y and z linear in x² and a measure m(x).
#[derive(Debug, Clone, PartialEq)]
pub struct ProductWeights {
    /// Weight of the product of the inner values.
    inner: Vec<f64>,
    /// Weight of either product of an inner and an outer value.
    mixed: Vec<f64>,
    /// Weight of the product of the outer values.
    outer: Vec<f64>,
}

impl ProductWeights {
    /// Computes the weights at the nodes `xs`. The smooth `measure` may be infinite at 0 if y or z vanishes there.
    pub fn new(xs: &[f64], measure: impl Fn(f64) -> f64) -> Self {
        let each = |weight: fn(f64) -> f64| {
            let cells = xs.windows(2).map(|cell| {
                let [a, b] = [cell[0], cell[1]];
                gauss(a, b, |x| {
                    measure(x) * weight((x - a) * (x + a) / ((b - a) * (b + a)))
                })
            });
            cells.collect()
        };
        Self {
            inner: each(|outer| (1.0 - outer).powi(2)),
            mixed: each(|outer| outer * (1.0 - outer)),
            outer: each(|outer| outer.powi(2)),
        }
    }

    /// Returns ∫ y (|z| − `rigid`) m dx over some `cells` of nodal y and z; z has one sign in each.
    ///
    /// Keeps eight sums, as in [`weighted`].
    pub fn integral(&self, cells: Range<usize>, y: &[f64], z: &[f64], rigid: f64) -> f64 {
        const EIGHT: usize = 8;
        let behind = cells.start + 1..cells.end + 1;
        let weights =
            [&self.inner, &self.mixed, &self.outer].map(|weights| &weights[cells.clone()]);
        let [inner, mixed, outer] = weights;
        let [y0, y1] = [&y[cells.clone()], &y[behind.clone()]];
        let [z0, z1] = [&z[cells.clone()], &z[behind]];
        vectorized(
            #[inline(always)]
            move || {
                let cell = |[inner, mixed, outer, y0, y1, z0, z1]: [f64; 7]| {
                    let [z0, z1] = [z0.abs() - rigid, z1.abs() - rigid];
                    inner * y0 * z0 + mixed * (y0 * z1 + y1 * z0) + outer * y1 * z1
                };
                let all = [inner, mixed, outer, y0, y1, z0, z1];
                let (eights, count) = (all.map(|values| values.as_chunks::<EIGHT>().0), y0.len());
                let mut sums = [0.0; EIGHT];
                for k in 0..count / EIGHT {
                    let eight = eights.map(|values| &values[k]);
                    for (i, sum) in sums.iter_mut().enumerate() {
                        *sum += cell(eight.map(|values| values[i]));
                    }
                }
                let rest = count - count % EIGHT..count;
                let rest: f64 = rest.map(|k| cell(all.map(|values| values[k]))).sum();
                sums.iter().sum::<f64>() + rest
            },
        )
    }
}

/// Returns the scalar product of weights and values, slices of equal length.
///
/// Keeps eight sums, so that no addition waits for the previous one.
pub fn weighted(weights: &[f64], values: &[f64]) -> f64 {
    weighted_each(
        weights,
        values,
        #[inline(always)]
        |value| value,
    )
}

/// Returns the scalar product of weights and `of(value)`, slices of equal length.
#[inline(always)]
pub fn weighted_each(weights: &[f64], values: &[f64], of: impl Fn(f64) -> f64) -> f64 {
    debug_assert_eq!(weights.len(), values.len());
    vectorized(
        #[inline(always)]
        || eight_sums(weights, values, of),
    )
}

/// As [`weighted`] where only the first `count` values are not zero; equal bit for bit.
pub fn weighted_first(weights: &[f64], values: &[f64], count: usize) -> f64 {
    let end = count.next_multiple_of(8).min(values.len());
    weighted(&weights[..end], &values[..end])
}

#[inline(always)]
fn eight_sums(weights: &[f64], values: &[f64], of: impl Fn(f64) -> f64) -> f64 {
    let (weights, last_weights) = weights.as_chunks::<8>();
    let (values, last_values) = values.as_chunks::<8>();
    let mut sums = [0.0; 8];
    for (weights, values) in weights.iter().zip(values) {
        for ((sum, weight), value) in sums.iter_mut().zip(weights).zip(values) {
            *sum += weight * of(*value);
        }
    }
    let last = last_weights.iter().zip(last_values);
    let last: f64 = last.map(|(weight, value)| weight * of(*value)).sum();
    sums.iter().sum::<f64>() + last
}

/// Returns 2π ∫ y r dr, the volume under a surface of revolution whose height is piecewise linear in r².
pub fn volume_of_revolution(rs: &[f64], ys: &[f64]) -> f64 {
    let twice = rs
        .windows(2)
        .zip(ys.windows(2))
        .map(|(r, y)| (r[1] - r[0]) * (r[1] + r[0]) * (y[0] + y[1]))
        .sum::<f64>();
    0.5 * std::f64::consts::PI * twice
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_and_a_paraboloid_are_exact() {
        let nodes: Vec<f64> = [0.0, 0.1, 0.35, 0.5, 1.0].into();
        let line: Vec<f64> = nodes.iter().map(|x| 2.0 + 3.0 * x).collect();
        assert!((trapezoid(&nodes, &line) - 3.5).abs() < 1e-15);
        let hertz: Vec<f64> = nodes.iter().map(|x| 1.0 - x * x).collect();
        assert!((weighted(&line_weights(&nodes), &hertz) - 2.0 / 3.0).abs() < 1e-15);
        let cells = 0..nodes.len() - 1;
        let twice = ProductWeights::new(&nodes, |_| 1.0).integral(cells, &hertz, &hertz, 0.0);
        assert!((twice - 8.0 / 15.0).abs() < 1e-15);
        assert!((gauss(1.0, 3.0, |x| x.powi(5)) - 364.0 / 3.0).abs() < 1e-13);
        let cap: Vec<f64> = nodes.iter().map(|r| 1.0 - r * r).collect();
        let exact = 0.5 * std::f64::consts::PI;
        assert!((volume_of_revolution(&nodes, &cap) - exact).abs() < 1e-15);
    }

    /// Integrates (1 − x²)² over any range of cells, whatever the sign of a factor.
    #[test]
    fn a_product_is_integrated_over_the_cells_that_are_asked_for() {
        let nodes: Vec<f64> = (0..=40).map(|i| f64::from(i) / 40.0).collect();
        let cap: Vec<f64> = nodes.iter().map(|x| 1.0 - x * x).collect();
        let against: Vec<f64> = cap.iter().map(|y| -y).collect();
        let weights = ProductWeights::new(&nodes, |_| 1.0);
        let exact = |x: f64| x - 2.0 * x.powi(3) / 3.0 + x.powi(5) / 5.0;
        for cells in [0..40, 3..14, 7..23, 39..40, 5..5] {
            let found = weights.integral(cells.clone(), &cap, &against, 0.0);
            let due = exact(nodes[cells.end]) - exact(nodes[cells.start]);
            assert!((found - due).abs() < 1e-15, "{cells:?}: {found} {due}");
        }
    }
}

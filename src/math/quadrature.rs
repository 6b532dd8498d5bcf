//! Integrals of nodal values that stay in one dimension: no singular kernel, no physics.

use super::vector::vectorized;

/// ∫ y dx from x₀ to the last node, trapezoidal: exact for a piecewise linear y.
pub fn trapezoid(xs: &[f64], ys: &[f64]) -> f64 {
    xs.windows(2)
        .zip(ys.windows(2))
        .map(|(x, y)| 0.5 * (x[1] - x[0]) * (y[0] + y[1]))
        .sum()
}

/// Weights of ∫₀ᴸ y dx for nodal values y that are linear in x² between nodes: exact for a Hertzian
/// line load.
pub fn line_weights(xs: &[f64]) -> Vec<f64> {
    let mut weights = vec![0.0; xs.len()];
    for (k, cell) in xs.windows(2).enumerate() {
        let [a, b] = [cell[0], cell[1]];
        // ∫ₐᵇ (x² − a²)/(b² − a²) dx: the share of the right node.
        let right = (b - a) * (2.0 * a + b) / (3.0 * (a + b));
        weights[k] += (b - a) - right;
        weights[k + 1] += right;
    }
    weights
}

/// ∫ₐᵇ y dx by three points of Gauss: exact for polynomials up to degree five.
pub fn gauss(a: f64, b: f64, y: impl Fn(f64) -> f64) -> f64 {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let off = 0.6_f64.sqrt() * half;
    half / 9.0 * (5.0 * (y(middle - off) + y(middle + off)) + 8.0 * y(middle))
}

/// Weights of ∫ y z dx in each cell, y and z linear in x² there: of the product of the inner values, of
/// each mixed one, and of the outer values.
pub fn product_weights(xs: &[f64]) -> Vec<[f64; 3]> {
    xs.windows(2)
        .map(|cell| {
            let [a, b] = [cell[0], cell[1]];
            let outer = |x: f64| (x - a) * (x + a) / ((b - a) * (b + a));
            [
                gauss(a, b, |x| (1.0 - outer(x)).powi(2)),
                gauss(a, b, |x| outer(x) * (1.0 - outer(x))),
                gauss(a, b, |x| outer(x).powi(2)),
            ]
        })
        .collect()
}

/// The scalar product of weights and values, as many of the one as of the other.
///
/// Eight sums, so that no addition waits for the one before.
pub fn weighted(weights: &[f64], values: &[f64]) -> f64 {
    debug_assert_eq!(weights.len(), values.len());
    vectorized(
        #[inline(always)]
        || eight_sums(weights, values),
    )
}

/// The same where only the first `count` values are not zero: to the last bit.
pub fn weighted_first(weights: &[f64], values: &[f64], count: usize) -> f64 {
    let end = count.next_multiple_of(8).min(values.len());
    weighted(&weights[..end], &values[..end])
}

#[inline(always)]
fn eight_sums(weights: &[f64], values: &[f64]) -> f64 {
    let (weights, last_weights) = weights.as_chunks::<8>();
    let (values, last_values) = values.as_chunks::<8>();
    let mut sums = [0.0; 8];
    for (weights, values) in weights.iter().zip(values) {
        for ((sum, weight), value) in sums.iter_mut().zip(weights).zip(values) {
            *sum += weight * value;
        }
    }
    let last = last_weights.iter().zip(last_values);
    let last: f64 = last.map(|(weight, value)| weight * value).sum();
    sums.iter().sum::<f64>() + last
}

/// 2π ∫ y r dr: the volume under a surface of revolution whose height is piecewise linear in r².
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
        let twice: f64 = product_weights(&nodes)
            .iter()
            .zip(hertz.windows(2))
            .map(|([inner, mixed, outer], y)| {
                inner * y[0] * y[0] + 2.0 * mixed * y[0] * y[1] + outer * y[1] * y[1]
            })
            .sum();
        assert!((twice - 8.0 / 15.0).abs() < 1e-15);
        assert!((gauss(1.0, 3.0, |x| x.powi(5)) - 364.0 / 3.0).abs() < 1e-13);
        let cap: Vec<f64> = nodes.iter().map(|r| 1.0 - r * r).collect();
        let exact = 0.5 * std::f64::consts::PI;
        assert!((volume_of_revolution(&nodes, &cap) - exact).abs() < 1e-15);
    }
}

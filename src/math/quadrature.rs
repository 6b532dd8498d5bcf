//! Integrals of nodal values that stay in one dimension: no singular kernel, no physics.

/// ∫ y dx from x₀ to the last node, trapezoidal: exact for a piecewise linear y.
pub fn trapezoid(xs: &[f64], ys: &[f64]) -> f64 {
    xs.windows(2)
        .zip(ys.windows(2))
        .map(|(x, y)| 0.5 * (x[1] - x[0]) * (y[0] + y[1]))
        .sum()
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
        let cap: Vec<f64> = nodes.iter().map(|r| 1.0 - r * r).collect();
        let exact = 0.5 * std::f64::consts::PI;
        assert!((volume_of_revolution(&nodes, &cap) - exact).abs() < 1e-15);
    }
}

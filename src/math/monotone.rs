//! A cubic through given points that is monotone wherever the
//! points are. The Abel image of its slope has a closed form.
//!
//! F. N. Fritsch, R. E. Carlson (1980), SIAM J. Numer. Anal. 17, 238–246, give the condition on the
//! slopes; J. M. Hyman (1983), SIAM J. Sci. Stat. Comput. 4, 645–654, the limiter used here: slopes of the parabola
//! through three points, cut to three times the smaller of the two secants. Smooth points are not limited, so a
//! straight line and a parabola are reproduced exactly.
//!
//! Interpolation crates only evaluate; Eq. (1) of the paper needs the cubics themselves, whose image is integrated
//! exactly, segment by segment.
//!
//! # Formula
//!
//! On a segment f′ = A + Br + Cr², and with s = √(x² − r²)
//!
//! ```text
//! ∫ f′/s dr   = A asin(r/x) − B s + ½C [x² asin(r/x) − r s]                Eq. (1)
//! ∫ r f′/s dr = −A s + ½B [x² asin(r/x) − r s] − C [x² s − s³/3]           Eq. (1L)
//! ```

use super::root;

/// A monotone piecewise cubic.
#[derive(Debug, Clone, PartialEq)]
pub struct Monotone {
    nodes: Vec<f64>,
    values: Vec<f64>,
    slopes: Vec<f64>,
}

impl Monotone {
    /// Interpolates `values` at strictly increasing `nodes`. `None` unless the slices have equal lengths of at least 2
    /// and the nodes increase.
    pub fn new(nodes: Vec<f64>, values: Vec<f64>) -> Option<Self> {
        let rises = nodes.windows(2).all(|pair| pair[0] < pair[1]);
        if nodes.len() < 2 || nodes.len() != values.len() || !rises {
            return None;
        }
        let slopes = slopes(&nodes, &values);
        Some(Self {
            nodes,
            values,
            slopes,
        })
    }

    /// Nodes of the curve.
    pub fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// Values at the nodes.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Returns the value at `x`; beyond the last point, on the straight line with the slope there.
    pub fn at(&self, x: f64) -> f64 {
        let (k, last) = (self.segment(x), self.nodes.len() - 1);
        if x >= self.nodes[last] {
            return self.values[last] + self.slopes[last] * (x - self.nodes[last]);
        }
        let width = self.nodes[k + 1] - self.nodes[k];
        let t = (x - self.nodes[k]) / width;
        let (left, right) = (self.slopes[k] * width, self.slopes[k + 1] * width);
        let rise = self.values[k + 1] - self.values[k];
        // Expanded around the left point (Hermite), so that nothing cancels near it.
        self.values[k]
            + t * (left
                + t * (3.0 * rise - 2.0 * left - right)
                + t * t * (left + right - 2.0 * rise))
    }

    /// Returns x ∫₀ˣ f′(r)/√(x² − r²) dr, Eq. (1), for a curve whose first node is 0.
    ///
    /// Cost: O(points inside x), with two elementary functions per point.
    pub fn image(&self, x: f64) -> f64 {
        if x <= 0.0 {
            return 0.0;
        }
        let moments = |r: f64| {
            let root = ((x - r) * (x + r)).max(0.0).sqrt();
            ((r / x).min(1.0).asin(), root, r)
        };
        let last = self.nodes.len() - 1;
        let (mut sum, mut from) = (0.0, moments(self.nodes[0]));
        for k in 0..=last {
            if self.nodes[k] >= x {
                break;
            }
            let end = self.nodes.get(k + 1).map_or(x, |&next| next.min(x));
            let to = moments(end);
            let (constant, linear, square) = self.derivative(k);
            let turned = to.0 - from.0;
            sum += constant * turned
                + linear * (from.1 - to.1)
                + 0.5 * square * (x * x * turned - to.2 * to.1 + from.2 * from.1);
            from = to;
        }
        x * sum
    }

    /// Returns ∫₀ˣ r f′(r)/√(x² − r²) dr, Eq. (1L), for a curve whose first node is 0.
    pub fn line_image(&self, x: f64) -> f64 {
        let moments = |r: f64| {
            let root = ((x - r) * (x + r)).max(0.0).sqrt();
            let square = 0.5 * (x * x * (r / x).min(1.0).asin() - r * root);
            [-root, square, root * (root * root / 3.0 - x * x)]
        };
        let inside = self.nodes.partition_point(|&node| node < x);
        let segments = (0..inside).map(|k| {
            let end = self.nodes.get(k + 1).map_or(x, |&next| next.min(x));
            let (from, to) = (moments(self.nodes[k]), moments(end));
            let (constant, linear, square) = self.derivative(k);
            let parts = [constant, linear, square].into_iter().enumerate();
            parts.map(|(i, part)| part * (to[i] - from[i])).sum::<f64>()
        });
        segments.sum()
    }

    /// Returns the outermost x at which the curve equals `value`; beyond the last point by its slope, infinite if that
    /// does not rise.
    pub fn last_at(&self, value: f64) -> f64 {
        let last = self.nodes.len() - 1;
        if self.values[last] <= value {
            let slope = self.slopes[last];
            return if slope > 0.0 {
                self.nodes[last] + (value - self.values[last]) / slope
            } else {
                f64::INFINITY
            };
        }
        let Some(k) = self.values.iter().rposition(|&below| below <= value) else {
            return self.nodes[0];
        };
        root::first([self.nodes[k], self.nodes[k + 1]], |x| self.at(x) > value)
    }

    /// Returns f′ = A + Br + Cr² on segment `k`; constant beyond the last point.
    fn derivative(&self, k: usize) -> (f64, f64, f64) {
        if k + 1 == self.nodes.len() {
            return (self.slopes[k], 0.0, 0.0);
        }
        let (start, width) = (self.nodes[k], self.nodes[k + 1] - self.nodes[k]);
        let secant = (self.values[k + 1] - self.values[k]) / width;
        let (left, right) = (self.slopes[k], self.slopes[k + 1]);
        let linear = (6.0 * secant - 4.0 * left - 2.0 * right) / width;
        let square = (3.0 * left + 3.0 * right - 6.0 * secant) / (width * width);
        (
            left - start * (linear - start * square),
            linear - 2.0 * start * square,
            square,
        )
    }

    /// Returns the segment that contains `x`.
    fn segment(&self, x: f64) -> usize {
        let behind = self.nodes.partition_point(|&node| node <= x);
        behind.clamp(1, self.nodes.len() - 1) - 1
    }
}

/// Computes slopes of the parabola through three neighbours, limited so that the cubic stays monotone.
fn slopes(nodes: &[f64], values: &[f64]) -> Vec<f64> {
    let widths: Vec<f64> = nodes.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let secants: Vec<f64> = values
        .windows(2)
        .zip(&widths)
        .map(|(pair, width)| (pair[1] - pair[0]) / width)
        .collect();
    let last = nodes.len() - 1;
    if last == 1 {
        return vec![secants[0]; 2];
    }
    let limited = |slope: f64, before: f64, after: f64| {
        if before * after <= 0.0 || slope * before <= 0.0 {
            return 0.0;
        }
        let most = 3.0 * before.abs().min(after.abs());
        slope.abs().min(most).copysign(before)
    };
    // An end takes the parabola through its three points, no steeper than three secants.
    let end = |near: f64, next: f64, width: f64, beyond: f64| {
        let slope = near + width * (near - next) / (width + beyond);
        limited(slope, near, near)
    };
    let mut slopes = vec![0.0; nodes.len()];
    slopes[0] = end(secants[0], secants[1], widths[0], widths[1]);
    slopes[last] = end(
        secants[last - 1],
        secants[last - 2],
        widths[last - 1],
        widths[last - 2],
    );
    for k in 1..last {
        let (before, after) = (secants[k - 1], secants[k]);
        let parabola = (before * widths[k] + after * widths[k - 1]) / (widths[k - 1] + widths[k]);
        slopes[k] = limited(parabola, before, after);
    }
    slopes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(f: impl Fn(f64) -> f64, points: u32) -> Monotone {
        let nodes: Vec<f64> = (0..=points)
            .map(|i| 2.0 * (f64::from(i) / f64::from(points)).powf(1.3))
            .collect();
        let values = nodes.iter().map(|&x| f(x)).collect();
        Monotone::new(nodes, values).expect("a curve")
    }

    /// Returns the largest relative error of the image of rⁿ, κₙxⁿ, for x from 0.3 to 1.9.
    fn error(exponent: f64, kappa: f64, points: u32) -> f64 {
        let curve = of(|r| r.powf(exponent), points);
        (3..20)
            .map(|i| f64::from(i) * 0.1)
            .map(|x| (curve.image(x) / (kappa * x.powf(exponent)) - 1.0).abs())
            .fold(0.0, f64::max)
    }

    #[test]
    fn lines_and_parabolas_are_exact() {
        assert!(error(1.0, std::f64::consts::FRAC_PI_2, 17) < 1e-13);
        let cubic = of(|r| 3.0 * r + 2.0 * r * r, 17);
        let image = 3.0 * 1.3 + std::f64::consts::PI * 1.3 * 1.3;
        assert!((cubic.line_image(1.3) - image).abs() < 1e-12);
        assert!(error(2.0, 2.0, 17) < 1e-12);
        let parabola = of(|r| 3.0 * r * r, 9);
        assert!((parabola.at(1.234) - 3.0 * 1.234 * 1.234).abs() < 1e-13);
        assert!((parabola.last_at(3.0) - 1.0).abs() < 1e-13);
        // Beyond the table the slope stays at its end value, 12.
        assert!((parabola.at(3.0) - 24.0).abs() < 1e-12);
        assert!((parabola.last_at(24.0) - 3.0).abs() < 1e-12);
    }

    /// The image follows the slopes, which are of second order.
    #[test]
    fn the_image_of_a_quartic_converges_with_second_order() {
        let (coarse, fine) = (error(4.0, 8.0 / 3.0, 40), error(4.0, 8.0 / 3.0, 160));
        let order = (coarse / fine).log(4.0);
        assert!(fine < 1e-4 && order > 2.0, "{coarse} {fine} {order}");
    }

    #[test]
    fn steps_and_plateaus_stay_monotone() {
        let values = vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.05, 4.0, 4.0];
        let nodes: Vec<f64> = (0..8).map(f64::from).collect();
        let curve = Monotone::new(nodes, values).expect("a curve");
        let samples: Vec<f64> = (0..=700).map(|i| curve.at(f64::from(i) * 0.01)).collect();
        assert!(samples.windows(2).all(|pair| pair[1] >= pair[0] - 1e-15));
        assert_eq!(curve.at(1.5), 0.0);
        assert_eq!(curve.last_at(4.0), f64::INFINITY);
    }

    #[test]
    fn the_image_is_that_of_eq_1() {
        let curve =
            Monotone::new(vec![0.0, 0.4, 0.5, 1.0], vec![0.0, 0.3, 0.31, 2.0]).expect("a curve");
        for x in [0.2, 0.45, 0.9, 1.4] {
            let steps = 200_000;
            let h = std::f64::consts::FRAC_PI_2 / f64::from(steps);
            let slope = |r: f64| (curve.at(r + 1e-6) - curve.at((r - 1e-6).abs())) / 2e-6;
            let sum: f64 = (0..steps)
                .map(|i| slope(x * (h * (f64::from(i) + 0.5)).sin()))
                .sum();
            let (ours, expected) = (curve.image(x), x * h * sum);
            assert!(
                (ours / expected - 1.0).abs() < 1e-4,
                "{x}: {ours} {expected}"
            );
        }
    }

    #[test]
    fn what_is_no_curve_is_refused() {
        assert!(Monotone::new(vec![0.0], vec![0.0]).is_none());
        assert!(Monotone::new(vec![0.0, 0.0], vec![0.0, 1.0]).is_none());
        assert!(Monotone::new(vec![0.0, 1.0], vec![0.0]).is_none());
        assert!(Monotone::new(vec![0.0, f64::NAN], vec![0.0, 1.0]).is_none());
    }
}

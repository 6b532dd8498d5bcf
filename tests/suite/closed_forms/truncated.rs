//! A paraboloid with a flat tip of radius b, f = (r²−b²)/2R, frictionless.
//!
//! Sources: Maugis & Barquins (1983), Popov & Heß (2015), ch. 3. From (1), for x > b (g = 0 up to b):
//! g = (x/R)√(x²−b²), F = (2E*/3R)(2a²+b²)√(a²−b²).
//!
//! The pressure is an incomplete elliptic integral. With m = max(r, b), l = min(r, b) and
//! x² = m² + (m²−l²) sinh² v, (3) becomes p = (E*/π) ∫ g′(x)√(x²−b²)/x dv, whose integrand is smooth;
//! it is integrated numerically. p is finite on the axis, +∞ (logarithmic) at the rim r = b, and 0 at the contact edge.
//! b = 0 is the whole paraboloid.

use super::elementary::{leg, positive_part};
use super::power_law::PowerLaw;
use super::quadrature::integrate;
use std::f64::consts::PI;

/// f = (r² − b²)/(2R) for r > b, 0 for r ≤ b.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TruncatedParaboloid {
    /// E*, Pa.
    pub e_star: f64,
    /// Radius of curvature R, m.
    pub radius: f64,
    /// Radius of the flat tip b ≥ 0, m.
    pub tip_radius: f64,
}

impl TruncatedParaboloid {
    /// f(r), m.
    pub fn profile(&self, r: f64) -> f64 {
        let b = self.tip_radius;
        positive_part((r - b) * (r + b)) / (2.0 * self.radius)
    }

    /// g(x) = (x/R)√(x²−b²), m; 0 for |x| ≤ b.
    pub fn mdr_profile(&self, x: f64) -> f64 {
        x.abs() / self.radius * leg(x.abs(), self.tip_radius)
    }

    /// d = (a/R)√(a²−b²), m, for a ≥ b; NaN for a < b, which no load produces.
    pub fn depth(&self, contact_radius: f64) -> f64 {
        if contact_radius < self.tip_radius {
            return f64::NAN;
        }
        self.mdr_profile(contact_radius)
    }

    /// a, m: 2a² = b² + √(b⁴ + 4R²d²); b at d = 0, and 0 (no contact) for d < 0.
    pub fn contact_radius(&self, depth: f64) -> f64 {
        if depth < 0.0 {
            return 0.0;
        }
        let square = self.tip_radius * self.tip_radius;
        (0.5 * (square + square.hypot(2.0 * self.radius * depth))).sqrt()
    }

    /// F = (2E*/3R)(2a²+b²)√(a²−b²), N, for a ≥ b; NaN for a < b.
    pub fn force(&self, contact_radius: f64) -> f64 {
        let (a, b) = (contact_radius, self.tip_radius);
        if a < b {
            return f64::NAN;
        }
        2.0 * self.e_star / (3.0 * self.radius) * (2.0 * a * a + b * b) * leg(a, b)
    }

    /// p(r), Pa, by quadrature of (3); +∞ at r = b, 0 for r ≥ a (and everywhere if a ≤ b).
    pub fn pressure(&self, contact_radius: f64, r: f64) -> f64 {
        let (a, b) = (contact_radius, self.tip_radius);
        if r >= a || a <= b {
            return 0.0;
        }
        if b == 0.0 {
            return PowerLaw::paraboloid(self.radius).pressure(self.e_star, a, r);
        }
        let (m, l) = (r.max(b), r.min(b));
        let (reach, gap) = (leg(a, m), leg(m, l));
        if gap == 0.0 {
            return f64::INFINITY;
        }
        // asinh(reach/gap), without overflow when the gap is tiny.
        let end = if reach > gap {
            (reach + reach.hypot(gap)).ln() - gap.ln()
        } else {
            (reach / gap).asinh()
        };
        let integrand = |v: f64| {
            let x = m.hypot(gap * v.sinh());
            (2.0 * x * x - b * b) / self.radius / x
        };
        self.e_star / PI * integrate(integrand, 0.0, end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    const E: f64 = 2.3e11;
    const A: f64 = 1.4e-4;
    const BALL: TruncatedParaboloid = TruncatedParaboloid {
        e_star: E,
        radius: 0.01,
        tip_radius: 5e-5,
    };

    fn close(value: f64, exact: f64, relative: f64, what: &str) {
        let error = (value - exact).abs();
        assert!(
            error <= relative * exact.abs(),
            "{what}: {value:e} against {exact:e}"
        );
    }

    /// Returns ∫₀ᵃ f dr; the steps r = b(1 ∓ t³) remove the logarithm at the rim b.
    fn across_rim(f: impl Fn(f64) -> f64, a: f64, b: f64) -> f64 {
        let inner = |t: f64| f(b * (1.0 - t.powi(3))) * 3.0 * b * t * t;
        let outer = |t: f64| f(b + (a - b) * t.powi(3)) * 3.0 * (a - b) * t * t;
        integrate(inner, 0.0, 1.0) + integrate(outer, 0.0, 1.0)
    }

    #[test]
    fn mdr_profiles_are_equation_1() {
        for x in [5.1e-5, 9e-5, A] {
            // r = x sin t, from the rim at sin t = b/x.
            let start = (5e-5f64 / x).asin();
            let ball = x * integrate(|t| x * t.sin() / 0.01, start, FRAC_PI_2);
            close(BALL.mdr_profile(-x), ball, 1e-12, "ball");
        }
        assert_eq!(BALL.mdr_profile(4e-5), 0.0);
    }

    #[test]
    fn forces_are_the_sum_of_the_springs_and_of_the_pressure() {
        let area = |g: &dyn Fn(f64) -> f64| {
            // x = b + (a − b)t² removes the root at b.
            let (b, l) = (5e-5, A - 5e-5);
            let outer = |t: f64| (g(A) - g(b + l * t * t)) * 2.0 * l * t;
            2.0 * E * (g(A) * b + integrate(outer, 0.0, 1.0))
        };
        close(
            BALL.force(A),
            area(&|x| BALL.mdr_profile(x)),
            1e-12,
            "ball springs",
        );
        let ring = |p: f64, r: f64| 2.0 * PI * r * p;
        let ball = across_rim(|r| ring(BALL.pressure(A, r), r), A, 5e-5);
        close(BALL.force(A), ball, 1e-9, "ball pressure");
    }

    #[test]
    fn pressure_is_equation_3_by_secants() {
        let b = 5e-5f64;
        let ball = |x: f64| (2.0 * x * x - b * b) / (0.01 * (x * x - b * b).sqrt());
        // x = m/cos t: dx/√(x²−m²) = dt/cos t, leaving the other root.
        let by_secant = |slope: &dyn Fn(f64) -> f64, r: f64| {
            let m = r.max(b);
            let integrand = |t: f64| {
                let x = m / t.cos();
                let other = if r > b {
                    1.0
                } else {
                    ((x * x - b * b) / (x * x - r * r)).sqrt()
                };
                slope(x) * other / t.cos()
            };
            E / PI * integrate(integrand, 0.0, (m / A).acos())
        };
        for r in [0.0, 1e-5, 4e-5, 4.9e-5, 5.1e-5, 6e-5, 1e-4, 1.39e-4] {
            close(BALL.pressure(A, r), by_secant(&ball, r), 1e-11, "ball");
        }
    }

    #[test]
    fn no_tip_is_the_plain_shape_and_a_small_one_nearly_so() {
        let (r, hertz) = (0.4 * A, PowerLaw::paraboloid(0.01));
        for (b, tolerance) in [(0.0, 1e-14), (1e-9, 1e-7)] {
            let ball = TruncatedParaboloid {
                tip_radius: b,
                ..BALL
            };
            close(
                ball.pressure(A, r),
                hertz.pressure(E, A, r),
                tolerance,
                "p ball",
            );
            close(
                ball.force(A),
                hertz.force(E, hertz.depth(A)),
                tolerance,
                "F ball",
            );
        }
    }

    #[test]
    fn axis_value_in_closed_form() {
        // r = 0: p = (E*/πR) ∫ (2x²−b²)/(x√(x²−b²)) dx = (E*/πR)[2√(a²−b²) − b acos(b/a)].
        let (b, s) = (5e-5f64, leg(A, 5e-5));
        let ball = E / (PI * 0.01) * (2.0 * s - b * (b / A).acos());
        close(BALL.pressure(A, 0.0), ball, 1e-13, "ball axis");
    }

    #[test]
    fn depth_inverts_and_limits_hold() {
        // Just above the tip d rises like √(a−b), so the last digit of a costs half of the digits of d.
        for (d, tolerance) in [(1e-12, 1e-4), (1e-8, 1e-11), (1e-6, 1e-14), (1e-2, 1e-14)] {
            close(
                BALL.depth(BALL.contact_radius(d)),
                d,
                tolerance,
                "ball d(a(d))",
            );
        }
        close(BALL.contact_radius(0.0), 5e-5, 1e-15, "a = b");
        assert_eq!(BALL.contact_radius(-1.0), 0.0);
        assert!(BALL.depth(4e-5).is_nan() && BALL.force(4e-5).is_nan());
        assert_eq!(BALL.pressure(A, 5e-5), f64::INFINITY);
        assert_eq!((BALL.pressure(A, A), BALL.pressure(5e-5, 0.0)), (0.0, 0.0));
        assert_eq!(BALL.profile(4e-5), 0.0);
    }
}

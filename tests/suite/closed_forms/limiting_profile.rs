//! The limiting profile of a paraboloid after endless fretting at fixed depth.
//!
//! Source: Popov (2014), Appl. Phys. Lett. 104, 191602, and Dimaki et al. (2014); Li et al. (2019)
//! for the transforms. Inside the permanent stick radius c nothing slips and f = f₀; outside, wear
//! continues until the pressure has vanished:
//! - g∞ = x²/R for x < c, = d for c < x < b;
//! - f∞ = [r² asin(c/r) − c√(r²−c²)]/(πR) + d[1 − (2/π) asin(c/r)] for c < r < b, f₀ outside;
//! - b where f∞(b) = f₀(b): b² + c√(b²−c²)/acos(c/b) = 2a², a² = Rd, so a ≤ b ≤ √(2a² − c²);
//! - F∞ = 2E*(dc − c³/3R);
//! - p∞ = (E*/π)(d − c²/R)/√(c²−r²) + (2E*/πR)√(c²−r²) for r < c, singular at c.
//!
//! d is the largest depth of the motion. c → 0: f∞ = d for 0 < r < √2 a. c = a: nothing wears, b = a.

use super::elementary::{angle_beyond, bisect, leg, positive_part};
use super::quadrature::integrate;
use std::f64::consts::PI;

/// The limiting state of a paraboloid r²/(2R) under a fixed depth and permanent stick radius.
///
/// Every method gives NaN unless 0 ≤ c ≤ √(Rd).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimitingProfile {
    /// E*, Pa.
    pub e_star: f64,
    /// Radius of curvature R, m.
    pub radius: f64,
    /// d, m: the largest depth of the motion.
    pub depth: f64,
    /// c, m: the permanent stick radius.
    pub stick_radius: f64,
}

impl LimitingProfile {
    /// Returns the limit under a held normal force N (and a held tangential force amplitude, so that c stays constant):
    /// d∞ = N/(2E*c) + c²/(3R), m. The force in N; needs c > 0.
    pub fn under_force(e_star: f64, radius: f64, force: f64, stick_radius: f64) -> Self {
        let c = stick_radius;
        Self {
            e_star,
            radius,
            depth: force / (2.0 * e_star * c) + c * c / (3.0 * radius),
            stick_radius,
        }
    }

    /// a² = Rd, m².
    fn contact_square(&self) -> f64 {
        self.radius * self.depth
    }

    fn is_valid(&self) -> bool {
        let c = self.stick_radius;
        // Tolerates a rounded c = √(Rd).
        c >= 0.0 && c * c <= self.contact_square() * (1.0 + 4.0 * f64::EPSILON)
    }

    /// b, m: the outer edge of the worn ring; nothing beyond it ever touches.
    pub fn outer_radius(&self) -> f64 {
        if !self.is_valid() {
            return f64::NAN;
        }
        let (c, square) = (self.stick_radius, self.contact_square());
        // r² + c√(r²−c²)/acos(c/r) rises from 2c² at r = c.
        let excess = |r: f64| {
            let angle = angle_beyond(c, r);
            let mean = if angle > 0.0 { leg(r, c) / angle } else { c };
            r * r + c * mean - 2.0 * square
        };
        let low = square.sqrt().max(c);
        let high = (2.0 * square - c * c).sqrt().max(low);
        bisect(low, high, |r| excess(r) < 0.0)
    }

    /// f₀(r) = r²/(2R), m.
    pub fn unworn(&self, r: f64) -> f64 {
        r * r / (2.0 * self.radius)
    }

    /// f∞(r) − f₀(r), m: the worn depth for c < r < b; 0 elsewhere.
    pub fn worn_depth(&self, r: f64) -> f64 {
        let b = self.outer_radius();
        if b.is_nan() {
            return f64::NAN;
        }
        if r >= b { 0.0 } else { self.ring_wear(r) }
    }

    /// [(2a²−r²) acos(c/r) − c√(r²−c²)]/(πR), 0 inside c.
    fn ring_wear(&self, r: f64) -> f64 {
        let c = self.stick_radius;
        if r <= c {
            return 0.0;
        }
        let square = 2.0 * self.contact_square() - r * r;
        let worn = square * angle_beyond(c, r) - c * leg(r, c);
        positive_part(worn / (PI * self.radius))
    }

    /// f∞(r), m.
    pub fn profile(&self, r: f64) -> f64 {
        self.unworn(r) + self.worn_depth(r)
    }

    /// g∞(x), m: x²/R up to c, d up to b, and by quadrature of (1) beyond, where it exceeds d.
    pub fn mdr_profile(&self, x: f64) -> f64 {
        let (x, c, b) = (x.abs(), self.stick_radius, self.outer_radius());
        if b.is_nan() {
            return f64::NAN;
        }
        if x <= c {
            return x * x / self.radius;
        }
        if x <= b {
            return self.depth;
        }
        // r² = c² + t², t = √(x²−c²) sin φ: f∞′ dr = [(2/πR)(t asin(c/r) − c) + 2dc/(πr²)] dt.
        let reach = leg(x, c);
        let integrand = |angle: f64| {
            let t = reach * angle.sin();
            let r = c.hypot(t);
            let ring = if c > 0.0 {
                2.0 / (PI * self.radius) * (t * c.atan2(t) - c)
                    + 2.0 * self.depth * c / (PI * r * r)
            } else {
                0.0
            };
            x * ring
        };
        // At c = 0 the ring's term is d·δ(r): a step of height d at the tip.
        let ring = if c > 0.0 {
            integrate(integrand, 0.0, (leg(b, c) / reach).asin())
        } else {
            self.depth
        };
        x * (x - reach + leg(x, b)) / self.radius + ring
    }

    /// F∞ = 2E*(dc − c³/(3R)), N.
    pub fn force(&self) -> f64 {
        if !self.is_valid() {
            return f64::NAN;
        }
        let c = self.stick_radius;
        2.0 * self.e_star * (self.depth * c - c.powi(3) / (3.0 * self.radius))
    }

    /// p∞(r), Pa; +∞ at r = c (0 there if c = a), 0 outside.
    pub fn pressure(&self, r: f64) -> f64 {
        if !self.is_valid() {
            return f64::NAN;
        }
        let c = self.stick_radius;
        if r > c || c == 0.0 {
            return 0.0;
        }
        let root = leg(c, r);
        let step = positive_part(self.contact_square() - c * c);
        let hertz = 2.0 * root;
        let factor = self.e_star / (PI * self.radius);
        // A step as small as rounding counts as none.
        if step <= 4.0 * f64::EPSILON * c * c {
            return factor * hertz;
        }
        factor * (step / root + hertz)
    }

    /// V∞ = 2π∫(f∞ − f₀) r dr, m³: with t = √(b²−c²), θ = acos(c/b),
    /// 2[d(b²θ − ct) − (b⁴θ + ct³ − c³t)/(4R)].
    pub fn worn_volume(&self) -> f64 {
        let (b, c) = (self.outer_radius(), self.stick_radius);
        let (t, angle) = (leg(b, c), angle_beyond(c, b));
        let bend = b.powi(4) * angle + c * t * (t * t - c * c);
        2.0 * (self.depth * (b * b * angle - c * t) - bend / (4.0 * self.radius))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    const E: f64 = 2.3e11;

    /// a = 1e-4 m; c as a fraction of it.
    fn limit(fraction: f64) -> LimitingProfile {
        LimitingProfile {
            e_star: E,
            radius: 0.01,
            depth: 1e-6,
            stick_radius: fraction * 1e-4,
        }
    }

    fn close(value: f64, exact: f64, relative: f64, what: &str) {
        let error = (value - exact).abs();
        assert!(
            error <= relative * exact.abs(),
            "{what}: {value:e} against {exact:e}"
        );
    }

    const FRACTIONS: [f64; 6] = [1e-6, 0.05, 0.4164, 0.767, 0.95, 0.999];

    #[test]
    fn profile_is_the_inverse_transform_of_g() {
        for l in FRACTIONS.map(limit) {
            let (c, b) = (l.stick_radius, l.outer_radius());
            for r in [0.2, 0.5, 0.9, 1.0].map(|t| c + t * (b - c)) {
                // f = (2/π) ∫ g(r sin φ) dφ with the step at x = c.
                let step = (c / r).asin();
                let inner = integrate(|t| (r * t.sin()).powi(2) / 0.01, 0.0, step);
                let f = 2.0 / PI * (inner + l.depth * (FRAC_PI_2 - step));
                close(l.profile(r), f, 1e-12, "f∞");
                // As published.
                let (s, root) = ((c / r).asin(), (r * r - c * c).sqrt());
                let f = (r * r * s - c * root) / (PI * 0.01) + 1e-6 * (1.0 - 2.0 / PI * s);
                close(l.profile(r), f, 1e-12, "f∞ as published");
            }
        }
    }

    #[test]
    fn outer_radius_is_where_both_profiles_meet() {
        for l in FRACTIONS.map(limit) {
            let (c, b) = (l.stick_radius, l.outer_radius());
            assert!(b >= 1e-4 && b * b <= 2e-8 - c * c, "{b:e}");
            assert!(l.ring_wear(b) < 1e-15 * l.depth);
            assert!(l.worn_depth(b - 1e-3 * (b - c)) > 0.0);
            assert_eq!(l.worn_depth(b), 0.0);
            // Beyond b the formula would add material.
            let past = b + 1e-3 * (b - c);
            let f = 2e-8 - past * past;
            assert!(f * angle_beyond(c, past) < c * leg(past, c));
        }
    }

    #[test]
    fn g_beyond_b_transforms_back_to_the_unworn_profile() {
        for l in [0.05, 0.4164, 0.767, 0.95].map(limit) {
            let (c, b) = (l.stick_radius, l.outer_radius());
            close(
                l.mdr_profile(b * (1.0 + 1e-12)),
                l.depth,
                1e-4,
                "continuous at b",
            );
            for r in [1.05 * b, 1.6 * b] {
                assert!(l.mdr_profile(r) > l.depth);
                // t = sin φ; x = r sin φ, with φ = φ_b + s² to remove the square root at b.
                let (inner, outer) = ((c / r).asin(), (b / r).asin());
                let parabola = integrate(|t| (r * t.sin()).powi(2) / 0.01, 0.0, inner);
                let flat = l.depth * (outer - inner);
                let end = (FRAC_PI_2 - outer).sqrt();
                let g = |s: f64| 2.0 * s * l.mdr_profile(r * (outer + s * s).sin());
                let f = 2.0 / PI * (parabola + flat + integrate(g, 0.0, end));
                close(f, l.unworn(r), 1e-9, "f₀ outside b");
            }
        }
    }

    #[test]
    fn pressure_is_equation_3_and_balances_the_force() {
        for l in FRACTIONS.map(limit) {
            let c = l.stick_radius;
            let ring = |t: f64| 2.0 * PI * c * t.sin() * l.pressure(c * t.sin()) * c * t.cos();
            // In t the ring is smooth, but c sin t rounds to c: the last sliver becomes one rectangle.
            let (sliver, end) = (1e-4, FRAC_PI_2 - 1e-4);
            let sum = integrate(ring, 0.0, end) + sliver * ring(end);
            close(sum, l.force(), 1e-10, "F∞");
            let springs = 2.0 * E * integrate(|x| l.depth - x * x / 0.01, 0.0, c);
            close(l.force(), springs, 1e-12, "springs");
            // −q′ = 2E*x/R inside and a jump q(c) at c.
            let r = 0.6 * c;
            let end = (c * c - r * r).sqrt();
            let inner = integrate(|_| 2.0 * E / 0.01, 0.0, end);
            let jump = E * (l.depth - c * c / 0.01) / end;
            close(l.pressure(r), (inner + jump) / PI, 1e-12, "p∞");
            let again = LimitingProfile::under_force(E, 0.01, l.force(), c);
            close(again.depth, l.depth, 1e-13, "d∞ of the same force");
        }
    }

    #[test]
    fn worn_volume_against_its_integral() {
        for l in FRACTIONS.map(limit) {
            let (c, b) = (l.stick_radius, l.outer_radius());
            // r = c + (b−c)t² removes the root at c.
            let ring = |t: f64| {
                let r = c + (b - c) * t * t;
                2.0 * PI * r * l.ring_wear(r) * 2.0 * (b - c) * t
            };
            let scale = PI * b * b * l.depth;
            let error = (l.worn_volume() - integrate(ring, 0.0, 1.0)).abs();
            assert!(error < 1e-13 * scale, "{error:e}");
        }
    }

    #[test]
    fn limits_of_no_stick_full_stick_and_impossible_stick() {
        let none = limit(0.0);
        close(none.outer_radius(), 2f64.sqrt() * 1e-4, 1e-15, "b = √2 a");
        close(none.profile(5e-5), 1e-6, 1e-15, "flat at d");
        assert_eq!(
            (none.force(), none.pressure(0.0), none.profile(0.0)),
            (0.0, 0.0, 0.0)
        );
        // 2π ∫ (d − r²/2R) r dr to √2 a = π a² d.
        close(none.worn_volume(), PI * 1e-8 * 1e-6, 1e-14, "V");
        // f = d up to b, then f₀: g = d + (x/R)√(x²−b²).
        let x: f64 = 3e-4;
        let g = 1e-6 + x / 0.01 * (x * x - 2e-8).sqrt();
        close(none.mdr_profile(x), g, 1e-14, "g");
        close(limit(1e-9).mdr_profile(x), g, 1e-6, "g, c → 0");

        let full = LimitingProfile {
            stick_radius: (0.01f64 * 1e-6).sqrt(),
            ..none
        };
        close(full.outer_radius(), 1e-4, 1e-12, "b = a");
        assert_eq!(full.worn_depth(9e-5), 0.0);
        close(full.force(), 4.0 / 3.0 * E * 1e-12 / 0.01, 1e-12, "Hertz");
        close(
            full.pressure(0.0),
            2.0 * E / (PI * 0.01) * 1e-4,
            1e-12,
            "Hertz p₀",
        );
        assert!(full.pressure(full.stick_radius) < 1e-6 * full.pressure(0.0));
        assert_eq!(limit(0.5).pressure(0.5e-4), f64::INFINITY);
        for wrong in [limit(1.1), limit(-0.1), limit(f64::NAN)] {
            assert!(wrong.outer_radius().is_nan() && wrong.profile(1e-4).is_nan());
            assert!(wrong.force().is_nan() && wrong.pressure(0.0).is_nan());
            assert!(wrong.mdr_profile(1e-5).is_nan() && wrong.worn_volume().is_nan());
        }
    }
}

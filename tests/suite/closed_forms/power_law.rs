//! Frictionless contact of f(r) = A rⁿ on an elastic half-space: paraboloid, cone, quartic, and others.
//!
//! Sources: Hertz (1882) for the paraboloid, Love (1939) for the cone, Galin (1946) and Sneddon
//! (1965) for any n; in the words of the method, Popov & Heß (2015), ch. 3, with (1)–(3) of Li et
//! al. (2019):
//! - g(x) = κₙ A xⁿ, d = κₙ A aⁿ, F = 2n/(n+1) E* d a,
//! - p(r) = (E*/π) κₙ n A ∫ᵣᵃ x^(n−1)/√(x²−r²) dx, w(r) = (2/π) ∫₀^min(r,a) (d − g)/√(r²−x²) dx.
//!
//! For integer n both integrals have closed forms by I_m = [a^(m−1) √(a²−r²) + (m−1) r² I_(m−2)]/m from
//! I₀ = acosh(a/r), I₁ = √(a²−r²), and its mirror image for w; for other n they are integrated numerically after
//! x = r cosh v, x = r sin φ. At r = 0 the pressure is finite for n > 1 and truly infinite for n ≤ 1. At r = a it is 0.

use super::elementary::{acosh_ratio, kappa, leg, positive_part};
use super::quadrature::integrate;
use std::f64::consts::{FRAC_PI_2, PI};

/// A rigid indenter f(r) = A rⁿ with its tip at r = 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLaw {
    /// A > 0, in m^(1−n).
    pub coefficient: f64,
    /// n > 0, dimensionless.
    pub exponent: f64,
}

impl PowerLaw {
    /// f = r²/(2R); radius of curvature R in m.
    pub fn paraboloid(radius: f64) -> Self {
        Self {
            coefficient: 0.5 / radius,
            exponent: 2.0,
        }
    }

    /// f = r tan θ; the slope tan θ is dimensionless.
    pub fn cone(slope: f64) -> Self {
        Self {
            coefficient: slope,
            exponent: 1.0,
        }
    }

    /// f = A r⁴; A in m⁻³.
    pub fn quartic(coefficient: f64) -> Self {
        Self {
            coefficient,
            exponent: 4.0,
        }
    }

    /// κₙ of this exponent, dimensionless (see [`kappa`]).
    pub fn kappa(&self) -> f64 {
        kappa(self.exponent)
    }

    /// f(r) = A rⁿ, m, for r ≥ 0 in m.
    pub fn profile(&self, r: f64) -> f64 {
        self.coefficient * r.powf(self.exponent)
    }

    /// g(x) = κₙ A |x|ⁿ, m: Eq. (1) of f.
    pub fn mdr_profile(&self, x: f64) -> f64 {
        self.kappa() * self.profile(x.abs())
    }

    /// d = g(a), m, for a contact radius a ≥ 0 in m.
    pub fn depth(&self, contact_radius: f64) -> f64 {
        self.mdr_profile(contact_radius)
    }

    /// a = (d/(κₙ A))^(1/n), m; 0 for d ≤ 0 (no contact).
    pub fn contact_radius(&self, depth: f64) -> f64 {
        let ratio = depth / (self.kappa() * self.coefficient);
        if ratio <= 0.0 {
            0.0
        } else if self.exponent == 2.0 {
            ratio.sqrt()
        } else {
            ratio.powf(1.0 / self.exponent)
        }
    }

    /// F = 2n/(n+1) E* d a, N, for E* in Pa and the depth d in m; 0 for d ≤ 0.
    pub fn force(&self, e_star: f64, depth: f64) -> f64 {
        let n = self.exponent;
        2.0 * n / (n + 1.0) * e_star * positive_part(depth) * self.contact_radius(depth)
    }

    /// p(r), Pa, by (3) at contact radius a; 0 for r ≥ a, +∞ at r = 0 for n ≤ 1.
    ///
    /// Paraboloid (2E*/πR)√(a²−r²); cone ½E* tan θ acosh(a/r); quartic
    /// (32/3π) A E* (s³/3 + r²s), s = √(a²−r²).
    pub fn pressure(&self, e_star: f64, contact_radius: f64, r: f64) -> f64 {
        let (n, a) = (self.exponent, contact_radius);
        if r >= a {
            return 0.0;
        }
        let factor = e_star / PI * self.kappa() * n * self.coefficient;
        factor * pressure_integral(n - 1.0, a, r)
    }

    /// w(r), m, by (2): the normal displacement of the surface, d − f inside the contact radius a
    /// and falling off as F/(πE*r) outside.
    ///
    /// Paraboloid, outside: (1/πR)[(2a²−r²) asin(a/r) + a√(r²−a²)].
    pub fn displacement(&self, contact_radius: f64, r: f64) -> f64 {
        let (n, a) = (self.exponent, contact_radius);
        let depth = self.depth(a);
        if r <= a {
            return depth - self.profile(r);
        }
        if a <= 0.0 {
            return 0.0;
        }
        // d asin(a/r) − κA ∫₀ᵃ xⁿ/√(r²−x²) dx. Far away the two terms agree to all digits but (a/r)³ of them, so the
        // difference itself is integrated there.
        if n.fract() == 0.0 && n <= 64.0 && r < 4.0 * a {
            let integral = displacement_integral(n, a, r);
            2.0 / PI * (depth * (a / r).asin() - self.kappa() * self.coefficient * integral)
        } else {
            let integrand = |t: f64| depth - self.mdr_profile(r * t.sin());
            2.0 / PI * integrate(integrand, 0.0, (a / r).asin())
        }
    }
}

/// I_m = ∫ᵣᵃ x^m/√(x²−r²) dx for m > −1, 0 ≤ r < a; unit m^m.
///
/// In closed form for integer m, else by quadrature; +∞ at r = 0 for m ≤ 0.
pub fn pressure_integral(m: f64, a: f64, r: f64) -> f64 {
    if r == 0.0 {
        return if m > 0.0 {
            a.powf(m) / m
        } else {
            f64::INFINITY
        };
    }
    if m < 0.0 || m.fract() != 0.0 || m > 64.0 {
        return integrate(|v| (r * v.cosh()).powf(m), 0.0, acosh_ratio(a, r));
    }
    let s = leg(a, r);
    let (mut value, mut k) = if m % 2.0 == 0.0 {
        (acosh_ratio(a, r), 0.0)
    } else {
        (s, 1.0)
    };
    while k < m {
        k += 2.0;
        value = (a.powf(k - 1.0) * s + (k - 1.0) * r * r * value) / k;
    }
    value
}

/// J_m = ∫₀ᵃ x^m/√(r²−x²) dx for m > −1, 0 ≤ a ≤ r; unit m^m.
///
/// In closed form for integer m, else by quadrature.
pub fn displacement_integral(m: f64, a: f64, r: f64) -> f64 {
    let angle = if r > 0.0 { (a / r).asin() } else { FRAC_PI_2 };
    if m < 0.0 || m.fract() != 0.0 || m > 64.0 {
        return integrate(|t| (r * t.sin()).powf(m), 0.0, angle);
    }
    let s = leg(r, a);
    let (mut value, mut k) = if m % 2.0 == 0.0 {
        (angle, 0.0)
    } else {
        (a * a / (r + s).max(f64::MIN_POSITIVE), 1.0)
    };
    while k < m {
        k += 2.0;
        value = ((k - 1.0) * r * r * value - a.powf(k - 1.0) * s) / k;
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    const E: f64 = 2.3e11;
    const A: f64 = 1.3e-4;

    fn shapes() -> Vec<PowerLaw> {
        let mut shapes = vec![
            PowerLaw::paraboloid(0.01),
            PowerLaw::cone(0.02),
            PowerLaw::quartic(3e9),
        ];
        for (coefficient, exponent) in [(1.0, 1.5), (40.0, 2.5), (9e5, 3.0), (1e12, 5.0)] {
            shapes.push(PowerLaw {
                coefficient,
                exponent,
            });
        }
        shapes
    }

    fn close(value: f64, exact: f64, relative: f64, what: &str) {
        let error = (value - exact).abs();
        assert!(
            error <= relative * exact.abs(),
            "{what}: {value:e} against {exact:e}"
        );
    }

    #[test]
    fn instances_are_the_textbook_ones() {
        let (a, r) = (A, 0.37 * A);
        let s = (a * a - r * r).sqrt();
        let hertz = PowerLaw::paraboloid(0.01);
        close(hertz.mdr_profile(-a), a * a / 0.01, 1e-15, "g = x²/R");
        close(hertz.contact_radius(a * a / 0.01), a, 1e-15, "a² = Rd");
        let force = 4.0 / 3.0 * E * a.powi(3) / 0.01;
        close(hertz.force(E, a * a / 0.01), force, 1e-14, "F");
        close(
            hertz.pressure(E, a, r),
            2.0 * E / (PI * 0.01) * s,
            1e-14,
            "p",
        );
        close(
            hertz.pressure(E, a, 0.0),
            1.5 * force / (PI * a * a),
            1e-14,
            "p0 = 3F/2πa²",
        );
        let cone = PowerLaw::cone(0.02);
        close(
            cone.force(E, cone.depth(a)),
            0.5 * PI * a * a * E * 0.02,
            1e-14,
            "F cone",
        );
        close(
            cone.pressure(E, a, r),
            0.5 * E * 0.02 * (a / r).acosh(),
            1e-13,
            "p cone",
        );
        let quartic = PowerLaw::quartic(3e9);
        let p = 32.0 / (3.0 * PI) * 3e9 * E * (s.powi(3) / 3.0 + r * r * s);
        close(quartic.pressure(E, a, r), p, 1e-13, "p quartic");
        let outside = 1.7 * a;
        let w = ((2.0 * a * a - outside * outside) * (a / outside).asin()
            + a * (outside * outside - a * a).sqrt())
            / (PI * 0.01);
        close(hertz.displacement(a, outside), w, 1e-13, "w outside");
    }

    #[test]
    fn mdr_profile_is_equation_1() {
        for shape in shapes() {
            let x = 0.8 * A;
            let n = shape.exponent;
            let slope = |r: f64| n * shape.coefficient * r.powf(n - 1.0);
            let g = x * integrate(|t| slope(x * t.sin()), 0.0, FRAC_PI_2);
            close(shape.mdr_profile(x), g, 1e-11, "g");
        }
    }

    #[test]
    fn pressure_is_equation_3_and_balances_the_force() {
        for shape in shapes() {
            let n = shape.exponent;
            let slope = |x: f64| shape.kappa() * n * shape.coefficient * x.powf(n - 1.0);
            for r in [1e-3 * A, 0.2 * A, 0.7 * A, 0.999 * A] {
                // x = √(r²+t²) after t = r tan φ: dx/√(x²−r²) = dφ/cos φ.
                let edge = ((A * A - r * r).sqrt()).atan2(r);
                let p = E / PI * integrate(|t| slope(r / t.cos()) / t.cos(), 0.0, edge);
                close(shape.pressure(E, A, r), p, 1e-11, "p");
            }
            let ring = |t: f64| {
                let r = A * t.sin();
                2.0 * PI * r * shape.pressure(E, A, r) * A * t.cos()
            };
            let force = integrate(ring, 0.0, FRAC_PI_2);
            close(
                shape.force(E, shape.depth(A)),
                force,
                1e-10,
                "force balance",
            );
        }
    }

    #[test]
    fn displacement_is_equation_2_inside_and_outside() {
        for shape in shapes() {
            let d = shape.depth(A);
            for r in [0.3 * A, A, 1.0001 * A, 1.5 * A, 3.9 * A, 4.1 * A, 300.0 * A] {
                let end = (A / r).min(1.0).asin();
                let w = integrate(|t| d - shape.mdr_profile(r * t.sin()), 0.0, end) * 2.0 / PI;
                close(shape.displacement(A, r), w, 3e-11, "w");
            }
            let far = 1e6 * A;
            let point_load = shape.force(E, d) / (PI * E * far);
            close(
                shape.displacement(A, far),
                point_load,
                1e-9,
                "far field F/(πE*r)",
            );
        }
    }

    #[test]
    fn depth_and_radius_invert_each_other_from_picometres_to_metres() {
        for shape in shapes() {
            for d in [1e-12, 1e-6, 1.0] {
                close(shape.depth(shape.contact_radius(d)), d, 1e-13, "d(a(d))");
            }
            assert_eq!(shape.contact_radius(-1.0), 0.0);
            assert_eq!(shape.force(E, -1.0), 0.0);
        }
    }

    #[test]
    fn limits_on_the_axis_and_at_the_edge() {
        for shape in shapes() {
            assert_eq!(shape.pressure(E, A, A), 0.0);
            assert_eq!(shape.pressure(E, 0.0, 0.0), 0.0);
            let axis = shape.pressure(E, A, 0.0);
            if shape.exponent > 1.0 {
                close(
                    shape.pressure(E, A, 1e-13 * A),
                    axis,
                    1e-6,
                    "p near the axis",
                );
            } else {
                assert_eq!(axis, f64::INFINITY);
            }
        }
        assert_eq!(displacement_integral(1.0, 0.0, 0.0), 0.0);
        assert_eq!(displacement_integral(0.0, 0.0, 0.0), FRAC_PI_2);
    }
}

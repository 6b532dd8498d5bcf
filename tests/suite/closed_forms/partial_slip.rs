//! Partial slip at fixed depth for any one-dimensional profile g(x).
//!
//! Sources: Cattaneo (1938), Mindlin (1949); Jäger (1995) and Ciavarella (1998) for any shape; Popov
//! & Heß (2015), ch. 5 for the springs. With λ = μE*/G* = 1/κ, the
//! spring at x carries G*u and slips at u = y(x) = λ(d − g(x)):
//! - stick edge g(c) = d − κU, gross slip from U_s = λd;
//! - F_x(U) = 2G*∫₀ᵃ min(U, y) dx = μ[F_z(a) − F_z(c)];
//! - slip of the surface by (2): s(r) = (2/π)∫₀ʳ (U − min(U, y))/√(r²−x²) dx;
//! - energy of a steady-state cycle: 8G*∫ y(U − y) dx over the springs with y < U, which is
//!   (8μ²E*²/G*)∫_cᵃ (d−g)(g−g(c)) dx in partial slip.
//!
//! All by adaptive quadrature; g must rise from g(0) ≥ 0 to g(a) = d without falling.

use super::elementary::{bisect, positive_part};
use super::quadrature::integrate;
use std::f64::consts::{FRAC_PI_2, PI};

/// G*/E* = 2(1−ν)/(2−ν), dimensionless: rigid on elastic, or two similar bodies (Mindlin 1949).
pub fn stiffness_ratio(poisson: f64) -> f64 {
    2.0 * (1.0 - poisson) / (2.0 - poisson)
}

/// A contact with one-dimensional profile g(x), held at depth d, moved sideways by U.
#[derive(Clone, Copy, Debug)]
pub struct PartialSlip<G> {
    /// E*, Pa.
    pub e_star: f64,
    /// G*, Pa.
    pub g_star: f64,
    /// μ ≥ 0, dimensionless.
    pub mu: f64,
    /// d, m.
    pub depth: f64,
    /// a, m: where g(a) = d.
    pub contact_radius: f64,
    /// U ≥ 0, m.
    pub amplitude: f64,
    /// g(x), m, for 0 ≤ x ≤ a in m.
    pub mdr_profile: G,
}

impl<G: Fn(f64) -> f64> PartialSlip<G> {
    /// y(x) = (μE*/G*)(d − g(x)), m: the displacement at which the spring at x slips; 0 outside.
    pub fn yield_displacement(&self, x: f64) -> f64 {
        if x > self.contact_radius {
            return 0.0;
        }
        self.mu * self.e_star / self.g_star * positive_part(self.depth - (self.mdr_profile)(x))
    }

    /// U_s = μE*(d − g(0))/G*, m: the whole contact slips from here on.
    pub fn gross_slip_displacement(&self) -> f64 {
        self.yield_displacement(0.0)
    }

    /// c, m: the root of y(c) = U by bisection to machine precision; a for U = 0, 0 for U ≥ U_s.
    pub fn stick_radius(&self) -> f64 {
        if self.amplitude == 0.0 {
            return self.contact_radius;
        }
        if self.amplitude >= self.gross_slip_displacement() {
            return 0.0;
        }
        let sticks = |x: f64| self.yield_displacement(x) >= self.amplitude;
        bisect(0.0, self.contact_radius, sticks)
    }

    /// q_x(x) = G* min(U, y(x)), N/m, at the end of the first loading.
    pub fn tangential_line_load(&self, x: f64) -> f64 {
        self.g_star * self.yield_displacement(x.abs()).min(self.amplitude)
    }

    /// F_z = 2E*∫₀ᵃ (d − g) dx, N.
    pub fn normal_force(&self) -> f64 {
        let load = |x: f64| self.depth - (self.mdr_profile)(x);
        2.0 * self.e_star * integrate(load, 0.0, self.contact_radius)
    }

    /// F_x(U), N, at the end of the first loading.
    pub fn tangential_force(&self) -> f64 {
        let (c, a) = (self.stick_radius(), self.contact_radius);
        let slipping = integrate(|x| self.yield_displacement(x), c, a);
        2.0 * self.g_star * (self.amplitude * c + slipping)
    }

    /// s(r), m, at the end of the first loading: 0 for r ≤ c, NaN for r > a.
    pub fn slip(&self, r: f64) -> f64 {
        let c = self.stick_radius();
        if r > self.contact_radius {
            return f64::NAN;
        }
        if c > 0.0 && r <= c {
            return 0.0;
        }
        let start = if c > 0.0 { (c / r).asin() } else { 0.0 };
        let lag = |t: f64| self.amplitude - self.yield_displacement(r * t.sin());
        2.0 / PI * integrate(lag, start, FRAC_PI_2)
    }

    /// E_d, J: energy of a steady-state cycle −U … U.
    pub fn energy_per_cycle(&self) -> f64 {
        let loss = |x: f64| {
            let y = self.yield_displacement(x);
            y * (self.amplitude - y)
        };
        8.0 * self.g_star * integrate(loss, self.stick_radius(), self.contact_radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cone, which has closed forms for everything.
    fn cone(amplitude: f64) -> PartialSlip<impl Fn(f64) -> f64> {
        PartialSlip {
            e_star: 2.0e11,
            g_star: 1.6e11,
            mu: 0.4,
            depth: FRAC_PI_2 * 0.02 * 1e-4,
            contact_radius: 1e-4,
            amplitude,
            mdr_profile: |x: f64| FRAC_PI_2 * 0.02 * x,
        }
    }

    fn close(value: f64, exact: f64, relative: f64, what: &str) {
        let error = (value - exact).abs();
        assert!(
            error <= relative * exact.abs(),
            "{what}: {value:e} against {exact:e}"
        );
    }

    #[test]
    fn a_cone_in_partial_slip() {
        let limit = cone(0.0).gross_slip_displacement();
        let m = 0.3;
        let model = cone(m * limit);
        let (a, c) = (1e-4, (1.0 - m) * 1e-4);
        close(model.stick_radius(), c, 1e-13, "c");
        close(
            model.tangential_line_load(-0.5 * c),
            model.g_star * m * limit,
            1e-15,
            "q_x",
        );
        let force = 0.5 * PI * a * a * 2.0e11 * 0.02;
        close(model.normal_force(), force, 1e-13, "F_z");
        close(
            model.tangential_force(),
            0.4 * force * (1.0 - (1.0 - m).powi(2)),
            1e-13,
            "F_x",
        );
        // y = U_s(1 − x/a): 8G*∫ y(U−y) dx = 8G* a U_s² m³/6.
        let energy = 8.0 * 1.6e11 * a * limit * limit * m.powi(3) / 6.0;
        close(model.energy_per_cycle(), energy, 1e-12, "E_d");
        // s = (2/π)(U_s/a)[√(r²−c²) − c acos(c/r)].
        let r: f64 = 0.9e-4;
        let s = 2.0 / PI * limit / a * ((r * r - c * c).sqrt() - c * (c / r).acos());
        close(model.slip(r), s, 1e-11, "s");
        assert_eq!(model.slip(0.5 * c), 0.0);
        assert!(model.slip(2.0 * a).is_nan());
    }

    #[test]
    fn a_cone_in_gross_slip_and_at_rest() {
        let limit = cone(0.0).gross_slip_displacement();
        let model = cone(1.5 * limit);
        assert_eq!(model.stick_radius(), 0.0);
        close(
            model.tangential_force(),
            0.4 * model.normal_force(),
            1e-13,
            "F_x",
        );
        // ∫ y(U−y) dx = a U_s² (1.5/2 − 1/3).
        let energy = 8.0 * 1.6e11 * 1e-4 * limit * limit * (0.75 - 1.0 / 3.0);
        close(model.energy_per_cycle(), energy, 1e-12, "E_d");
        close(model.slip(0.0), 0.5 * limit, 1e-13, "rigid slip at the tip");
        let rest = cone(0.0);
        assert_eq!(rest.stick_radius(), rest.contact_radius);
        assert_eq!(
            (rest.tangential_force(), rest.energy_per_cycle()),
            (0.0, 0.0)
        );
    }

    #[test]
    fn stiffness_ratio_of_textbook_poissons() {
        assert_eq!(stiffness_ratio(0.0), 1.0);
        assert!((stiffness_ratio(0.5) - 2.0 / 3.0).abs() < 1e-15);
        // 1/E* = (1−ν²)/E and 1/G* = (2−ν)(1+ν)/(2E), E = 1.
        let (nu, e) = (0.3, 1.0);
        let ratio = 2.0 * e / ((2.0 - nu) * (1.0 + nu)) * (1.0 - nu * nu);
        assert!((stiffness_ratio(nu) - ratio).abs() < 1e-15);
    }
}

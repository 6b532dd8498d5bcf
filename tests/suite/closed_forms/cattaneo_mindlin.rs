//! The paraboloid in partial slip at fixed depth: stick radius, force, stress, slip.
//!
//! Sources: Cattaneo (1938), Mindlin (1949); Popov & Heß (2015), ch. 5. This file covers first loading,
//! [`super::fretting_loop`] the loop, its energy and its wear. With κ = G*/(μE*):
//! - c² = R(d − κU), gross slip from U_s = d/κ; F_x = μF_z[1 − (1 − U/U_s)^{3/2}];
//! - τ(r) = μ[p(r; a) − p(r; c)];
//! - s(r) = (μE*/(πG*R))[(r²−2c²) acos(c/r) + c√(r²−c²)] for c < r < a;
//!
//! The differences (a − c, sin y − y cos y, 1 − (1−ε)^{3/2}) are computed without cancellation, so that amplitudes of
//! 1e-9 d and less keep their digits.

use super::elementary::{angle_beyond, leg, positive_part};
use std::f64::consts::PI;

/// A paraboloid r²/(2R) held at depth d and moved sideways with amplitude U.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CattaneoMindlin {
    /// E*, Pa.
    pub e_star: f64,
    /// G*, Pa.
    pub g_star: f64,
    /// μ ≥ 0, dimensionless.
    pub mu: f64,
    /// Radius of curvature R, m.
    pub radius: f64,
    /// d, m; no contact for d ≤ 0.
    pub depth: f64,
    /// U ≥ 0, m.
    pub amplitude: f64,
}

impl CattaneoMindlin {
    /// κ = G*/(μE*), dimensionless; +∞ for μ = 0.
    pub fn kappa(&self) -> f64 {
        self.g_star / (self.mu * self.e_star)
    }

    /// a = √(Rd), m.
    pub fn contact_radius(&self) -> f64 {
        (self.radius * positive_part(self.depth)).sqrt()
    }

    /// U_s = d/κ = μE*d/G*, m: gross slip from here on.
    pub fn gross_slip_displacement(&self) -> f64 {
        self.mu * self.e_star * positive_part(self.depth) / self.g_star
    }

    /// True if no point sticks: U ≥ U_s > 0, or any motion without friction.
    pub fn is_gross_slip(&self) -> bool {
        self.amplitude > 0.0 && self.amplitude >= self.gross_slip_displacement()
    }

    /// c = √(R(d − κU)), m; a for U = 0, and 0 in gross slip.
    pub fn stick_radius(&self) -> f64 {
        self.stick_radius_at(self.amplitude)
    }

    /// c, m, at a displacement of the first loading.
    pub fn stick_radius_at(&self, displacement: f64) -> f64 {
        if displacement == 0.0 {
            return self.contact_radius();
        }
        let left = self.depth - self.kappa() * displacement;
        (self.radius * positive_part(left)).sqrt()
    }

    /// F_z = 4E*a³/(3R), N.
    pub fn normal_force(&self) -> f64 {
        4.0 * self.e_star * self.contact_radius().powi(3) / (3.0 * self.radius)
    }

    /// F_x, N, at displacement u on first loading (odd in u, μF_z from U_s on).
    pub fn first_loading_force(&self, u: f64) -> f64 {
        let (limit, full) = (
            self.gross_slip_displacement(),
            self.mu * self.normal_force(),
        );
        if u.abs() >= limit {
            return if u == 0.0 { 0.0 } else { full * u.signum() };
        }
        // 1 − (1−ε)^{3/2}
        let rise = -(1.5 * (-u.abs() / limit).ln_1p()).exp_m1();
        full * rise * u.signum()
    }

    /// p(r) = (2E*/πR)√(a²−r²), Pa; 0 outside.
    pub fn pressure(&self, r: f64) -> f64 {
        2.0 * self.e_star / (PI * self.radius) * leg(self.contact_radius(), r)
    }

    /// τ(r), Pa, at displacement U of the first loading; μp(r) outside c, 0 outside a.
    pub fn shear_stress(&self, r: f64) -> f64 {
        self.first_loading_shear(self.amplitude, r)
    }

    /// τ(r), Pa, at a displacement u ≥ 0 of the first loading.
    pub fn first_loading_shear(&self, u: f64, r: f64) -> f64 {
        let (a, c) = (self.contact_radius(), self.stick_radius_at(u));
        let factor = 2.0 * self.mu * self.e_star / (PI * self.radius);
        if r >= c {
            return if u == 0.0 { 0.0 } else { factor * leg(a, r) };
        }
        // a² − c² = Rκu, so the friction coefficient cancels.
        2.0 * self.g_star * u / (PI * (leg(a, r) + leg(c, r)))
    }

    /// s(r), m, at displacement U of the first loading: 0 for r ≤ c; in gross
    /// slip U − U_s + μE*r²/(2G*R); NaN for r > a, outside the contact.
    pub fn slip(&self, r: f64) -> f64 {
        let (a, c) = (self.contact_radius(), self.stick_radius());
        let lambda = self.mu * self.e_star / self.g_star;
        if !(0.0..=a).contains(&r) {
            return f64::NAN;
        }
        if self.is_gross_slip() {
            let rigid = self.amplitude - self.gross_slip_displacement();
            return rigid + 0.5 * lambda * r * r / self.radius;
        }
        if r <= c {
            return 0.0;
        }
        // (r²−2c²)θ + c√(r²−c²) = (r²/2)(sin 2θ − 2θ cos 2θ), θ = acos(c/r).
        let y = 2.0 * angle_beyond(c, r);
        lambda * r * r / (2.0 * PI * self.radius) * sine_less_arc(y)
    }
}

/// sin y − y cos y for 0 ≤ y ≤ π; by its series Σ (−1)^{k+1} 2k y^{2k+1}/(2k+1)! for small y.
fn sine_less_arc(y: f64) -> f64 {
    if y > 1.0 {
        return y.sin() - y * y.cos();
    }
    let (mut power, mut sum) = (y, 0.0);
    for k in 1..12u8 {
        let k = 2.0 * f64::from(k);
        power *= -y * y / (k * (k + 1.0));
        sum -= k * power;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::super::fretting_loop::Branch;
    use super::super::partial_slip::PartialSlip;
    use super::*;

    fn model(fraction: f64) -> CattaneoMindlin {
        let rest = CattaneoMindlin {
            e_star: 2.3e11,
            g_star: 1.9e11,
            mu: 0.3,
            radius: 0.01,
            depth: 1e-6,
            amplitude: 0.0,
        };
        let amplitude = fraction * rest.gross_slip_displacement();
        CattaneoMindlin { amplitude, ..rest }
    }

    fn close(value: f64, exact: f64, relative: f64, what: &str) {
        let error = (value - exact).abs();
        assert!(
            error <= relative * exact.abs(),
            "{what}: {value:e} against {exact:e}"
        );
    }

    fn springs(m: CattaneoMindlin) -> PartialSlip<impl Fn(f64) -> f64> {
        PartialSlip {
            e_star: m.e_star,
            g_star: m.g_star,
            mu: m.mu,
            depth: m.depth,
            contact_radius: m.contact_radius(),
            amplitude: m.amplitude,
            mdr_profile: move |x: f64| x * x / m.radius,
        }
    }

    const FRACTIONS: [f64; 6] = [1e-3, 0.1, 0.5, 0.9, 1.0, 1.7];

    #[test]
    fn agrees_with_the_springs_by_quadrature() {
        for m in FRACTIONS.map(model) {
            let s = springs(m);
            let (a, c) = (m.contact_radius(), m.stick_radius());
            assert!((s.stick_radius() - c).abs() < 1e-7 * a, "c {c:e}");
            close(m.normal_force(), s.normal_force(), 1e-13, "F_z");
            close(
                m.first_loading_force(m.amplitude),
                s.tangential_force(),
                1e-12,
                "F_x",
            );
            close(m.energy_per_cycle(), s.energy_per_cycle(), 1e-7, "E_d");
            for r in [0.1, 0.4, 0.8, 1.0].map(|t| c + t * (a - c)) {
                close(m.slip(r), s.slip(r), 1e-8, "s");
            }
        }
    }

    #[test]
    fn tiny_amplitudes_keep_their_digits() {
        let m = model(1e-12);
        let (a, g) = (m.contact_radius(), m.g_star);
        close(
            m.first_loading_force(m.amplitude),
            2.0 * g * a * m.amplitude,
            1e-11,
            "2G*a",
        );
        // (a−c)³ 5a² with a − c = RκU/2a.
        let ring = m.radius * m.kappa() * m.amplitude / (2.0 * a);
        let factor = 16.0 * (m.mu * m.e_star / m.radius).powi(2) / (15.0 * g);
        close(
            m.energy_per_cycle(),
            factor * 5.0 * a * a * ring.powi(3),
            1e-11,
            "E_d ~ U³",
        );
        close(
            m.shear_stress(0.0),
            g * m.amplitude / (PI * a),
            1e-11,
            "a punch's τ",
        );
        for y in [1e-8f64, 1e-4, 1e-2] {
            let cubic = y.powi(3) / 3.0 * (1.0 - y * y / 10.0 + y.powi(4) / 280.0);
            close(sine_less_arc(y), cubic, 1e-13, "y³/3");
        }
        for y in [0.3, 0.999_999, 1.000_001] {
            close(
                sine_less_arc(y),
                f64::sin(y) - y * f64::cos(y),
                1e-13,
                "series",
            );
        }
    }

    #[test]
    fn limits_without_motion_friction_or_contact() {
        let rest = model(0.0);
        let a = rest.contact_radius();
        assert_eq!((rest.stick_radius(), rest.energy_per_cycle()), (a, 0.0));
        assert_eq!(
            (rest.slip(a), rest.shear_stress(a), rest.shear_stress(0.0)),
            (0.0, 0.0, 0.0)
        );
        let smooth = CattaneoMindlin {
            mu: 0.0,
            ..model(0.5)
        };
        assert_eq!(
            (smooth.stick_radius(), smooth.energy_per_cycle()),
            (0.0, 0.0)
        );
        assert_eq!(
            (smooth.slip(0.0), smooth.shear_stress(0.0)),
            (smooth.amplitude, 0.0)
        );
        assert_eq!(smooth.first_loading_force(1.0), 0.0);
        let still = CattaneoMindlin {
            amplitude: 0.0,
            ..smooth
        };
        assert_eq!((still.stick_radius(), still.slip(0.0)), (a, 0.0));
        let lifted = CattaneoMindlin {
            depth: -1e-6,
            ..model(0.5)
        };
        assert_eq!(
            (lifted.normal_force(), lifted.energy_per_cycle()),
            (0.0, 0.0)
        );
        assert_eq!(
            (lifted.wear_per_cycle(1.0, 0.0), lifted.shear_stress(0.0)),
            (0.0, 0.0)
        );
        let gross = model(1.0);
        close(
            gross.slip(a),
            gross.amplitude / 2.0,
            1e-14,
            "U_s − λ d/2 at the edge",
        );
        assert!(gross.slip(1.1 * a).is_nan() && gross.loop_force(Branch::Loading, 1.0).is_nan());
        assert_eq!(gross.wear_per_cycle(1.0, 1.1 * a), 0.0);
    }
}

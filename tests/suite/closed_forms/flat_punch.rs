//! A rigid flat-ended cylinder on an elastic half-space, pressed and pushed sideways.
//!
//! Sources: Boussinesq (1885), Sneddon (1965); Popov & Heß (2015), ch. 3. In one dimension the
//! punch is g = 0 for x < a and infinite beyond, so q = E*d is constant and jumps to 0 at a: by (3)
//! the pressure is singular at the edge, and by (2) w = (2d/π) asin(a/r) outside. Under a
//! tangential displacement every spring reaches its friction limit at the same moment, U_s =
//! μE*d/G*: the punch sticks or slips as a whole.

use super::elementary::{leg, positive_part};
use std::f64::consts::PI;

/// A flat punch at a given depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatPunch {
    /// E*, Pa.
    pub e_star: f64,
    /// G*, Pa.
    pub g_star: f64,
    /// μ, dimensionless.
    pub mu: f64,
    /// a, m: the radius of punch and contact.
    pub radius: f64,
    /// d, m; no contact for d ≤ 0.
    pub depth: f64,
}

impl FlatPunch {
    /// F_z = 2E*ad, N.
    pub fn force(&self) -> f64 {
        2.0 * self.e_star * self.radius * positive_part(self.depth)
    }

    /// p(r) = E*d/(π√(a²−r²)), Pa; +∞ at r = a, 0 outside and without contact.
    pub fn pressure(&self, r: f64) -> f64 {
        if r > self.radius || self.depth <= 0.0 {
            return 0.0;
        }
        self.e_star * self.depth / (PI * leg(self.radius, r))
    }

    /// w(r), m: d under the punch, (2d/π) asin(a/r) outside.
    pub fn displacement(&self, r: f64) -> f64 {
        let depth = positive_part(self.depth);
        if r <= self.radius {
            depth
        } else {
            2.0 * depth / PI * (self.radius / r).asin()
        }
    }

    /// U_s = μE*d/G*, m: the tangential displacement from which the whole punch slips.
    pub fn gross_slip_displacement(&self) -> f64 {
        self.mu * self.e_star * positive_part(self.depth) / self.g_star
    }

    /// F_x(U) on first loading, N: 2G*aU up to μF_z (odd in U).
    pub fn tangential_force(&self, displacement: f64) -> f64 {
        let limit = self.gross_slip_displacement();
        2.0 * self.g_star * self.radius * displacement.clamp(-limit, limit)
    }

    /// τ(r) on first loading, Pa: G*U/(π√(a²−r²)), at most μp(r); +∞ at r = a, 0 outside.
    pub fn shear_stress(&self, displacement: f64, r: f64) -> f64 {
        if r > self.radius || self.depth <= 0.0 || displacement == 0.0 {
            return 0.0;
        }
        let limit = self.gross_slip_displacement();
        if limit == 0.0 {
            return 0.0;
        }
        self.g_star * displacement.clamp(-limit, limit) / (PI * leg(self.radius, r))
    }

    /// E_d of a steady-state cycle of amplitude U ≥ 0, J: 4μF_z(U − U_s), 0 for U ≤ U_s.
    pub fn energy_per_cycle(&self, amplitude: f64) -> f64 {
        let sliding = (amplitude - self.gross_slip_displacement()).max(0.0);
        4.0 * self.mu * self.force() * sliding
    }
}

#[cfg(test)]
mod tests {
    use super::super::quadrature::integrate;
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    const PUNCH: FlatPunch = FlatPunch {
        e_star: 2.3e11,
        g_star: 1.9e11,
        mu: 0.3,
        radius: 1e-4,
        depth: 1e-6,
    };

    fn close(value: f64, exact: f64, relative: f64) {
        let error = (value - exact).abs();
        assert!(
            error <= relative * exact.abs(),
            "{value:e} against {exact:e}"
        );
    }

    #[test]
    fn pressure_and_shear_balance_their_forces() {
        let a = PUNCH.radius;
        let total = |stress: &dyn Fn(f64) -> f64| {
            let ring = |t: f64| 2.0 * PI * a * t.sin() * stress(a * t.sin()) * a * t.cos();
            integrate(ring, 0.0, FRAC_PI_2 - 1e-9)
        };
        close(total(&|r| PUNCH.pressure(r)), PUNCH.force(), 2e-9);
        let u = 0.4 * PUNCH.gross_slip_displacement();
        close(
            total(&|r| PUNCH.shear_stress(u, r)),
            PUNCH.tangential_force(u),
            2e-9,
        );
        close(
            PUNCH.pressure(0.0),
            PUNCH.force() / (2.0 * PI * a * a),
            1e-15,
        );
    }

    #[test]
    fn displacement_is_equation_2() {
        for factor in [1.0, 1.0001, 1.5, 30.0] {
            let r = factor * PUNCH.radius;
            let end = (1.0 / factor).asin();
            let w = 2.0 / PI * integrate(|_| PUNCH.depth, 0.0, end);
            close(PUNCH.displacement(r), w, 1e-13);
        }
        let far = 1e7 * PUNCH.radius;
        close(
            PUNCH.displacement(far),
            PUNCH.force() / (PI * PUNCH.e_star * far),
            1e-12,
        );
    }

    #[test]
    fn it_sticks_whole_or_slips_whole() {
        let limit = PUNCH.gross_slip_displacement();
        close(
            PUNCH.tangential_force(limit),
            PUNCH.mu * PUNCH.force(),
            1e-15,
        );
        close(
            PUNCH.tangential_force(-3.0 * limit),
            -PUNCH.mu * PUNCH.force(),
            1e-15,
        );
        let r = 0.3 * PUNCH.radius;
        close(
            PUNCH.shear_stress(2.0 * limit, r),
            PUNCH.mu * PUNCH.pressure(r),
            1e-14,
        );
        assert_eq!(PUNCH.energy_per_cycle(0.9 * limit), 0.0);
        // The loop is a parallelogram: base 2(U − U_s), height 2μF_z.
        let base = 2.0 * (1.7 - 1.0) * limit;
        let area = base * 2.0 * PUNCH.mu * PUNCH.force();
        close(PUNCH.energy_per_cycle(1.7 * limit), area, 1e-14);
    }

    #[test]
    fn edges_and_lost_contact() {
        assert_eq!(PUNCH.pressure(PUNCH.radius), f64::INFINITY);
        assert_eq!(PUNCH.pressure(1.0), 0.0);
        let lifted = FlatPunch {
            depth: -1e-6,
            ..PUNCH
        };
        assert_eq!((lifted.force(), lifted.pressure(0.0)), (0.0, 0.0));
        assert_eq!(
            (lifted.displacement(0.0), lifted.tangential_force(1.0)),
            (0.0, 0.0)
        );
        let smooth = FlatPunch { mu: 0.0, ..PUNCH };
        assert_eq!(smooth.shear_stress(1.0, PUNCH.radius), 0.0);
        assert_eq!(smooth.energy_per_cycle(1e-6), 0.0);
    }
}

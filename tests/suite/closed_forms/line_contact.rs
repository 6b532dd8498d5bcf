//! A cylinder on a flat, f = r²/2R, in plane strain: Hertz, partial slip, its wear to the limit, gross slip. All loads,
//! works and volumes are per unit length of the line.
//!
//! Flamant's w′ = −(2/πE*) ⨍ p/(x − ξ) dξ for the sum of both surfaces, normal and tangential alike. With
//! m = Q/(μP), c² = a²(1 − m) and s = √(x² − c²):
//!
//! - Hertz: P = πE*a²/4R, p = (E*/2R)√(a² − x²).
//! - Cattaneo: τ = μ[p(x; a) − p(x; c)]; slip from rest (μ/2R)[xs − c² arcosh(x/c)]; friction work of a cycle
//!   (2μ²P²/πE*)[2m − m² + 2(1 − m)ln(1 − m)].
//! - Displacement against a point at the depth ℓ ≫ a: μ[S(a) − S(c)], S(a) = (2P/πE*) ln(2ℓ/a) + a²/4R; gross slip
//!   from μS(a).
//! - Worn to the limit under amplitudes of force: Δf = (1/2R)[a² arcosh(x/c) − xs] on c < x < b, b = c cosh θ,
//!   sinh(2θ)/2θ = a²/c²; V = √(b² − c²)(2b² + c² − 3a²)/3R;
//!   p = (E*/2R)√(c² − x²) + (E*/4R)(a² − c²)/√(c² − x²).
//! - Gross slip: the pressure becomes P/2b; up to a half-width b, V = 2b³/3R − a²b/2R.

use super::elementary::bisect;
use super::fretting_loop::{Branch, masing};
use std::f64::consts::PI;

/// A cylinder under a held load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    /// E*, Pa.
    pub e_star: f64,
    /// R, m.
    pub radius: f64,
    /// μ.
    pub friction: f64,
    /// P, N/m.
    pub load: f64,
}

impl Cylinder {
    /// a, m, unworn.
    pub fn half_width(&self) -> f64 {
        (4.0 * self.load * self.radius / (PI * self.e_star)).sqrt()
    }

    /// p at x for the half-width `a`, Pa.
    pub fn pressure(&self, a: f64, x: f64) -> f64 {
        0.5 * self.e_star / self.radius * (a * a - x * x).max(0.0).sqrt()
    }

    /// c under a tangential force Q from 0 to μP, m.
    pub fn stick_half_width(&self, force: f64) -> f64 {
        self.half_width() * (1.0 - self.share(force)).sqrt()
    }

    /// m = Q/(μP).
    fn share(&self, force: f64) -> f64 {
        force / (self.friction * self.load)
    }

    /// τ on first loading to Q, Pa.
    pub fn shear(&self, force: f64, x: f64) -> f64 {
        let c = self.stick_half_width(force);
        self.friction * (self.pressure(self.half_width(), x) - self.pressure(c, x))
    }

    /// τ at a force (N/m) of the settled loop of an `amplitude` below μP, by Masing's rule; NaN for |Q| beyond it.
    pub fn loop_shear(&self, branch: Branch, [force, amplitude]: [f64; 2], x: f64) -> f64 {
        masing(|force| self.shear(force, x), amplitude, branch, force)
    }

    /// The slip on first loading to Q at x up to a, m.
    pub fn slip(&self, force: f64, x: f64) -> f64 {
        let c = self.stick_half_width(force);
        let x = x.max(c);
        let root = (x * x - c * c).sqrt();
        0.5 * self.friction / self.radius * (x * root - c * c * (x / c).acosh())
    }

    /// E_d per cycle of amplitude Q, J/m.
    pub fn energy_per_cycle(&self, amplitude: f64) -> f64 {
        let m = self.share(amplitude);
        // At m = 1 the last term is 0.
        let log = if m < 1.0 {
            2.0 * (1.0 - m) * (1.0 - m).ln()
        } else {
            0.0
        };
        let scale = 2.0 * (self.friction * self.load).powi(2) / (PI * self.e_star);
        scale * (2.0 * m - m * m + log)
    }

    /// The displacement on first loading to Q against a point at
    /// depth `gauge`, m; with Q = μP it is the onset of gross slip.
    pub fn shift(&self, force: f64, gauge: f64) -> f64 {
        let stuck = |a: f64| {
            let load = PI * self.e_star * a * a / (4.0 * self.radius);
            let far = 2.0 * load / (PI * self.e_star) * (2.0 * gauge / a).ln();
            if a > 0.0 {
                far + 0.25 * a * a / self.radius
            } else {
                0.0
            }
        };
        self.friction * (stuck(self.half_width()) - stuck(self.stick_half_width(force)))
    }

    /// b, m: the end of the scar around a permanent stick zone of half-width c.
    pub fn scar_half_width(&self, c: f64) -> f64 {
        let ratio = (self.half_width() / c).powi(2);
        let theta = bisect(0.0, 20.0, |theta| {
            (2.0 * theta).sinh() < 2.0 * theta * ratio
        });
        c * theta.cosh()
    }

    /// The worn depth in the limit, m.
    pub fn limit_depth(&self, c: f64, x: f64) -> f64 {
        if x <= c || x >= self.scar_half_width(c) {
            return 0.0;
        }
        let a = self.half_width();
        let root = (x * x - c * c).sqrt();
        0.5 / self.radius * (a * a * (x / c).acosh() - x * root)
    }

    /// V in the limit, m³/m.
    pub fn limit_volume(&self, c: f64) -> f64 {
        let (a, b) = (self.half_width(), self.scar_half_width(c));
        (b * b - c * c).sqrt() * (2.0 * b * b + c * c - 3.0 * a * a) / (3.0 * self.radius)
    }

    /// p in the limit at x < c, Pa.
    pub fn limit_pressure(&self, c: f64, x: f64) -> f64 {
        let (a, root) = (self.half_width(), (c * c - x * x).sqrt());
        0.5 * self.e_star / self.radius * (root + 0.5 * (a * a - c * c) / root)
    }

    /// V, m³/m, when gross slip has worn the contact to a half-width b.
    pub fn sliding_volume(&self, b: f64) -> f64 {
        let a = self.half_width();
        (2.0 * b * b / 3.0 - 0.5 * a * a) * b / self.radius
    }
}

#[cfg(test)]
mod tests {
    use super::super::quadrature::integrate;
    use super::*;

    const CYLINDER: Cylinder = Cylinder {
        e_star: 2.0,
        radius: 3.0,
        friction: 0.4,
        load: 0.7,
    };

    /// Checks loads, volumes and work by quadrature of the other closed forms.
    #[test]
    fn the_forms_agree_with_each_other() {
        let a = CYLINDER.half_width();
        let load = 2.0 * integrate(|x| CYLINDER.pressure(a, x), 0.0, a);
        assert!((load / CYLINDER.load - 1.0).abs() < 1e-9, "{load}");
        for m in [0.3, 0.8] {
            let force = m * CYLINDER.friction * CYLINDER.load;
            let c = CYLINDER.stick_half_width(force);
            let carried = 2.0 * integrate(|x| CYLINDER.shear(force, x), 0.0, a);
            assert!((carried / force - 1.0).abs() < 1e-7, "{carried} {force}");
            for branch in [Branch::Unloading, Branch::Reloading] {
                let shear = |x| CYLINDER.loop_shear(branch, [0.4 * force, force], x);
                let carried = 2.0 * integrate(shear, 0.0, a) / force;
                assert!((carried - 0.4).abs() < 1e-6, "{branch:?} {carried}");
            }
            // Each stroke slips by twice what half the force does: 4μp s per cycle.
            let work = |x: f64| {
                let s = CYLINDER.slip(force, x);
                4.0 * CYLINDER.friction * CYLINDER.pressure(a, x) * s
            };
            let work = 2.0 * integrate(work, c, a);
            let energy = CYLINDER.energy_per_cycle(force);
            assert!((work / energy - 1.0).abs() < 1e-7, "{work} {energy}");
            let b = CYLINDER.scar_half_width(c);
            let inside = b * (1.0 - 1e-12);
            let volume = 2.0 * integrate(|x| CYLINDER.limit_depth(c, x), c, inside);
            let exact = CYLINDER.limit_volume(c);
            assert!((volume / exact - 1.0).abs() < 1e-6, "{volume} {exact}");
            let carried = |v: f64| CYLINDER.limit_pressure(c, c * v.sin()) * c * v.cos();
            // Nearer to the border, sin v is 1 and the pressure infinite.
            let carried = 2.0 * integrate(carried, 0.0, 0.5 * PI * (1.0 - 1e-7));
            assert!((carried / CYLINDER.load - 1.0).abs() < 1e-6, "{carried}");
        }
    }
}

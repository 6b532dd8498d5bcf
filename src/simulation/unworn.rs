//! The contact of the unworn indenter, by quadrature of its closed 1D profile: independent of grids, steps and
//! transforms, so that it can check them.
//!
//! # Formulas
//!
//! With λ = μE*/G*, d the depth, and slip beyond the depth d_c of the stick border, g(c) = d_c:
//!
//! ```text
//! F_z(d) = 2E* ∫ (d − g)₊ dx
//! F_x    = μ [F_z(d) − F_z(d_c)],   d_c = d − U/λ under a displacement amplitude U
//! E_d    = 8G* ∫ y (U − y) dx over the springs with y = λ(d − g) < U, in a steady-state cycle
//! ```
//!
//! In a line contact of length L, with dx/(πx) instead of dx and U = Q/(E*L),
//!
//! ```text
//! F_z(d) = L E* d
//! u_x    = μ [s(d) − s(d_c)],   s(d) = (2/π) [d ln(2ℓ/a) + ∫₀ᵃ g dx/x]   against a point at the gauge length ℓ
//! ```
//!
//! C. Cattaneo (1938), R. D. Mindlin and H. Deresiewicz (1953), for any shape M. Ciavarella (1998); by springs
//! V. L. Popov and M. Heß (2015), ch. 5.

use std::f64::consts::FRAC_2_PI;

use super::Setup;
use super::drive::{Control, Drive, Oscillation};
use crate::contact::indenter::Indenter;
use crate::contact::material::Material;
use crate::math::geometry::Geometry;
use crate::math::quadrature::gauss_in_pieces;
use crate::math::root;

/// The parts that determine a contact before wear.
#[derive(Clone, Copy)]
pub struct Unworn<'a> {
    /// Geometry of the contact.
    pub geometry: Geometry,
    /// The unworn shape.
    pub indenter: &'a Indenter,
    /// Moduli and friction.
    pub material: &'a Material,
    /// The motion.
    pub drive: &'a Drive,
}

/// A contact that slips in a ring, under a held normal load.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ring {
    /// a, m.
    pub contact_radius: f64,
    /// c, m; 0 in gross slip.
    pub stick_radius: f64,
    /// The amplitude of F_x, N.
    pub force: f64,
    /// E_d of a steady-state cycle, J.
    pub energy: f64,
}

impl<'a> Unworn<'a> {
    /// Returns the unworn contact of a setup.
    pub fn new(setup: &'a Setup) -> Self {
        Self {
            geometry: setup.geometry,
            indenter: &setup.indenter,
            material: &setup.material,
            drive: &setup.drive,
        }
    }

    /// Returns a, m, where g(a) is the `depth` (m), or the rim.
    pub fn radius(&self, depth: f64) -> f64 {
        let indenter = self.indenter;
        if let Some(rim) = indenter.rim() {
            return if depth > 0.0 { rim } else { 0.0 };
        }
        // f₀ < g₀: the contact reaches no further.
        let end = indenter.radius_at(depth);
        root::first([0.0, end], |x| self.image(x) >= depth)
    }

    /// g₀(x), m.
    fn image(&self, x: f64) -> f64 {
        self.indenter.image(self.geometry, x)
    }

    /// F_z, N, at a `depth` (m).
    pub fn force(&self, depth: f64) -> f64 {
        if let Some(length) = self.geometry.length() {
            return self.material.normal_modulus() * length * depth.max(0.0);
        }
        let gap = |x: f64| (depth - self.image(x)).max(0.0);
        2.0 * self.material.normal_modulus() * gauss_in_pieces([0.0, self.radius(depth)], gap)
    }

    /// F_z over the area of the contact, Pa, at a `depth` (m).
    pub fn mean_pressure(&self, depth: f64) -> f64 {
        let area = self.geometry.area(self.radius(depth));
        self.force(depth) / area.max(f64::MIN_POSITIVE)
    }

    /// Returns the depth, m, that carries a `force` (N); infinite if no depth does.
    pub fn depth(&self, force: f64) -> f64 {
        let modulus = self.material.normal_modulus();
        if let Some(length) = self.geometry.length() {
            return force.max(0.0) / (modulus * length);
        }
        if let Some(radius) = self.indenter.rim() {
            return force / (2.0 * modulus * radius);
        }
        if force <= 0.0 {
            return 0.0;
        }
        // F(a) = 2n/(n+1) E* κₙ f₀(a) a exceeds E* f₀(a) a for every n ≥ 1, and a flat tip adds to it.
        let carries = |&a: &f64| modulus * self.indenter.profile(a) * a >= force;
        let mut radii = std::iter::successors(Some(1e-15), |a| (*a < 1e15).then_some(2.0 * a));
        let deepest = radii.find(carries).map(|a| self.image(a));
        let missing = |depth: f64| self.force(depth) / force - 1.0;
        let depth = deepest.and_then(|end| root::bracketed(missing, 0.0, end, 1e-15 * end));
        depth.unwrap_or(f64::INFINITY)
    }

    /// Returns the deepest indentation of the motion, m.
    pub fn deepest(&self) -> f64 {
        match self.drive.normal() {
            Control::Displacement(depth) => depth.highest(),
            Control::Force(force) => self.depth(force.highest().max(0.0)),
        }
    }

    /// Returns the displacement of a line contact at a `depth` (m) in full sliding against a point at the gauge length,
    /// divided by μ, m; 0 for a round one.
    fn shift_over_friction(&self, depth: f64) -> f64 {
        let gauge = self.drive.gauge_length().unwrap_or_default();
        let edge = self.radius(depth);
        if edge <= 0.0 || !self.geometry.is_line() {
            return 0.0;
        }
        let own = gauss_in_pieces([0.0, edge], |x| self.image(x) / x);
        FRAC_2_PI * (depth * (2.0 * gauge / edge).ln() + own)
    }

    /// Returns the displacement of the actuator, m, under which a held load slips outside the border of the unworn
    /// contact at the depth `border` (m); with `border` = 0 it is the largest without gross slip.
    pub(crate) fn line_shift(&self, depth: f64, border: f64) -> f64 {
        let own = self.shift_over_friction(depth) - self.shift_over_friction(border);
        let in_rig = self.drive.rig_compliance() * (self.force(depth) - self.force(border));
        self.material.friction() * (own + in_rig)
    }

    /// Returns the depth, m, at the stick border of a line contact at a `depth` (m) whose actuator oscillates; in gross
    /// slip negative, the distance that it slides as a whole divided by μ.
    fn line_border(&self, depth: f64, swing: &Oscillation) -> f64 {
        let (friction, amplitude) = (self.material.friction(), swing.amplitude());
        let beyond = |border: f64| self.line_shift(depth, border) / amplitude - 1.0;
        let sliding = amplitude - self.line_shift(depth, 0.0);
        if sliding >= 0.0 {
            return -sliding / friction;
        }
        root::bracketed(beyond, 0.0, depth, 1e-13 * depth).unwrap_or(depth)
    }

    /// Applies Melan's theorem if the motion of the springs is prescribed: returns g at the border of the permanent
    /// stick zone, m, and the radius c of that border on the unworn indenter, m. `None` without such a zone.
    pub(crate) fn melan(&self) -> Option<(f64, f64)> {
        let ratio = self.material.stick_ratio();
        let depth = self.drive.shakedown_depth(ratio);
        let depth = depth.filter(|&depth| depth > 0.0)?;
        Some((depth, self.radius(depth)))
    }

    /// Returns the depth d_c of the stick border, m, at a held `depth` (m) if the actuator moves by `amplitude` (m), of
    /// which the rig takes C F_x.
    fn border_on_rig(&self, depth: f64, amplitude: f64) -> Option<f64> {
        let (friction, compliance) = (self.material.friction(), self.drive.rig_compliance());
        let yields = friction * self.material.normal_modulus() / self.material.tangential_modulus();
        let stiff = depth - amplitude / yields;
        if compliance == 0.0 {
            return Some(stiff);
        }
        let whole = self.force(depth);
        let excess = |border: f64| {
            let force = friction * (whole - self.force(border.max(0.0)));
            (depth - border) * yields + compliance * force - amplitude
        };
        root::bracketed(excess, stiff, depth, 1e-14 * depth)
    }

    /// Returns the contact under a constant normal load; `None` if the load varies, nothing touches, or nothing moves.
    pub(crate) fn ring(&self) -> Option<Ring> {
        let normal = self.drive.normal().oscillation();
        if normal.amplitude() != 0.0 || normal.mean() <= 0.0 {
            return None;
        }
        let depth = self.deepest();
        let friction = self.material.friction();
        let modulus = self.material.tangential_modulus();
        let yields = friction * self.material.normal_modulus() / modulus;
        let swing = self.drive.tangential()?;
        let border = match swing {
            Control::Displacement(shift) if self.geometry.is_line() => {
                self.line_border(depth, shift)
            }
            Control::Displacement(shift) => self.border_on_rig(depth, shift.amplitude())?,
            Control::Force(force) => {
                let left = self.force(depth) - force.amplitude() / friction;
                if left > 0.0 { self.depth(left) } else { 0.0 }
            }
        };
        if !border.is_finite() || swing.oscillation().amplitude() == 0.0 {
            return None;
        }
        let contact_radius = self.radius(depth);
        let stick_radius = if border > 0.0 {
            self.radius(border)
        } else {
            0.0
        };
        // A line slides by the rest, with its full force.
        let (reach, sliding) = match self.geometry {
            Geometry::Round => (yields * (depth - border), 0.0),
            Geometry::Line { .. } => (yields * (depth - border.max(0.0)), -border.min(0.0)),
        };
        let slipping = |x: f64| {
            let limit = yields * (depth - self.image(x)).max(0.0);
            limit * (reach - limit).max(0.0) * self.geometry.measure(x)
        };
        let of_sliding = 4.0 * friction * self.force(depth) * friction * sliding;
        Some(Ring {
            contact_radius,
            stick_radius,
            force: friction * (self.force(depth) - self.force(border.max(0.0))),
            energy: 8.0 * modulus * gauss_in_pieces([stick_radius, contact_radius], slipping)
                + of_sliding,
        })
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn with<T>(indenter: &Indenter, of: impl Fn(Unworn) -> T) -> T {
        let still = Oscillation::new(1.0, 0.0, 1.0, 0.0).expect("a motion");
        of(Unworn {
            geometry: Geometry::Round,
            indenter,
            material: &Material::new(2.3077e11, 0.3, 0.1).expect("a material"),
            drive: &Drive::new(Control::Force(still), None),
        })
    }

    /// Hertz, for R = 10 mm and d = 1 µm.
    const FORCE: f64 = 4.0 / 3.0 * 2.3077e11 * 0.1 * 1e-9;

    fn is_near(found: f64, due: f64, error: f64) {
        assert!((found / due - 1.0).abs() < error, "{found:e} {due:e}");
    }

    #[test]
    fn a_force_finds_the_depth_and_the_radius_of_hertz() {
        let ball = Indenter::paraboloid(0.01).expect("a shape");
        with(&ball, |contact| {
            let depth = contact.depth(FORCE);
            is_near(depth, 1e-6, 1e-12);
            is_near(contact.radius(depth), 1e-4, 1e-12);
            is_near(contact.force(1e-6), FORCE, 1e-12);
            is_near(contact.mean_pressure(1e-6), FORCE / (PI * 1e-8), 1e-12);
        });
    }

    #[test]
    fn every_shape_and_size_carries_its_load() {
        for indenter in [
            Indenter::paraboloid(1e-9),
            Indenter::paraboloid(1e6),
            Indenter::cone(1e-6),
            Indenter::cone(1.5),
            Indenter::power(1e30, 20.0),
            Indenter::power(1e-30, 1.0),
            Indenter::flat_punch(1e-6),
            Indenter::truncated_paraboloid(0.01, 1e-3),
            Indenter::truncated_paraboloid(1e3, 1e-9),
            Indenter::truncated_cone(0.02, 1e-3),
        ] {
            let indenter = indenter.expect("a shape");
            for force in [1e-9, 1.0, 1e6] {
                let depth = with(&indenter, |contact| contact.depth(force));
                let [radius, carried] = with(&indenter, |contact| {
                    [contact.radius(depth), contact.force(depth)]
                });
                // A flat tip of 1 mm carries a nanonewton at a depth too small to change the digits of its radius.
                assert!(
                    depth > 0.0 && radius > 0.0 && (carried / force - 1.0).abs() < 0.02,
                    "{indenter:?} {force}: {depth:e} {radius:e} {carried:e}"
                );
            }
            with(&indenter, |contact| assert_eq!(contact.depth(0.0), 0.0));
        }
    }

    /// F = 2E*(d a − ∫g dx) for both shapes with a flat face.
    #[test]
    fn a_flat_face_sinks_by_its_force_over_its_width() {
        let punch = Indenter::flat_punch(1e-4).expect("a shape");
        with(&punch, |contact| {
            let depth = contact.depth(FORCE);
            is_near(depth, 2e-6 / 3.0, 1e-12);
            assert_eq!(contact.radius(depth), 1e-4);
            is_near(contact.force(depth), FORCE, 1e-12);
        });
        // F = 2E*/(3R) (2a² + b²) √(a² − b²) with b = 1e-4, a = 1.25e-4.
        let tip = Indenter::truncated_paraboloid(0.01, 1e-4).expect("a shape");
        let (a, b) = (1.25e-4f64, 1e-4f64);
        let load = 2.0 * 2.3077e11 / 0.03 * (2.0 * a * a + b * b) * (a * a - b * b).sqrt();
        with(&tip, |contact| {
            let depth = contact.depth(load);
            is_near(contact.radius(depth), a, 2e-3);
            is_near(depth, tip.profile_1d(a), 2e-3);
        });
    }
}

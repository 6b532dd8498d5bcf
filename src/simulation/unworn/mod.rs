//! The contact of the unworn indenter, by its closed 1D profile and quadrature: independent of grids, steps and
//! transforms, so that it can check them. Everything that a closed form says of a scenario comes from here.
//!
//! # Formulas
//!
//! With d the depth and a the contact radius, g(a) = d:
//!
//! ```text
//! F_z(d) = 2E* ∫ (d − g)₊ dx
//! p(r)   = (E*/π) ∫ᵣᵃ g′(x)/√(x² − r²) dx
//! ```
//!
//! In a line contact of length L, F_z(d) = L E* d. [`slip`] moves the contact sideways, [`limit`] wears it to its end.

use std::f64::consts::FRAC_1_PI;

use super::Setup;
use super::drive::{Control, Drive};
use crate::contact::indenter::Indenter;
use crate::contact::material::Material;
use crate::math::geometry::Geometry;
use crate::math::quadrature::gauss_in_pieces;
use crate::math::root;

mod limit;
mod slip;

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
        self.carried(depth, self.radius(depth))
    }

    /// Returns what the springs of a round contact within a radius (m) carry at a `depth` (m), N.
    fn carried(&self, depth: f64, within: f64) -> f64 {
        let gap = |x: f64| (depth - self.image(x)).max(0.0);
        2.0 * self.material.normal_modulus() * gauss_in_pieces([0.0, within], gap)
    }

    /// Returns p(r), Pa, at a `depth` (m) under a whole tip f = A rⁿ; `None` for other shapes.
    pub fn pressure(&self, depth: f64) -> Option<impl Fn(f64) -> f64> {
        let exponent = self.indenter.exponent()?;
        let edge = self.radius(depth);
        // g′ = n g/x, and x = r cosh v; under a paraboloid n g/x² is constant.
        let factor = FRAC_1_PI * self.material.normal_modulus() * exponent;
        let square = self.image(edge) / (edge * edge);
        Some(move |r: f64| {
            let leg = ((edge - r) * (edge + r)).max(0.0).sqrt();
            if leg == 0.0 {
                0.0
            } else if exponent == 2.0 {
                factor * square * leg
            } else if r > 0.0 {
                let slope = |v: f64| self.image(r * v.cosh()) / (r * v.cosh());
                factor * gauss_in_pieces([0.0, (leg / r).asinh()], slope)
            } else if exponent > 1.0 {
                factor * square * edge / (exponent - 1.0)
            } else {
                f64::INFINITY
            }
        })
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
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::super::drive::Oscillation;
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

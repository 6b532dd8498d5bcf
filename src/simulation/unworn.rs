//! The contact of the unworn indenter, by quadrature of its closed 1D profile: independent of
//! grids, steps and transforms, so that these can be checked against it.
//!
//! # Formulas
//!
//! With λ = μE*/G*, d the depth, and slip beyond the depth d_c of the stick border, g(c) = d_c:
//!
//! ```text
//! F_z(d) = 2E* ∫ (d − g)₊ dx
//! F_x    = μ [F_z(d) − F_z(d_c)],   d_c = d − U/λ under a displacement amplitude U
//! E_d    = 8G* ∫ y (U − y) dx over the springs with y = λ(d − g) < U, of a settled cycle
//! ```
//!
//! C. Cattaneo (1938), R. D. Mindlin and H. Deresiewicz (1953), for any shape M. Ciavarella (1998); by springs
//! V. L. Popov and M. Heß (2015), ch. 5.

use std::f64::consts::PI;

use super::Setup;
use super::drive::{Control, Drive};
use crate::contact::indenter::Indenter;
use crate::contact::material::Material;
use crate::math::quadrature::gauss_in_pieces;
use crate::math::root;

/// What makes a contact, before anything is worn.
#[derive(Clone, Copy)]
pub struct Unworn<'a> {
    /// The unworn shape.
    pub indenter: &'a Indenter,
    /// What both bodies are made of.
    pub material: &'a Material,
    /// The motion.
    pub drive: &'a Drive,
}

/// A contact that slips in a ring, under a normal load that is held.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ring {
    /// a, m.
    pub contact_radius: f64,
    /// c, m; 0 in gross slip.
    pub stick_radius: f64,
    /// The amplitude of F_x, N.
    pub force: f64,
    /// E_d of a settled cycle, J.
    pub energy: f64,
}

impl<'a> Unworn<'a> {
    /// The unworn contact of a setup.
    pub fn of(setup: &'a Setup) -> Self {
        Self {
            indenter: &setup.indenter,
            material: &setup.material,
            drive: &setup.drive,
        }
    }

    /// a, m, where g(a) is the `depth` (m), or the rim.
    pub fn radius(&self, depth: f64) -> f64 {
        let indenter = self.indenter;
        if let Some(rim) = indenter.rim() {
            return if depth > 0.0 { rim } else { 0.0 };
        }
        // f₀ < g₀: what touches at all reaches no further.
        let end = indenter.radius_at(depth);
        root::first([0.0, end], |x| indenter.profile_1d(x) >= depth)
    }

    /// F_z, N, at a `depth` (m).
    pub fn force(&self, depth: f64) -> f64 {
        let gap = |x: f64| (depth - self.indenter.profile_1d(x)).max(0.0);
        2.0 * self.material.normal_modulus() * gauss_in_pieces([0.0, self.radius(depth)], gap)
    }

    /// F_z/(π a²), Pa, at a `depth` (m).
    pub fn mean_pressure(&self, depth: f64) -> f64 {
        let area = PI * self.radius(depth).powi(2);
        self.force(depth) / area.max(f64::MIN_POSITIVE)
    }

    /// The depth, m, that carries a `force` (N); infinite where none does.
    pub fn depth(&self, force: f64) -> f64 {
        let modulus = self.material.normal_modulus();
        if let Some(radius) = self.indenter.rim() {
            return force / (2.0 * modulus * radius);
        }
        if force <= 0.0 {
            return 0.0;
        }
        // F(a) = 2n/(n+1) E* κₙ f₀(a) a exceeds E* f₀(a) a for every n ≥ 1, and a flat tip adds to it.
        let carries = |&a: &f64| modulus * self.indenter.profile(a) * a >= force;
        let mut radii = std::iter::successors(Some(1e-15), |a| (*a < 1e15).then_some(2.0 * a));
        let deepest = radii.find(carries).map(|a| self.indenter.profile_1d(a));
        let missing = |depth: f64| self.force(depth) / force - 1.0;
        let depth = deepest.and_then(|end| root::bracketed(missing, 0.0, end, 1e-15 * end));
        depth.unwrap_or(f64::INFINITY)
    }

    /// The deepest indentation of the motion, m.
    pub fn deepest(&self) -> f64 {
        match self.drive.normal() {
            Control::Displacement(depth) => depth.highest(),
            Control::Force(force) => self.depth(force.highest().max(0.0)),
        }
    }

    /// By Melan's theorem, where both displacements are prescribed: g at the border of the permanent stick zone, m, and
    /// the radius c at which the unworn indenter has it, m. `None` without such a zone.
    pub(crate) fn melan(&self) -> Option<(f64, f64)> {
        let ratio = self.material.stick_ratio();
        let depth = self.drive.shakedown_depth(ratio);
        let depth = depth.filter(|&depth| depth > 0.0)?;
        Some((depth, self.radius(depth)))
    }

    /// The depth d_c of the stick border, m, at a held `depth` (m) where the actuator moves by `amplitude` (m): the rig
    /// takes C F_x of it.
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

    /// The contact under a constant normal load; `None` if the load varies, nothing touches, or nothing moves.
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
        let reach = yields * (depth - border);
        let slipping = |x: f64| {
            let limit = yields * (depth - self.indenter.profile_1d(x)).max(0.0);
            limit * (reach - limit).max(0.0)
        };
        Some(Ring {
            contact_radius,
            stick_radius,
            force: friction * (self.force(depth) - self.force(border.max(0.0))),
            energy: 8.0 * modulus * gauss_in_pieces([stick_radius, contact_radius], slipping),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::drive::Oscillation;

    fn with<T>(indenter: &Indenter, of: impl Fn(Unworn) -> T) -> T {
        let still = Oscillation::new(1.0, 0.0, 1.0, 0.0).expect("a motion");
        of(Unworn {
            indenter,
            material: &Material::new(2.3077e11, 0.3, 0.1).expect("a material"),
            drive: &Drive::new(Control::Force(still), None),
        })
    }

    /// Of Hertz, for R = 10 mm and d = 1 µm.
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
                // A flat tip of 1 mm bears a nanonewton at a depth that its radius has no digits for.
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

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

use super::Setup;
use super::drive::Control;
use crate::math::quadrature::gauss_in_pieces;
use crate::math::root;

/// The unworn contact of a setup.
#[derive(Clone, Copy)]
pub struct Unworn<'a>(pub &'a Setup);

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

impl Unworn<'_> {
    /// a, m, where g(a) is the `depth` (m), or the rim.
    pub fn radius(&self, depth: f64) -> f64 {
        let indenter = &self.0.indenter;
        if let Some(rim) = indenter.rim() {
            return if depth > 0.0 { rim } else { 0.0 };
        }
        // f₀ < g₀: what touches at all reaches no further.
        let end = indenter.radius_at(depth);
        root::first([0.0, end], |x| indenter.profile_1d(x) >= depth)
    }

    /// F_z, N, at a `depth` (m).
    pub fn force(&self, depth: f64) -> f64 {
        let gap = |x: f64| (depth - self.0.indenter.profile_1d(x)).max(0.0);
        2.0 * self.0.material.normal_modulus() * gauss_in_pieces([0.0, self.radius(depth)], gap)
    }

    /// The depth, m, that carries a `force` (N).
    pub fn depth(&self, force: f64) -> f64 {
        let mut end = 1e-15;
        while self.force(end) < force && end < 1e15 {
            end *= 2.0;
        }
        root::first([0.0, end], |depth| self.force(depth) >= force)
    }

    /// The deepest indentation of the motion, m.
    pub fn deepest(&self) -> f64 {
        match self.0.drive.normal() {
            Control::Displacement(depth) => depth.highest(),
            Control::Force(force) => self.depth(force.highest().max(0.0)),
        }
    }

    /// By Melan's theorem, where both displacements are prescribed: g at the border of the permanent stick zone, m, and
    /// the radius c at which the unworn indenter has it, m. `None` without such a zone.
    pub(crate) fn melan(&self) -> Option<(f64, f64)> {
        let ratio = self.0.material.stick_ratio();
        let depth = self.0.drive.shakedown_depth(ratio);
        let depth = depth.filter(|&depth| depth > 0.0)?;
        Some((depth, self.radius(depth)))
    }

    /// The contact under a constant normal load; `None` if the load varies, nothing touches, or nothing moves.
    pub(crate) fn ring(&self) -> Option<Ring> {
        let setup = self.0;
        let normal = setup.drive.normal().oscillation();
        if normal.amplitude() != 0.0 || normal.mean() <= 0.0 {
            return None;
        }
        let depth = self.deepest();
        let friction = setup.material.friction();
        let modulus = setup.material.tangential_modulus();
        let yields = friction * setup.material.normal_modulus() / modulus;
        let swing = setup.drive.tangential()?;
        let border = match swing {
            Control::Displacement(shift) => depth - shift.amplitude() / yields,
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
            let limit = yields * (depth - setup.indenter.profile_1d(x)).max(0.0);
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

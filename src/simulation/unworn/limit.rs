//! Where wear ends: the limiting profile around a permanent stick zone, and how far the contact grows until then.
//!
//! # Formulas
//!
//! Inside the stick radius c nothing wears. Outside, wear goes on until the springs touch without load, g = d, which
//! the inverse of Eq. (1) turns into the profile
//!
//! ```text
//! f∞(r) = (2/π) [∫₀ᶜ g dx/√(r² − x²) + d arccos(c/r)]               round
//! f∞(r) = (2/π) [∫₀ᶜ g r dx/(x √(r² − x²)) + d arcosh(r/c)]         line
//! ```
//!
//! as far as that exceeds f₀. V. L. Popov (2014), Appl. Phys. Lett. 104, 191602, for a paraboloid.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

use super::Unworn;
use crate::math::quadrature::gauss_in_pieces;
use crate::math::root;

impl Unworn<'_> {
    /// Returns f∞(r), m, at the largest `depth` (m) of the motion around a permanent `stick` radius (m).
    pub(crate) fn limit(&self, depth: f64, stick: f64, r: f64) -> f64 {
        let unworn = self.indenter.profile(r);
        if r <= stick {
            return unworn;
        }
        // x = r sin φ.
        let (end, is_line) = ((stick / r).asin(), self.geometry.is_line());
        let inside = gauss_in_pieces([0.0, end], |phi| {
            let image = self.image(r * phi.sin());
            if is_line { image / phi.sin() } else { image }
        });
        let outside = if is_line {
            (r / stick).acosh()
        } else {
            FRAC_PI_2 - end
        };
        unworn.max(FRAC_2_PI * (inside + depth * outside))
    }

    /// Returns the depth, m, at which a held normal force and a tangential amplitude U have worn away all that slips.
    /// Within the stick radius c the depth is d = g(c) + U/λ, λ = μE*/G*, and the part outside carries nothing,
    /// F_z = 2E* ∫₀ᶜ (d − g) dx. `None` if that exceeds the depth `most` (m).
    pub(crate) fn settled_depth(&self, most: f64) -> Option<f64> {
        let shift = self.drive.tangential()?.displacement()?;
        let yielding = shift.amplitude() * self.material.stick_ratio();
        let depth = |stick: f64| self.image(stick) + yielding;
        let force = self.drive.normal().oscillation().mean();
        let missing = |stick: f64| self.carried(depth(stick), stick) / force - 1.0;
        let widest = self.indenter.radius_at(most);
        root::bracketed(missing, 0.0, widest, 1e-9 * widest).map(depth)
    }

    /// Returns b/a: how far a cylinder of half-width a (m) wears around a permanent `stick` zone of half-width c (m),
    /// b = c cosh θ, sinh(2θ)/2θ = (a/c)². Other shapes differ little.
    pub(crate) fn settled_width(edge: f64, stick: f64) -> f64 {
        let ratio = (edge / stick).powi(2);
        let grows = |theta: f64| (2.0 * theta).sinh() / (2.0 * theta) / ratio - 1.0;
        let theta = root::bracketed(grows, 1e-6, 4.0, 1e-9).unwrap_or(0.0);
        theta.cosh() * stick / edge
    }
}

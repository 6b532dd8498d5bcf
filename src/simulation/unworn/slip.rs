//! The unworn contact moved sideways: stick borders, gross slip, friction work.
//!
//! # Formulas
//!
//! With λ = μE*/G*, d the depth, and slip beyond the depth d_c of the stick border, g(c) = d_c:
//!
//! ```text
//! F_x = μ [F_z(d) − F_z(d_c)],   d_c = d − U/λ under a displacement amplitude U
//! τ   = μ [p(r; d) − p(r; d_c)]
//! E_d = 8G* ∫ y (U − y) dx over the springs with y = λ(d − g) < U, in a steady-state cycle
//! ```
//!
//! In a line contact of length L, with dx/(πx) instead of dx and U = Q/(E*L),
//!
//! ```text
//! u_x = μ [s(d) − s(d_c)],   s(d) = (2/π) [d ln(2ℓ/a) + ∫₀ᵃ g dx/x]   against a point at the gauge length ℓ
//! ```
//!
//! C. Cattaneo (1938), R. D. Mindlin and H. Deresiewicz (1953), for any shape M. Ciavarella (1998); by springs
//! V. L. Popov and M. Heß (2015), ch. 5; the cycle from the first loading by G. Masing (1926).

use std::f64::consts::FRAC_2_PI;

use super::Unworn;
use crate::math::geometry::Geometry;
use crate::math::quadrature::gauss_in_pieces;
use crate::math::root;
use crate::simulation::drive::Control;

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

impl Unworn<'_> {
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

    /// Returns the displacement, m, from which the whole contact slips at a held `depth` (m): U = d/κ, κ = G*/(μE*), for
    /// any shape; relative to the gauge for a line.
    pub fn gross_slip_shift(&self, depth: f64) -> f64 {
        match self.geometry {
            Geometry::Round => depth / self.material.stick_ratio(),
            Geometry::Line { .. } => self.material.friction() * self.shift_over_friction(depth),
        }
    }

    /// Returns the amplitude of the actuator, m, from which the whole contact slips at a held `depth` (m): a rig takes
    /// μ C F_z of it.
    pub fn gross_slip_amplitude(&self, depth: f64) -> f64 {
        let rig = self.drive.rig_compliance() * self.material.friction();
        self.gross_slip_shift(depth) + rig * self.force(depth)
    }

    /// Returns τ(r), Pa, under a [shape with a pressure](Self::pressure) at a `cycle` of a motion from rest, where the
    /// prescribed displacement (m) or force (N) is `at`. `None` without a closed form: on a rig, under a varying load, in
    /// gross slip.
    pub(crate) fn shear(&self, cycle: f64, at: f64) -> Option<impl Fn(f64) -> f64> {
        let (normal, swing) = (self.drive.normal().oscillation(), self.drive.tangential()?);
        let tangential = swing.oscillation();
        let amplitude = tangential.amplitude();
        let is_centred = tangential.mean() == 0.0 && tangential.phase() == 0.0;
        let from_rest = is_centred && tangential.is_sine();
        if self.drive.has_rig() || normal.amplitude() != 0.0 || !from_rest {
            return None;
        }
        let depth = self.deepest();
        let whole = self.pressure(depth)?;
        self.border(depth, amplitude)
            .filter(|&border| border > 0.0)?;
        // Rounding may pass the turning points.
        let at = at.clamp(-amplitude, amplitude);
        let [(first, load), (second, further)] = masing(cycle, at, amplitude);
        let sticks = self.pressure(self.border(depth, load)?)?;
        let returned = self.pressure(self.border(depth, further)?)?;
        let friction = self.material.friction();
        let slips = move |r, sticks: &dyn Fn(f64) -> f64| friction * (whole(r) - sticks(r));
        Some(move |r| first * slips(r, &sticks) + second * slips(r, &returned))
    }

    /// Returns the displacement of the actuator, m, under which a held load slips outside the border of the unworn
    /// contact at the depth `border` (m).
    fn line_shift(&self, depth: f64, border: f64) -> f64 {
        let own = self.shift_over_friction(depth) - self.shift_over_friction(border);
        let in_rig = self.drive.rig_compliance() * (self.force(depth) - self.force(border));
        self.material.friction() * (own + in_rig)
    }

    /// Returns the depth, m, at the stick border of a line contact at a `depth` (m) whose actuator oscillates; in gross
    /// slip negative, the distance that it slides as a whole divided by μ.
    fn line_border(&self, depth: f64, amplitude: f64) -> f64 {
        let friction = self.material.friction();
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

    /// Returns the depth d_c of the stick border, m, at a held `depth` (m) under this `amplitude` of what is prescribed, m
    /// or N; in gross slip 0 or less.
    fn border(&self, depth: f64, amplitude: f64) -> Option<f64> {
        match self.drive.tangential()? {
            Control::Displacement(_) if self.geometry.is_line() => {
                Some(self.line_border(depth, amplitude))
            }
            Control::Displacement(_) => self.border_on_rig(depth, amplitude),
            Control::Force(_) => {
                let left = self.force(depth) - amplitude / self.material.friction();
                Some(if left > 0.0 { self.depth(left) } else { 0.0 })
            }
        }
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
        let amplitude = self.drive.tangential()?.oscillation().amplitude();
        let border = self.border(depth, amplitude)?;
        if !border.is_finite() || amplitude == 0.0 {
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

/// Masing's rule for a settled cycle of this `amplitude` from rest: the first loading, down, and up again are sums of
/// first loadings, here as factors and loads.
fn masing(cycle: f64, at: f64, amplitude: f64) -> [(f64, f64); 2] {
    match cycle {
        first if first <= 0.25 => [(at.signum(), at.abs()), (0.0, 0.0)],
        later if (0.25..0.75).contains(&later.fract()) => {
            [(1.0, amplitude), (-2.0, 0.5 * (amplitude - at))]
        }
        _ => [(-1.0, amplitude), (2.0, 0.5 * (amplitude + at))],
    }
}

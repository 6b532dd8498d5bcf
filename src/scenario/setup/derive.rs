//! Derives defaults from the rest of a scenario: the domain radius and the references of the power law, found by
//! pressing the unworn indenter, and choices that depend on the transform method.

use crate::math::abel::AbelMethod;
use crate::simulation::drive::Control;
use crate::simulation::{Scheme, Spacing, Unworn};
use crate::wear::References;

/// Under a prescribed force a wearing contact sinks in. If the final depth is unknown, the domain has room for this
/// many times the depth of the unworn contact.
const ROOM_TO_SINK: f64 = 3.0;

/// Margin beyond the depth at which wear ends, for the error of cells and steps.
const BEYOND_SETTLED: f64 = 1.05;

/// Domain of a line contact in half-widths of the unworn one, if nothing wears and if the final size of the scar is
/// unknown. It grows with the contact.
const UNWORN_LINE: f64 = 1.5;
const WORN_LINE: f64 = 2.0;

/// Default grid and scheme: the published methods run as published.
pub fn choices(method: AbelMethod) -> (Spacing, Scheme) {
    if method.traits().is_published {
        (Spacing::Uniform, Scheme::Euler)
    } else {
        (Spacing::Graded, Scheme::Trapezoid)
    }
}

impl Unworn<'_> {
    /// Returns the largest radius that can ever touch, m: the rim, or where f₀ reaches the largest depth. Under a force
    /// there is generally no such bound; then [`ROOM_TO_SINK`] applies, plus the depth (m) `worn` at the start of the
    /// run. `None` if no contact can carry the force.
    pub(super) fn domain_radius(&self, friction_is_constant: bool, worn: f64) -> Option<f64> {
        let start = self.deepest();
        if self.geometry.is_line() {
            return self.line_domain(start, friction_is_constant, worn);
        }
        let depth = match self.drive.normal() {
            Control::Displacement(_) => start,
            Control::Force(force) => {
                let is_steady = friction_is_constant && worn == 0.0 && force.amplitude() == 0.0;
                let end = is_steady
                    .then(|| self.settled_depth(ROOM_TO_SINK * start))
                    .flatten();
                let end = end.map_or(f64::INFINITY, |end| BEYOND_SETTLED * end);
                end.min(ROOM_TO_SINK * start + worn)
            }
        };
        start.is_finite().then(|| self.indenter.radius_at(depth))
    }

    /// Returns the domain radius of a line contact with the depth `start` (m), as far as known before the run: if the
    /// permanent stick zone shrinks, no bound is known.
    fn line_domain(&self, start: f64, friction_is_constant: bool, worn: f64) -> Option<f64> {
        let edge = self.radius(start);
        if self.indenter.rim().is_some() {
            return Some(edge).filter(|&edge| edge > 0.0);
        }
        let melan = self.melan().filter(|_| friction_is_constant);
        let in_edges = match (self.drive.tangential(), melan) {
            (None, _) => UNWORN_LINE,
            (_, Some((_, stick))) if stick > 0.0 => {
                let settled = Self::settled_width(edge, stick);
                (BEYOND_SETTLED * settled).clamp(BEYOND_SETTLED, WORN_LINE)
            }
            _ => WORN_LINE,
        };
        let radius = (in_edges * edge).max(self.indenter.radius_at(worn));
        let room = self.indenter.end().filter(|&end| end > edge);
        let radius = radius.min(room.unwrap_or(f64::INFINITY));
        (radius > 0.0 && radius.is_finite()).then_some(radius)
    }

    /// Returns what the keys of wear laws may follow from: the mean pressure at the mean normal position, μ times that, and
    /// the greatest tangential velocity of the indenter. `None` if no contact can carry the force.
    pub(super) fn references(&self) -> Option<References> {
        // A motion that only touches at its deepest point takes the pressure there.
        let swing = self.drive.normal().oscillation();
        let at = if swing.mean() > 0.0 {
            swing.mean()
        } else {
            swing.highest()
        };
        let depth = match self.drive.normal() {
            Control::Displacement(_) => at,
            Control::Force(_) => Some(self.depth(at)).filter(|depth| depth.is_finite())?,
        };
        // Without friction there is no stress to compare with, so any reference will do.
        let or_one = |value: f64| if value > 0.0 { value } else { 1.0 };
        let pressure = self.mean_pressure(depth);
        let velocity = match self.drive.tangential() {
            None => 0.0,
            Some(Control::Displacement(shift)) => shift.greatest_speed(),
            Some(Control::Force(_)) if self.geometry.is_line() => {
                let motion = self.drive.shift_of_springs();
                motion.map_or(0.0, |motion| motion.greatest_speed())
            }
            Some(Control::Force(force)) => {
                let stiffness = 2.0 * self.material.tangential_modulus() * self.radius(depth);
                force.greatest_speed() / stiffness
            }
        };
        Some(References {
            pressure,
            stress: or_one(self.material.friction()) * pressure,
            slip_rate: or_one(velocity),
        })
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::contact::indenter::Indenter;
    use crate::contact::material::Material;
    use crate::math::geometry::Geometry;
    use crate::simulation::drive::{Drive, Oscillation};

    fn hertz() -> (Indenter, Material, f64) {
        let indenter = Indenter::paraboloid(0.01).expect("a shape");
        let material = Material::new(2.3077e11, 0.3, 0.1).expect("a material");
        (indenter, material, 4.0 / 3.0 * 2.3077e11 * 0.1 * 1e-9)
    }

    #[test]
    fn a_held_force_sinks_in_until_nothing_slips() {
        let (indenter, material, force) = hertz();
        let swing = Oscillation::new(0.0, 5e-8, 1.0, 0.0).expect("a motion");
        let held = Oscillation::new(force, 0.0, 1.0, 0.0).expect("a force");
        let drive = Drive::new(Control::Force(held), Some(Control::Displacement(swing)));
        let contact = Unworn {
            geometry: Geometry::Round,
            indenter: &indenter,
            material: &material,
            drive: &drive,
        };
        let depth = contact.settled_depth(ROOM_TO_SINK * 1e-6).expect("a depth");
        // (2/3) c³/R + (U/λ) c = F_z/(2E*), d = c²/R + U/λ.
        let yielding = 5e-8 * material.stick_ratio();
        let c = ((depth - yielding) * 0.01).sqrt();
        let borne = 2.0 / 3.0 * c * c * c / 0.01 + yielding * c;
        assert!((borne * 2.0 * 2.3077e11 / force - 1.0).abs() < 1e-6);
        assert!(depth > 1e-6 && depth < 3e-6, "{depth:e}");
        let domain = contact.domain_radius(true, 0.0).expect("a domain");
        assert!((domain / (0.02 * BEYOND_SETTLED * depth).sqrt() - 1.0).abs() < 1e-9);
        // If friction changes, there is no such limit.
        let domain = contact.domain_radius(false, 0.0).expect("a domain");
        assert!((domain / (0.02 * ROOM_TO_SINK * 1e-6_f64).sqrt() - 1.0).abs() < 1e-9);
    }

    #[test]
    fn references_follow_pressure_and_velocity() {
        let (indenter, material, force) = hertz();
        let swing =
            |mean, amplitude| Oscillation::new(mean, amplitude, 100.0, 0.0).expect("a motion");
        let normal = Control::Displacement(swing(1e-6, 0.0));
        let tangential = Some(Control::Displacement(swing(0.0, 1e-7)));
        let references = |drive: &Drive| {
            let (indenter, material) = (&indenter, &material);
            let contact = Unworn {
                geometry: Geometry::Round,
                indenter,
                material,
                drive,
            };
            contact.references()
        };
        let moving = Drive::new(normal.clone(), tangential);
        let found = references(&moving).expect("references");
        assert!((found.stress / (0.1 * force / (PI * 1e-8)) - 1.0).abs() < 1e-9);
        assert!((found.slip_rate / 1e-5 - 1.0).abs() < 1e-12);
        let still = Drive::new(normal, None);
        assert_eq!(references(&still).map(|found| found.slip_rate), Some(1.0));
    }
}

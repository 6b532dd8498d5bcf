//! Defaults derived from the rest of a scenario: the domain radius and the references of the power
//! law, found by pressing the unworn indenter, and choices that depend on the transform method.

use std::f64::consts::PI;

use crate::contact::foundation::WinklerFoundation;
use crate::contact::indenter::Indenter;
use crate::contact::material::Material;
use crate::contact::normal;
use crate::math::abel::AbelMethod;
use crate::math::abel::field::Field;
use crate::math::grid::RadialGrid;
use crate::math::quadrature::gauss_in_pieces;
use crate::math::root;
use crate::simulation::drive::{Control, Drive};
use crate::simulation::{Scheme, Spacing};

/// Cells of the grid on which the unworn contact is solved: 1e-4 of the depth is more than enough.
const CELLS: usize = 200;

/// Under a prescribed force a wearing contact sinks in; where nobody knows how far, the domain has room
/// for this many times the depth of the unworn one.
const ROOM_TO_SINK: f64 = 3.0;

/// Room beyond the depth at which wear ends, for what cells and steps err by.
const BEYOND_SETTLED: f64 = 1.05;

/// The contact of the unworn indenter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pressed {
    /// d, m.
    pub depth: f64,
    /// a, m.
    pub radius: f64,
    /// F_z, N.
    pub force: f64,
}

impl Pressed {
    /// Where a motion presses the unworn indenter deepest; `None` where it never touches.
    pub fn of(indenter: &Indenter, material: &Material, drive: &Drive) -> Option<Self> {
        let highest = drive.normal().oscillation().highest();
        let contact = Contact {
            indenter,
            material,
            drive,
        };
        (highest > 0.0).then(|| contact.pressed(highest))?
    }

    /// F_z/(π a²), Pa.
    pub fn mean_pressure(&self) -> f64 {
        self.force / (PI * self.radius * self.radius)
    }
}

/// Grid and scheme where the scenario gives none: the published methods run as they were published.
pub(super) fn choices(method: AbelMethod) -> (Spacing, Scheme) {
    match method {
        AbelMethod::Product => (Spacing::Graded, Scheme::Trapezoid),
        AbelMethod::Benad | AbelMethod::A | AbelMethod::B | AbelMethod::APlusB => {
            (Spacing::Uniform, Scheme::Euler)
        }
    }
}

/// What makes a contact, before anything is worn.
#[derive(Clone, Copy)]
pub(super) struct Contact<'a> {
    pub indenter: &'a Indenter,
    pub material: &'a Material,
    pub drive: &'a Drive,
}

impl Contact<'_> {
    /// The contact where the normal motion is at this depth, m, or force, N.
    fn pressed(&self, at: f64) -> Option<Pressed> {
        match self.drive.normal() {
            Control::Displacement(_) => self.press(self.indenter.radius_at(at), |_, _, _| Some(at)),
            Control::Force(_) => self.press_by(at),
        }
    }

    /// The largest radius that can ever touch, m: the rim, or where f₀ reaches the largest depth. Under a
    /// force that has no bound in general: [`ROOM_TO_SINK`] is used instead, added to the depth (m) that is `worn` when the
    /// run begins.
    pub(super) fn domain_radius(&self, friction_is_constant: bool, worn: f64) -> Option<f64> {
        if let Some(rim) = self.indenter.rim() {
            return Some(rim);
        }
        let depth = match self.drive.normal() {
            Control::Displacement(depth) => depth.highest(),
            Control::Force(force) => {
                let start = self.press_by(force.highest())?.depth;
                let starts_unworn = worn == 0.0;
                let end = (friction_is_constant && starts_unworn && force.amplitude() == 0.0)
                    .then(|| self.settled_depth(start));
                let end = end.flatten().map(|end| BEYOND_SETTLED * end);
                end.unwrap_or(f64::INFINITY)
                    .min(ROOM_TO_SINK * start + worn)
            }
        };
        Some(self.indenter.radius_at(depth))
    }

    /// The depth, m, at which a held normal force and a tangential amplitude U have worn all that slips: within
    /// the stick radius c the depth is d = g(c) + U/λ, λ = μE*/G*, and what lies outside bears nothing,
    /// F_z = 2E* ∫₀ᶜ (d − g) dx. None if it is beyond [`ROOM_TO_SINK`] times the depth at the `start` (m).
    fn settled_depth(&self, start: f64) -> Option<f64> {
        let Control::Displacement(shift) = self.drive.tangential()? else {
            return None;
        };
        let yielding = shift.amplitude() * self.material.stick_ratio();
        let profile = |x: f64| self.indenter.profile_1d(x);
        let borne = |c: f64| {
            let depth = profile(c) + yielding;
            2.0 * self.material.normal_modulus() * gauss_in_pieces([0.0, c], |x| depth - profile(x))
        };
        let force = self.drive.normal().oscillation().mean();
        let widest = self.indenter.radius_at(ROOM_TO_SINK * start);
        let radius = root::bracketed(|c| borne(c) / force - 1.0, 0.0, widest, 1e-9 * widest)?;
        Some(profile(radius) + yielding)
    }

    /// τ_ref, Pa, and v_ref, m/s, of the power law where the scenario gives none: μ times the mean
    /// pressure at the mean normal position, and the greatest tangential velocity of the self.indenter.
    pub(super) fn references(&self) -> Option<(f64, f64)> {
        // A motion that only touches at its deepest has its pressure there.
        let swing = self.drive.normal().oscillation();
        let at = if swing.mean() > 0.0 {
            swing.mean()
        } else {
            swing.highest()
        };
        let pressed = self.pressed(at)?;
        // Without friction there is no stress to compare with, and any reference does.
        let or_one = |value: f64| if value > 0.0 { value } else { 1.0 };
        let stress = or_one(self.material.friction()) * pressed.mean_pressure();
        let velocity = match self.drive.tangential() {
            None => 0.0,
            Some(Control::Displacement(shift)) => shift.greatest_speed(),
            Some(Control::Force(force)) => {
                let stiffness = 2.0 * self.material.tangential_modulus() * pressed.radius;
                force.greatest_speed() / stiffness
            }
        };
        Some((stress, or_one(velocity)))
    }

    /// Presses by a force, N, on a domain just wide enough to carry it.
    fn press_by(&self, force: f64) -> Option<Pressed> {
        let modulus = self.material.normal_modulus();
        if let Some(radius) = self.indenter.rim() {
            let depth = force / (2.0 * modulus * radius);
            return Some(Pressed {
                depth,
                radius,
                force,
            });
        }
        // F(a) = 2n/(n+1) E* κₙ f₀(a) a exceeds E* f₀(a) a for every n ≥ 1, and a flat tip adds to it.
        let radius = std::iter::successors(Some(1e-15), |radius| Some(radius * 1.25))
            .take_while(|radius| *radius < 1e15)
            .find(|&radius| modulus * self.indenter.profile(radius) * radius >= force)?;
        let pressed = self.press(radius, |foundation, g, load| {
            let deepest = g.last().copied()?;
            normal::depth_for_load(foundation, g, force, modulus, deepest, load)
        })?;
        Some(Pressed { force, ..pressed })
    }

    /// Presses to the depth (m) that `depth` finds for the 1D image of the unworn profile on a grid out to `radius`, m.
    fn press(
        &self,
        radius: f64,
        depth: impl Fn(&WinklerFoundation, &[f64], &mut Field) -> Option<f64>,
    ) -> Option<Pressed> {
        let grid = RadialGrid::uniform(CELLS, radius).ok()?;
        let image = |&x: &f64| self.indenter.profile_1d(x);
        let g: Vec<f64> = grid.nodes().iter().map(image).collect();
        let mut load = Field::zeros(grid.len());
        let foundation = WinklerFoundation::new(&grid);
        let depth = depth(&foundation, &g, &mut load)?;
        let modulus = self.material.normal_modulus();
        let contact = normal::press(&foundation, &g, depth, modulus, &mut load);
        Some(Pressed {
            depth,
            radius: contact.radius,
            force: foundation.force(&load, contact),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::drive::Oscillation;

    fn with<T>(indenter: &Indenter, material: &Material, of: impl Fn(Contact) -> T) -> T {
        let still = Oscillation::new(1.0, 0.0, 1.0, 0.0).expect("a motion");
        of(Contact {
            indenter,
            material,
            drive: &Drive::new(Control::Force(still), None),
        })
    }

    fn press_by(indenter: &Indenter, material: &Material, force: f64) -> Option<Pressed> {
        with(indenter, material, |contact| contact.press_by(force))
    }

    fn press_to(indenter: &Indenter, material: &Material, depth: f64) -> Option<Pressed> {
        with(indenter, material, |contact| {
            contact.press(indenter.radius_at(depth), |_, _, _| Some(depth))
        })
    }

    fn hertz() -> (Indenter, Material, f64) {
        let indenter = Indenter::paraboloid(0.01).expect("a shape");
        let material = Material::new(2.3077e11, 0.3, 0.1).expect("a material");
        (indenter, material, 4.0 / 3.0 * 2.3077e11 * 0.1 * 1e-9)
    }

    #[test]
    fn a_force_finds_the_depth_and_the_radius_of_hertz() {
        let (indenter, material, force) = hertz();
        let pressed = press_by(&indenter, &material, force).expect("a contact");
        assert!(
            (pressed.depth / 1e-6 - 1.0).abs() < 1e-3,
            "{}",
            pressed.depth
        );
        assert!(
            (pressed.radius / 1e-4 - 1.0).abs() < 1e-3,
            "{}",
            pressed.radius
        );
        let pressed = press_to(&indenter, &material, 1e-6).expect("a contact");
        assert!(
            (pressed.force / force - 1.0).abs() < 1e-3,
            "{}",
            pressed.force
        );
    }

    #[test]
    fn a_held_force_sinks_in_until_nothing_slips() {
        let (indenter, material, force) = hertz();
        let swing = Oscillation::new(0.0, 5e-8, 1.0, 0.0).expect("a motion");
        let held = Oscillation::new(force, 0.0, 1.0, 0.0).expect("a force");
        let drive = Drive::new(Control::Force(held), Some(Control::Displacement(swing)));
        let contact = Contact {
            indenter: &indenter,
            material: &material,
            drive: &drive,
        };
        let depth = contact.settled_depth(1e-6).expect("a depth");
        // (2/3) c³/R + (U/λ) c = F_z/(2E*), d = c²/R + U/λ.
        let yielding = 5e-8 * material.stick_ratio();
        let c = ((depth - yielding) * 0.01).sqrt();
        let borne = 2.0 / 3.0 * c * c * c / 0.01 + yielding * c;
        assert!((borne * 2.0 * 2.3077e11 / force - 1.0).abs() < 1e-6);
        assert!(depth > 1e-6 && depth < 3e-6, "{depth:e}");
        let domain = contact.domain_radius(true, 0.0).expect("a domain");
        assert!((domain / (0.02 * BEYOND_SETTLED * depth).sqrt() - 1.0).abs() < 1e-9);
        // Friction that changes has no such end.
        let domain = contact.domain_radius(false, 0.0).expect("a domain");
        assert!((domain / (0.02 * ROOM_TO_SINK * 1e-6_f64).sqrt() - 1.0).abs() < 1e-3);
    }

    #[test]
    fn every_shape_and_size_carries_its_load() {
        let (_, material, _) = hertz();
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
                let pressed = press_by(&indenter, &material, force);
                let pressed = pressed.unwrap_or_else(|| panic!("{indenter:?} {force}"));
                assert!(
                    pressed.depth > 0.0 && pressed.radius > 0.0,
                    "{indenter:?} {force}"
                );
            }
        }
    }

    /// F = 2E*(d a − ∫g dx) for both shapes with a flat face.
    #[test]
    fn a_flat_face_sinks_by_its_force_over_its_width() {
        let (_, material, force) = hertz();
        let punch = Indenter::flat_punch(1e-4).expect("a shape");
        let pressed = press_by(&punch, &material, force).expect("a contact");
        assert!((pressed.depth / (2e-6 / 3.0) - 1.0).abs() < 1e-3);
        assert_eq!(pressed.radius, 1e-4);
        let back = press_to(&punch, &material, pressed.depth).expect("a contact");
        assert!((back.force / force - 1.0).abs() < 1e-12);
        // F = 2E*/(3R) (2a² + b²) √(a² − b²) with b = 1e-4, a = 1.25e-4.
        let tip = Indenter::truncated_paraboloid(0.01, 1e-4).expect("a shape");
        let (a, b) = (1.25e-4f64, 1e-4f64);
        let load = 2.0 * 2.3077e11 / 0.03 * (2.0 * a * a + b * b) * (a * a - b * b).sqrt();
        let pressed = press_by(&tip, &material, load).expect("a contact");
        assert!(
            (pressed.radius / a - 1.0).abs() < 2e-3,
            "{}",
            pressed.radius
        );
        assert!((pressed.depth / tip.profile_1d(a) - 1.0).abs() < 2e-3);
    }

    #[test]
    fn references_follow_pressure_and_velocity() {
        let (indenter, material, force) = hertz();
        let swing =
            |mean, amplitude| Oscillation::new(mean, amplitude, 100.0, 0.0).expect("a motion");
        let normal = Control::Displacement(swing(1e-6, 0.0));
        let tangential = Some(Control::Displacement(swing(0.0, 1e-7)));
        let drive = Drive::new(normal.clone(), tangential);
        let references = |drive: &Drive| {
            with(&indenter, &material, |contact| {
                Contact { drive, ..contact }.references()
            })
        };
        let (stress, rate) = references(&drive).expect("references");
        assert!((stress / (0.1 * force / (PI * 1e-8)) - 1.0).abs() < 1e-3);
        assert!((rate / 1e-5 - 1.0).abs() < 1e-12);
        let still = Drive::new(normal, None);
        assert_eq!(references(&still).map(|both| both.1), Some(1.0));
    }
}

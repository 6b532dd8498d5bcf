//! Builds the material from the keys of a scenario, for the pair or for two bodies.

use super::{Faults, Spec};
use crate::contact::material::{Body, Material};
use crate::scenario::key::join;
use crate::scenario::spec;

/// Sections of the two bodies.
const BODIES: [&str; 2] = ["material.indenter", "material.half_space"];

/// Returns the coefficient of friction at the start; 0 where it does not matter.
pub(super) fn friction(spec: &Spec, faults: &mut Faults) -> Option<f64> {
    let meaning = "coefficient of friction, which the tangential motion needs";
    match spec.friction.first() {
        None if spec.motion.tangential.is_some() => faults.missing("friction.coefficient", meaning),
        first => Some(first.unwrap_or(0.0)),
    }
}

/// Returns the moduli and the coefficient of friction.
pub(super) fn material(spec: &Spec, faults: &mut Faults) -> Option<Material> {
    let given = &spec.material;
    let friction = friction(spec, faults);
    let made = if given.indenter.is_none() && given.half_space.is_none() {
        let modulus = faults.need("material.effective_modulus", given.effective_modulus);
        let poisson = faults.need("material.poisson", given.poisson);
        Material::new(modulus?, poisson?, friction?)
    } else {
        let meaning = "the second body: youngs_modulus and poisson, or rigid = true";
        let both = [&given.indenter, &given.half_space];
        let [indenter, half_space] = [0, 1].map(|side| match both[side] {
            Some(given) => body(spec, faults, BODIES[side], given),
            None => faults.missing(BODIES[side], meaning),
        });
        Material::of_bodies(indenter?, half_space?, friction?)
    };
    let section = match &made {
        Err(invalid) if invalid.field == "coefficient" => "friction",
        Err(invalid) if invalid.field == "rigid" => BODIES[1],
        _ => "material",
    };
    faults.accept(spec, section, made)
}

/// Returns the hardness of the softer body, Pa.
pub(super) fn hardness(material: &spec::Material) -> Option<f64> {
    let bodies = material.indenter.iter().chain(&material.half_space);
    let all = bodies.map(|body| body.hardness).chain([material.hardness]);
    all.flatten().reduce(f64::min)
}

/// Builds one of two bodies from its section of the scenario.
fn body(spec: &Spec, faults: &mut Faults, section: &str, given: &spec::Body) -> Option<Body> {
    let [modulus, poisson, rigid] =
        ["youngs_modulus", "poisson", "rigid"].map(|key| join(section, key));
    if faults.covers(&rigid) {
        return None;
    }
    if given.rigid == Some(true) {
        let rule = "a rigid body has no such key";
        return match (given.youngs_modulus, given.poisson) {
            (Some(_), _) => faults.refuse(spec, &modulus, rule),
            (None, Some(_)) => faults.refuse(spec, &poisson, rule),
            (None, None) => Some(Body::Rigid),
        };
    }
    let modulus = faults.need(&modulus, given.youngs_modulus);
    let poisson = faults.need(&poisson, given.poisson);
    faults.accept(spec, section, Body::elastic(modulus?, poisson?))
}

//! Builds the material from the keys of a scenario, for the pair or for two bodies.

use super::{FRICTION, Noted, Parts};
use crate::contact::material::{Body, Material};
use crate::math::invalid::Invalid;
use crate::scenario::spec;

/// Sections of the material and of the two bodies.
const MATERIAL: &str = "material";
const BODIES: [&str; 2] = ["material.indenter", "material.half_space"];

impl Parts<'_> {
    /// Returns the coefficient of friction at the start; 0 where it does not matter.
    pub(super) fn friction(&self) -> Result<f64, Noted> {
        let meaning = "coefficient of friction, which the tangential motion needs";
        match self.spec.friction.first() {
            None if self.spec.motion.tangential.is_some() => {
                Err(self.at(FRICTION).missing("coefficient", meaning))
            }
            first => Ok(first.unwrap_or(0.0)),
        }
    }

    /// Returns the moduli and the coefficient of friction.
    pub(super) fn material(&self) -> Result<Material, Noted> {
        let (at, given) = (self.at(MATERIAL), &self.spec.material);
        let friction = self.friction();
        let refused = |invalid: Invalid| match invalid.field {
            "coefficient" => self.at(FRICTION).refused(invalid),
            "rigid" => self.at(BODIES[1]).refused(invalid),
            _ => at.refused(invalid),
        };
        if given.indenter.is_none() && given.half_space.is_none() {
            let modulus = at.need("effective_modulus", given.effective_modulus);
            let poisson = at.need("poisson", given.poisson);
            return Material::new(modulus?, poisson?, friction?).map_err(refused);
        }
        let body = |key, path, given: &Option<spec::Body>| {
            let meaning = "the second body: youngs_modulus and poisson, or rigid = true";
            let given = given.as_ref().ok_or_else(|| at.missing(key, meaning))?;
            self.body(path, given)
        };
        let indenter = body("indenter", BODIES[0], &given.indenter);
        let half_space = body("half_space", BODIES[1], &given.half_space);
        Material::of_bodies(indenter?, half_space?, friction?).map_err(refused)
    }

    /// Returns the hardness of the softer body, Pa.
    pub(super) fn hardness(&self) -> Option<f64> {
        let material = &self.spec.material;
        let bodies = material.indenter.iter().chain(&material.half_space);
        let all = bodies.map(|body| body.hardness).chain([material.hardness]);
        all.flatten().reduce(f64::min)
    }

    /// Builds one of two bodies from its section of the scenario.
    fn body(&self, path: &'static str, given: &spec::Body) -> Result<Body, Noted> {
        let (at, modulus, poisson) = (self.at(path), given.youngs_modulus, given.poisson);
        if at.is_blamed("rigid") {
            return Err(Noted);
        }
        if given.rigid == Some(true) {
            let rule = "a rigid body has no such key";
            return match (modulus, poisson) {
                (Some(_), _) => Err(at.refuse("youngs_modulus", rule)),
                (None, Some(_)) => Err(at.refuse("poisson", rule)),
                (None, None) => Ok(Body::Rigid),
            };
        }
        let modulus = at.need("youngs_modulus", modulus);
        let poisson = at.need("poisson", poisson);
        Body::elastic(modulus?, poisson?).map_err(|invalid| at.refused(invalid))
    }
}

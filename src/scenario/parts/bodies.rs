//! Builds the material from the keys of a scenario, for the pair or for two bodies.

use super::Parts;
use crate::contact::material::{Body, Material};
use crate::math::invalid::Invalid;
use crate::scenario::error::Refusal;
use crate::scenario::values::join;

/// Sections of the two bodies.
const INDENTER: &str = "material.indenter";
const HALF_SPACE: &str = "material.half_space";

impl Parts<'_> {
    /// Returns the moduli and the coefficient of friction.
    pub(super) fn material(&self) -> Result<Material, Refusal> {
        let friction = match self.first("friction.coefficient", "friction") {
            None if self.has("motion.tangential") => {
                let meaning = "coefficient of friction, which the tangential motion needs";
                self.any("friction.coefficient", meaning)?
            }
            friction => friction.unwrap_or(0.0),
        };
        let refused = |invalid: Invalid| match invalid.field {
            "coefficient" => self.refused("friction")(invalid),
            "rigid" => self.refused(HALF_SPACE)(invalid),
            _ => self.refused("material")(invalid),
        };
        if !self.has(INDENTER) && !self.has(HALF_SPACE) {
            let modulus = self.require("material.effective_modulus")?;
            let poisson = self.require("material.poisson")?;
            return Material::new(modulus, poisson, friction).map_err(refused);
        }
        let (indenter, half_space) = (self.body(INDENTER)?, self.body(HALF_SPACE)?);
        Material::of_bodies(indenter, half_space, friction).map_err(refused)
    }

    /// Returns the hardness of the softer body, Pa.
    pub(super) fn hardness(&self) -> Option<f64> {
        let all = ["material", INDENTER, HALF_SPACE].into_iter();
        let given = all.filter_map(|section| self.get::<f64>(&join(section, "hardness")));
        given.reduce(f64::min)
    }

    /// Builds one of two bodies from its section of the scenario.
    fn body(&self, section: &str) -> Result<Body, Refusal> {
        if !self.has(section) {
            let meaning = "the second body: youngs_modulus and poisson, or rigid = true";
            return Err(self.missing(section, meaning));
        }
        let [modulus, poisson] = ["youngs_modulus", "poisson"].map(|key| join(section, key));
        if self.require(&join(section, "rigid"))? {
            return match [modulus, poisson].iter().find(|key| self.has(key)) {
                Some(key) => Err(self.refuse(key, "a rigid body has no such key")),
                None => Ok(Body::Rigid),
            };
        }
        let elastic = Body::elastic(self.require(&modulus)?, self.require(&poisson)?);
        elastic.map_err(self.refused(section))
    }
}

//! Builds the material from the keys of a scenario: of the pair, or of two bodies.

use super::error::ScenarioError;
use super::keys;
use super::schema::Key;
use super::validate::Parts;
use crate::contact::material::{Body, Material};
use crate::math::invalid::Invalid;

impl Parts<'_> {
    /// The moduli and the coefficient of friction.
    pub(super) fn material(&self) -> Result<Material, ScenarioError> {
        let friction = match self.first(&keys::FRICTION, &keys::FRICTION_COURSE) {
            None if self.has("motion.tangential") => {
                let meaning = "coefficient of friction, which the tangential motion needs";
                return Err(self.origin.missing(keys::FRICTION.path(), meaning));
            }
            friction => friction.unwrap_or(0.0),
        };
        let refused = |invalid: Invalid| match invalid.field {
            "coefficient" => self.refused("friction", invalid),
            "rigid" => self.refused("material.half_space", invalid),
            _ => self.refused("material", invalid),
        };
        if !self.has("material.indenter") && !self.has("material.half_space") {
            let modulus = self.require(&keys::EFFECTIVE_MODULUS)?;
            let poisson = self.require(&keys::POISSON)?;
            return Material::new(modulus, poisson, friction).map_err(refused);
        }
        let indenter = self.body(
            "material.indenter",
            &keys::INDENTER_MODULUS,
            &keys::INDENTER_POISSON,
            &keys::INDENTER_RIGID,
        )?;
        let half_space = self.body(
            "material.half_space",
            &keys::HALF_SPACE_MODULUS,
            &keys::HALF_SPACE_POISSON,
            &keys::HALF_SPACE_RIGID,
        )?;
        Material::of_bodies(indenter, half_space, friction).map_err(refused)
    }

    /// The hardness of the softer body, Pa.
    pub(super) fn hardness(&self) -> Option<f64> {
        let all = [
            &keys::HARDNESS,
            &keys::INDENTER_HARDNESS,
            &keys::HALF_SPACE_HARDNESS,
        ];
        let given = all.into_iter().filter_map(|key| self.get(key));
        given.reduce(f64::min)
    }

    fn body(
        &self,
        section: &str,
        modulus: &Key<f64>,
        poisson: &Key<f64>,
        rigid: &Key<bool>,
    ) -> Result<Body, ScenarioError> {
        if !self.has(section) {
            let meaning = "the second body: youngs_modulus and poisson, or rigid = true";
            return Err(self.origin.missing(section, meaning));
        }
        if self.require(rigid)? {
            let given = [modulus, poisson]
                .into_iter()
                .find(|key| self.has(key.path()));
            return match given {
                Some(key) => Err(self.refuse(key.path(), "", "a rigid body has no such key")),
                None => Ok(Body::Rigid),
            };
        }
        Body::elastic(self.require(modulus)?, self.require(poisson)?)
            .map_err(|invalid| self.refused(section, invalid))
    }
}

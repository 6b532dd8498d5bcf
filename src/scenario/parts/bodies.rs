//! Builds the material from the keys of a scenario: of the pair, or of two bodies.

use super::keys::{BodyKeys, HALF_SPACE, INDENTER};
use super::*;
use crate::contact::material::Body;

impl Parts<'_> {
    /// The moduli and the coefficient of friction.
    pub(super) fn material(&self) -> Result<Material, ScenarioError> {
        let friction = match self.first(&keys::FRICTION, &keys::FRICTION_COURSE) {
            None if self.has("motion.tangential") => {
                let meaning = "coefficient of friction, which the tangential motion needs";
                self.any(&keys::FRICTION, meaning)?
            }
            friction => friction.unwrap_or(0.0),
        };
        let refused = |invalid: Invalid| match invalid.field {
            "coefficient" => self.refused("friction", invalid),
            "rigid" => self.refused(HALF_SPACE.section, invalid),
            _ => self.refused("material", invalid),
        };
        if !self.has(INDENTER.section) && !self.has(HALF_SPACE.section) {
            let modulus = self.require(&keys::EFFECTIVE_MODULUS)?;
            let poisson = self.require(&keys::POISSON)?;
            return Material::new(modulus, poisson, friction).map_err(refused);
        }
        let (indenter, half_space) = (self.body(&INDENTER)?, self.body(&HALF_SPACE)?);
        Material::of_bodies(indenter, half_space, friction).map_err(refused)
    }

    /// The hardness of the softer body, Pa.
    pub(super) fn hardness(&self) -> Option<f64> {
        let all = [keys::HARDNESS, INDENTER.hardness, HALF_SPACE.hardness];
        let given = all.into_iter().filter_map(|key| self.get(&key));
        given.reduce(f64::min)
    }

    fn body(&self, keys: &BodyKeys) -> Result<Body, ScenarioError> {
        let section = keys.section;
        if !self.has(section) {
            let meaning = "the second body: youngs_modulus and poisson, or rigid = true";
            return Err(self.missing(section, meaning));
        }
        if self.require(&keys.rigid)? {
            let given = [keys.modulus, keys.poisson]
                .into_iter()
                .find(|key| self.has(key.path()));
            return match given {
                Some(key) => Err(self.refuse(key.path(), "", "a rigid body has no such key")),
                None => Ok(Body::Rigid),
            };
        }
        Body::elastic(self.require(&keys.modulus)?, self.require(&keys.poisson)?)
            .map_err(|invalid| self.refused(section, invalid))
    }
}

//! Elastic moduli and friction of the contact, checked once on construction.

use crate::math::invalid::{Invalid, non_negative, positive};

/// One elastic body, or a rigid one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Body {
    /// Young's modulus in Pa and Poisson's ratio.
    Elastic {
        /// E, Pa.
        youngs_modulus: f64,
        /// ν.
        poisson: f64,
    },
    /// Rigid; adds no compliance.
    Rigid,
}

impl Body {
    /// Makes an elastic body with E in Pa; ν from 0 to 0.5.
    pub fn elastic(youngs_modulus: f64, poisson: f64) -> Result<Self, Invalid> {
        Ok(Self::Elastic {
            youngs_modulus: positive("youngs_modulus", youngs_modulus)?,
            poisson: check_poisson(poisson)?,
        })
    }

    /// Returns ν; `None` if the body is rigid.
    fn poisson(self) -> Option<f64> {
        match self {
            Self::Elastic { poisson, .. } => Some(poisson),
            Self::Rigid => None,
        }
    }

    /// Returns (1 − ν²)/E, this body's share of 1/E*, 1/Pa.
    fn normal_compliance(self) -> f64 {
        match self {
            Self::Elastic {
                youngs_modulus,
                poisson,
            } => (1.0 - poisson * poisson) / youngs_modulus,
            Self::Rigid => 0.0,
        }
    }

    /// Returns (2 − ν)/(4G) with G = E/(2(1 + ν)), this body's share of 1/G*, 1/Pa.
    fn tangential_compliance(self) -> f64 {
        match self {
            Self::Elastic {
                youngs_modulus,
                poisson,
            } => (2.0 - poisson) * (1.0 + poisson) / (2.0 * youngs_modulus),
            Self::Rigid => 0.0,
        }
    }
}

/// The effective moduli of the pair and its coefficient of friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    normal_modulus: f64,
    tangential_modulus: f64,
    friction: f64,
    poisson: f64,
}

impl Material {
    /// Makes the pair from E* in Pa, ν of the elastic body (or of both, if they are alike), and μ.
    ///
    /// # Formula
    /// G*/E* = 2(1 − ν)/(2 − ν).
    pub fn new(effective_modulus: f64, poisson: f64, friction: f64) -> Result<Self, Invalid> {
        let normal_modulus = positive("effective_modulus", effective_modulus)?;
        let poisson = check_poisson(poisson)?;
        Ok(Self {
            normal_modulus,
            tangential_modulus: normal_modulus * 2.0 * (1.0 - poisson) / (2.0 - poisson),
            friction: non_negative("coefficient", friction)?,
            poisson,
        })
    }

    /// Makes the pair from two bodies and μ.
    ///
    /// # Formula
    /// 1/E* = Σ(1 − ν²)/E and 1/G* = Σ(2 − ν)/(4G) over the two bodies. Exact if normal and tangential displacement are
    /// uncoupled, as for elastically similar bodies.
    pub fn of_bodies(indenter: Body, half_space: Body, friction: f64) -> Result<Self, Invalid> {
        let normal = indenter.normal_compliance() + half_space.normal_compliance();
        let tangential = indenter.tangential_compliance() + half_space.tangential_compliance();
        if normal == 0.0 {
            return Err(Invalid::new(
                "rigid",
                true,
                "at most one of the two bodies may be rigid",
            ));
        }
        Ok(Self {
            normal_modulus: normal.recip(),
            tangential_modulus: tangential.recip(),
            friction: non_negative("coefficient", friction)?,
            poisson: half_space.poisson().or(indenter.poisson()).unwrap_or(0.0),
        })
    }

    /// Returns the same pair in a line contact: in plane strain a half-plane resists tangential and normal loads alike,
    /// G* = E*.
    #[must_use]
    pub fn in_plane_strain(self) -> Self {
        Self {
            tangential_modulus: self.normal_modulus,
            ..self
        }
    }

    /// Returns ν of the half-space, or of the indenter if the half-space is rigid; stresses inside depend on it.
    pub fn poisson(&self) -> f64 {
        self.poisson
    }

    /// Returns the same pair with another μ, 0 or greater.
    #[must_use]
    pub fn with_friction(self, friction: f64) -> Self {
        Self { friction, ..self }
    }

    /// E*, Pa.
    pub fn normal_modulus(&self) -> f64 {
        self.normal_modulus
    }

    /// G*, Pa.
    pub fn tangential_modulus(&self) -> f64 {
        self.tangential_modulus
    }

    /// μ.
    pub fn friction(&self) -> f64 {
        self.friction
    }

    /// Returns μ/G*, 1/Pa: the largest strain of a spring under unit load.
    pub fn reach(&self) -> f64 {
        self.friction / self.tangential_modulus
    }

    /// Returns κ = G*/(μE*): a spring compressed by d − g holds a tangential displacement of up to (d − g)/κ. Infinite
    /// without friction.
    pub fn stick_ratio(&self) -> f64 {
        self.tangential_modulus / (self.friction * self.normal_modulus)
    }
}

fn check_poisson(poisson: f64) -> Result<f64, Invalid> {
    if (0.0..=0.5).contains(&poisson) {
        Ok(poisson)
    } else {
        Err(Invalid::new("poisson", poisson, "must be from 0 to 0.5"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_similar_bodies_and_one_on_a_rigid_one_agree_with_the_ratio() {
        let steel = Body::elastic(210e9, 0.3).expect("steel");
        for pair in [(steel, steel), (Body::Rigid, steel), (steel, Body::Rigid)] {
            let material = Material::of_bodies(pair.0, pair.1, 0.1).expect("a pair");
            let ratio = material.tangential_modulus() / material.normal_modulus();
            assert!((ratio - 2.0 * 0.7 / 1.7).abs() < 1e-14, "{ratio}");
        }
        let pair = Material::of_bodies(steel, steel, 0.1).expect("a pair");
        assert!((pair.normal_modulus() - 210e9 / (2.0 * 0.91)).abs() < 1.0);
    }

    #[test]
    fn impossible_materials_are_refused() {
        for poisson in [-0.1, 0.7, f64::NAN] {
            assert_eq!(
                Material::new(1e11, poisson, 0.1).map_err(|e| e.field),
                Err("poisson")
            );
        }
        assert_eq!(
            Material::new(0.0, 0.3, 0.1).map_err(|e| e.field),
            Err("effective_modulus")
        );
        assert_eq!(
            Material::new(1e11, 0.3, -0.1).map_err(|e| e.field),
            Err("coefficient")
        );
        assert!(Material::of_bodies(Body::Rigid, Body::Rigid, 0.1).is_err());
    }
}

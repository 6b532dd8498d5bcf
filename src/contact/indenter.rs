//! The unworn indenter: its profile f₀(r), the gap to its tip before anything deforms.

use crate::math::invalid::{Invalid, positive};

/// A shape of revolution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Indenter {
    /// f = r²/(2R).
    Paraboloid {
        /// R, m.
        radius: f64,
    },
    /// f = r tan θ.
    Cone {
        /// θ, rad, between the surface and the cone's flank.
        angle: f64,
    },
    /// f = A rⁿ.
    Power {
        /// A, m^(1−n).
        coefficient: f64,
        /// n.
        exponent: f64,
    },
}

impl Indenter {
    /// A paraboloid with radius of curvature R in m.
    pub fn paraboloid(radius: f64) -> Result<Self, Invalid> {
        positive("radius", radius).map(|radius| Self::Paraboloid { radius })
    }

    /// A cone whose flank rises by `angle` rad, greater than 0 and less than π/2.
    pub fn cone(angle: f64) -> Result<Self, Invalid> {
        if angle > 0.0 && angle < std::f64::consts::FRAC_PI_2 {
            Ok(Self::Cone { angle })
        } else {
            Err(Invalid::new(
                "angle",
                angle,
                "must be greater than 0 and less than pi/2 (rad)",
            ))
        }
    }

    /// f = `coefficient` · r^`exponent`, with an exponent of at least 1.
    pub fn power(coefficient: f64, exponent: f64) -> Result<Self, Invalid> {
        let coefficient = positive("coefficient", coefficient)?;
        if (1.0..=20.0).contains(&exponent) {
            Ok(Self::Power {
                coefficient,
                exponent,
            })
        } else {
            Err(Invalid::new("exponent", exponent, "must be from 1 to 20"))
        }
    }

    /// f₀(r), m.
    pub fn profile(&self, r: f64) -> f64 {
        match *self {
            Self::Paraboloid { radius } => r * r / (2.0 * radius),
            Self::Cone { angle } => r * angle.tan(),
            Self::Power {
                coefficient,
                exponent,
            } => coefficient * r.powf(exponent),
        }
    }

    /// The radius at which f₀ reaches `height`, m: nothing outside it touches at that depth,
    /// whatever wears inside (f∞ ≥ f₀ and f∞ ≤ d, §5 of the limiting profile).
    pub fn radius_at(&self, height: f64) -> f64 {
        let height = height.max(0.0);
        match *self {
            Self::Paraboloid { radius } => (2.0 * radius * height).sqrt(),
            Self::Cone { angle } => height / angle.tan(),
            Self::Power {
                coefficient,
                exponent,
            } => (height / coefficient).powf(exponent.recip()),
        }
    }

    /// The shape's name, as a scenario spells it.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Paraboloid { .. } => "paraboloid",
            Self::Cone { .. } => "cone",
            Self::Power { .. } => "power",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_radius_at_a_height_inverts_the_profile() {
        for shape in [
            Indenter::paraboloid(0.01),
            Indenter::cone(0.02),
            Indenter::power(3e7, 4.0),
            Indenter::power(0.5, 1.0),
        ] {
            let shape = shape.expect("a shape");
            for height in [1e-12, 1e-6, 1e-3] {
                let back = shape.profile(shape.radius_at(height));
                assert!((back / height - 1.0).abs() < 1e-12, "{shape:?}");
            }
            assert_eq!(shape.profile(0.0), 0.0);
            assert_eq!(shape.radius_at(-1.0), 0.0);
        }
    }

    #[test]
    fn impossible_shapes_are_refused() {
        assert!(Indenter::paraboloid(-0.01).is_err());
        assert!(Indenter::paraboloid(f64::NAN).is_err());
        assert!(Indenter::cone(0.0).is_err());
        assert!(Indenter::cone(1.6).is_err());
        assert!(Indenter::power(1.0, 0.5).is_err());
        assert!(Indenter::power(0.0, 2.0).is_err());
    }
}

//! The unworn indenter: its profile f₀(r), the gap to its tip before deformation, and the 1D image g₀(x) of that
//! profile in closed form.
//!
//! V. L. Popov, M. Heß (2015), Method of dimensionality reduction in contact mechanics and friction,
//! ch. 3; κₙ = √π Γ(n/2 + 1)/Γ(n/2 + ½).
//!
//! To add a shape: its word in [`Shape`], which does not compile until [`Indenter::new`] makes it; its keys, in
//! [`Dimensions`]; word and keys in `keys.toml`.

use std::f64::consts::{FRAC_PI_2, PI};

use strum::{EnumString, IntoStaticStr, VariantNames};

use super::measured::MeasuredProfile;
use crate::math::geometry::Geometry;
use crate::math::invalid::{Invalid, Unmade, need, positive};

/// A shape, by its word in scenarios.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumString, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
#[expect(missing_docs, reason = "keys.toml describes each word")]
pub enum Shape {
    Paraboloid,
    Cone,
    Power,
    FlatPunch,
    TruncatedParaboloid,
    TruncatedCone,
    RoundedPunch,
    Table,
}

/// Keys of the shapes as a scenario gives them; `None`: not given.
#[derive(Debug, Clone, PartialEq, Default)]
#[expect(missing_docs, reason = "keys.toml describes each key")]
pub struct Dimensions {
    pub radius: Option<f64>,
    pub angle: Option<f64>,
    pub tip_radius: Option<f64>,
    pub coefficient: Option<f64>,
    pub exponent: Option<f64>,
    pub smoothing: Option<f64>,
    pub radii: Option<Vec<f64>>,
    pub heights: Option<Vec<f64>>,
}

/// A body of revolution, or the section of a cylinder.
#[derive(Debug, Clone, PartialEq)]
pub enum Indenter {
    /// f = (r² − b²)/(2R) outside a flat tip of radius b.
    Paraboloid {
        /// R, m.
        radius: f64,
        /// b, m; 0 for a whole paraboloid.
        tip_radius: f64,
    },
    /// f = (r − b) tan θ outside a flat tip of radius b.
    Cone {
        /// θ, rad, between the surface and the cone's flank.
        angle: f64,
        /// b, m; 0 for a whole cone.
        tip_radius: f64,
    },
    /// f = A rⁿ.
    Power {
        /// A, m^(1−n).
        coefficient: f64,
        /// n.
        exponent: f64,
    },
    /// f = 0 up to the rim, where the punch ends.
    FlatPunch {
        /// The punch's radius, m.
        radius: f64,
    },
    /// f = (r − b)²/(2R) outside a flat face of radius b: a punch with a rounded edge.
    RoundedPunch {
        /// R, m: radius of the rounding.
        radius: f64,
        /// b, m.
        tip_radius: f64,
    },
    /// A measured profile.
    Table(MeasuredProfile),
}

impl Indenter {
    /// Makes a shape of the keys of a scenario.
    ///
    /// # Errors
    /// If one of its keys is not given or not allowed.
    pub fn new(shape: Shape, given: &Dimensions) -> Result<Self, Unmade> {
        let radius = || need("radius", given.radius);
        let angle = || need("angle", given.angle);
        let tip = || need("tip_radius", given.tip_radius);
        let made = match shape {
            Shape::Paraboloid => Self::paraboloid(radius()?),
            Shape::Cone => Self::cone(angle()?),
            Shape::Power => Self::power(
                need("coefficient", given.coefficient)?,
                need("exponent", given.exponent)?,
            ),
            Shape::FlatPunch => Self::flat_punch(radius()?),
            Shape::TruncatedParaboloid => Self::truncated_paraboloid(radius()?, tip()?),
            Shape::TruncatedCone => Self::truncated_cone(angle()?, tip()?),
            Shape::RoundedPunch => Self::rounded_punch(radius()?, tip()?),
            Shape::Table => Self::table(
                need("radii", given.radii.as_deref())?,
                need("heights", given.heights.as_deref())?,
                need("smoothing", given.smoothing)?,
            ),
        };
        Ok(made?)
    }

    /// Makes a paraboloid with radius of curvature R in m.
    pub fn paraboloid(radius: f64) -> Result<Self, Invalid> {
        let tip_radius = 0.0;
        positive("radius", radius).map(|radius| Self::Paraboloid { radius, tip_radius })
    }

    /// Makes a cone whose flank rises by `angle` rad, greater than 0 and less than π/2.
    pub fn cone(angle: f64) -> Result<Self, Invalid> {
        let tip_radius = 0.0;
        check_angle(angle).map(|angle| Self::Cone { angle, tip_radius })
    }

    /// Makes f = `coefficient` · r^`exponent`, with an exponent from 1 to 20.
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

    /// Makes a flat punch of the given radius in m.
    pub fn flat_punch(radius: f64) -> Result<Self, Invalid> {
        positive("radius", radius).map(|radius| Self::FlatPunch { radius })
    }

    /// Makes a paraboloid of curvature radius R in m, cut flat at a tip radius in m.
    pub fn truncated_paraboloid(radius: f64, tip_radius: f64) -> Result<Self, Invalid> {
        Ok(Self::Paraboloid {
            radius: positive("radius", radius)?,
            tip_radius: positive("tip_radius", tip_radius)?,
        })
    }

    /// Makes a cone of the given angle in rad, cut flat at a tip radius in m.
    pub fn truncated_cone(angle: f64, tip_radius: f64) -> Result<Self, Invalid> {
        Ok(Self::Cone {
            angle: check_angle(angle)?,
            tip_radius: positive("tip_radius", tip_radius)?,
        })
    }

    /// Makes a punch with a flat face of radius `tip_radius` (m) and an edge rounded by `radius` (m).
    pub fn rounded_punch(radius: f64, tip_radius: f64) -> Result<Self, Invalid> {
        Ok(Self::RoundedPunch {
            radius: positive("radius", radius)?,
            tip_radius: positive("tip_radius", tip_radius)?,
        })
    }

    /// Makes a profile from a table: see [`MeasuredProfile::new`].
    pub fn table(radii: &[f64], heights: &[f64], smoothing: f64) -> Result<Self, Invalid> {
        MeasuredProfile::new(radii, heights, smoothing).map(Self::Table)
    }

    /// Returns f₀(r), m. A flat punch ends at its rim; callers do not ask beyond it.
    pub fn profile(&self, r: f64) -> f64 {
        if r <= self.tip_radius() {
            return 0.0;
        }
        match *self {
            Self::Table(ref measured) => measured.profile(r),
            Self::Paraboloid { radius, tip_radius } => {
                (r - tip_radius) * (r + tip_radius) / (2.0 * radius)
            }
            Self::Cone { angle, tip_radius } => (r - tip_radius) * angle.tan(),
            Self::Power {
                coefficient,
                exponent,
            } => coefficient * r.powf(exponent),
            Self::FlatPunch { .. } => 0.0,
            Self::RoundedPunch { radius, tip_radius } => (r - tip_radius).powi(2) / (2.0 * radius),
        }
    }

    /// Returns g₀(x), m, in a contact of this `geometry`, whose
    /// shape is a body of revolution or the section of a cylinder.
    pub fn image(&self, geometry: Geometry, x: f64) -> f64 {
        match geometry {
            Geometry::Round => self.profile_1d(x),
            Geometry::Line { .. } => self.line_profile_1d(x),
        }
    }

    /// Returns g₀(x), m: Eq. (1L), ∫ r f′/√(x² − r²) dr, in closed form.
    fn line_profile_1d(&self, x: f64) -> f64 {
        let b = self.tip_radius();
        if x <= b {
            return 0.0;
        }
        let root = ((x - b) * (x + b)).sqrt();
        // With a face of half-width b the arc runs from b to x.
        let sector = |radius: f64, sign: f64| {
            let arc = if b == 0.0 { FRAC_PI_2 } else { (b / x).acos() };
            (x * x * arc + sign * b * root) / (2.0 * radius)
        };
        match *self {
            Self::Table(ref measured) => measured.line_profile_1d(x),
            Self::Paraboloid { radius, .. } => sector(radius, 1.0),
            Self::RoundedPunch { radius, .. } => sector(radius, -1.0),
            Self::Cone { angle, .. } => root * angle.tan(),
            Self::Power {
                coefficient,
                exponent,
            } => exponent * FRAC_PI_2 / kappa(exponent) * coefficient * x.powf(exponent),
            Self::FlatPunch { .. } => 0.0,
        }
    }

    /// Returns g₀(x), m: Eq. (1) of the paper in closed form.
    pub fn profile_1d(&self, x: f64) -> f64 {
        if x <= self.tip_radius() {
            return 0.0;
        }
        match *self {
            Self::Table(ref measured) => measured.profile_1d(x),
            Self::Paraboloid { radius, tip_radius } => {
                x * ((x - tip_radius) * (x + tip_radius)).sqrt() / radius
            }
            Self::Cone { angle, tip_radius } => x * angle.tan() * (tip_radius / x).acos(),
            Self::Power {
                coefficient,
                exponent,
            } => kappa(exponent) * coefficient * x.powf(exponent),
            Self::FlatPunch { .. } => 0.0,
            Self::RoundedPunch { radius, tip_radius } => {
                let root = ((x - tip_radius) * (x + tip_radius)).sqrt();
                x / radius * (root - tip_radius * (tip_radius / x).acos())
            }
        }
    }

    /// Returns the radius at which f₀ reaches `height`, m: at that depth nothing touches outside it, whatever wears
    /// inside. A punch never reaches beyond its rim.
    pub fn radius_at(&self, height: f64) -> f64 {
        let height = height.max(0.0);
        match *self {
            Self::Table(ref measured) => measured.radius_at(height),
            Self::Paraboloid { radius, tip_radius } => {
                tip_radius.hypot((2.0 * radius * height).sqrt())
            }
            Self::Cone { angle, tip_radius } => tip_radius + height / angle.tan(),
            Self::Power {
                coefficient,
                exponent,
            } => (height / coefficient).powf(exponent.recip()),
            Self::FlatPunch { radius } => radius,
            Self::RoundedPunch { radius, tip_radius } => {
                tip_radius + (2.0 * radius * height).sqrt()
            }
        }
    }

    /// Returns the rim at which the indenter ends, m, if it has one.
    pub fn rim(&self) -> Option<f64> {
        match *self {
            Self::FlatPunch { radius } => Some(radius),
            _ => None,
        }
    }

    /// Returns the radius beyond which the shape is unknown, m: the rim, or the end of a table.
    pub fn end(&self) -> Option<f64> {
        match self {
            Self::Table(measured) => Some(measured.last_radius()),
            _ => self.rim(),
        }
    }

    /// Returns R of a whole paraboloid, m: the radius of a Hertzian ball.
    pub fn ball_radius(&self) -> Option<f64> {
        match *self {
            Self::Paraboloid {
                radius,
                tip_radius: 0.0,
            } => Some(radius),
            _ => None,
        }
    }

    /// Returns n of a whole tip f = A rⁿ.
    pub fn exponent(&self) -> Option<f64> {
        match *self {
            Self::Paraboloid { .. } if self.tip_radius() == 0.0 => Some(2.0),
            Self::Cone { .. } if self.tip_radius() == 0.0 => Some(1.0),
            Self::Power { exponent, .. } => Some(exponent),
            _ => None,
        }
    }

    /// Returns the radius of the flat face inside a rising profile, m; 0 if there is none.
    pub fn tip_radius(&self) -> f64 {
        match *self {
            Self::Paraboloid { tip_radius, .. }
            | Self::Cone { tip_radius, .. }
            | Self::RoundedPunch { tip_radius, .. } => tip_radius,
            _ => 0.0,
        }
    }

    /// Summarises in one line how a measured profile was treated.
    pub fn remark(&self) -> Option<String> {
        match self {
            Self::Table(measured) => Some(measured.summary()),
            _ => None,
        }
    }

    /// Returns its name in scenarios.
    pub fn name(&self) -> &'static str {
        let is_cut = self.tip_radius() > 0.0;
        let shape = match self {
            Self::Paraboloid { .. } if is_cut => Shape::TruncatedParaboloid,
            Self::Paraboloid { .. } => Shape::Paraboloid,
            Self::Cone { .. } if is_cut => Shape::TruncatedCone,
            Self::Cone { .. } => Shape::Cone,
            Self::Power { .. } => Shape::Power,
            Self::FlatPunch { .. } => Shape::FlatPunch,
            Self::RoundedPunch { .. } => Shape::RoundedPunch,
            Self::Table(_) => Shape::Table,
        };
        shape.into()
    }
}

fn check_angle(angle: f64) -> Result<f64, Invalid> {
    if angle > 0.0 && angle < FRAC_PI_2 {
        Ok(angle)
    } else {
        Err(Invalid::new(
            "angle",
            angle,
            "must be greater than 0 and less than pi/2 (rad)",
        ))
    }
}

/// κₙ: g = κₙ A xⁿ for f = A rⁿ.
fn kappa(n: f64) -> f64 {
    PI.sqrt() * libm::tgamma(0.5 * n + 1.0) / libm::tgamma(0.5 * n + 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shapes() -> Vec<Indenter> {
        [
            Indenter::paraboloid(0.01),
            Indenter::cone(0.02),
            Indenter::power(3e7, 4.0),
            Indenter::power(0.5, 1.0),
            Indenter::truncated_paraboloid(0.01, 2e-5),
            Indenter::truncated_cone(0.02, 2e-5),
            Indenter::rounded_punch(0.01, 2e-5),
        ]
        .into_iter()
        .map(|shape| shape.expect("a shape"))
        .collect()
    }

    #[test]
    fn the_radius_at_a_height_inverts_the_profile() {
        for shape in shapes() {
            for height in [1e-9, 1e-6, 1e-3] {
                let back = shape.profile(shape.radius_at(height));
                assert!((back / height - 1.0).abs() < 1e-9, "{shape:?}");
            }
            assert_eq!(shape.profile(0.0), 0.0);
        }
    }

    /// Eqs. (1) and (1L) with r = x sin φ: g = x ∫ f′(x sin φ) dφ, and with r instead of x, by the midpoint rule on
    /// differences of f.
    #[test]
    fn the_closed_images_are_those_of_eq_1() {
        for shape in shapes() {
            for x in [1e-5, 4e-5, 1.3e-4] {
                let steps = 40_000;
                let h = FRAC_PI_2 / f64::from(steps);
                let (mut round, mut line) = (0.0, 0.0);
                for i in 0..steps {
                    let r = x * (h * (f64::from(i) + 0.5)).sin();
                    let dr = 1e-6 * x;
                    let slope = (shape.profile(r + dr) - shape.profile((r - dr).abs()))
                        / (r + dr - (r - dr).abs());
                    round += x * h * slope;
                    line += r * h * slope;
                }
                let strip = Geometry::Line { length: 1.0 };
                for (geometry, expected) in [(Geometry::Round, round), (strip, line)] {
                    let ours = shape.image(geometry, x);
                    assert!(
                        (ours - expected).abs() <= 1e-4 * expected.abs(),
                        "{shape:?} at {x}: {ours} {expected}"
                    );
                }
            }
        }
    }

    #[test]
    fn kappa_of_cone_paraboloid_and_quartic() {
        for (n, expected) in [(1.0, FRAC_PI_2), (2.0, 2.0), (4.0, 8.0 / 3.0)] {
            assert!((kappa(n) / expected - 1.0).abs() < 1e-14);
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
        assert!(Indenter::flat_punch(0.0).is_err());
        assert!(Indenter::truncated_paraboloid(0.01, -1.0).is_err());
        assert!(Indenter::truncated_cone(2.0, 1e-5).is_err());
        assert!(Indenter::rounded_punch(0.01, 0.0).is_err());
    }
}

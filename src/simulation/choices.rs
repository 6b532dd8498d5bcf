//! Choices of numerics that a user makes by name: where the nodes lie, and how time is stepped.

use strum::{Display, EnumString, IntoStaticStr, VariantNames};

use crate::math::invalid::{Invalid, positive};

/// Where the nodes lie.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Hash, Display, EnumString, IntoStaticStr, VariantNames,
)]
#[strum(serialize_all = "kebab-case")]
pub enum Spacing {
    /// Narrow cells where wear is steep: towards the border of a permanent stick zone, one node on it, or where a
    /// pilot run wears.
    Graded,
    /// Cells of equal width, as in the paper.
    Uniform,
    /// Where the scenario says: a coarser run has placed them where the wear is.
    Given,
}

/// How a step in time is taken.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Hash, Display, EnumString, IntoStaticStr, VariantNames,
)]
#[strum(serialize_all = "kebab-case")]
pub enum Scheme {
    /// Extrapolated profile, mean stress of the step, turning points met exactly: second order.
    Trapezoid,
    /// Explicit Euler, as in the paper: first order.
    Euler,
}

/// What is done about steps whose wear answers too stiffly to the stress.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Hash, Display, EnumString, IntoStaticStr, VariantNames,
)]
#[strum(serialize_all = "kebab-case")]
pub enum Stability {
    /// They are taken in parts.
    SubStep,
    /// Nothing: the raw method, as the paper saw it.
    Off,
}

/// How cycles are gone through.
#[derive(Debug, Clone, Copy, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Integrator {
    /// Every step of every cycle.
    Direct,
    /// Jumps over many settled cycles at once where cycles are alike; direct elsewhere.
    CycleJump {
        /// The error of the worn profile to aim at, in units of the largest depth.
        tolerance: f64,
    },
}

impl Integrator {
    /// The names in scenarios and files.
    pub const NAMES: &[&str] = Self::VARIANTS;

    /// The integrator of a name, with the tolerance of its jumps: greater than 0, at most 0.1.
    pub fn new(name: &str, tolerance: f64) -> Result<Self, Invalid> {
        match name {
            "direct" => Ok(Self::Direct),
            "cycle-jump" if positive("tolerance", tolerance)? > 0.1 => {
                Err(Invalid::new("tolerance", tolerance, "must be at most 0.1"))
            }
            "cycle-jump" => Ok(Self::CycleJump { tolerance }),
            _ => Err(Invalid::choice("integrator", name, Self::NAMES)),
        }
    }

    /// The name in scenarios and files.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

impl Spacing {
    /// Their names in scenarios and files.
    pub const NAMES: &[&str] = Self::VARIANTS;

    /// The name in scenarios and files.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

impl Scheme {
    /// Every choice.
    pub const ALL: [Self; 2] = [Self::Trapezoid, Self::Euler];

    /// Their names in scenarios and files.
    pub const NAMES: &[&str] = Self::VARIANTS;

    /// The name in scenarios and files.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

impl Stability {
    /// Every choice.
    pub const ALL: [Self; 2] = [Self::SubStep, Self::Off];

    /// Their names in scenarios and files.
    pub const NAMES: &[&str] = Self::VARIANTS;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_integrator_needs_a_name_and_a_tolerance() {
        for &name in Integrator::NAMES {
            let integrator = Integrator::new(name, 1e-3).expect("an integrator");
            assert_eq!(integrator.name(), name);
        }
        let field = |name, tolerance| Integrator::new(name, tolerance).map_err(|e| e.field);
        assert_eq!(field("jump", 1e-3), Err("integrator"));
        assert_eq!(field("cycle-jump", 0.0), Err("tolerance"));
        assert_eq!(field("cycle-jump", 0.2), Err("tolerance"));
    }

    #[test]
    fn names_read_back() {
        assert_eq!(Scheme::ALL.map(Scheme::name), Scheme::NAMES);
        for spacing in [Spacing::Graded, Spacing::Uniform, Spacing::Given] {
            assert_eq!(spacing.name().parse(), Ok(spacing));
        }
        for scheme in Scheme::ALL {
            assert_eq!(scheme.to_string().parse(), Ok(scheme));
        }
        for stability in Stability::ALL {
            assert_eq!(stability.to_string().parse(), Ok(stability));
        }
        assert!("heun".parse::<Scheme>().is_err());
    }
}

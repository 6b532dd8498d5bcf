//! Choices of numerics that a user makes by name: where the nodes lie, and how time is stepped.

use serde::{Deserialize, Serialize};
use strum::{Display, EnumString, IntoStaticStr, VariantNames};

/// Where the nodes lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[derive(Display, EnumString, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Spacing {
    /// Narrow cells where wear is steep: towards the border of a permanent stick zone, with a node on it, or where a
    /// pilot run wears.
    Graded,
    /// Cells of equal width, as in the paper.
    Uniform,
    /// As listed in the scenario: a coarser run has placed them where the wear is.
    Given,
}

/// How a step in time is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[derive(Display, EnumString, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Scheme {
    /// Extrapolated profile, mean stress of the step, turning points met exactly: second order.
    Trapezoid,
    /// Explicit Euler, as in the paper: first order.
    Euler,
}

/// What is done about steps whose wear answers too stiffly to the stress.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[derive(Display, EnumString, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Stability {
    /// Split into sub-steps.
    SubStep,
    /// Not at all: the raw method, as in the paper.
    Off,
}

/// How cycles are integrated.
#[derive(Debug, Clone, Copy, PartialEq, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Integrator {
    /// Steps through every cycle.
    Direct,
    /// Jumps over many steady-state cycles at once if cycles are alike; steps otherwise.
    CycleJump {
        /// Target error of the worn profile, in units of the largest depth.
        tolerance: f64,
    },
}

impl Integrator {
    /// The names in scenarios and files.
    pub const NAMES: &[&str] = Self::VARIANTS;

    /// The name in scenarios and files.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

impl Spacing {
    /// The name in scenarios and files.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

impl Scheme {
    /// Every choice.
    pub const ALL: [Self; 2] = [Self::Trapezoid, Self::Euler];

    /// The name in scenarios and files.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_read_back() {
        assert_eq!(Scheme::ALL.map(Scheme::name), Scheme::VARIANTS);
        for spacing in [Spacing::Graded, Spacing::Uniform, Spacing::Given] {
            assert_eq!(spacing.name().parse(), Ok(spacing));
        }
        for scheme in Scheme::ALL {
            assert_eq!(scheme.to_string().parse(), Ok(scheme));
        }
        for stability in [Stability::SubStep, Stability::Off] {
            assert_eq!(stability.to_string().parse(), Ok(stability));
        }
        assert!("heun".parse::<Scheme>().is_err());
    }
}

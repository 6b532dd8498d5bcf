//! Choices of numerics that a user makes by name: where the nodes lie, and how time is stepped.

use std::fmt;
use std::str::FromStr;

use crate::math::invalid::{Invalid, positive};

/// Where the nodes lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Spacing {
    /// Cells of equal width, as in the paper.
    Uniform,
    /// Cells that narrow towards the stick border from both sides, one node on it. Where the motion
    /// leaves no permanent stick zone, uniform.
    Graded,
}

/// How a step in time is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Scheme {
    /// Explicit Euler, as in the paper: first order.
    Euler,
    /// Extrapolated profile, mean stress of the step, turning points met exactly: second order.
    Trapezoid,
}

/// What is done about steps whose wear answers too stiffly to the stress.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Stability {
    /// They are taken in parts.
    SubStep,
    /// Nothing: the raw method, as the paper saw it.
    Off,
}

/// How cycles are gone through.
#[derive(Debug, Clone, Copy, PartialEq)]
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
    pub const NAMES: [&str; 2] = ["direct", "cycle-jump"];

    /// The integrator of a name, with the tolerance of its jumps: greater than 0, at most 0.1.
    pub fn new(name: &str, tolerance: f64) -> Result<Self, Invalid> {
        if by_name("integrator", &Self::NAMES, |name| name, name)? == "direct" {
            return Ok(Self::Direct);
        }
        if positive("tolerance", tolerance)? > 0.1 {
            return Err(Invalid::new("tolerance", tolerance, "must be at most 0.1"));
        }
        Ok(Self::CycleJump { tolerance })
    }

    /// The name in scenarios and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Direct => Self::NAMES[0],
            Self::CycleJump { .. } => Self::NAMES[1],
        }
    }
}

impl Spacing {
    /// Every choice.
    pub const ALL: [Self; 2] = [Self::Graded, Self::Uniform];

    /// The name in scenarios and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Graded => "graded",
        }
    }
}

impl Scheme {
    /// Every choice.
    pub const ALL: [Self; 2] = [Self::Trapezoid, Self::Euler];

    /// The name in scenarios and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Euler => "euler",
            Self::Trapezoid => "trapezoid",
        }
    }
}

impl Stability {
    /// Every choice.
    pub const ALL: [Self; 2] = [Self::SubStep, Self::Off];

    /// The name in scenarios and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::SubStep => "sub-step",
            Self::Off => "off",
        }
    }
}

fn by_name<T: Copy>(
    field: &'static str,
    all: &[T],
    name_of: fn(T) -> &'static str,
    name: &str,
) -> Result<T, Invalid> {
    all.iter()
        .copied()
        .find(|&choice| name_of(choice) == name)
        .ok_or_else(|| {
            let names: Vec<String> = all
                .iter()
                .map(|&choice| format!("{:?}", name_of(choice)))
                .collect();
            Invalid::new(
                field,
                format!("{name:?}"),
                format!("must be one of {}", names.join(", ")),
            )
        })
}

impl FromStr for Spacing {
    type Err = Invalid;

    fn from_str(name: &str) -> Result<Self, Invalid> {
        by_name("grid", &Self::ALL, Self::name, name)
    }
}

impl FromStr for Scheme {
    type Err = Invalid;

    fn from_str(name: &str) -> Result<Self, Invalid> {
        by_name("scheme", &Self::ALL, Self::name, name)
    }
}

impl FromStr for Stability {
    type Err = Invalid;

    fn from_str(name: &str) -> Result<Self, Invalid> {
        by_name("stability", &Self::ALL, Self::name, name)
    }
}

impl fmt::Display for Spacing {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}

impl fmt::Display for Scheme {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_integrator_needs_a_name_and_a_tolerance() {
        for name in Integrator::NAMES {
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
        for spacing in Spacing::ALL {
            assert_eq!(spacing.name().parse(), Ok(spacing));
        }
        for scheme in Scheme::ALL {
            assert_eq!(scheme.name().parse(), Ok(scheme));
        }
        for stability in Stability::ALL {
            assert_eq!(stability.name().parse(), Ok(stability));
        }
        assert_eq!(
            "heun".parse::<Scheme>().map_err(|refusal| refusal.field),
            Err("scheme")
        );
    }
}

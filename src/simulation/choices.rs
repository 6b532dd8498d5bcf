//! Choices of numerics that a user makes by name: where the nodes lie, and how time is stepped.

use std::fmt;
use std::str::FromStr;

use crate::math::invalid::Invalid;

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
    fn names_read_back() {
        for spacing in Spacing::ALL {
            assert_eq!(spacing.name().parse(), Ok(spacing));
        }
        for scheme in Scheme::ALL {
            assert_eq!(scheme.name().parse(), Ok(scheme));
        }
        assert_eq!(
            "heun".parse::<Scheme>().map_err(|refusal| refusal.field),
            Err("scheme")
        );
    }
}

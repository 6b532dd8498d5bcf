//! The problems of the study, by name.

use std::collections::HashMap;
use std::sync::LazyLock;

use serde::Deserialize;
use strum::{Display, IntoStaticStr, VariantArray};

use super::errors::Errors;
use super::{line, normal, sliding};
use crate::math::abel::AbelMethod;
use crate::math::geometry::Geometry;
use crate::simulation::Breakdown;

/// A problem with a closed form.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Hash, Display, Deserialize, IntoStaticStr, VariantArray,
)]
#[strum(serialize_all = "kebab-case")]
#[serde(rename_all = "kebab-case")]
pub enum Problem {
    /// The paraboloid of the paper's Fig. 2.
    Hertz,
    /// A cone.
    Cone,
    /// f = r⁴.
    Quartic,
    /// A paraboloid with a flat tip.
    TruncatedParaboloid,
    /// A flat punch.
    FlatPunch,
    /// Partial slip of a paraboloid.
    Cattaneo,
    /// The limiting profile of a paraboloid.
    Limit,
    /// Partial slip of a cylinder on a flat.
    Cylinder,
    /// The limiting profile of a cylinder.
    CylinderLimit,
}

/// The border of the permanent stick zone: the only quantity with one number instead of one per node.
pub const STICK_RADIUS: &str = "c";

/// Facts about a problem.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, bound(deserialize = "'de: 'static"))]
pub struct Facts {
    /// Symbols of the compared quantities.
    pub quantities: Vec<&'static str>,
    /// What is solved and how, where the edges lie, the unit of the
    /// error and what is left out: lines of at most 78 columns.
    pub description: Vec<&'static str>,
}

/// Contents of `problems.toml`.
static FACTS: LazyLock<HashMap<Problem, Facts>> = LazyLock::new(|| {
    toml::from_str(include_str!("problems.toml")).expect("the problems are whole")
});

impl Problem {
    /// All problems, in the order of the report.
    pub const ALL: &[Self] = Self::VARIANTS;

    /// Returns the name on the command line and in files.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Returns the facts about it.
    pub fn facts(self) -> &'static Facts {
        &FACTS[&self]
    }

    /// Solves it by a method on N cells; returns the errors of the quantities.
    pub(super) fn solve(self, method: AbelMethod, points: usize) -> Result<Vec<Errors>, Breakdown> {
        let solve = match self {
            Self::Hertz => normal::hertz,
            Self::Cone => normal::cone,
            Self::Quartic => normal::quartic,
            Self::TruncatedParaboloid => normal::truncated_paraboloid,
            Self::FlatPunch => normal::flat_punch,
            Self::Cattaneo => sliding::cattaneo,
            Self::Limit => sliding::limit,
            Self::Cylinder => line::cattaneo,
            Self::CylinderLimit => line::limit,
        };
        solve(method, points)
    }

    /// Returns the methods that solve it: the paper's methods only solve round contacts.
    pub fn methods(self) -> &'static [AbelMethod] {
        match self {
            Self::Cylinder | Self::CylinderLimit => {
                AbelMethod::for_geometry(Geometry::Line { length: 1.0 })
            }
            _ => AbelMethod::for_geometry(Geometry::Round),
        }
    }

    /// Whether runs with `points` cells need `--all`: each run to the limiting profile takes seconds.
    pub fn is_long(self, points: usize) -> bool {
        matches!(self, Self::Limit | Self::CylinderLimit) && points > 200
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_problem_is_described() {
        for problem in Problem::ALL {
            let facts = problem.facts();
            assert!(!facts.quantities.is_empty(), "{problem}");
            let is_short = |line: &&str| line.chars().count() <= 78;
            assert!(facts.description.iter().all(is_short), "{problem}");
        }
    }
}

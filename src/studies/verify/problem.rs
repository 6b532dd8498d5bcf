//! The problems of the study, by name.

use strum::{Display, IntoStaticStr, VariantArray};

use super::errors::NodalErrors;
use super::{hertz, sliding};
use crate::math::abel::AbelMethod;
use crate::simulation::Breakdown;

/// A problem with a closed form.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Display, IntoStaticStr, VariantArray)]
#[strum(serialize_all = "kebab-case")]
pub enum Problem {
    /// The transforms of the paper's Fig. 2.
    Hertz,
    /// Partial slip, with its borders between nodes.
    Cattaneo,
    /// The limiting profile.
    Limit,
}

/// The border of the permanent stick zone: the only quantity with one number instead of one per node.
pub const STICK_RADIUS: &str = "c";

/// Facts about a problem.
#[derive(Debug)]
pub struct ProblemFacts {
    /// Symbols of the compared quantities.
    pub quantities: &'static [&'static str],
    /// What is solved and how, where the edges lie, the unit of the error and what is left out: lines of at most 78
    /// columns.
    pub description: &'static str,
}

impl Problem {
    /// All problems, in the order of the report.
    pub const ALL: &[Self] = Self::VARIANTS;

    /// Returns the name on the command line and in files.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Returns the facts about it.
    pub const fn facts(self) -> ProblemFacts {
        match self {
            Self::Hertz => ProblemFacts {
                quantities: &["g", "p", "w"],
                description: "\
Paraboloid, as in Fig. 2 of the paper: N cells over the contact, the edge a on
the last node; g of the exact f, p of the exact q, w of the exact u = d - g.
Error relative to theory at each node. Left out: g at r = 0 and p at r = a,
where theory is 0.",
            },
            Self::Cattaneo => ProblemFacts {
                quantities: &["tau", "slip"],
                description: "\
Partial slip of a paraboloid on first loading, c = a/2, a quarter of a cycle
of the simulation without wear: N cells over 1.5 a, a and c a third of a cell
past a node. Error of tau in its peak at all nodes, of the slip of the surface
in its peak at the nodes inside a.",
            },
            Self::Limit => ProblemFacts {
                quantities: &["f", "c"],
                description: "\
Limiting profile: paraboloid at constant depth d, mu = 0.1, nu = 0.3,
amplitude 0.05 d, k E* d/a = 3, 400 cycles of 40 steps, N cells over 1.5 a;
each method on its own grid and scheme. Error of f in d, the rms over the
radius; relative error of the permanent stick radius c.",
            },
        }
    }

    /// Solves it by a method on N cells; returns the errors of the quantities.
    pub(super) fn solve(
        self,
        method: AbelMethod,
        points: usize,
    ) -> Result<Vec<NodalErrors>, Breakdown> {
        match self {
            Self::Hertz => Ok(hertz::transforms(method, points)),
            Self::Cattaneo => sliding::cattaneo(method, points),
            Self::Limit => sliding::limit(method, points),
        }
    }

    /// Whether runs with `points` cells need `--long`: each run to the limiting profile takes seconds.
    pub fn is_long(self, points: usize) -> bool {
        self == Self::Limit && points > 200
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
            let is_short = |line: &str| line.chars().count() <= 78;
            assert!(facts.description.lines().all(is_short), "{problem}");
        }
    }
}

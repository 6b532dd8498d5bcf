//! The problems of the study, by name.

use strum::{Display, IntoStaticStr};

use super::errors::Errors;
use super::{Stop, normal, sliding};
use crate::math::abel::AbelMethod;

/// A problem with a closed form.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Display, IntoStaticStr)]
#[strum(serialize_all = "kebab-case")]
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
    /// What endless fretting leaves of a paraboloid.
    Limit,
}

/// The border of the permanent stick zone: the quantity that is one number, and not one a node.
pub const STICK_RADIUS: &str = "c";

/// What there is to know of a problem.
pub struct Facts {
    /// Solves it by a method on N cells; gives the errors of the quantities.
    pub(super) solve: fn(AbelMethod, usize) -> Result<Vec<Errors>, Stop>,
    /// The symbols of what is compared.
    pub quantities: &'static [&'static str],
    /// What is solved, how, where the edges lie, in what the error is measured and what is left
    /// out: lines of at most 78 columns.
    pub description: &'static [&'static str],
}

impl Problem {
    /// Every problem, in the order of the report.
    pub const ALL: [Self; 7] = [
        Self::Hertz,
        Self::Cone,
        Self::Quartic,
        Self::TruncatedParaboloid,
        Self::FlatPunch,
        Self::Cattaneo,
        Self::Limit,
    ];

    /// The name on the command line and in files.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// What there is to know of it.
    pub fn facts(self) -> Facts {
        match self {
            Self::Hertz => Facts {
                solve: normal::hertz,
                quantities: &["g", "p", "w"],
                description: &[
                    "Paraboloid, as in Fig. 2 of the paper: N cells over the contact, the edge a on",
                    "the last node; g of the exact f, p of the exact q, w of the exact u = d - g.",
                    "Error relative to theory at each node. Left out: g at r = 0 and p at r = a,",
                    "where theory is 0.",
                ],
            },
            Self::Cone => Facts {
                solve: normal::cone,
                quantities: &["g", "p", "w"],
                description: &[
                    "Cone: N cells over the contact, the edge a on the last node; transforms of",
                    "exact data. Errors of g and w relative to d, of p to the mean pressure.",
                    "Left out: p at r = 0, where theory is infinite.",
                ],
            },
            Self::Quartic => Facts {
                solve: normal::quartic,
                quantities: &["g", "p", "w"],
                description: &[
                    "f = r^4: N cells over 1.5 a, the edge a a third of a cell past a node; p as",
                    "the simulation has it, g and w of exact data. Error of g and w in the depth d,",
                    "of p in the mean pressure. Nodes inside a.",
                ],
            },
            Self::TruncatedParaboloid => Facts {
                solve: normal::truncated_paraboloid,
                quantities: &["g", "p", "w"],
                description: &[
                    "Paraboloid with a flat tip of radius b = a/2: N cells over 1.5 a, a and b a",
                    "third of a cell past a node; p, infinite at b, as the simulation has it, g and",
                    "w of exact data. Errors of g and w relative to d, of p to the mean pressure.",
                    "Nodes inside a.",
                ],
            },
            Self::FlatPunch => Facts {
                solve: normal::flat_punch,
                quantities: &["p"],
                description: &[
                    "Flat punch: N cells over the punch, its rim on the last node, where q jumps;",
                    "p as the simulation has it. Error relative to the mean pressure.",
                    "Left out: r = a, where theory is infinite.",
                ],
            },
            Self::Cattaneo => Facts {
                solve: sliding::cattaneo,
                quantities: &["tau", "slip"],
                description: &[
                    "Partial slip of a paraboloid on first loading, c = a/2, a quarter of a cycle",
                    "of the simulation without wear: N cells over 1.5 a, a and c a third of a cell",
                    "past a node. Error of tau in its peak at all nodes, of the slip of the surface",
                    "in its peak at the nodes inside a.",
                ],
            },
            Self::Limit => Facts {
                solve: sliding::limit,
                quantities: &["f", STICK_RADIUS],
                description: &[
                    "Limiting profile: paraboloid at constant depth d, mu = 0.1, nu = 0.3,",
                    "amplitude 0.05 d, k E* d/a = 3, 400 cycles of 40 steps, N cells over 1.5 a;",
                    "each method on its own grid and scheme. Error of f in d, the rms over the",
                    "radius; relative error of the permanent stick radius c.",
                ],
            },
        }
    }

    /// Whether runs with `points` cells need `--all`: each run to the limiting profile takes seconds.
    pub fn is_long(self, points: usize) -> bool {
        self == Self::Limit && points > 200
    }

    /// How long one task takes, roughly, in any unit: for a progress bar.
    pub fn effort(self, points: usize) -> u64 {
        let square = (points * points) as u64;
        match self {
            Self::Limit => 400 * square,
            _ => square,
        }
    }
}

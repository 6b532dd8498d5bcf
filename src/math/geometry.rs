//! The shape of a contact from above: a disc under a body of revolution, or a strip under a long cylinder.
//!
//! Both share the springs and Eq. (3). They differ here and in [`line`](super::abel::line): in two kernels, and in how
//! loads, works and depths add up.
//!
//! # Formula
//!
//! | | round | line of length L, plane strain |
//! |---|---|---|
//! | force of the springs | 2∫ q dx | L q(0) |
//! | work of the springs over the slip e | 2∫ q e dx | L [(2/π) ∫ q (e − e(0)) dx/x + q(0) e(0)] |
//! | volume of the depth δ | 2π∫ δ r dr | 2L ∫ δ dx |
//! | contact area | πa² | 2aL |

use std::f64::consts::{FRAC_1_PI, PI};

use super::abel::worn;
use super::grid::RadialGrid;
use super::quadrature::{line_weights, volume_of_revolution, weighted};

/// Replaces words of round contacts by words of lines, in this order.
const LINE_WORDS: [(&str, &str); 17] = [
    (
        "outer radius of the wear scar",
        "half-width of the wear scar",
    ),
    ("outermost radius", "largest distance from the centre line"),
    ("along the radius", "from the centre line outwards"),
    ("the radius", "the distance from the centre line"),
    ("radii", "half-widths"),
    ("radius", "half-width"),
    ("3D profile", "section"),
    ("e outer ring slips", "e edges slip"),
    ("RING SLIPS", "EDGES SLIP"),
    (" in the ring", " in the strips"),
    (" the ring", " the slip zone"),
    ("the depth d", "d = P/(E*L)"),
    ("depth d", "d = P/(E*L)"),
    (
        "indentation depth",
        "load over E* and the length of the line",
    ),
    (
        "exactly the sum of the spring forces",
        "exactly what the spring at the centre carries",
    ),
    ("if the depth is held", "if forces are prescribed"),
    ("if a force keeps pressing the indenter in", "in gross slip"),
];

/// The plan of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Geometry {
    /// A disc under a body of revolution; r is the distance from the axis.
    #[default]
    Round,
    /// A strip in plane strain: r is the distance from the centre line.
    Line {
        /// L, m.
        length: f64,
    },
}

impl Geometry {
    /// Returns the length of a line contact, m.
    pub fn length(self) -> Option<f64> {
        match self {
            Self::Round => None,
            Self::Line { length } => Some(length),
        }
    }

    /// Whether it is a line contact.
    pub fn is_line(self) -> bool {
        self.length().is_some()
    }

    /// Returns the weight of the work of a spring at `x` (m), in addition to dx.
    pub fn measure(self, x: f64) -> f64 {
        match self {
            Self::Round => 1.0,
            Self::Line { length } => length * FRAC_1_PI / x,
        }
    }

    /// Returns the weights (m²) of the volume (m³) of a worn depth (m) at the nodes.
    pub fn volume_weights(self, grid: &RadialGrid) -> Vec<f64> {
        match self {
            Self::Round => worn::volume_weights(grid),
            Self::Line { length } => {
                let weights = line_weights(grid.nodes()).into_iter();
                weights.map(|weight| 2.0 * length * weight).collect()
            }
        }
    }

    /// Integrates y over the contact area: nodal values `ys` at `rs` (m), linear in r².
    pub fn area_integral(self, rs: &[f64], ys: &[f64]) -> f64 {
        match self {
            Self::Round => volume_of_revolution(rs, ys),
            Self::Line { length } => 2.0 * length * weighted(&line_weights(rs), ys),
        }
    }

    /// Returns the area (m²) of a contact of radius or half-width `radius` (m).
    pub fn area(self, radius: f64) -> f64 {
        match self {
            Self::Round => PI * radius * radius,
            Self::Line { length } => 2.0 * length * radius,
        }
    }

    /// A name or a text in the words of this geometry: what is a radius in a round contact is a half-width in a line.
    pub fn term(self, name: &str) -> String {
        match self {
            Self::Round => name.to_owned(),
            Self::Line { .. } => LINE_WORDS
                .iter()
                .fold(name.to_owned(), |name, (of, by)| name.replace(of, by)),
        }
    }

    /// Tells what forces and volumes refer to; `None` for a round contact.
    pub fn remark(self) -> Option<String> {
        let length = self.length()?;
        Some(if length == 1.0 {
            "line, plane strain: forces, volumes and energies are per metre".into()
        } else {
            format!("line, plane strain, {length:e} m long")
        })
    }
}

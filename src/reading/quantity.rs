//! The numbers of a run with stated errors: one list for headers, columns, screens, the guide and the judge.

use strum::{EnumCount, VariantArray};

/// A number that a run gives away.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumCount, VariantArray)]
pub enum Quantity {
    /// The new wear, as a curve.
    WornDepth,
    /// The largest new wear.
    Deepest,
    /// The new worn volume V.
    Volume,
    /// The friction work E_d.
    Energy,
    /// F_x over the last period.
    Force,
    /// The area of the last fretting loop.
    Loop,
    /// The pressure.
    Pressure,
    /// a.
    ContactRadius,
    /// c, at the moment and permanent.
    StickRadius,
}

impl Quantity {
    /// All quantities, in the order of headers.
    pub const ALL: &'static [Self] = Self::VARIANTS;

    /// Returns the name on screens and in messages, as after "error of".
    pub const fn name(self) -> &'static str {
        match self {
            Self::WornDepth => "the worn depth, rms",
            Self::Deepest => "the deepest wear",
            Self::Volume => "the worn volume",
            Self::Energy => "the friction work",
            Self::Force => "F_x",
            Self::Loop => "the loop's area",
            Self::Pressure => "p away from borders",
            Self::ContactRadius => "the contact radius",
            Self::StickRadius => "the stick radii",
        }
    }

    /// The key in the headers of files, and the name of the column in studies.
    pub const fn column(self) -> &'static str {
        match self {
            Self::WornDepth => "estimated_error",
            Self::Deepest => "estimated_error_deepest",
            Self::Volume => "estimated_error_volume",
            Self::Energy => "estimated_error_energy",
            Self::Force => "estimated_error_force",
            Self::Loop => "estimated_error_loop",
            Self::Pressure => "estimated_error_pressure",
            Self::ContactRadius => "estimated_error_contact_radius",
            Self::StickRadius => "estimated_error_stick_radius",
        }
    }

    /// What its error is, and relative to what, in one line.
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::WornDepth => {
                "error of the new wear, rms over the scar, relative to its largest depth"
            }
            Self::Deepest => "error of the largest new wear, relative to it",
            Self::Volume => "error of the new worn volume, relative to it",
            Self::Energy => {
                "error of the friction work, relative to it or to 0.001 of 4 mu F_z U per cycle"
            }
            Self::Force => "largest error of F_x over the last period, relative to mu F_z",
            Self::Loop => "error of the last loop's area, relative to it or to 0.001 of 4 mu F_z U",
            Self::Pressure => {
                "largest error of p farther than 0.05 a from the axis, the stick border and the contact's edge, \
                 relative to the largest p there"
            }
            Self::ContactRadius => "error of a, relative to it",
            Self::StickRadius => "larger error of c, of the moment and permanent, relative to a",
        }
    }

    /// Whether it concerns wear, so that it means nothing before anything has worn.
    pub const fn is_of_wear(self) -> bool {
        matches!(self, Self::WornDepth | Self::Deepest | Self::Volume)
    }

    /// Whether `numerics.accuracy` guarantees it; the other errors are only reported.
    pub const fn is_promised(self) -> bool {
        match self {
            Self::WornDepth | Self::Volume | Self::Energy | Self::Force => true,
            Self::Deepest
            | Self::Loop
            | Self::Pressure
            | Self::ContactRadius
            | Self::StickRadius => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The chapter on accuracy has one row per quantity, in the same words.
    #[test]
    fn the_guide_lists_every_number() {
        let guide = include_str!("../guide/accuracy.md");
        for quantity in Quantity::ALL {
            let promised = if quantity.is_promised() { "yes" } else { "no" };
            let row = format!(
                "| `{}` | {} | {promised} |",
                quantity.column(),
                quantity.meaning()
            );
            assert!(guide.contains(&row), "the guide lacks: {row}");
        }
    }
}

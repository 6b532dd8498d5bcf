//! The numbers of a run with stated errors: one list for headers, columns, screens, the guide and the judge.

use strum::{EnumCount, VariantArray};

use super::Column;

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

    /// Its estimated error: the key in the headers of files, and the column of studies.
    pub const fn column(self) -> Column {
        Column::ERRORS[self as usize]
    }

    /// Whether it concerns wear, so that it means nothing before anything has worn.
    pub const fn is_of_wear(self) -> bool {
        matches!(self, Self::WornDepth | Self::Deepest | Self::Volume)
    }

    /// Whether `numerics.accuracy` guarantees it; the other errors are only reported.
    pub const fn is_promised(self) -> bool {
        match self {
            Self::WornDepth | Self::Deepest | Self::Volume | Self::Energy | Self::Force => true,
            Self::Loop | Self::Pressure | Self::ContactRadius | Self::StickRadius => false,
        }
    }
}

/// Each stated error is that of a quantity.
const _: () = assert!(Column::ERRORS.len() == Quantity::COUNT);

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
                quantity.column().name(),
                quantity.column().meaning()
            );
            assert!(guide.contains(&row), "the guide lacks: {row}");
        }
    }
}

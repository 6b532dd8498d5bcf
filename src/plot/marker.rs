//! Characters that dots are made of.

use clap::ValueEnum;
use ratatui::symbols::braille::BRAILLE;

/// The character of a dot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Marker {
    /// Braille patterns: 2 by 4 dots per cell.
    #[default]
    Braille,
    /// Half blocks: 1 by 2 dots per cell.
    #[value(name = "halfblock")]
    HalfBlock,
    /// A bullet: one dot per cell.
    Dot,
    /// An asterisk: one dot per cell; axes, units and labels are then in ASCII too.
    Ascii,
}

impl Marker {
    /// Dots in a cell, across and down.
    pub fn dots(self) -> (u16, u16) {
        match self {
            Marker::Braille => (2, 4),
            Marker::HalfBlock => (1, 2),
            Marker::Dot | Marker::Ascii => (1, 1),
        }
    }

    /// The character of a cell with these dots of curves.
    pub fn glyph(self, dots: u8) -> char {
        match (self, dots) {
            (Marker::Braille, _) => BRAILLE[usize::from(dots)],
            (Marker::HalfBlock, 1) => '▀',
            (Marker::HalfBlock, 2) => '▄',
            (Marker::HalfBlock, _) => '█',
            (Marker::Dot, _) => '•',
            (Marker::Ascii, _) => '*',
        }
    }

    /// The character of a cell with these dots of the layer below.
    pub(super) fn under_glyph(self, kind: Under, dots: u8) -> char {
        match (self, kind) {
            (Marker::Braille, _) => BRAILLE[usize::from(dots)],
            (Marker::HalfBlock, Under::Fill) => '░',
            (Marker::Dot, Under::Fill) => '·',
            (Marker::Ascii, Under::Fill) => '.',
            (Marker::Ascii, Under::Zero) => '-',
            (Marker::Ascii, Under::Mark) => ':',
            (Marker::Ascii, Under::Cursor) => '|',
            (_, Under::Zero) => '┈',
            (_, Under::Mark) => '┊',
            (_, Under::Cursor) => '│',
        }
    }
}

/// The layer under the curves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Under {
    /// The area between a curve and its base.
    Fill,
    /// The line of zero.
    Zero,
    /// A vertical mark.
    Mark,
    /// The cursor.
    Cursor,
}

//! Characters that curves are drawn with.

use clap::ValueEnum;
use ratatui::symbols::braille::BRAILLE;

/// How dots are drawn.
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
    /// Returns the number of dots per cell, across and down.
    pub fn dots(self) -> (u16, u16) {
        match self {
            Marker::Braille => (2, 4),
            Marker::HalfBlock => (1, 2),
            Marker::Dot | Marker::Ascii => (1, 1),
        }
    }

    /// Returns the character of a cell with these curve dots.
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

    /// Returns the character of a cell with these dots of the layer below.
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

/// The kinds of drawing in the layer below the curves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Under {
    /// The area between a curve and its base.
    Fill,
    /// The zero line.
    Zero,
    /// A vertical mark.
    Mark,
    /// The cursor.
    Cursor,
}

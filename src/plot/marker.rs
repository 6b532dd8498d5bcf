//! Characters that dots are made of.

use clap::ValueEnum;

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
    pub(super) fn glyph(self, dots: u8) -> char {
        match (self, dots) {
            (Marker::Braille, _) => braille(dots),
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
            (Marker::Braille, _) => braille(dots),
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

/// The Braille character of a cell's bits (left, right; top to bottom).
fn braille(bits: u8) -> char {
    const PATTERN: [u32; 8] = [0x01, 0x08, 0x02, 0x10, 0x04, 0x20, 0x40, 0x80];
    let dots = PATTERN
        .iter()
        .enumerate()
        .filter(|(bit, _)| bits & (1 << bit) != 0);
    let code: u32 = dots.map(|(_, dot)| dot).sum();
    char::from_u32(0x2800 + code).unwrap_or(' ')
}

//! Maps values to colours, or to characters without colours.

use ratatui::style::Color;

use crate::studies::sweep::slice::REGIMES;
use crate::tui::theme::{Look, Theme};

/// Colours from low to high, of the 16 that every terminal has.
const COLORS: [Color; 9] = [
    Color::Blue,
    Color::LightBlue,
    Color::Cyan,
    Color::LightCyan,
    Color::Green,
    Color::LightGreen,
    Color::Yellow,
    Color::LightRed,
    Color::Red,
];

/// Characters from low to high.
const SIGNS: [char; 9] = ['.', ':', '-', '=', '+', 'o', '*', '%', '@'];

/// What a point shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shade {
    /// No row yet.
    Waiting,
    /// A row that failed, or one without this value.
    Failed,
    /// From 0 to 1 of the range.
    Share(f64),
    /// One of a few words, by its number.
    Word(usize),
}

/// The characters and colours of [`REGIMES`].
const SWATCHES: [(char, Color); REGIMES.len()] = [
    ('s', Color::Green),
    ('~', Color::Yellow),
    ('#', Color::Red),
    (' ', Color::Blue),
];

impl Shade {
    /// The colour; `None` where nothing is to be seen.
    pub fn color(self, theme: &Theme) -> Option<Color> {
        match self {
            Self::Waiting => None,
            Self::Failed if theme.look == Look::Light => Some(Color::Gray),
            Self::Failed => Some(Color::DarkGray),
            Self::Share(share) => Some(COLORS[level(share)]),
            Self::Word(word) => Some(SWATCHES[word % SWATCHES.len()].1),
        }
    }

    /// The character that stands for it without colours.
    pub fn sign(self) -> char {
        match self {
            Self::Waiting => ' ',
            Self::Failed => '!',
            Self::Share(share) => SIGNS[level(share)],
            Self::Word(word) => SWATCHES[word % SWATCHES.len()].0,
        }
    }
}

fn level(share: f64) -> usize {
    let levels = COLORS.len();
    ((share * levels as f64) as usize).min(levels - 1)
}

/// Every shade of a continuous range, for the legend.
pub fn all() -> impl Iterator<Item = Shade> {
    (0..COLORS.len()).map(|at| Shade::Share((at as f64 + 0.5) / COLORS.len() as f64))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ends_of_the_range_have_a_shade() {
        assert_eq!((level(0.0), level(1.0)), (0, COLORS.len() - 1));
        assert_eq!(all().count(), SIGNS.len());
    }
}

//! Maps values to colours, or to characters without colours.

use ratatui::style::Color;

use crate::plot::colormap::ColorMap;
use crate::studies::sweep::slice::REGIMES;
use crate::tui::shades::{self, SHADES};
use crate::tui::theme::{Look, Role, Theme};

/// Characters from low to high.
const SIGNS: [char; SHADES] = ['.', ':', '-', '=', '+', 'c', 'o', 'x', '*', '%', '#', '@'];

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

/// The characters and roles of [`REGIMES`]: stick and slip have the colours that they have in all panels, and any kind
/// of colour vision tells the one between them from both.
const SWATCHES: [(char, Role); REGIMES.len()] = [
    ('s', Role::Stick),
    ('~', Role::Pressure),
    ('#', Role::Slip),
    (' ', Role::Limit),
];

impl Shade {
    /// The colour; `None` where nothing is to be seen.
    pub fn color(self, theme: &Theme) -> Option<Color> {
        match self {
            Self::Waiting => None,
            Self::Failed if theme.look == Look::Light => Some(Color::Gray),
            Self::Failed => Some(Color::DarkGray),
            Self::Share(share) => shades::color(theme, ColorMap::Sequential, level(share)),
            Self::Word(word) => theme.style(SWATCHES[word % SWATCHES.len()].1).fg,
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
    shades::shade(share, [0.0, 1.0])
}

/// The character of a shade without colours.
pub fn sign(shade: usize) -> char {
    SIGNS[shade]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plot::Marker;
    use crate::tui::theme::Depth;

    /// G. Machado et al. (2009): what a deuteranope sees of linear red, green and blue.
    const DEUTERANOPE: [[f64; 3]; 3] = [
        [0.367322, 0.860646, -0.227968],
        [0.280085, 0.672501, 0.047413],
        [-0.011820, 0.042940, 0.968881],
    ];

    #[test]
    fn a_deuteranope_tells_the_regimes_apart() {
        for look in [Look::Dark, Look::Light] {
            let theme = Theme::new(look, Marker::Braille).with_depth(Depth::Indexed);
            let seen = |word: usize| {
                let Some(Color::Indexed(index)) = Shade::Word(word).color(&theme) else {
                    panic!("{word} has no colour of the cube");
                };
                let digits = [36, 6, 1].map(|place| (index - 16) / place % 6);
                let linear = digits.map(|digit| match f64::from(digit) {
                    0.0 => 0.0,
                    digit => ((55.0 + 40.0 * digit) / 255.0).powf(2.2),
                });
                DEUTERANOPE.map(|row| (0..3).map(|k| row[k] * linear[k]).sum::<f64>())
            };
            // Lift-off has no sign, the others have one each.
            for (a, b, least) in [
                (0, 1, 0.3),
                (1, 2, 0.5),
                (0, 2, 0.2),
                (0, 3, 0.3),
                (1, 3, 0.1),
                (2, 3, 0.5),
            ] {
                let apart = seen(a).into_iter().zip(seen(b));
                let apart = apart.map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
                assert!(apart > least, "{look:?} {a} {b}: {apart}");
            }
        }
    }

    #[test]
    fn both_ends_of_the_range_have_a_shade() {
        assert_eq!((level(0.0), level(1.0)), (0, SHADES - 1));
    }
}

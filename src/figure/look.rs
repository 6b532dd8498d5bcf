//! The look of a figure: its font size, and the colours or greys of its curves.

use clap::ValueEnum;

use super::canvas::{BLACK, Rgb};
use crate::plot::colormap::ColorMap;
use crate::plot::map::WORDS;
use crate::plot::theme::Role;

/// Colours or greys.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Style {
    /// The screen's colours for a light background, dark enough for print.
    Color,
    /// Greys and dashes.
    Grey,
}

/// How a figure looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FigureStyle {
    /// The font size, mm.
    pub font: f64,
    /// Colours or greys.
    pub style: Style,
}

/// Colours of several states, from Okabe and Ito: safe for colour-blind readers.
const SERIES: [Rgb; 6] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [204, 121, 167],
    [120, 94, 20],
    [86, 180, 233],
];

/// Colours of other sources, which no quantity has.
const GHOSTS: [Rgb; 4] = [[200, 0, 60], [150, 75, 0], [90, 90, 90], [110, 0, 130]];

/// Colours of the words on a map: stick, partial slip, gross slip, lift-off.
const REGIMES: [Rgb; WORDS] = [
    [69, 117, 180],
    [171, 217, 233],
    [253, 174, 97],
    [215, 48, 39],
];
const REGIME_GREYS: [u8; WORDS] = [110, 165, 210, 245];

/// Dash patterns that tell grey lines apart, mm: first for states and other sources, then for closed forms and for the
/// unworn profile, which are drawn with them.
const DASHES: [&[f64]; SERIES.len() + 2] = [
    &[],
    &[2.0, 0.8],
    &[0.5, 0.6],
    &[2.0, 0.6, 0.5, 0.6],
    &[3.0, 0.6, 1.0, 0.6],
    &[1.0, 1.0],
    &[2.0, 0.6, 0.5, 0.6, 0.5, 0.6],
    &[4.0, 0.8],
];

/// The grey of each pattern.
const GREYS: [u8; DASHES.len()] = [0, 90, 130, 60, 110, 30, 100, 150];

/// Returns the index of a role among the greys.
fn rank(role: Role) -> usize {
    match role {
        Role::Shear | Role::Stick => 1,
        Role::Limit => SERIES.len(),
        Role::Unworn => SERIES.len() + 1,
        Role::Series(k) | Role::Border(k) => k % SERIES.len(),
        Role::Ghost(k) => (k + 1) % SERIES.len(),
        _ => 0,
    }
}

impl FigureStyle {
    /// Returns the colour of a curve.
    pub fn color(&self, role: Role) -> Rgb {
        if matches!(role, Role::Border(_)) {
            return BLACK;
        }
        if self.style == Style::Grey {
            return [GREYS[rank(role)]; 3];
        }
        match role {
            Role::Unworn => [130, 130, 130],
            Role::Profile => [20, 60, 200],
            Role::Pressure | Role::Contact => [0, 130, 150],
            Role::Shear => [170, 0, 150],
            Role::Stick => [0, 140, 60],
            Role::Series(k) => SERIES[k % SERIES.len()],
            Role::Ghost(k) => GHOSTS[k % GHOSTS.len()],
            _ => BLACK,
        }
    }

    /// Returns the dashes and gaps of a curve, mm.
    pub fn dashes(&self, role: Role, dashed: bool) -> &'static [f64] {
        match (self.style, dashed) {
            (_, _) if matches!(role, Role::Border(_)) => DASHES[rank(role)],
            (Style::Grey, _) if rank(role) > 0 => DASHES[rank(role)],
            (_, true) => DASHES[1],
            _ => DASHES[0],
        }
    }

    /// Returns the colour of a word on a map.
    pub fn regime(&self, word: usize) -> Rgb {
        match self.style {
            Style::Color => REGIMES[word % WORDS],
            Style::Grey => [REGIME_GREYS[word % WORDS]; 3],
        }
    }

    /// Returns the colour at a share of a map's range, 0 to 1.
    pub fn mapped(&self, map: ColorMap, share: f64) -> Rgb {
        // The number of distinct shades. Neighbours with the same shade are drawn as one area.
        const SHADES: f64 = 48.0;
        let share = ((share.clamp(0.0, 1.0) * SHADES).floor() + 0.5).min(SHADES - 0.5) / SHADES;
        match self.style {
            Style::Color => map.color(share),
            Style::Grey => [(250.0 - 220.0 * share) as u8; 3],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each state has different dashes, and the curves drawn with them have others.
    #[test]
    fn greys_tell_states_apart_from_the_unworn_profile_and_the_limit() {
        let look = FigureStyle {
            font: 2.8,
            style: Style::Grey,
        };
        let states = (0..SERIES.len()).map(Role::Series);
        let inks: Vec<Role> = states.chain([Role::Limit, Role::Unworn]).collect();
        for (k, &ink) in inks.iter().enumerate() {
            for &other in &inks[..k] {
                assert_ne!(
                    look.dashes(ink, false),
                    look.dashes(other, false),
                    "{ink:?} {other:?}"
                );
                assert_ne!(look.color(ink), look.color(other), "{ink:?} {other:?}");
            }
        }
    }
}

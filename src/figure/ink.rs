//! The look of a figure: font size, and colours or shades of grey.

use super::canvas::{BLACK, Rgb};
use crate::plot::colormap::ColorMap;

/// The role of a curve: the same quantity has the same colour in every chart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ink {
    /// The unworn profile, and past states.
    Unworn,
    /// Closed forms.
    Limit,
    /// f and the worn depth.
    Profile,
    /// g.
    Profile1d,
    /// p, F_z.
    Pressure,
    /// τ, F_x.
    Shear,
    /// The contact radius.
    Contact,
    /// The stick radius.
    Stick,
    /// One of several states or methods.
    Series(usize),
    /// One of several curves of other sources.
    Ghost(usize),
    /// One of several borders on a map.
    Border(usize),
}

/// Colours or greys.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// The screen's colours for a light background, dark enough for print.
    Color,
    /// Greys, told apart by dashes.
    Grey,
}

/// How a figure looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Look {
    /// The size of the font, mm.
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

/// Colours of other sources: no quantity has them.
const GHOSTS: [Rgb; 4] = [[200, 0, 60], [150, 75, 0], [90, 90, 90], [110, 0, 130]];

/// Colours of words on a map: stick, partial slip, gross slip, lift-off.
const REGIMES: [Rgb; REGIME_INKS] = [
    [69, 117, 180],
    [171, 217, 233],
    [253, 174, 97],
    [215, 48, 39],
];
const REGIME_GREYS: [u8; REGIME_INKS] = [110, 165, 210, 245];

/// How many words a map can tell apart.
pub const REGIME_INKS: usize = 4;

/// Dashes that tell grey lines apart, mm: those of states and other sources, then those of closed forms and of
/// the unworn profile, which are drawn beside any of them.
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

/// Their greys.
const GREYS: [u8; DASHES.len()] = [0, 90, 130, 60, 110, 30, 100, 150];

impl Ink {
    /// Its place among the greys.
    fn rank(self) -> usize {
        match self {
            Self::Profile | Self::Profile1d | Self::Pressure | Self::Contact => 0,
            Self::Shear | Self::Stick => 1,
            Self::Limit => SERIES.len(),
            Self::Unworn => SERIES.len() + 1,
            Self::Series(k) => k % SERIES.len(),
            Self::Ghost(k) => (k + 1) % SERIES.len(),
            Self::Border(k) => k % SERIES.len(),
        }
    }
}

impl Look {
    /// The colour of a curve.
    pub fn color(&self, ink: Ink) -> Rgb {
        if matches!(ink, Ink::Border(_)) {
            return BLACK;
        }
        if self.style == Style::Grey {
            return [GREYS[ink.rank()]; 3];
        }
        match ink {
            Ink::Unworn => [130, 130, 130],
            Ink::Limit | Ink::Border(_) => BLACK,
            Ink::Profile => [20, 60, 200],
            Ink::Profile1d => [60, 110, 230],
            Ink::Pressure | Ink::Contact => [0, 130, 150],
            Ink::Shear => [170, 0, 150],
            Ink::Stick => [0, 140, 60],
            Ink::Series(k) => SERIES[k % SERIES.len()],
            Ink::Ghost(k) => GHOSTS[k % GHOSTS.len()],
        }
    }

    /// Dashes and gaps of a curve, mm.
    pub fn dashes(&self, ink: Ink, dashed: bool) -> &'static [f64] {
        match (self.style, dashed) {
            (_, _) if matches!(ink, Ink::Border(_)) => DASHES[ink.rank()],
            (Style::Grey, _) if ink.rank() > 0 => DASHES[ink.rank()],
            (_, true) => DASHES[1],
            _ => DASHES[0],
        }
    }

    /// The colour of a word on a map.
    pub fn regime(&self, word: usize) -> Rgb {
        match self.style {
            Style::Color => REGIMES[word % REGIME_INKS],
            Style::Grey => [REGIME_GREYS[word % REGIME_INKS]; 3],
        }
    }

    /// The colour of a share of a map's range, 0 to 1.
    pub fn mapped(&self, map: ColorMap, share: f64) -> Rgb {
        // The number of distinct shades; neighbours that share one are drawn as one area.
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

    /// Of the states of a figure each has its dashes, and what is drawn beside them has others.
    #[test]
    fn greys_tell_states_apart_from_the_unworn_profile_and_the_limit() {
        let look = Look {
            font: 2.8,
            style: Style::Grey,
        };
        let states = (0..SERIES.len()).map(Ink::Series);
        let inks: Vec<Ink> = states.chain([Ink::Limit, Ink::Unworn]).collect();
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

//! Dash patterns, which tell curves of one colour apart.

use super::marker::Marker;

/// Solid, or a pattern of dashes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DashPattern {
    /// No gaps.
    #[default]
    Solid,
    /// Dashes.
    Dashed,
    /// Dots.
    Dotted,
    /// A dash and a dot alternately.
    DashDotted,
    /// Dashes of twice the length.
    LongDashed,
}

/// Lengths in dots, alternately drawn and left out.
type Runs = &'static [usize];

impl DashPattern {
    /// Returns the pattern along a line, across and down.
    pub(super) fn runs(self, marker: Marker) -> [Runs; 2] {
        use Marker::{Ascii, Braille, Dot, HalfBlock};
        match (self, marker) {
            (Self::Solid, _) => [&[1], &[1]],
            (Self::Dashed, Braille) => [&[4, 2], &[5, 3]],
            (Self::Dashed, HalfBlock) => [&[2, 1], &[3, 1]],
            (Self::Dashed, Dot | Ascii) => [&[1, 1], &[1, 1]],
            (Self::Dotted, _) => [&[1, 2], &[1, 2]],
            (Self::DashDotted, Braille) => [&[5, 2, 1, 2], &[6, 2, 1, 2]],
            (Self::DashDotted, _) => [&[3, 1, 1, 1], &[3, 1, 1, 1]],
            (Self::LongDashed, Braille) => [&[9, 3], &[10, 4]],
            (Self::LongDashed, _) => [&[5, 1], &[5, 1]],
        }
    }

    /// Returns the character that shows it in a legend.
    pub(super) fn swatch(self) -> char {
        match self {
            Self::Solid => '─',
            Self::Dashed => '╌',
            Self::Dotted => '┈',
            Self::DashDotted => '┄',
            Self::LongDashed => '╴',
        }
    }
}

/// Whether the dot at `place` along a line is drawn.
pub(super) fn draws(runs: Runs, place: usize) -> bool {
    let mut left = place % runs.iter().sum::<usize>().max(1);
    for (k, &run) in runs.iter().enumerate() {
        if left < run {
            return k % 2 == 0;
        }
        left -= run;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_repeat_and_no_two_look_alike() {
        use DashPattern::{DashDotted, Dashed, Dotted, LongDashed, Solid};
        for marker in [
            Marker::Braille,
            Marker::HalfBlock,
            Marker::Dot,
            Marker::Ascii,
        ] {
            let mut seen = Vec::new();
            for stroke in [Solid, Dashed, Dotted, DashDotted, LongDashed] {
                let [across, _] = stroke.runs(marker);
                let drawn: String = (0..40)
                    .map(|i| if draws(across, i) { '#' } else { ' ' })
                    .collect();
                assert!(drawn.starts_with('#') && !seen.contains(&drawn), "{drawn}");
                seen.push(drawn);
            }
        }
    }
}

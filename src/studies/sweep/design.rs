//! Combines the values of several axes into points: every combination, pairwise, or samples that fill the space evenly.

use serde::Deserialize;
use strum::Display;

use super::shuffle::{mix, shuffled};

/// How axes are combined into points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Display)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Design {
    /// Every combination; the last axis changes fastest.
    #[default]
    Grid,
    /// The first values of all axes, then the second ones, and so on.
    Zip,
    /// A Latin hypercube: each axis is cut into as many strata as
    /// there are samples, and each stratum contains one sample.
    LatinHypercube,
    /// A Sobol sequence with Owen's scrambling (Burley 2020, JCGT 9(4)).
    Sobol,
}

impl Design {
    /// Maximum number of samples of a design that draws the values of its axes; an axis then only gives its ends.
    pub fn most_samples(self) -> Option<usize> {
        match self {
            Self::Grid | Self::Zip => None,
            Self::LatinHypercube => Some(MOST_POINTS),
            // The length of the crate's sequences.
            Self::Sobol => Some(1 << 16),
        }
    }
}

/// Maximum number of points of a study.
pub(super) const MOST_POINTS: usize = 10_000_000;

/// Maximum number of axes of a Sobol sequence.
pub(super) const MOST_SOBOL_AXES: usize = 256;

/// How the values of an axis lie between its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spacing {
    /// In order, at equal distances from end to end.
    Even,
    /// At random, one in each stratum; each axis has its own key, so that adding an axis leaves the others unchanged.
    Strata(u64),
    /// As in a Sobol sequence: the dimension of this axis, and the seed.
    Sobol(u32, u32),
}

impl Spacing {
    /// Returns the spacing of axis number `axis` in a design.
    pub(super) fn new(design: Design, axis: usize, seed: u32) -> Self {
        match design {
            Design::Sobol => Self::Sobol(axis as u32, seed),
            _ => Self::Strata(mix((u64::from(seed) << 32) | axis as u64)),
        }
    }

    /// Returns how far (0 to 1) the value at `index` of `count` is from the first end to the second.
    pub(super) fn share(self, index: usize, count: usize) -> f64 {
        match self {
            Self::Even => index as f64 / (count - 1).max(1) as f64,
            Self::Strata(key) => {
                let stratum = shuffled(index, count, key) as f64;
                let within = mix(key ^ mix(stratum as u64)) >> 11;
                (stratum + within as f64 / (1_u64 << 53) as f64) / count as f64
            }
            Self::Sobol(axis, seed) => f64::from(sobol_burley::sample(index as u32, axis, seed)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shares(design: Design, axis: usize, count: usize, seed: u32) -> Vec<f64> {
        let spacing = Spacing::new(design, axis, seed);
        (0..count)
            .map(|index| spacing.share(index, count))
            .collect()
    }

    #[test]
    fn a_latin_hypercube_has_one_sample_in_every_stratum_of_every_axis() {
        for axis in 0..5 {
            let mut shares = shares(Design::LatinHypercube, axis, 40, 7);
            shares.sort_by(f64::total_cmp);
            for (stratum, share) in shares.iter().enumerate() {
                assert_eq!((share * 40.0) as usize, stratum);
            }
        }
    }

    #[test]
    fn a_sobol_sequence_fills_every_square_of_a_power_of_two_once() {
        let mut filled = [false; 64];
        let axis = |axis| shares(Design::Sobol, axis, 64, 3);
        for (x, y) in axis(0).into_iter().zip(axis(1)) {
            let square = (x * 8.0) as usize * 8 + (y * 8.0) as usize;
            assert!(!filled[square], "two samples in square {square}");
            filled[square] = true;
        }
    }

    #[test]
    fn samples_hang_on_the_seed_alone() {
        for design in [Design::LatinHypercube, Design::Sobol] {
            let drawn = |axis, seed| shares(design, axis, 16, seed);
            assert_eq!(drawn(1, 5), drawn(1, 5));
            assert!(drawn(1, 5) != drawn(1, 6) && drawn(0, 5) != drawn(1, 5));
        }
    }
}

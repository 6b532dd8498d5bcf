//! Combines the values of several axes into points: every combination, pairwise, or samples that
//! fill the space evenly.

use serde::Deserialize;
use strum::IntoStaticStr;

use super::shuffle::{Shuffle, mix};

/// The way from axes to points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, IntoStaticStr)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Design {
    /// Every combination; the last axis changes fastest.
    #[default]
    Grid,
    /// The first values of all axes, then the second ones, and so on.
    Zip,
    /// A Latin hypercube: each axis is cut into as many strata as there are samples, and each
    /// stratum holds one of them.
    LatinHypercube,
    /// A Sobol sequence with Owen's scrambling (Burley 2020, JCGT 9(4)).
    Sobol,
}

impl Design {
    /// The name in study files.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The most samples of a design that draws the values of its axes, so that an axis names its ends alone.
    pub fn most_samples(self) -> Option<usize> {
        match self {
            Self::Grid | Self::Zip => None,
            Self::LatinHypercube => Some(10_000_000),
            // The length of the crate's sequences.
            Self::Sobol => Some(1 << 16),
        }
    }
}

/// The most axes of a Sobol sequence.
pub(super) const MOST_SOBOL_AXES: usize = 256;

/// The shares (0 to 1) of one axis in `samples` samples of a Sobol sequence.
pub(super) fn sobol(axis: usize, samples: usize, seed: u32) -> impl Iterator<Item = f64> {
    let share = move |sample: usize| sobol_burley::sample(sample as u32, axis as u32, seed);
    (0..samples).map(move |sample| f64::from(share(sample)))
}

/// The samples of one axis of a Latin hypercube.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Strata {
    samples: usize,
    /// Each axis has its own key, so that adding one leaves the others unchanged.
    key: u64,
    order: Shuffle,
}

impl Strata {
    pub(super) fn new(axis: usize, samples: usize, seed: u32) -> Self {
        let key = mix((u64::from(seed) << 32) | axis as u64);
        Self {
            samples,
            key,
            order: Shuffle::new(samples, key),
        }
    }

    /// The number of samples.
    pub(super) fn len(self) -> usize {
        self.samples
    }

    /// The share (0 to 1) of a sample: somewhere in its stratum.
    pub(super) fn share(self, sample: usize) -> f64 {
        let stratum = self.order.of(sample);
        let within = mix(self.key ^ mix(stratum as u64)) >> 11;
        (stratum as f64 + within as f64 / (1_u64 << 53) as f64) / self.samples as f64
    }

    /// The sample in a stratum.
    pub(super) fn sample_in(self, stratum: usize) -> usize {
        self.order.back(stratum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_latin_hypercube_has_one_sample_in_every_stratum_of_every_axis() {
        for axis in 0..5 {
            let strata = Strata::new(axis, 40, 7);
            let mut shares: Vec<f64> = (0..40).map(|sample| strata.share(sample)).collect();
            for (sample, share) in shares.iter().enumerate() {
                assert_eq!(strata.sample_in((share * 40.0) as usize), sample);
            }
            shares.sort_by(f64::total_cmp);
            for (stratum, share) in shares.iter().enumerate() {
                assert_eq!((share * 40.0) as usize, stratum);
            }
        }
    }

    #[test]
    fn a_sobol_sequence_fills_every_square_of_a_power_of_two_once() {
        let mut filled = [false; 64];
        for (x, y) in sobol(0, 64, 3).zip(sobol(1, 64, 3)) {
            let square = (x * 8.0) as usize * 8 + (y * 8.0) as usize;
            assert!(!filled[square], "two samples in square {square}");
            filled[square] = true;
        }
    }

    #[test]
    fn samples_hang_on_the_seed_alone() {
        let latin = |axis, seed| {
            let strata = Strata::new(axis, 16, seed);
            (0..16).map(|sample| strata.share(sample)).collect()
        };
        let drawn =
            |axis, seed| -> [Vec<f64>; 2] { [latin(axis, seed), sobol(axis, 16, seed).collect()] };
        assert_eq!(drawn(1, 5), drawn(1, 5));
        for (one, other) in [(drawn(1, 5), drawn(1, 6)), (drawn(0, 5), drawn(1, 5))] {
            assert!(one[0] != other[0] && one[1] != other[1]);
        }
    }
}

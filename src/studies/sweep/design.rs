//! Combines the values of several axes into points: every combination, in pairs, or samples that fill the space evenly.

use serde::Deserialize;

/// How axes are combined into points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Design {
    /// Every combination; the last axis changes fastest.
    #[default]
    Grid,
    /// The first values of all axes, then the second ones, and so on.
    Zip,
    /// A Sobol sequence with Owen's scrambling (Burley 2020, JCGT 9(4)) between the ends of the axes.
    Sobol,
}

/// Maximum number of points of a study.
pub(super) const MOST_POINTS: usize = 10_000_000;

/// The length of the crate's Sobol sequences, and the number of their axes.
pub(super) const MOST_SAMPLES: usize = 1 << 16;
pub(super) const MOST_SAMPLED_AXES: usize = 256;

/// Returns how far (0 to 1) sample `index` is along axis number `axis` of a Sobol sequence.
pub(super) fn sample(index: usize, axis: usize, seed: u32) -> f64 {
    f64::from(sobol_burley::sample(index as u32, axis as u32, seed))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(axis: usize, count: usize, seed: u32) -> Vec<f64> {
        (0..count).map(|index| sample(index, axis, seed)).collect()
    }

    #[test]
    fn samples_fill_every_square_of_a_power_of_two_once() {
        let mut filled = [false; 64];
        for (x, y) in samples(0, 64, 3).into_iter().zip(samples(1, 64, 3)) {
            let square = (x * 8.0) as usize * 8 + (y * 8.0) as usize;
            assert!(!filled[square], "two samples in square {square}");
            filled[square] = true;
        }
    }

    #[test]
    fn samples_depend_on_the_seed_alone() {
        let drawn = |axis, seed| samples(axis, 16, seed);
        assert_eq!(drawn(1, 5), drawn(1, 5));
        assert!(drawn(1, 5) != drawn(1, 6) && drawn(0, 5) != drawn(1, 5));
    }
}

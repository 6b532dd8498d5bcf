//! Combines the values of several axes into points: every combination, pairwise, or samples that
//! fill the space evenly.

use super::axis::Spread;

/// The way from axes to points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Design {
    /// Every combination; the last axis changes fastest.
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
    /// All designs.
    pub const ALL: [Self; 4] = [Self::Grid, Self::Zip, Self::LatinHypercube, Self::Sobol];

    /// The name in study files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Grid => "grid",
            Self::Zip => "zip",
            Self::LatinHypercube => "latin-hypercube",
            Self::Sobol => "sobol",
        }
    }

    /// Whether the values of the axes are drawn, so that an axis names its ends alone.
    pub fn is_sampled(self) -> bool {
        matches!(self, Self::LatinHypercube | Self::Sobol)
    }

    /// The most samples of a sampled design.
    pub fn most_samples(self) -> usize {
        match self {
            // The length of the crate's sequences.
            Self::Sobol => 1 << 16,
            _ => 10_000_000,
        }
    }
}

/// The most axes of a Sobol sequence.
pub(super) const MOST_SOBOL_AXES: usize = 256;

/// Returns the shares (0 to 1) of one axis in `samples` samples of a sampled design; the same for
/// the same `seed`.
pub(super) fn shares(design: Design, axis: usize, samples: usize, seed: u32) -> Vec<f64> {
    match design {
        Design::Sobol => {
            let set = |sample: usize| sobol_burley::sample(sample as u32, axis as u32, seed);
            (0..samples).map(|sample| f64::from(set(sample))).collect()
        }
        _ => {
            // Each axis has a generator of its own, so that adding one leaves the others as they are.
            let seed = (u64::from(seed) << 32) | axis as u64;
            let mut random = fastrand::Rng::with_seed(seed);
            let mut strata: Vec<usize> = (0..samples).collect();
            random.shuffle(&mut strata);
            let within = |stratum: usize| (stratum as f64 + random.f64()) / samples as f64;
            strata.into_iter().map(within).collect()
        }
    }
}

/// How the values of an axis are spread if its ends are given under this name.
pub(super) fn spread_of(name: &str) -> Spread {
    match name {
        "logspace" => Spread::Logarithmic,
        _ => Spread::Linear,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        let (x, y) = (
            shares(Design::Sobol, 0, 64, 3),
            shares(Design::Sobol, 1, 64, 3),
        );
        let mut filled = [false; 64];
        for (x, y) in x.iter().zip(&y) {
            let square = (x * 8.0) as usize * 8 + (y * 8.0) as usize;
            assert!(!filled[square], "two samples in square {square}");
            filled[square] = true;
        }
    }

    #[test]
    fn samples_hang_on_the_seed_alone() {
        for design in [Design::LatinHypercube, Design::Sobol] {
            assert_eq!(shares(design, 1, 16, 5), shares(design, 1, 16, 5));
            assert_ne!(shares(design, 1, 16, 5), shares(design, 1, 16, 6));
            assert_ne!(shares(design, 0, 16, 5), shares(design, 1, 16, 5));
        }
    }
}

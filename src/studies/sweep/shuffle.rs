//! A random order of many places of which any one is known without the others.

/// A permutation of the numbers below `length`, one for each key: a Feistel network of four rounds on
/// the next even number of bits, walked until it comes back below `length`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Shuffle {
    length: u64,
    /// Bits of a half.
    bits: u32,
    key: u64,
}

/// Enough for what looks random.
const ROUNDS: u64 = 4;

impl Shuffle {
    pub fn new(length: usize, key: u64) -> Self {
        let length = length as u64;
        let bits = (u64::BITS - length.saturating_sub(1).leading_zeros()).div_ceil(2);
        Self {
            length,
            bits: bits.max(1),
            key,
        }
    }

    /// Where `place` goes.
    pub fn of(self, place: usize) -> usize {
        self.walk(place, |place| {
            (0..ROUNDS).fold(place, |place, round| {
                let (high, low) = self.halves(place);
                (low << self.bits) | (high ^ self.mixed(low, round))
            })
        })
    }

    /// What goes to `place`: the inverse of [`of`](Self::of).
    pub fn back(self, place: usize) -> usize {
        self.walk(place, |place| {
            (0..ROUNDS).rev().fold(place, |place, round| {
                let (high, low) = self.halves(place);
                ((low ^ self.mixed(high, round)) << self.bits) | high
            })
        })
    }

    fn walk(self, place: usize, step: impl Fn(u64) -> u64) -> usize {
        let mut place = step(place as u64);
        while place >= self.length {
            place = step(place);
        }
        place as usize
    }

    fn halves(self, place: u64) -> (u64, u64) {
        (place >> self.bits, place & self.mask())
    }

    fn mask(self) -> u64 {
        (1 << self.bits) - 1
    }

    fn mixed(self, half: u64, round: u64) -> u64 {
        mix(self.key ^ mix(half ^ (round << 32))) & self.mask()
    }
}

/// The finalizer of SplitMix64 (Steele, Lea and Flood 2014): a number that looks random.
pub(super) fn mix(number: u64) -> u64 {
    let mut z = number.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_is_taken_once_and_found_again() {
        for length in [1, 2, 3, 7, 64, 100, 1000] {
            for key in 0..20 {
                let shuffle = Shuffle::new(length, mix(key));
                let mut found: Vec<usize> = (0..length).map(|place| shuffle.of(place)).collect();
                for (place, &to) in found.iter().enumerate() {
                    assert_eq!(shuffle.back(to), place);
                }
                found.sort_unstable();
                assert_eq!(found, (0..length).collect::<Vec<_>>());
            }
        }
    }

    #[test]
    fn neighbours_are_torn_apart() {
        // The correlation of neighbouring places of a random order is about 1/√n.
        let shuffle = Shuffle::new(10_000, 7);
        let share = |place: usize| shuffle.of(place) as f64 / 1e4 - 0.5;
        let sum: f64 = (1..10_000).map(|at| share(at) * share(at - 1)).sum();
        assert!((12.0 * sum / 1e4).abs() < 0.05, "{}", 12.0 * sum / 1e4);
    }
}

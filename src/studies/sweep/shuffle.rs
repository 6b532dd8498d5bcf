//! A random permutation with O(1) access (Feistel network).

/// Enough rounds to look random.
const ROUNDS: u64 = 4;

/// Returns the position of `place` in a random permutation of `length` elements, which depends on `key`: a Feistel
/// network of four rounds on the next even number of bits, repeated until the result is below `length`.
pub(super) fn shuffled(place: usize, length: usize, key: u64) -> usize {
    let bits = usize::BITS - length.saturating_sub(1).leading_zeros();
    // Bits per half.
    let bits = bits.div_ceil(2).max(1);
    let mask = (1 << bits) - 1;
    let round = |place: u64, round: u64| {
        let (high, low) = (place >> bits, place & mask);
        (low << bits) | (high ^ mix(key ^ mix(low ^ (round << 32))) & mask)
    };
    let mut place = place as u64;
    loop {
        place = (0..ROUNDS).fold(place, round);
        if place < length as u64 {
            return place as usize;
        }
    }
}

/// Mixes a number into one that looks random, by the finalizer of SplitMix64 (Steele, Lea and Flood 2014).
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
    fn every_place_is_taken_once() {
        for length in [1, 2, 3, 7, 64, 100, 1000] {
            for key in (0..20).map(mix) {
                let found = (0..length).map(|place| shuffled(place, length, key));
                let mut found: Vec<usize> = found.collect();
                found.sort_unstable();
                assert_eq!(found, (0..length).collect::<Vec<_>>());
            }
        }
    }

    #[test]
    fn neighbours_are_torn_apart() {
        // Neighbouring places of a random permutation have a correlation of about 1/√n.
        let share = |place: usize| shuffled(place, 10_000, 7) as f64 / 1e4 - 0.5;
        let sum: f64 = (1..10_000).map(|at| share(at) * share(at - 1)).sum();
        assert!((12.0 * sum / 1e4).abs() < 0.05, "{}", 12.0 * sum / 1e4);
    }
}

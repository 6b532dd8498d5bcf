//! Properties of a trace over a scar: where its middle is, and the sign of its wear.

/// Number of candidates for the middle of a trace.
const PLACES: usize = 200;

/// Fraction of a trace, at either end, taken as unworn in finding its sign.
const OUTER: usize = 10;

/// The centre cannot lie within this fraction of either end: one side of a ring is nearly symmetric, too.
const NO_CENTRE: f64 = 0.35;

/// Finds the centre of a trace that is symmetric except for noise: where both sides differ least. The abscissae rise.
/// From worn depths, the line through both ends is subtracted first.
pub fn centre(x: &[f64], values: &[f64], is_worn: bool) -> f64 {
    let (first, last) = (x[0], x[x.len() - 1]);
    let length = last - first;
    let outer = (x.len() / 20).max(1);
    let mean_of = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let rise = mean_of(&values[values.len() - outer..]) - mean_of(&values[..outer]);
    let slope = if is_worn {
        rise / (length * (1.0 - outer as f64 / x.len() as f64))
    } else {
        0.0
    };
    let levelled: Vec<f64> = x
        .iter()
        .zip(values)
        .map(|(x, value)| value - slope * (x - first))
        .collect();
    let values = &levelled[..];
    let mean = mean_of(values);
    let at = |place: f64| {
        let above = x.partition_point(|&x| x < place).clamp(1, x.len() - 1);
        let width = x[above] - x[above - 1];
        let share = if width > 0.0 {
            (place - x[above - 1]) / width
        } else {
            0.0
        };
        values[above - 1] + share * (values[above] - values[above - 1])
    };
    // Squared differences of both sides, relative to their squared distances from the mean.
    let asymmetry = |centre: f64| {
        let reach = (centre - first).min(last - centre);
        let pairs = (0..=PLACES).map(|i| reach * i as f64 / PLACES as f64);
        let pairs = pairs.map(|t| (at(centre + t) - mean, at(centre - t) - mean));
        let (odd, size) = pairs.fold((0.0, 0.0), |(odd, size), (right, left)| {
            (
                odd + (right - left).powi(2),
                size + right * right + left * left,
            )
        });
        odd / size
    };
    let places = (0..=PLACES)
        .map(|i| first + length * (NO_CENTRE + (1.0 - 2.0 * NO_CENTRE) * i as f64 / PLACES as f64));
    let scored = places.map(|place| (place, asymmetry(place)));
    scored
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map_or(0.0, |(place, _)| place)
}

/// Whether depths count downwards: most of them lie below zero and below the ends of the trace.
pub(super) fn is_downwards(x: &[f64], values: &[f64]) -> bool {
    let outer = (values.len() / OUTER).max(1);
    let is_half = x[0] > -0.2 * x[x.len() - 1];
    let ends = values[values.len() - outer..]
        .iter()
        .chain(values[..outer].iter().filter(|_| !is_half));
    let mut ends: Vec<f64> = ends.copied().collect();
    ends.sort_by(f64::total_cmp);
    let base = ends[ends.len() / 2];
    // Averages neighbours, to reduce noise.
    let smooth = values
        .windows(outer.min(5))
        .map(|part| part.iter().sum::<f64>() / part.len() as f64 - base);
    let [low, high] = crate::math::scan::range(smooth).unwrap_or_default();
    -low > 2.0 * high && values.iter().sum::<f64>() < 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trace(middle: f64, sign: f64) -> (Vec<f64>, Vec<f64>) {
        let x: Vec<f64> = (0..121).map(|i| f64::from(i) - 60.0).collect();
        let ring = |x: &f64| sign * (-((x - middle).abs() - 25.0).powi(2) / 40.0).exp();
        let values = x.iter().map(ring).collect();
        (x, values)
    }

    #[test]
    fn the_middle_of_a_ring_is_found_from_both_sides() {
        for middle in [-12.0, 0.0, 7.0] {
            let (x, values) = trace(middle, 1.0);
            assert!((centre(&x, &values, true) - middle).abs() < 0.5);
            let tilted: Vec<f64> = x
                .iter()
                .zip(&values)
                .map(|(x, value)| value + 0.01 * x)
                .collect();
            assert!((centre(&x, &tilted, true) - middle).abs() < 1.0);
            let bowl: Vec<f64> = x.iter().map(|x| (x - middle).powi(2)).collect();
            assert!((centre(&x, &bowl, false) - middle).abs() < 0.5);
        }
    }

    #[test]
    fn the_sign_of_wear_is_seen() {
        for (sign, expected) in [(1.0, false), (-1.0, true)] {
            let (x, values) = trace(0.0, sign);
            assert_eq!(is_downwards(&x, &values), expected);
            assert_eq!(is_downwards(&x[60..], &values[60..]), expected);
        }
    }
}

//! How much of a profile's ups and downs is teeth.

/// The total variation of `values` above that of their envelope, the median of every five neighbours:
/// peaks and gaps one or two nodes wide, whatever the shape on which they stand. Monotone values have
/// none, a single tooth of height 1 has 2.
///
/// Known failure: an even comb, every second node by one height, is its own median and is seen at its ends
/// alone.
pub fn teeth(values: &[f64]) -> f64 {
    let last = values.len().saturating_sub(1);
    let envelope: Vec<f64> = (0..values.len())
        .map(|j| {
            // At the ends fewer neighbours on both sides, so that a slope stays as it is.
            let reach = 2.min(j).min(last - j);
            let mut near = values[j - reach..=j + reach].to_vec();
            near.sort_by(f64::total_cmp);
            near[reach]
        })
        .collect();
    (variation(values) - variation(&envelope)).max(0.0)
}

fn variation(values: &[f64]) -> f64 {
    values
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).abs())
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_and_hills_have_no_teeth_and_each_tooth_counts_twice() {
        let slope: Vec<f64> = (0..40).map(|j| f64::from(j) * 0.1).collect();
        assert_eq!(teeth(&slope), 0.0);
        let step: Vec<f64> = (0..40).map(|j| f64::from(u8::from(j > 20))).collect();
        assert_eq!(teeth(&step), 0.0);
        let hill = |j: i32| 1.0 - (f64::from(j - 20) / 20.0).powi(2);
        let hills: Vec<f64> = (0..40).map(hill).collect();
        assert!(teeth(&hills) < 0.03, "{}", teeth(&hills));
        let mut toothed = slope.clone();
        for j in [10, 20, 30] {
            toothed[j] += 1.0;
        }
        assert!((teeth(&toothed) - 6.0).abs() < 0.7, "{}", teeth(&toothed));
        assert_eq!(teeth(&[]), 0.0);
        assert_eq!(teeth(&[1.0]), 0.0);
    }
}

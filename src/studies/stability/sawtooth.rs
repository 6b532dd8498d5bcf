//! Measures the height of a sawtooth in a profile.
//!
//! # Formula
//!
//! With the second differences D_j = v_{j−1} − 2v_j + v_{j+1} of the nodal values, the sawtooth
//! around a node where D changes its sign twice, from the node before and to the node after, has
//! the height
//!
//! ```text
//! ½ min(|D_{j−1}|, |D_j|, |D_{j+1}|)       the height of the sawtooth is the largest of these
//! ```
//!
//! A regular comb, every second node higher by H, has D = ±2H and so a sawtooth of height H. A kink, as at the stick
//! border and at the contact edge, is one large D among small ones, and a jump is two: neither counts as a sawtooth.

/// Returns the height of the highest sawtooth in `values`, from peak to valley, in their unit; 0 if they are smooth.
pub fn sawtooth(values: &[f64]) -> f64 {
    let bends = values.windows(3).map(|v| (v[0] - v[1]) + (v[2] - v[1]));
    let bends: Vec<f64> = bends.collect();
    let turns = bends
        .windows(3)
        .filter(|d| d[0] * d[1] < 0.0 && d[1] * d[2] < 0.0);
    let heights = turns.map(|d| 0.5 * d[0].abs().min(d[1].abs()).min(d[2].abs()));
    heights.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A limiting profile on equal cells: unworn inside the border, a root outside it, a kink where the worn zone ends.
    fn worn(cells: i32) -> Vec<f64> {
        let radius = |j: i32| f64::from(j) * 1.5 / f64::from(cells);
        let depth = |r: f64| {
            (0.8 * (r * r - 0.16_f64).max(0.0).sqrt())
                .min(1.4 - r)
                .max(0.0)
        };
        (0..=cells).map(|j| depth(radius(j))).collect()
    }

    /// Raises every `pitch`-th node from `from` to `to` by `height`.
    fn comb(values: &[f64], from: usize, to: usize, pitch: usize, height: f64) -> Vec<f64> {
        let mut swinging = values.to_vec();
        for j in (from..to).step_by(pitch) {
            swinging[j] += height;
        }
        swinging
    }

    #[test]
    fn smooth_profiles_with_kinks_and_jumps_have_none() {
        for cells in [25, 60, 100, 200, 1000] {
            assert!(sawtooth(&worn(cells)) < 1e-15, "{cells}");
        }
        let jump: Vec<f64> = (0..40).map(|j| f64::from(u8::from(j > 20))).collect();
        assert_eq!(sawtooth(&jump), 0.0);
        let hills: Vec<f64> = (0..100).map(|j| (0.2 * f64::from(j)).sin()).collect();
        assert_eq!(sawtooth(&hills), 0.0);
        for few in 0..5 {
            assert_eq!(sawtooth(&vec![1.0; few]), 0.0);
        }
    }

    #[test]
    fn an_even_comb_is_as_high_as_it_is() {
        for height in [1e-3, 0.1, 3.0] {
            let found = sawtooth(&comb(&[0.5; 60], 10, 50, 2, height));
            assert!((found / height - 1.0).abs() < 1e-9, "{height}: {found}");
        }
    }

    /// One spike has second differences of H, −2H and H.
    #[test]
    fn a_single_tooth_counts_half() {
        let slope: Vec<f64> = (0..60).map(|j| f64::from(j) * 0.1).collect();
        for pitch in [3, 5, 100] {
            let found = sawtooth(&comb(&slope, 30, 50, pitch, 1.0));
            assert!((found - 0.5).abs() < 1e-9, "{pitch}: {found}");
        }
    }

    #[test]
    fn small_combs_are_seen_on_a_worn_profile() {
        for pitch in [2, 3] {
            let found = sawtooth(&comb(&worn(100), 40, 80, pitch, 2e-3));
            assert!((0.4e-3..2.1e-3).contains(&found), "{pitch}: {found}");
        }
        // One sawtooth at the border and one at the end of the worn zone.
        for from in [26, 66] {
            let found = sawtooth(&comb(&worn(100), from, from + 8, 2, 0.2));
            assert!(found > 0.1, "{from}: {found}");
        }
    }
}

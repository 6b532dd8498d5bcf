//! What accuracy costs: the N and the steps a cycle of the default method for an error, and the error
//! for an N. Known beforehand, so that nothing is searched when a run begins.
//!
//! The error is the rms error of the worn profile at the end of a run, in largest depths. `mdr-tui trade`
//! on strong-wear, cone, two-frequencies, limit-shape and li2019-fig3 finds, in the worst of them:
//!
//! | N | 12 | 25 | 50 | 100 | 200 | 400 |
//! |---|---|---|---|---|---|---|
//! | error | 1.4e-2 | 2.9e-3 | 1.1e-3 | 3.8e-4 | 1.1e-4 | 2.5e-5 |
//! | steps a cycle that are enough | 12 | 12 | 12 | 25 | 25 | 50 |

/// The accuracies that keys step through, the coarsest first; those in between can be asked for as well.
pub const RUNGS: [f64; 9] = [0.1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5];

/// N for an error of 1e-3, and how fast it grows.
const POINTS: (f64, f64) = (57.0, 0.56);

/// The same for the steps a cycle.
const STEPS: (f64, f64) = (14.0, 0.45);

/// The fewest that are any good.
const FEWEST: (f64, f64) = (8.0, 12.0);

/// N and the steps a cycle whose worn profile errs by `accuracy` at most.
pub(super) fn choices(accuracy: f64) -> (i64, i64) {
    let finer = 1e-3 / accuracy;
    let points = (POINTS.0 * finer.powf(POINTS.1)).ceil().max(FEWEST.0);
    let steps = (STEPS.0 * finer.powf(STEPS.1)).ceil().max(FEWEST.1);
    (points as i64, steps as i64)
}

/// The error to expect of N cells.
pub fn expected(points: usize) -> f64 {
    1e-3 * (POINTS.0 / points as f64).powf(1.0 / POINTS.1)
}

/// The rung `places` further on, to finer ones if positive, from the one nearest to `accuracy`; the last one
/// at the end of the ladder.
pub fn rung(accuracy: f64, places: isize) -> f64 {
    let distance = |rung: f64| (rung / accuracy).ln().abs();
    let nearest = (0..RUNGS.len())
        .min_by(|&a, &b| distance(RUNGS[a]).total_cmp(&distance(RUNGS[b])))
        .unwrap_or(0);
    let at = nearest as isize + places;
    RUNGS[at.clamp(0, RUNGS.len() as isize - 1) as usize]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finer_is_dearer_and_expected_to_be_finer() {
        for pair in RUNGS.windows(2) {
            let (coarse, fine) = (choices(pair[0]), choices(pair[1]));
            assert!(coarse.0 < fine.0 && coarse.1 <= fine.1, "{pair:?}");
        }
        assert_eq!(choices(1e-2), (16, 12));
        assert_eq!(choices(1e-3), (57, 14));
        assert_eq!(choices(1e-4), (207, 40));
        for accuracy in [1e-2, 1e-3, 1e-4] {
            let expected = expected(choices(accuracy).0 as usize);
            assert!(
                expected <= accuracy && expected > 0.9 * accuracy,
                "{expected}"
            );
        }
        // What the table in the header says, within a factor of two.
        for (points, error) in [(12, 1.4e-2), (50, 1.1e-3), (200, 1.1e-4), (400, 2.5e-5)] {
            let ratio = expected(points) / error;
            assert!((0.5..2.0).contains(&ratio), "N = {points}: {ratio}");
        }
    }

    #[test]
    fn the_ladder_ends() {
        assert_eq!(rung(expected(100), 0), 3e-4);
        assert_eq!(rung(1e-3, 1), 3e-4);
        assert_eq!(rung(1e-3, -2), 1e-2);
        assert_eq!(rung(0.1, -1), 0.1);
        assert_eq!(rung(1e-5, 1), 1e-5);
    }
}

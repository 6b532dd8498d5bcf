//! Zeros, centre and tilt of a data set: what an instrument adds to its measurements.
//!
//! They cost no run, so they are fitted separately for each set of keys (variable projection: G. H. Golub, V. Pereyra,
//! 1973, SIAM J. Numer. Anal. 10, 413–432), here by Gauss–Newton with halved steps.

use nalgebra::{Matrix3, Vector3};

use super::model::Prediction;
use crate::math::scan::range;
use crate::studies::measured::Measured;

/// Names of the three in reports, for a scar and for other data.
pub const NAMES: [[&str; 2]; 3] = [["baseline", "level"], ["centre", "shift"], ["tilt", "tilt"]];

/// Maximum number of steps of a search.
const MOST_STEPS: usize = 40;

/// A search ends when a step changes the sum of squares by less than this fraction.
const ENOUGH: f64 = 1e-10;

/// Which of level, shift and tilt are fitted to a data set, and where their search begins.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Nuisances {
    pub active: [bool; 3],
    pub start: [f64; 3],
}

/// Step of the shift for its derivative, relative to the range of the abscissae.
const STEP: f64 = 2e-4;

/// Returns ∂(simulated)/∂(nuisance) of each active one, by central differences.
pub(super) fn derivatives(
    set: &Measured,
    response: &Prediction,
    at: [f64; 3],
    active: [bool; 3],
) -> Vec<Vec<f64>> {
    let [least, most] = range(set.at.iter().copied()).unwrap_or_default();
    let column = |k: usize| match k {
        0 => vec![1.0; set.at.len()],
        1 => {
            let step = STEP * (most - least);
            let moved = |sign: f64| response.at(set, [at[0], at[1] + sign * step, at[2]]);
            moved(1.0)
                .iter()
                .zip(moved(-1.0))
                .map(|(b, a)| (b - a) / (2.0 * step))
                .collect()
        }
        _ => set.at.clone(),
    };
    (0..3).filter(|&k| active[k]).map(column).collect()
}

impl Nuisances {
    /// Finds the values that fit best, with the simulated values;
    /// `weigh` returns the weighted deviations of simulated values.
    pub fn solve(
        &self,
        set: &Measured,
        response: &Prediction,
        weigh: &dyn Fn(&[f64]) -> Vec<f64>,
    ) -> ([f64; 3], Vec<f64>) {
        let squares = |values: &[f64]| weigh(values).iter().map(|z| z * z).sum::<f64>();
        let mut at = self.start;
        let mut values = response.at(set, at);
        let mut sum = squares(&values);
        if !self.active.contains(&true) {
            return (at, values);
        }
        let places: Vec<usize> = (0..3).filter(|&k| self.active[k]).collect();
        for _ in 0..MOST_STEPS {
            let z = weigh(&values);
            // dz = −weight · d(simulated): a small change reveals the weights.
            let columns = derivatives(set, response, at, self.active);
            let scale: Vec<f64> = columns
                .iter()
                .map(|column| column.iter().map(|d| d * d).sum::<f64>().sqrt())
                .collect();
            let size = values
                .iter()
                .fold(f64::MIN_POSITIVE, |size, value| size.max(value.abs()));
            let small = 1e-6 * size;
            let slopes: Vec<Vec<f64>> = columns
                .iter()
                .zip(&scale)
                .map(|(column, scale)| {
                    let moved: Vec<f64> = values
                        .iter()
                        .zip(column)
                        .map(|(value, d)| value + small * d / scale)
                        .collect();
                    weigh(&moved)
                        .iter()
                        .zip(&z)
                        .map(|(b, a)| (b - a) / small)
                        .collect()
                })
                .collect();
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let mut normal = Matrix3::identity();
            let mut gradient = Vector3::zeros();
            for (i, a) in slopes.iter().enumerate() {
                gradient[i] = dot(a, &z);
                for (j, b) in slopes.iter().enumerate() {
                    normal[(i, j)] = dot(a, b);
                }
                normal[(i, i)] *= 1.0 + 1e-9;
            }
            let Some(step) = normal.lu().solve(&gradient) else {
                break;
            };
            let tried = (0..8)
                .map(|halving| 0.5f64.powi(halving))
                .find_map(|share| {
                    let mut next = at;
                    for (i, &k) in places.iter().enumerate() {
                        next[k] -= share * step[i] / scale[i];
                    }
                    let values = response.at(set, next);
                    let found = squares(&values);
                    (found < sum).then_some((next, values, found))
                });
            let Some((next, found, less)) = tried else {
                break;
            };
            let gain = sum - less;
            (at, values, sum) = (next, found, less);
            if gain <= ENOUGH * sum {
                break;
            }
        }
        (at, values)
    }
}

//! Where a search begins: at the start values, and around them where they lead nowhere.

use std::f64::consts::LN_10;

use anyhow::{Result, anyhow};

use super::search::{Found, Search, residuals};
use super::structure::Structure;

/// Starts that are tried around the given ones, in e-folds of each key: factors of 10 and 100.
const STARTS: [f64; 5] = [0.0, -LN_10, LN_10, -2.0 * LN_10, 2.0 * LN_10];

/// Maximum number of keys varied together when looking for a start; more are varied in turn.
const TOGETHER: usize = 2;

/// Starts from which the minimum is sought.
const BEST_STARTS: usize = 2;

impl Search<'_> {
    /// The minimum from the best of the starts, or from the next best where that leaves more than noise.
    ///
    /// # Errors
    /// A scenario that cannot run with its start values nor near them, and a search that fails.
    pub fn locate(&mut self, start: &[f64]) -> Result<Found> {
        let mut best = match self.evaluate(start) {
            Ok(_) => Err(anyhow!("no minimum was found")),
            Err(error) => Err(anyhow!("at the start values: {error}")),
        };
        let starts = self.starts(start).into_iter();
        let mut starts: Vec<(f64, Vec<f64>)> = starts
            .filter_map(|theta| Some((self.evaluate(&theta).ok()?.objective, theta)))
            .collect();
        starts.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (first, mut errors) = (self.errors.clone(), self.errors.clone());
        for (_, theta) in starts.into_iter().take(BEST_STARTS) {
            self.errors.clone_from(&first);
            let found = self.descend(&theta);
            let is_better = |found: &Found| {
                let best = best.as_ref();
                !best.is_ok_and(|best: &Found| best.objective <= found.objective)
            };
            if best.is_err() || found.as_ref().is_ok_and(is_better) {
                (best, errors) = (found, self.errors.clone());
            }
            if best
                .as_ref()
                .is_ok_and(|best| self.is_inside(best) && self.is_noise(best))
            {
                break;
            }
        }
        self.errors = errors;
        best
    }

    /// Whether no key has run into the end of its range.
    fn is_inside(&self, found: &Found) -> bool {
        let mut keys = self.fit.free.iter().zip(&found.theta);
        keys.all(|(free, theta)| !free.is_at_bound(*theta))
    }

    /// Values of the keys from which a search may begin.
    fn starts(&self, start: &[f64]) -> Vec<Vec<f64>> {
        let mut all = vec![start.to_vec()];
        for (i, free) in self.fit.free.iter().enumerate() {
            let around = |theta: &Vec<f64>| {
                let moved = STARTS.iter().map(|&step| free.moved(theta[i], step));
                let moved = moved.map(|value| {
                    let mut theta = theta.clone();
                    theta[i] = value;
                    theta
                });
                moved.collect::<Vec<_>>()
            };
            if i < TOGETHER {
                all = all.iter().flat_map(around).collect()
            } else {
                all.extend(around(&start.to_vec()))
            }
        }
        all
    }

    /// Whether the residuals of all data sets may be noise.
    pub fn is_noise(&self, found: &Found) -> bool {
        let mut sets = self.fit.data.iter().zip(&found.simulated);
        sets.all(|(set, simulated)| {
            let left = residuals(set, simulated);
            let freedom = left.len().saturating_sub(found.theta.len()).max(1) as f64;
            Structure::new(&left, set.errors.as_deref(), freedom).is_noise()
        })
    }
}

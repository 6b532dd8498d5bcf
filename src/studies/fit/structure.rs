//! Tests whether residuals are noise: compares their size with
//! neighbouring differences, and counts runs of their signs.

use serde::Serialize;

/// Statistics of the residuals of a data set.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Structure {
    /// χ² per degree of freedom: by the errors of the file, or by the noise between neighbouring residuals.
    pub chi_squared: f64,
    /// Probability of so large a χ² by chance, given that noise; 0 with the errors of the file.
    pub chi_squared_probability: f64,
    /// Runs of one sign.
    pub runs: usize,
    /// Expected number of runs by chance.
    pub expected_runs: f64,
    /// Probability of so few runs by chance.
    pub probability: f64,
}

/// χ² per degree of freedom above which a remark is made.
const MOST_CHI_SQUARED: f64 = 2.0;

/// Probability of the runs below which a remark is made.
const LEAST_PROBABILITY: f64 = 1e-3;

/// Returns the probability of a normal value below `z`.
fn below(z: f64) -> f64 {
    0.5 * libm::erfc(-z / std::f64::consts::SQRT_2)
}

impl Structure {
    /// Tests residuals in the order of the points, with their given errors and so many degrees of `freedom`.
    pub fn new(residuals: &[f64], errors: Option<&[f64]>, freedom: f64) -> Self {
        let squares =
            |values: &mut dyn Iterator<Item = f64>| values.map(|value| value * value).sum::<f64>();
        let pairs = residuals.len().saturating_sub(1).max(1) as f64;
        let count = residuals.len() as f64;
        let (chi_squared, chi_squared_probability) = match errors {
            Some(errors) => {
                let mut z = residuals
                    .iter()
                    .zip(errors)
                    .map(|(left, error)| left / error);
                (squares(&mut z) / freedom, 0.0)
            }
            // J. von Neumann (1941), Ann. Math. Stat. 12, 367–395: half the mean square of differences.
            None => {
                let differences = &mut residuals.windows(2).map(|pair| pair[1] - pair[0]);
                let noise = squares(differences) / (2.0 * pairs);
                let size = squares(&mut residuals.iter().copied()) / freedom;
                let ratio = if size > 0.0 { noise / size } else { 1.0 };
                let deviation = ((count - 2.0).max(1.0) / (count * count - 1.0)).sqrt();
                (1.0 / ratio.max(1e-12), below((ratio - 1.0) / deviation))
            }
        };
        // A. Wald, J. Wolfowitz (1940), Ann. Math. Stat. 11, 147–162.
        let signs: Vec<bool> = residuals
            .iter()
            .filter(|left| **left != 0.0)
            .map(|left| *left > 0.0)
            .collect();
        let runs = 1 + signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
        let [positive, negative] =
            [true, false].map(|sign| signs.iter().filter(|one| **one == sign).count() as f64);
        let all = (positive + negative).max(2.0);
        let product = 2.0 * positive * negative;
        let expected_runs = 1.0 + product / all;
        let variance = product * (product - all) / (all * all * (all - 1.0));
        let probability = if variance > 0.0 {
            let z = (runs as f64 + 0.5 - expected_runs) / variance.sqrt();
            below(z)
        } else {
            // All of one sign: 2^(1 − n).
            if positive * negative == 0.0 {
                2.0 * 0.5f64.powf(all)
            } else {
                1.0
            }
        };
        Self {
            chi_squared,
            chi_squared_probability,
            runs,
            expected_runs,
            probability,
        }
    }

    /// Whether the residuals may be noise.
    pub fn is_noise(&self) -> bool {
        let is_usual = self.chi_squared <= MOST_CHI_SQUARED
            || self.chi_squared_probability >= LEAST_PROBABILITY;
        is_usual && self.probability >= LEAST_PROBABILITY
    }

    /// Says what speaks against noise; `None` if nothing does.
    pub fn remark(&self, name: &str) -> Option<String> {
        let (probability, by_chance) = (self.probability, self.chi_squared_probability);
        let mut why = Vec::new();
        if probability < LEAST_PROBABILITY {
            let (runs, expected) = (self.runs, self.expected_runs);
            why.push(format!(
                "{runs} runs of one sign where chance has {expected:.0} (p = {probability:.0e})"
            ));
        }
        if self.chi_squared > MOST_CHI_SQUARED {
            why.push(format!("χ² per degree of freedom {:.1}", self.chi_squared));
        }
        let what = if self.is_noise() {
            format!("may be no noise (p = {by_chance:.0e})")
        } else {
            "are no noise: the model misses something, and the errors above do not count it; see --plot".to_owned()
        };
        (!why.is_empty()).then(|| format!("{name}: {}: the residuals {what}", why.join(", ")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_passes_and_a_wave_does_not() {
        // Sums of three even numbers are nearly normal.
        let mut state = 7u64;
        let mut even = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / f64::from(1u32 << 31) - 0.5
        };
        let noise: Vec<f64> = (0..200).map(|_| even() + even() + even()).collect();
        let found = Structure::new(&noise, None, 198.0);
        assert!(found.remark("x").is_none(), "{found:?}");
        let waves: Vec<f64> = noise
            .iter()
            .zip(0..)
            .map(|(noise, i)| noise + (0.1 * f64::from(i)).sin())
            .collect();
        let found = Structure::new(&waves, None, 198.0);
        assert!(
            found.probability < 1e-3 && found.chi_squared > 2.0,
            "{found:?}"
        );
        assert!(
            found
                .remark("x")
                .expect("a remark")
                .contains("runs of one sign")
        );
        assert!(Structure::new(&[1.0; 20], None, 19.0).probability < 1e-5);
        let given = Structure::new(&noise, Some(&[0.1; 200]), 198.0);
        assert!(given.chi_squared > 10.0);
    }
}

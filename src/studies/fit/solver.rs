//! The search for the minimum.

use anyhow::{Result, ensure};
use rmpfit::{MPConfig, MPError, MPFitter, MPPar, MPResult, MPSuccess};

use crate::scenario::key::{Key, Kind, Range};
use crate::scenario::{Refusal, Scenario, units};

/// Maximum range of a positive key, in e-folds.
const FARTHEST: f64 = 9.3;

/// The step of differences, of a logarithm or relative to a value: the scenario is planned again for each run, its grid
/// follows the keys, and jumps over cycles end elsewhere, which leaves roughness of some 1e-5 of the depth.
const STEP: f64 = 0.02;

/// A step of the search changes the sum of squares by less than this part of it at the minimum.
const TOLERANCE: f64 = 1e-5;

/// The residual of every point where the contact cannot be computed: no minimum lies there.
const HOPELESS: f64 = 1e6;

/// A fitted key.
#[derive(Debug, Clone)]
pub(super) struct Free {
    /// The key.
    pub key: Key,
    /// Its unit.
    pub unit: &'static str,
    /// Fitted by its logarithm.
    positive: bool,
    /// Where the search starts.
    pub start: f64,
    /// Where it ends at the latest.
    bounds: [f64; 2],
}

impl Free {
    /// A key of `scenario`, whose value there starts the search; positive ones are fitted by their logarithms.
    ///
    /// # Errors
    /// A key that is unknown, is no physical number, or has no value to start from.
    pub fn new(scenario: &Scenario, key: &str) -> Result<Self> {
        let refused = |rule: &str| Refusal::from(format!("{key} {rule}"));
        let parameter = Key::named(key, key)?;
        let rule = "is not a number that can be fitted";
        ensure!(parameter.kind == Kind::Number, refused(rule));
        let is_physical = !["run", "changes", "numerics"].contains(&parameter.section());
        let rule = "is not a physical property, so data cannot determine it";
        ensure!(is_physical, refused(rule));
        let rule = format!("has no value to start from; give one with --set {key}=...");
        let value = scenario.number(key).ok_or_else(|| refused(&rule))?;
        let is_zero = parameter.range == Range::NotNegative && value == 0.0;
        let rule = "starts at 0; give a value greater than 0 with --set";
        ensure!(!is_zero, refused(rule));
        let (positive, limits) = match parameter.range {
            Range::Any => (false, [f64::NEG_INFINITY, f64::INFINITY]),
            Range::Positive | Range::NotNegative => (true, [0.0, f64::INFINITY]),
            Range::UpTo(most) => (true, [0.0, most]),
            Range::Acute => (true, [0.0, std::f64::consts::FRAC_PI_2]),
            Range::Within(least, most) => (least > 0.0, [least, most]),
        };
        let (start, bounds) = if !positive {
            (value, limits)
        } else {
            // A limit that has no logarithm is none.
            let (start, [least, most]) = (value.ln(), limits.map(f64::ln));
            let reach = [start - FARTHEST, start + FARTHEST];
            (start, [least.max(reach[0]), most.min(reach[1])])
        };
        Ok(Self {
            key: parameter,
            unit: units::unit_of(&parameter, scenario.prescribes_force(key)),
            positive,
            start,
            bounds,
        })
    }

    /// Returns the value of the key.
    pub fn value(&self, theta: f64) -> f64 {
        if self.positive { theta.exp() } else { theta }
    }

    /// Whether it is fitted by its logarithm.
    pub fn is_positive(&self) -> bool {
        self.positive
    }

    /// Returns `theta` moved by so many e-folds, or by that multiple of the value, within its range.
    pub fn moved(&self, theta: f64, step: f64) -> f64 {
        let step = step * self.size(theta);
        let [low, up] = self.bounds;
        // Just inside: an end of the range stands for what is not determined.
        let inside = |bound: f64, into: f64| {
            if bound.is_finite() {
                bound + into
            } else {
                bound
            }
        };
        (theta + step).clamp(inside(low, STEP), inside(up, -STEP).max(inside(low, STEP)))
    }

    /// Returns the standard error of the value.
    pub fn error(&self, theta: f64, error: f64) -> f64 {
        error * if self.positive { theta.exp() } else { 1.0 }
    }

    /// The size of its value, in which steps and errors are small: 1 for a logarithm.
    pub fn size(&self, theta: f64) -> f64 {
        if self.positive {
            1.0
        } else {
            theta.abs().max(1e-12)
        }
    }

    /// Returns the step of differences around `theta`.
    pub fn step(&self, theta: f64) -> f64 {
        STEP * self.size(theta)
    }

    /// The ends of its range for the search.
    fn limits(&self, theta: f64) -> MPPar {
        let [low, up] = self.bounds;
        let finite = |bound: f64| if bound.is_finite() { bound } else { 0.0 };
        let mut parameter = MPPar::new();
        (parameter.limited_low, parameter.limited_up) = (low.is_finite(), up.is_finite());
        (parameter.limit_low, parameter.limit_up) = (finite(low), finite(up));
        parameter.step = self.step(theta);
        parameter
    }

    /// Whether it ran into the end of its range.
    pub fn is_at_bound(&self, theta: f64) -> bool {
        let [low, up] = self.bounds;
        theta <= low || theta >= up
    }
}

struct LeastSquares<'a> {
    points: usize,
    parameters: Vec<MPPar>,
    config: MPConfig,
    residuals: &'a mut dyn FnMut(&[f64]) -> Option<Vec<f64>>,
}

impl MPFitter for LeastSquares<'_> {
    fn eval(&mut self, theta: &[f64], deviates: &mut [f64]) -> MPResult<()> {
        match (self.residuals)(theta) {
            Some(found) if found.iter().all(|z| z.is_finite()) => deviates.copy_from_slice(&found),
            _ => deviates.fill(HOPELESS),
        }
        Ok(())
    }

    fn number_of_points(&self) -> usize {
        self.points
    }

    fn config(&self) -> &MPConfig {
        &self.config
    }

    fn parameters(&self) -> &[MPPar] {
        &self.parameters
    }
}

/// Seeks the minimum of the sum of squares of the `points` values of `residuals` from `theta`. Returns the keys there,
/// positive ones by their logarithms.
///
/// # Errors
/// In words, where the search cannot begin or does not end.
pub(super) fn solve(
    free: &[Free],
    theta: &[f64],
    points: usize,
    residuals: &mut dyn FnMut(&[f64]) -> Option<Vec<f64>>,
) -> Result<Vec<f64>, &'static str> {
    let mut config = MPConfig::new();
    (config.ftol, config.xtol, config.gtol) = (TOLERANCE, TOLERANCE, 1e-10);
    config.max_iter = 60;
    let parameters = free.iter().zip(theta);
    let parameters = parameters.map(|(free, theta)| free.limits(*theta));
    let mut problem = LeastSquares {
        points,
        parameters: parameters.collect(),
        config,
        residuals,
    };
    let mut theta = theta.to_vec();
    let status = problem.mpfit(&mut theta).map_err(|error| match error {
        MPError::InitBounds => "a start value is out of range",
        MPError::DoF => "there are fewer data points than keys",
        _ => "the residuals are not finite",
    })?;
    if status.success == MPSuccess::MaxIter {
        return Err("no convergence after 60 iterations; try better start values");
    }
    Ok(theta)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_is_kept_and_its_end_is_reported() {
        let free = [Free {
            key: Key::find("wear.coefficient").expect("a key"),
            unit: "",
            positive: false,
            start: 0.3,
            bounds: [0.0, 0.5],
        }];
        let mut residuals =
            |theta: &[f64]| Some((1..9).map(|i| f64::from(i) * (theta[0] - 2.0)).collect());
        let theta = solve(&free, &[0.3], 8, &mut residuals).expect("a minimum");
        assert_eq!(theta, [0.5]);
        assert!(free[0].is_at_bound(theta[0]));
    }
}

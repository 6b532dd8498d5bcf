//! Parameters from measured data: least squares over any keys of a scenario.
//!
//! Every data set is compared with the same run: scars with its end, loops with the cycle that they were measured
//! in or the last one, histories with their cycles. Keys that must be positive are fitted by their logarithms. If a
//! file gives no errors, all its values share one, estimated from the residuals, so that scars in
//! nanometres and loops in newtons are weighted by their noise.
//!
//! # Formula
//!
//! ```text
//! minimise Σ ρ(z²),  z = (measured − simulated)/σ
//! ρ(z²) = z², or 2(√(1 + z²) − 1) against outliers
//! ```
//!
//! The errors of the keys, and those that the values of a file share, are computed in `errors`.
//!
//! The minimum is sought by `rmpfit`, MINPACK's Levenberg–Marquardt with bounds and derivatives by
//! differences; it depends on nothing else. (`levenberg-marquardt` brings a second nalgebra and wants
//! derivatives; `basin` minimises in general and gives no covariance.)

use std::collections::BTreeMap;
use std::ops::Range;

use anyhow::{Context, Result, anyhow, ensure};
use serde::Serialize;

use crate::math::scan::rms;
use crate::scenario::session::SessionError;
use crate::scenario::{MOST_CYCLES, Refusal, Scenario};
use crate::studies::measured::{Measured, check_radii};
use crate::traces::Axes;
use errors::{Errors, freedom};
use solver::Free;

mod errors;
mod model;
mod solver;

/// Fits, each with the errors that the one before has left.
const ROUNDS: usize = 3;

/// The least error of a data set, relative to its own size: exact data must not weigh without end.
const LEAST_ERROR: f64 = 1e-4;

/// Beyond this standard error of a logarithm, or correlation, the data determine a key hardly.
const VAGUE: f64 = 0.5;
const ALIKE: f64 = 0.95;

/// The standard deviation of normal noise in medians of its size.
const OF_MEDIAN: f64 = 1.4826;

/// What is to be fitted to what.
#[derive(Debug)]
pub struct Fit {
    scenario: Scenario,
    /// The data sets.
    pub data: Vec<Measured>,
    free: Vec<Free>,
    /// The cycles of each run: loops that state no cycle are compared with the last one.
    pub cycles: f64,
    robust: bool,
}

/// A key that was fitted.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Value {
    /// The dotted path.
    #[serde(skip)]
    pub key: String,
    /// Its unit.
    #[serde(skip)]
    pub unit: &'static str,
    /// The value at the minimum.
    pub value: f64,
    /// Its standard error; `None` if the data do not determine it.
    pub stderr: Option<f64>,
    /// Its correlations with the other keys; 0 with a key that is not determined.
    pub correlations: BTreeMap<String, f64>,
}

/// What came of a fit.
#[derive(Debug)]
pub struct Fitted {
    /// The keys in the order in which they were asked for.
    pub values: Vec<Value>,
    /// Measured less simulated values of each data set.
    pub residuals: Vec<Vec<f64>>,
    /// Where data do not determine a key, in a line each.
    pub remarks: Vec<String>,
    /// The scenario with the fitted values.
    pub scenario: Scenario,
}

impl Fit {
    /// Fits the keys `free` of `scenario` to `data`, in runs of `cycles` (default: `run.cycles`, or the
    /// last cycle of the histories); `robust` against outliers.
    ///
    /// # Errors
    /// Keys that are not numbers or have no value to start from, fewer points than keys, data that lie
    /// outside of what is simulated.
    pub fn new(
        scenario: Scenario,
        data: Vec<Measured>,
        free: &[String],
        cycles: Option<f64>,
        robust: bool,
    ) -> Result<Self> {
        let free = free.iter().map(|key| Free::of(&scenario, key));
        let free: Vec<Free> = free.collect::<Result<_>>()?;
        let is_empty = free.is_empty() || data.is_empty();
        let rule = "needs a key to fit and a data set to fit it to".to_owned();
        ensure!(!is_empty, Refusal::from(rule));
        let points: usize = data.iter().map(|set| set.values.len()).sum();
        let rule = format!("{points} points cannot determine {} keys", free.len());
        ensure!(points > free.len(), Refusal::from(rule));
        for (i, Free { key, .. }) in free.iter().enumerate() {
            let is_new = free[..i].iter().all(|other| other.key != *key);
            ensure!(is_new, Refusal::from(format!("{key} is given twice")));
        }
        let histories = data.iter().filter(|set| set.axes.x == "cycle");
        let cycles_of = histories.flat_map(|set| &set.at);
        let last = cycles_of.copied().fold(0.0, f64::max);
        let planned = cycles.or(scenario.run().cycles).unwrap_or(0.0);
        let cycles = planned.max(last);
        let most = format!("a run has at most {MOST_CYCLES:e} cycles");
        let rule = format!("the data end at cycle {cycles:e}; {most}");
        ensure!(cycles <= MOST_CYCLES, Refusal::from(rule));
        let domain = scenario.setup().grid.radius();
        for set in &data {
            let is_loop = set.axes == Axes::LOOP;
            let rule = "the length of the run is unknown, or less than a cycle; give --cycles";
            let is_long = cycles > 0.0 && (!is_loop || cycles >= 1.0);
            ensure!(is_long, Refusal::from(rule.to_owned()));
            if let Some(end) = set.cycle.filter(|_| is_loop) {
                let rule = format!(
                    "its loop ends at cycle {end}, but the run has the cycles 1 to {cycles}; --cycles and \
                     --loop FILE@CYCLE say others"
                );
                let is_run = (1.0..=cycles).contains(&end);
                ensure!(is_run, Refusal::new(&set.name, rule));
            }
            if set.axes.over_r() {
                check_radii(&set.name, &set.at, domain)?;
            }
        }
        Ok(Self {
            scenario,
            data,
            free,
            cycles,
            robust,
        })
    }

    /// Seeks the minimum; `on_run` hears of every run.
    ///
    /// # Errors
    /// A scenario that cannot run with its start values, and a search that fails.
    pub fn run(&self, on_run: &dyn Fn()) -> Result<Fitted> {
        let simulate = |theta: &[f64]| {
            on_run();
            model::simulate(&self.at(theta)?, &self.data, self.cycles)
        };
        let mut theta: Vec<f64> = self.free.iter().map(|free| free.start).collect();
        simulate(&theta).map_err(|error| anyhow!("at the start values: {error}"))?;
        let mut errors: Vec<f64> = self.data.iter().flat_map(first_errors).collect();
        let is_given = self.data.iter().all(|set| set.errors.is_some());
        let rounds = if is_given && !self.robust { 1 } else { ROUNDS };
        // The points of the data sets whose error is estimated, among all points.
        let estimated = self.places().filter(|(set, _)| set.errors.is_none());
        let estimated: Vec<Range<usize>> = estimated.map(|(_, points)| points).collect();
        let mut round = 1;
        loop {
            let deviations = |theta: &[f64]| Some(self.deviations(&simulate(theta).ok()?, &errors));
            let mut residuals = |theta: &[f64]| {
                let mut all = deviations(theta)?;
                if self.robust {
                    for z in &mut all {
                        *z = (2.0 * (z.hypot(1.0) - 1.0)).sqrt().copysign(*z);
                    }
                }
                Some(all)
            };
            theta = solver::solve(&self.free, &theta, errors.len(), &mut residuals)
                .map_err(|why| anyhow!("no minimum was found: {why}"))?;
            let derivatives = self.derivatives(&theta, &deviations);
            let simulated = simulate(&theta);
            let simulated = simulated.map_err(|error| anyhow!("no minimum was found: {error}"))?;
            let z = self.deviations(&simulated, &errors);
            let uncertainty = Errors::new(&z, &derivatives, &estimated, self.robust);
            if round == rounds {
                let scenario = self.at(&theta).context("no minimum was found")?;
                return Ok(self.fitted(&theta, &uncertainty, simulated, scenario));
            }
            self.update_errors(&simulated, &uncertainty.leverages, &mut errors);
            round += 1;
        }
    }

    /// The scenario with these values of the keys.
    fn at(&self, theta: &[f64]) -> Result<Scenario, SessionError> {
        let keys = self.free.iter().zip(theta);
        let values = keys.map(|(free, theta)| (&free.key, format!("{:e}", free.value(*theta))));
        Ok(self.scenario.with_all(&values.collect::<Vec<_>>())?)
    }

    /// z of all points.
    fn deviations(&self, simulated: &[Vec<f64>], errors: &[f64]) -> Vec<f64> {
        let sets = self.data.iter().zip(simulated);
        let left = sets.flat_map(|(set, simulated)| residuals(set, simulated));
        left.zip(errors).map(|(left, error)| left / error).collect()
    }

    /// The points of each data set among all points.
    fn places(&self) -> impl Iterator<Item = (&Measured, Range<usize>)> {
        self.data.iter().scan(0, |end, set| {
            let first = *end;
            *end += set.values.len();
            Some((set, first..*end))
        })
    }

    /// ∂z/∂θ of each key at the minimum by central differences, by one-sided ones at the end of what can be
    /// computed; none for a key at the end of its range.
    fn derivatives(
        &self,
        theta: &[f64],
        deviations: &dyn Fn(&[f64]) -> Option<Vec<f64>>,
    ) -> Vec<Option<Vec<f64>>> {
        let derivative = |i: usize| {
            let step = self.free[i].step(theta[i]);
            let at = |offset: f64| {
                let mut theta = theta.to_vec();
                theta[i] += offset;
                deviations(&theta).map(|z| (theta[i], z))
            };
            if self.free[i].is_at_bound(theta[i]) {
                return None;
            }
            let low = at(-step).or_else(|| at(0.0))?;
            let high = at(step).or_else(|| at(0.0))?;
            let width = high.0 - low.0;
            let differences = high.1.iter().zip(&low.1);
            (width > 0.0).then(|| differences.map(|(b, a)| (b - a) / width).collect())
        };
        (0..self.free.len()).map(derivative).collect()
    }

    /// The error that all values of a data set share, from what the fit leaves and from what each of its points
    /// has spent on the keys.
    fn update_errors(&self, simulated: &[Vec<f64>], leverages: &[f64], errors: &mut [f64]) {
        for ((set, place), simulated) in self.places().zip(simulated) {
            if set.errors.is_some() {
                continue;
            }
            let points = set.values.len();
            let spent: f64 = leverages[place.clone()].iter().sum();
            let left = residuals(set, simulated);
            let size = if self.robust {
                let mut sizes: Vec<f64> = left.iter().map(|left| left.abs()).collect();
                sizes.sort_by(f64::total_cmp);
                OF_MEDIAN * sizes[points / 2]
            } else {
                rms(&left)
            };
            let size = size * (points as f64 / freedom(points, spent)).sqrt();
            let least = (LEAST_ERROR * rms(&set.values)).max(f64::MIN_POSITIVE);
            errors[place].fill(size.max(least));
        }
    }

    fn fitted(
        &self,
        theta: &[f64],
        uncertainty: &Errors,
        simulated: Vec<Vec<f64>>,
        scenario: Scenario,
    ) -> Fitted {
        let (mut values, mut remarks, mut alike) = (Vec::new(), Vec::new(), Vec::new());
        let covariance = &uncertainty.covariance;
        let correlation = |i: usize, j: usize| {
            let norm = (covariance[(i, i)] * covariance[(j, j)]).sqrt();
            match norm > 0.0 {
                true => covariance[(i, j)] / norm,
                false => 0.0,
            }
        };
        for (i, (free, &theta)) in self.free.iter().zip(theta).enumerate() {
            let error = covariance[(i, i)].sqrt();
            let at_bound = free.is_at_bound(theta);
            let is_known = error.is_finite() && error > 0.0 && !at_bound;
            let key = free.key.clone();
            if at_bound {
                remarks.push(format!("{key} reached the end of its range"));
            } else if !is_known {
                remarks.push(format!("the data do not determine {key}"));
            } else if error > VAGUE * free.vague_at(theta) {
                remarks.push(format!(
                    "the data hardly determine {key}: its standard error is as large as itself"
                ));
            }
            let others = self.free.iter().enumerate().filter(|(j, _)| *j != i);
            let others = others.map(|(j, other)| (other.key.clone(), correlation(i, j)));
            for (other, correlation) in others.clone().take(i) {
                if correlation.abs() > ALIKE {
                    alike.push(format!(
                        "the data hardly distinguish {other} from {key}: their correlation is {correlation:.4}"
                    ));
                }
            }
            values.push(Value {
                unit: free.unit,
                value: free.value(theta),
                stderr: is_known.then(|| free.error(theta, error)),
                correlations: others.collect(),
                key,
            });
        }
        remarks.extend(alike);
        let sets = self.data.iter().zip(&simulated);
        let left = sets.map(|(set, simulated)| residuals(set, simulated));
        Fitted {
            values,
            residuals: left.collect(),
            remarks,
            scenario,
        }
    }
}

/// The errors of a data set: as given, or its size until a fit estimates them.
fn first_errors(set: &Measured) -> Vec<f64> {
    let size = rms(&set.values).max(f64::MIN_POSITIVE);
    let given = set.errors.clone();
    given.unwrap_or_else(|| vec![size; set.values.len()])
}

/// Measured less simulated.
fn residuals(measured: &Measured, simulated: &[f64]) -> Vec<f64> {
    let pairs = measured.values.iter().zip(simulated);
    pairs.map(|(value, simulated)| value - simulated).collect()
}

//! One search: a level of numerics, what is fitted in addition to the keys, and the errors of the data so far.

use std::cell::{Cell, RefCell};
use std::ops::Range;
use std::rc::Rc;

use anyhow::{Result, anyhow};

use super::errors::{ErrorAnalysis, degrees_of_freedom};
use super::model::{self, Prediction};
use super::nuisance::{self, Nuisances};
use super::solver::{self, Free};
use super::{Fit, Switch};
use crate::math::scan::rms;
use crate::scenario::Scenario;
use crate::scenario::session::SessionError;
use crate::studies::measured::Measured;

/// Minimum error of a data set, relative to its own size: exact data must not get infinite weight.
const LEAST_ERROR: f64 = 1e-4;

/// The standard deviation of normal noise in medians of its size.
const OF_MEDIAN: f64 = 1.4826;

/// Minimum fraction of unworn points needed to fit a baseline.
const BASELINE: f64 = 0.08;

/// A run is aborted after this multiple of the steps of the shortest one, but not before [`ENOUGH_STEPS`]: a wear
/// coefficient that is far too large costs a hundred times as much, and is not the minimum.
const MOST_STEPS: u64 = 20;
const ENOUGH_STEPS: u64 = 10_000;

/// A key that the data do not determine stays near its start: a prior of this standard deviation, in e-folds or sizes, moves
/// others by less than a percent of their errors.
const PRIOR: f64 = 20.0;

/// The most rounds of a descent, each of which weighs by the errors that the one before has left, and by how much errors
/// may change that have settled.
const MOST_ROUNDS: usize = 3;
const SETTLED: f64 = 0.05;

/// Runs that are remembered.
const REMEMBERED: usize = 64;

type Responses = Rc<Vec<Prediction>>;

/// The state of a search.
#[derive(Clone)]
pub(super) struct Search<'a> {
    pub fit: &'a Fit,
    pub scenario: Scenario,
    pub nuisances: Vec<Nuisances>,
    /// σ of each point.
    pub errors: Vec<f64>,
    on_run: &'a dyn Fn(),
    in_time: &'a dyn Fn() -> bool,
    /// Smallest number of steps of a run.
    fewest_steps: Cell<u64>,
    remembered: RefCell<Vec<(Vec<u64>, Responses)>>,
    /// The best of all evaluations so far.
    best: RefCell<Option<Found>>,
}

/// A minimum.
#[derive(Debug, Clone)]
pub(super) struct Found {
    /// The keys, positive ones as logarithms.
    pub theta: Vec<f64>,
    /// Level, shift and tilt of each data set.
    pub nuisances: Vec<[f64; 3]>,
    /// The simulated values.
    pub simulated: Vec<Vec<f64>>,
    /// The deviations in units of the errors.
    pub z: Vec<f64>,
    /// The same, smaller for outliers if these count less, and the keys' distances from their starts.
    weighed: Vec<f64>,
    /// −2 ln of the likelihood, up to a constant.
    pub objective: f64,
}

impl<'a> Search<'a> {
    pub fn new(
        fit: &'a Fit,
        scenario: Scenario,
        on_run: &'a dyn Fn(),
        in_time: &'a dyn Fn() -> bool,
    ) -> Self {
        Self {
            errors: fit.data.iter().flat_map(first_errors).collect(),
            fit,
            scenario,
            nuisances: Vec::new(),
            on_run,
            in_time,
            fewest_steps: Cell::new(u64::MAX),
            remembered: RefCell::default(),
            best: RefCell::default(),
        }
    }

    /// What a run on the level of `scenario` adds to the values at a minimum, and its steps.
    ///
    /// # Errors
    /// A contact that cannot be computed there, and the end of the time.
    pub fn changes_on(
        &self,
        scenario: &Scenario,
        found: &Found,
    ) -> Result<(Vec<Vec<f64>>, u64), SessionError> {
        let (responses, steps) = self.run(scenario, &found.theta, u64::MAX)?;
        let sets = self.fit.data.iter().zip(&responses).zip(&found.nuisances);
        let values = sets.map(|((set, response), at)| response.at(set, *at));
        let change = |(new, old): (Vec<f64>, &Vec<f64>)| {
            new.iter().zip(old).map(|(new, old)| new - old).collect()
        };
        Ok((values.zip(&found.simulated).map(change).collect(), steps))
    }

    /// Whether its time is not over.
    pub fn is_in_time(&self) -> bool {
        (self.in_time)()
    }

    /// The best evaluation so far, also if the search has failed.
    pub fn best_so_far(&self) -> Option<Found> {
        self.best.borrow().clone()
    }

    /// Goes on with the level of `scenario`.
    pub fn move_to(&mut self, scenario: Scenario) {
        self.scenario = scenario;
        self.remembered.take();
        self.fewest_steps.set(u64::MAX);
    }

    /// How `changes` of the values change the deviations.
    pub fn in_errors(&self, changes: &[Vec<f64>]) -> Vec<f64> {
        let changes = changes.iter().flatten().zip(&self.errors);
        changes.map(|(change, error)| -change / error).collect()
    }

    /// What a run with these keys says of all data.
    pub fn responses(&self, theta: &[f64]) -> Result<Responses, SessionError> {
        let bits: Vec<u64> = theta.iter().map(|theta| theta.to_bits()).collect();
        let known = self
            .remembered
            .borrow()
            .iter()
            .find(|(known, _)| *known == bits)
            .map(|(_, found)| found.clone());
        if let Some(found) = known {
            return Ok(found);
        }
        let fewest = self.fewest_steps.get();
        let most = fewest.saturating_mul(MOST_STEPS).max(ENOUGH_STEPS);
        let (found, steps) = self.run(&self.scenario, theta, most)?;
        self.fewest_steps.set(fewest.min(steps));
        let found = Rc::new(found);
        let mut remembered = self.remembered.borrow_mut();
        remembered.truncate(REMEMBERED - 1);
        remembered.insert(0, (bits, found.clone()));
        Ok(found)
    }

    /// Runs `scenario` with these keys, for `most` steps or fewer.
    pub fn run(
        &self,
        scenario: &Scenario,
        theta: &[f64],
        most: u64,
    ) -> Result<(Vec<Prediction>, u64), SessionError> {
        if !(self.in_time)() {
            return Err(SessionError::Interrupted);
        }
        (self.on_run)();
        let scenario = self.fit.at(scenario, theta)?;
        let go_on = |steps: u64| steps < most && (self.in_time)();
        model::simulate(&scenario, &self.fit.data, self.fit.cycles, &go_on)
    }

    /// The data with these keys and the nuisances that fit best.
    pub fn evaluate(&self, theta: &[f64]) -> Result<Found, SessionError> {
        let responses = self.responses(theta)?;
        let (mut nuisances, mut simulated) = (Vec::new(), Vec::new());
        let (mut z, mut all_weighed) = (Vec::new(), Vec::new());
        let mut objective = 0.0;
        for ((set, place), (response, nuisance)) in
            self.places().zip(responses.iter().zip(&self.nuisances))
        {
            let weigh =
                |values: &[f64]| self.weighted_residuals(set, &self.errors[place.clone()], values);
            let (at, values) = nuisance.solve(set, response, &weigh);
            let size = self.spread(&residuals(set, &values));
            let weighed = weigh(&values);
            objective += match &set.errors {
                Some(_) => weighed.iter().map(|z| z * z).sum::<f64>(),
                None => 2.0 * set.values.len() as f64 * size.max(f64::MIN_POSITIVE).ln(),
            };
            z.extend(deviations(set, &self.errors[place.clone()], &values));
            all_weighed.extend(weighed);
            nuisances.push(at);
            simulated.push(values);
        }
        let keys = self.fit.free.iter().zip(theta);
        all_weighed
            .extend(keys.map(|(free, at)| (at - free.start) / (PRIOR * free.size(free.start))));
        let found = Found {
            theta: theta.to_vec(),
            nuisances,
            simulated,
            z,
            weighed: all_weighed,
            objective,
        };
        let mut best = self.best.borrow_mut();
        if best.as_ref().is_none_or(|best| objective < best.objective) {
            *best = Some(found.clone());
        }
        Ok(found)
    }

    /// The deviations with these keys and nuisances; `None` where the contact cannot be computed.
    pub fn deviations_at(&self, theta: &[f64], nuisances: &[[f64; 3]]) -> Option<Vec<f64>> {
        let responses = self.responses(theta).ok()?;
        let sets = self.places().zip(responses.iter().zip(nuisances));
        let all = sets.flat_map(|((set, place), (response, at))| {
            deviations(set, &self.errors[place], &response.at(set, *at))
        });
        Some(all.collect())
    }

    /// Deviations of simulated values in units of the errors, smaller ones for outliers if these count less.
    fn weighted_residuals(&self, set: &Measured, errors: &[f64], simulated: &[f64]) -> Vec<f64> {
        let mut all = deviations(set, errors, simulated);
        if self.fit.options.robust {
            for z in &mut all {
                *z = (2.0 * (z.hypot(1.0) - 1.0)).sqrt().copysign(*z);
            }
        }
        all
    }

    /// The keys that fit best from `theta` on, but the one that is `held`, and the sum of squares there.
    ///
    /// # Errors
    /// If the search fails.
    pub fn least_squares(&self, theta: &[f64], held: Option<usize>) -> Result<(Vec<f64>, f64)> {
        let free: Vec<usize> = (0..theta.len()).filter(|i| Some(*i) != held).collect();
        let whole = |some: &[f64]| {
            let mut all = theta.to_vec();
            free.iter()
                .zip(some)
                .for_each(|(&i, value)| all[i] = *value);
            all
        };
        let mut residuals = |some: &[f64]| Some(self.evaluate(&whole(some)).ok()?.weighed);
        let points = self.errors.len() + theta.len();
        let keys: Vec<Free> = free.iter().map(|&i| self.fit.free[i].clone()).collect();
        let some: Vec<f64> = free.iter().map(|&i| theta[i]).collect();
        let some = if keys.is_empty() {
            some
        } else {
            solver::solve(&keys, &some, points, &mut residuals)
                .map_err(|why| anyhow!("no minimum was found: {why}"))?
        };
        let theta = whole(&some);
        let sum = self.at(&theta)?.weighed.iter().map(|z| z * z).sum();
        Ok((theta, sum))
    }

    /// The data at a minimum.
    fn at(&self, theta: &[f64]) -> Result<Found> {
        self.evaluate(theta)
            .map_err(|error| anyhow!("no minimum was found: {error}"))
    }

    /// The minimum near `theta`, weighed by the errors that it leaves.
    ///
    /// # Errors
    /// If the search fails.
    pub fn descend(&mut self, theta: &[f64]) -> Result<Found> {
        let mut theta = theta.to_vec();
        for _ in 0..MOST_ROUNDS {
            theta = self.least_squares(&theta, None)?.0;
            let found = self.at(&theta)?;
            let leverages = self.uncertainty(&found, &[]).leverages;
            let before = self.errors.clone();
            self.update_errors(&found.simulated, &leverages);
            let mut pairs = before.iter().zip(&self.errors);
            if pairs.all(|(before, error)| (error / before - 1.0).abs() < SETTLED) {
                break;
            }
        }
        self.at(&theta)
    }

    /// Leaves out baselines and tilts that the data cannot show, unless the user wants them.
    pub fn drop_undetermined(&mut self, found: &Found) -> bool {
        let Ok(responses) = self.responses(&found.theta) else {
            return false;
        };
        let before = self.nuisances.clone();
        for (i, set) in self.fit.data.iter().enumerate() {
            let is_wear = set.axes == crate::traces::Axes::WEAR;
            if is_wear && responses[i].unworn_share(set, found.nuisances[i][1]) < BASELINE {
                for k in [0, 2] {
                    self.nuisances[i].active[k] &= self.fit.options.nuisances[k] == Switch::On;
                }
            }
        }
        before != self.nuisances
    }

    /// Errors and correlations at a minimum: of the keys but those that are `held`, then of the nuisances.
    pub fn uncertainty(&self, found: &Found, held: &[usize]) -> ErrorAnalysis {
        let mut derivatives = self.derivatives(found, held);
        if let Ok(responses) = self.responses(&found.theta) {
            for (i, (set, place)) in self.places().enumerate() {
                let columns = nuisance::derivatives(
                    set,
                    &responses[i],
                    found.nuisances[i],
                    self.nuisances[i].active,
                );
                for column in columns {
                    let mut whole = vec![0.0; self.errors.len()];
                    let weighed = column
                        .iter()
                        .zip(&self.errors[place.clone()])
                        .map(|(d, error)| -d / error);
                    whole[place.clone()]
                        .iter_mut()
                        .zip(weighed)
                        .for_each(|(whole, d)| *whole = d);
                    derivatives.push(Some(whole));
                }
            }
        }
        let estimated = self.places().filter(|(set, _)| set.errors.is_none());
        let estimated: Vec<Range<usize>> = estimated.map(|(_, points)| points).collect();
        ErrorAnalysis::new(&found.z, &derivatives, &estimated, self.fit.options.robust)
    }

    /// The size of residuals; by their median if outliers count less.
    fn spread(&self, left: &[f64]) -> f64 {
        if !self.fit.options.robust {
            return rms(left);
        }
        let mut sizes: Vec<f64> = left.iter().map(|left| left.abs()).collect();
        sizes.sort_by(f64::total_cmp);
        OF_MEDIAN * sizes[sizes.len() / 2]
    }

    /// The points of each data set among all points.
    pub fn places(&self) -> impl Iterator<Item = (&'a Measured, Range<usize>)> + use<'a> {
        self.fit.data.iter().scan(0, |end, set| {
            let first = *end;
            *end += set.values.len();
            Some((set, first..*end))
        })
    }

    /// ∂z/∂θ of each key at the minimum by central differences, by one-sided ones at the end of what can be
    /// computed; none for a key that is `held` or at the end of its range.
    fn derivatives(&self, found: &Found, held: &[usize]) -> Vec<Option<Vec<f64>>> {
        let derivative = |(i, free): (usize, &Free)| {
            let step = free.step(found.theta[i]);
            let at = |offset: f64| {
                let mut theta = found.theta.clone();
                theta[i] += offset;
                self.deviations_at(&theta, &found.nuisances)
                    .map(|z| (theta[i], z))
            };
            if held.contains(&i) || free.is_at_bound(found.theta[i]) {
                return None;
            }
            let low = at(-step).or_else(|| at(0.0))?;
            let high = at(step).or_else(|| at(0.0))?;
            let width = high.0 - low.0;
            let differences = high.1.iter().zip(&low.1);
            (width > 0.0).then(|| differences.map(|(b, a)| (b - a) / width).collect())
        };
        self.fit.free.iter().enumerate().map(derivative).collect()
    }

    /// The error that all values of a data set share, from what the fit leaves and from what each of its points
    /// has spent on the keys.
    fn update_errors(&mut self, simulated: &[Vec<f64>], leverages: &[f64]) {
        for ((set, place), simulated) in self.places().zip(simulated) {
            if set.errors.is_some() {
                continue;
            }
            let points = set.values.len();
            let spent: f64 = leverages[place.clone()].iter().sum();
            let left = residuals(set, simulated);
            let size =
                self.spread(&left) * (points as f64 / degrees_of_freedom(points, spent)).sqrt();
            let least = (LEAST_ERROR * rms(&set.values)).max(f64::MIN_POSITIVE);
            self.errors[place].fill(size.max(least));
        }
    }
}

/// The errors of a data set: as given, or its size until a fit estimates them.
fn first_errors(set: &Measured) -> Vec<f64> {
    let size = rms(&set.values).max(f64::MIN_POSITIVE);
    let given = set.errors.clone();
    given.unwrap_or_else(|| vec![size; set.values.len()])
}

/// Returns measured minus simulated values.
pub(super) fn residuals(measured: &Measured, simulated: &[f64]) -> Vec<f64> {
    let pairs = measured.values.iter().zip(simulated);
    pairs.map(|(value, simulated)| value - simulated).collect()
}

fn deviations(set: &Measured, errors: &[f64], simulated: &[f64]) -> Vec<f64> {
    residuals(set, simulated)
        .iter()
        .zip(errors)
        .map(|(left, error)| left / error)
        .collect()
}

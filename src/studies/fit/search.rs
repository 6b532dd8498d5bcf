//! One search: a level of numerics, what is fitted beside the keys, and the errors of the data so far.

use std::cell::{Cell, RefCell};
use std::f64::consts::LN_10;
use std::ops::Range;
use std::rc::Rc;

use anyhow::{Result, anyhow};

use super::errors::{Errors, freedom};
use super::model::{self, Response};
use super::nuisance::{self, Nuisances};
use super::solver::{self, Free};
use super::structure::Structure;
use super::{Fit, Switch};
use crate::math::scan::rms;
use crate::scenario::Scenario;
use crate::scenario::session::SessionError;
use crate::studies::measured::Measured;

/// Minimum error of a data set, relative to its own size: exact data must not get infinite weight.
const LEAST_ERROR: f64 = 1e-4;

/// The standard deviation of normal noise in medians of its size.
const OF_MEDIAN: f64 = 1.4826;

/// Starts that are tried around the given ones, in e-folds of each key: factors of 10 and 100.
const STARTS: [f64; 5] = [0.0, -LN_10, LN_10, -2.0 * LN_10, 2.0 * LN_10];

/// So many keys are varied together in search of a start, more of them one by one.
const TOGETHER: usize = 2;

/// Starts from which the minimum is sought.
const BEST_STARTS: usize = 2;

/// A scar without so much of its points beyond its edge shows no baseline.
const BASELINE: f64 = 0.08;

/// A run of the coarse search ends at so many times the steps of the shortest one, but not before [`ENOUGH_STEPS`].
const MOST_STEPS: u64 = 20;
const ENOUGH_STEPS: u64 = 10_000;

/// A step of the search changes Σz² by less than this part of it at the minimum: in the coarse search, and after it.
const TOLERANCES: [f64; 2] = [1e-4, 1e-6];

/// Number of runs remembered.
const REMEMBERED: usize = 8;

type Responses = Rc<Vec<Response>>;

/// The state of a search.
#[derive(Clone)]
pub(super) struct Search<'a> {
    pub fit: &'a Fit,
    pub scenario: Scenario,
    pub nuisances: Vec<Nuisances>,
    /// σ of each point.
    pub errors: Vec<f64>,
    /// Whether it only seeks where the minimum lies.
    pub is_coarse: bool,
    on_run: &'a dyn Fn(),
    in_time: &'a dyn Fn() -> bool,
    /// Smallest number of steps of a run.
    fewest_steps: Cell<u64>,
    remembered: RefCell<Vec<(Vec<u64>, Responses)>>,
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
    /// −2 ln of the likelihood, but for a constant.
    pub objective: f64,
}

impl<'a> Search<'a> {
    pub fn new(
        fit: &'a Fit,
        scenario: Scenario,
        nuisances: Vec<Nuisances>,
        on_run: &'a dyn Fn(),
        in_time: &'a dyn Fn() -> bool,
    ) -> Self {
        Self {
            errors: fit.data.iter().flat_map(first_errors).collect(),
            fit,
            scenario,
            nuisances,
            is_coarse: false,
            on_run,
            in_time,
            fewest_steps: Cell::new(u64::MAX),
            remembered: RefCell::default(),
        }
    }

    fn tolerance(&self) -> f64 {
        TOLERANCES[usize::from(!self.is_coarse)]
    }

    /// Forgets what runs have told: the scenario is another one.
    pub fn forget(&mut self) {
        self.remembered.take();
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
        if !(self.in_time)() {
            return Err(SessionError::Interrupted);
        }
        (self.on_run)();
        let scenario = self.fit.at(&self.scenario, theta)?;
        // A coefficient of wear that is far too large costs a hundred times as much, and is no minimum.
        let most = match self.is_coarse {
            true => self
                .fewest_steps
                .get()
                .saturating_mul(MOST_STEPS)
                .max(ENOUGH_STEPS),
            false => u64::MAX,
        };
        let go_on = |steps: u64| steps < most && (self.in_time)();
        let (found, steps) = model::simulate(&scenario, &self.fit.data, self.fit.cycles, &go_on)?;
        self.fewest_steps.set(self.fewest_steps.get().min(steps));
        let found = Rc::new(found);
        let mut remembered = self.remembered.borrow_mut();
        remembered.truncate(REMEMBERED - 1);
        remembered.insert(0, (bits, found.clone()));
        Ok(found)
    }

    /// The data with these keys and the nuisances that fit best.
    fn evaluate(&self, theta: &[f64]) -> Result<Found, SessionError> {
        let responses = self.responses(theta)?;
        let (mut nuisances, mut simulated, mut z) = (Vec::new(), Vec::new(), Vec::new());
        let mut objective = 0.0;
        for ((set, place), (response, nuisance)) in
            self.places().zip(responses.iter().zip(&self.nuisances))
        {
            let weigh = |values: &[f64]| self.weighed(set, &self.errors[place.clone()], values);
            let (at, values) = nuisance.solve(set, response, &weigh);
            let size = residuals(set, &values)
                .iter()
                .map(|left| left * left)
                .sum::<f64>();
            objective += match &set.errors {
                Some(_) => weigh(&values).iter().map(|z| z * z).sum::<f64>(),
                None => set.values.len() as f64 * size.max(f64::MIN_POSITIVE).ln(),
            };
            z.extend(deviations(set, &self.errors[place.clone()], &values));
            nuisances.push(at);
            simulated.push(values);
        }
        Ok(Found {
            theta: theta.to_vec(),
            nuisances,
            simulated,
            z,
            objective,
        })
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
    fn weighed(&self, set: &Measured, errors: &[f64], simulated: &[f64]) -> Vec<f64> {
        let mut all = deviations(set, errors, simulated);
        if self.fit.options.robust {
            for z in &mut all {
                *z = (2.0 * (z.hypot(1.0) - 1.0)).sqrt().copysign(*z);
            }
        }
        all
    }

    /// The sum of squares at the best nuisances, with the keys that are not `held` at their best; `None` if there is none.
    pub fn least_squares(&self, theta: &[f64], held: Option<usize>) -> Option<(Vec<f64>, f64)> {
        let free: Vec<usize> = (0..theta.len()).filter(|i| Some(*i) != held).collect();
        let whole = |some: &[f64]| {
            let mut all = theta.to_vec();
            free.iter()
                .zip(some)
                .for_each(|(&i, value)| all[i] = *value);
            all
        };
        let mut residuals = |some: &[f64]| {
            let found = self.evaluate(&whole(some)).ok()?;
            let sets = self.places().zip(&found.simulated);
            let all = sets
                .flat_map(|((set, place), values)| self.weighed(set, &self.errors[place], values));
            Some(all.collect())
        };
        let keys: Vec<Free> = free.iter().map(|&i| self.fit.free[i].clone()).collect();
        let some: Vec<f64> = free.iter().map(|&i| theta[i]).collect();
        let found = match keys.is_empty() {
            true => some,
            false => solver::solve(
                &keys,
                &some,
                (self.errors.len(), self.tolerance()),
                &mut residuals,
            )
            .ok()?,
        };
        let sum = residuals(&found)?.iter().map(|z| z * z).sum();
        Some((whole(&found), sum))
    }

    /// The minimum near `theta`, in `rounds` that each weigh by the errors that the one before has left.
    ///
    /// # Errors
    /// If the search fails.
    pub fn descend(&mut self, theta: &[f64], rounds: usize) -> Result<Found> {
        let mut theta = theta.to_vec();
        let is_given = self.fit.data.iter().all(|set| set.errors.is_some());
        let rounds = if is_given && !self.fit.options.robust {
            1
        } else {
            rounds
        };
        for round in 1..=rounds {
            let mut residuals = |theta: &[f64]| {
                let found = self.evaluate(theta).ok()?;
                let sets = self.places().zip(&found.simulated);
                let all = sets.flat_map(|((set, place), values)| {
                    self.weighed(set, &self.errors[place], values)
                });
                Some(all.collect())
            };
            theta = solver::solve(
                &self.fit.free,
                &theta,
                (self.errors.len(), self.tolerance()),
                &mut residuals,
            )
            .map_err(|why| anyhow!("no minimum was found: {why}"))?;
            if round < rounds {
                let found = self
                    .evaluate(&theta)
                    .map_err(|error| anyhow!("no minimum was found: {error}"))?;
                let uncertainty = self.uncertainty(&found);
                self.update_errors(&found.simulated, &uncertainty.leverages);
            }
        }
        self.evaluate(&theta)
            .map_err(|error| anyhow!("no minimum was found: {error}"))
    }

    /// The minimum from `start`, or from the best of a grid of starts where that leaves more than noise.
    ///
    /// # Errors
    /// A scenario that cannot run with its start values, and a search that fails.
    pub fn locate(&mut self, start: &[f64]) -> Result<Found> {
        let at_start = self.evaluate(start);
        let first = self.errors.clone();
        let found = match &at_start {
            Ok(_) => self.descend(start, 3),
            Err(error) => Err(anyhow!("at the start values: {error}")),
        };
        if let Ok(found) = &found
            && self.is_noise(found)
            && self
                .fit
                .free
                .iter()
                .zip(&found.theta)
                .all(|(free, theta)| !free.is_at_bound(*theta))
        {
            return Ok(found.clone());
        }
        let mut starts: Vec<(f64, Vec<f64>)> = self
            .starts(start)
            .into_iter()
            .filter_map(|theta| Some((self.evaluate(&theta).ok()?.objective, theta)))
            .collect();
        starts.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut best = found.map(|found| (found, self.errors.clone()));
        for (_, theta) in starts.into_iter().take(BEST_STARTS) {
            self.errors.clone_from(&first);
            let Ok(found) = self.descend(&theta, 3) else {
                continue;
            };
            if best
                .as_ref()
                .map_or(true, |(best, _)| found.objective < best.objective)
            {
                best = Ok((found, self.errors.clone()));
            }
        }
        best.map(|(found, errors)| {
            self.errors = errors;
            found
        })
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
            match i < TOGETHER {
                true => all = all.iter().flat_map(around).collect(),
                false => all.extend(around(&start.to_vec())),
            }
        }
        all
    }

    /// Whether the residuals of all data sets may be noise.
    pub fn is_noise(&self, found: &Found) -> bool {
        let sets = self.fit.data.iter().zip(&found.simulated);
        let mut remarks = sets.map(|(set, simulated)| {
            let left = residuals(set, simulated);
            let freedom = left.len().saturating_sub(found.theta.len()).max(1) as f64;
            Structure::new(&left, set.errors.as_deref(), freedom).remark("")
        });
        remarks.all(|remark| remark.is_none())
    }

    /// Leaves out baselines and tilts that the data cannot show, unless the user wants them.
    pub fn drop_vague(&mut self, found: &Found) -> bool {
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

    /// Errors and correlations at a minimum: of the keys, then of the nuisances.
    pub fn uncertainty(&self, found: &Found) -> Errors {
        let mut derivatives = self.derivatives(found);
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
        Errors::new(&found.z, &derivatives, &estimated, self.fit.options.robust)
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
    /// computed; none for a key at the end of its range.
    fn derivatives(&self, found: &Found) -> Vec<Option<Vec<f64>>> {
        let derivative = |(i, free): (usize, &Free)| {
            let step = free.step(found.theta[i]);
            let at = |offset: f64| {
                let mut theta = found.theta.clone();
                theta[i] += offset;
                self.deviations_at(&theta, &found.nuisances)
                    .map(|z| (theta[i], z))
            };
            if free.is_at_bound(found.theta[i]) {
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
            let size = if self.fit.options.robust {
                let mut sizes: Vec<f64> = left.iter().map(|left| left.abs()).collect();
                sizes.sort_by(f64::total_cmp);
                OF_MEDIAN * sizes[points / 2]
            } else {
                rms(&left)
            };
            let size = size * (points as f64 / freedom(points, spent)).sqrt();
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

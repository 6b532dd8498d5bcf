//! Parameters from measured data: least squares over any keys of a scenario.
//!
//! Every data set is compared with the same run: scars with its end, loops with the cycle that they were measured
//! in or the last one, histories with their course. Keys that must be positive are fitted by their logarithms. If a
//! file gives no errors, all its values share one, estimated from the residuals, so that scars in
//! nanometres and loops in newtons are weighted by their noise. The zeros, the centre and the tilt of each file are
//! fitted in addition to the keys, see [`nuisance`].
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
//! # Search
//!
//! On a coarse level from the best of a grid of starts, a factor of 100 around the given ones; then on finer [`levels`].
//!
//! The minimum is sought by `rmpfit`, MINPACK's Levenberg–Marquardt with bounds and derivatives by
//! differences; it depends on nothing else. (`levenberg-marquardt` brings a second nalgebra and wants
//! derivatives; `basin` minimises in general and gives no covariance.)

use std::time::{Duration, Instant};

use anyhow::{Result, anyhow, ensure};

use crate::reading::Column;
use crate::scenario::session::SessionError;
use crate::scenario::{MOST_CYCLES, Refusal, Scenario, value};
use crate::studies::measured::{Measured, check_radii};
use crate::traces::Axes;
use search::{Found, Search};
use solver::Free;

mod checked;
mod coarse;
mod errors;
mod hypotheses;
mod levels;
mod model;
mod nuisance;
mod profile;
mod report;
mod scar;
mod search;
mod solver;
mod starts;
mod structure;

pub use model::{ModelCycle, model_cycles};
pub use nuisance::NAMES;
pub use report::{Fitted, FittedKey, Nuisance, SetResult};
pub use structure::Structure;

/// Whether a nuisance is fitted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, clap::ValueEnum)]
pub enum Switch {
    /// Where the data can show it.
    #[default]
    Auto,
    /// Always.
    On,
    /// Never.
    Off,
}

/// How to fit.
#[derive(Debug, Clone, Default)]
pub struct FitOptions {
    /// Number of cycles of each run; default: `run.cycles`, or the last cycle of the histories.
    pub cycles: Option<f64>,
    /// Whether outliers count less.
    pub robust: bool,
    /// Whether level, shift and tilt are fitted.
    pub nuisances: [Switch; 3],
    /// Whether the scenario takes its stroke from the loops.
    pub takes_stroke: bool,
    /// Seconds after which the search ends with the best result so far.
    pub budget: Option<f64>,
}

/// What is to be fitted to what.
#[derive(Debug)]
pub struct Fit {
    scenario: Scenario,
    /// The data sets.
    pub data: Vec<Measured>,
    free: Vec<Free>,
    /// The cycles of each run: loops that state no cycle are compared with the last one.
    pub cycles: f64,
    options: FitOptions,
}

impl Fit {
    /// Fits the keys `free` of `scenario` to `data`.
    ///
    /// # Errors
    /// Keys that are not numbers or have no value to start from, fewer points than keys, data that lie
    /// outside of what is simulated, loops of another stroke.
    pub fn new(
        scenario: Scenario,
        mut data: Vec<Measured>,
        free: &[String],
        options: FitOptions,
    ) -> Result<Self> {
        let scenario = checked::with_stroke(scenario, &data, free, options.takes_stroke)?;
        let free = free.iter().map(|key| Free::new(&scenario, key));
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
        let cycles = cycles(&scenario, &data, options.cycles)?;
        let domain = scenario.setup().grid.radius();
        for set in &mut data {
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
                checked::check_depths(set, &scenario)?;
                checked::decide_profile(set, &scenario.setup().indenter);
            }
        }
        Ok(Self {
            scenario,
            data,
            free,
            cycles,
            options,
        })
    }

    /// Finds the minimum; calls `on_run` after each simulation.
    ///
    /// # Errors
    /// A scenario that cannot run with its start values, and a search that fails.
    pub fn run(&self, on_run: &dyn Fn()) -> Result<Fitted> {
        let deadline = self
            .options
            .budget
            .map(|budget| Instant::now() + Duration::from_secs_f64(budget));
        let in_time = || deadline.is_none_or(|deadline| Instant::now() < deadline);
        let start: Vec<f64> = self.free.iter().map(|free| free.start).collect();
        let scenario = coarse::of_search(&self.scenario)?;
        let first = Search::new(self, scenario, on_run, &in_time);
        let mut search = first.clone();
        let mut best: Result<(Search, Found)> = Err(anyhow!("no minimum was found"));
        for nuisances in self.hypotheses() {
            // Another reading of a trace is tried where the plain one leaves more than noise.
            if best
                .as_ref()
                .is_ok_and(|(search, found)| search.is_noise(found))
            {
                break;
            }
            search.nuisances = nuisances;
            search.errors.clone_from(&first.errors);
            let found = search.locate(&start);
            let is_better = |found: &Found| {
                let best = best.as_ref();
                !best.is_ok_and(|(_, best)| best.objective <= found.objective)
            };
            if best.is_err() || found.as_ref().is_ok_and(is_better) {
                best = found.map(|found| (search.clone(), found));
            }
        }
        let (mut search, mut found) = match (best, search.best_so_far()) {
            (Err(_), Some(found)) if !in_time() => (search, found),
            (best, _) => best?,
        };
        if search.drop_undetermined(&found) {
            let better = search.descend(&found.theta);
            found = better.or_else(|why| if in_time() { Err(why) } else { Ok(found) })?;
        }
        let (mut errors, numerical) = levels::refine(&mut search, &mut found)?;
        let intervals = profile::intervals(&search, &found, &errors);
        // A key without an end on one side has no error that others could share.
        let is_open = |i: &usize| intervals[*i].is_some_and(|ends| ends.contains(&None));
        let open: Vec<usize> = (0..intervals.len()).filter(is_open).collect();
        if !open.is_empty() {
            errors = search.uncertainty(&found, &open);
        }
        let scenario = self.at(&self.scenario, &found.theta)?;
        let mut fitted = Fitted::new(&search, &found, (&errors, numerical), &intervals, scenario);
        if !in_time() {
            fitted.cut_off(self.options.budget.unwrap_or_default());
        }
        Ok(fitted)
    }

    /// `scenario` with these values of the keys.
    fn at(&self, scenario: &Scenario, theta: &[f64]) -> Result<Scenario, SessionError> {
        Ok(scenario.edited(|spec| {
            for (free, theta) in self.free.iter().zip(theta) {
                spec.set(free.key, value::Value::Number(free.value(*theta)));
            }
        })?)
    }
}

/// The cycles of each run.
fn cycles(scenario: &Scenario, data: &[Measured], given: Option<f64>) -> Result<f64> {
    let planned = given.or(scenario.run().cycles).unwrap_or(0.0);
    let mut last = 0.0f64;
    let over = |set: &&Measured| {
        set.axes != Axes::LOOP && !set.axes.over_r() && set.axes.x != Column::Energy
    };
    for set in data.iter().filter(over) {
        let per_cycle = model::per_cycle(&scenario.setup().drive, set.axes.x);
        let rule = "a sliding distance needs a prescribed displacement; give cycles instead";
        ensure!(per_cycle.is_finite(), Refusal::new(&set.name, rule));
        last = set.at.iter().map(|at| at / per_cycle).fold(last, f64::max);
    }
    let cycles = planned.max(last);
    let most = format!("a run has at most {MOST_CYCLES:e} cycles");
    let rule = format!("the data end at cycle {cycles:e}; {most}");
    ensure!(cycles <= MOST_CYCLES, Refusal::from(rule));
    Ok(cycles)
}

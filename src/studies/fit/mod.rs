//! Parameters from measured data: least squares over any keys of a scenario.
//!
//! Every data set is compared with the same run: scars with its end, loops with the cycle that they were measured
//! in or the last one, histories with their course. Keys that must be positive are fitted by their logarithms. If a
//! file gives no errors, all its values share one, estimated from the residuals, so that scars in
//! nanometres and loops in newtons are weighted by their noise. The zeros, the centre and the tilt of each file are
//! fitted beside the keys, see [`nuisance`].
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
//! On a coarse level from the start values, and from a grid of starts a factor of 100 around them unless what that
//! leaves is noise; then on the points and steps that the minimum needs, which the start values may not tell.
//!
//! The minimum is sought by `rmpfit`, MINPACK's Levenberg–Marquardt with bounds and derivatives by
//! differences; it depends on nothing else. (`levenberg-marquardt` brings a second nalgebra and wants
//! derivatives; `basin` minimises in general and gives no covariance.)

use std::time::{Duration, Instant};

use anyhow::{Result, anyhow, ensure};

use crate::reading::Column;
use crate::scenario::session::{Session, SessionError};
use crate::scenario::{MOST_CYCLES, Refusal, Scenario};
use crate::studies::measured::{Measured, check_radii};
use crate::studies::refinement::{self, Budget, Level};
use crate::traces::Axes;
use nuisance::Nuisances;
use search::{Found, Search};
use solver::Free;

mod checked;
mod errors;
mod model;
mod nuisance;
mod profile;
mod report;
mod search;
mod solver;
mod structure;

pub use nuisance::NAMES;
pub use report::{Fitted, Nuisance, SetResult, Value};
pub use structure::Structure;

/// Cells and steps of the search, where the scenario asks for an accuracy and not for them.
const COARSE: (usize, u32) = (40, 16);

/// The tolerance of jumps on that level, in units of the depth.
const COARSE_JUMPS: f64 = 3e-3;

/// The numerics are resolved again where a key has moved by more than this in a logarithm, or of its value.
const MOVED: f64 = 0.2;

/// How much finer the run is that tells the numerical error; neither a multiple nor a divisor of the steps.
const FINER: f64 = 1.5;

/// A run that is [`FINER`] shows this part of the error, if it falls with the first to second power of the steps.
const SHOWN: f64 = 0.45;

/// Whether a nuisance is fitted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
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
pub struct Options {
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
    options: Options,
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
        options: Options,
    ) -> Result<Self> {
        let scenario = checked::with_stroke(scenario, &data, free, options.takes_stroke)?;
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

    /// Seeks the minimum; `on_run` hears of every run.
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
        let coarse = match self.scenario.accuracy() {
            None => self.scenario.clone(),
            Some(_) => self.coarse()?,
        };
        let search = |scenario, nuisances| Search::new(self, scenario, nuisances, on_run, &in_time);
        let mut best: Option<(Search, Found)> = None;
        let mut failure = anyhow!("no minimum was found");
        for nuisances in self.hypotheses() {
            // Another reading of a trace is tried where the plain one leaves more than noise.
            if best
                .as_ref()
                .is_some_and(|(search, found): &(Search, Found)| search.is_noise(found))
            {
                break;
            }
            let mut coarse = search(coarse.clone(), nuisances);
            coarse.is_coarse = self.scenario.accuracy().is_some();
            match coarse.locate(&start) {
                Ok(found)
                    if best
                        .as_ref()
                        .is_none_or(|(_, best)| found.objective < best.objective) =>
                {
                    best = Some((coarse, found));
                }
                Ok(_) => {}
                Err(why) => failure = why,
            }
        }
        let Some((mut located, mut found)) = best else {
            return Err(failure);
        };
        if located.drop_vague(&found) {
            found = located.descend(&found.theta, 2)?;
        }
        let (mut at, mut warning) = (found.theta.clone(), None);
        let mut fine = located.clone();
        fine.is_coarse = false;
        if self.scenario.accuracy().is_some() {
            for _ in 0..2 {
                let resolved = refinement::resolve(
                    &self.at(&self.scenario, &at)?,
                    Some(self.cycles),
                    Budget::UNLIMITED,
                    &in_time,
                );
                let resolved = match resolved {
                    Err(SessionError::Interrupted) => break,
                    resolved => resolved?,
                };
                warning = resolved.warning;
                fine.scenario = resolved.scenario;
                fine.forget();
                found = fine.descend(&at, 2)?;
                let moved = found.theta.iter().zip(&at).zip(&self.free);
                let is_near = |((new, old), free): ((&f64, &f64), &Free)| {
                    (new - old).abs() < MOVED * free.vague_at(*old)
                };
                let mut moved = moved;
                let is_settled = moved.all(is_near);
                at.clone_from(&found.theta);
                if is_settled {
                    break;
                }
            }
        }
        let scenario = self.at(&fine.scenario, &found.theta)?;
        let mut fitted = Fitted::new(&fine, &found, fine.uncertainty(&found), scenario);
        fitted.remarks.extend(warning);
        self.add_numerical_errors(&fine, &found, &mut fitted);
        located.nuisances.clone_from(&fine.nuisances);
        located.errors.clone_from(&fine.errors);
        profile::add_intervals(&located, &found, &mut fitted);
        if !in_time() {
            let budget = self.options.budget.unwrap_or_default();
            fitted.remarks.push(format!(
                "the search ended after {budget} s (--budget): this is the best so far"
            ));
        }
        Ok(fitted)
    }

    /// The scenario on the level of the search.
    fn coarse(&self) -> Result<Scenario> {
        let (points, steps) = COARSE;
        let tolerance = Level::of(&self.scenario).tolerance.map(|_| COARSE_JUMPS);
        Ok(Level::new(points, steps, tolerance).of_scenario(&self.scenario)?)
    }

    /// `scenario` with these values of the keys.
    fn at(&self, scenario: &Scenario, theta: &[f64]) -> Result<Scenario, SessionError> {
        let keys = self.free.iter().zip(theta);
        let values = keys.map(|(free, theta)| (free.key.as_str(), free.value(*theta)));
        Ok(scenario.with_numbers(values)?)
    }

    /// What may be fitted beside the keys. A trace on one side of its zero may begin at the axis or run through it.
    fn hypotheses(&self) -> Vec<Vec<Nuisances>> {
        let wanted = |k: usize, by_default: bool| match self.options.nuisances[k] {
            Switch::Auto => by_default,
            switch => switch == Switch::On,
        };
        let mut all = vec![Vec::new()];
        for set in &self.data {
            let (is_scar, is_loop) = (set.axes.over_r(), set.axes == Axes::LOOP);
            let is_whole = set.is_two_sided();
            let one = |is_whole: bool| Nuisances {
                active: [
                    wanted(0, is_scar || is_loop),
                    wanted(1, is_whole || is_loop) && !(is_scar && set.is_averaged),
                    wanted(2, is_whole) && is_scar,
                ],
                start: [0.0, if is_whole { set.centre() } else { 0.0 }, 0.0],
            };
            let mut ways = vec![one(is_whole)];
            if is_scar && is_whole {
                // Noise may hide where the middle is.
                let [level, _, tilt] = ways[0].start;
                ways.push(Nuisances {
                    start: [level, 0.0, tilt],
                    ..ways[0]
                });
            }
            if is_scar && !is_whole && !set.is_averaged && self.options.nuisances[1] == Switch::Auto
            {
                ways.push(one(true));
            }
            let extended = |before: &Vec<Nuisances>| {
                let ways = ways
                    .iter()
                    .map(|way| before.iter().copied().chain([*way]).collect());
                ways.collect::<Vec<Vec<Nuisances>>>()
            };
            // Repeats are traces of one kind: beyond a few files, all are as they seem.
            all = match all.len() {
                0..=2 => all.iter().flat_map(extended).collect(),
                _ => all
                    .iter()
                    .map(|before| before.iter().copied().chain([ways[0]]).collect())
                    .collect(),
            };
        }
        all
    }

    /// How much the keys would move on a finer level.
    fn add_numerical_errors(&self, fine: &Search, found: &Found, fitted: &mut Fitted) {
        let finer = Level::of(&fine.scenario).scaled(FINER, FINER);
        let Ok(scenario) = finer.of_scenario(&fine.scenario) else {
            return;
        };
        let mut finer = fine.clone();
        finer.scenario = scenario;
        finer.forget();
        let Some(moved) = finer.deviations_at(&found.theta, &found.nuisances) else {
            return;
        };
        let dz: Vec<f64> = moved
            .iter()
            .zip(&found.z)
            .map(|(new, old)| new - old)
            .collect();
        for ((value, free), (theta, step)) in fitted
            .values
            .iter_mut()
            .zip(&self.free)
            .zip(found.theta.iter().zip(fitted.errors.newton_step(&dz)))
        {
            value.numerical_error = value.stderr.map(|_| free.error(*theta, step.abs() / SHOWN));
            // Whoever has chosen cells and steps has chosen their error.
            let is_chosen = self.scenario.accuracy().is_none();
            if let (Some(numerical), Some(stderr)) = (value.numerical_error, value.stderr)
                && numerical > stderr
                && !is_chosen
            {
                fitted.remarks.push(format!(
                    "{}: the numerical error exceeds the statistical one; a smaller numerics.accuracy lowers it",
                    value.key
                ));
            }
        }
    }
}

/// The cycles of each run.
fn cycles(scenario: &Scenario, data: &[Measured], given: Option<f64>) -> Result<f64> {
    let planned = given.or(scenario.run().cycles).unwrap_or(0.0);
    let mut last = 0.0f64;
    let over = |set: &&Measured| {
        set.axes != Axes::LOOP && !set.axes.over_r() && set.axes.x != Column::Energy
    };
    if data.iter().any(|set| over(&set)) {
        let session = Session::start(scenario.clone())?;
        for set in data.iter().filter(over) {
            let per_cycle = model::per_cycle(session.simulation(), set.axes.x);
            let rule = "a sliding distance needs a prescribed displacement; give cycles instead";
            ensure!(per_cycle.is_finite(), Refusal::new(&set.name, rule));
            last = set.at.iter().map(|at| at / per_cycle).fold(last, f64::max);
        }
    }
    let cycles = planned.max(last);
    let most = format!("a run has at most {MOST_CYCLES:e} cycles");
    let rule = format!("the data end at cycle {cycles:e}; {most}");
    ensure!(cycles <= MOST_CYCLES, Refusal::from(rule));
    Ok(cycles)
}

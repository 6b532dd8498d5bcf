//! Computes how sensitive the results of a scenario are to its keys.
//!
//! # Formula
//!
//! The elasticity of a result y with respect to a key x, E = d ln y/d ln x, by the central difference D(h) = [ln y(x
//! eʰ) − ln y(x e⁻ʰ)]/2h and one step of Richardson extrapolation, E = [4 D(h) − D(2h)]/3. |E − D(h)| covers both the
//! remaining truncation error and the noise of the runs, and serves as the error of E. If an error exceeds `WANTED`,
//! all runs are repeated on a finer grid with more steps, at most `LEVELS` times.
//!
//! With standard deviations σ of the keys, which are assumed independent, the relative spread of y is √Σ(E σ/x)².
//!
//! All runs use the numerics chosen for the central scenario: an accuracy chooses by the values of the keys, and a
//! different choice would add noise to the difference.

use rayon::ThreadPool;
use rayon::prelude::*;

use super::Study;
use super::point::{self, Success};
use crate::math::number::exact;
use crate::scenario::{Refusal, Scenario};
use crate::studies::refinement::Level;
use crate::studies::table::Rows;

/// h, in ln x.
const STEP: f64 = 0.01;

/// Acceptable errors of elasticities: absolute, and relative to the elasticity.
const WANTED: (f64, f64) = (0.01, 0.02);

/// Maximum number of refinement levels; each halves cells and steps.
const LEVELS: u32 = 3;

/// Positions of the runs of a key, in units of the step.
const PLACES: [f64; 4] = [-2.0, -1.0, 1.0, 2.0];

/// Results of a sensitivity study.
#[derive(Debug)]
pub struct Sensitivity {
    /// A row per key and column, followed by the relative spread of each column due to all deviations together.
    pub table: Rows,
    /// Cells and steps per cycle of the last runs.
    pub numerics: (usize, u32),
    /// Whether every elasticity is as accurate as wanted.
    pub is_resolved: bool,
}

/// Computes the elasticities of the study's columns with respect to its sensitivity keys, or else to its axes, around
/// its base with its settings. `None` if `go_on` returned false before the end.
///
/// # Errors
///
/// If a key's value in the scenario is not a number greater than 0, or if a run failed.
pub fn run(
    study: &Study,
    pool: &ThreadPool,
    go_on: &(dyn Fn() -> bool + Sync),
) -> Result<Option<Sensitivity>, Refusal> {
    let middle = study.scenario_at(&[], None)?;
    let axes = study.axes.iter().map(|axis| (axis.key.clone(), 0.0));
    let keys = match &study.sensitivity[..] {
        [] => axes.collect(),
        asked => asked.to_vec(),
    };
    let valued = keys.iter().map(|(key, deviation)| {
        let deviation = Some(*deviation).filter(|known| *known > 0.0);
        let value = middle.number(key);
        match value.filter(|value| *value > 0.0 && value.is_finite()) {
            Some(value) => Ok((key.as_str(), deviation, value)),
            None => Err(Refusal::new(
                format_args!("sensitivity: {key}"),
                "must be a number greater than 0 in the base or in [set]",
            )),
        }
    });
    let keys = valued.collect::<Result<Vec<_>, _>>()?;
    let mut level = 0;
    loop {
        let finer = f64::from(1 << level);
        let fixed = Level::from_scenario(&middle)
            .scaled(finer, finer)
            .of_scenario(&middle);
        let fixed = fixed.map_err(|error| Refusal::new("sensitivity", error))?;
        let found = around(study, &fixed, &keys, pool, go_on)?;
        if level == LEVELS || found.as_ref().is_none_or(|found| found.is_resolved) {
            return Ok(found);
        }
        level += 1;
    }
}

/// Computes the elasticities around a scenario with fixed numerics.
fn around(
    study: &Study,
    fixed: &Scenario,
    keys: &[(&str, Option<f64>, f64)],
    pool: &ThreadPool,
    go_on: &(dyn Fn() -> bool + Sync),
) -> Result<Option<Sensitivity>, Refusal> {
    let mut scenarios = vec![fixed.clone()];
    for (key, _, value) in keys {
        for place in PLACES {
            let value = exact(value * (STEP * place).exp());
            let scenario = fixed.assigned(&[(key, &value)]);
            scenarios.push(scenario.map_err(|error| Refusal::new("sensitivity", error))?);
        }
    }
    let runs: Vec<_> = pool.install(|| {
        let runs = scenarios.into_par_iter();
        runs.map(|scenario| point::run_scenario(study, scenario, go_on))
            .collect()
    });
    if !go_on() {
        return Ok(None);
    }
    let mut results: Vec<Vec<Option<f64>>> = Vec::new();
    for row in runs.into_iter().flatten() {
        if !Success::from_row(&row).has_result() {
            let status = row.last().cloned().unwrap_or_default();
            return Err(Refusal::new("sensitivity", status));
        }
        let numbers = row.iter().map(|field| field.parse::<f64>().ok());
        results.push(numbers.collect());
    }
    let names = "key value column result elasticity error deviation relative_spread";
    let mut table = Rows::with_columns(&[("", names)]);
    let mut is_resolved = true;
    let has_deviation = keys.iter().any(|(_, deviation, _)| deviation.is_some());
    // The relative spread of each column, unless one of its elasticities is unknown.
    let mut spreads = vec![has_deviation.then_some(0.0); study.columns.len()];
    for (&(key, deviation, value), around) in keys.iter().zip(results[1..].chunks(PLACES.len())) {
        for (column, known) in study.columns.iter().enumerate() {
            let around: Option<Vec<f64>> = around.iter().map(|run| run[column]).collect();
            let found = around.as_deref().and_then(difference);
            let good = |[found, error]: [f64; 2]| error <= WANTED.0.max(WANTED.1 * found.abs());
            is_resolved &= found.is_none_or(good);
            let [elasticity, error] = found.map_or([None; 2], |found| found.map(Some));
            let spread = deviation.zip(elasticity);
            let spread = spread.map(|(deviation, found)| (found * deviation / value).abs());
            if deviation.is_some() {
                let both = spreads[column].zip(spread);
                spreads[column] = both.map(|(sum, spread)| f64::hypot(sum, spread));
            }
            let (name, result) = (known.name(), results[0][column]);
            table.push((
                key, value, name, result, elasticity, error, deviation, spread,
            ));
        }
    }
    for (column, spread) in spreads.into_iter().enumerate() {
        if spread.is_some() {
            let (name, result) = (study.columns[column].name(), results[0][column]);
            table.push(("all", (), name, result, (), (), (), spread));
        }
    }
    let setup = fixed.setup();
    Ok(Some(Sensitivity {
        table,
        numerics: (setup.grid.cells(), setup.steps_per_cycle),
        is_resolved,
    }))
}

/// Returns E and its error from the results at [`PLACES`]; `None` unless all are positive.
fn difference(results: &[f64]) -> Option<[f64; 2]> {
    let &[far_below, below, above, far_above] = results else {
        return None;
    };
    let is_positive = |result: &f64| *result > 0.0 && result.is_finite();
    if !results.iter().all(is_positive) {
        return None;
    }
    let near = (above / below).ln() / (2.0 * STEP);
    let far = (far_above / far_below).ln() / (4.0 * STEP);
    let extrapolated = (4.0 * near - far) / 3.0;
    Some([extrapolated, (extrapolated - near).abs()])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_has_its_exponent_as_elasticity() {
        let results = PLACES.map(|place| 7.0 * (STEP * place).exp().powf(1.5));
        let [elasticity, error] = difference(&results).expect("an elasticity");
        assert!((elasticity - 1.5).abs() < 1e-10 && error < 1e-10);
        // Noise appears as an error of the same size.
        let noisy = [results[0], results[1], results[2] * 1.001, results[3]];
        let [elasticity, error] = difference(&noisy).expect("an elasticity");
        assert!(error > 0.2 * (elasticity - 1.5).abs() && error > 0.01);
        assert_eq!(difference(&[1.0, 0.0, 1.0, 1.0]), None);
    }
}

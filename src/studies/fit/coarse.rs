//! The coarse levels of numerics on which a fit searches.

use anyhow::Result;

use crate::scenario::Scenario;
use crate::studies::refinement::Level;

/// Cells, steps and tolerance of jumps (in units of the depth) of the search, where the scenario leaves them open.
const COARSE: (usize, u32, f64) = (40, 16, 3e-4);

/// How much finer each level is in cells and in steps: no whole number, or both would see the same moments and radii.
pub(super) const FINER: f64 = 1.6;

/// The scenario on the level of the search: its own where it names one.
pub(super) fn of_search(scenario: &Scenario) -> Result<Scenario> {
    if scenario.accuracy().is_none() {
        return Ok(scenario.clone());
    }
    let (points, steps, tolerance) = COARSE;
    let jumps = match scenario.spec().numerics.integrator {
        Some(_) => Level::from_scenario(scenario).tolerance.is_some(),
        None => scenario.setup().drive.repeats_after().is_some(),
    };
    let level = Level::new(points, steps, jumps.then_some(tolerance));
    Ok(level.of_scenario(scenario)?)
}

/// Returns the scenario on the first level on which a fit may end: two levels finer than the search.
pub(super) fn of_figures(scenario: &Scenario) -> Result<Scenario> {
    let search = of_search(scenario)?;
    if scenario.accuracy().is_none() {
        return Ok(search);
    }
    let finer = Level::from_scenario(&search).scaled(FINER * FINER, FINER * FINER);
    Ok(finer.of_scenario(&search)?)
}

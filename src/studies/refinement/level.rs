//! How finely a scenario is computed: cells, steps and the tolerance of jumps.

use crate::math::grid::{MAX_CELLS, MIN_CELLS};
use crate::scenario::{Scenario, ScenarioError};
use crate::simulation::Integrator;

/// The fewest steps per cycle that are tried.
const MIN_STEPS: u32 = 4;

/// One level of refinement.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Level {
    /// N, cells of the grid.
    pub points: usize,
    /// Steps per cycle.
    pub steps: u32,
    /// The tolerance of jumps over cycles, in units of the largest depth; `None` if every cycle is stepped.
    pub tolerance: Option<f64>,
}

impl Level {
    /// The level of a scenario as it stands.
    pub fn of(scenario: &Scenario) -> Self {
        let setup = scenario.setup();
        Self {
            points: setup.grid.cells(),
            steps: setup.steps_per_cycle,
            tolerance: match setup.integrator {
                Integrator::Direct => None,
                Integrator::CycleJump { tolerance } => Some(tolerance),
            },
        }
    }

    /// The same with `cells` times the cells and `time` times the steps, within what a scenario may have.
    #[must_use]
    pub fn scaled(&self, cells: f64, time: f64) -> Self {
        let points = (self.points as f64 * cells).round();
        let steps = (f64::from(self.steps) * time).round();
        Self {
            points: points.clamp(MIN_CELLS as f64, MAX_CELLS as f64) as usize,
            steps: steps.clamp(f64::from(MIN_STEPS.min(self.steps)), 1e6) as u32,
            tolerance: self.tolerance.map(|tolerance| at_steps(tolerance, time)),
        }
    }

    /// By how much this level is finer than another one, in cells and in time.
    pub fn ratio(&self, coarse: &Self) -> (f64, f64) {
        (
            self.points as f64 / coarse.points as f64,
            f64::from(self.steps) / f64::from(coarse.steps),
        )
    }

    /// The keys of a scenario and their values.
    pub fn keys(&self) -> Vec<(&'static str, String)> {
        let mut keys = vec![
            ("numerics.points", self.points.to_string()),
            ("numerics.steps_per_cycle", self.steps.to_string()),
        ];
        if let Some(tolerance) = self.tolerance {
            let integrator = Integrator::CycleJump { tolerance };
            keys.push(("numerics.integrator", integrator.name().to_owned()));
            keys.push(("numerics.tolerance", format!("{tolerance:e}")));
        } else {
            keys.push(("numerics.integrator", Integrator::Direct.name().to_owned()));
        }
        keys
    }

    /// The scenario computed so; its changes stay.
    ///
    /// # Errors
    /// If the scenario's method or shape does not allow this many cells.
    pub fn of_scenario(&self, scenario: &Scenario) -> Result<Scenario, ScenarioError> {
        let keys = self.keys();
        let keys: Vec<(&str, &str)> = keys.iter().map(|(k, v)| (*k, v.as_str())).collect();
        scenario.with_all(&keys)
    }
}

/// The tolerance of jumps that goes with `time` times the steps. It bounds the error of a jump, which so falls about
/// as the error of the steps does; a higher power of `time` makes jumps shorter than the steps are worth.
pub(super) fn at_steps(tolerance: f64, time: f64) -> f64 {
    rounded((tolerance / time).clamp(1e-12, 0.1))
}

/// Two digits: no more than anybody would write.
fn rounded(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}

//! The resolution of a computation: cells, steps and the tolerance of jumps.

use crate::math::grid::{MAX_CELLS, MIN_CELLS, RadialGrid};
use crate::scenario::spec::{Numerics, Passage};
use crate::scenario::{Refusal, Scenario};
use crate::simulation::{Integrator, Spacing};

/// Minimum number of steps per cycle.
const MIN_STEPS: u32 = 4;

/// Maximum tolerance of a scenario.
pub(super) const MOST_TOLERANT: f64 = 0.1;

/// How much finer one level is than another: in cells, in steps per cycle, and in jumps over the same cycles.
pub(super) type Ratio = [f64; 3];

/// The error of a jump is of third order in its length, so this many times the jumps require a tolerance smaller by the
/// third power.
const ORDER_OF_A_JUMP: f64 = 3.0;

/// One level of refinement.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    /// N, cells of the grid.
    pub points: usize,
    /// Steps per cycle.
    pub steps: u32,
    /// The tolerance of jumps over cycles, in units of the depth; `None` if every cycle is stepped.
    pub tolerance: Option<f64>,
    /// The nodes, if a coarser run has placed them.
    pub nodes: Option<RadialGrid>,
}

impl Level {
    /// Makes a level without placed nodes.
    pub fn new(points: usize, steps: u32, tolerance: Option<f64>) -> Self {
        Self {
            points,
            steps,
            tolerance,
            nodes: None,
        }
    }

    /// Returns the level of a scenario.
    pub fn from_scenario(scenario: &Scenario) -> Self {
        let setup = scenario.setup();
        Self {
            points: setup.grid.cells(),
            steps: setup.steps_per_cycle,
            tolerance: match setup.integrator {
                Integrator::Direct => None,
                Integrator::CycleJump { tolerance } => Some(tolerance),
            },
            nodes: (setup.spacing == Spacing::Given).then(|| setup.grid.clone()),
        }
    }

    /// Returns the level with `cells` times the cells and `time` times the steps, and with jumps to match, within the
    /// limits of a scenario.
    #[must_use]
    pub fn scaled(&self, cells: f64, time: f64) -> Self {
        let tolerance = self.tolerance.map(|tolerance| at_steps(tolerance, time));
        Self {
            tolerance,
            ..self.refined([cells, time, 1.0])
        }
    }

    /// Returns the number of error sources: cells and steps, and jumps if there are any.
    pub(super) fn sources(&self) -> usize {
        2 + usize::from(self.tolerance.is_some())
    }

    /// Returns the level refined by the given ratios, within the limits of a scenario. Nodes keep their spacing.
    #[must_use]
    pub(super) fn refined(&self, [cells, steps, jumps]: Ratio) -> Self {
        let points = (self.points as f64 * cells).round();
        let points = points.clamp(MIN_CELLS as f64, MAX_CELLS as f64) as usize;
        let steps = (f64::from(self.steps) * steps).round();
        let tolerance = |before: f64| match jumps {
            1.0 => before,
            _ => rounded((before / jumps.powf(ORDER_OF_A_JUMP)).clamp(1e-12, MOST_TOLERANT)),
        };
        Self {
            points,
            steps: steps.clamp(f64::from(MIN_STEPS.min(self.steps)), 1e6) as u32,
            tolerance: self.tolerance.map(tolerance),
            nodes: match &self.nodes {
                Some(grid) if grid.cells() != points => grid.resampled(points).ok(),
                same => same.clone(),
            },
        }
    }

    /// Returns how much finer this level is than a `coarse` one.
    pub(super) fn ratio(&self, coarse: &Self) -> Ratio {
        let jumps = match (self.tolerance, coarse.tolerance) {
            (Some(fine), Some(coarse)) => (coarse / fine).powf(1.0 / ORDER_OF_A_JUMP),
            _ => 1.0,
        };
        [
            self.points as f64 / coarse.points as f64,
            f64::from(self.steps) / f64::from(coarse.steps),
            jumps,
        ]
    }

    /// Puts the numerics of a scenario on this level.
    pub fn set(&self, numerics: &mut Numerics) {
        numerics.accuracy = None;
        numerics.points = Some(self.points);
        numerics.steps_per_cycle = Some(self.steps);
        let jumps = self.tolerance.map(|_| Passage::CycleJump);
        numerics.integrator = jumps.or(Some(Passage::Direct));
        numerics.tolerance = self.tolerance.or(numerics.tolerance);
        numerics.nodes = self.nodes.as_ref().map(|grid| grid.nodes().to_vec());
        numerics.grid = numerics.grid.filter(|_| self.nodes.is_none());
    }

    /// Returns the scenario on this level, including its changes.
    ///
    /// # Errors
    /// If the scenario's method or shape does not allow this many cells.
    pub fn of_scenario(&self, scenario: &Scenario) -> Result<Scenario, Refusal> {
        scenario.edited(|spec| self.set(&mut spec.numerics))
    }
}

/// Returns the tolerance of jumps for `time` times the steps. It bounds the error of a jump, which so falls about as
/// the error of the steps does; a higher power of `time` would make jumps shorter than the steps justify.
pub(super) fn at_steps(tolerance: f64, time: f64) -> f64 {
    rounded((tolerance / time).clamp(1e-12, MOST_TOLERANT))
}

/// Rounds to two digits, as people write them.
fn rounded(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}

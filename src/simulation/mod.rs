//! The simulation: the loop of Fig. 1 of the paper, one step at a time.
//!
//! It takes parts that are already valid and knows nothing of scenarios, files or screens.

use std::sync::Arc;

use crate::contact::indenter::Indenter;
use crate::contact::material::Material;
use crate::math::abel::AbelMethod;
use crate::math::grid::RadialGrid;
use crate::math::quadrature;
use crate::wear::WearLaw;

pub mod breakdown;
pub mod drive;
mod integrator;
pub mod observation;
mod solve;
pub mod state;
mod workspace;

pub use breakdown::{Breakdown, Cause};
use drive::{Drive, LONGEST_REPEAT};
pub use observation::{Curves, Moment, Observation, Zone};
pub use state::State;
use workspace::Workspace;

/// The parts that a run is assembled from, each validated on its own floor.
#[derive(Debug, Clone, PartialEq)]
pub struct Setup {
    /// Nodes of the 3D and of the 1D contact.
    pub grid: RadialGrid,
    /// Moduli and friction.
    pub material: Material,
    /// The unworn shape.
    pub indenter: Indenter,
    /// The motion.
    pub drive: Drive,
    /// The law of wear; none: nothing wears, and no stress is computed for it.
    pub wear: Option<WearLaw>,
    /// The way to compute the transforms.
    pub method: AbelMethod,
    /// Steps a cycle, at least 1.
    pub steps_per_cycle: u32,
}

impl Setup {
    /// The largest depth of the motion, m, where the displacement is prescribed.
    fn deepest(&self) -> Option<f64> {
        match self.drive.normal() {
            drive::Control::Displacement(oscillation) => Some(oscillation.highest()),
            drive::Control::Force(_) => None,
        }
    }
}

/// A running simulation.
#[derive(Debug, Clone)]
pub struct Simulation {
    setup: Setup,
    state: State,
    workspace: Workspace,
}

impl Simulation {
    /// Presses the unworn indenter to u_z(0), then shifts it to u_x(0), without wear.
    pub fn new(setup: Setup) -> Result<Self, Breakdown> {
        let state = State::new(setup.grid.len(), setup.drive.tangential().is_some());
        Self::resume(setup, state)
    }

    /// Goes on from a saved state.
    pub fn resume(setup: Setup, state: State) -> Result<Self, Breakdown> {
        let workspace = Workspace::new(&setup, None);
        let mut simulation = Self {
            setup,
            state,
            workspace,
        };
        simulation.settle()?;
        Ok(simulation)
    }

    /// Replaces the parts mid-run. The worn profile, the springs and the counters are carried over;
    /// on another grid they are interpolated. Where the new parts cannot hold the contact, the
    /// simulation stays as it was.
    pub fn reconfigure(&mut self, setup: Setup) -> Result<(), Breakdown> {
        let same_grid = setup.grid == self.setup.grid;
        let plan = (same_grid && setup.method == self.setup.method)
            .then(|| Arc::clone(&self.workspace.plan));
        let mut state = self.state.clone();
        if !same_grid {
            let onto = |values: &[f64]| {
                setup
                    .grid
                    .nodes()
                    .iter()
                    .map(|&r| self.setup.grid.interpolate(values, r))
                    .collect()
            };
            state.wear = onto(&self.state.wear);
            if !state.spring.is_empty() {
                state.spring = onto(&self.state.spring);
            }
        }
        state.spring.resize(
            if setup.drive.tangential().is_some() {
                setup.grid.len()
            } else {
                0
            },
            0.0,
        );
        let workspace = Workspace::new(&setup, plan);
        let mut changed = Self {
            setup,
            state,
            workspace,
        };
        changed.settle()?;
        *self = changed;
        Ok(())
    }

    /// The parts in use.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// The state after the last good step.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Cycles since the start.
    pub fn cycle(&self) -> f64 {
        self.state.cycle
    }

    /// Takes one step, to the next multiple of 1/steps-per-cycle.
    pub fn step(&mut self) -> Result<(), Breakdown> {
        let cycle = self.next_moment();
        self.step_to(cycle)
    }

    /// Steps until `cycle` is reached; the last step is shortened so as to end there exactly.
    pub fn advance_to(&mut self, cycle: f64) -> Result<(), Breakdown> {
        while self.state.cycle < cycle {
            let next = self.next_moment();
            // A step that would end within rounding of the goal ends at the goal.
            self.step_to(if next > cycle - self.rounding() {
                cycle
            } else {
                next
            })?;
        }
        Ok(())
    }

    /// Cycles that are less than this apart are the same moment.
    pub fn rounding(&self) -> f64 {
        1e-6 / f64::from(self.setup.steps_per_cycle)
    }

    /// The next multiple of 1/steps-per-cycle after the present cycle.
    pub fn next_moment(&self) -> f64 {
        let steps = f64::from(self.setup.steps_per_cycle);
        ((self.state.cycle * steps + 1e-6).floor() + 1.0) / steps
    }

    /// One step of the integrator; the state changes only if all went well.
    fn step_to(&mut self, cycle: f64) -> Result<(), Breakdown> {
        match integrator::direct::step(&self.setup, &mut self.state, &mut self.workspace, cycle) {
            Ok(()) => Ok(()),
            Err(cause) => {
                let breakdown = Breakdown {
                    cycle: self.state.cycle,
                    cause,
                };
                // Leave buffers that belong to the last good state; they held a contact before.
                let _ = self.settle();
                Err(breakdown)
            }
        }
    }

    /// Solves the contact at the present cycle, without wear and without passing time.
    fn settle(&mut self) -> Result<(), Breakdown> {
        integrator::direct::settle(&self.setup, &mut self.state, &mut self.workspace).map_err(
            |cause| Breakdown {
                cycle: self.state.cycle,
                cause,
            },
        )
    }

    /// Worn volume 2π∫(f − f₀) r dr, m³.
    pub fn wear_volume(&self) -> f64 {
        quadrature::volume_of_revolution(self.setup.grid.nodes(), &self.state.wear)
    }
}

/// Cycles after which the permanent stick radius is read anew: the common period of the motion.
fn cycles_to_settle(drive: &Drive) -> u32 {
    drive.repeats_after().unwrap_or(LONGEST_REPEAT)
}

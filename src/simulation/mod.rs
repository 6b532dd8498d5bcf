//! The simulation: the loop of Fig. 1 of the paper, one step at a time.
//!
//! It takes parts that are already valid and knows nothing of scenarios, files or screens.

use std::sync::Arc;

use crate::contact::indenter::Indenter;
use crate::contact::material::Material;
use crate::contact::tangential::Hold;
use crate::math::abel::AbelMethod;
use crate::math::grid::RadialGrid;
use crate::math::quadrature::weighted;
use crate::wear::WearLaw;

mod border;
pub mod breakdown;
mod choices;
pub mod drive;
mod integrator;
mod moments;
pub mod observation;
mod profile;
mod saved;
mod solve;
pub mod stability;
pub mod state;
mod stress;
mod workspace;

pub use breakdown::{Breakdown, Cause};
pub use choices::{Integrator, Scheme, Spacing, Stability};
use drive::{Drive, LONGEST_REPEAT};
pub use observation::{Curves, Moment, Observation, Zone};
pub use saved::{Saved, Unfit};
use state::JumpMemory;
pub use state::{Effort, State};
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
    /// Whether the grid is to be graded towards the stick border; [`grid`](Self::grid) then only
    /// says how many cells there are and where the domain ends.
    pub spacing: Spacing,
    /// How a step in time is taken.
    pub scheme: Scheme,
    /// What is done about steps that are too harsh.
    pub stability: Stability,
    /// Steps a cycle, at least 1.
    pub steps_per_cycle: u32,
    /// How cycles are gone through.
    pub integrator: Integrator,
}

impl Setup {
    /// The largest depth of the motion, m, where the displacement is prescribed.
    pub fn largest_depth(&self) -> Option<f64> {
        match self.drive.normal() {
            drive::Control::Displacement(oscillation) => Some(oscillation.highest()),
            drive::Control::Force(_) => None,
        }
    }

    /// The depth that wear is measured in, m: the largest of the motion, or the `present` one where the
    /// force is prescribed.
    pub fn depth_scale(&self, present: f64) -> f64 {
        self.largest_depth().unwrap_or(present)
    }
}

/// A running simulation.
#[derive(Debug, Clone)]
pub struct Simulation {
    setup: Setup,
    state: State,
    workspace: Workspace,
    /// Where the next step ends, and whether the motion turns there.
    next: (f64, bool),
}

impl Simulation {
    /// Presses the unworn indenter to u_z(0), then shifts it to u_x(0), without wear.
    pub fn new(setup: Setup) -> Result<Self, Breakdown> {
        let setup = border::graded(&setup, None);
        let state = State::new(setup.grid.len(), setup.drive.tangential().is_some());
        Self::resume(setup, state)
    }

    /// Goes on from a saved state, on the grid of `setup` as it is.
    pub fn resume(setup: Setup, state: State) -> Result<Self, Breakdown> {
        let workspace = Workspace::new(&setup, None);
        let mut simulation = Self {
            setup,
            state,
            workspace,
            next: (0.0, false),
        };
        simulation.settle()?;
        Ok(simulation)
    }

    /// Replaces the parts mid-run. The worn profile, the springs and the counters are carried over;
    /// on another grid they are interpolated. Where the new parts cannot hold the contact, the
    /// simulation stays as it was.
    pub fn reconfigure(&mut self, setup: Setup) -> Result<(), Breakdown> {
        let setup = if border::stays(&self.setup, &setup) {
            Setup {
                grid: self.setup.grid.clone(),
                ..setup
            }
        } else {
            border::graded(&setup, Some(self))
        };
        let state = self.state_on(&setup);
        let same = setup.grid == self.setup.grid
            && setup.method == self.setup.method
            && setup.indenter == self.setup.indenter;
        let planned = same.then(|| Arc::clone(&self.workspace.planned));
        let workspace = Workspace::new(&setup, planned);
        let mut changed = Self {
            setup,
            state,
            workspace,
            next: (0.0, false),
        };
        changed.settle()?;
        *self = changed;
        Ok(())
    }

    /// The present state on the grid of another setup.
    fn state_on(&self, setup: &Setup) -> State {
        let mut state = self.state.clone();
        state.jump = JumpMemory::default();
        let nodes = setup.grid.len();
        if setup.grid != self.setup.grid {
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
                state.hold = vec![Hold::Stick; nodes];
            }
        }
        let springs = if setup.drive.tangential().is_some() {
            nodes
        } else {
            0
        };
        state.spring.resize(springs, 0.0);
        state.hold.resize(springs, Hold::Stick);
        state
    }

    /// The parts in use; the grid is the one that is computed on.
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

    /// Takes one step, to the next moment, or one jump over many cycles.
    pub fn step(&mut self) -> Result<(), Breakdown> {
        self.step_until(f64::INFINITY)
    }

    /// Takes one step or jump that ends at `cycle` at the latest; nothing if that has been reached.
    pub fn step_until(&mut self, cycle: f64) -> Result<(), Breakdown> {
        if self.state.cycle >= cycle || self.jump(cycle - self.state.cycle)? {
            return Ok(());
        }
        let (next, turns) = self.next;
        // A step that would end within rounding of the goal ends at the goal.
        let reached = next > cycle - self.rounding();
        let at_turn = turns && next < cycle + self.rounding();
        self.step_to(if reached { cycle } else { next }, at_turn)
    }

    /// Steps until `cycle` is reached exactly.
    pub fn advance_to(&mut self, cycle: f64) -> Result<(), Breakdown> {
        while self.state.cycle < cycle {
            self.step_until(cycle)?;
        }
        Ok(())
    }

    /// Whether the next step may be a jump over many cycles.
    pub fn may_jump(&self) -> bool {
        integrator::is_possible(&self.setup, &self.state)
    }

    /// Why cycles that were to be jumped are all stepped directly; none where they are jumped.
    pub fn why_never_jumped(&self) -> Option<&'static str> {
        let Setup {
            drive,
            wear,
            integrator,
            ..
        } = &self.setup;
        match integrator {
            Integrator::Direct => None,
            _ if drive.tangential().is_none() || wear.is_none() => Some("nothing wears"),
            _ if drive.repeats_after().is_none() => {
                Some("the two frequencies have no common period, so no two cycles are alike")
            }
            Integrator::CycleJump { .. } => None,
        }
    }

    /// Jumps over at most `most` cycles, where that is wanted and pays.
    fn jump(&mut self, most: f64) -> Result<bool, Breakdown> {
        if !self.may_jump() {
            return Ok(false);
        }
        let jumped = integrator::jump(&self.setup, &mut self.state, &mut self.workspace, most)
            .map_err(|cause| self.broken(cause))?;
        self.next = self.look_ahead();
        Ok(jumped == integrator::Jumped::Done)
    }

    /// What is looked at now must be the last good state, not the contact that failed.
    fn broken(&mut self, cause: Cause) -> Breakdown {
        self.workspace.show_last_good(&self.state);
        Breakdown {
            cycle: self.state.cycle,
            cause,
        }
    }

    /// Cycles that are less than this apart are the same moment.
    pub fn rounding(&self) -> f64 {
        moments::rounding(&self.setup, self.state.cycle)
    }

    /// The cycle at which the next step ends, if it is not a jump: the next multiple of
    /// 1/steps-per-cycle, or before it the next turning point of the motion, if the scheme minds.
    pub fn next_moment(&self) -> f64 {
        self.next.0
    }

    /// Looks for the end of the next step.
    fn look_ahead(&self) -> (f64, bool) {
        moments::next(&self.setup, self.state.cycle, self.state.steps > 0)
    }

    /// One step of the integrator; the state changes only if all went well.
    fn step_to(&mut self, cycle: f64, turns: bool) -> Result<(), Breakdown> {
        integrator::step(
            &self.setup,
            &mut self.state,
            &mut self.workspace,
            cycle,
            turns,
        )
        .map_err(|cause| self.broken(cause))?;
        self.next = self.look_ahead();
        Ok(())
    }

    /// Solves the contact at the present cycle, without wear and without passing time.
    fn settle(&mut self) -> Result<(), Breakdown> {
        integrator::settle(&self.setup, &mut self.state, &mut self.workspace).map_err(|cause| {
            Breakdown {
                cycle: self.state.cycle,
                cause,
            }
        })?;
        self.next = self.look_ahead();
        Ok(())
    }

    /// Worn volume 2π∫(f − f₀) r dr, m³.
    pub fn wear_volume(&self) -> f64 {
        worn_volume(&self.state, &self.workspace)
    }
}

/// 2π∫(f − f₀) r dr of the profile as it stands, m³.
fn worn_volume(state: &State, work: &Workspace) -> f64 {
    weighted(&work.planned.volume_weights, &state.wear) + at_rim(work)
}

/// The integral of the rate of wear over surface and time, m³.
fn volume_by_rate(state: &State, work: &Workspace) -> f64 {
    weighted(&work.planned.volume_weights, &state.wear) + state.volume_between_nodes
}

/// What the kink at the rim of the worn zone adds to the interpolant of the nodes, m³.
fn at_rim(work: &Workspace) -> f64 {
    let rim = work.rim.as_ref();
    rim.map_or(0.0, |rim| rim.volume(&work.planned.grid))
}

/// Cycles after which the permanent stick radius is read anew: the common period of the motion.
fn cycles_to_settle(drive: &Drive) -> u32 {
    drive.repeats_after().unwrap_or(LONGEST_REPEAT)
}

//! The simulation: the loop of Fig. 1 of the paper, one step at a time.
//!
//! It takes valid parts and knows nothing of scenarios, files or screens.
//!
//! Each round has four values: the worn profile and its 1D image in the [`State`], the
//! [`Contact`](contact::Contact) of the springs, their stress, and the
//! wear. A `step` makes the next state from the last one and from a `Model`, which is planned
//! once per run; a failed step changes nothing.
//!
//! ```
//! use mdr_tui::contact::{indenter::Indenter, material::Material};
//! use mdr_tui::math::{abel::AbelMethod, geometry::Geometry, grid::RadialGrid};
//! use mdr_tui::simulation::drive::{Control, Drive, Oscillation};
//! use mdr_tui::simulation::{Integrator, Scheme, Setup, Simulation, Spacing, Stability};
//! use mdr_tui::wear::WearLaw;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! // A sphere of 1 cm radius pressed by 1 µm into steel, and moved to and fro by 0.05 µm.
//! let setup = Setup {
//!     grid: RadialGrid::uniform(100, 1.5e-4)?,
//!     material: Material::new(2.3e11, 0.3, 0.1)?,
//!     indenter: Indenter::paraboloid(1e-2)?,
//!     geometry: Geometry::Round,
//!     drive: Drive::new(
//!         Control::Displacement(Oscillation::new(1e-6, 0.0, 100.0, 0.0)?),
//!         Some(Control::Displacement(Oscillation::new(0.0, 5e-8, 100.0, 0.0)?)),
//!     ),
//!     wear: Some(WearLaw::archard(1e-10)?),
//!     running_in: None,
//!     scar: None,
//!     hardness: None,
//!     method: AbelMethod::Product,
//!     spacing: Spacing::Graded,
//!     scheme: Scheme::Trapezoid,
//!     stability: Stability::SubStep,
//!     steps_per_cycle: 40,
//!     integrator: Integrator::Direct,
//! };
//! let mut simulation = Simulation::new(setup)?;
//! simulation.advance_to(3.0)?;
//! let now = simulation.moment();
//! // What has worn is k times the work of friction.
//! let expected = 1e-10 * now.dissipated_energy;
//! assert!((now.wear_volume / expected - 1.0).abs() < 0.01);
//! // The middle of the contact never slips, and never wears.
//! let stuck = now.permanent_stick_radius.expect("a tangential motion");
//! assert!((stuck / 7.67e-5 - 1.0).abs() < 0.01, "{stuck}");
//! assert_eq!(simulation.worn_depth()[0], 0.0);
//! # Ok(())
//! # }
//! ```

pub(crate) mod border;
pub mod breakdown;
mod choices;
pub mod contact;
pub mod drive;
mod fine_period;
mod friction;
mod mean_shear;
mod model;
mod moments;
pub(crate) mod placing;
mod profile;
mod reconfigure;
pub mod running_in;
mod saved;
mod setup;
pub mod stability;
pub mod state;
mod step;
pub mod traction;
mod unworn;
pub mod waveform;
mod wear;
mod within_step;

pub use breakdown::{Breakdown, Cause};
pub use choices::{Integrator, Scheme, Spacing, Stability};
pub use fine_period::{FinePeriod, PeriodPoint};
pub(crate) use model::Model;
use profile::{Profile, even_end, scar_volume};
pub use reconfigure::Domain;
pub use saved::{Saved, Unfit};
pub use setup::Setup;
pub use state::{State, Stats};
use step::Scratch;
pub use unworn::Unworn;

use crate::math::abel::counted;

/// A running simulation.
#[derive(Debug, Clone)]
pub struct Simulation {
    model: Model,
    /// State after the last good step.
    state: State,
    /// Buffers for the next step and its sub-steps; the first holds the state before the last step.
    spare: [State; 2],
    scratch: Scratch,
    /// Where the next step ends, and whether the motion turns there.
    next: (f64, bool),
    /// Whether the last step or jump was cut short by its goal.
    is_shortened: bool,
}

impl Setup {
    /// Updates friction and wear to their run-in values after `cycle` cycles and work of friction of `energy` (J).
    fn run_in(&mut self, cycle: f64, energy: f64) {
        if let Some(running_in) = &self.running_in {
            running_in.apply(cycle, energy, &mut self.material, &mut self.wear);
        }
    }
}

impl Simulation {
    /// Presses the indenter, unworn or with the scar of `setup`, to u_z(0), then shifts it to u_x(0), without wear.
    pub fn new(setup: Setup) -> Result<Self, Breakdown> {
        Self::begin(border::graded(&setup, None))
    }

    /// Begins a new run on the grid of `setup`.
    fn begin(setup: Setup) -> Result<Self, Breakdown> {
        let model = Model::new(setup, None);
        let mut state = State::new(model.nodes(), model.springs() > 0);
        if model.setup.scar.is_some() {
            state.wear = model.setup.initial_wear(&model.grid);
            model.plan.image(&state.wear, &mut state.image);
            // The work that wore it is unknown.
            state.ledger.initial_volume = scar_volume(&model, &state.wear, None);
            state.ledger.unexplained_volume = state.ledger.initial_volume;
        }
        Self::continued(model, state)
    }

    /// Continues from a saved state, on the grid of `setup`.
    pub fn resume(setup: Setup, state: State) -> Result<Self, Breakdown> {
        Self::continued(Model::new(setup, None), state)
    }

    fn continued(model: Model, state: State) -> Result<Self, Breakdown> {
        let mut simulation = Self::from_parts(model, state);
        simulation.solve_contact()?;
        Ok(simulation)
    }

    fn from_parts(model: Model, state: State) -> Self {
        Self {
            spare: [state.clone(), state.clone()],
            scratch: Scratch::new(&model),
            next: (0.0, false),
            is_shortened: false,
            model,
            state,
        }
    }

    /// Returns the parts in use, with the grid of the computation.
    pub fn setup(&self) -> &Setup {
        &self.model.setup
    }

    /// Worn depth f − f₀, m, at the nodes.
    pub fn worn_depth(&self) -> &[f64] {
        &self.state.wear
    }

    /// Returns the growth of f in the last step, m, at the nodes; 0 after a jump.
    pub fn last_wear(&self) -> &[f64] {
        &self.state.last.wear
    }

    /// Steps taken since the start.
    pub fn steps(&self) -> u64 {
        self.state.steps
    }

    /// Returns counts of the computations so far.
    pub fn stats(&self) -> Stats {
        self.state.stats
    }

    /// Returns the operators of the run, for readers of its state.
    pub(crate) fn model(&self) -> &Model {
        &self.model
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

    /// Takes one step or jump that ends at `cycle` at the latest; does nothing if that is reached already.
    pub fn step_until(&mut self, cycle: f64) -> Result<(), Breakdown> {
        self.is_shortened = false;
        if self.state.cycle >= cycle || self.jump(cycle - self.state.cycle)? {
            return Ok(());
        }
        let (next, turns) = self.next;
        // A step that would end within rounding of the goal ends exactly at the goal.
        let reached = next > cycle - self.rounding();
        self.is_shortened |= reached && next.to_bits() != cycle.to_bits();
        let at_turn = turns && next < cycle + self.rounding();
        self.step_to(if reached { cycle } else { next }, at_turn)
    }

    /// Whether the goal of the last [`step_until`](Self::step_until) has changed that step or jump. Without it, the run
    /// would have taken other steps, so it is reproduced bit for bit only with the same goal.
    pub fn was_shortened(&self) -> bool {
        self.is_shortened
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
        step::is_possible(self.setup(), &self.state)
    }

    /// Jumps over at most `most` cycles, if jumps are wanted and pay.
    fn jump(&mut self, most: f64) -> Result<bool, Breakdown> {
        if !self.may_jump() {
            return Ok(false);
        }
        use step::Jumped;
        let (state, spare) = (&self.state, &mut self.spare[0]);
        let (jumped, transforms) =
            counted(|| step::jump(&self.model, state, spare, &mut self.scratch, most));
        let jumped = jumped.map_err(|cause| self.refused(cause))?;
        std::mem::swap(&mut self.state, &mut self.spare[0]);
        self.state.stats.transforms += transforms;
        // A jump uses other buffers.
        self.spare[0].clone_from(&self.state);
        if jumped == Jumped::WithoutRoom && self.grow()? {
            return self.jump(most);
        }
        self.is_shortened = matches!(jumped, Jumped::Shortened | Jumped::TooNear);
        let jumped = matches!(jumped, Jumped::Done | Jumped::Shortened);
        self.run_in();
        self.next = self.look_ahead();
        Ok(jumped)
    }

    /// Returns the difference in cycles below which two moments count as the same.
    pub fn rounding(&self) -> f64 {
        moments::rounding(self.setup(), self.state.cycle)
    }

    /// The cycle at which the next step ends, if it is not a jump: the next multiple of
    /// 1/steps-per-cycle, or before it the next turning point of the motion, if the scheme minds.
    pub fn next_moment(&self) -> f64 {
        self.next.0
    }

    /// Finds the end of the next step.
    fn look_ahead(&self) -> (f64, bool) {
        let g = self.model.profile_from_axis(&self.state.image);
        let (setup, state) = (self.setup(), &self.state);
        let touch = moments::Touch::new(setup, state, g);
        let turning = |from, until| touch.turning_point(setup, from, until);
        moments::next(setup, touch, state.cycle, state.steps > 0, turning)
    }

    /// Takes one step into the spare state, which becomes the present one on success.
    fn step_to(&mut self, cycle: f64, turns: bool) -> Result<(), Breakdown> {
        let (state, spare) = (&self.state, &mut self.spare);
        let (stepped, transforms) =
            counted(|| step::step(&mut self.model, state, spare, &mut self.scratch, cycle));
        if let Err(cause) = stepped {
            self.run_in();
            return if cause.lacks_room() && self.grow()? {
                self.step_to(cycle, turns)
            } else {
                Err(self.refused(cause))
            };
        }
        std::mem::swap(&mut self.state, &mut self.spare[0]);
        self.state.stats.transforms += transforms;
        if turns {
            self.state.last.duration = 0.0;
        }
        self.state.steps += 1;
        self.run_in();
        self.next = self.look_ahead();
        Ok(())
    }

    /// Updates friction and wear to their run-in values.
    fn run_in(&mut self) {
        let (cycle, energy) = (self.state.cycle, self.state.ledger.dissipated_energy);
        self.model.setup.run_in(cycle, energy);
    }

    /// Solves the contact at the present cycle, without wear and without advancing time.
    fn solve_contact(&mut self) -> Result<(), Breakdown> {
        self.run_in();
        let (solved, transforms) =
            counted(|| step::solve_contact(&self.model, &mut self.state, &mut self.scratch));
        solved.map_err(|cause| self.refused(cause))?;
        self.state.stats.transforms += transforms;
        self.spare[0].clone_from(&self.state);
        self.run_in();
        self.next = self.look_ahead();
        Ok(())
    }

    /// Makes the error of a refused step; the state stays as the last good step left it.
    fn refused(&self, cause: Cause) -> Breakdown {
        Breakdown {
            cycle: self.state.cycle,
            cause,
        }
    }

    /// Returns the present contact as a separate simulation that steps every cycle without wear: a steady-state cycle
    /// on the present profile. `None` if the contact cannot be solved.
    pub fn without_wear(&self) -> Option<Self> {
        let setup = Setup {
            wear: None,
            integrator: Integrator::Direct,
            ..self.setup().clone()
        };
        Self::continued(Model::new(setup, Some(&self.model)), self.state.clone()).ok()
    }

    /// Whether the last action was a jump over cycles: nothing has been stepped or changed since.
    pub(crate) fn has_jumped(&self) -> bool {
        self.state.jump.settled.is_some()
    }

    /// Returns the model as it was in the last step: friction and wear may have run in since.
    pub(crate) fn model_of_last_step(&self) -> Model {
        let mut model = self.model.clone();
        let before = &self.spare[0];
        model
            .setup
            .run_in(before.cycle, before.ledger.dissipated_energy);
        model
    }

    /// The contact that the last step, of the `model` [then](Self::model_of_last_step), would have come to after a
    /// `share` of it on a profile that stays. `None` if it cannot be solved.
    pub(crate) fn within_last_step(&self, model: &Model, share: f64) -> Option<contact::Contact> {
        let (before, springs) = (&self.spare[0], model.springs());
        let cycle = before.cycle + share * (self.state.cycle - before.cycle);
        let mut contact = contact::Contact::new(model.nodes(), springs);
        let mut slip = vec![0.0; springs];
        let even = even_end(model, &before.contact.load);
        let profile = Profile::of_worn(model, [&before.wear, &before.image], even);
        let problem = contact::ContactProblem::new(model, &profile, &before.contact);
        let targets = model.setup.drive.targets(cycle);
        problem.solve(targets, &mut contact, &mut slip).ok()?;
        Some(contact)
    }

    /// Returns g at the nodes, m, of the present profile.
    pub(crate) fn profile_1d(&self) -> Vec<f64> {
        let state = &self.state;
        Profile::of_worn(&self.model, [&state.wear, &state.image], self.even_end()).g
    }

    /// Returns p(r), Pa, at the present moment, by one transform.
    pub fn pressure(&self) -> Vec<f64> {
        let mut pressure = vec![0.0; self.setup().grid.len()];
        traction::pressure(&self.model, &self.state.contact, &mut pressure);
        pressure
    }

    /// The amplitude of u_x against the gauge length, m, from which the present profile of a line contact slips as a whole.
    pub(crate) fn line_slip_border(&self) -> f64 {
        let reach = self.setup().material.reach();
        let mut spring = self.state.contact.load.clone();
        spring.nodal.iter_mut().for_each(|load| *load *= reach);
        spring.kinks.iter_mut().for_each(|kink| kink.jump *= reach);
        let gauge = self.setup().drive.gauge_length().unwrap_or_default();
        self.model.foundation.shift_against(gauge, &spring)
    }

    /// Returns the worn volume, m³: 2π∫(f − f₀) r dr, or 2L∫(f − f₀) dr in a line contact.
    pub fn wear_volume(&self) -> f64 {
        match self.setup().scar {
            None => scar_volume(&self.model, &self.state.wear, self.even_end()),
            // What the cells make of the scar that it began with is no wear.
            Some(_) => self.state.ledger.initial_volume + self.volume_since_start(),
        }
    }

    /// Returns 2π∫ r dr of the growth of f since the run began, m³.
    fn volume_since_start(&self) -> f64 {
        scar_volume(&self.model, &self.worn_since_start(), self.even_end())
    }

    /// The height over E* of the dome as which the load ends, if it does.
    fn even_end(&self) -> Option<f64> {
        even_end(&self.model, &self.state.contact.load)
    }

    /// Returns the growth of f since the run began, m, at the nodes.
    pub fn worn_since_start(&self) -> Vec<f64> {
        let initial = self.setup().initial_wear(&self.setup().grid);
        let worn = self.state.wear.iter().zip(initial);
        worn.map(|(depth, initial)| depth - initial).collect()
    }
}

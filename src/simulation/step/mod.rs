//! One step in time: a function from a state to the next one.
//!
//! ```text
//! profile  = Profile::find(state)                 Eq. (1)
//! contact  = Problem(profile, state.contact).solve()     the springs of both directions
//! friction = Friction::find(contact, slip)        which springs slip, and their work
//! sliding  = Sliding::find(slip)                  Eq. (2)
//! stress   = traction::{Pressure, shear}(contact)  Eq. (3)
//! wear     = Increment::wear(stress, sliding)      Eq. (15)
//! next     = accept(state, contact, wear)
//! ```
//!
//! A step reads `state` and writes into `next`, which reuses the buffers of the state before the
//! last: nothing is allocated, and a failed step changes nothing. Each phase of a step fills a value of the [`Scratch`]
//! and returns a reference to it, which the next phases take.
//!
//! [`euler`] and [`trapezoid`] choose the profile for the contact and the stress for the wear.
//! [`attempt`] tries a step, [`substep`] takes it, in parts where it is too stiff; [`cycle_jump`] takes many cycles at
//! once, by the wear of a [steady-state cycle](steady_cycle).

use super::breakdown::{Cause, advice};
use super::choices::Scheme;
use super::contact::Contact;
use super::drive::Control;
use super::friction::Friction;
use super::mean_shear::MeanShear;
use super::model::Model;
use super::moments::Period;
use super::profile::{Profile, even_end, scar_volume};
use super::setup::Setup;
use super::state::State;
use super::traction::Pressure;
use super::wear::{Increment, Sliding};
use crate::math::geometry::Geometry;
use crate::math::scan::largest;
use crate::math::vector::{vectorized, write_each};

mod attempt;
mod cycle_jump;
mod euler;
mod jump_step;
mod response;
mod steady_cycle;
mod substep;
mod trapezoid;

pub(super) use cycle_jump::{Jumped, is_possible, jump};
pub(super) use substep::step;

/// The values that the phases of a step return, kept for their memory.
#[derive(Debug, Clone)]
pub(super) struct Scratch {
    /// The profile under the contact.
    pub(super) profile: Profile,
    /// Slip of the springs, m.
    slip: Vec<f64>,
    friction: Friction,
    sliding: Sliding,
    shear: MeanShear,
    increment: Increment,
    /// Pressure of the contact at the start of a step, if the state has too little of it.
    pressure: Pressure,
    /// Buffer for a load without its dome, N/m.
    rest: Vec<f64>,
    /// The steps of steady-state cycles.
    period: Period,
}

impl Scratch {
    pub(super) fn new(model: &Model) -> Self {
        let springs = model.springs();
        // Without wear no stress is needed.
        let wearing = if model.setup.wear.is_some() {
            springs
        } else {
            0
        };
        Self {
            profile: Profile::new(model),
            slip: vec![0.0; springs],
            friction: Friction::new(springs),
            sliding: Sliding::new(wearing),
            shear: MeanShear::new(wearing),
            increment: Increment::new(model.nodes(), wearing),
            pressure: Pressure::unknown(springs),
            rest: Vec::new(),
            period: Period::default(),
        }
    }
}

impl Scratch {
    /// Finds the stiffness of every node that wears in the step; returns the largest.
    fn find_stiffness(&mut self, model: &Model) -> f64 {
        let (shear, sliding) = (&self.shear.nodal, &self.sliding);
        self.increment.find_stiffness(model, shear, sliding)
    }

    /// Computes the wear due to the slip so far and the `pressure` of a constant `contact`, and the friction
    /// work: τ = μp and ΔE_d = 2∫ μq |Δs| dx. The first `stuck` nodes do not slip.
    fn wear_by_load(
        &mut self,
        model: &Model,
        contact: &Contact,
        pressure: &Pressure,
        stuck: usize,
    ) {
        let coefficient = model.setup.material.friction();
        let shear = &mut self.shear.nodal;
        shear[..stuck].fill(0.0);
        for (tau, p) in shear[stuck..].iter_mut().zip(&pressure.nodal[stuck..]) {
            *tau = coefficient * p;
        }
        self.sliding.nodes = stuck..model.nodes();
        let pressures = [pressure; 2];
        (self.increment).wear(model, shear, &self.sliding, pressures, 1.0);
        let friction = (self.friction).find(model, [contact, contact], &mut self.slip);
        self.increment.friction_work = friction.work;
    }
}

/// How stiff the steps of a scheme may be.
struct Bounds {
    /// A stiffer step is not taken whole.
    stiff: f64,
    /// Target stiffness of its sub-steps.
    aim: f64,
}

/// A worn depth this many times the largest depth of indentation cannot result from contact.
const RUNAWAY: f64 = 10.0;

/// Solves the contact at the present cycle: pressed to u_z, shifted to u_x, nothing worn.
pub(super) fn solve_contact(
    model: &Model,
    state: &mut State,
    scratch: &mut Scratch,
) -> Result<(), Cause> {
    model.plan.image(&state.wear, &mut state.image);
    let even = even_end(model, &state.contact.load);
    (scratch.profile).find(model, [&state.wear, &state.image], even);
    let mut solved = state.contact.clone();
    attempt::solve(model, &state.contact, &mut solved, scratch, state.cycle)?;
    state.contact = solved;
    state.last.duration = 0.0;
    state.last.stiffness = 0.0;
    state.last.wear.fill(0.0);
    state.last.growth.fill(0.0);
    state.pressure.forget();
    state.stats.contacts += 1;
    Ok(())
}

/// Computes the wear of a step whose contact has been solved, into `scratch.increment`.
fn wear(model: &Model, state: &State, next: &mut State, scratch: &mut Scratch, cycle: f64) {
    match model.setup.scheme {
        Scheme::Euler => euler::wear(model, state, next, scratch, cycle),
        Scheme::Trapezoid => trapezoid::wear(model, state, next, scratch, cycle),
    }
}

/// Completes `next`, whose contact and pressure are solved, as the state after `state`: adds the wear of the step.
fn accept(
    model: &Model,
    state: &State,
    next: &mut State,
    scratch: &mut Scratch,
    cycle: f64,
) -> Result<(), Cause> {
    let increment = &mut scratch.increment;
    next.carry_sums(state);
    next.wear.copy_from_slice(&state.wear);
    if let Some(law) = model.setup.wear.filter(|_| model.springs() > 0) {
        let nodes = increment.nodes.clone();
        let (after, before) = (&mut next.wear[nodes.clone()], &state.wear[nodes.clone()]);
        let worn = &increment.depth[nodes.clone()];
        write_each(after, before, worn, |before, worn| before + worn);
        refuse(model, next.contact.depth, after, &model.grid.nodes()[nodes])?;
        // The two sides of V = k E_d: what work explains, and what other laws wore.
        if law.traits().explained_by_work {
            next.ledger.expected_volume += law.coefficient() * increment.friction_work;
        } else {
            let even = even_end(model, &state.contact.load);
            next.ledger.unexplained_volume +=
                scar_volume(model, &next.wear, even) - scar_volume(model, &state.wear, even);
        }
        // Eq. (1) is linear, so only the growth is transformed.
        model.plan.image(&increment.depth, &mut next.last.growth);
        write_each(
            &mut next.image,
            &state.image,
            &next.last.growth,
            #[inline(always)]
            |image, growth| image + growth,
        );
        std::mem::swap(&mut next.last.wear, &mut increment.depth);
    } else {
        next.image.copy_from_slice(&state.image);
    }
    if model.springs() > 0 {
        next.ledger.dissipated_energy += increment.friction_work;
        follow_stick(model, next, cycle);
    }
    next.last.duration = cycle - state.cycle;
    next.cycle = cycle;
    next.stats.contacts += 1;
    Ok(())
}

/// Returns the largest worn depth; `None` if one is not finite.
fn deepest(wear: &[f64]) -> Option<f64> {
    vectorized(
        #[inline(always)]
        || {
            let finite = wear.iter().fold(true, |all, worn| all & worn.is_finite());
            finite.then(|| largest(wear))
        },
    )
}

/// Refuses the worn depths `wear` (m) at some `radii` (m) if the deepest of them is not finite or far above anything
/// that can touch.
fn refuse(model: &Model, depth: f64, wear: &[f64], radii: &[f64]) -> Result<(), Cause> {
    let setup = &model.setup;
    let depth = match setup.geometry {
        Geometry::Round => setup.depth_scale(depth.max(least_depth(setup))),
        // A strip in gross slip wears on whatever its springs carry, until the flanks of the indenter touch; without
        // flanks, as far as it acts as a half-plane.
        Geometry::Line { .. } => match setup.indenter.rim() {
            None => model.unworn[model.nodes() - 1].max(depth),
            Some(rim) => rim,
        },
    };
    let deepest = deepest(wear);
    let worn = deepest.map_or(f64::INFINITY, |deepest| deepest / depth);
    if deepest.is_none() || worn == f64::INFINITY && depth > 0.0 {
        return Err(Cause::NotFinite {
            quantity: "worn profile",
            advice: advice(setup),
        });
    }
    if worn > RUNAWAY && depth > 0.0 {
        let at = wear.iter().position(|&worn| Some(worn) == deepest);
        return Err(Cause::Runaway {
            worn,
            radius: radii[at.unwrap_or_default()],
            advice: advice(setup),
        });
    }
    Ok(())
}

/// Returns a lower bound, m, on the depth at the largest prescribed force of the motion, for any contact on the domain:
/// when contact is lost, the present depth says nothing about what can touch.
fn least_depth(setup: &Setup) -> f64 {
    match setup.drive.normal() {
        Control::Displacement(_) => 0.0,
        Control::Force(force) => {
            force.highest() / (2.0 * setup.material.normal_modulus() * setup.grid.radius())
        }
    }
}

/// Follows the smallest stick radius through the period of the motion that `state` is in until `cycle`.
fn follow_stick(model: &Model, state: &mut State, cycle: f64) {
    let Some(stick) = state.contact.stick_radius else {
        return;
    };
    state.ledger.smallest_stick_radius = state.ledger.smallest_stick_radius.min(stick);
    // Periods are whole numbers of cycles.
    if cycle.floor() == state.cycle.floor() {
        return;
    }
    let period = f64::from(model.setup.drive.cycles_to_settle());
    if (cycle / period).floor() > (state.cycle / period).floor() {
        state.ledger.settled_stick_radius = Some(state.ledger.smallest_stick_radius);
        state.ledger.smallest_stick_radius = f64::INFINITY;
    }
}

//! Explicit Euler, the paper's own.
//!
//! # Formula
//!
//! Fig. 1 of the paper: f → g by Eq. (1) → springs → τ by Eq. (3) and the slip of the surface by
//! Eq. (2) → f by the wear law, Eq. (15).
//!
//! - **Order**: first in the step.
//! - **Limit**: stable while μkE*s < 4h/π, s the slip of a step and h the cell's width.

use super::super::breakdown::Cause;
use super::super::model::Model;
use super::super::state::State;
use super::super::{Scratch, contact, stability, traction};
use super::accept;
use super::substep::{self, Outcome, Part};
use crate::math::scan::leading;

/// The stiffness beyond which a step is taken in sub-steps, and that of these, in limits: an explicit
/// step at its limit rings, at half of it no error changes its sign.
const STIFF: f64 = 0.5;
const AIM: f64 = 0.4;

/// One step from `state` to `cycle`, into `next`.
pub(super) fn step(
    model: &Model,
    state: &State,
    next: &mut State,
    scratch: &mut Scratch,
    cycle: f64,
) -> Result<(), Cause> {
    let limit = stability::limit(model.setup.scheme);
    let guard = model.setup.stability;
    substep::step(
        guard,
        AIM * limit,
        state,
        next,
        cycle,
        |state, next, reach, part| {
            model.profile(&state.image, 0.0, &[], &mut scratch.g);
            let (contact, slip) = (&mut next.contact, &mut scratch.increment.slip);
            contact::solve(model, &scratch.g, &state.contact, reach, contact, slip)?;
            wear(model, state, next, scratch, reach);
            let seconds = model.seconds(reach - state.cycle);
            let stiffness = scratch.increment.stiffness(model, seconds);
            match part {
                Part::Guarded if stiffness > STIFF * limit => {
                    return Ok(Outcome::TooStiff(stiffness));
                }
                Part::Guarded | Part::Raw => {}
                Part::Unstable => scratch.increment.damp(model),
            }
            accept(model, state, next, scratch, reach)?;
            Ok(Outcome::Done(stiffness))
        },
    )
}

/// What a step wears whose contact has been solved, into `scratch.increment`.
pub(super) fn wear(model: &Model, state: &State, next: &State, scratch: &mut Scratch, cycle: f64) {
    let Scratch {
        increment,
        stresses,
        ..
    } = scratch;
    if model.springs() == 0 {
        return;
    }
    let contact = &next.contact;
    if model.setup.wear.is_some() {
        // Method B's stress looks one node across.
        let end = (contact.normal.nodes + 1).min(model.nodes());
        increment.slip_of_surface(model, end);
        let first = leading(&increment.surface_slip[..end], |&slip| slip == 0.0);
        increment.nodes = first..end;
        let (stuck, tau) = (state.stuck_radius(), &mut increment.shear);
        traction::shear(model, contact, stuck, first..end, stresses, tau);
        scratch.transforms += 2;
        increment.wear(model, model.seconds(cycle - state.cycle));
    }
    increment.rub_explicitly(model, contact);
}

//! Explicit Euler, as in the paper.
//!
//! # Formula
//!
//! Fig. 1 of the paper: f → g by Eq. (1) → springs → τ by Eq. (3) and the slip of the surface by
//! Eq. (2) → f by the wear law, Eq. (15).
//!
//! - **Order**: first in the step.
//! - **Limit**: stable while μkE*s < 4h/π, with s the slip of a step and h the cell width.

use super::super::model::Model;
use super::super::state::State;
use super::super::traction;
use super::{Bounds, Scratch};

/// At its limit of 2 an explicit step oscillates; up to half of that no error changes sign.
pub(super) const BOUNDS: Bounds = Bounds {
    stiff: 1.0,
    aim: 0.8,
};

/// Computes the wear of a step whose contact has been solved, into `scratch.increment`.
pub(super) fn wear(model: &Model, state: &State, next: &State, scratch: &mut Scratch, cycle: f64) {
    if model.springs() == 0 {
        return;
    }
    let (contact, slip) = (&next.contact, &mut scratch.slip);
    if let Some(law) = &model.setup.wear {
        let sliding = scratch.sliding.find_under(model, slip, contact);
        let shear = &mut scratch.shear.nodal;
        traction::shear(model, contact, 0, (&mut shear[..], &mut scratch.rest));
        if law.traits().needs_pressure {
            (scratch.pressure).find(model, contact, sliding.nodes.start, &mut scratch.rest);
        }
        let (pressures, seconds) = ([&scratch.pressure; 2], model.seconds(cycle - state.cycle));
        (scratch.increment).wear(model, shear, sliding, pressures, seconds);
    }
    let friction = scratch.friction.find_explicitly(model, contact, slip);
    scratch.increment.friction_work = friction.work;
}

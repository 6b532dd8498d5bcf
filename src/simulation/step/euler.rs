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
use crate::math::scan::leading;

/// At its limit of 2 an explicit step oscillates; up to half of that no error changes sign.
pub(super) const BOUNDS: Bounds = Bounds {
    stiff: 1.0,
    aim: 0.8,
};

/// Computes the wear of a step whose contact has been solved, into `scratch.increment`.
pub(super) fn wear(model: &Model, state: &State, next: &State, scratch: &mut Scratch, cycle: f64) {
    let increment = &mut scratch.increment;
    if model.springs() == 0 {
        return;
    }
    let contact = &next.contact;
    if model.setup.wear.is_some() {
        // Method B's stress looks one node across.
        let end = (contact.normal.nodes + 1).min(model.nodes());
        let surface_slip = &mut increment.surface_slip[..end];
        model.plan.displacement(&increment.slip, surface_slip);
        let first = leading(surface_slip, |&slip| slip == 0.0);
        increment.nodes = first..end;
        let out = (&mut increment.shear[..], &mut increment.rest);
        traction::shear(model, contact, 0, out);
        scratch.transforms += 2;
        increment.wear(model, model.seconds(cycle - state.cycle));
    }
    increment.rub_explicitly(model, contact);
}

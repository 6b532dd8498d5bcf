//! Tries a step: solves the contact at its end, and computes the wear with friction and wear that [run
//! in](super::super::running_in) during it.

use super::super::breakdown::Cause;
use super::super::choices::Scheme;
use super::super::contact::{Contact, ContactProblem};
use super::super::model::Model;
use super::super::running_in::{RunningIn, Stretch};
use super::super::state::State;
use super::{Scratch, wear};

/// Solves the contact at `cycle` on the profile in `scratch`, into `next`, and computes the wear of the step from
/// `state`; returns its stiffness. Leaves the `model` with the mean friction and wear over the step.
pub(super) fn attempt(
    model: &mut Model,
    state: &State,
    next: &mut State,
    scratch: &mut Scratch,
    cycle: f64,
) -> Result<f64, Cause> {
    if let Some(running_in) = model.setup.running_in.clone() {
        run_in(&running_in, model, state, next, scratch, cycle)?;
    } else {
        solve(model, &state.contact, &mut next.contact, scratch, cycle)?;
        wear(model, state, next, scratch, cycle);
    }
    Ok(scratch.find_stiffness(model))
}

/// Solves the contact at `cycle` on the profile in `scratch`, from the one `before`.
pub(super) fn solve(
    model: &Model,
    before: &Contact,
    next: &mut Contact,
    scratch: &mut Scratch,
    cycle: f64,
) -> Result<(), Cause> {
    let problem = ContactProblem::new(model, &scratch.profile, before);
    let targets = model.setup.drive.targets(cycle);
    problem.solve(targets, next, &mut scratch.slip)
}

/// Tries the step with the friction at its end, and with the means of friction and k over it.
fn run_in(
    running_in: &RunningIn,
    model: &mut Model,
    state: &State,
    next: &mut State,
    scratch: &mut Scratch,
    cycle: f64,
) -> Result<(), Cause> {
    let start = state.ledger.dissipated_energy;
    let mut stretch = Stretch {
        cycles: [state.cycle, cycle],
        energy: [start; 2],
    };
    if running_in.friction_follows_work(start) && model.setup.scheme == Scheme::Trapezoid {
        solve(model, &state.contact, &mut next.contact, scratch, cycle)?;
        let contacts = [&state.contact, &next.contact];
        let friction = scratch.friction.find(model, contacts, &mut scratch.slip);
        stretch.energy[1] = start + friction.work;
    }
    running_in.set_friction(stretch.end(), &mut model.setup.material);
    solve(model, &state.contact, &mut next.contact, scratch, cycle)?;
    running_in.set_friction(stretch, &mut model.setup.material);
    // Wear is linear in k, and computing it also gives the work that determines the mean of k.
    let given = model.setup.wear;
    model.setup.wear = given.map(|law| law.with_coefficient(1.0));
    wear(model, state, next, scratch, cycle);
    stretch.energy[1] = start + scratch.increment.friction_work;
    model.setup.wear = given.map(|mut law| {
        running_in.set_wear(stretch, &model.setup.material, &mut law);
        let depth = &mut scratch.increment.depth;
        depth.iter_mut().for_each(|worn| *worn *= law.coefficient());
        law
    });
    Ok(())
}

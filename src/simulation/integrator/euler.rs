//! Explicit Euler, the paper's own.
//!
//! # Formula
//!
//! Fig. 1 of the paper: f → g by Eq. (1) → springs → τ by Eq. (3) and the slip of the surface by
//! Eq. (2) → f by the wear law, Eq. (15).
//!
//! The slip of the springs is what Eq. (2) transforms, not their displacement: the two are the same
//! by linearity, since a rigid shift maps to itself, but the slip is exactly zero inside the stick
//! zone and stays so under a causal transform.
//!
//! - **Order**: first in the step.
//! - **Limit**: stable while μkE*s < 4h/π, s the slip of a step and h the cell's width.

use super::super::Setup;
use super::super::breakdown::Cause;
use super::super::solve::{shear, solve_contact};
use super::super::state::State;
use super::super::workspace::Workspace;
use super::commit;

/// One step from the state's cycle to `cycle`.
pub(super) fn step(
    setup: &Setup,
    state: &mut State,
    work: &mut Workspace,
    cycle: f64,
) -> Result<(), Cause> {
    work.predicted.copy_from_slice(&work.g);
    solve_contact(setup, state, work, cycle)?;
    let mut friction_work = 0.0;
    if setup.drive.tangential().is_some() {
        for ((work, load), slip) in work
            .friction_work
            .iter_mut()
            .zip(&work.tangential_load)
            .zip(&work.slip)
        {
            *work = load * slip;
        }
        friction_work = work.planned.row.force(&work.friction_work, &[]);
        if let Some(law) = &setup.wear {
            let mut tau = std::mem::take(&mut work.shear);
            shear(work, setup.material.tangential_modulus(), &mut tau);
            work.shear = tau;
            work.planned
                .plan
                .displacement(&work.slip, &mut work.surface_slip);
            let duration = (cycle - state.cycle) * setup.drive.period();
            work.worn.fill(0.0);
            law.wear(&work.shear, &work.surface_slip, duration, &mut work.worn);
            for ((after, before), worn) in work.wear.iter_mut().zip(&state.wear).zip(&work.worn) {
                *after = before + worn;
            }
            state.last.shear.copy_from_slice(&work.shear);
        }
    }
    commit(setup, state, work, cycle, friction_work)
}

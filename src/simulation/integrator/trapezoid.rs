//! Second order in time: the profile looked ahead, the stress of a step its mean.
//!
//! # Formula
//!
//! ```text
//! g*      = g_n + ρ (g_n − g_{n−1}),   ρ = Δt_n / Δt_{n−1}; ρ = 0 where the motion has turned
//! springs at n+1 by g*;  p_{n+1} by Eq. (3), slip Δs by Eq. (2)
//! τ̄      = ± μ (p_n + p_{n+1})/2       in the outermost slip zone
//!        = (τ_n + τ_{n+1})/2           elsewhere, where both have one sign
//!        = τ_{n+1}/2                   where it turned and now works with the slip, else 0
//! f_{n+1} = f_n + wear(τ̄, Δs)
//! ```
//!
//! Steps end at every turning point of d ± κu_x, where stick and slip change. A spring that begins to
//! slip inside the step carries τ = μp while it slips, and not the mean of what it carried before and
//! after: that is why the outer zone takes the mean of μp. It alone is worth a factor of 16 at 100
//! steps a cycle.
//!
//! # Stability
//!
//! At the [stiffness](super::stiffness) z, steps stay clean up to z = 0.7. One beyond is taken whole in
//! [stages](super::relaxed) where it is stiff and hardly changes anything, and in [parts](super::parts)
//! elsewhere.
//!
//! - **Order**: second. Fig. 3 shows 1.9 to 2.0 from 25 to 400 steps a cycle at K = 0.3, and from 50 to 400
//!   at K = 1: with longer steps wear next to the border is stiff, z near 1. Turning points cut steps at
//!   odd places, so neighbouring rungs scatter by a third. The error at 100 steps is below that of
//!   explicit Euler at 800.
//! - **Cost**: four transforms a step.

use std::hint::select_unpredictable as select;

use super::super::Setup;
use super::super::breakdown::Cause;
use super::super::solve::{solve_contact, surface_slip};
use super::super::state::State;
use super::super::stress;
use super::super::workspace::Workspace;
use super::parts::{self, Outcome, Part};
use super::worn_volume::{self, LoadEnd};
use super::{commit, relaxed, stiffness};
use crate::contact::tangential::Hold;
use crate::math::abel::bend::{self, Bend};
use crate::math::scan::{leading, trailing};
use crate::math::vector::{vectorized, write_each};

/// The most that the profile is looked ahead, in lengths of the step before.
const FARTHEST: f64 = 4.0;

/// The stiffness beyond which a step is not taken as it is, and that of its parts. Closer to the limit errors
/// ring, and make springs let go that would not have.
const HARSH: f64 = 0.7;
const AIM: f64 = 0.35;

/// One step from the state's cycle to `cycle`, in parts where wear is harsh.
pub(super) fn step(
    setup: &Setup,
    state: &mut State,
    work: &mut Workspace,
    cycle: f64,
) -> Result<(), Cause> {
    parts::step(setup.stability, AIM, state, cycle, |state, reach, part| {
        attempt(setup, state, work, reach, part)
    })
}

fn attempt(
    setup: &Setup,
    state: &mut State,
    work: &mut Workspace,
    cycle: f64,
    part: Part,
) -> Result<Outcome, Cause> {
    let duration = cycle - state.cycle;
    let smooth = state.last.duration > 0.0 && part != Part::Snap;
    let ahead = if smooth {
        (duration / state.last.duration).min(FARTHEST)
    } else {
        0.0
    };
    let (predicted, growth) = (&mut work.predicted, &state.last.growth);
    write_each(
        predicted,
        &work.g,
        growth,
        #[inline(always)]
        |g, growth| g + ahead * growth,
    );
    solve_contact(setup, state, work, cycle)?;
    let mut friction_work = worn(setup, state, work, cycle);
    let stiffness = stiffness::of_step(setup, work, duration);
    let mut outcome = Outcome::Done(stiffness);
    match part {
        Part::Guarded if stiffness > HARSH => {
            match relaxed::step(setup, state, work, cycle, stiffness) {
                Some(relaxed) => (friction_work, outcome) = (relaxed, Outcome::Relaxed),
                None => return Ok(Outcome::TooHarsh(stiffness)),
            }
        }
        Part::Guarded | Part::Raw => {}
        Part::Snap => {
            let share = stiffness::damp(work);
            friction_work *= share;
            work.beyond_nodes = work.beyond_nodes.map(|volume| share * volume);
        }
    }
    commit(setup, state, work, cycle, friction_work)?;
    if setup.wear.is_some() && setup.drive.tangential().is_some() {
        std::mem::swap(&mut state.last.pressure, &mut work.pressure);
        std::mem::swap(&mut state.last.shear, &mut work.shear);
    }
    Ok(outcome)
}

/// What the step that the contact has been solved for wears (m, into `work.worn`), and its work of
/// friction (J).
pub(super) fn worn(setup: &Setup, state: &State, work: &mut Workspace, cycle: f64) -> f64 {
    work.beyond_nodes = None;
    if setup.drive.tangential().is_none() {
        return 0.0;
    }
    let friction_work = work_of_friction(setup, state, work);
    if let Some(law) = &setup.wear {
        stresses(setup, state, work);
        let zone = mean_shear(setup, state, work);
        let seconds = (cycle - state.cycle) * setup.drive.period();
        let nodes = work.sliding.clone();
        let (tau, slip) = (
            &work.working_shear[nodes.clone()],
            &work.surface_slip[nodes.clone()],
        );
        work.worn[..nodes.start].fill(0.0);
        work.worn[nodes.end..].fill(0.0);
        let worn = &mut work.worn[nodes];
        vectorized(
            #[inline(always)]
            || law.wear(tau, slip, seconds, worn),
        );
        let ends = [LoadEnd::before(&state.last), LoadEnd::now(work)];
        work.beyond_nodes = worn_volume::beyond_nodes(setup, work, ends, zone);
    }
    friction_work
}

/// 2∫ μ (q_n + q_{n+1})/2 |Δs| dx: what each spring that slips turns into heat.
fn work_of_friction(setup: &Setup, state: &State, work: &mut Workspace) -> f64 {
    let friction = setup.material.friction();
    write_each(
        &mut work.friction_work,
        &work.normal_load,
        &state.last.normal_load,
        #[inline(always)]
        |after, before| 0.5 * friction * (after + before),
    );
    kinks_of_slip(work, &state.last.spring_breaks);
    let normal = &work.contact.normal;
    let at_edge = match normal.nodes {
        0 => 0.0,
        nodes => work.slip[nodes - 1].abs(),
    };
    let last = &state.last;
    let before = worn_volume::between_springs(setup, &last.normal_breaks, last.rim_edge.as_ref());
    let now = worn_volume::between_springs(setup, &work.normal_breaks, work.rim_edge.as_ref());
    let edge = friction * (before + now) * at_edge;
    let row = &work.planned.row;
    let (limit, slip) = (&work.friction_work, &work.slip);
    edge + row.work(limit, slip, &work.slip_kinks, normal.edge())
}

/// Where the slip of the step bends between springs: where a border of stick is now, and where one was
/// before. A cell that sticks does not slip, wherever its border was.
pub(super) fn kinks_of_slip(work: &mut Workspace, before: &[Bend]) {
    let squares = work.planned.grid.squares();
    work.slip_kinks.clear();
    for (breaks, sign) in [(&work.spring_breaks[..], -1.0), (before, 1.0)] {
        for (k, bend) in bend::by_cell(breaks, squares) {
            let slips = |j: usize| work.hold[j].sign().is_some();
            if (slips(k) || slips(k + 1)) && work.hold[k + 1] != Hold::Open {
                let jump = sign * bend.jump;
                work.slip_kinks.push((k, Bend { jump, ..bend }));
            }
        }
    }
}

/// p and τ at the end of the step, and the slip of the surface in it.
pub(super) fn stresses(setup: &Setup, state: &State, work: &mut Workspace) {
    let (mut p, mut tau, mut rest) = (
        std::mem::take(&mut work.pressure),
        std::mem::take(&mut work.shear),
        std::mem::take(&mut work.rest),
    );
    let core = state.core_radius();
    stress::stresses(work, &setup.material, core, &mut rest, &mut p, &mut tau);
    (work.pressure, work.shear, work.rest) = (p, tau, rest);
    work.transforms += 2;
    // What carried a stress before or carries one now wears, up to an edge behind the last of these nodes; method
    // B's stress looks one node across.
    let before = &state.last.pressure;
    let nodes = before.len() - trailing(before, |&p| p == 0.0);
    let nodes = (nodes.max(work.contact.normal.nodes) + 1).min(before.len());
    surface_slip(work, nodes);
    // Nothing slips within the innermost spring that does.
    let core = leading(&work.hold, |&hold| hold == Hold::Stick);
    work.surface_slip[..core].fill(0.0);
    work.sliding = core.min(nodes)..nodes;
}

/// The stress that wears: its mean over the step, by zones; returns where the outer slip zone begins.
pub(super) fn mean_shear(setup: &Setup, state: &State, work: &mut Workspace) -> usize {
    let (zone, sign) = outer_slip_zone(&work.hold);
    let friction = sign * setup.material.friction();
    let (inner, outer) = work.working_shear.split_at_mut(zone);
    let shears = state.last.shear.iter().zip(&work.shear);
    let pressures = state.last.pressure[zone..].iter();
    let pressures = pressures.zip(&work.pressure[zone..]);
    let slips = &work.surface_slip;
    vectorized(
        #[inline(always)]
        || {
            for ((mean, (was, is)), slip) in inner.iter_mut().zip(shears).zip(slips) {
                let with_slip = select(is * slip > 0.0, 0.5 * is, 0.0);
                *mean = select(was * is > 0.0, 0.5 * (was + is), with_slip);
            }
            for (mean, (was, is)) in outer.iter_mut().zip(pressures) {
                *mean = 0.5 * friction * (was + is);
            }
        },
    );
    zone
}

/// The first node from which outwards every spring in contact slips in one direction, and that
/// direction. Springs out of contact belong to it.
pub(super) fn outer_slip_zone(hold: &[Hold]) -> (usize, f64) {
    let Some(outermost) = hold.iter().rposition(|&hold| hold != Hold::Open) else {
        return (hold.len(), 0.0);
    };
    let Some(sign) = hold[outermost].sign() else {
        return (hold.len(), 0.0);
    };
    let direction = hold[outermost];
    let inner = hold[..outermost]
        .iter()
        .rposition(|&hold| hold != direction && hold != Hold::Open);
    (inner.map_or(0, |j| j + 1), sign)
}

#[cfg(test)]
mod tests {
    use super::*;
    use Hold::{Backward, Forward, Open, Stick};

    #[test]
    fn the_outer_zone_ends_where_something_else_begins() {
        assert_eq!(
            outer_slip_zone(&[Stick, Stick, Forward, Forward, Open]),
            (2, 1.0)
        );
        assert_eq!(
            outer_slip_zone(&[Forward, Stick, Backward, Open, Open]),
            (2, -1.0)
        );
        assert_eq!(outer_slip_zone(&[Forward, Forward]), (0, 1.0));
        assert_eq!(outer_slip_zone(&[Stick, Stick, Open]), (3, 0.0));
        assert_eq!(outer_slip_zone(&[Open, Open]), (2, 0.0));
    }
}

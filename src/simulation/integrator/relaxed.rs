//! Stiff steps that are taken whole, in stages.
//!
//! # Formula
//!
//! What has worn until it bears next to nothing still slips all the way: there the stiffness z of a step is in
//! the hundreds while the profile hardly changes, and explicit parts would come in hundreds. With the slip Δs
//! of the step as it was solved, wear follows
//!
//! ```text
//! dδ/dθ = wear(τ(θ, δ), Δs),   θ from 0 to 1,   τ = ±μ p(θ, δ)
//! ```
//!
//! p by Eq. (3) of the indenter pressed as the motion has it at θ, on the profile worn so far; inside the outermost
//! slip zone τ stays the mean of the step. One [Runge–Kutta–Chebyshev step](crate::math::chebyshev) of √(1.5 z)
//! stages integrates it, and the work of friction and the volume between nodes with it. The slip is then solved
//! anew on the profile that came out, and the stages are gone through again, until what the slip still missed
//! would wear less than a hundred-thousandth of the depth: G max|Δg|, G the [gain](super::super::stability::gain) of a
//! spring that slips.
//!
//! - **Order**: second.
//! - **Cost**: two transforms a stage, four a pass, one to three passes.
//! - **Known failure**: where springs let go, G near 1, the slip of the step is no given, and where the edge of the
//!   contact passes many cells, wear that begins or ends within the step is no polynomial in θ: stages overshoot
//!   there by up to a tenth of it. Such steps are refused.

use super::super::Setup;
use super::super::breakdown::Cause;
use super::super::profile::{set_profile, update_profile};
use super::super::solve::{press_at, solve_contact};
use super::super::stability;
use super::super::state::State;
use super::super::stress::pressure;
use super::super::workspace::Workspace;
use super::steady_load;
use super::trapezoid::{kinks_of_slip, mean_shear, outer_slip_zone, stresses};
use crate::math::chebyshev;

/// Less stiff steps are cheaper in parts.
const STIFF: f64 = 4.0;

/// The most stages: z up to about 1000.
const MOST_STAGES: usize = 40;

/// The largest gain at which slip is looked at as given.
const MOST_GAIN: f64 = 0.2;

/// The most that stages may overshoot by at a node, in depths.
const MOST_OVERSHOOT: f64 = 1e-4;

/// What the slip may err by, in terms of what it wears, in depths.
const TOLERANCE: f64 = 1e-5;

/// The most times that the stages are gone through.
const MOST_PASSES: usize = 3;

/// Takes the step to `cycle` whole, whose contact has been solved and whose largest stiffness is `stiffness`.
/// Its wear is then in `work` as that of an explicit one, and its work of friction (J) is returned; none where
/// it is better taken in parts.
pub(super) fn step(
    setup: &Setup,
    state: &State,
    work: &mut Workspace,
    cycle: f64,
    stiffness: f64,
) -> Option<f64> {
    let stages = chebyshev::stages_for(stiffness);
    let gain = stability::gain(setup)?;
    let pressure = sliding(work, &state.last.pressure).max(sliding(work, &work.pressure));
    if stiffness < STIFF || stages > MOST_STAGES || gain * pressure > MOST_GAIN {
        return None;
    }
    // What fails on the way may go well in parts, and says what is wrong if it does not.
    let relaxed = pass_by_pass(setup, state, work, cycle, stages, gain);
    set_profile(work, &state.image, &state.wear);
    relaxed.ok().flatten()
}

fn pass_by_pass(
    setup: &Setup,
    state: &State,
    work: &mut Workspace,
    cycle: f64,
    stages: usize,
    gain: f64,
) -> Result<Option<f64>, Cause> {
    for _ in 0..MOST_PASSES {
        let supposed = work.predicted.clone();
        let end = pass(setup, state, work, cycle - state.cycle, stages)?;
        let depth = setup.depth_scale(work.contact.depth);
        if end.overshoot > MOST_OVERSHOOT * depth {
            return Ok(None);
        }
        update_profile(work, &end.wear);
        work.predicted.copy_from_slice(&work.g);
        solve_contact(setup, state, work, cycle)?;
        kinks_of_slip(work, &state.last.spring_breaks);
        stresses(setup, state, work);
        let profiles = supposed.iter().zip(&work.predicted);
        let missed = profiles
            .zip(&work.hold)
            .filter(|(_, hold)| hold.sign().is_some())
            .map(|((supposed, found), _)| (supposed - found).abs())
            .fold(0.0, f64::max);
        if gain * sliding(work, &work.pressure) * missed <= TOLERANCE * depth {
            let wear = end.wear.iter().zip(&state.wear);
            work.sliding = 0..work.worn.len();
            for (worn, (after, before)) in work.worn.iter_mut().zip(wear) {
                *worn = after - before;
            }
            work.beyond_nodes = end.beyond_nodes;
            return Ok(Some(end.friction_work));
        }
        mean_shear(setup, state, work);
    }
    Ok(None)
}

/// Where a pass ends.
struct End {
    /// m, nodal.
    wear: Vec<f64>,
    /// J.
    friction_work: f64,
    /// m³; none where that is not known.
    beyond_nodes: Option<f64>,
    /// The most that the stages grew back anywhere and should not have, m.
    overshoot: f64,
}

/// Wears the slip of the step in `stages`. The last entries of y are the work of friction, the volume between
/// nodes, and θ.
fn pass(
    setup: &Setup,
    state: &State,
    work: &mut Workspace,
    duration: f64,
    stages: usize,
) -> Result<End, Cause> {
    let nodes = state.wear.len();
    let seconds = duration * setup.drive.period();
    let (zone, sign) = outer_slip_zone(&work.hold);
    let kinks = work.slip_kinks.clone();
    let core = state.core_radius();
    let mut tells = true;
    let mut slope = |y: &[f64], out: &mut Vec<f64>| {
        update_profile(work, &y[..nodes]);
        work.predicted.copy_from_slice(&work.g);
        press_at(setup, work, state.cycle + y[nodes + 2] * duration)?;
        let (mut p, mut rest) = (
            std::mem::take(&mut work.pressure),
            std::mem::take(&mut work.rest),
        );
        pressure(work, &setup.material, core, &mut rest, &mut p);
        (work.pressure, work.rest) = (p, rest);
        work.transforms += 1;
        let heat = steady_load::wear(setup, work, zone, sign, seconds, &kinks);
        tells &= work.beyond_nodes.is_some();
        out.clear();
        out.extend_from_slice(&work.worn);
        out.extend([heat, work.beyond_nodes.unwrap_or_default(), 1.0]);
        Ok(())
    };
    let mut start = state.wear.clone();
    start.extend([0.0; 3]);
    let (mut first, mut end) = (Vec::new(), Vec::new());
    slope(&start, &mut first)?;
    chebyshev::step(stages, 1.0, &start, &first, &mut end, slope)?;
    let (friction_work, beyond_nodes) = (end[nodes], end[nodes + 1]);
    end.truncate(nodes);
    // Stages overshoot by their error where all has worn off: nothing grows back.
    let mut overshoot = 0.0_f64;
    for (after, before) in end.iter_mut().zip(&state.wear) {
        overshoot = overshoot.max(before - *after);
        *after = after.max(*before);
    }
    Ok(End {
        wear: end,
        friction_work,
        beyond_nodes: tells.then_some(beyond_nodes),
        overshoot,
    })
}

/// The largest of the pressures `p` (Pa) under which a node wears.
fn sliding(work: &Workspace, p: &[f64]) -> f64 {
    let nodes = p.iter().zip(&work.hold).zip(&work.worn);
    nodes
        .filter(|((_, hold), worn)| hold.sign().is_some() && **worn > 0.0)
        .map(|((p, _), _)| *p)
        .fold(0.0, f64::max)
}

//! Takes stiff steps whole, in stages.
//!
//! # Formula
//!
//! Where wear has removed almost all pressure, the surface still slips the whole way: the stiffness
//! z of a step is in the hundreds while the profile hardly changes, and hundreds of explicit
//! sub-steps would be needed. With the slip Δs of the solved step, wear follows
//!
//! ```text
//! dδ/dθ = wear(τ(θ, δ), Δs),   θ from 0 to 1,   τ = ±μ p(θ, δ)
//! ```
//!
//! p by Eq. (3) of the indenter pressed as the motion has it at θ, on the profile worn so far; inside the outermost
//! slip zone τ stays the mean of the step. One [Runge–Kutta–Chebyshev step](crate::math::chebyshev) of √(1.5 z)
//! stages integrates it, and the work of friction with it. The slip is then solved
//! anew on the profile that came out, and the stages are gone through again, until what the slip still missed
//! would wear less than a hundred-thousandth of the depth: G max|Δg|, G the [gain](super::super::stability::gain) of a
//! spring that slips.
//!
//! - **Order**: second.
//! - **Cost**: two transforms a stage, four a pass, one to three passes.
//! - **Known failure**: near slip instabilities (G near 1) the slip of the step is not known in
//!   advance, and where the contact edge passes many cells, wear that begins or ends within the
//!   step is not a polynomial in θ: stages overshoot there by up to a tenth. Such steps are
//!   refused.

use super::super::breakdown::Cause;
use super::super::model::Model;
use super::super::state::State;
use super::super::wear::outer_slip_zone;
use super::super::{Scratch, contact, stability, traction};
use super::trapezoid::{mean_shear, tractions};
use crate::math::chebyshev;

/// Less stiff steps are cheaper in sub-steps.
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
/// On success, `scratch.increment` holds the step's wear and work; false where it is better taken in sub-steps.
pub(super) fn step(
    model: &Model,
    state: &State,
    next: &mut State,
    scratch: &mut Scratch,
    cycle: f64,
    stiffness: f64,
) -> bool {
    let stages = chebyshev::stages_for(stiffness);
    let Some(gain) = stability::gain(&model.setup) else {
        return false;
    };
    let pressures = [&state.traction.pressure, &next.traction.pressure];
    let pressure = pressures.map(|p| sliding(next, scratch, p));
    if stiffness < STIFF || stages > MOST_STAGES || gain * pressure[0].max(pressure[1]) > MOST_GAIN
    {
        return false;
    }
    // What fails on the way may go well in sub-steps, and says what is wrong if it does not.
    pass_by_pass(model, state, next, scratch, cycle, stages, gain).unwrap_or(false)
}

fn pass_by_pass(
    model: &Model,
    state: &State,
    next: &mut State,
    scratch: &mut Scratch,
    cycle: f64,
    stages: usize,
    gain: f64,
) -> Result<bool, Cause> {
    for _ in 0..MOST_PASSES {
        scratch.stages.supposed.clone_from(&scratch.g);
        let end = pass(model, state, next, scratch, cycle - state.cycle, stages)?;
        let depth = model.setup.depth_scale(next.contact.depth);
        if end.overshoot > MOST_OVERSHOOT * depth {
            return Ok(false);
        }
        let Stages { y, image, .. } = &mut scratch.stages;
        model.image(&y[..model.nodes()], image);
        scratch.transforms += 1;
        model.profile(image, 0.0, &[], &mut scratch.g);
        let slip = &mut scratch.increment.slip;
        contact::solve(
            model,
            &scratch.g,
            &state.contact,
            cycle,
            &mut next.contact,
            slip,
        )?;
        tractions(model, state, next, scratch);
        let profiles = scratch.stages.supposed.iter().zip(&scratch.g);
        let missed = profiles
            .zip(&next.contact.spring_state)
            .filter(|(_, state)| state.sign().is_some())
            .map(|((supposed, found), _)| (supposed - found).abs())
            .fold(0.0, f64::max);
        if gain * sliding(next, scratch, &next.traction.pressure) * missed <= TOLERANCE * depth {
            let wear = scratch.stages.y.iter().zip(&state.wear);
            let increment = &mut scratch.increment;
            increment.nodes = 0..model.nodes();
            increment.friction_work = end.friction_work;
            for (worn, (after, before)) in increment.depth.iter_mut().zip(wear) {
                *worn = after - before;
            }
            return Ok(true);
        }
        mean_shear(model, state, next, scratch);
    }
    Ok(false)
}

/// What stages write into and nobody reads afterwards.
#[derive(Debug, Clone, Default)]
pub(in super::super) struct Stages {
    /// The 1D profile that the slip of a pass was solved on, m.
    supposed: Vec<f64>,
    /// The 1D image of the wear of a stage and its profile, m.
    image: Vec<f64>,
    g: Vec<f64>,
    /// Where a pass begins, the slope there, and where it ends: wear, m, nodal, the work of friction, J, and θ.
    start: Vec<f64>,
    first: Vec<f64>,
    y: Vec<f64>,
    chebyshev: chebyshev::Buffers,
}

/// How a pass ends; its wear is in [`Stages`].
struct End {
    /// J.
    friction_work: f64,
    /// The most that the stages grew back anywhere and should not have, m.
    overshoot: f64,
}

/// Wears the slip of the step in `stages`.
fn pass(
    model: &Model,
    state: &State,
    next: &mut State,
    scratch: &mut Scratch,
    duration: f64,
    stages: usize,
) -> Result<End, Cause> {
    let Scratch {
        increment,
        transforms,
        stages: buffers,
        ..
    } = scratch;
    let Stages {
        image,
        g,
        start,
        first,
        y: end,
        chebyshev,
        ..
    } = buffers;
    let nodes = model.nodes();
    let seconds = model.seconds(duration);
    let zone = outer_slip_zone(&next.contact.spring_state);
    image.resize(nodes, 0.0);
    g.resize(nodes, 0.0);
    let mut slope = |y: &[f64], out: &mut [f64]| {
        model.image(&y[..nodes], image);
        model.profile(image, 0.0, &[], g);
        let (contact, p) = (&mut next.contact, &mut next.traction.pressure);
        contact::press_at(model, g, state.cycle + y[nodes + 1] * duration, contact)?;
        traction::pressure(model, contact, p);
        *transforms += 2;
        increment.wear_by_load(model, contact, p, zone, seconds);
        out[..nodes].copy_from_slice(&increment.depth);
        out[nodes..].copy_from_slice(&[increment.friction_work, 1.0]);
        Ok(())
    };
    start.clone_from(&state.wear);
    start.extend([0.0; 2]);
    first.resize(start.len(), 0.0);
    slope(start, first)?;
    chebyshev::step(stages, 1.0, start, first, end, chebyshev, slope)?;
    // Stages overshoot by their error where all has worn off: nothing grows back.
    let mut overshoot = 0.0_f64;
    for (after, before) in end.iter_mut().zip(&state.wear) {
        overshoot = overshoot.max(before - *after);
        *after = after.max(*before);
    }
    Ok(End {
        friction_work: end[nodes],
        overshoot,
    })
}

/// The largest of the pressures `p` (Pa) under which a node wears.
fn sliding(next: &State, scratch: &Scratch, p: &[f64]) -> f64 {
    let nodes = p
        .iter()
        .zip(&next.contact.spring_state)
        .zip(&scratch.increment.depth);
    nodes
        .filter(|((_, state), worn)| state.sign().is_some() && **worn > 0.0)
        .map(|((p, _), _)| *p)
        .fold(0.0, f64::max)
}

//! The wear of a steady-state cycle on a frozen profile: the slope dδ/dn that jumps over cycles integrate.
//!
//! During one period the springs shake down, which needs no transform, since nothing wears. The
//! next one is stepped like any other, but with a frozen profile.
//!
//! # Formula
//!
//! If the depth is constant, the tangential motion is ±U, and wear is proportional to slip, no steps are needed. Each
//! spring that slips does so by S(x) = 2(U − μq_z/G*)₊ in each half
//! of a cycle, from the edge of the contact inwards, so that τ = μp where anything slips:
//!
//! ```text
//! W(r) = 2 k μ p(r) s(r),   s the transform (2) of S             E_d per cycle = 2 · 2∫ μ q_z S dx
//! ```
//!
//! On an unworn profile that is the 4μkps of Cattaneo and Mindlin.

use super::super::breakdown::Cause;
use super::super::choices::Scheme;
use super::super::contact::{self, Contact};
use super::super::drive::{Control, SpringMotion, Targets};
use super::super::model::Model;
use super::super::moments::Touch;
use super::super::profile::even_end;
use super::super::setup::Setup;
use super::super::state::{State, SteadyCycle};
use super::{Scratch, wear};
use crate::contact::tangential::SpringState;
use crate::math::abel::field::Field;
use crate::math::abel::kink;
use crate::math::scan::leading;
use crate::math::vector::add_to;

/// A motion has just turned if it has moved by less than this fraction of its amplitude since.
const AT_TURN: f64 = 1e-9;

/// A spring nearly touches whose gap is less than this, in depths of the motion.
const NEARLY: f64 = 0.03;

/// What a cycle does once the springs have shaken down on the depth `worn` (m) with its 1D image (m), on average
/// over the period of the motion. `memory` lends the springs and keeps them; its profile, its sums and its cycle are left as
/// they are. `spare` is overwritten.
pub(super) fn cycle(
    model: &Model,
    memory: &mut State,
    spare: &mut State,
    scratch: &mut Scratch,
    worn: [&[f64]; 2],
) -> Result<SteadyCycle, Cause> {
    let even = even_end(model, &memory.contact.load);
    scratch.profile.find(model, worn, even);
    let now = memory.cycle;
    let outcome = match plain_swing(&model.setup) {
        Some(swing) => plain_cycle(model, memory, spare, scratch, swing),
        None => period(model, memory, spare, scratch),
    };
    memory.cycle = now;
    memory.last.duration = 0.0;
    outcome
}

/// Returns the cost of evaluating a steady-state period, in periods stepped directly.
pub(super) fn cost(setup: &Setup) -> f64 {
    if plain_swing(setup).is_some() {
        2.0 / setup.steps_in_a_cycle()
    } else {
        4.0 / 3.0
    }
}

/// Whether cycles wear at a constant rate for ever: all of the contact slips under a held force, without a normal motion.
/// Implicit jumps would wear less at its edge than friction works.
pub(super) fn is_even(setup: &Setup, steady: &SteadyCycle) -> bool {
    let is_held = matches!(setup.drive.normal(), Control::Force(_));
    is_held && steady.stick_radius == 0.0 && plain_swing(setup).is_some()
}

/// Solves the contact of the targets on the profile in `scratch`, into `spare`.
fn solve(
    model: &Model,
    memory: &State,
    spare: &mut State,
    scratch: &mut Scratch,
    targets: Targets,
) -> Result<(), Cause> {
    let problem = contact::ContactProblem::new(model, &scratch.profile, &memory.contact);
    problem.solve(targets, &mut spare.contact, &mut scratch.slip)
}

/// Moves the contact from `spare` to `memory`, at `cycle`.
fn accept_contact(memory: &mut State, spare: &mut State, cycle: f64) {
    std::mem::swap(&mut memory.contact, &mut spare.contact);
    memory.cycle = cycle;
    memory.stats.contacts += 1;
}

fn period(
    model: &Model,
    memory: &mut State,
    spare: &mut State,
    scratch: &mut Scratch,
) -> Result<SteadyCycle, Cause> {
    let cycles = f64::from(model.setup.drive.cycles_to_settle());
    let touch = Touch::new(&model.setup, memory, scratch.profile.g.iter().copied());
    let moments = scratch.period.moments(&model.setup, touch, cycles);
    memory.cycle = 0.0;
    for &(moment, targets) in moments.iter() {
        solve(model, memory, spare, scratch, targets)?;
        accept_contact(memory, spare, moment);
    }
    memory.pressure.forget();
    memory.cycle = 0.0;
    let mut steady = SteadyCycle {
        wear: vec![0.0; model.nodes()],
        stiffness: vec![0.0; model.nodes()],
        stick_radius: f64::INFINITY,
        ..SteadyCycle::default()
    };
    let modulus = model.setup.material.normal_modulus();
    let mut deepest = f64::NEG_INFINITY;
    for &(moment, targets) in moments.iter() {
        solve(model, memory, spare, scratch, targets)?;
        wear(model, memory, spare, scratch, moment);
        scratch.find_stiffness(model);
        let increment = &scratch.increment;
        steady.friction_work += increment.friction_work;
        let nodes = increment.nodes.clone();
        let summands = &increment.stiffness[nodes.clone()];
        add_to(&mut steady.stiffness[nodes.clone()], summands);
        add_to(&mut steady.wear[nodes.clone()], &increment.depth[nodes]);
        if let Some(stick) = spare.contact.stick_radius {
            steady.stick_radius = steady.stick_radius.min(stick);
        }
        deepest = deepest.max(spare.contact.depth);
        let compression = spare.contact.normal.strongest / modulus;
        steady.elastic_depth = steady.elastic_depth.max(compression);
        accept_contact(memory, spare, moment);
        std::mem::swap(&mut memory.pressure, &mut spare.pressure);
    }
    memory.stats.evaluated_cycles += cycles as u64;
    for sum in steady.wear.iter_mut().chain(&mut steady.stiffness) {
        *sum /= cycles;
    }
    steady.friction_work /= cycles;
    steady.touching = nearly_touching(model, &scratch.profile.g, deepest);
    Ok(steady)
}

/// Returns the tangential motion, if a cycle needs no steps.
fn plain_swing(setup: &Setup) -> Option<SpringMotion<'_>> {
    let swing = setup.drive.shift_of_springs()?;
    let is_plain = setup.drive.normal().oscillation().amplitude() == 0.0
        && setup.wear.is_some_and(|law| law.traits().linear_in_slip)
        && setup.scheme == Scheme::Trapezoid
        && !setup.drive.has_rig()
        && swing.waveform().has_two_strokes();
    is_plain.then_some(swing)
}

/// Computes a steady-state cycle of ±U at a held depth.
fn plain_cycle(
    model: &Model,
    memory: &mut State,
    spare: &mut State,
    scratch: &mut Scratch,
    swing: SpringMotion<'_>,
) -> Result<SteadyCycle, Cause> {
    memory.stats.evaluated_cycles += 1;
    let start = model.setup.drive.targets(0.0);
    // First the normal contact, whatever the springs do; then the springs from the last turn to where the cycle ends.
    solve(model, memory, spare, scratch, start)?;
    std::mem::swap(&mut memory.contact, &mut spare.contact);
    turn_back(model, &mut memory.contact, swing);
    solve(model, memory, spare, scratch, start)?;
    accept_contact(memory, spare, 0.0);

    let material = &model.setup.material;
    let reach = material.reach();
    let (contact, squares) = (&memory.contact, model.grid.squares());
    let excess = |j: usize| swing.amplitude() - reach * contact.load.nodal[j];
    let mut slip = Field::zeros(model.nodes());
    for (j, slip) in slip.nodal.iter_mut().enumerate() {
        *slip = 2.0 * excess(j).max(0.0);
    }
    let stuck = leading(&slip.nodal, |&slip| slip == 0.0);
    let mut stick_radius = contact.normal.radius;
    if stuck == 0 {
        stick_radius = 0.0;
    } else if stuck < contact.normal.nodes {
        let k = stuck - 1;
        let share = excess(k) / (excess(k) - excess(stuck));
        let border = squares[k] + share * (squares[stuck] - squares[k]);
        let ends = [squares[k], squares[stuck]];
        let slips = [slip.nodal[k], slip.nodal[stuck]];
        kink::polyline(ends, slips, &[(border, 0.0)], &mut slip.kinks);
        stick_radius = border.sqrt();
    }
    let surface_slip = &mut scratch.sliding.slip;
    slip.displacement(&model.plan, &model.grid, surface_slip);
    surface_slip[..stuck].fill(0.0);
    let pressure = (memory.pressure).find(model, contact, stuck, &mut scratch.rest);
    scratch.slip.copy_from_slice(&slip.nodal);
    scratch.wear_by_load(model, contact, pressure, stuck);
    scratch.find_stiffness(model);
    let increment = &scratch.increment;
    let mut stiffness = vec![0.0; model.nodes()];
    let nodes = increment.nodes.clone();
    for (z, once) in stiffness[nodes.clone()]
        .iter_mut()
        .zip(&increment.stiffness[nodes])
    {
        *z = 2.0 * once;
    }
    Ok(SteadyCycle {
        wear: increment.depth.iter().map(|worn| 2.0 * worn).collect(),
        friction_work: 2.0 * increment.friction_work,
        elastic_depth: memory.contact.normal.strongest / material.normal_modulus(),
        stiffness,
        touching: nearly_touching(model, &scratch.profile.g, memory.contact.depth),
        stick_radius,
    })
}

/// How many springs on the profile `g` (m) touch, or nearly do, at the largest `depth` (m).
fn nearly_touching(model: &Model, g: &[f64], depth: f64) -> usize {
    let reach = depth + NEARLY * model.setup.depth_scale(depth);
    g.iter().rposition(|&g| g < reach).map_or(0, |j| j + 1)
}

/// Brings indenter and springs back to where a steady-state cycle turned last before its end: the springs that slip in
/// it stood at their limits there, the others move with the indenter. Solved from there, the end of the cycle knows
/// what slips in it; solved from itself, nothing would move and all would stick.
fn turn_back(model: &Model, contact: &mut Contact, swing: SpringMotion<'_>) {
    let setup = &model.setup;
    let is_line = setup.geometry.is_line();
    // The indenter of a line contact stands where its springs and the rigid slip have it.
    let rigid = is_line.then(|| contact.shift - contact.elastic_shift(model));
    let (reach, amplitude) = (setup.material.reach(), swing.amplitude());
    let rises = if swing.rises_at_start() { 1.0 } else { -1.0 };
    let since = amplitude + rises * (swing.after_turns(0.0) - swing.mean());
    // A cycle that ends at a turn ends a complete stroke.
    let (sign, since) = if since <= AT_TURN * amplitude {
        (-rises, 2.0 * amplitude)
    } else {
        (rises, since)
    };
    contact.shift -= sign * since;
    let springs = contact.spring.nodal.iter_mut().zip(&contact.load.nodal);
    for ((u, load), state) in springs.zip(&mut contact.spring_state) {
        let limit = reach * load;
        *u = if limit < amplitude {
            -sign * limit
        } else {
            *u - sign * since
        };
        *state = if *load > 0.0 {
            SpringState::Stick
        } else {
            SpringState::Open
        };
    }
    if let Some(rigid) = rigid {
        contact.shift = rigid + contact.elastic_shift(model);
    }
}

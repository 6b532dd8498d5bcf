//! Computes the stresses p(r) and τ(r) from the line loads of a solved contact, Eq. (3).

use std::hint::select_unpredictable as select;
use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::contact::Contact;
use super::model::Model;
use super::state::State;
use crate::contact::tangential::SpringState;
use crate::math::abel::cone::Rest;
use crate::math::scan::changes;
use crate::math::vector::{add_to, vectorized};

/// Springs beyond the permanent stick zone whose load still drops like a root.
const STEEP: usize = 4;

/// Nodes behind a border of stick whose second difference reaches across it.
const BEHIND_BORDER: usize = 2;

/// Nodes within the permanent stick radius that stresses are computed for all the same: slip may reach a little
/// further in than in the period before.
const SPARE: usize = 2;

/// p and τ of one contact, Pa, nodal; empty where nothing needs them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Traction {
    /// The first node that they are computed for; further in they are zero.
    #[serde(default)]
    pub first: usize,
    /// p.
    pub pressure: Vec<f64>,
    /// τ.
    pub shear: Vec<f64>,
}

impl Traction {
    pub(super) fn zeros(nodes: usize) -> Self {
        Self {
            first: 0,
            pressure: vec![0.0; nodes],
            shear: vec![0.0; nodes],
        }
    }
}

/// What stresses are computed with and nobody reads afterwards.
#[derive(Debug, Clone, Default)]
pub(super) struct Buffers {
    /// A load without its cusp.
    rest: Rest,
    /// What curvature adds to p, Pa, nodal.
    terms: Vec<f64>,
}

/// The first node whose stresses the steps from `state` on need: further in nothing has slipped for a period.
pub(super) fn first_needed(model: &Model, state: &State) -> usize {
    if state.settled_stick_radius.is_none() {
        return 0;
    }
    let radius = state.stuck_radius();
    let stuck = model.grid.nodes().partition_point(|&x| x <= radius);
    stuck.saturating_sub(SPARE)
}

/// p and τ of the solved contact, from the node `first` on. Nothing slips within the radius `stuck` (m).
pub(super) fn of(
    model: &Model,
    contact: &Contact,
    stuck: f64,
    first: usize,
    buffers: &mut Buffers,
    traction: &mut Traction,
) {
    let Buffers { rest, terms } = buffers;
    traction.first = first;
    let Traction {
        pressure: p,
        shear: tau,
        ..
    } = traction;
    let nodes = first..tau.len();
    pressure_of_chords(model, contact, nodes.clone(), rest, p);
    shear_of_chords(model, contact, nodes.clone(), rest, tau);
    let curved = curve(model, contact, stuck, nodes, terms);
    add_to(&mut p[curved.clone()], &terms[curved.clone()]);
    add_to_shear(model, contact, curved, terms, tau);
}

/// p alone.
pub(super) fn pressure(
    model: &Model,
    contact: &Contact,
    stuck: f64,
    buffers: &mut Buffers,
    out: &mut [f64],
) {
    let Buffers { rest, terms } = buffers;
    let nodes = 0..out.len();
    pressure_of_chords(model, contact, nodes.clone(), rest, out);
    let curved = curve(model, contact, stuck, nodes, terms);
    add_to(&mut out[curved.clone()], &terms[curved]);
}

/// τ alone, of some `nodes`; those further in are zero, the others finite.
pub(super) fn shear(
    model: &Model,
    contact: &Contact,
    stuck: f64,
    nodes: Range<usize>,
    buffers: &mut Buffers,
    out: &mut [f64],
) {
    let Buffers { rest, terms } = buffers;
    shear_of_chords(model, contact, nodes.clone(), rest, out);
    let curved = curve(model, contact, stuck, nodes, terms);
    add_to_shear(model, contact, curved, terms, out);
}

/// p of a line load that is linear in x² between the nodes and its kinks, of those `nodes` alone.
fn pressure_of_chords(
    model: &Model,
    contact: &Contact,
    nodes: Range<usize>,
    rest: &mut Rest,
    out: &mut [f64],
) {
    let load = &contact.load;
    let end = contact.end(model, &load.nodal);
    load.stress(&model.plan, &model.grid, end, nodes, rest, out);
}

/// τ of such a load, of those `nodes` alone.
fn shear_of_chords(
    model: &Model,
    contact: &Contact,
    nodes: Range<usize>,
    rest: &mut Rest,
    out: &mut [f64],
) {
    let spring = &contact.spring;
    let end = contact.end(model, &spring.nodal);
    spring.stress(&model.plan, &model.grid, end, nodes.clone(), rest, out);
    let modulus = model.setup.material.tangential_modulus();
    let stresses = &mut out[nodes];
    vectorized(
        #[inline(always)]
        || {
            for stress in stresses {
                *stress *= modulus;
            }
        },
    );
}

/// Writes into `terms` what the curvature of the line load between the nodes adds to p on those `nodes`, and returns
/// the ones that it adds to: nothing next to the permanent stick zone or behind a border of stick, where wear may
/// just have made the load steep.
fn curve(
    model: &Model,
    contact: &Contact,
    stuck: f64,
    nodes: Range<usize>,
    terms: &mut Vec<f64>,
) -> Range<usize> {
    let Some(curvature) = &model.curvature else {
        return 0..0;
    };
    let (load, grid) = (&contact.load, &model.grid);
    let end = contact.end(model, &load.nodal);
    let nodes = nodes.start..nodes.end.min(end.nodes).max(nodes.start);
    terms.resize(grid.len(), 0.0);
    curvature.terms(&load.nodal, end.cusp, &load.kinks, nodes.clone(), terms);
    let mut drop = |steep: Range<usize>| {
        let [start, end] = [steep.start, steep.end].map(|j| j.min(grid.len()));
        terms[start..end].fill(0.0);
    };
    let stuck = grid.nodes().partition_point(|&x| x <= stuck);
    drop(stuck.saturating_sub(1)..stuck + STEEP);
    let from = nodes.start.saturating_sub(BEHIND_BORDER);
    let states = contact.spring_state.get(from..nodes.end);
    for border in changes(states.unwrap_or_default(), |&state| {
        state == SpringState::Stick
    }) {
        drop(from + border..from + border + BEHIND_BORDER);
    }
    nodes
}

/// Adds to `tau` its share of what the curvature of the load adds to p on those `nodes`, the `terms`: what slips is
/// curved like μq, what sticks keeps the kinks of its history.
fn add_to_shear(
    model: &Model,
    contact: &Contact,
    nodes: Range<usize>,
    terms: &[f64],
    tau: &mut [f64],
) {
    let friction = model.setup.material.friction();
    let (tau, terms) = (&mut tau[nodes.clone()], &terms[nodes.clone()]);
    let states = &contact.spring_state[nodes];
    vectorized(
        #[inline(always)]
        move || {
            for ((tau, state), term) in tau.iter_mut().zip(states).zip(terms) {
                let backward = select(*state == SpringState::Backward, -friction, 0.0);
                *tau += select(*state == SpringState::Forward, friction, backward) * term;
            }
        },
    );
}

//! Computes the stresses p(r) and τ(r) from the line loads of a solved contact, Eq. (3).

use std::hint::select_unpredictable as select;
use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::contact::Contact;
use super::model::Model;
use super::state::State;
use crate::contact::tangential::SpringState;
use crate::math::abel::cone::Rest;
use crate::math::vector::{add_to, vectorized};

/// Springs beyond the permanent stick zone whose load still drops like a root.
const STEEP: usize = 4;

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
    rest: &mut Rest,
    traction: &mut Traction,
) {
    traction.first = first;
    let Traction {
        pressure: p,
        shear: tau,
        ..
    } = traction;
    let nodes = first..tau.len();
    pressure_of_chords(model, contact, nodes.clone(), rest, p);
    shear_of_chords(model, contact, nodes.clone(), rest, tau);
    curve(model, contact, stuck, nodes, |first, terms| {
        let nodes = first..first + terms.len();
        add_to(&mut p[nodes.clone()], terms);
        add_to_shear(
            &mut tau[nodes.clone()],
            &contact.spring_state[nodes],
            model.setup.material.friction(),
            terms,
        );
    });
}

/// p alone.
pub(super) fn pressure(
    model: &Model,
    contact: &Contact,
    stuck: f64,
    rest: &mut Rest,
    out: &mut [f64],
) {
    let nodes = 0..out.len();
    pressure_of_chords(model, contact, nodes.clone(), rest, out);
    curve(model, contact, stuck, nodes, |first, terms| {
        add_to(&mut out[first..first + terms.len()], terms);
    });
}

/// τ alone, of some `nodes`; those further in are zero, the others finite.
pub(super) fn shear(
    model: &Model,
    contact: &Contact,
    stuck: f64,
    nodes: Range<usize>,
    rest: &mut Rest,
    out: &mut [f64],
) {
    shear_of_chords(model, contact, nodes.clone(), rest, out);
    curve(model, contact, stuck, nodes, |first, terms| {
        let nodes = first..first + terms.len();
        let (tau, states) = (&mut out[nodes.clone()], &contact.spring_state[nodes]);
        add_to_shear(tau, states, model.setup.material.friction(), terms);
    });
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

/// Passes to `add`, in pieces with their first nodes, what the curvature of the line load between the nodes adds to
/// p on those `nodes`: nothing next to the permanent stick zone or behind a border of stick, where wear may just have
/// made the load steep.
fn curve(
    model: &Model,
    contact: &Contact,
    stuck: f64,
    nodes: Range<usize>,
    mut add: impl FnMut(usize, &[f64]),
) {
    let Some(curvature) = &model.curvature else {
        return;
    };
    let kinks = contact.load.kinks.iter().copied();
    let stuck = model.grid.nodes().partition_point(|&x| x <= stuck);
    let steep = stuck.saturating_sub(1)..stuck + STEEP;
    let load = &contact.load.nodal;
    let end = contact.end(model, load);
    let nodes = nodes.start..nodes.end.min(end.nodes);
    curvature.for_each(load, end.cusp, kinks, nodes, |first, terms| {
        let steep = within(&steep, first, terms.len());
        terms[steep].fill(0.0);
        drop_behind_borders(&contact.spring_state, first, terms);
        add(first, terms);
    });
}

/// Which of a piece of `count` nodes from `first` on are among `nodes`, counted from the first.
fn within(nodes: &Range<usize>, first: usize, count: usize) -> Range<usize> {
    let [start, end] = [nodes.start, nodes.end].map(|j| j.clamp(first, first + count) - first);
    start..end
}

/// Makes the `terms` of nodes from `first` on zero where a border of stick lies within the two cells before.
fn drop_behind_borders(states: &[SpringState], first: usize, terms: &mut [f64]) {
    // The term of the first two nodes is zero.
    let skipped = 2_usize.saturating_sub(first);
    let (Some(terms), Some(states)) = (terms.get_mut(skipped..), states.get(first + skipped - 2..))
    else {
        return;
    };
    vectorized(
        #[inline(always)]
        || {
            for (term, states) in terms.iter_mut().zip(states.windows(3)) {
                let [second, first, own] = [0, 1, 2].map(|i| states[i] == SpringState::Stick);
                *term = select((second == own) & (first == own), *term, 0.0);
            }
        },
    );
}

/// Adds to `tau`, of nodes whose springs are in `states`, its share of what the curvature of the load adds to p: what
/// slips is curved like μq, what sticks keeps the kinks of its history.
fn add_to_shear(tau: &mut [f64], states: &[SpringState], friction: f64, terms: &[f64]) {
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

//! Computes the stresses p(r) and τ(r) from the line loads of a solved contact, Eq. (3).

use serde::{Deserialize, Serialize};

use super::contact::Contact;
use super::model::Model;
use crate::math::abel::field::Field;
use crate::math::vector::vectorized;

/// p of a solved contact at the nodes, Pa, computed from node `from` outwards.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Pressure {
    /// Innermost node whose value belongs to this contact.
    pub from: usize,
    /// One value per node; 0 before that node.
    pub nodal: Vec<f64>,
}

impl Pressure {
    /// Makes a pressure without values, on `nodes` nodes.
    pub(super) fn unknown(nodes: usize) -> Self {
        let nodal = vec![0.0; nodes];
        Self { from: nodes, nodal }
    }

    /// Forgets the values, because the contact has changed.
    pub(super) fn forget(&mut self) {
        self.from = self.nodal.len();
        self.nodal.fill(0.0);
    }

    /// Computes the pressure of a contact from the node `first` on. Overwrites `rest`.
    pub(super) fn find(
        &mut self,
        model: &Model,
        contact: &Contact,
        first: usize,
        rest: &mut Vec<f64>,
    ) -> &Self {
        let out = (&mut self.nodal[..], rest);
        self.from = stress(model, contact, &contact.load, first, out);
        self.nodal[..self.from].fill(0.0);
        self
    }
}

/// Computes p, Pa, of the solved contact, for output.
pub(crate) fn pressure(model: &Model, contact: &Contact, out: &mut [f64]) {
    stress(model, contact, &contact.load, 0, (out, &mut Vec::new()));
    smooth_end(&contact.load, out);
}

/// Computes τ, Pa, of the solved contact, for output.
pub(crate) fn shear_to_read(model: &Model, contact: &Contact, out: &mut [f64]) {
    shear(model, contact, 0, (out, &mut Vec::new()));
    smooth_end(&contact.spring, out);
}

/// A stress that rises by more than this factor between the last nodes really rises.
const RISES: f64 = 1.1;

/// Limits the stress at the last node of a scar over which the edge has just passed: until it has worn, it carries more
/// than its share. Leaves stress that rises towards the edge, as under an oscillating load.
fn smooth_end(field: &Field, stress: &mut [f64]) {
    let Some(dome) = field.dome else { return };
    if let [before, next, end] = &mut stress[dome.last.saturating_sub(2)..=dome.last]
        && next.abs() <= RISES * before.abs()
    {
        *end = end.clamp(-next.abs(), next.abs());
    }
}

/// Eq. (3) of a `field` of a contact, see [`Field::stress_from`].
fn stress(
    model: &Model,
    contact: &Contact,
    field: &Field,
    first: usize,
    out: (&mut [f64], &mut Vec<f64>),
) -> usize {
    field.stress_from(first, &model.plan, &model.grid, contact.normal.nodes, out)
}

/// Computes τ, Pa, of the solved contact, from the node `first` on. Overwrites `rest`.
pub(crate) fn shear(
    model: &Model,
    contact: &Contact,
    first: usize,
    (out, rest): (&mut [f64], &mut Vec<f64>),
) {
    stress(model, contact, &contact.spring, first, (&mut *out, rest));
    let modulus = model.setup.material.tangential_modulus();
    vectorized(
        #[inline(always)]
        || {
            for stress in &mut out[first..] {
                *stress *= modulus;
            }
        },
    );
}

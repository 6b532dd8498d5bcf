//! Computes the stresses p(r) and τ(r) from the line loads of a solved contact, Eq. (3).

use serde::{Deserialize, Serialize};

use super::contact::Contact;
use super::model::Model;
use crate::math::vector::vectorized;

/// p of a solved contact, Pa, at the nodes: as far inwards as a step has needed it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Pressure {
    /// The innermost node with a value of this contact.
    pub from: usize,
    /// One value a node; 0 before that one.
    pub nodal: Vec<f64>,
}

impl Pressure {
    /// Of no contact yet, on `nodes` nodes.
    pub(super) fn unknown(nodes: usize) -> Self {
        let nodal = vec![0.0; nodes];
        Self { from: nodes, nodal }
    }

    /// Forgets the contact, which has become another one.
    pub(super) fn forget(&mut self) {
        self.from = self.nodal.len();
        self.nodal.fill(0.0);
    }

    /// Becomes that of a contact from the node `first` on.
    pub(super) fn find(&mut self, model: &Model, contact: &Contact, first: usize) {
        let (plan, grid, touching) = (&model.plan, &model.grid, contact.normal.nodes);
        let p = &mut self.nodal;
        self.from = contact.load.stress_from(first, plan, grid, touching, p);
        p[..self.from].fill(0.0);
    }
}

/// p, Pa, of the solved contact.
pub(crate) fn pressure(model: &Model, contact: &Contact, out: &mut [f64]) {
    let touching = contact.normal.nodes;
    contact.load.stress(&model.plan, &model.grid, touching, out);
}

/// τ, Pa, of the solved contact, from the node `first` on.
pub(crate) fn shear(model: &Model, contact: &Contact, first: usize, out: &mut [f64]) {
    let (plan, grid, touching) = (&model.plan, &model.grid, contact.normal.nodes);
    contact.spring.stress_from(first, plan, grid, touching, out);
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

//! Computes the stresses p(r) and τ(r) from the line loads of a solved contact, Eq. (3).

use serde::{Deserialize, Serialize};

use super::contact::Contact;
use super::model::Model;
use crate::math::vector::vectorized;

/// p and τ of one contact, Pa, nodal; empty where nothing needs them.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Traction {
    /// p.
    pub pressure: Vec<f64>,
    /// τ.
    pub shear: Vec<f64>,
}

impl Traction {
    pub(super) fn zeros(nodes: usize) -> Self {
        Self {
            pressure: vec![0.0; nodes],
            shear: vec![0.0; nodes],
        }
    }
}

/// p and τ of the solved contact.
pub(super) fn of(model: &Model, contact: &Contact, traction: &mut Traction) {
    pressure(model, contact, &mut traction.pressure);
    shear(model, contact, &mut traction.shear);
}

/// p alone.
pub(crate) fn pressure(model: &Model, contact: &Contact, out: &mut [f64]) {
    let touching = contact.normal.nodes;
    contact.load.stress(&model.plan, &model.grid, touching, out);
}

/// τ alone.
pub(crate) fn shear(model: &Model, contact: &Contact, out: &mut [f64]) {
    let touching = contact.normal.nodes;
    contact
        .spring
        .stress(&model.plan, &model.grid, touching, out);
    let modulus = model.setup.material.tangential_modulus();
    vectorized(
        #[inline(always)]
        || {
            for stress in out {
                *stress *= modulus;
            }
        },
    );
}

//! Buffers of a run: planned once, overwritten in every step, never saved.

use std::sync::Arc;

use super::Setup;
use crate::contact::normal::NormalContact;
use crate::contact::tangential::Slide;
use crate::math::abel::AbelPlan;

/// Weights, buffers, and the contact as the last step solved it.
#[derive(Debug, Clone)]
pub(super) struct Workspace {
    pub plan: Arc<AbelPlan>,
    /// f₀ and its 1D image g₀, m.
    pub unworn: Arc<[f64]>,
    pub unworn_1d: Arc<[f64]>,
    /// g, m.
    pub g: Vec<f64>,
    /// q_z, N/m.
    pub normal_load: Vec<f64>,
    /// The springs u_x after the step, m.
    pub spring: Vec<f64>,
    /// Slip of the springs in the step, m.
    pub slip: Vec<f64>,
    /// q_x, N/m.
    pub tangential_load: Vec<f64>,
    /// q_x times the slip, J/m.
    pub friction_work: Vec<f64>,
    /// τ, Pa.
    pub tau: Vec<f64>,
    /// Slip of the surface in the step, m.
    pub surface_slip: Vec<f64>,
    /// f − f₀ after the step, m.
    pub wear: Vec<f64>,
    pub contact: Contact,
}

/// The scalars of a solved contact.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Contact {
    pub depth: f64,
    pub shift: f64,
    pub normal: NormalContact,
    pub tangential_force: f64,
    pub slide: Option<Slide>,
}

impl Workspace {
    /// Plans the transforms and sets up the buffers; `plan` is reused where one fits.
    pub fn new(setup: &Setup, plan: Option<Arc<AbelPlan>>) -> Self {
        let plan = plan.unwrap_or_else(|| Arc::new(AbelPlan::new(setup.method, &setup.grid)));
        let unworn: Arc<[f64]> = setup
            .grid
            .nodes()
            .iter()
            .map(|&r| setup.indenter.profile(r))
            .collect();
        let nodes = setup.grid.len();
        let mut g = vec![0.0; nodes];
        plan.profile(&unworn, &mut g);
        // Without tangential motion there are no springs, without wear no stress to wear by.
        let springs = if setup.drive.tangential().is_some() {
            nodes
        } else {
            0
        };
        Self {
            unworn_1d: g.as_slice().into(),
            plan,
            unworn,
            g,
            normal_load: vec![0.0; nodes],
            spring: vec![0.0; springs],
            slip: vec![0.0; springs],
            tangential_load: vec![0.0; springs],
            friction_work: vec![0.0; springs],
            tau: vec![0.0; springs],
            surface_slip: vec![0.0; springs],
            wear: vec![0.0; nodes],
            contact: Contact::default(),
        }
    }
}

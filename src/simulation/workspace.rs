//! Buffers of a run: planned once, overwritten in every step, never saved.

use std::ops::Range;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::choices::Integrator;
use super::state::State;
use super::{Setup, moments};
use crate::contact::foundation::Foundation;
use crate::contact::normal::NormalContact;
use crate::contact::tangential::Hold;
use crate::math::abel::bend::Bend;
use crate::math::abel::cone::Rest;
use crate::math::abel::curvature::Curvature;
use crate::math::abel::rim::Rim;
use crate::math::abel::rim_edge::RimEdge;
use crate::math::abel::worn;
use crate::math::abel::{AbelMethod, AbelPlan, WornPlan};
use crate::math::grid::RadialGrid;

/// Weights, buffers, and the contact as the last step solved it.
#[derive(Debug, Clone)]
pub(super) struct Workspace {
    pub planned: Arc<Planned>,
    /// g, m, of the profile as it stands.
    pub g: Vec<f64>,
    /// What Eq. (1) was last computed of, m: a worn depth or its growth.
    pub image: Vec<f64>,
    /// g, m, that the contact was solved with: the scheme may look ahead.
    pub predicted: Vec<f64>,
    /// The rim of the worn zone, where the worn profile has a kink.
    pub rim: Option<Rim>,
    /// q_z, N/m, and its breaks.
    pub normal_load: Vec<f64>,
    pub normal_breaks: Vec<Bend>,
    /// The contact's edge where it lies in the rim's cell.
    pub rim_edge: Option<RimEdge>,
    /// The springs u_x after the step, m, and their breaks.
    pub spring: Vec<f64>,
    pub hold: Vec<Hold>,
    pub spring_breaks: Vec<Bend>,
    /// Slip of the springs in the step, m.
    pub slip: Vec<f64>,
    /// Where the slip bends between springs, and in which cell.
    pub slip_kinks: Vec<(usize, Bend)>,
    /// The work of friction, J/m, and its breaks.
    pub friction_work: Vec<f64>,
    pub work_breaks: Vec<Bend>,
    /// p, Pa.
    pub pressure: Vec<f64>,
    /// τ at the end of the step, Pa.
    pub shear: Vec<f64>,
    /// A load without its cusp, while its stress is computed.
    pub rest: Rest,
    /// τ by which the step wears, Pa.
    pub working_shear: Vec<f64>,
    /// Slip of the surface in the step, m.
    pub surface_slip: Vec<f64>,
    /// How stiffly each node that slides answers to its wear, of a step.
    pub stiffness: Vec<f64>,
    /// The ends of the steps of a period, in cycles, for jumps.
    pub moments: Vec<f64>,
    /// The nodes that may wear in the step: further in nothing slips, further out nothing presses.
    pub sliding: Range<usize>,
    /// What the step wears, m; 0 but for the nodes that slide.
    pub worn: Vec<f64>,
    /// What the step wears between nodes beyond their interpolant, m³; none where that is not known.
    pub beyond_nodes: Option<f64>,
    /// f − f₀ after the step, m, of the nodes that slide, until the state has it.
    pub wear: Vec<f64>,
    /// Transforms computed since they were last counted.
    pub transforms: u64,
    pub contact: Contact,
    /// The contact of the last good step.
    pub good: Contact,
}

/// What depends on the grid, the method and the indenter alone.
#[derive(Debug)]
pub(super) struct Planned {
    pub plan: AbelPlan,
    /// From the worn depth to its share of g, where that is not the plan's Eq. (1).
    pub worn: Option<WornPlan>,
    pub row: Foundation,
    /// What the stress lacks between nodes, where the method takes it into account.
    pub curvature: Option<Curvature>,
    pub grid: RadialGrid,
    /// 1/h, h the width of the cell around each node, 1/m.
    pub per_width: Vec<f64>,
    /// Weights of 2π∫ y r dr, m².
    pub volume_weights: Vec<f64>,
    /// f₀ and its 1D image g₀, m.
    pub unworn: Arc<[f64]>,
    pub unworn_1d: Vec<f64>,
}

/// The scalars of a solved contact.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(super) struct Contact {
    pub depth: f64,
    pub shift: f64,
    pub normal: NormalContact,
    /// The stick radius, m; none without tangential motion.
    pub stick_radius: Option<f64>,
}

impl Planned {
    fn new(setup: &Setup) -> Self {
        let plan = AbelPlan::new(setup.method, &setup.grid);
        let nodes = setup.grid.nodes();
        let unworn: Arc<[f64]> = nodes.iter().map(|&r| setup.indenter.profile(r)).collect();
        let (worn, unworn_1d) = if setup.method == AbelMethod::Product {
            let image = nodes
                .iter()
                .map(|&x| setup.indenter.profile_1d(x))
                .collect();
            let border = setup.grid.border();
            (border.map(|_| WornPlan::new(&setup.grid)), image)
        } else {
            let mut image = vec![0.0; nodes.len()];
            plan.profile(&unworn, &mut image);
            (None, image)
        };
        Self {
            worn,
            row: Foundation::new(&setup.grid),
            curvature: (setup.method == AbelMethod::Product).then(|| Curvature::new(&setup.grid)),
            per_width: setup.grid.widths().map(f64::recip).collect(),
            volume_weights: worn::volume_weights(&setup.grid),
            grid: setup.grid.clone(),
            plan,
            unworn,
            unworn_1d,
        }
    }

    /// Whether breaks between nodes go into the transforms.
    pub fn has_breaks(&self) -> bool {
        self.plan.method() == AbelMethod::Product
    }
}

/// The steps of a period, where periods are to be jumped.
fn jump_moments(setup: &Setup) -> Vec<f64> {
    match (setup.integrator, setup.drive.repeats_after()) {
        (Integrator::CycleJump { .. }, Some(period)) => moments::of_period(setup, period),
        _ => Vec::new(),
    }
}

impl Workspace {
    /// Plans the transforms and sets up the buffers; `planned` is reused where it fits.
    pub fn new(setup: &Setup, planned: Option<Arc<Planned>>) -> Self {
        let planned = planned.unwrap_or_else(|| Arc::new(Planned::new(setup)));
        let nodes = setup.grid.len();
        // Without tangential motion there are no springs, without wear no stress to wear by.
        let springs = if setup.drive.tangential().is_some() {
            nodes
        } else {
            0
        };
        let wearing = if setup.wear.is_some() { springs } else { 0 };
        Self {
            g: planned.unworn_1d.clone(),
            image: vec![0.0; nodes],
            predicted: planned.unworn_1d.clone(),
            planned,
            rim: None,
            normal_load: vec![0.0; nodes],
            normal_breaks: Vec::new(),
            rim_edge: None,
            spring: vec![0.0; springs],
            hold: vec![Hold::Stick; springs],
            spring_breaks: Vec::new(),
            slip: vec![0.0; springs],
            slip_kinks: Vec::new(),
            friction_work: vec![0.0; springs],
            work_breaks: Vec::new(),
            pressure: vec![0.0; wearing],
            shear: vec![0.0; wearing],
            rest: Rest::default(),
            working_shear: vec![0.0; wearing],
            surface_slip: vec![0.0; wearing],
            stiffness: vec![0.0; wearing],
            moments: jump_moments(setup),
            sliding: 0..0,
            worn: vec![0.0; nodes],
            beyond_nodes: None,
            wear: vec![0.0; nodes],
            transforms: 0,
            contact: Contact::default(),
            good: Contact::default(),
        }
    }

    /// Notes that the contact as solved is good.
    pub fn keep_as_good(&mut self) {
        self.good = self.contact;
    }

    /// Takes the contact of the last good step back, after one that failed.
    pub fn show_last_good(&mut self, state: &State) {
        self.contact = self.good;
        self.normal_breaks.clone_from(&state.last.normal_breaks);
        self.spring_breaks.clone_from(&state.last.spring_breaks);
        self.rim_edge = state.last.rim_edge;
        self.normal_load.copy_from_slice(&state.last.normal_load);
        self.spring.copy_from_slice(&state.spring);
        self.hold.copy_from_slice(&state.hold);
        super::profile::set_profile(self, &state.image, &state.wear);
    }
}

//! Everything planned once per run: the parts, the operators, and the 1D image of the indenter.

use std::ops::Deref;
use std::sync::{Arc, OnceLock};

use super::Setup;
use crate::contact::foundation::WinklerFoundation;
use crate::math::abel::{AbelPlan, counted};
use crate::math::grid::RadialGrid;
use crate::math::quadrature::weighted;
use crate::math::vector::{vectorized, write_each};

/// The parts of a run with their operators.
#[derive(Debug, Clone)]
pub(crate) struct Model {
    pub setup: Setup,
    operators: Arc<Operators>,
}

/// Operators that only depend on grid, method and indenter; clones of a [`Model`] share them.
#[derive(Debug)]
pub(crate) struct Operators {
    pub plan: AbelPlan,
    pub foundation: WinklerFoundation,
    pub grid: RadialGrid,
    /// 1/h, with h the width of the cell around each node, 1/m.
    pub per_width: Vec<f64>,
    /// Weights of the volume 2π∫ y r dr, or 2L∫ y dr in a line contact, m².
    pub volume_weights: Vec<f64>,
    /// f₀ and its 1D image g₀, m.
    pub unworn: Arc<[f64]>,
    unworn_1d: Vec<f64>,
    near_response: OnceLock<Vec<[f64; 3]>>,
}

impl Operators {
    fn new(setup: &Setup) -> Self {
        let plan = AbelPlan::for_geometry(setup.geometry, setup.method, &setup.grid);
        let nodes = setup.grid.nodes();
        let unworn: Arc<[f64]> = nodes.iter().map(|&r| setup.indenter.profile(r)).collect();
        let mut unworn_1d = vec![0.0; nodes.len()];
        if setup.method.traits().is_published {
            plan.profile(&unworn, &mut unworn_1d);
        } else {
            for (g, &x) in unworn_1d.iter_mut().zip(nodes) {
                *g = setup.indenter.image(setup.geometry, x);
            }
        }
        Self {
            foundation: WinklerFoundation::for_geometry(setup.geometry, &setup.grid),
            per_width: setup.grid.widths().map(f64::recip).collect(),
            volume_weights: setup.geometry.volume_weights(&setup.grid),
            grid: setup.grid.clone(),
            plan,
            unworn,
            unworn_1d,
            near_response: OnceLock::new(),
        }
    }
}

/// Distance, in nodes, between nodes that are probed at the same time: each response has died down at the next one.
const PROBES: usize = 24;

impl Operators {
    /// The three diagonals of M of a contact that reaches to the edge, row by row: by how much p (in E*) falls at a node for
    /// a depth worn at the one before it, at itself and at the one behind, 1/m. Half of what the rest of the row sums up to
    /// is added to its own.
    pub fn near_response(&self) -> &[[f64; 3]] {
        // Not counted: which of the runs that share it needs it first is a matter of chance.
        let probe = || {
            let nodes = self.grid.len();
            let mut image = vec![0.0; nodes];
            let mut respond = |worn: &[f64]| {
                let mut pressure = vec![0.0; nodes];
                self.plan.image(worn, &mut image);
                self.plan.stress(&image, &mut pressure);
                pressure
            };
            let mut rows = vec![[0.0; 3]; nodes];
            for first in 0..PROBES.min(nodes) {
                let mut worn = vec![0.0; nodes];
                worn[first..]
                    .iter_mut()
                    .step_by(PROBES)
                    .for_each(|w| *w = 1.0);
                let pressure = respond(&worn);
                for j in (first..nodes).step_by(PROBES) {
                    for k in j.saturating_sub(1)..(j + 2).min(nodes) {
                        rows[k][j + 1 - k] = pressure[k];
                    }
                }
            }
            let all = respond(&vec![1.0; nodes]);
            for (row, all) in rows.iter_mut().zip(all) {
                row[1] += 0.5 * (all - row.iter().sum::<f64>());
            }
            rows
        };
        self.near_response.get_or_init(|| counted(probe).0)
    }
}

impl Deref for Model {
    type Target = Operators;

    fn deref(&self) -> &Operators {
        &self.operators
    }
}

impl Model {
    /// Plans the operators of a setup; reuses the operators of the model `before` if they fit.
    pub fn new(setup: Setup, before: Option<&Self>) -> Self {
        let fits = |before: &&Self| {
            before.setup.grid == setup.grid
                && before.setup.method == setup.method
                && before.setup.indenter == setup.indenter
                && before.setup.geometry == setup.geometry
        };
        let operators = match before.filter(fits) {
            Some(before) => Arc::clone(&before.operators),
            None => Arc::new(Operators::new(&setup)),
        };
        Self { setup, operators }
    }

    /// Nodes, N + 1.
    pub fn nodes(&self) -> usize {
        self.grid.len()
    }

    /// Returns the number of tangential springs: one per node, 0 without tangential motion.
    pub fn springs(&self) -> usize {
        self.setup.springs()
    }

    /// Writes g = g₀ + `image`, m, plus `ahead` times the `growth` of the image.
    pub fn profile(&self, image: &[f64], ahead: f64, growth: &[f64], g: &mut [f64]) {
        if ahead == 0.0 {
            return write_each(
                g,
                &self.unworn_1d,
                image,
                #[inline(always)]
                |unworn, image| unworn + image,
            );
        }
        vectorized(
            #[inline(always)]
            || {
                let parts = self.unworn_1d.iter().zip(image).zip(growth);
                for (g, ((unworn, image), growth)) in g.iter_mut().zip(parts) {
                    *g = unworn + image + ahead * growth;
                }
            },
        );
    }

    /// Iterates over g = g₀ + `image`, m, node by node.
    pub fn profile_from_axis(&self, image: &[f64]) -> impl Iterator<Item = f64> {
        let parts = self.unworn_1d.iter().zip(image);
        parts.map(|(unworn, image)| unworn + image)
    }

    /// Returns the volume, m³, of a nodal depth (m).
    pub fn volume(&self, depth: &[f64]) -> f64 {
        weighted(&self.volume_weights, depth)
    }

    /// Converts cycles to s.
    pub fn seconds(&self, cycles: f64) -> f64 {
        cycles * self.setup.drive.period()
    }
}

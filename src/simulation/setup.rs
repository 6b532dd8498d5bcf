//! The parts that a run is assembled from.

use super::choices::{Integrator, Scheme, Spacing, Stability};
use super::drive::{Drive, SpringMotion};
use super::running_in::RunningIn;
use crate::contact::indenter::Indenter;
use crate::contact::material::Material;
use crate::contact::scar::Scar;
use crate::math::abel::AbelMethod;
use crate::math::geometry::Geometry;
use crate::math::grid::RadialGrid;
use crate::wear::WearLaw;

/// The parts that a run is assembled from, each validated on its own floor.
#[derive(Debug, Clone, PartialEq)]
pub struct Setup {
    /// Nodes of the 3D and of the 1D contact.
    pub grid: RadialGrid,
    /// Round, or a line; the drive and the material are [of the same](Drive::on).
    pub geometry: Geometry,
    /// Moduli and friction.
    pub material: Material,
    /// The unworn shape.
    pub indenter: Indenter,
    /// The motion.
    pub drive: Drive,
    /// The law of wear; none: nothing wears, and no stress is computed for it.
    pub wear: Option<WearLaw>,
    /// What changes with use; none: friction and wear stay as they are.
    pub running_in: Option<RunningIn>,
    /// What is worn when the run begins; none: nothing is.
    pub scar: Option<Scar>,
    /// The pressure that the softer body bears, Pa; none: no pressure is computed to be held against it.
    pub hardness: Option<f64>,
    /// The way to compute the transforms.
    pub method: AbelMethod,
    /// How the nodes are placed; where they are graded towards the stick border, only the number of cells and the radius
    /// of [`grid`](Self::grid) count.
    pub spacing: Spacing,
    /// How a step in time is taken.
    pub scheme: Scheme,
    /// What is done about steps that are too harsh.
    pub stability: Stability,
    /// Steps per period of the faster of the two motions, at least 1.
    pub steps_per_cycle: u32,
    /// How cycles are gone through.
    pub integrator: Integrator,
}

impl Setup {
    /// The same on another grid.
    pub(super) fn on(&self, grid: RadialGrid) -> Self {
        Self {
            grid,
            ..self.clone()
        }
    }

    /// Tangential springs: one a node, none without tangential motion.
    pub fn springs(&self) -> usize {
        if self.drive.tangential().is_some() {
            self.grid.len()
        } else {
            0
        }
    }

    /// The depth that is worn when the run begins, m, at the nodes of a grid.
    pub(super) fn initial_wear(&self, grid: &RadialGrid) -> Vec<f64> {
        let scar = self.scar.as_ref();
        let depth = |&r: &f64| scar.map_or(0.0, |scar| scar.depth(r));
        grid.nodes().iter().map(depth).collect()
    }

    /// The largest depth of the springs, m, where their motion is prescribed.
    pub fn largest_depth(&self) -> Option<f64> {
        self.drive
            .depth_of_springs()
            .map(|depth| SpringMotion::highest(&depth))
    }

    /// Steps in a cycle, but for those that end where the motion turns: a normal motion that is faster than the
    /// tangential one is resolved as well.
    pub fn steps_in_a_cycle(&self) -> f64 {
        f64::from(self.steps_per_cycle) * f64::from(self.drive.turns_of_the_faster())
    }

    /// The depth that wear is measured in, m: the largest of the motion, or the `present` one where the
    /// force is prescribed.
    pub fn depth_scale(&self, present: f64) -> f64 {
        self.largest_depth().unwrap_or(present)
    }
}

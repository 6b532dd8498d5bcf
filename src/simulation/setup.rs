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

/// The parts that a run is assembled from, each validated in its own layer.
#[derive(Debug, Clone, PartialEq)]
pub struct Setup {
    /// Nodes of the 3D and the 1D contact.
    pub grid: RadialGrid,
    /// Geometry of the contact; drive and material must be [made for it](Drive::in_geometry).
    pub geometry: Geometry,
    /// Moduli and friction.
    pub material: Material,
    /// The unworn shape.
    pub indenter: Indenter,
    /// The motion.
    pub drive: Drive,
    /// The wear law; `None` if nothing wears, and then no stress is computed for it.
    pub wear: Option<WearLaw>,
    /// Coefficients that change with use; `None` if friction and wear are constant.
    pub running_in: Option<RunningIn>,
    /// Initial wear; `None` if unworn.
    pub scar: Option<Scar>,
    /// The pressure that the softer body can bear, Pa; `None` to skip the comparison.
    pub hardness: Option<f64>,
    /// The transform method.
    pub method: AbelMethod,
    /// How the nodes are placed; if they are graded towards the stick border, only the number of cells and the radius
    /// of [`grid`](Self::grid) count.
    pub spacing: Spacing,
    /// The time-stepping scheme.
    pub scheme: Scheme,
    /// How too stiff steps are treated.
    pub stability: Stability,
    /// Steps per period of the faster of the two motions, at least 1.
    pub steps_per_cycle: u32,
    /// How cycles are integrated.
    pub integrator: Integrator,
}

impl Setup {
    /// Returns the same setup on another grid.
    pub(super) fn with_grid(&self, grid: RadialGrid) -> Self {
        Self {
            grid,
            ..self.clone()
        }
    }

    /// Returns the number of tangential springs: one per node, 0 without tangential motion.
    pub fn springs(&self) -> usize {
        if self.drive.tangential().is_some() {
            self.grid.len()
        } else {
            0
        }
    }

    /// Returns the initially worn depth, m, at the nodes of a grid.
    pub(super) fn initial_wear(&self, grid: &RadialGrid) -> Vec<f64> {
        let scar = self.scar.as_ref();
        let depth = |&r: &f64| scar.map_or(0.0, |scar| scar.depth(r));
        grid.nodes().iter().map(depth).collect()
    }

    /// Returns the largest depth of the springs, m, if their motion is prescribed.
    pub fn largest_depth(&self) -> Option<f64> {
        self.drive
            .depth_of_springs()
            .map(|depth| SpringMotion::highest(&depth))
    }

    /// Returns the number of steps per cycle, not counting those that end at turning points. A normal motion that is
    /// faster than the tangential one is resolved as well.
    pub fn steps_in_a_cycle(&self) -> f64 {
        f64::from(self.steps_per_cycle) * f64::from(self.drive.turns_of_the_faster())
    }

    /// Returns the depth to which wear is relative, m: the largest of
    /// the motion, or the `present` one if the force is prescribed.
    pub fn depth_scale(&self, present: f64) -> f64 {
        self.largest_depth().unwrap_or(present)
    }
}

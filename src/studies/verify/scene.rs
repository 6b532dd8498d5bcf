//! The dimensionless contact of the study: E* = 1, and a = 1 where something presses.

use crate::contact::indenter::Indenter;
use crate::contact::material::Material;
use crate::math::abel::AbelMethod;
use crate::math::grid::RadialGrid;
use crate::math::invalid::Invalid;
use crate::simulation::drive::{Control, Drive, Oscillation};
use crate::simulation::{Integrator, Scheme, Setup, Spacing, Stability};
use crate::wear::WearLaw;

/// μ.
pub const FRICTION: f64 = 0.1;

/// ν.
pub const POISSON: f64 = 0.3;

/// What differs from problem to problem.
pub struct Scene {
    /// The transforms.
    pub method: AbelMethod,
    /// N.
    pub points: usize,
    /// L/a.
    pub domain: f64,
    /// f₀.
    pub indenter: Indenter,
    /// d.
    pub depth: f64,
    /// U; none: no tangential motion.
    pub amplitude: Option<f64>,
    /// k; none: no wear.
    pub wear: Option<f64>,
    /// Where the nodes lie.
    pub spacing: Spacing,
    /// How time is stepped.
    pub scheme: Scheme,
}

/// Steps per cycle.
const STEPS: u32 = 40;

impl Scene {
    /// `indenter` pressed to `depth` on the paper's grid, N = `points` over `domain`; nothing else.
    pub fn pressed(
        method: AbelMethod,
        points: usize,
        domain: f64,
        indenter: Indenter,
        depth: f64,
    ) -> Self {
        Self {
            method,
            points,
            domain,
            indenter,
            depth,
            amplitude: None,
            wear: None,
            spacing: Spacing::Uniform,
            scheme: Scheme::Euler,
        }
    }

    /// The parts of a simulation.
    pub fn setup(&self) -> Result<Setup, Invalid> {
        let swing = |mean, amplitude| {
            Oscillation::new(mean, amplitude, 1.0, 0.0).map(Control::Displacement)
        };
        let tangential = self.amplitude.map(|amplitude| swing(0.0, amplitude));
        Ok(Setup {
            grid: RadialGrid::uniform(self.points, self.domain)?,
            material: Material::new(1.0, POISSON, FRICTION)?,
            indenter: self.indenter.clone(),
            drive: Drive::new(swing(self.depth, 0.0)?, tangential.transpose()?),
            wear: self.wear.map(WearLaw::archard).transpose()?,
            method: self.method,
            spacing: self.spacing,
            scheme: self.scheme,
            stability: Stability::Off,
            integrator: Integrator::Direct,
            running_in: None,
            scar: None,
            hardness: None,
            steps_per_cycle: STEPS,
        })
    }
}

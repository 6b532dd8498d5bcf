//! The dimensionless contact of the study: E* = 1, and a = 1 if there is contact.

use crate::contact::indenter::Indenter;
use crate::contact::material::Material;
use crate::math::abel::AbelMethod;
use crate::math::geometry::Geometry;
use crate::math::grid::RadialGrid;
use crate::simulation::drive::{Control, Drive, Oscillation};
use crate::simulation::{Integrator, Scheme, Setup, Spacing, Stability};

/// μ.
pub const FRICTION: f64 = 0.1;

/// ν.
pub const POISSON: f64 = 0.3;

/// Steps per cycle.
const STEPS: u32 = 40;

/// Presses `indenter` to `depth` on the nodes of `grid`, by the paper's scheme, without tangential motion or wear.
pub fn pressed(method: AbelMethod, grid: RadialGrid, indenter: Indenter, depth: f64) -> Setup {
    Setup {
        geometry: Geometry::Round,
        grid,
        material: Material::new(1.0, POISSON, FRICTION).expect("a material"),
        indenter,
        drive: Drive::new(swing(depth, 0.0), None),
        wear: None,
        method,
        spacing: Spacing::Uniform,
        scheme: Scheme::Euler,
        stability: Stability::Off,
        integrator: Integrator::Direct,
        running_in: None,
        scar: None,
        hardness: None,
        steps_per_cycle: STEPS,
    }
}

/// Makes a displacement of angular frequency 1.
pub fn swing(mean: f64, amplitude: f64) -> Control {
    let swing = Oscillation::new(mean, amplitude, 1.0, 0.0);
    Control::Displacement(swing.expect("a motion"))
}

/// Makes N = `points` equal cells up to `radius`.
///
/// # Panics
/// If a grid cannot have that many or that few cells.
pub fn grid(points: usize, radius: f64) -> RadialGrid {
    RadialGrid::uniform(points, radius).expect("a grid")
}

//! A cylinder on a flat with a = R = E* = 1: first loading, and the limit of wear.

use std::f64::consts::FRAC_PI_4;

use super::errors::Errors;
use super::normal::between_nodes;
use super::scene::{FRICTION, grid, pressed};
use crate::contact::indenter::Indenter;
use crate::math::abel::AbelMethod;
use crate::math::geometry::Geometry;
use crate::oracle::line_contact::Cylinder;
use crate::reading::Curves;
use crate::scenario::choices;
use crate::simulation::drive::{Control, Drive, Oscillation};
use crate::simulation::{Breakdown, Setup, Simulation};
use crate::wear::WearLaw;

/// ℓ/a, irrelevant under forces.
const GAUGE: f64 = 10.0;

/// L/a, beyond the end of the scar.
const DOMAIN: f64 = 1.3;

/// Q/(μP), k E* and the number of cycles of the run to the limit.
const SHARE: f64 = 0.5;
const WEAR: f64 = 3.0;
const CYCLES: f64 = 400.0;

fn cylinder() -> Cylinder {
    Cylinder {
        e_star: 1.0,
        radius: 1.0,
        friction: FRICTION,
        load: FRAC_PI_4,
    }
}

/// Returns one metre of it, under a tangential force of this amplitude.
fn moved(method: AbelMethod, points: usize, domain: f64, amplitude: f64) -> Setup {
    let force = |mean, amplitude| {
        let force = Oscillation::new(mean, amplitude, 1.0, 0.0);
        Control::Force(force.expect("a motion"))
    };
    let indenter = Indenter::paraboloid(1.0).expect("a shape");
    let setup = pressed(method, grid(points, domain), indenter, 1.0);
    let geometry = Geometry::Line { length: 1.0 };
    let material = setup.material.in_plane_strain();
    let drive = Drive::new(force(FRAC_PI_4, 0.0), Some(force(0.0, amplitude)));
    Setup {
        geometry,
        material,
        drive: drive.in_geometry(geometry, &material, GAUGE),
        ..setup
    }
}

/// Computes errors of τ and slip after a quarter of a cycle without wear, c about a/2.
pub fn cattaneo(method: AbelMethod, points: usize) -> Result<Vec<Errors>, Breakdown> {
    let (domain, inner) = between_nodes(points);
    let exact = cylinder();
    let force = (1.0 - inner * inner) * exact.friction * exact.load;
    let mut simulation = Simulation::new(moved(method, points, domain, force))?;
    simulation.advance_to(0.25)?;
    let seen = simulation.observe(Curves::SHEAR | Curves::SURFACE | Curves::SPRINGS);
    let nodes = seen.radii().iter().copied();
    let shear = nodes.clone().zip(seen.shear());
    let shear = shear.map(|(x, &tau)| (x, tau, exact.shear(force, x)));
    let slip = nodes.zip(seen.surface()).take_while(|(x, _)| *x <= 1.0);
    let slip = slip.map(|(x, surface)| (x, seen.spring()[0] - surface, exact.slip(force, x)));
    Ok(vec![
        Errors::new(Some(exact.shear(force, inner)), shear),
        Errors::new(Some(exact.slip(force, 1.0)), slip),
    ])
}

/// Computes errors of the worn depth after a long run.
pub fn limit(method: AbelMethod, points: usize) -> Result<Vec<Errors>, Breakdown> {
    let exact = cylinder();
    let force = SHARE * exact.friction * exact.load;
    let mut setup = moved(method, points, DOMAIN, force);
    setup.wear = Some(WearLaw::archard(WEAR).expect("a law"));
    (setup.spacing, setup.scheme) = choices(method);
    let mut simulation = Simulation::new(setup)?;
    simulation.advance_to(CYCLES)?;
    let stick = exact.stick_half_width(force);
    let nodes = simulation.setup().grid.nodes().iter();
    let worn = nodes.zip(simulation.worn_depth());
    let samples = worn.map(|(&x, &worn)| (x, worn, exact.limit_depth(stick, x)));
    let mut errors = Errors::new(Some(0.5), samples);
    errors.over_radius = true;
    Ok(vec![errors])
}

//! Tangential contact of a paraboloid with a = d = R = E* = 1: first loading, and the limit of wear.

use super::errors::NodalErrors;
use super::exact::{self, FRICTION, GROSS_SLIP, POISSON};
use crate::contact::indenter::Indenter;
use crate::contact::material::Material;
use crate::math::abel::AbelMethod;
use crate::math::geometry::Geometry;
use crate::math::grid::RadialGrid;
use crate::reading::Curves;
use crate::scenario::choices;
use crate::simulation::drive::{Control, Drive, Oscillation};
use crate::simulation::{Breakdown, Integrator, Scheme, Setup, Simulation, Spacing, Stability};
use crate::wear::WearLaw;

/// Steps per cycle.
const STEPS: u32 = 40;

/// Returns L/a, about 1.5, and c/a, about a half, of a grid of N = `points`. Both borders lie a third of a cell outside a
/// node: otherwise an error that depends on the place within the cell would hide the order.
fn between_nodes(points: usize) -> (f64, f64) {
    let cells = |whole: usize| whole as f64 + 1.0 / 3.0;
    let contact = cells(2 * points / 3);
    (points as f64 / contact, cells(points / 3) / contact)
}

/// Returns the contact, moved by `amplitude`, on N = `points` equal cells over `domain`, by the paper's scheme.
fn moved(method: AbelMethod, points: usize, domain: f64, amplitude: f64) -> Setup {
    let swing = |mean, amplitude| {
        let swing = Oscillation::new(mean, amplitude, 1.0, 0.0);
        Control::Displacement(swing.expect("a motion"))
    };
    Setup {
        geometry: Geometry::Round,
        grid: RadialGrid::uniform(points, domain).expect("a grid"),
        material: Material::new(1.0, POISSON, FRICTION).expect("a material"),
        indenter: Indenter::paraboloid(1.0).expect("a shape"),
        drive: Drive::new(swing(1.0, 0.0), Some(swing(0.0, amplitude))),
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

/// Computes errors of τ and slip after a quarter of a cycle without wear: c² = 1 − κU.
pub fn cattaneo(method: AbelMethod, points: usize) -> Result<Vec<NodalErrors>, Breakdown> {
    let (domain, inner) = between_nodes(points);
    let amplitude = (1.0 - inner * inner) * GROSS_SLIP;
    let mut simulation = Simulation::new(moved(method, points, domain, amplitude))?;
    simulation.advance_to(0.25)?;
    let seen = simulation.observe(Curves::SHEAR | Curves::SURFACE);
    let nodes = seen.radii().iter().copied();
    let shear = nodes.clone().zip(seen.shear());
    let shear = shear.map(|(r, &tau)| (r, tau, exact::shear(inner, r)));
    let slip = nodes.zip(seen.surface()).take_while(|(r, _)| *r <= 1.0);
    let slip = slip.map(|(r, surface)| (r, seen.moment.shift - surface, exact::slip(inner, r)));
    // τ rises up to c and falls beyond; the slip rises up to a.
    Ok(vec![
        NodalErrors::new(Some(exact::shear(inner, inner)), shear),
        NodalErrors::new(Some(exact::slip(inner, 1.0)), slip),
    ])
}

/// L/a: greater than √2, beyond which nothing touches.
const DOMAIN: f64 = 1.5;

/// U, in d.
const AMPLITUDE: f64 = 0.05;

/// K = kE*d/a.
const WEAR: f64 = 3.0;

/// Cycles after which the remaining wear is far below every error.
const CYCLES: f64 = 400.0;

/// Computes errors of f and the permanent stick radius after a long run.
pub fn limit(method: AbelMethod, points: usize) -> Result<Vec<NodalErrors>, Breakdown> {
    let stick_radius = (1.0 - AMPLITUDE / GROSS_SLIP).sqrt();
    let mut setup = moved(method, points, DOMAIN, AMPLITUDE);
    setup.wear = Some(WearLaw::archard(WEAR).expect("a law"));
    (setup.spacing, setup.scheme) = choices(method);
    let mut simulation = Simulation::new(setup)?;
    simulation.advance_to(CYCLES)?;
    let seen = simulation.observe(Curves::PROFILE);
    let worn = seen.radii().iter().zip(seen.profile());
    let worn = worn.map(|(&r, &f)| (r, f, exact::limit(stick_radius, r)));
    let found = seen.moment.permanent_stick_radius.unwrap_or(f64::NAN);
    let mut profile = NodalErrors::new(Some(1.0), worn);
    profile.over_radius = true;
    let stick = [(stick_radius, found, stick_radius)];
    Ok(vec![profile, NodalErrors::new(None, stick.into_iter())])
}

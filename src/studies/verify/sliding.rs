//! Tangential contact of a paraboloid with a = d = R = 1: first loading, and the limit of wear.

use super::errors::Errors;
use super::normal::between_nodes;
use super::scene::{FRICTION, POISSON, grid, pressed, swing};
use crate::contact::indenter::Indenter;
use crate::math::abel::AbelMethod;
use crate::oracle::cattaneo_mindlin::CattaneoMindlin;
use crate::oracle::limiting_profile::LimitingProfile;
use crate::oracle::partial_slip::stiffness_ratio;
use crate::reading::Curves;
use crate::scenario::choices;
use crate::simulation::drive::Drive;
use crate::simulation::{Breakdown, Setup, Simulation};
use crate::wear::WearLaw;

/// Returns the closed form for the motion `amplitude`.
fn theory(amplitude: f64) -> CattaneoMindlin {
    CattaneoMindlin {
        e_star: 1.0,
        g_star: stiffness_ratio(POISSON),
        mu: FRICTION,
        radius: 1.0,
        depth: 1.0,
        amplitude,
    }
}

/// Returns the paraboloid, moved by `amplitude`, on N = `points` over `domain`.
fn moved(method: AbelMethod, points: usize, domain: f64, amplitude: f64) -> Setup {
    let indenter = Indenter::paraboloid(1.0).expect("a shape");
    Setup {
        drive: Drive::new(swing(1.0, 0.0), Some(swing(0.0, amplitude))),
        ..pressed(method, grid(points, domain), indenter, 1.0)
    }
}

/// Computes errors of τ and slip after a quarter of a cycle without wear, c about a/2: c² = 1 − κU.
pub fn cattaneo(method: AbelMethod, points: usize) -> Result<Vec<Errors>, Breakdown> {
    let (domain, inner) = between_nodes(points);
    let exact = theory((1.0 - inner * inner) * theory(0.0).gross_slip_displacement());
    let setup = moved(method, points, domain, exact.amplitude);
    let mut simulation = Simulation::new(setup)?;
    simulation.advance_to(0.25)?;
    let seen = simulation.observe(Curves::SHEAR | Curves::SURFACE);
    let nodes = seen.radii().iter().copied();
    let shear = nodes.clone().zip(seen.shear());
    let shear = shear.map(|(r, &tau)| (r, tau, exact.shear_stress(r)));
    let slip = nodes.zip(seen.surface()).take_while(|(r, _)| *r <= 1.0);
    let slip = slip.map(|(r, surface)| (r, seen.moment.shift - surface, exact.slip(r)));
    // τ rises up to c and falls beyond; the slip rises up to a.
    let peak = exact.shear_stress(exact.stick_radius());
    Ok(vec![
        Errors::new(Some(peak), shear),
        Errors::new(Some(exact.slip(1.0)), slip),
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
pub fn limit(method: AbelMethod, points: usize) -> Result<Vec<Errors>, Breakdown> {
    let stick_radius = theory(AMPLITUDE).stick_radius();
    let exact = LimitingProfile {
        e_star: 1.0,
        radius: 1.0,
        depth: 1.0,
        stick_radius,
    };
    let mut setup = moved(method, points, DOMAIN, AMPLITUDE);
    setup.wear = Some(WearLaw::archard(WEAR).expect("a law"));
    (setup.spacing, setup.scheme) = choices(method);
    let mut simulation = Simulation::new(setup)?;
    simulation.advance_to(CYCLES)?;
    let seen = simulation.observe(Curves::PROFILE);
    let worn = seen.radii().iter().zip(seen.profile());
    let worn = worn.map(|(&r, &f)| (r, f, exact.profile(r)));
    let found = seen.moment.permanent_stick_radius.unwrap_or(f64::NAN);
    let mut profile = Errors::new(Some(1.0), worn);
    profile.over_radius = true;
    Ok(vec![
        profile,
        Errors::new(None, [(stick_radius, found, stick_radius)].into_iter()),
    ])
}

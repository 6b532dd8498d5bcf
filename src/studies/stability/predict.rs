//! Predicts the wear coefficient K from which a sawtooth grows.
//!
//! # Formula
//!
//! A sawtooth has three causes; the smallest K of the three is the predicted boundary.
//!
//! **Steps.** Errors grow over a cycle in which the amplifications of its steps, by the
//! [stiffness](crate::simulation::stability) z, multiply to more than 1. In an unworn contact that is so above some K.
//! As the contact wears, z rises: springs that carry no load slip all the way. A run at a small K, with the guard, goes
//! through the same shapes as one at a large K, at equal X = K × cycles. So each of its cycles gives the K(X) from
//! which errors grow over it, and the boundary of explicit Euler is the smallest of max{K(X), X/cycles}. A node counts
//! if a sawtooth that [counts](super::VISIBLE), of amplitude A, would stay in contact: where p > ρ E* A/h. For the
//! trapezoid only the unworn contact is used: a worn one tolerates up to twice K(X), perhaps because it slips in the
//! few steps after a reversal, and the first of these does not extrapolate.
//!
//! **Slip instabilities.** A spring that slips holds u = μq/G*, so wear by δ lets the surface slip by μE*δ/G* more (Eq.
//! (2) after Eq. (1) is the identity), and that wears G times as much as δ did:
//!
//! ```text
//! G = k μ² p E*/G*
//! ```
//!
//! If G exceeds 1 a spring slips all at once at any step size; the trapezoid, which extrapolates, overshoots. The
//! pressure on the slipping part rises as the ring around it wears: the boundary is the K at which G reaches 1 in the
//! first cycle, at X = K. Later, at smaller K, G only reaches 1 next to the border, and that node's peak is worn off by
//! the end of the cycle. Explicit Euler overshoots only beyond a G that depends on the cell; this is not predicted, and
//! with many short steps it comes first (400 per cycle: at 0.4 to 0.9 of the prediction).
//!
//! **Methods that are unstable at any step size.** For b and benad, a measured constant of the method, not derived.

use super::growth::growing_from;
use super::{StabilityStudy, VISIBLE, Variant};
use crate::math::scan::largest;
use crate::reading::{Curves, Zone};
use crate::scenario::session::{Session, SessionError};
use crate::simulation::{Scheme, Setup, Simulation};

/// Wear number at which the unworn contact is examined: small enough to preserve its shape.
const MILD: f64 = 1e-3;

/// The small K is the predicted limit of the unworn contact divided by this.
const SMALLER: f64 = 8.0;

/// Nodes that wear less than this, relative to the largest wear of a step, are ignored.
const LEAST: f64 = 1e-3;

/// Measurements of a cycle, scaled to K = 1.
#[derive(Default)]
struct PredictedCycle {
    /// Largest z of each step.
    stiffness: Vec<f64>,
    /// Largest G.
    gain: f64,
    /// Deepest wear, in largest depths.
    worn: f64,
}

impl PredictedCycle {
    /// Returns the K from which errors grow over the cycle.
    fn growing(&self, scheme: Scheme) -> f64 {
        growing_from(scheme, &self.stiffness).unwrap_or(f64::INFINITY)
    }
}

/// Predicts the wear number from which `setting` shows a sawtooth
/// within the cycles of the study; `None` if nothing slips.
pub(super) fn predict(
    study: &StabilityStudy,
    setting: Variant,
) -> Result<Option<f64>, SessionError> {
    let mut guarded = setting;
    guarded.guard = true;
    let mut mild = study.start(guarded, MILD)?;
    // The first cycle lets the springs settle.
    cycle(&mut mild, MILD, 0.0)?;
    let unworn = cycle(&mut mild, MILD, 0.0)?;
    if let Some(sawtooth) = setting.method.traits().sawtooth {
        let worn = unworn.worn * study.cycles;
        return Ok((worn > 0.0).then(|| sawtooth.from / worn));
    }
    let scheme = mild.simulation().setup().scheme;
    let boundary = unworn.growing(scheme);
    let small = boundary.min(unworn.gain.recip()) / SMALLER;
    if !small.is_finite() {
        return Ok(None);
    }
    let run = study.start(guarded, small)?;
    match scheme {
        Scheme::Euler => while_it_wears(run, small, boundary, study.cycles),
        Scheme::Trapezoid => letting_go(run, small, boundary),
    }
    .map(Some)
}

/// Returns the smallest K from which errors grow over a cycle of a `run` at the wear number `small`, at most
/// `boundary`.
fn while_it_wears(
    mut run: Session,
    small: f64,
    mut boundary: f64,
    cycles: f64,
) -> Result<f64, SessionError> {
    let scheme = run.simulation().setup().scheme;
    let mut worn = small;
    while worn < boundary * cycles {
        let now = cycle(&mut run, small, VISIBLE)?;
        boundary = boundary.min(now.growing(scheme).max(worn / cycles));
        worn += small;
    }
    Ok(boundary)
}

/// Returns the K at which springs slip all at once in the first cycle, found from a `run` at the wear number `small`;
/// at most `boundary`.
fn letting_go(mut run: Session, small: f64, boundary: f64) -> Result<f64, SessionError> {
    let (mut worn, mut before) = (0.0, 0.0);
    while worn < boundary {
        let now = (worn + small) * cycle(&mut run, small, 0.0)?.gain;
        if now > 1.0 {
            let share = (1.0 - before) / (now - before);
            return Ok(boundary.min(worn + small * share));
        }
        (worn, before) = (worn + small, now);
    }
    Ok(boundary)
}

/// Runs one cycle at `wear_number`; counts the nodes with enough pressure to keep a sawtooth of `height` (relative
/// to the largest depth) in contact.
fn cycle(
    session: &mut Session,
    wear_number: f64,
    height: f64,
) -> Result<PredictedCycle, SessionError> {
    let mut cycle = PredictedCycle::default();
    let before = session.simulation().worn_depth().to_vec();
    let mut last = session.simulation().pressure();
    let end = session.simulation().cycle().floor() + 1.0;
    let start = session.simulation().steps();
    session.advance_while(end, |session| {
        let simulation = session.simulation();
        if simulation.steps() > start {
            let pressure = simulation.pressure();
            let (stiffness, gain) = step(simulation, &last, &pressure, height);
            cycle.stiffness.push(stiffness / wear_number);
            cycle.gain = cycle.gain.max(gain / wear_number);
            last = pressure;
        }
        true
    })?;
    let wear = session.simulation().worn_depth();
    let deepest = wear.iter().zip(&before).map(|(now, was)| now - was);
    let deepest = deepest.fold(0.0, f64::max);
    cycle.worn = deepest / (wear_number * depth(session.simulation()));
    Ok(cycle)
}

/// Returns G for p = 1 Pa: a spring that slips holds u = μq/G*, so wear by δ lets the surface slip by μE*δ/G* more,
/// which wears G = kμ²pE*/G* times δ. `None` unless the law is in proportion to friction work.
fn gain(setup: &Setup) -> Option<f64> {
    let law = setup.wear.filter(|law| law.traits().linear_in_work)?;
    let (material, friction) = (&setup.material, setup.material.friction());
    let moduli = material.normal_modulus() / material.tangential_modulus();
    Some(law.coefficient() * friction * friction * moduli)
}

/// Returns the largest z and G of the last step, from the pressures before and after it.
fn step(simulation: &Simulation, before: &[f64], after: &[f64], height: f64) -> (f64, f64) {
    let setup = simulation.setup();
    let Some(law) = &setup.wear else {
        return (0.0, 0.0);
    };
    let scale = setup.method.traits().response * setup.material.normal_modulus();
    let share = gain(setup).unwrap_or_default();
    let amplitude = 0.5 * height * depth(simulation);
    let worn = simulation.last_wear();
    let zones = simulation.observe(Curves::ZONES).zones;
    let least = LEAST * largest(worn);
    let (mut stiffest, mut most) = (0.0_f64, 0.0_f64);
    let inner = setup.grid.cells();
    for (j, width) in setup.grid.widths().enumerate().take(inner).skip(1) {
        if zones[j] != Zone::Slip || worn[j] <= least {
            continue;
        }
        // The pressure with which the step wore.
        let pressure = match setup.scheme {
            Scheme::Euler => after[j],
            Scheme::Trapezoid => 0.5 * (before[j] + after[j]),
        };
        if pressure > scale * amplitude / width {
            stiffest =
                stiffest.max(scale * law.traits().stress_exponent * worn[j] / (pressure * width));
        }
        most = most.max(share * pressure);
    }
    (stiffest, most)
}

/// Returns the depth to which the height of a sawtooth is relative, m.
pub(super) fn depth(simulation: &Simulation) -> f64 {
    simulation.setup().depth_scale(simulation.moment().depth)
}

//! Evaluates the scenario at each point of the data.

use crate::math::grid::RadialGrid;
use crate::math::scan::largest;
use crate::reading::Curves;
use crate::scenario::Scenario;
use crate::scenario::session::{Session, SessionError};
use crate::studies::measured::{Kind, Measured, Strokes, rises};

/// The simulated value of every point, data set by data set, of a run of `cycles`.
///
/// # Errors
/// A contact that cannot be computed.
pub(super) fn simulate(
    scenario: &Scenario,
    data: &[Measured],
    cycles: f64,
) -> Result<Vec<Vec<f64>>, SessionError> {
    let mut session = Session::start(scenario.clone())?;
    let mut simulated: Vec<Vec<f64>> = data.iter().map(|set| vec![0.0; set.at.len()]).collect();
    // What is read off the run on its way: where it must stop, and what for.
    let mut moments: Vec<(f64, usize, usize)> = Vec::new();
    for (i, set) in data.iter().enumerate() {
        match set.kind {
            Kind::Volume | Kind::Depth => {
                moments.extend(set.at.iter().enumerate().map(|(j, cycle)| (*cycle, i, j)));
            }
            Kind::Loop => moments.push((set.cycle.unwrap_or(cycles) - 1.0, i, 0)),
            Kind::Wear | Kind::Profile => {}
        }
    }
    moments.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (cycle, i, j) in moments {
        session.advance_to(cycle)?;
        let set = &data[i];
        match set.kind {
            Kind::Loop => {
                let strokes = Strokes::new(&next_cycle(&session)?);
                let points = simulated[i].iter_mut().zip(&set.at).zip(rises(&set.at));
                for ((value, &displacement), rising) in points {
                    *value = strokes.force(displacement, rising);
                }
            }
            Kind::Depth => {
                simulated[i][j] = largest(&session.simulation().observe(Curves::PROFILE).wear);
            }
            _ => simulated[i][j] = session.simulation().moment().wear_volume,
        }
    }
    session.advance_to(cycles)?;
    let seen = session.simulation().observe(Curves::PROFILE);
    let setup = session.simulation().setup();
    for (set, simulated) in data.iter().zip(&mut simulated) {
        match set.kind {
            Kind::Wear | Kind::Profile => {
                for (value, &r) in simulated.iter_mut().zip(&set.at) {
                    *value = worn_at(&setup.grid, &seen.wear, r);
                    if set.kind == Kind::Profile {
                        *value += setup.indenter.profile(r);
                    }
                }
            }
            Kind::Loop | Kind::Volume | Kind::Depth => {}
        }
    }
    Ok(simulated)
}

/// The cycle that begins now, every step of it, in a copy of the run: where cycles are jumped over, the run goes on
/// with its jumps.
fn next_cycle(session: &Session) -> Result<Vec<(f64, f64)>, SessionError> {
    let mut session = session.clone();
    session.change("numerics.integrator", "direct")?;
    let end = session.simulation().cycle() + 1.0;
    let mut trace = Vec::new();
    session.advance_while(end, |session| {
        trace.push(point(session));
        true
    })?;
    Ok(trace)
}

/// The displacement that the rig measures, m, and the tangential force, N.
fn point(session: &Session) -> (f64, f64) {
    let moment = session.simulation().moment();
    let displacement = moment.rig_displacement.unwrap_or(moment.shift);
    (displacement, moment.tangential_force)
}

/// The worn depth at a radius, m; nothing wears outside of the grid.
fn worn_at(grid: &RadialGrid, wear: &[f64], r: f64) -> f64 {
    if r > grid.radius() {
        0.0
    } else {
        grid.interpolate(wear, r)
    }
}

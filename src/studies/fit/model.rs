//! Evaluates the scenario at each point of the data.

use crate::math::grid::RadialGrid;
use crate::math::scan::largest;
use crate::scenario::Scenario;
use crate::scenario::session::{Session, SessionError};
use crate::simulation::Curves;
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
    let has_loop = data.iter().any(|set| set.kind == Kind::Loop);
    let last_cycle = if has_loop { cycles - 1.0 } else { cycles };
    let mut moments: Vec<(f64, usize, usize)> = Vec::new();
    for (i, set) in data.iter().enumerate() {
        if matches!(set.kind, Kind::Volume | Kind::Depth) {
            moments.extend(set.at.iter().enumerate().map(|(j, cycle)| (*cycle, i, j)));
        }
    }
    moments.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut trace = Vec::new();
    let mut advance = |session: &mut Session, to: f64| -> Result<(), SessionError> {
        session.advance_to(to.min(last_cycle))?;
        if has_loop && to > last_cycle {
            if trace.is_empty() {
                // Every step of the loop is wanted.
                session.change("numerics.integrator", "direct")?;
                trace.push(point(session));
            }
            while session.simulation().cycle() < to {
                session.step_until(to)?;
                trace.push(point(session));
            }
        }
        Ok(())
    };
    for (cycle, i, j) in moments {
        advance(&mut session, cycle)?;
        simulated[i][j] = match data[i].kind {
            Kind::Depth => largest(&session.simulation().observe(Curves::PROFILE).wear),
            _ => session.simulation().moment().wear_volume,
        };
    }
    advance(&mut session, cycles)?;
    let strokes = Strokes::new(&trace);
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
            Kind::Loop => {
                let points = simulated.iter_mut().zip(&set.at).zip(rises(&set.at));
                for ((value, &displacement), rising) in points {
                    *value = strokes.force(displacement, rising);
                }
            }
            Kind::Volume | Kind::Depth => {}
        }
    }
    Ok(simulated)
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

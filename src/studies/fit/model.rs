//! Evaluates the scenario at each point of the data.

use crate::math::scan::largest;
use crate::scenario::Scenario;
use crate::scenario::session::{Session, SessionError};
use crate::studies::measured::{Measured, Strokes, rises};
use crate::traces::Axes;

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
        match set.axes {
            Axes::VOLUME | Axes::DEPTH => {
                moments.extend(set.at.iter().enumerate().map(|(j, cycle)| (*cycle, i, j)));
            }
            Axes::LOOP => moments.push((set.cycle.unwrap_or(cycles) - 1.0, i, 0)),
            _ => {}
        }
    }
    moments.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (cycle, i, j) in moments {
        session.advance_to(cycle)?;
        match data[i].axes {
            Axes::LOOP => {
                let Some(strokes) = Strokes::new(&next_cycle(&session)?) else {
                    continue;
                };
                let points = data[i].at.iter().zip(rises(&data[i].at));
                let forces = points.map(|(&shift, rising)| strokes.force(shift, rising));
                simulated[i] = forces.collect();
            }
            Axes::DEPTH => {
                simulated[i][j] = largest(session.simulation().worn_depth());
            }
            _ => simulated[i][j] = session.simulation().moment().wear_volume,
        }
    }
    session.advance_to(cycles)?;
    let worn = session.simulation().worn_depth();
    let setup = session.simulation().setup();
    for (set, simulated) in data.iter().zip(&mut simulated) {
        if set.axes.over_r() {
            let is_profile = set.axes == Axes::PROFILE;
            let at = |&r: &f64| match r > setup.grid.radius() {
                // Nothing wears outside of the grid.
                true => 0.0,
                false => setup.grid.interpolate(worn, r),
            };
            let unworn = |&r: &f64| {
                if is_profile {
                    setup.indenter.profile(r)
                } else {
                    0.0
                }
            };
            *simulated = set.at.iter().map(|r| at(r) + unworn(r)).collect();
        }
    }
    Ok(simulated)
}

/// The displacement that the rig measures, m, and the tangential force, N, of every step of the cycle that begins now,
/// in a copy of the run: where cycles are jumped over, the run goes on with its jumps.
fn next_cycle(session: &Session) -> Result<Vec<(f64, f64)>, SessionError> {
    let mut session = session.clone();
    session.change("numerics.integrator", "direct")?;
    let end = session.simulation().cycle() + 1.0;
    let mut trace = Vec::new();
    session.advance_while(end, |session| {
        let moment = session.simulation().moment();
        // What the rig measures.
        let displacement = moment.rig_displacement.unwrap_or(moment.shift);
        trace.push((displacement, moment.tangential_force));
        true
    })?;
    Ok(trace)
}

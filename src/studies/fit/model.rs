//! Evaluates the scenario at each point of the data.

use crate::math::scan::largest;
use crate::scenario::Scenario;
use crate::scenario::session::{Session, SessionError};
use crate::simulation::Simulation;
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
    // Where the run must stop, and for which points.
    let mut moments: Vec<(f64, usize, usize)> = Vec::new();
    for (i, set) in data.iter().enumerate() {
        let stops = match set.axes {
            Axes::LOOP => vec![set.cycle.unwrap_or(cycles) - 1.0],
            axes if axes.over_r() => vec![cycles],
            _ => set.at.clone(),
        };
        moments.extend(stops.iter().enumerate().map(|(j, cycle)| (*cycle, i, j)));
    }
    moments.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (cycle, i, j) in moments {
        session.advance_to(cycle)?;
        let (set, simulation) = (&data[i], session.simulation());
        match set.axes {
            Axes::DEPTH => simulated[i][j] = largest(simulation.worn_depth()),
            Axes::VOLUME => simulated[i][j] = simulation.moment().wear_volume,
            Axes::LOOP => {
                if let Some(strokes) = Strokes::new(&next_cycle(&session)?) {
                    let points = set.at.iter().zip(rises(&set.at));
                    let forces = points.map(|(&shift, rising)| strokes.force(shift, rising));
                    simulated[i] = forces.collect();
                }
            }
            axes => {
                let depth = |&r: &f64| scar(simulation, r, axes == Axes::PROFILE);
                simulated[i] = set.at.iter().map(depth).collect();
            }
        }
    }
    Ok(simulated)
}

/// What has worn at a radius, m, or the worn profile there, m.
fn scar(simulation: &Simulation, r: f64, is_profile: bool) -> f64 {
    let setup = simulation.setup();
    let unworn = is_profile.then(|| setup.indenter.profile(r));
    // Nothing wears outside of the grid.
    let is_inside = r <= setup.grid.radius();
    let worn = is_inside.then(|| setup.grid.interpolate(simulation.worn_depth(), r));
    unworn.unwrap_or(0.0) + worn.unwrap_or(0.0)
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

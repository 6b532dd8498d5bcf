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
            Axes::LOOP => vec![set.cycle.unwrap_or(cycles)],
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
                if let Some(strokes) = Strokes::new(&last_period(simulation)) {
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

/// The displacement that the rig measures, m, and the tangential force, N, through the last period; nothing without
/// tangential motion.
fn last_period(simulation: &Simulation) -> Vec<(f64, f64)> {
    let period = simulation.fine_period();
    let points = period.iter().flat_map(|period| &period.points);
    points
        .map(|point| (point.sensed, point.tangential_force))
        .collect()
}

//! The companion: the same run on half the cells, to see what the grid is worth.

use std::time::Instant;

use crate::math::grid::{MIN_CELLS, interpolate};
use crate::scenario::session::{Session, SessionError};
use crate::simulation::{Curves, Observation};

/// What the companion shows.
#[derive(Debug, Clone, PartialEq)]
pub struct Companion {
    /// Its cells.
    pub cells: usize,
    /// Up to which cycle both were run.
    pub cycle: f64,
    /// Root mean square and largest difference of f, in depths.
    pub profile: [f64; 2],
    /// Relative difference of the permanent stick radius, where there is one.
    pub stick_radius: Option<f64>,
    /// Relative difference of the worn volume, where anything has worn.
    pub wear_volume: Option<f64>,
    /// What it took, s.
    pub seconds: f64,
}

/// Runs the companion of a session from its start to where it stands.
pub fn run(session: &Session) -> Result<Companion, SessionError> {
    let start = Instant::now();
    let cells = (session.simulation().setup().grid.cells() / 2).max(MIN_CELLS);
    let scenario = session
        .loaded()
        .with("numerics.points", &cells.to_string())?;
    let mut companion = Session::start(scenario.with_changes(session.changes().to_vec()))?;
    companion.advance_to(session.simulation().cycle())?;
    let (fine, coarse) = (session.simulation(), companion.simulation());
    let (here, there) = (
        fine.observe(Curves::PROFILE),
        coarse.observe(Curves::PROFILE),
    );
    let differences = differences(&there, &here);
    let largest = differences
        .iter()
        .fold(0.0, |largest: f64, d| largest.max(d.abs()));
    let depth = here.moment.depth.abs().max(f64::MIN_POSITIVE);
    let sticks = here
        .moment
        .permanent_stick_radius
        .zip(there.moment.permanent_stick_radius);
    let volumes = (here.moment.wear_volume, there.moment.wear_volume);
    Ok(Companion {
        cells,
        cycle: fine.cycle(),
        profile: [rms(&differences) / depth, largest / depth],
        stick_radius: sticks
            .filter(|(here, _)| *here > 0.0)
            .map(|(here, there)| there / here - 1.0),
        wear_volume: (volumes.0 > 0.0).then(|| volumes.1 / volumes.0 - 1.0),
        seconds: start.elapsed().as_secs_f64(),
    })
}

/// The worn profile of `there` less that of `here`, m, at the nodes of `there`; between nodes linear
/// in r².
pub fn differences(there: &Observation, here: &Observation) -> Vec<f64> {
    let points = there.radii.iter().zip(&there.wear);
    points
        .map(|(&r, wear)| wear - interpolate(&here.radii, &here.wear, r))
        .collect()
}

/// Root mean square of differences; 0 of none.
pub fn rms(differences: &[f64]) -> f64 {
    let squares: f64 = differences.iter().map(|d| d * d).sum();
    (squares / differences.len().max(1) as f64).sqrt()
}

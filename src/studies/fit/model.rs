//! Evaluates the scenario at each point of the data.

use super::scar::WornDepth;
use anyhow::Result;

use super::coarse;
use crate::contact::indenter::Indenter;
use crate::math::scan::value_at;
use crate::reading::{Column, Recorder};
use crate::scenario::Scenario;
use crate::scenario::scalars::Reading;
use crate::scenario::session::{Session, SessionError};
use crate::simulation::Simulation;
use crate::simulation::drive::Drive;
use crate::studies::measured::{Measured, Strokes};
use crate::traces::Axes;

/// Prediction of a run for one data set, at arbitrary points.
#[derive(Debug, Clone)]
pub(super) enum Prediction {
    /// What has worn, and the unworn shape where the profile was measured.
    Scar(WornDepth, Option<Indenter>),
    /// One finely stepped cycle.
    Loop(Strokes),
    /// The value at each point of a history.
    History(Vec<f64>),
}

impl Prediction {
    /// Returns the simulated values of a data set whose abscissae are off by `shift`, and whose values by `level` and
    /// by `tilt` per unit of the abscissa.
    pub fn at(&self, set: &Measured, [level, shift, tilt]: [f64; 3]) -> Vec<f64> {
        let plain = |i: usize, x: f64| match self {
            Self::Scar(worn, unworn) => {
                let r = (x - shift).abs();
                unworn.as_ref().map_or(0.0, |unworn| unworn.profile(r)) + worn.at(r)
            }
            Self::Loop(strokes) => strokes.force(x - shift, set.rising[i]),
            Self::History(values) => values[i],
        };
        let points = set.at.iter().enumerate();
        points
            .map(|(i, &x)| plain(i, x) + level + tilt * x)
            .collect()
    }

    /// Returns the share of a scar's points where nothing has worn.
    pub fn unworn_share(&self, set: &Measured, shift: f64) -> f64 {
        let Self::Scar(worn, _) = self else {
            return 0.0;
        };
        let is_unworn = |x: &&f64| worn.is_unworn((**x - shift).abs());
        set.at.iter().filter(is_unworn).count() as f64 / set.at.len() as f64
    }
}

/// What a run records for histories over the friction work.
const OVER_ENERGY: [Column; 5] = [
    Column::Cycle,
    Column::Energy,
    Column::WearVolume,
    Column::ScarDepth,
    Column::Approach,
];

/// The response of a run of `cycles` to every data set, and the steps that it took.
///
/// # Errors
/// A contact that cannot be computed, or that `go_on` says no to the steps so far.
pub(super) fn simulate(
    scenario: &Scenario,
    data: &[Measured],
    cycles: f64,
    go_on: &dyn Fn(u64) -> bool,
) -> Result<(Vec<Prediction>, u64), SessionError> {
    let mut session = Session::start(scenario.clone())?;
    let start = session.simulation().moment().depth;
    let mut responses: Vec<Prediction> = Vec::new();
    // Where the run must stop, and for which points.
    let mut moments: Vec<(f64, usize, usize)> = Vec::new();
    for (i, set) in data.iter().enumerate() {
        let stops = match set.axes {
            Axes::LOOP => vec![set.cycle.unwrap_or(cycles)],
            axes if axes.over_r() || axes.x == Column::Energy => vec![cycles],
            axes => {
                let per_cycle = per_cycle(&session.simulation().setup().drive, axes.x);
                set.at.iter().map(|at| at / per_cycle).collect()
            }
        };
        moments.extend(stops.iter().enumerate().map(|(j, cycle)| (*cycle, i, j)));
        responses.push(Prediction::History(vec![0.0; set.at.len()]));
    }
    moments.sort_by(|a, b| a.0.total_cmp(&b.0));
    let is_over_energy = data.iter().any(|set| set.axes.x == Column::Energy);
    let mut course = Recorder::of_moments(OVER_ENERGY);
    let value = |session: &Session, column| match column {
        Column::Approach => session.simulation().moment().depth - start,
        Column::Energy => session.simulation().moment().dissipated_energy,
        column => Reading::new(session).number(column),
    };
    for (cycle, i, j) in moments {
        session.advance_while(cycle, |session| {
            if is_over_energy {
                course.record(|column| value(session, column));
            }
            go_on(session.simulation().steps())
        })?;
        let (set, simulation) = (&data[i], session.simulation());
        match (&mut responses[i], set.axes) {
            (response, Axes::LOOP) => {
                let strokes = Strokes::new(&last_period(simulation));
                *response = strokes.map_or_else(|| response.clone(), Prediction::Loop);
            }
            (response, axes) if axes.over_r() => {
                let setup = simulation.setup();
                let unworn = (axes == Axes::PROFILE).then(|| setup.indenter.clone());
                let worn = WornDepth::new(setup.grid.clone(), simulation.worn_depth().to_vec());
                *response = Prediction::Scar(worn, unworn);
            }
            (Prediction::History(values), axes) if axes.x == Column::Energy => {
                let course = course.table(&OVER_ENERGY);
                let column = |column| course.column(column).unwrap_or_default();
                let (energies, worn) = (column(axes.x), column(axes.y));
                let found = set
                    .at
                    .iter()
                    .map(|&energy| value_at(energies, worn, energy));
                *values = found.map(|value| value.unwrap_or(f64::NAN)).collect();
            }
            (Prediction::History(values), axes) => values[j] = value(&session, axes.y),
            _ => {}
        }
    }
    Ok((responses, session.simulation().steps()))
}

/// A cycle of the model as a rig would record it.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelCycle {
    /// The displacement at the sensor, m.
    pub displacements: Vec<f64>,
    /// F_x, N.
    pub forces: Vec<f64>,
    /// The mean of F_z, N.
    pub load: f64,
}

/// Runs a scenario, on the cells and steps of a fit, and returns the cycles that end at `ends`, which rise; none without
/// tangential motion.
///
/// # Errors
/// A contact that cannot be computed.
pub fn model_cycles(scenario: &Scenario, ends: &[f64]) -> Result<Vec<ModelCycle>> {
    let mut session = Session::start(coarse::of_figures(scenario)?)?;
    let mut cycles = Vec::new();
    for end in ends {
        session.advance_while(*end, |_| true)?;
        let Some(period) = session.simulation().fine_period() else {
            break;
        };
        let (displacements, forces) = last_period(session.simulation()).into_iter().unzip();
        let loads = period.points.iter().map(|point| point.normal_force);
        cycles.push(ModelCycle {
            displacements,
            forces,
            load: loads.sum::<f64>() / period.points.len() as f64,
        });
    }
    Ok(cycles)
}

/// What one cycle adds to an abscissa of histories.
pub(super) fn per_cycle(drive: &Drive, over: Column) -> f64 {
    match over {
        Column::Time => drive.period(),
        // The path of the actuator: four amplitudes.
        Column::Distance => drive
            .tangential()
            .map_or(f64::NAN, |control| 4.0 * control.oscillation().amplitude()),
        _ => 1.0,
    }
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

//! `loop.csv`: the fretting loop of the last period, computed with fine steps on the last profile.

use super::header;
use crate::reading::{Column, Recorder};
use crate::scenario::session::Session;
use crate::simulation::Simulation;

/// The columns, in order; the last one stays empty without a rig that yields.
pub const COLUMNS: [Column; 4] = [
    Column::Cycle,
    Column::Shift,
    Column::TangentialForce,
    Column::RigDisplacement,
];

/// Periods of up to this many cycles are written whole; of longer ones, only the last cycle.
const LONGEST: f64 = 20.0;

/// Records the moments of the last period. The record is empty without tangential motion.
pub fn record(simulation: &Simulation) -> Recorder {
    let mut moments = Recorder::of_moments(COLUMNS);
    let yields = simulation.setup().drive.rig_compliance() > 0.0;
    let Some(period) = simulation.fine_period() else {
        return moments;
    };
    let begin = if period.cycles > LONGEST {
        simulation.cycle() - 1.0
    } else {
        f64::NEG_INFINITY
    };
    for point in period.points.iter().filter(|point| point.cycle >= begin) {
        moments.record(|column| match column {
            Column::Cycle => point.cycle,
            Column::Shift => point.shift,
            Column::TangentialForce => point.tangential_force,
            _ if yields => point.sensed,
            _ => f64::NAN,
        });
    }
    moments
}

/// Returns the whole file for the present state of `session`; `None` without tangential motion.
pub fn file(session: &Session) -> Option<String> {
    let moments = record(session.simulation());
    (!moments.rows().is_empty()).then(|| header::file(session, &moments.table(&COLUMNS)))
}

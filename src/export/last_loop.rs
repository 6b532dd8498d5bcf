//! `loop.csv`: the fretting loop of the last period, computed with fine steps on the last profile.

use super::header::table;
use crate::math::number::exact;
use crate::reading::Column;
use crate::scenario::session::Session;
use crate::simulation::{PeriodPoint, Simulation};

/// The columns, in order; the last one stays empty without a rig that yields.
pub const COLUMNS: [Column; 4] = [
    Column::Cycle,
    Column::Shift,
    Column::TangentialForce,
    Column::RigDisplacement,
];

/// Periods of up to this many cycles are written whole; of longer ones, only the last cycle.
const LONGEST: f64 = 20.0;

/// Returns the moments of the last period: cycle, u_x⁽⁰⁾ (m), F_x (N), displacement of the rig's actuator (m; NaN on a
/// stiff rig). Returns no rows without tangential motion.
pub fn rows(simulation: &Simulation) -> Vec<[f64; 4]> {
    let yields = simulation.setup().drive.rig_compliance() > 0.0;
    let Some(period) = simulation.fine_period() else {
        return Vec::new();
    };
    let begin = if period.cycles > LONGEST {
        simulation.cycle() - 1.0
    } else {
        f64::NEG_INFINITY
    };
    let points = period.points.iter().filter(|point| point.cycle >= begin);
    let row = |point: &PeriodPoint| {
        let sensed = if yields { point.sensed } else { f64::NAN };
        [point.cycle, point.shift, point.tangential_force, sensed]
    };
    points.map(row).collect()
}

/// Returns the whole file for the present state of `session`; `None` without tangential motion.
pub fn file(session: &Session) -> Option<String> {
    let rows = rows(session.simulation());
    let fields = rows.iter().map(|row| row.map(exact));
    (!rows.is_empty()).then(|| table(session, &COLUMNS, fields))
}

//! `loop.csv`: the fretting loop of the last cycle.

use serde::{Deserialize, Serialize};

use super::header::{field, table};
use crate::reading::Moment;
use crate::scenario::session::Session;
use crate::simulation::Simulation;

/// The columns, in order; the last one stays empty without a rig that yields.
pub const COLUMNS: [&str; 4] = ["cycle", "u_x_m", "F_x_N", "rig_displacement_m"];

/// The steps of the last cycle: cycle, u_x⁽⁰⁾ (m), F_x (N), displacement of the rig's actuator (m, or NaN).
#[derive(Debug, Default, Clone, Serialize, Deserialize)]
pub struct LastLoop {
    rows: Vec<[f64; 4]>,
}

impl LastLoop {
    /// Adds the present moment, if it belongs to the cycle before `end`.
    pub fn record(&mut self, simulation: &Simulation, end: f64) {
        let now = simulation.cycle();
        if now < end - 1.0 - simulation.rounding() || simulation.setup().springs() == 0 {
            return;
        }
        // A run continued beyond an earlier end leaves steps behind.
        self.rows.retain(|row| row[0] < now && row[0] >= end - 1.5);
        self.rows.push(row(&simulation.moment()));
    }

    /// The steps of the cycle that ends now. Where cycles were jumped over, the steps of a cycle on the present
    /// profile, which is stepped through without wear for that purpose; none without tangential motion.
    pub fn rows(&self, simulation: &Simulation) -> Vec<[f64; 4]> {
        let end = simulation.cycle();
        let step = 1.5 / simulation.setup().steps_in_a_cycle();
        let begin = (end - 1.0).max(0.0);
        let cycles: Vec<f64> = self.rows.iter().map(|row| row[0]).collect();
        let cycles = [&[begin], &cycles[..], &[end]].concat();
        if cycles.windows(2).all(|pair| pair[1] - pair[0] < step) {
            return self.rows.clone();
        }
        stepped(simulation).unwrap_or_default()
    }

    /// The whole file for the present state of `session`; `None` without tangential motion.
    pub fn table(&self, session: &Session) -> Option<String> {
        let rows = self.rows(session.simulation());
        let fields = rows.iter().map(|row| row.map(field));
        (!rows.is_empty()).then(|| table(session, &COLUMNS, fields))
    }
}

/// The row of a moment.
pub fn row(moment: &Moment) -> [f64; 4] {
    let sensed = moment.rig_displacement.unwrap_or(f64::NAN);
    [moment.cycle, moment.shift, moment.tangential_force, sensed]
}

/// The next cycle without wear, as the one that ends now.
fn stepped(simulation: &Simulation) -> Option<Vec<[f64; 4]>> {
    if simulation.setup().springs() == 0 {
        return None;
    }
    let mut probe = simulation.without_wear()?;
    let end = probe.cycle() + 1.0;
    let mut rows = vec![row(&probe.moment())];
    while probe.cycle() < end {
        probe.step_until(end).ok()?;
        rows.push(row(&probe.moment()));
    }
    for row in &mut rows {
        row[0] -= 1.0;
    }
    Some(rows)
}

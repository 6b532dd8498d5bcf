//! `history.csv`: a row a recorded moment.

use serde::{Deserialize, Serialize};

use super::header::{lines, number, optional};
use crate::math::scan::largest;
use crate::scenario::session::Session;

/// The columns, in order.
pub const COLUMNS: [&str; 21] = [
    "cycle",
    "time_s",
    "u_z_m",
    "u_x_m",
    "F_z_N",
    "F_x_N",
    "contact_radius_m",
    "stick_radius_m",
    "permanent_stick_radius_m",
    "wear_volume_m3",
    "dissipated_energy_J",
    "energy_residual",
    "max_pressure_Pa",
    "period_energy_residual",
    "force_residual",
    "steps",
    "transforms",
    "evaluated_cycles",
    "rejected_jumps",
    "stability_margin",
    "parts",
];

/// The rows recorded so far, as text.
#[derive(Debug, Default, Clone, Serialize, Deserialize)]
pub struct History {
    rows: String,
    last_cycle: Option<f64>,
}

/// A place in a history to go back to.
#[derive(Debug, Clone, Copy)]
pub struct Mark {
    length: usize,
    last_cycle: Option<f64>,
}

impl History {
    /// Whether nothing is recorded yet.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// How much is recorded.
    pub fn mark(&self) -> Mark {
        Mark {
            length: self.rows.len(),
            last_cycle: self.last_cycle,
        }
    }

    /// Forgets what was recorded after `mark`.
    pub fn rewind(&mut self, mark: Mark) {
        self.rows.truncate(mark.length);
        self.last_cycle = mark.last_cycle;
    }

    /// Adds the present moment of `session`, once.
    pub fn record(&mut self, session: &Session) {
        let simulation = session.simulation();
        if self.last_cycle == Some(simulation.cycle()) {
            return;
        }
        self.last_cycle = Some(simulation.cycle());
        self.rows.push_str(&row(session));
        self.rows.push('\n');
    }

    /// The whole file up to the present state of `session`, of which its header tells.
    pub fn table(&self, session: &Session) -> String {
        let mut table = format!("{}{}\n{}", lines(session), COLUMNS.join(","), self.rows);
        if self.last_cycle != Some(session.simulation().cycle()) {
            table.push_str(&row(session));
            table.push('\n');
        }
        table
    }
}

fn row(session: &Session) -> String {
    let simulation = session.simulation();
    let (moment, state) = (simulation.moment(), simulation.state());
    let pressure = simulation.pressure();
    [
        number(moment.cycle),
        number(moment.time),
        number(moment.depth),
        number(moment.shift),
        number(moment.normal_force),
        number(moment.tangential_force),
        number(moment.contact_radius),
        optional(moment.stick_radius),
        optional(moment.permanent_stick_radius),
        number(moment.wear_volume),
        number(moment.dissipated_energy),
        optional(moment.energy_residual),
        number(largest(&pressure)),
        optional(moment.period_residual),
        optional(simulation.force_residual(&pressure)),
        state.steps.to_string(),
        state.effort.transforms.to_string(),
        state.effort.evaluated_cycles.to_string(),
        state.effort.rejected_jumps.to_string(),
        optional(moment.stability_margin),
        state.effort.parts.to_string(),
    ]
    .join(",")
}

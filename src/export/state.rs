//! `state.csv`: a row a node of one moment.

use super::header::{lines, number};
use crate::scenario::session::Session;
use crate::simulation::{Curves, Observation};

/// The columns, in order.
pub const COLUMNS: [&str; 13] = [
    "r_m",
    "f0_m",
    "f_m",
    "g_m",
    "u_z_1d_m",
    "q_z_N_per_m",
    "q_x_N_per_m",
    "p_Pa",
    "tau_Pa",
    "u_x_1d_m",
    "u_x_m",
    "wear_m",
    "zone",
];

/// The whole file for the present state of `session`.
pub fn table(session: &Session) -> String {
    let observation = session.simulation().observe(Curves::all());
    let mut text = lines(session);
    text.push_str(&COLUMNS.join(","));
    text.push('\n');
    for j in 0..observation.radii.len() {
        text.push_str(&row(&observation, j));
        text.push('\n');
    }
    text
}

fn row(seen: &Observation, j: usize) -> String {
    let values = [
        seen.radii[j],
        seen.unworn[j],
        seen.profile[j],
        seen.profile_1d[j],
        // The compression of the springs: d − g in contact, 0 elsewhere.
        (seen.moment.depth - seen.profile_1d[j]).max(0.0),
        seen.normal_load[j],
        seen.tangential_load[j],
        seen.pressure[j],
        seen.shear[j],
        seen.spring[j],
        seen.surface[j],
        seen.wear[j],
    ];
    let mut fields: Vec<String> = values.into_iter().map(number).collect();
    fields.push(seen.zones[j].name().into());
    fields.join(",")
}

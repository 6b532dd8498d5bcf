//! `state.csv`: one row per node, at one moment.

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

/// The columns that follow where the scenario shares the wear between both bodies.
pub const COLUMNS_OF_BODIES: [&str; 2] = ["wear_indenter_m", "wear_half_space_m"];

/// The whole file for the present state of `session`.
pub fn table(session: &Session) -> String {
    let observation = session.simulation().observe(Curves::all());
    let share = session.scenario().wear_share();
    let mut text = lines(session);
    text.push_str(&COLUMNS.join(","));
    if share.is_some() {
        text.push(',');
        text.push_str(&COLUMNS_OF_BODIES.join(","));
    }
    text.push('\n');
    for j in 0..observation.radii.len() {
        text.push_str(&row(&observation, j));
        if let Some(share) = share {
            for depth in observation.wear_of_bodies(share, j) {
                text.push(',');
                text.push_str(&number(depth));
            }
        }
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

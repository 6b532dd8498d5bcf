//! `state.csv`: one row per node, at one moment.

use super::header::{self, number};
use crate::reading::{Curves, Observation};
use crate::scenario::session::Session;

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
    let seen = session.simulation().observe(Curves::all());
    let (numbers, share) = (columns(&seen), session.scenario().wear_share());
    let of_bodies = share.iter().flat_map(|_| COLUMNS_OF_BODIES);
    let names: Vec<&str> = COLUMNS.into_iter().chain(of_bodies).collect();
    let rows = seen.zones.iter().enumerate().map(|(j, zone)| {
        let fields = numbers.iter().map(|(_, values)| number(values[j]));
        let of_bodies = share
            .iter()
            .flat_map(|&share| seen.wear_of_bodies(share, j));
        let fields = fields.chain([zone.name().to_owned()]);
        fields.chain(of_bodies.map(number)).collect::<Vec<_>>()
    });
    header::table(session, &names, rows)
}

/// The columns of numbers with their names, in the order of the file, as far as they were asked for.
pub fn columns(seen: &Observation) -> Vec<(&'static str, Vec<f64>)> {
    // The compression of the springs: d − g in contact, 0 elsewhere.
    let pressed = |g: &f64| (seen.moment.depth - g).max(0.0);
    let values = [
        seen.radii.to_vec(),
        seen.unworn.to_vec(),
        seen.profile.clone(),
        seen.profile_1d.clone(),
        seen.profile_1d.iter().map(pressed).collect(),
        seen.normal_load.clone(),
        seen.tangential_load.clone(),
        seen.pressure.clone(),
        seen.shear.clone(),
        seen.spring.clone(),
        seen.surface.clone(),
        seen.wear.clone(),
    ];
    let named = COLUMNS.into_iter().zip(values);
    named.filter(|(_, values)| !values.is_empty()).collect()
}

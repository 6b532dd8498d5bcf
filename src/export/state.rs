//! `state.csv`: one row per node, at one moment.

use super::header::{self, number};
use crate::reading::{Curves, Observation};
use crate::scenario::session::Session;

/// The columns that follow where the scenario shares the wear between both bodies.
const COLUMNS_OF_BODIES: [&str; 2] = ["wear_indenter_m", "wear_half_space_m"];

/// Returns the whole file for the present state of `session`.
pub fn table(session: &Session) -> String {
    let seen = session.simulation().observe(Curves::all());
    let (numbers, share) = (columns(&seen), session.scenario().wear_share());
    let of_bodies = share.iter().flat_map(|_| COLUMNS_OF_BODIES);
    let names = numbers.iter().map(|(name, _)| *name).chain(["zone"]);
    let names: Vec<&str> = names.chain(of_bodies).collect();
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
    let mut columns = vec![
        ("r_m", seen.radii.to_vec()),
        ("f0_m", seen.unworn.to_vec()),
        ("f_m", seen.profile.clone()),
        ("g_m", seen.profile_1d.clone()),
        ("u_z_1d_m", seen.profile_1d.iter().map(pressed).collect()),
        ("q_z_N_per_m", seen.normal_load.clone()),
        ("q_x_N_per_m", seen.tangential_load.clone()),
        ("p_Pa", seen.pressure.clone()),
        ("tau_Pa", seen.shear.clone()),
        ("u_x_1d_m", seen.spring.clone()),
        ("u_x_m", seen.surface.clone()),
        ("wear_m", seen.wear.clone()),
    ];
    columns.retain(|(_, values)| !values.is_empty());
    columns
}

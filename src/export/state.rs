//! `state.csv`: one row per node, at one moment.

use super::header;
use crate::reading::{Column, Curves, Table};
use crate::scenario::session::Session;

/// Returns the whole file for the present state of `session`.
pub fn table(session: &Session) -> String {
    let seen = session.simulation().observe(Curves::all());
    let zones = seen.zones.iter().map(|zone| f64::from(*zone as u8));
    let mut table = Table::clone(&seen.columns).with(Column::Zone, zones.collect());
    if let Some(share) = session.scenario().wear_share() {
        let of_bodies = (0..table.rows()).map(|node| seen.wear_of_bodies(share, node).into());
        let (indenter, half_space) = of_bodies.collect::<Vec<(f64, f64)>>().into_iter().unzip();
        table = table
            .with(Column::WearIndenter, indenter)
            .with(Column::WearHalfSpace, half_space);
    }
    header::file(session, &table)
}

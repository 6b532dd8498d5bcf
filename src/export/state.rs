//! `state.csv`: one row per node, at one moment.

use super::header;
use crate::math::number::exact;
use crate::reading::{Column, Curves};
use crate::scenario::session::Session;

/// The columns that follow where the scenario shares the wear between both bodies.
const COLUMNS_OF_BODIES: [Column; 2] = [Column::WearIndenter, Column::WearHalfSpace];

/// Returns the whole file for the present state of `session`.
pub fn table(session: &Session) -> String {
    let seen = session.simulation().observe(Curves::all());
    let share = session.scenario().wear_share();
    let of_bodies = share.iter().flat_map(|_| COLUMNS_OF_BODIES);
    let names = seen
        .columns
        .columns()
        .map(|(column, _)| column)
        .chain([Column::Zone]);
    let names: Vec<Column> = names.chain(of_bodies).collect();
    let rows = seen.zones.iter().enumerate().map(|(j, zone)| {
        let fields = seen.columns.columns().map(|(_, values)| exact(values[j]));
        let of_bodies = share
            .iter()
            .flat_map(|&share| seen.wear_of_bodies(share, j));
        let fields = fields.chain([zone.name().to_owned()]);
        fields.chain(of_bodies.map(exact)).collect::<Vec<_>>()
    });
    header::table(session, &names, rows)
}

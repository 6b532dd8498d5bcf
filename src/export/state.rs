//! `state.csv`: one row per node, at one moment.

use super::header::{self, number};
use crate::reading::{Column, Curves, Observation};
use crate::scenario::session::Session;

/// The columns that follow where the scenario shares the wear between both bodies.
const COLUMNS_OF_BODIES: [Column; 2] = [Column::WearIndenter, Column::WearHalfSpace];

/// Returns the whole file for the present state of `session`.
pub fn table(session: &Session) -> String {
    let seen = session.simulation().observe(Curves::all());
    let (numbers, share) = (columns(&seen), session.scenario().wear_share());
    let of_bodies = share.iter().flat_map(|_| COLUMNS_OF_BODIES);
    let names = numbers.iter().map(|(name, _)| *name).chain([Column::Zone]);
    let names: Vec<Column> = names.chain(of_bodies).collect();
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
pub fn columns(seen: &Observation) -> Vec<(Column, Vec<f64>)> {
    // The compression of the springs: d − g in contact, 0 elsewhere.
    let pressed = |g: &f64| (seen.moment.depth - g).max(0.0);
    let mut columns = vec![
        (Column::Radius, seen.radii.to_vec()),
        (Column::Unworn, seen.unworn.to_vec()),
        (Column::Profile, seen.profile.clone()),
        (Column::Profile1d, seen.profile_1d.clone()),
        (
            Column::Compression,
            seen.profile_1d.iter().map(pressed).collect(),
        ),
        (Column::NormalLoad, seen.normal_load.clone()),
        (Column::TangentialLoad, seen.tangential_load.clone()),
        (Column::Pressure, seen.pressure.clone()),
        (Column::Shear, seen.shear.clone()),
        (Column::SpringShift, seen.spring.clone()),
        (Column::Shift, seen.surface.clone()),
        (Column::Wear, seen.wear.clone()),
    ];
    columns.retain(|(_, values)| !values.is_empty());
    columns
}

//! `field.csv`: the stresses inside the half-space in the plane of motion y = 0, and the fatigue parameters of a
//! steady-state cycle, one row per point.

use super::header;
use crate::reading::fatigue::{Fatigue, StressCycle};
use crate::reading::{Column, Curves, Table};
use crate::scenario::session::Session;

/// The columns, in order.
pub const COLUMNS: [Column; 11] = [
    Column::X,
    Column::Z,
    Column::StressXx,
    Column::StressYy,
    Column::StressZz,
    Column::StressXz,
    Column::VonMises,
    Column::MaxPrincipal,
    Column::Swt,
    Column::ShearAmplitude,
    Column::MaxHydrostatic,
];

/// Number of intervals in half the width, and in depth.
const HALF_WIDTH: i32 = 100;
const DEPTH: i32 = 100;

/// Extent of the plane to either side and downwards, in contact radii.
const REACH: f64 = 1.5;

/// Returns the whole file for the present state of `session`.
pub fn file(session: &Session) -> String {
    header::file(session, &table(session))
}

/// Returns the stresses and fatigue parameters, from the surface down, in each x from −1.5 a to 1.5 a; the parameters are
/// NaN if the motion has no steady-state cycle. Without contact the domain's radius replaces a, and all stresses are zero.
pub fn table(session: &Session) -> Table {
    let simulation = session.simulation();
    let seen = simulation.observe(Curves::SPRINGS);
    let load = seen.spring_load(simulation.setup().material.poisson());
    let radius = match seen.moment.contact_radius {
        contact if contact > 0.0 => contact,
        _ => seen.radii().last().copied().unwrap_or_default(),
    };
    let cycle = StressCycle::simulate(simulation);
    let step = REACH * radius / f64::from(HALF_WIDTH);
    let mut rows: Vec<Vec<f64>> = Vec::new();
    for k in 0..=DEPTH {
        let z = REACH * radius * f64::from(k) / f64::from(DEPTH);
        let radii = (0..=HALF_WIDTH).map(|i| step * f64::from(i));
        let both_sides = radii.map(|r| {
            let fatigue = cycle.as_ref().map(|cycle| cycle.mirrored(r, z));
            (load.mirrored(r, z), fatigue)
        });
        let both_sides: Vec<_> = both_sides.collect();
        rows.extend((-HALF_WIDTH..=HALF_WIDTH).map(|i| {
            let (x, side) = (step * f64::from(i), usize::from(i < 0));
            let (at, fatigue) = both_sides[i.unsigned_abs() as usize];
            let (at, fatigue) = (at[side], fatigue.map(|both| both[side]));
            let invariants = [at.von_mises(), at.max_principal()];
            let fatigue = fatigue.map_or([f64::NAN; 3], |fatigue: Fatigue| {
                [fatigue.swt, fatigue.shear_amplitude, fatigue.hydrostatic]
            });
            [
                &[x, z, at.xx, at.yy, at.zz, at.xz][..],
                &invariants,
                &fatigue,
            ]
            .concat()
        }));
    }
    let columns = COLUMNS.into_iter().enumerate();
    let columns = columns.map(|(k, column)| (column, rows.iter().map(|row| row[k]).collect()));
    Table::of_columns(Vec::new(), columns)
}

//! `field.csv`: the stresses inside the half-space in the plane of motion y = 0, and the fatigue parameters
//! of a steady cycle, one row per point.

use super::header;
use crate::reading::Curves;
use crate::reading::fatigue::{Fatigue, StressCycle};
use crate::scenario::scalars::field;
use crate::scenario::session::Session;

/// The columns, in order.
pub const COLUMNS: [&str; 11] = [
    "x_m",
    "z_m",
    "sigma_xx_Pa",
    "sigma_yy_Pa",
    "sigma_zz_Pa",
    "sigma_xz_Pa",
    "von_mises_Pa",
    "max_principal_Pa",
    "swt_Pa",
    "shear_amplitude_Pa",
    "max_hydrostatic_Pa",
];

/// Half the intervals along x, and the intervals in depth.
const HALF_WIDTH: usize = 100;
const DEPTH: usize = 100;

/// How far the plane reaches to either side and downwards, in contact radii.
const REACH: f64 = 1.5;

/// The whole file for the present state of `session`: depth by depth from the surface down, x from
/// −1.5 a to 1.5 a. Without contact the domain takes the place of a, and all stresses are zero.
pub fn table(session: &Session) -> String {
    let rows = rows(session).into_iter();
    let fields = rows.map(|row| row.into_iter().map(field).collect::<Vec<_>>());
    header::table(session, &COLUMNS, fields)
}

/// The rows of the file; the fatigue parameters are NaN where the motion has no steady cycle.
pub fn rows(session: &Session) -> Vec<Vec<f64>> {
    let simulation = session.simulation();
    let seen = simulation.observe(Curves::SPRINGS);
    let load = seen.spring_load(simulation.setup().material.poisson());
    let radius = match seen.moment.contact_radius {
        contact if contact > 0.0 => contact,
        _ => seen.radii.last().copied().unwrap_or_default(),
    };
    let cycle = StressCycle::of(simulation);
    let step = REACH * radius / HALF_WIDTH as f64;
    let mut rows = Vec::new();
    for k in 0..=DEPTH {
        let z = REACH * radius * k as f64 / DEPTH as f64;
        let at = |i: usize| {
            let r = step * i as f64;
            (
                load.mirrored(r, z),
                cycle.as_ref().map(|cycle| cycle.mirrored(r, z)),
            )
        };
        let row: Vec<_> = (0..=HALF_WIDTH).map(at).collect();
        let left = (1..=HALF_WIDTH).rev().map(|i| (-step * i as f64, i, 1));
        let right = (0..=HALF_WIDTH).map(|i| (step * i as f64, i, 0));
        rows.extend(left.chain(right).map(|(x, i, side)| {
            let (at, fatigue) = (row[i].0[side], row[i].1.map(|both| both[side]));
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
    rows
}

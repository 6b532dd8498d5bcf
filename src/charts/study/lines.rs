//! Lines over the map of a study: borders in closed form, criteria from the literature, and where the computed running
//! condition changes.

use super::slice::Slice;
use crate::plot::Curve;
use crate::plot::theme::Role;
use crate::reading::Column;
use crate::studies::sweep::StudyAxis;
use crate::studies::sweep::border::{crossing, to_gross_slip, to_lift_off};

/// The field's criteria: column, value, and name with what it holds for.
const CRITERIA: [(Column, f64, &str); 5] = [
    (
        Column::EnergyRatio,
        0.2,
        "A = 0.2 (unworn sphere, stiff rig only)",
    ),
    (
        Column::SlidingRatio,
        0.26,
        "D = 0.26 (unworn sphere, stiff rig only)",
    ),
    (Column::EnergyRatioB, 0.77, "B = 0.77 (sphere, any rig)"),
    (Column::SwtRatio, 1.0, "SWT at the fatigue limit"),
    (
        Column::CrosslandRatio,
        1.0,
        "Crossland at the fatigue limit",
    ),
];

/// Interrupts a line.
const GAP: [f64; 2] = [f64::NAN; 2];

/// The number of roles that borders in closed form take, and the role of the computed one behind them.
const CHANGES: usize = 2;

/// Returns the borders in closed form.
pub fn borders(slice: &Slice) -> Vec<Curve> {
    let Some(y) = slice.y else {
        return Vec::new();
    };
    let [wide, high] = slice.size();
    let lines = [
        (
            "gross slip, closed form, unworn",
            to_gross_slip as fn(&_) -> _,
        ),
        ("lift-off, closed form, unworn", to_lift_off),
    ];
    let lines = lines.into_iter().map(|(name, to_border)| {
        // Crosses the border along one axis, with the other one at a place.
        let crossed = |along: usize, other: usize, place: usize| {
            let mut places = slice.at.clone();
            places[other] = place;
            let study = &slice.results.study;
            let value = crossing(to_border, study, &places, along)?;
            study.axes[along].place_of(value)
        };
        let columns = (0..wide).filter_map(|at| Some([at as f64, crossed(y, slice.x, at)?]));
        let rows = (0..high).filter_map(|at| Some([crossed(slice.x, y, at)?, at as f64]));
        (name, columns.chain(rows).collect())
    });
    joined(slice, lines, 0)
}

/// Returns the published criteria whose columns the study has, between neighbouring points of the map.
pub fn criteria(slice: &Slice) -> Vec<Curve> {
    let [wide, high] = slice.size();
    let lines = CRITERIA.map(|(column, value, name)| {
        let off = |[x, y]: [usize; 2]| {
            let point = (x < wide && y < high).then(|| slice.point_at([x, y]));
            Some(slice.results.number(point?, column)? - value)
        };
        let crossed = slice.places().flat_map(|[x, y]| {
            let part = |there: [usize; 2]| {
                let (here, there) = (off([x, y])?, off(there)?);
                (here * there < 0.0).then(|| here / (here - there))
            };
            let [column, row] = [x as f64, y as f64];
            let up = part([x, y + 1]).map(|part| [column, row + part]);
            let right = part([x + 1, y]).map(|part| [column + part, row]);
            [up, right].into_iter().flatten()
        });
        (name, crossed.collect())
    });
    joined(slice, lines, CHANGES + 1)
}

/// Joins the crossings of each line with columns and rows of the map, from left to right, with gaps at columns that it
/// does not cross. A crossing is a place on both axes: 1.5 lies halfway between the second and the third value.
fn joined(
    slice: &Slice,
    lines: impl IntoIterator<Item = (&'static str, Vec<[f64; 2]>)>,
    role: usize,
) -> Vec<Curve> {
    let Some(up) = slice.y() else {
        return Vec::new();
    };
    let lines = lines.into_iter().filter_map(|(name, mut at)| {
        at.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        let parts = at.chunk_by(|from, to| to[0] - from[0] <= 1.0);
        let parts = parts.filter(|part| part.len() > 1);
        let spots = parts.flat_map(|part| std::iter::once(&GAP).chain(part));
        let spots = spots.skip(1);
        // The value of a word is its index.
        let value = |axis: &StudyAxis, place: f64| axis.value_at(place).unwrap_or(place);
        let spots = spots.map(|&[x, y]| (value(slice.x(), x), value(up, y)));
        let (xs, ys): (Vec<f64>, Vec<f64>) = spots.unzip();
        (!xs.is_empty()).then_some((name, xs, ys))
    });
    let lines = lines.enumerate();
    lines
        .map(|(k, (name, xs, ys))| Curve::new(name, xs, ys, Role::Border(role + k)))
        .collect()
}

/// Returns the edges of a map's cells between points of different running conditions; `edges` are its column and
/// row edges.
pub fn changes(slice: &Slice, [across, up]: [&[f64]; 2]) -> Option<Curve> {
    let [wide, high] = slice.size();
    let regime = |x: usize, y: usize| slice.results.regime(slice.point_at([x, y]));
    let differ = |a, b| Option::zip(a, b).is_some_and(|(a, b)| a != b);
    let mut border = Vec::new();
    for [x, y] in slice.places() {
        let (here, corner) = (regime(x, y), [across[x + 1], up[y + 1]]);
        if x + 1 < wide && differ(here, regime(x + 1, y)) {
            border.extend([[across[x + 1], up[y]], corner, GAP]);
        }
        if y + 1 < high && differ(here, regime(x, y + 1)) {
            border.extend([[across[x], up[y + 1]], corner, GAP]);
        }
    }
    let (xs, ys): (Vec<f64>, Vec<f64>) = border.into_iter().map(|[x, y]| (x, y)).unzip();
    let name = "running condition changes";
    (!xs.is_empty()).then(|| Curve::new(name, xs, ys, Role::Border(CHANGES)))
}

//! The chart of a study, on a screen and on paper: a column over one axis as a curve or points, or over two as a map.

use crate::math::scan::range;
use crate::plot::colormap::ColorMap;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve, Map, Mark, Scale};
use crate::reading::{Column, Regime};
use crate::studies::sweep::{Design, StudyAxis};

pub mod lines;
mod slice;

pub use slice::Slice;

/// Positive values with at least this ratio of largest to smallest get a logarithmic scale.
const DECADES: f64 = 100.0;

/// Free space next to curves with symbols, relative to the data's extent.
const MARGIN: f64 = 0.04;

/// The column of the words.
pub const REGIME: Column = Column::Regime;

/// Quantities whose estimated error studies can record, and the column that holds it, relative to the quantity.
const ERRORS: [(Column, Column); 5] = [
    (Column::ScarDepth, Column::DeepestError),
    (Column::WearVolume, Column::VolumeError),
    (Column::DissipatedEnergy, Column::EnergyError),
    (Column::EnergyPerCycle, Column::LoopError),
    (Column::ContactRadius, Column::ContactRadiusError),
];

/// Makes the chart of a column; over a map lie the `borders` in closed form, the criteria and the changes of the running
/// condition, or no lines without `borders`.
pub fn chart(slice: &Slice, column: Column, borders: Option<&[Curve]>) -> Chart {
    match slice.y() {
        Some(upwards) => map(slice, upwards, column, borders),
        None => points(slice, column),
    }
}

/// Returns an axis of a study with its title and unit.
pub fn titled_axis(slice: &Slice, axis: &StudyAxis) -> Axis {
    let unit = slice.results.study.unit(axis);
    let mut label = match (axis.key.path, unit) {
        ("motion.normal.mean", "N") => "mean normal force F_z".to_owned(),
        ("motion.normal.mean", _) => "mean depth d".to_owned(),
        (key, _) => axis.key.label.unwrap_or(key).to_owned(),
    };
    if (0..axis.count()).any(|place| axis.number(place).is_none()) {
        let words = (0..axis.count()).map(|place| format!("{place}: {}", axis.text(place)));
        label = format!("{label}, {}", words.collect::<Vec<_>>().join(", "));
    }
    Axis::new(label, unit).scale(axis.spread)
}

/// A column of a study in words, with its unit; logarithmic where its `values` span decades.
pub fn quantity(column: Column, values: &[f64]) -> Axis {
    let shown = values.iter().copied().filter(|value| value.is_finite());
    Axis::new(column.meaning(), column.unit()).scale(match range(shown) {
        Some([low, high]) if low > 0.0 && high / low >= DECADES => Scale::Log,
        _ => Scale::Linear,
    })
}

/// Returns the positions of an axis' values: the numbers themselves, or the indices of words.
fn places(axis: &StudyAxis) -> Vec<f64> {
    let all = 0..axis.count();
    all.map(|place| axis.number(place).unwrap_or(place as f64))
        .collect()
}

/// The values of a column at points; regimes count as the numbers of their words.
fn values(slice: &Slice, column: Column, points: impl Iterator<Item = usize>) -> Vec<f64> {
    let value = |point| match column {
        REGIME => slice
            .results
            .regime(point)
            .map(|regime| f64::from(regime as u8)),
        _ => slice.results.number(point, column),
    };
    points
        .map(|point| value(point).unwrap_or(f64::NAN))
        .collect()
}

/// Makes a chart of a column as colours over two axes, below lines.
fn map(slice: &Slice, upwards: &StudyAxis, column: Column, borders: Option<&[Curve]>) -> Chart {
    let gridded = |axis: &StudyAxis| {
        let (shown, places) = (titled_axis(slice, axis), places(axis));
        let edges = shown.edges(&places);
        let [first, last] = [edges[0], edges[edges.len() - 1]];
        let bounds = [first.min(last), first.max(last)];
        (shown.bounds(bounds), places, edges)
    };
    let [(x, xs, across), (y, ys, up)] = [slice.x(), upwards].map(gridded);
    let values = values(slice, column, slice.points());
    let is_regime = column == REGIME;
    let title = if is_regime { "running condition" } else { "" };
    let mut chart = Chart::new(title, x, y);
    chart.map = Some(Map {
        quantity: quantity(column, if is_regime { &[] } else { &values }),
        values,
        colors: ColorMap::Sequential,
        words: if is_regime {
            Regime::ALL.map(Regime::title).to_vec()
        } else {
            Vec::new()
        },
        places: [xs, ys],
    });
    if let Some(borders) = borders {
        let changes = (!is_regime).then(|| lines::changes(slice, [&across, &up]));
        chart.curves.extend(changes.flatten());
        chart.curves.extend_from_slice(borders);
        chart.curves.extend(lines::criteria(slice));
    }
    chart
}

/// Plots a column over the first axis: one symbol per point, with error bars if the study has recorded them. Joins the
/// points of a grid, and those that are in order along the axis.
fn points(slice: &Slice, column: Column) -> Chart {
    let places = places(slice.x());
    let is_sorted = places.is_sorted() || places.iter().rev().is_sorted();
    let is_joined = slice.results.study.design == Design::Grid || is_sorted;
    let mut order: Vec<usize> = (0..places.len()).collect();
    if is_joined {
        order.sort_by(|&a, &b| places[a].total_cmp(&places[b]));
    }
    let shown = || order.iter().map(|&x| slice.point_at([x, 0]));
    let ys = values(slice, column, shown());
    let of_column = ERRORS.iter().find(|(of, _)| *of == column);
    let errors = of_column.map(|(_, error)| values(slice, *error, shown()));
    let errors = errors.filter(|errors| errors.iter().any(|error| error.is_finite()));
    let bars = errors.map(|errors| {
        let both = ys.iter().zip(&errors);
        both.map(|(y, error)| (y * error).abs()).collect()
    });
    let x = titled_axis(slice, slice.x());
    let mut chart = Chart::new("", x, quantity(column, &ys));
    chart.margin = MARGIN;
    let xs: Vec<f64> = order.iter().map(|&x| places[x]).collect();
    let curve = Curve::new("", xs, ys, Role::Profile);
    let mut curve = curve.scattered(bars.unwrap_or_else(Vec::new));
    curve.has_line = is_joined;
    chart.curves.push(curve);
    if is_joined {
        let edges = chart.x.edges(&places);
        let regime = |x: usize| slice.results.regime(slice.point_at([x, 0]));
        for (x, &edge) in edges.iter().enumerate().take(places.len()).skip(1) {
            if let (Some(before), Some(after)) = (regime(x - 1), regime(x))
                && before != after
            {
                chart.marks.push(Mark {
                    x: edge,
                    label: after.title(),
                    role: Role::Quiet,
                });
            }
        }
    }
    chart
}

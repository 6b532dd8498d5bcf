//! Charts of a sweep's table: a map over two axes, curves over one axis, or points of a sampled design.

use std::iter;

use super::Sheet;
use crate::math::scan::range;
use crate::plot::colormap::ColorMap;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve, Map, Mark, Point, Scale};
use crate::reading::column::unit_of;
use crate::reading::{Column, Regime};
use crate::scenario::hint::nearest;
use crate::scenario::key::Key;
use crate::scenario::printable;
use crate::studies::sweep::slice::{Contour, Slice};
use crate::studies::sweep::{self, Design};

/// Maximum number of charts by default.
const MOST_CHARTS: usize = 4;

/// Positive values with at least this ratio of largest to smallest get a logarithmic scale.
const DECADES: f64 = 100.0;

/// Free space beside curves with symbols, relative to the data's extent.
const MARGIN: f64 = 0.04;

/// Interrupts a line.
const GAP: (f64, f64) = (f64::NAN, f64::NAN);

/// The column of the words.
const REGIME: Column = Column::Regime;

/// Quantities whose estimated error studies can record, and the column that holds it, relative to the quantity.
const ERRORS: [(Column, Column); 5] = [
    (Column::ScarDepth, Column::DeepestError),
    (Column::WearVolume, Column::VolumeError),
    (Column::DissipatedEnergy, Column::EnergyError),
    (Column::EnergyPerCycle, Column::LoopError),
    (Column::ContactRadius, Column::ContactRadiusError),
];

/// Makes the sheet of the study called `name`: one chart for each of `columns`, or for the default ones.
///
/// # Errors
/// Names, in one line, a column that the study lacks or that has no values.
pub fn sheet(slice: &Slice, columns: &[String], name: &str) -> Result<Sheet, String> {
    let study = &slice.study;
    let has_values = |column: &Column| {
        let mut points = slice.points();
        points.any(|point| slice.field(point, *column).is_some())
    };
    let mut chosen = usual(slice);
    chosen.retain(has_values);
    if !columns.is_empty() {
        let names = || study.columns.iter().map(|column| column.name());
        let chosen_by = |column: &String| match names().position(|known| known == column) {
            Some(at) if has_values(&study.columns[at]) => Ok(study.columns[at]),
            Some(_) => Err(format!("--column {column}: no point of {name} has a value")),
            None => {
                let (column, known) = (printable(column), names().collect::<Vec<_>>().join(", "));
                let near = nearest(&column, names());
                let near = near.map_or(String::new(), |near| format!("did you mean {near}? "));
                Err(format!("--column {column}: {near}{name} has {known}"))
            }
        };
        chosen = columns.iter().map(chosen_by).collect::<Result<_, _>>()?;
    }
    if chosen.is_empty() {
        return Err(format!("{name}: no point has a value to draw"));
    }
    let charts = chosen.into_iter().map(|column| {
        let mut chart = chart(slice, column, [slice.borders(), slice.criteria()]);
        chart.curves.splice(0..0, regime_border(slice, column));
        chart
    });
    Ok(Sheet {
        title: study.title.clone().unwrap_or_else(|| name.to_owned()),
        charts: charts.collect(),
        facts: facts(slice, name),
    })
}

/// The default columns of a sheet: for a map the first one and the regimes, for curves all except errors.
fn usual(slice: &Slice) -> Vec<Column> {
    let named = slice.study.columns.iter().copied();
    let regime = named.clone().filter(|name| *name == REGIME);
    let plain = named.filter(|column| *column != REGIME && !Column::ERRORS.contains(column));
    match slice.y {
        Some(_) => plain.take(1).chain(regime).collect(),
        None => plain.take(MOST_CHARTS).collect(),
    }
}

/// Returns the facts for a caption.
fn facts(slice: &Slice, name: &str) -> Vec<(String, String)> {
    let study = &slice.study;
    let mut facts = vec![
        ("study".to_owned(), name.to_owned()),
        ("base".into(), study.base.title().to_owned()),
    ];
    let hidden = slice.hidden();
    facts.extend(hidden.map(|axis| {
        let of = &study.axes[axis];
        (of.key.clone(), of.text(slice.at[axis]))
    }));
    let set = study.set.iter();
    facts.extend(set.map(|(key, value)| (key.clone(), value.to_string())));
    let (there, failed) = slice.count();
    let all = study.points();
    facts.push((
        "points".into(),
        format!("{there} of {all}, {failed} failed"),
    ));
    facts
}

/// Returns the positions of an axis' values: the numbers themselves, or the indices of words.
fn places(axis: &sweep::StudyAxis) -> Vec<f64> {
    let all = 0..axis.count();
    all.map(|place| axis.number(place).unwrap_or(place as f64))
        .collect()
}

/// Returns an axis of a study with its title and unit.
pub fn paper_axis(slice: &Slice, axis: &sweep::StudyAxis) -> Axis {
    let unit = slice.study.unit(axis);
    let label = Key::find(&axis.key).and_then(|known| known.label);
    let mut label = match (axis.key.as_str(), unit) {
        ("motion.normal.mean", "N") => "mean normal force F_z".to_owned(),
        ("motion.normal.mean", _) => "mean depth d".to_owned(),
        (key, _) => label.unwrap_or(key).to_owned(),
    };
    if (0..axis.count()).any(|place| axis.number(place).is_none()) {
        let words = (0..axis.count()).map(|place| format!("{place}: {}", axis.text(place)));
        label = format!("{label}, {}", words.collect::<Vec<_>>().join(", "));
    }
    Axis::new(label, unit).scale(axis.spread)
}

/// A column of a study in words, with its unit; logarithmic where its `values` span decades.
pub fn quantity(name: &str, values: &[f64]) -> Axis {
    let label =
        Column::find(name).map_or_else(|| name.to_owned(), |column| column.meaning().to_owned());
    let shown = values.iter().copied().filter(|value| value.is_finite());
    Axis::new(label, unit_of(name)).scale(match range(shown) {
        Some([low, high]) if low > 0.0 && high / low >= DECADES => Scale::Log,
        _ => Scale::Linear,
    })
}

/// The values of a column at points; regimes count as the numbers of their words.
fn values(slice: &Slice, column: Column, points: impl Iterator<Item = usize>) -> Vec<f64> {
    let value = |point| match column {
        REGIME => slice.regime(point).map(|regime| f64::from(regime as u8)),
        _ => slice.number(point, column),
    };
    points
        .map(|point| value(point).unwrap_or(f64::NAN))
        .collect()
}

/// Plots a column over one axis as a curve, or over two as a map; `lines` are borders in closed form and criteria from
/// the literature.
pub fn chart(slice: &Slice, column: Column, lines: [Vec<Contour>; 2]) -> Chart {
    match slice.y() {
        Some(upwards) => map(slice, upwards, column, lines),
        None => points(slice, column),
    }
}

/// Returns an axis of a map, its positions, and the edges between them.
fn gridded(slice: &Slice, axis: &sweep::StudyAxis) -> (Axis, Vec<f64>, Vec<f64>) {
    let (shown, places) = (paper_axis(slice, axis), places(axis));
    let edges = shown.edges(&places);
    let [first, last] = [edges[0], edges[edges.len() - 1]];
    let bounds = [first.min(last), first.max(last)];
    (shown.bounds(bounds), places, edges)
}

/// Makes a chart of a column as colours over two axes, with a letter at the end of each line.
fn map(
    slice: &Slice,
    upwards: &sweep::StudyAxis,
    column: Column,
    [borders, criteria]: [Vec<Contour>; 2],
) -> Chart {
    let [(x, xs, _), (y, ys, _)] = [slice.x(), upwards].map(|axis| gridded(slice, axis));
    let values = values(slice, column, slice.points());
    let is_regime = column == REGIME;
    let title = if is_regime { "running condition" } else { "" };
    let mut chart = Chart::new(title, x, y);
    chart.map = Some(Map {
        quantity: quantity(column.name(), if is_regime { &[] } else { &values }),
        values,
        colors: ColorMap::Sequential,
        words: if is_regime {
            Regime::ALL.map(Regime::title).to_vec()
        } else {
            Vec::new()
        },
        places: [xs, ys],
    });
    // The value of a word is its index.
    let value = |axis: &sweep::StudyAxis, place: f64| axis.value_at(place).unwrap_or(place);
    let spot = |[x, y]: [f64; 2]| (value(slice.x(), x), value(upwards, y));
    let criteria = criteria.into_iter().enumerate();
    let criteria = criteria.map(|(k, line)| (3 + k, line));
    for (k, line) in borders.into_iter().enumerate().chain(criteria) {
        let parts = line.parts().map(|part| part.iter().map(|&at| spot(at)));
        let points = parts.flat_map(|part| iter::once(GAP).chain(part)).skip(1);
        let (xs, ys): (Vec<f64>, Vec<f64>) = points.unzip();
        let end = line.at.last().map(|&end| spot(end));
        chart.points.extend(end.map(|(x, y)| Point {
            at: [x, y],
            sign: line.letter(),
            role: Role::Title,
        }));
        let curve = Curve::new(line.name, xs, ys, Role::Border(k));
        chart.curves.push(curve);
    }
    chart
}

/// The edges of a map's cells between points of different regimes, with gaps; `None` without any, and where the
/// `column` itself shows them.
fn regime_border(slice: &Slice, column: Column) -> Option<Curve> {
    let upwards = slice.y().filter(|_| column != REGIME)?;
    let [(_, _, across), (_, _, up)] = [slice.x(), upwards].map(|axis| gridded(slice, axis));
    let [wide, high] = slice.size();
    let regime = |x: usize, y: usize| slice.regime(slice.point_at(x, y));
    let differ = |a: Option<Regime>, b: Option<Regime>| a.zip(b).is_some_and(|(a, b)| a != b);
    let mut border = Vec::new();
    for y in 0..high {
        for x in 0..wide {
            let corner = (across[x + 1], up[y + 1]);
            if x + 1 < wide && differ(regime(x, y), regime(x + 1, y)) {
                border.extend([(across[x + 1], up[y]), corner, GAP]);
            }
            if y + 1 < high && differ(regime(x, y), regime(x, y + 1)) {
                border.extend([(across[x], up[y + 1]), corner, GAP]);
            }
        }
    }
    let (xs, ys): (Vec<f64>, Vec<f64>) = border.into_iter().unzip();
    let name = "running condition changes";
    (!xs.is_empty()).then(|| Curve::new(name, xs, ys, Role::Border(2)))
}

/// Plots a column over the first axis: one symbol per point, with error bars if the study has recorded them. Joins the
/// points unless they differ in more than this axis.
fn points(slice: &Slice, column: Column) -> Chart {
    let places = places(slice.x());
    let is_joined = matches!(slice.study.design, Design::Grid | Design::Zip);
    let mut order: Vec<usize> = (0..places.len()).collect();
    if is_joined {
        order.sort_by(|&a, &b| places[a].total_cmp(&places[b]));
    }
    let shown = || order.iter().map(|&x| slice.point_at(x, 0));
    let ys = values(slice, column, shown());
    let of_column = ERRORS.iter().find(|(of, _)| *of == column);
    let errors = of_column.map(|(_, error)| values(slice, *error, shown()));
    let errors = errors.filter(|errors| errors.iter().any(|error| error.is_finite()));
    let bars = errors.map(|errors| {
        let both = ys.iter().zip(&errors);
        both.map(|(y, error)| (y * error).abs()).collect()
    });
    let mut chart = Chart::new(
        "",
        paper_axis(slice, slice.x()),
        quantity(column.name(), &ys),
    );
    chart.margin = MARGIN;
    let xs: Vec<f64> = order.iter().map(|&x| places[x]).collect();
    let curve = Curve::new("", xs, ys, Role::Profile);
    let mut curve = curve.scattered(bars.unwrap_or_else(Vec::new));
    curve.has_line = is_joined;
    chart.curves.push(curve);
    if is_joined {
        let edges = chart.x.edges(&places);
        let regime = |x: usize| slice.regime(slice.point_at(x, 0));
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

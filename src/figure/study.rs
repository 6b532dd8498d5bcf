//! The sheet of a sweep's table: charts of some of its columns, and what its caption says.

use super::Sheet;
use crate::charts::study::lines::borders;
use crate::charts::study::{REGIME, Slice, chart};
use crate::reading::Column;
use crate::scenario::hint::nearest;
use crate::scenario::printable;

/// Maximum number of charts by default.
const MOST_CHARTS: usize = 4;

/// Makes the sheet of the study called `name`: one chart for each of `columns`, or for the default ones.
///
/// # Errors
/// Names, in one line, a column that the study lacks or that has no values.
pub fn sheet(slice: &Slice, columns: &[String], name: &str) -> Result<Sheet, String> {
    let study = &slice.results.study;
    let has_values = |column: &Column| {
        let mut points = slice.points();
        points.any(|point| slice.results.value(point, *column).is_some())
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
    let borders = borders(slice);
    let charts = chosen.into_iter();
    let charts = charts.map(|column| chart(slice, column, Some(&borders)));
    Ok(Sheet {
        title: study.title.clone().unwrap_or_else(|| name.to_owned()),
        charts: charts.collect(),
        facts: facts(slice, name),
    })
}

/// The default columns of a sheet: for a map the first one and the regimes, for curves all except errors.
fn usual(slice: &Slice) -> Vec<Column> {
    let named = slice.results.study.columns.iter().copied();
    let regime = named.clone().filter(|name| *name == REGIME);
    let plain = named.filter(|column| *column != REGIME && !Column::ERRORS.contains(column));
    match slice.y {
        Some(_) => plain.take(1).chain(regime).collect(),
        None => plain.take(MOST_CHARTS).collect(),
    }
}

/// Returns the facts for a caption.
fn facts(slice: &Slice, name: &str) -> Vec<(String, String)> {
    let study = &slice.results.study;
    let mut facts = vec![
        ("study".to_owned(), name.to_owned()),
        ("base".into(), study.base.title().to_owned()),
    ];
    let hidden = slice.hidden();
    facts.extend(hidden.map(|axis| {
        let of = &study.axes[axis];
        (of.key.to_string(), of.text(slice.at[axis]))
    }));
    let set = study.set.iter();
    facts.extend(set.map(|(key, value)| (key.clone(), value.to_string())));
    let (there, failed) = (slice.results.rows().len(), slice.results.failed());
    let all = study.points();
    let points = format!("{there} of {all}, {failed} failed");
    facts.push(("points".into(), points));
    facts
}

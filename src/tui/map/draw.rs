//! The screen of a study.
//!
//! ```text
//! map.csv                          1432 of 1600 points   title, how far the study is
//! worn volume V  0.06 ▀▀▀▀▀▀▀▀▀ 10571 µm³                the chart, as on paper: the key to its colours and lines,
//! G gross slip, closed form   A A = 0.2
//!  2e-06 ▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀                           the map,
//!        ▀▀▀▀▀▀▀▀G▀▀▀▀▀▀▀▀▀▀▀▀                           G: the end of a line
//!  5e-07 ▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀
//!        1e-08           1e-06   tangential amplitude
//! point 17: mean depth d 0.5 µm ... regime partial       what the cursor reads
//! arrows move  Enter open  Tab column  t theory  q quit
//! ```

use ratatui::layout::Constraint::{Fill, Length};
use ratatui::prelude::*;

use super::view::MapView;
use crate::charts::study::{quantity, titled_axis};
use crate::plot::map::side_by_side;
use crate::plot::theme::{Role, Theme};
use crate::plot::units::format_value;
use crate::plot::{Axis, Chart, Plot, Point};
use crate::scenario::scalars::cell;
use crate::studies::sweep::Results;
use crate::tui::canvas::Canvas;

/// The keys of the footer, of which as many as fit are shown, and the one that is always shown.
const KEYS: [[&str; 2]; 7] = [
    ["arrows", "move"],
    ["Enter", "open"],
    ["Tab", "column"],
    ["L", "log"],
    ["x y", "axes"],
    ["[ ]", "other axes"],
    ["t", "theory"],
];
const ALWAYS: [[&str; 2]; 2] = [["?", "help"], ["q", "quit"]];

/// All keys, with the explanations of the help.
pub const ALL_KEYS: [[&str; 2]; 12] = [
    ["arrows, hjkl", "move the cursor, which reads the point"],
    ["Home End", "to the first and the last point of the row"],
    ["Enter", "open the point in the explorer; q leads back"],
    ["Tab S-Tab", "next and previous column of the study"],
    ["L", "logarithmic colours, or linear ones"],
    ["x", "the next axis to the right"],
    ["y", "the next axis upwards"],
    ["[ ]", "move along the axes that are not shown"],
    ["t", "borders in closed form and criteria, or none"],
    ["?", "show or hide these keys"],
    ["Ctrl-Z", "suspend to the shell"],
    ["q", "leave the map"],
];

/// The character of the base scenario.
const HERE: char = '◆';

/// Significant digits of values.
const DIGITS: usize = 4;

/// Draws the whole screen; a `notice` replaces the keys.
pub fn draw(view: &MapView, notice: Option<&str>, mut canvas: Canvas) {
    let (area, theme) = (canvas.area, canvas.theme);
    if area.width < 20 || area.height < 10 {
        return canvas.show(Line::raw("too small: needs 20x10 or more"));
    }
    let lines = cursor_lines(view, &theme, area.width);
    let rows = (lines.len() as u16).min(area.height / 3);
    let layout = Layout::vertical([Length(1), Fill(1), Length(rows), Length(1)]);
    let [head, body, below, keys] = layout.areas(area);
    let styled =
        |text: &str, role| Line::from(Span::styled(theme.printable(text), theme.style(role)));
    let count = styled(&count(&view.slice.results), Role::Quiet);
    canvas.at(head).show(styled(&view.name, Role::Title));
    canvas.at(head).show(count.right_aligned());
    let mut chart = view.chart();
    mark(view, &mut chart);
    let place = view.slice.cursor()[0];
    let along = view.slice.x().number(place).unwrap_or(place as f64);
    let along = Some(along).filter(|_| chart.map.is_none());
    canvas
        .at(body)
        .show(Plot::new(&chart, &theme).cursor(along));
    canvas.at(below).show(Text::from(lines));
    let notice = notice.map(|text| (text, Role::Notice));
    canvas.at(keys).keys(notice, &KEYS, &ALWAYS);
}

/// Says how many points have their rows.
fn count(results: &Results) -> String {
    let (there, points) = (results.rows().len(), results.study.points());
    match results.failed() {
        0 => format!("{there} of {points} points"),
        failed => format!("{there} of {points} points, {failed} failed"),
    }
}

/// Marks the base scenario in a chart and, on a map, the cursor and the points without a value.
fn mark(view: &MapView, chart: &mut Chart) {
    let (mut signs, here) = (Vec::new(), view.position());
    let mut add = |at, sign, role| signs.push(Point { at, sign, role });
    let curve = chart.curves.first();
    let here = match (&chart.map, here) {
        (None, Some([x, _])) => curve.and_then(|curve| Some([x, curve.value_at(x)?])),
        (_, here) => here,
    };
    if let Some(here) = here {
        add(here, HERE, Role::Title);
        chart.note = format!("{HERE} you are here");
    }
    if let Some(map) = &chart.map {
        let spot = |[x, y]: [usize; 2]| [map.places[0][x], map.places[1][y]];
        for (place, value) in view.slice.places().zip(&map.values) {
            let point = view.slice.point_at(place);
            if view.slice.results.row(point).is_some() && !map.quantity.scale.has(*value) {
                add(spot(place), '!', Role::Alarm);
            }
        }
        add(spot(view.slice.cursor()), '╳', Role::Focus);
    }
    chart.points.extend(signs);
}

/// Returns what the cursor reads: the point with its place on the axes, and its values, the shown column first.
fn cursor_lines(view: &MapView, theme: &Theme, width: u16) -> Vec<Line<'static>> {
    let (study, point) = (&view.slice.results.study, view.point());
    let axes = study.axes.iter().zip(study.places(point));
    let values = axes.map(|(axis, place)| match axis.number(place) {
        Some(number) => in_words(&titled_axis(&view.slice, axis), number),
        None => format!("{} {}", axis.key, axis.text(place)),
    });
    let place = format!("point {point}: {}", values.collect::<Vec<_>>().join(", "));
    let mut reading = vec!["not there yet".to_owned()];
    if let Some(row) = view.slice.results.row(point) {
        let read = study.columns.iter().zip(&row.values);
        let (first, others): (Vec<_>, Vec<_>) =
            read.partition(|(column, _)| **column == view.column());
        let read = first.into_iter().chain(others);
        let read = read.map(|(column, value)| match value.as_f64() {
            Some(number) => in_words(&quantity(*column, &[]), number),
            None => format!("{} {}", column.name(), cell(value)),
        });
        reading = read.chain([format!("status {}", row.status)]).collect();
    }
    let styled = |text: &String, role| Span::styled(theme.printable(text), theme.style(role));
    let reading = reading
        .iter()
        .map(|text| Line::from(styled(text, Role::Notice)));
    let mut lines = vec![Line::from(styled(&place, Role::Quiet))];
    lines.extend(side_by_side(reading, width));
    lines
}

/// Formats a number with the name and the unit of its quantity.
fn in_words(of: &Axis, number: f64) -> String {
    format!("{} {}", of.label, format_value(number, of.unit, DIGITS))
}

//! The screen of a study.
//!
//! ```text
//! map.csv                          1432 of 1600 points   title, how far the study is
//! wear_volume_m3   1.2e-18 ▀▀▀▀▀▀▀▀▀ 3.4e-14             column and its colours
//!  2e-06 ▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀                           the chart, as on paper
//!        ▀▀▀▀▀▀▀▀G▀▀▀▀▀▀▀▀▀▀▀▀                           G: a border in closed form
//!  5e-07 ▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀▀
//!        1e-08           1e-06   motion.tangential.amplitude
//! G gross slip, closed form   A = 0.2                    what the letters are
//! point 17: motion.normal.mean = 5e-7 ... regime partial what the cursor reads
//! arrows move  Enter open  Tab column  t theory  q quit
//! ```

use ratatui::prelude::*;

use super::view::{MapView, shown};
use crate::figure::study;
use crate::plot::colormap::ColorMap;
use crate::plot::map::{self, SWATCHES};
use crate::plot::shades::{self, has_blocks};
use crate::plot::theme::{Role, Theme};
use crate::plot::units::{format_value, range_ends};
use crate::plot::{Axis, Chart, Plot, Point, Scale};
use crate::reading::Regime;
use crate::tui::canvas::Canvas;
use crate::tui::line::cells;

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
    let (area, theme) = (canvas.area, &canvas.theme.clone());
    if area.width < 20 || area.height < 10 {
        return canvas.show(Line::raw("too small: needs 20x10 or more"));
    }
    let ((there, failed), points) = (view.slice.count(), view.slice.study.points());
    let failed = match failed {
        0 => String::new(),
        failed => format!(", {failed} failed"),
    };
    let count = format!("{there} of {points} points{failed}");
    let behind = area.width.saturating_sub(count.chars().count() as u16);
    let mut chart = view.chart();
    // The lines' names go below the map; letters on the map refer to them.
    let lines = chart.curves.iter_mut().zip(&chart.points);
    let names =
        lines.map(|(line, point)| format!("{} {}", point.sign, std::mem::take(&mut line.name)));
    let mut names: Vec<String> = names.collect();
    let here = view.position();
    names.extend(here.map(|_| format!("{HERE} you are here")));
    let point = view.point();
    let row = |row: u16| Rect::new(area.x, area.y + row, area.width, 1);
    let count_place = Rect::new(area.x + behind, area.y, area.width - behind, 1);
    let parts = [
        (names, Role::Quiet),
        (vec![place(view, point)], Role::Quiet),
        (reading(view, point), Role::Notice),
    ];
    // Each part takes as many rows as it needs, and the map gets the rest.
    let told = parts.iter().flat_map(|(parts, role)| {
        let lines = side_by_side(parts, usize::from(area.width)).into_iter();
        lines.map(move |line| (line, *role))
    });
    let told: Vec<_> = told.take(usize::from(area.height / 3)).collect();
    let below = area.height - 1 - told.len() as u16;
    let rows = told.iter().zip(below..);
    let rows = rows.map(|((text, role), k)| (row(k), text, *role));
    let head = [
        (row(0), &view.name, Role::Title),
        (count_place, &count, Role::Quiet),
    ];
    for (place, text, role) in head.into_iter().chain(rows) {
        let text = canvas.printable(text);
        let style = canvas.style(role);
        canvas.at(place).show(Line::styled(text, style));
    }
    canvas.at(row(1)).show(legend(view, theme, &chart));
    signs(view, theme, &mut chart);
    let body = Rect::new(area.x, area.y + 2, area.width, below - 2);
    let place = view.cursor()[0];
    let along = view.slice.x().number(place).unwrap_or(place as f64);
    let along = Some(along).filter(|_| chart.map.is_none());
    canvas.at(body).show(Plot::new(&chart, theme).cursor(along));
    let notice = notice.map(|text| (text, Role::Notice));
    let last = row(area.height - 1);
    canvas.at(last).keys(notice, &KEYS, &ALWAYS);
}

/// Adds the marks of the screen to the chart: the base scenario and, on a map, points without a value, the words of
/// regions, and the cursor.
fn signs(view: &MapView, theme: &Theme, chart: &mut Chart) {
    let (mut signs, here) = (Vec::new(), view.position());
    let mut add = |at, sign, role| signs.push(Point { at, sign, role });
    let Some(map) = &chart.map else {
        let base = here.and_then(|[x, _]| Some([x, chart.curves.first()?.value_at(x)?]));
        base.into_iter().for_each(|at| add(at, HERE, Role::Alarm));
        return chart.points.extend(signs);
    };
    let [wide, _] = view.slice.size();
    let spot = |k: usize| [map.places[0][k % wide], map.places[1][k / wide]];
    for (k, point) in view.slice.points().enumerate() {
        if view.slice.row(point).is_some() && !map.quantity.scale.has(map.values[k]) {
            add(spot(k), '!', Role::Alarm);
        }
    }
    let words = SWATCHES.iter().enumerate().take(map.words.len());
    for (word, (sign, _)) in words.filter(|_| has_blocks(theme)) {
        let is_there = |k: &usize| map.values[*k] == word as f64;
        let there: Vec<usize> = (0..map.values.len()).filter(is_there).collect();
        let mean = |of: fn(usize, usize) -> usize| {
            let sum: usize = there.iter().map(|&k| of(k, wide)).sum();
            sum / there.len().max(1)
        };
        let (x, y) = (mean(|k, wide| k % wide), mean(|k, wide| k / wide));
        // The middle of a bent region may lie outside it.
        let nearest = there
            .iter()
            .min_by_key(|&k| (k % wide).abs_diff(x) + (k / wide).abs_diff(y));
        nearest
            .into_iter()
            .for_each(|&k| add(spot(k), *sign, Role::Title));
    }
    here.into_iter().for_each(|at| add(at, HERE, Role::Title));
    let [x, y] = view.cursor();
    add(spot(y * wide + x), '╳', Role::Focus);
    chart.points.extend(signs);
}

/// Arranges texts side by side in lines of this width; returns at least one line.
fn side_by_side(parts: &[String], width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for part in parts {
        let last = lines.len() - 1;
        match cells(&lines[last]) {
            0 => lines[last].push_str(part),
            taken if taken + 2 + cells(part) <= width => {
                lines[last].push_str("  ");
                lines[last].push_str(part);
            }
            _ => lines.push(part.clone()),
        }
    }
    lines
}

/// Describes a point by its number and its position on the axes.
fn place(view: &MapView, point: usize) -> String {
    let study = &view.slice.study;
    let axes = study.axes.iter().zip(study.places(point));
    let values = axes.map(|(axis, place)| match axis.number(place) {
        Some(number) => in_words(&study::paper_axis(&view.slice, axis), number),
        None => format!("{} {}", axis.key, axis.text(place)),
    });
    let values: Vec<String> = values.collect();
    format!("point {point}: {}", values.join(", "))
}

/// Returns the values of a point: the shown column, the others and the status.
fn reading(view: &MapView, point: usize) -> Vec<String> {
    let study = &view.slice.study;
    let Some(fields) = view.slice.row(point) else {
        return vec!["not there yet".to_owned()];
    };
    let columns = study.columns();
    let read = columns.iter().zip(fields).skip(study.axes.len());
    let (first, others): (Vec<_>, Vec<_>) =
        read.partition(|(name, _)| **name == view.column().name());
    let read = first.into_iter().chain(others);
    let read = read.map(|(name, field)| match field.parse() {
        Ok(number) => in_words(&study::quantity(name, &[]), number),
        Err(_) => format!("{name} {field}"),
    });
    read.collect()
}

/// Formats a number with the name and the unit of its quantity.
fn in_words(of: &Axis, number: f64) -> String {
    format!("{} {}", of.label, format_value(number, of.unit, DIGITS))
}

/// Returns the column with its range, or its words, in their colours.
fn legend(view: &MapView, theme: &Theme, chart: &Chart) -> Line<'static> {
    let ((quantity, range), quiet) = (shown(chart), theme.style(Role::Quiet));
    let name = if view.is_regime() {
        view.column().name()
    } else {
        &quantity.label
    };
    let name = Span::styled(theme.printable(name), theme.style(Role::Focus));
    let mut line = Line::from(name);
    if view.is_regime() {
        for ((sign, role), regime) in SWATCHES.into_iter().zip(Regime::ALL) {
            line.push_span("  ");
            if has_blocks(theme) {
                line.push_span(Span::styled("█", theme.style(role)));
            }
            line.push_span(format!("{sign} {}", regime.title()));
        }
        return line;
    }
    let Some(range) = range else {
        return line;
    };
    let [low, high] = range_ends(range, quantity.unit, 3);
    let ends = [format!("  {low} "), format!(" {high}")].map(|end| theme.printable(&end));
    line.extend(shades::key(theme, ColorMap::Sequential, map::SIGNS, ends));
    if quantity.scale == Scale::Log {
        line.push_span(Span::styled("  log", quiet));
    }
    for axis in view.slice.hidden() {
        let (place, axis) = (view.slice.at[axis], &view.slice.study.axes[axis]);
        let text = theme.printable(&format!("  {} = {}", axis.key, axis.text(place)));
        line.push_span(Span::styled(text, quiet));
    }
    line
}

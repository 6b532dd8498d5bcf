//! The values of the curves at the cursor, in one line. With ghosts, the focused panel's quantity comes first, with
//! each ghost's value and its difference.

use super::cursor::{RADIUS, abscissa};
use super::frame::Frame;
use super::live_charts::LiveCharts;
use super::panels::Panel;
use crate::charts::Run;
use crate::math::scan::value_at;
use crate::plot::Chart;
use crate::plot::theme::{Role, Theme};
use crate::plot::units::format_value;
use crate::studies::ghost::Ghost;
use crate::traces::{Axes, Loop};

/// Significant digits.
const DIGITS: usize = 4;

/// Maximum length of a ghost's name, in characters.
const LONGEST_NAME: usize = 16;

/// Returns the values at a position in the focused panel's chart, as many as fit into `width` cells.
pub(super) fn line_at(
    frame: &Frame,
    charts: &LiveCharts,
    focus: Panel,
    place: f64,
    width: usize,
    theme: &Theme,
) -> String {
    let Some(recipe) = focus.chart() else {
        return line(frame, focus, place, width, theme);
    };
    match &*charts.get(focus, recipe, frame) {
        _ if abscissa(focus) == RADIUS => line(frame, focus, place, width, theme),
        Ok(chart) => match &compared(frame, focus, place)[..] {
            [] => line_of(chart, place, width, theme),
            now => theme.printable(&format!(" now {}", now.concat())),
        },
        Err(_) => String::new(),
    }
}

/// Returns `r 52.0 µm  slip  f ...`: as many values at the radius `r` (m) as fit into `width` cells. Curves that no
/// panel shows are not computed and therefore missing.
fn line(frame: &Frame, focus: Panel, r: f64, width: usize, theme: &Theme) -> String {
    let value = |name: &str, value: f64, unit: &str| {
        format!(" {name} {} ", format_value(value, unit, DIGITS))
    };
    let run = &frame.run;
    let mut parts = compared(frame, focus, r);
    let at_radius = parts.is_empty() || compared_axes(focus).over_r();
    if at_radius {
        let zone = frame.live.observation.moment.zone_at(r);
        let place = [value("r", r, "m"), format!(" {} ", zone.name())];
        parts.splice(0..0, place);
        let moves = frame.live.observation.moment.stick_radius.is_some();
        let curves = CURVES.into_iter();
        for axes in curves.filter(|axes| moves || *axes != Axes::SHEAR) {
            let at = over_r(run, axes, r).map(|seen| value(axes.y.symbol(), seen, axes.y.unit()));
            parts.extend(at.filter(|part| !parts.contains(part)));
        }
    }
    let mut line = String::new();
    for part in parts.iter().map(|part| theme.printable(part)) {
        if line.chars().count() + part.chars().count() > width {
            break;
        }
        line.push_str(&part);
    }
    line
}

/// The curves over the radius, in the order of the line.
const CURVES: [Axes; 5] = [
    Axes::PROFILE,
    Axes::PRESSURE,
    Axes::SHEAR,
    Axes::WEAR,
    Axes::SPRINGS,
];

/// Returns the run's value at a radius.
fn over_r(run: &Run, axes: Axes, r: f64) -> Option<f64> {
    let state = run.states.last()?;
    value_at(state.column(axes.x)?, state.column(axes.y)?, r)
}

/// Returns the quantity that a panel compares with other sources.
fn compared_axes(focus: Panel) -> Axes {
    let overlays = focus.recipe().overlays;
    overlays.first().copied().unwrap_or(Axes::WEAR)
}

/// Returns the position at which the panel compares (the radius, or the present displacement, cycle or work) and the
/// run's value there.
fn own_value(frame: &Frame, axes: Axes, r: f64) -> Option<(f64, f64)> {
    let run = &frame.run;
    if axes.over_r() {
        return Some((r, over_r(run, axes, r)?));
    }
    let moment = &frame.live.observation.moment;
    match axes {
        Axes::LOOP => return Some((moment.shift, moment.tangential_force)),
        // The screen shows the largest radius of the cycle, histories the one at that moment.
        Axes::CONTACT => return Some((moment.cycle, moment.contact_radius)),
        _ => {}
    }
    let last = |column| run.history.as_ref()?.column(column)?.last().copied();
    Some((last(axes.x)?, last(axes.y)?))
}

/// Returns a ghost's value at the same position, if it has one.
fn of_ghost(run: &Run, ghost: &Ghost, axes: Axes, place: f64) -> Option<f64> {
    match axes {
        Axes::LOOP => {
            let rises = run.loops.last().is_none_or(Loop::rises);
            ghost.trace(axes)?.force_at(place, rises)
        }
        Axes::WEAR => {
            let worn = ghost.worn(|r| run.unworn(r))?;
            value_at(&worn.radii, &worn.wear, place)
        }
        _ => ghost.trace(axes)?.value_at(place),
    }
}

/// Returns the run's value of the focused panel's quantity, and each ghost's value with its difference from the run's;
/// empty if no ghost has the quantity.
fn compared(frame: &Frame, focus: Panel, r: f64) -> Vec<String> {
    let axes = compared_axes(focus);
    let run = &frame.run;
    let Some((place, own)) = own_value(frame, axes, r) else {
        return Vec::new();
    };
    let shown = |value: f64| format_value(value, axes.y.unit(), DIGITS);
    let mut parts = vec![format!(" {} {} ", axes.y.symbol(), shown(own))];
    for ghost in &run.ghosts {
        let Some(value) = of_ghost(run, ghost, axes, place) else {
            continue;
        };
        let difference = value - own;
        let sign = if difference < 0.0 { "" } else { "+" };
        let name: String = ghost.name.chars().take(LONGEST_NAME).collect();
        let [value, difference] = [value, difference].map(shown);
        parts.push(format!(" {name} {value} ({sign}{difference}) "));
    }
    if parts.len() == 1 {
        parts.clear();
    }
    parts
}

/// Returns `cycles 12.00  c 41.6 µm …`: the values at a position of a chart that is not over r, as many as fit into
/// `width` cells. A loop has two almost everywhere.
fn line_of(chart: &Chart, x: f64, width: usize, theme: &Theme) -> String {
    let value = |value: f64, unit| format_value(value, unit, DIGITS);
    let mut line = format!(" {} {} ", chart.x.label, value(x, chart.x.unit));
    for curve in chart
        .curves
        .iter()
        .filter(|curve| curve.role != Role::Faint)
    {
        let name = match curve.name.as_str() {
            "" => &chart.y.label,
            name => name,
        };
        let values = curve.values_at(x);
        let values: Vec<String> = values.map(|y| value(y, chart.y.unit)).collect();
        let part = theme.printable(&format!(" {name} {} ", values.join(", ")));
        if !values.is_empty() && line.chars().count() + part.chars().count() <= width {
            line.push_str(&part);
        }
    }
    theme.printable(&line)
}

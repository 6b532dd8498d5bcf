//! Two runs in lockstep from one state: both profiles, both pressures, and the difference below. Ghosts lie
//! over each plot, in the difference as their own from this run.

use ratatui::buffer::Buffer;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::text::Line;
use ratatui::widgets::Widget;

use super::{App, Frame, bare_plot, clip_spikes, curve, edge_marks, ghosts, nothing, panel_block};
use crate::math::scan::largest;
use crate::plot::units::{format_number, format_value_in};
use crate::plot::{Axis, Scale, nice_bounds};
use crate::simulation::Observation;
use crate::studies::ghost::Axes;
use crate::tui::frame::Comparison;
use crate::tui::theme::Role;

/// Least width of a column of numbers, cells.
const COLUMN: usize = 11;

/// The difference is not drawn below this width.
const NARROWEST: u16 = 17;

/// Draws the comparison over the whole area of the panels.
pub fn draw(frame: &Frame, comparison: &Comparison, app: &App, area: Rect, buffer: &mut Buffer) {
    let [top, bottom] = Layout::vertical([Constraint::Fill(3), Constraint::Fill(2)]).areas(area);
    let [left, right] = Layout::horizontal([Constraint::Fill(1); 2])
        .spacing(1)
        .areas(top);
    let (seen, other, theme) = (&frame.observation, &comparison.observation, &app.theme);
    let difference: Vec<f64> = differences(other, seen).into_iter().map(f64::abs).collect();
    let rows = rows(frame, comparison, &difference, theme.ascii());
    let cells = rows.iter().flat_map(|(_, here, there)| [here, there]);
    let column = cells
        .map(|cell| cell.chars().count())
        .fold(COLUMN, usize::max);
    // The numbers must not be cut; the difference gets the rest, if that is wide enough.
    let table = 17 + 2 * column as u16;
    let left_over = bottom.width.saturating_sub(table + 1);
    let [below, numbers] = if left_over < NARROWEST {
        [Rect::ZERO, bottom]
    } else {
        Layout::horizontal([Constraint::Fill(1), Constraint::Length(table)])
            .spacing(1)
            .areas(bottom)
    };
    let names = (this_name(frame), comparison.name.as_str());
    let inside = panel_block("3D profile", app, left, buffer);
    let mut lines = ghosts::worn(frame, Some(1.0));
    let mut plot = bare_plot(app, Axis::new("r", "m"), Axis::new("f", "m"))
        .cursor(app.cursor_radius(frame))
        .curves(ghosts::curves(&mut lines, app))
        .curve(curve(names.1, &other.radii, &other.profile, theme, Role::Slip).dashed())
        .curve(curve(
            &names.0,
            &seen.radii,
            &seen.profile,
            theme,
            Role::Profile,
        ));
    for mark in edge_marks(frame, theme) {
        plot = plot.mark(mark);
    }
    plot.render(inside, buffer);
    let inside = panel_block("pressure", app, right, buffer);
    let mut lines = ghosts::on(frame, Axes::Pressure, 1.0);
    // A spike at a border of stick must not flatten all the rest.
    let mut pressures = [&seen.pressure[..], &other.pressure].concat();
    clip_spikes(&mut pressures);
    let highest = largest(&pressures);
    let mut ordinate = Axis::new("p", "Pa");
    if highest > 0.0 {
        ordinate = ordinate.bounds(nice_bounds(0.0, highest));
    }
    bare_plot(app, Axis::new("r", "m"), ordinate)
        .cursor(app.cursor_radius(frame))
        .curves(ghosts::curves(&mut lines, app))
        .curve(curve(names.1, &other.radii, &other.pressure, theme, Role::Slip).dashed())
        .curve(curve(
            &names.0,
            &seen.radii,
            &seen.pressure,
            theme,
            Role::Pressure,
        ))
        .render(inside, buffer);
    let inside = panel_block("difference of f", app, below, buffer);
    let mut lines = ghosts::differences(frame);
    let of_ghosts = ghosts::ordinates(&lines);
    let largest = of_ghosts.into_iter().fold(largest(&difference), f64::max);
    let edge = seen.radii.last().copied().unwrap_or(0.0);
    // Six decades: what lies below is rounding.
    let decade = largest.log10().ceil();
    let bounds = if largest > 0.0 {
        [10f64.powf(decade - 6.0), 10f64.powf(decade)]
    } else {
        [1e-18, 1e-12]
    };
    let ordinate = Axis::new("|difference|", "m")
        .scale(Scale::Log)
        .bounds(bounds);
    if largest == 0.0 {
        let words = ["equal so far", "C: from the start"];
        for (text, row) in words.iter().zip(inside.rows()) {
            nothing(text, app, row, buffer);
        }
    } else {
        bare_plot(app, Axis::new("r", "m").bounds([0.0, edge]), ordinate)
            .cursor(app.cursor_radius(frame))
            .curves(ghosts::curves(&mut lines, app))
            .curve(curve("", &other.radii, &difference, theme, Role::Slip))
            .render(inside, buffer);
    }
    let inside = panel_block("side by side", app, numbers, buffer);
    let lines = rows
        .iter()
        .map(|(name, here, there)| format!(" {name:14} {here:>column$} {there:>column$}"));
    let stopped = comparison.stopped.iter().map(|why| format!(" {why}"));
    for (line, row) in lines.chain(stopped).zip(inside.rows()) {
        Line::raw(line).render(row, buffer);
    }
}

fn this_name(frame: &Frame) -> String {
    format!(
        "{}, N = {}",
        frame.observation.method.spoken(),
        frame.observation.radii.len() - 1
    )
}

fn rows(
    frame: &Frame,
    comparison: &Comparison,
    difference: &[f64],
    ascii: bool,
) -> Vec<(&'static str, String, String)> {
    let (here, there) = (&frame.observation.moment, &comparison.observation.moment);
    let value = |value: f64, unit: &str| format_value_in(value, unit, 4, ascii);
    let maybe =
        |number: Option<f64>, unit: &str| number.map_or_else(|| "-".into(), |v| value(v, unit));
    let residual = |number: Option<f64>| number.map_or_else(|| "-".into(), |v| format_number(v, 2));
    vec![
        ("", this_name(frame), comparison.name.clone()),
        (
            "stick c",
            maybe(here.permanent_stick_radius, "m"),
            maybe(there.permanent_stick_radius, "m"),
        ),
        (
            "contact a",
            value(here.contact_radius, "m"),
            value(there.contact_radius, "m"),
        ),
        (
            "wear volume",
            value(here.wear_volume, "m³"),
            value(there.wear_volume, "m³"),
        ),
        (
            "1 - V/(k E_d)",
            residual(here.energy_residual),
            residual(there.energy_residual),
        ),
        (
            "time per step",
            maybe(frame.step_cost, "s"),
            maybe(comparison.step_cost, "s"),
        ),
        ("rms difference", value(rms(difference), "m"), String::new()),
    ]
}

/// The worn profile of `there` less that of `here`, m, at the nodes of `there`.
fn differences(there: &Observation, here: &Observation) -> Vec<f64> {
    let points = there.radii.iter().zip(&there.wear);
    points
        .map(|(&r, wear)| wear - here.worn_depth_at(r))
        .collect()
}

/// Root mean square of differences; 0 of none.
fn rms(differences: &[f64]) -> f64 {
    let squares: f64 = differences.iter().map(|d| d * d).sum();
    (squares / differences.len().max(1) as f64).sqrt()
}

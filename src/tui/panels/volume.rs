//! Wear volume V over cycles. What the work of friction says of it, V = k E_d, differs by less than a line
//! is wide: the panel beside shows the difference.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;

use super::{App, Frame, Panel, curve, ghosts, nothing, over_cycles, series};
use crate::plot::Axis;
use crate::plot::units::format_value_in;
use crate::studies::ghost::Axes;
use crate::tui::theme::Role;

/// What the ordinate must hold: volumes grow from zero.
pub fn ordinates(frame: &Frame) -> Vec<f64> {
    let mut values = vec![0.0];
    values.extend(series(frame, |entry| entry.wear_volume).1);
    values.extend(ghosts::ordinates(&ghosts::on(frame, Axes::Volume, 1.0)));
    values
}

/// Draws the panel.
pub fn draw(frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
    let (seen, theme) = (&frame.observation, &app.theme);
    if seen.law.is_none() {
        return nothing("no wear in this scenario", app, area, buffer);
    }
    let (cycles, volume) = series(frame, |entry| entry.wear_volume);
    let work = format_value_in(seen.moment.dissipated_energy, "J", 4, theme.ascii());
    let work = format!("E_d {work}");
    let mut ghosts = ghosts::on(frame, Axes::Volume, 1.0);
    over_cycles(Panel::Volume, frame, app, Axis::new("V", "m³"))
        .curves(ghosts::curves(&mut ghosts, app))
        .curve(curve("", &cycles, &volume, theme, Role::Profile))
        .note(&work)
        .render(area, buffer);
}

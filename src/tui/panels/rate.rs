//! Worn volume per cycle, over cycles. The unfinished cycle is left out: most of the wear of a cycle falls
//! into a part of it, so a rate over less than a cycle means little.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;

use super::{App, Frame, Panel, curve, finished_series, nothing, over_cycles};
use crate::plot::Axis;
use crate::tui::theme::Role;

/// What the ordinate must hold.
pub fn ordinates(frame: &Frame) -> Vec<f64> {
    let mut values = finished_series(frame, |entry| entry.wear_rate).1;
    values.push(0.0);
    values
}

/// Draws the panel.
pub fn draw(frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
    if frame.observation.law.is_none() {
        return nothing("no wear in this scenario", app, area, buffer);
    }
    let (cycles, rate) = finished_series(frame, |entry| entry.wear_rate);
    let now = curve("", &cycles, &rate, &app.theme, Role::Profile);
    over_cycles(Panel::Rate, frame, app, Axis::new("V per cycle", "m³"))
        .curve(now)
        .render(area, buffer);
}

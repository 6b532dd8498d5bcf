//! Time per step on this machine, over finished cycles.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;

use super::{App, Frame, Panel, curve, finished_series, nothing, over_cycles};
use crate::plot::Axis;
use crate::tui::theme::Role;

/// What the ordinate must hold: costs are read from zero.
pub fn ordinates(frame: &Frame) -> Vec<f64> {
    let mut values = finished_series(frame, |entry| entry.step_cost).1;
    values.push(0.0);
    values
}

/// Draws the panel.
pub fn draw(frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
    let (cycles, cost) = finished_series(frame, |entry| entry.step_cost);
    if !cost.iter().any(|value| value.is_finite()) {
        return nothing("measured while it runs", app, area, buffer);
    }
    over_cycles(Panel::Cost, frame, app, Axis::new("t", "s"))
        .curve(curve("", &cycles, &cost, &app.theme, Role::Shear))
        .render(area, buffer);
}

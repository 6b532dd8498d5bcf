//! How far V and k E_d disagree over a period of the motion: |1 − ΔV/(k ΔE_d)|.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;

use super::{App, Frame, Panel, curve, nothing, over_cycles, series};
use crate::tui::plot::{Axis, Scale};
use crate::tui::theme::Role;

/// What the ordinate must hold.
pub fn ordinates(frame: &Frame) -> Vec<f64> {
    series(frame, |entry| entry.residual).1
}

/// Draws the panel. Errors are read by their decade: the scale is always logarithmic.
pub fn draw(frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
    let (cycles, residual) = series(frame, |entry| entry.residual);
    if !residual.iter().any(|value| *value > 0.0) {
        return nothing("nothing to compare yet", app, area, buffer);
    }
    let axis = Axis::new("|1 - V/(k E_d)|", "").scale(Scale::Log);
    over_cycles(Panel::Residual, frame, app, axis)
        .curve(curve("", &cycles, &residual, &app.theme, Role::Limit))
        .render(area, buffer);
}

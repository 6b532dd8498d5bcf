//! The largest worn depth over cycles.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;

use super::{App, Frame, Panel, curve, ghosts, nothing, over_cycles, series};
use crate::plot::Axis;
use crate::studies::ghost::Axes;
use crate::tui::theme::Role;

/// What the ordinate must hold: depths grow from zero.
pub fn ordinates(frame: &Frame) -> Vec<f64> {
    let mut values = vec![0.0];
    values.extend(series(frame, |entry| entry.scar_depth).1);
    values.extend(ghosts::ordinates(&ghosts::on(frame, Axes::Depth, 1.0)));
    values
}

/// Draws the panel.
pub fn draw(frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
    if frame.observation.law.is_none() {
        return nothing("no wear in this scenario", app, area, buffer);
    }
    let (cycles, depths) = series(frame, |entry| entry.scar_depth);
    let mut ghosts = ghosts::on(frame, Axes::Depth, 1.0);
    over_cycles(Panel::ScarDepth, frame, app, Axis::new("depth", "m"))
        .curves(ghosts::curves(&mut ghosts, app))
        .curve(curve("", &cycles, &depths, &app.theme, Role::Profile))
        .render(area, buffer);
}

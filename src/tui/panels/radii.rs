//! The largest contact radius and the smallest stick radius of every cycle.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;

use super::{App, Frame, Panel, curve, plot};
use crate::tui::plot::Axis;
use crate::tui::theme::Role;

/// What the ordinate must hold: radii grow from zero.
pub fn ordinates(frame: &Frame) -> Vec<f64> {
    std::iter::once(0.0)
        .chain(
            frame
                .trend
                .cycles()
                .flat_map(|cycle| [cycle.contact_radius, cycle.stick_radius]),
        )
        .collect()
}

/// Draws the panel.
pub fn draw(frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
    let theme = &app.theme;
    let cycles: Vec<f64> = frame.trend.cycles().map(|cycle| cycle.cycle).collect();
    let contact: Vec<f64> = frame
        .trend
        .cycles()
        .map(|cycle| cycle.contact_radius)
        .collect();
    let stick: Vec<f64> = frame
        .trend
        .cycles()
        .map(|cycle| cycle.stick_radius)
        .collect();
    let end = cycles.last().copied().unwrap_or(0.0).max(1.0);
    let ends = [0.0, end];
    let mut plot = plot(
        Panel::Radii,
        app,
        Axis::new("cycles", "").bounds([0.0, end]),
        Axis::new("radius", "m"),
    )
    .curve(curve("contact a", &cycles, &contact, theme, Role::Contact));
    if stick.iter().any(|radius| radius.is_finite()) {
        plot = plot.curve(curve("stick c", &cycles, &stick, theme, Role::Stick).dashed());
    }
    let theory = app.theory_of(frame).and_then(|theory| theory.stick_radius);
    let line = theory.map(|radius| [radius; 2]);
    if let Some(line) = &line {
        plot = plot.curve(curve("theory c", &ends, line, theme, Role::Limit));
    }
    plot.render(area, buffer);
}

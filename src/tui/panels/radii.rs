//! The largest contact radius and the smallest stick radius of every cycle.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;

use super::{App, Frame, Panel, curve, cycles_shown, ghosts, over_cycles, series};
use crate::plot::Axis;
use crate::studies::ghost::Axes;
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
        .chain(ghosts::ordinates(&ghosts(frame)))
        .collect()
}

/// Contact radii, and below them stick radii, which need no name.
fn ghosts(frame: &Frame) -> Vec<ghosts::Line> {
    let mut lines = ghosts::on(frame, Axes::Contact, 1.0);
    let stick = ghosts::on(frame, Axes::Stick, 1.0).into_iter();
    lines.extend(stick.map(ghosts::Line::nameless));
    lines
}

/// Draws the panel.
pub fn draw(frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
    let theme = &app.theme;
    let (cycles, contact) = series(frame, |entry| entry.contact_radius);
    let stick = series(frame, |entry| entry.stick_radius).1;
    let ends = cycles_shown(frame);
    let mut ghosts = ghosts(frame);
    let mut plot = over_cycles(Panel::Radii, frame, app, Axis::new("radius", "m"))
        .curves(ghosts::curves(&mut ghosts, app))
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

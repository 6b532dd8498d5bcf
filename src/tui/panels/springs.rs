//! The 1D profile g(x) against the depth to which it is pressed: springs touch where g is less.

use super::{App, Frame, Panel, curve, edge_marks, ghosts, radial_plot};
use crate::plot::Plot;
use crate::studies::ghost::Axes;
use crate::tui::theme::Role;

/// What the ordinate must hold.
pub fn ordinates(frame: &Frame) -> Vec<f64> {
    let seen = &frame.observation;
    seen.profile_1d
        .iter()
        .copied()
        .chain((!seen.profile_1d.is_empty()).then_some(seen.moment.depth))
        .chain(ghosts::ordinates(&ghosts::on(frame, Axes::Springs, 1.0)))
        .collect()
}

/// Makes the plot and hands it to `then`.
pub fn plotted<T>(frame: &Frame, app: &App, then: impl FnOnce(&Plot<'_>) -> T) -> T {
    let (seen, theme) = (&frame.observation, &app.theme);
    let ends = [0.0, seen.radii.last().copied().unwrap_or(0.0)];
    let depth = [seen.moment.depth; 2];
    let mut ghosts = ghosts::on(frame, Axes::Springs, 1.0);
    let mut plot = radial_plot(Panel::Springs, app, frame, "x", ("g", "m"))
        .curve(curve("depth d", &ends, &depth, theme, Role::Contact).dashed())
        .curves(ghosts::curves(&mut ghosts, app))
        .curve(curve(
            "g",
            &seen.radii,
            &seen.profile_1d,
            theme,
            Role::Profile1d,
        ));
    for mark in edge_marks(frame, theme) {
        plot = plot.mark(mark);
    }
    then(&plot)
}

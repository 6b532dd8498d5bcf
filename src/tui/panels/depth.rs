//! The worn depth f − f₀ over the radius.

use super::{App, Frame, Panel, curve, edge_marks, ghosts, radial_plot, zones};
use crate::plot::{Band, Plot, Scale};
use crate::tui::theme::Role;

/// What the ordinate must hold.
pub fn ordinates(frame: &Frame) -> Vec<f64> {
    let ghosts = ghosts::ordinates(&ghosts::worn(frame, None));
    [frame.observation.wear.clone(), ghosts].concat()
}

/// Makes the plot and hands it to `then`.
pub fn plotted<T>(frame: &Frame, app: &App, then: impl FnOnce(&Plot<'_>) -> T) -> T {
    let (seen, theme) = (&frame.observation, &app.theme);
    let zones = zones(frame, theme);
    let limit: Vec<f64> = app
        .theory_of(frame)
        .and_then(|theory| theory.limiting_profile(&seen.radii))
        .map(|limit| {
            limit
                .iter()
                .zip(&*seen.unworn)
                .map(|(f, f0)| f - f0)
                .collect()
        })
        .unwrap_or_default();
    let mut plot = radial_plot(Panel::Depth, app, frame, "r", ("f - f0", "m"));
    if !limit.is_empty() {
        plot = plot.curve(curve("limit", &seen.radii, &limit, theme, Role::Limit).dashed());
    }
    let now = curve("worn", &seen.radii, &seen.wear, theme, Role::Profile);
    // Without a base on a log axis, the area would reach for minus infinity.
    let now = match app.scale(Panel::Depth) {
        Scale::Linear => now.fill_to(0.0),
        Scale::Log => now,
    };
    let mut ghosts = ghosts::worn(frame, None);
    plot = plot.curves(ghosts::curves(&mut ghosts, app));
    plot = plot.curve(now).band(Band { zones: &zones });
    for mark in edge_marks(frame, theme) {
        plot = plot.mark(mark);
    }
    then(&plot)
}

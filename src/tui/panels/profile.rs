//! The 3D profile f(r), worn and unworn, with the zones of the contact under it.

use super::{App, Frame, Panel, curve, edge_marks, radial_plot, zones};
use crate::tui::plot::{Band, Plot};
use crate::tui::theme::Role;

/// What the ordinate must hold.
pub fn ordinates(frame: &Frame) -> Vec<f64> {
    let seen = &frame.observation;
    if seen.profile.is_empty() {
        return Vec::new();
    }
    seen.unworn.iter().chain(&seen.profile).copied().collect()
}

/// Makes the plot and hands it to `then`.
pub fn plotted<T>(frame: &Frame, app: &App, then: impl FnOnce(&Plot<'_>) -> T) -> T {
    let (seen, theme) = (&frame.observation, &app.theme);
    let zones = zones(frame, theme);
    let limit = app
        .theory_of(frame)
        .and_then(|theory| theory.limiting_profile(&seen.radii))
        .unwrap_or_default();
    let mut plot = radial_plot(Panel::Profile, app, frame, "r", ("f", "m"))
        .curve(curve("unworn", &seen.radii, &seen.unworn, theme, Role::Unworn).dashed());
    if !limit.is_empty() {
        plot = plot.curve(curve("limit", &seen.radii, &limit, theme, Role::Limit).dashed());
    }
    plot = plot
        .curve(curve(
            "now",
            &seen.radii,
            &seen.profile,
            theme,
            Role::Profile,
        ))
        .band(Band { zones: &zones });
    for mark in edge_marks(frame, theme) {
        plot = plot.mark(mark);
    }
    then(&plot)
}

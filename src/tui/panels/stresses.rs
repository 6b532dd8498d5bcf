//! Pressure p(r) and shear stress τ(r). τ is drawn as τ/μ: it meets ±p where the contact slips.

use super::{App, Frame, Panel, curve, edge_marks, ghosts, radial_plot};
use crate::plot::{Plot, Scale};
use crate::studies::ghost::Axes;
use crate::tui::theme::Role;

/// τ/μ; empty without friction or tangential motion.
fn scaled_shear(frame: &Frame, scale: Scale) -> Vec<f64> {
    if frame.friction == 0.0 || frame.observation.moment.stick_radius.is_none() {
        return Vec::new();
    }
    // A logarithmic ordinate shows the size of τ.
    let sign = |shear: f64| {
        if scale == Scale::Log {
            shear.abs()
        } else {
            shear
        }
    };
    frame
        .observation
        .shear
        .iter()
        .map(|&shear| sign(shear) / frame.friction)
        .collect()
}

/// Pressures, and below them shear stresses in the scale of those of the run, which need no name.
fn ghosts(frame: &Frame, scale: Scale) -> Vec<ghosts::Line> {
    let mut lines = ghosts::on(frame, Axes::Pressure, 1.0);
    if frame.friction > 0.0 && frame.observation.moment.stick_radius.is_some() {
        let shear = ghosts::on(frame, Axes::Shear, 1.0 / frame.friction).into_iter();
        let shear = shear.map(ghosts::Line::nameless);
        lines.extend(shear.map(|line| match scale {
            Scale::Log => line.sizes(),
            Scale::Linear => line,
        }));
    }
    lines
}

/// What the ordinate must hold.
pub fn ordinates(frame: &Frame) -> Vec<f64> {
    let mut values = frame.observation.pressure.clone();
    values.extend(scaled_shear(frame, Scale::Linear));
    values.extend(ghosts::ordinates(&ghosts(frame, Scale::Linear)));
    values
}

/// Makes the plot and hands it to `then`.
pub fn plotted<T>(frame: &Frame, app: &App, then: impl FnOnce(&Plot<'_>) -> T) -> T {
    let (seen, theme) = (&frame.observation, &app.theme);
    let scale = app.scale(Panel::Stresses);
    let shear = scaled_shear(frame, scale);
    let name = match (theme.ascii(), scale) {
        (true, Scale::Linear) => "tau/mu",
        (true, Scale::Log) => "|tau|/mu",
        (false, Scale::Linear) => "τ/μ",
        (false, Scale::Log) => "|τ|/μ",
    };
    let theory = app.theory_of(frame);
    let hertz = theory
        .and_then(|theory| theory.unworn_pressure(seen.moment.depth, &seen.radii))
        .unwrap_or_default();
    let cattaneo: Vec<f64> = theory
        .and_then(|theory| theory.unworn_shear(seen.moment.cycle, seen.moment.shift, &seen.radii))
        .unwrap_or_default()
        .into_iter()
        .map(|shear| if scale == Scale::Log { shear.abs() } else { shear } / frame.friction)
        .collect();
    let mut ghosts = ghosts(frame, scale);
    let mut plot = radial_plot(Panel::Stresses, app, frame, "r", ("stress", "Pa"))
        .curves(ghosts::curves(&mut ghosts, app))
        .curve(curve(
            "p",
            &seen.radii,
            &seen.pressure,
            theme,
            Role::Pressure,
        ));
    if !shear.is_empty() {
        plot = plot.curve(
            // Dashes: where the contact slips the pressure lies under it, and is still seen.
            curve(name, &seen.radii, &shear, theme, Role::Shear).dashed(),
        );
    }
    if !hertz.is_empty() {
        plot = plot.curve(curve("unworn p", &seen.radii, &hertz, theme, Role::Limit).dashed());
    }
    if !cattaneo.is_empty() {
        plot = plot.curve(curve("Cattaneo", &seen.radii, &cattaneo, theme, Role::Unworn).dashed());
    }
    for mark in edge_marks(frame, theme) {
        plot = plot.mark(mark);
    }
    then(&plot)
}

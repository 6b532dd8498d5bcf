//! Curves of other sources in the panels: dashes in the colour of text, each its own pattern, error bars where
//! there are any.

use super::Frame;
use crate::plot::Curve;
use crate::plot::theme::Role;
use crate::studies::ghost::{Axes, Ghost};

/// What one ghost gives for a panel: abscissae, ordinates, and errors if there are any.
type Points = (Vec<f64>, Vec<f64>, Option<Vec<f64>>);

/// The curves of all ghosts that `of` finds points in.
fn curves(frame: &Frame, of: impl Fn(&Ghost) -> Option<Points>) -> Vec<Curve> {
    let ghosts = frame.ghosts.iter().enumerate();
    let curves = ghosts.filter_map(|(k, ghost)| {
        let (xs, ys, errors) = of(ghost)?;
        let curve = Curve::new(ghost.name.clone(), xs, ys, Role::Ghost(k));
        Some(curve.scattered(errors.unwrap_or_default()))
    });
    curves.collect()
}

/// The curves of the traces on `axes`, each ordinate times `factor`.
pub(super) fn on(frame: &Frame, axes: Axes, factor: f64) -> Vec<Curve> {
    curves(frame, |ghost| {
        let trace = ghost.trace(axes)?;
        let scaled = |values: &Vec<f64>| values.iter().map(|value| factor * value).collect();
        let errors = trace.errors.as_ref().map(scaled);
        Some((trace.xs.clone(), scaled(&trace.ys), errors))
    })
}

/// The curves of the wear, magnified by `times` on top of the unworn profile; `None` draws the wear alone.
pub(super) fn worn(frame: &Frame, times: Option<f64>) -> Vec<Curve> {
    curves(frame, |ghost| {
        let worn = ghost.worn(|r| frame.indenter.profile(r))?;
        let drawn = worn.unworn.iter().zip(&worn.wear);
        let ys = drawn.map(|(f0, wear)| times.map_or(*wear, |times| f0 + times * wear));
        let ys = ys.collect();
        let scaled = |error: f64| times.unwrap_or(1.0) * error;
        let errors = worn
            .errors
            .map(|errors| errors.into_iter().map(scaled).collect());
        Some((worn.radii, ys, errors))
    })
}

/// The curves of how much more or less the ghosts are worn than this run, m, in absolute values.
pub(super) fn differences(frame: &Frame) -> Vec<Curve> {
    curves(frame, |ghost| {
        let worn = ghost.worn(|r| frame.indenter.profile(r))?;
        let points = worn.radii.iter().zip(&worn.wear);
        let ys = points.map(|(&r, wear)| (wear - frame.observation.worn_depth_at(r)).abs());
        let ys = ys.collect();
        Some((worn.radii, ys, None))
    })
}

/// The last cycle that ghosts tell of.
pub(super) fn end(frame: &Frame) -> f64 {
    let over_cycles = [Axes::Volume, Axes::Depth, Axes::Contact, Axes::Stick];
    let traces = frame.ghosts.iter().flat_map(|ghost| ghost.traces());
    let traces = traces.filter(|trace| over_cycles.contains(&trace.axes));
    traces
        .filter_map(|trace| trace.xs.last().copied())
        .fold(0.0, f64::max)
}

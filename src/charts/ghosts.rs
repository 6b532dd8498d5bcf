//! Overlaid curves from other sources. On a screen they are dashed in the text colour, each with a different pattern;
//! measured ones have error bars if their errors are known.

use crate::charts::run::Run;
use crate::plot::Curve;
use crate::plot::theme::Role;
use crate::studies::ghost::Ghost;
use crate::traces::Axes;

/// What one ghost adds to a chart: abscissae, ordinates, errors (empty if unknown), and the values that a cursor reads
/// (empty if they equal the ordinates).
type Points = (Vec<f64>, Vec<f64>, Vec<f64>, Vec<f64>);

/// Returns a curve for every ghost in which `of` finds points.
fn curves(run: &Run, of: impl Fn(&Ghost) -> Option<Points>) -> Vec<Curve> {
    let ghosts = run.ghosts.iter().enumerate();
    let curves = ghosts.filter_map(|(k, ghost)| {
        let (xs, ys, errors, true_values) = of(ghost)?;
        let mut curve = Curve::new(ghost.name.clone(), xs, ys, Role::Ghost(k));
        curve.true_values = true_values;
        Some(if ghost.is_measured {
            curve.scattered(errors)
        } else {
            curve.dashed()
        })
    });
    let is_there = |curve: &Curve| curve.ys.iter().any(|y| y.is_finite());
    curves.filter(is_there).collect()
}

/// Returns the ghosts' curves on `axes`.
pub fn curves_on(run: &Run, axes: Axes) -> Vec<Curve> {
    curves(run, |ghost| {
        let trace = ghost.trace(axes)?;
        let errors = trace.errors.unwrap_or_default();
        let [xs, ys, errors] = [trace.xs, trace.ys, errors].map(<[f64]>::to_vec);
        Some((xs, ys, errors, Vec::new()))
    })
}

/// Returns the ghosts' curves on both pairs of axes, the second ones modified by `change`. Each ghost has one legend
/// entry.
pub(super) fn both(run: &Run, axes: [Axes; 2], change: impl Fn(&mut Curve)) -> Vec<Curve> {
    let [mut curves, mut second] = axes.map(|axes| curves_on(run, axes));
    for curve in &mut second {
        if curves.iter().any(|other| other.role == curve.role) {
            curve.name.clear();
        }
        change(curve);
    }
    curves.append(&mut second);
    curves
}

/// Returns the ghosts' wear, magnified by `times` on top of the unworn profile, or alone if `times` is `None`.
pub fn worn(run: &Run, times: Option<f64>) -> Vec<Curve> {
    curves(run, |ghost| {
        let worn = ghost.worn(|r| run.unworn(r))?;
        let drawn = |times: Option<f64>| -> Vec<f64> {
            let pairs = worn.unworn.iter().zip(&worn.wear);
            let ys = pairs.map(|(f0, wear)| times.map_or(*wear, |times| f0 + times * wear));
            ys.collect()
        };
        let (ys, true_values) = (drawn(times), drawn(times.map(|_| 1.0)));
        let scaled = |error: f64| times.unwrap_or(1.0) * error;
        let errors = worn.errors.into_iter().flatten().map(scaled).collect();
        Some((worn.radii, ys, errors, true_values))
    })
}

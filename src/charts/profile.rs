//! The 3D profile f(r), worn and unworn, with the zones of the contact below it. Wear that would be thinner than a line
//! is drawn magnified.

use super::{
    A, BAND, C, Medium, NO_STATE, Recipe, View, ghosts, limit, magnification, of_states, over_r,
};
use crate::charts::run::Run;
use crate::math::scan::largest;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve};
use crate::reading::{Column, Curves};
use crate::traces::Axes;

/// The chart.
pub static RECIPE: Recipe = Recipe {
    name: "profile",
    title: "3D profile",
    can_be_log: true,
    needs: Curves::PROFILE,
    overlays: &[Axes::WEAR, Axes::PROFILE],
    text: "The shape of the indenter against the radius, unworn and worn. Wear thinner than a line is drawn \
           magnified, by one factor for the whole run that the legend tells. It begins where surfaces slide \
           under pressure: in the ring between c and a. The band below tells what sticks at the moment: all, \
           whenever the motion reverses.",
    symbols: &[("f", "height of the profile over its tip"), A, C, BAND],
    ..Recipe::new(make)
};

/// Maximum height of the magnified wear, relative to the height of the unworn profile.
const SHARE: f64 = 0.9;

/// Wear below this share of the unworn profile's height is shown in a separate inset on paper.
const HIDDEN: f64 = 0.25;

/// Returns the height of the `unworn` profile over the domain, m, ignoring the infinite values beyond the rim of a
/// punch.
fn height(unworn: &[f64], depth: f64) -> f64 {
    let finite = unworn.iter().copied().filter(|f| f.is_finite());
    let height = finite.fold(0.0, f64::max);
    // A flat punch has no height, so its wear is scaled to the depth.
    if height > 0.0 { height } else { depth.abs() }
}

/// Returns the magnification of the wear on a screen. It stays the same from the first cycle to the planned end, so
/// that growing wear is seen to grow; it drops only if there is more wear than expected.
fn times(run: &Run, view: &View, unworn: &[f64], wear: &[f64]) -> f64 {
    let Some(live) = view.live() else {
        return 1.0;
    };
    let ghosts = ghosts::worn(run, None);
    let seen = largest(wear).max(live.expected_wear);
    let deepest = ghosts.iter().map(Curve::highest).fold(seen, f64::max);
    magnification(
        deepest,
        SHARE * height(unworn, live.observation.moment.depth),
    )
}

fn make(run: &Run, view: &View) -> Result<Chart, &'static str> {
    let state = run.states.last().ok_or(NO_STATE)?;
    let column = |name| state.column(name).unwrap_or_default();
    let (radii, unworn, wear) = (
        column(Column::Radius),
        column(Column::Unworn),
        column(Column::Wear),
    );
    let mut chart = over_r(view, "r", ("f", "m"));
    let times = times(run, view, unworn, wear);
    let worn = match view.medium {
        Medium::Screen(_) => {
            let nodes = unworn.iter().zip(wear);
            let shown: Vec<f64> = nodes.map(|(f0, wear)| f0 + times * wear).collect();
            let curve = Curve::new("worn", radii, shown, Role::Profile);
            vec![
                curve
                    .magnified(times, column(Column::Profile))
                    .filled(unworn),
            ]
        }
        Medium::Paper => {
            // What a page hides in the profile: wear that is seen there would lie under its inset.
            let (r, depth) = (Axis::new("r", "m"), Axis::new("worn depth", "m"));
            let inset = of_states(run, Column::Wear, "", Role::Profile);
            let deepest = inset.iter().map(Curve::highest).fold(0.0, f64::max);
            let is_hidden = deepest > 0.0 && deepest < HIDDEN * height(unworn, 0.0);
            let inset = Chart::new("", r, depth).curves(inset);
            chart.inset = is_hidden.then(|| Box::new(inset));
            of_states(run, Column::Profile, "worn", Role::Profile)
        }
    };
    chart.band = view.zones(run.edge());
    let theory = view.theory(run).or(view.pick(None, run.theory.as_deref()));
    // Unworn curves come first, so that the worn ones lie on top.
    Ok(chart
        .curve(Curve::new("unworn", radii, unworn, Role::Unworn).dashed())
        .curves(limit(run, theory, Some(times)))
        .curves(ghosts::worn(run, Some(times)))
        .curves(worn))
}

//! The 1D profile g(x) and the indentation depth d: springs are in contact where g < d.

use super::{A, C, NO_STATE, Recipe, View, ghosts, of_states, over_r};
use crate::charts::run::Run;
use crate::plot::theme::Role;
use crate::plot::{Chart, Curve};
use crate::reading::{Column, Curves};
use crate::traces::Axes;

/// The chart.
pub static RECIPE: Recipe = Recipe {
    name: "profile-1d",
    title: "1D profile",
    needs: Curves::PROFILE_1D,
    overlays: &[Axes::SPRINGS],
    text: "The method replaces the 3D contact with a row of independent springs, and the shape f with its 1D \
           image g. A spring at x touches where g(x) is below the depth d. The contact force is exactly the \
           sum of the spring forces.",
    symbols: &[("g", "1D profile"), ("d", "indentation depth"), A, C],
    ..Recipe::new(make)
};

fn make(run: &Run, view: &View) -> Result<Chart, &'static str> {
    run.states.last().ok_or(NO_STATE)?;
    let depth = view.live().map(|live| {
        let (ends, depth) = ([0.0, run.edge()], [live.observation.moment.depth; 2]);
        Curve::new("depth d", ends, depth, Role::Contact).dashed()
    });
    let springs = of_states(run, Column::Profile1d, view.pick("g", ""), Role::Profile);
    Ok(over_r(view, "x", ("g", "m"))
        .curves(depth)
        .curves(ghosts::curves_on(run, Axes::SPRINGS))
        .curves(springs))
}

//! The largest worn depth over cycles.

use super::{NO_STATE, Recipe, Subject, View, ghosts, over_cycles, series};
use crate::charts::run::Run;
use crate::math::scan::largest;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve};
use crate::reading::Column;
use crate::traces::Axes;

/// The chart.
pub static RECIPE: Recipe = Recipe {
    name: "scar-depth",
    title: "depth over cycles",
    can_be_log: true,
    is_calm: true,
    subject: Subject::Wear,
    overlays: &[Axes::DEPTH],
    history: &[Column::ScarDepth],
    text: "The largest worn depth of the profile over cycles: what a profilometer reads in the deepest point \
           of the scar. Measured depths lie over it with --overlay.",
    symbols: &[("depth", "largest f - f0 over the radius")],
    ..Recipe::new(make)
};

/// Returns the largest worn depth of every state, for histories that did not record it.
fn of_states(run: &Run) -> Option<Curve> {
    let deepest = run
        .states
        .iter()
        .map(|state| Some((state.cycle(), largest(state.column(Column::Wear)?))));
    let (cycles, depths): (Vec<f64>, Vec<f64>) = deepest.flatten().unzip();
    let curve = Curve::new("simulated", cycles, depths, Role::Profile);
    Some(curve.scattered([])).filter(|curve| !curve.xs.is_empty())
}

fn make(run: &Run, view: &View) -> Result<Chart, &'static str> {
    view.wears()?;
    let depth = series(run, view, Column::ScarDepth, "", Role::Profile).ok();
    let depth = depth.or_else(|| of_states(run)).ok_or(NO_STATE)?;
    let ordinate = Axis::new(view.pick("depth", "worn depth"), "m")
        .from_zero()
        .expecting(view.expected_wear());
    Ok(over_cycles(run, view, ordinate)
        .curves(ghosts::curves_on(run, Axes::DEPTH))
        .curve(depth))
}

//! The worn depth f − f₀ over the radius.

use super::{A, BAND, C, NO_STATE, Recipe, Subject, View, ghosts, limit, of_states, over_r};
use crate::charts::run::Run;
use crate::plot::theme::Role;
use crate::plot::{Chart, Curve};
use crate::reading::{Column, Curves};
use crate::traces::Axes;

/// The chart.
pub static RECIPE: Recipe = Recipe {
    name: "worn-depth",
    title: "worn depth",
    can_be_log: true,
    needs: Curves::PROFILE,
    subject: Subject::Wear,
    overlays: &[Axes::WEAR, Axes::PROFILE],
    text: "How much has worn off, against the radius. Inside the permanent stick zone it is zero; the ring \
           outside it grows towards the limiting shape (t) if the depth is held.",
    symbols: &[("f - f0", "worn depth"), A, C, BAND],
    ..Recipe::new(make)
};

fn make(run: &Run, view: &View) -> Result<Chart, &'static str> {
    run.states.last().ok_or(NO_STATE)?;
    let mut worn = of_states(run, Column::Wear, view.pick("worn", ""), Role::Profile);
    let mut chart = over_r(view, "r", (view.pick("f - f0", "worn depth"), "m"));
    chart.band = view.zones(run.edge());
    chart.y.expects = view.expected_wear();
    if view.is_on_screen() {
        chart.y.holds = Some(0.0);
        let shade = |curve: &mut Curve| curve.fill = vec![0.0; curve.xs.len()];
        worn.iter_mut().for_each(shade);
    }
    Ok(chart
        .curves(limit(run, view.theory(run), None))
        .curves(ghosts::worn(run, None))
        .curves(worn))
}

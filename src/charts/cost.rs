//! Time per step on this machine, over complete cycles.

use super::{Recipe, View, finished_series, over_cycles};
use crate::charts::run::Run;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart};
use crate::reading::Column;

/// The chart.
pub static RECIPE: Recipe = Recipe {
    title: "time per step",
    can_be_log: true,
    has_spikes: true,
    is_calm: true,
    history: &[Column::StepCost],
    text: "How long one step of the simulation takes on this machine.",
    symbols: &[("t", "time per step")],
    ..Recipe::new(make)
};

fn make(run: &Run, view: &View) -> Result<Chart, &'static str> {
    let cost = finished_series(run, view, Column::StepCost, Role::Shear)?;
    if !cost.ys.iter().any(|value| value.is_finite()) {
        return Err("measured while it runs");
    }
    Ok(over_cycles(run, view, Axis::new("t", "s").from_zero()).curve(cost))
}

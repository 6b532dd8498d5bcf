//! Wear volume V over cycles. V = k E_d from the friction work would differ by less than the width of a line; the panel
//! next to it shows the difference.

use super::{E_D, Recipe, Subject, V, View, ghosts, over_cycles, series};
use crate::charts::run::Run;
use crate::plot::theme::Role;
use crate::plot::units::format_value;
use crate::plot::{Axis, Chart};
use crate::reading::Column;
use crate::traces::Axes;

/// The chart.
pub static RECIPE: Recipe = Recipe {
    name: "volume",
    title: "wear volume",
    can_be_log: true,
    is_calm: true,
    subject: Subject::Wear,
    overlays: &[Axes::VOLUME],
    history: &[Column::WearVolume],
    text: "The wear volume since the start. It grows by k times the energy that friction dissipates.",
    symbols: &[V, E_D],
    ..Recipe::new(make)
};

fn make(run: &Run, view: &View) -> Result<Chart, &'static str> {
    view.wears()?;
    let volume = series(run, view, Column::WearVolume, "", Role::Profile)?;
    let ordinate = Axis::new("V", "m³").from_zero();
    let mut chart = over_cycles(run, view, ordinate.expecting(view.expected_volume()));
    if let Some(live) = view.live() {
        let work = format_value(live.observation.moment.dissipated_energy, "J", 4);
        chart.note = format!("E_d {work}");
    }
    Ok(chart
        .curves(ghosts::curves_on(run, Axes::VOLUME))
        .curve(volume))
}

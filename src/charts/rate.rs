//! Worn volume per cycle, over cycles. The incomplete cycle is left out: a cycle wears mostly in a part of it, so a
//! rate over less than a cycle means little.

use super::{Recipe, Subject, View, finished_series, over_cycles};
use crate::charts::{Live, Run};
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart};
use crate::reading::Column;
use crate::traces::Axes;

/// The chart.
pub static RECIPE: Recipe = Recipe {
    title: "wear rate",
    can_be_log: true,
    has_spikes: true,
    is_calm: true,
    subject: Subject::Wear,
    overlays: &[Axes::VOLUME],
    history: &[Column::WearVolume],
    text: "The wear volume of each cycle. It falls as the ring wears free of load, and stays up if a force \
           keeps pressing the indenter in.",
    symbols: &[("V per cycle", "wear volume of one cycle")],
    ..Recipe::new(make)
};

fn make(run: &Run, view: &View) -> Result<Chart, &'static str> {
    view.wears()?;
    let mut rate = finished_series(run, view, Column::WearVolume, Role::Profile)?;
    let initial = view
        .live()
        .map_or(0.0, |live| live.observation.moment.initial_volume);
    let points = rate.xs.iter().copied().zip(rate.ys.iter().copied());
    let before = [(0.0, initial)].into_iter().chain(points.clone());
    let rates = points
        .zip(before)
        .map(|((n, volume), (n0, volume0))| (volume - volume0) / (n - n0));
    rate.ys = rates.collect();
    let cycles = view.live().and_then(Live::planned_cycles);
    let expected = view.expected_volume() / cycles.unwrap_or(1.0);
    let ordinate = Axis::new("V per cycle", "m³")
        .from_zero()
        .expecting(expected);
    Ok(over_cycles(run, view, ordinate).curve(rate))
}

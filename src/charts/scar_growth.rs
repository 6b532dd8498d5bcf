//! The scar's radius and depth over the friction work: what a profilometer and the fretting loops of a test measure.

use super::{
    E_D, NO_CYCLE, NO_HISTORY, Recipe, Subject, View, cycles_shown, ghosts, magnification,
};
use crate::charts::run::Run;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve, Scale};
use crate::reading::Column;
use crate::traces::Axes;

/// The chart.
pub static RECIPE: Recipe = Recipe {
    name: "scar-growth",
    title: "scar over friction work",
    can_be_log: true,
    keeps_abscissa: true,
    is_calm: true,
    subject: Subject::Wear,
    overlays: &[DEPTH, RADIUS],
    history: &[
        Column::DissipatedEnergy,
        Column::ScarRadius,
        Column::ScarDepth,
    ],
    text: "The outer radius of the wear scar and its depth over the energy that friction has dissipated. At \
           first the ring deepens where it is; then it grows outwards, and the depth per energy falls. The \
           depth is drawn magnified by the factor in the legend, which a logarithmic scale does not need.",
    symbols: &[
        E_D,
        ("radius", "outermost radius that has worn"),
        ("depth", "largest f - f0 over the radius"),
    ],
    ..Recipe::new(make)
};

/// The columns.
const DEPTH: Axes = Axes::new(Column::DissipatedEnergy, Column::ScarDepth);
const RADIUS: Axes = Axes::new(Column::DissipatedEnergy, Column::ScarRadius);

/// Extrapolates the friction work, J, to the last cycle that charts show, at the mean rate so far.
fn shown_work(run: &Run, view: &View) -> Option<f64> {
    let [cycles, work] = view.over_cycles(run, [Column::Cycle, Column::DissipatedEnergy])?;
    let (cycle, done) = (*cycles.last()?, *work.last()?);
    let [_, end] = cycles_shown(run, view)?;
    (cycle >= 1.0).then(|| done * (end / cycle).max(1.0))
}

fn make(run: &Run, view: &View) -> Result<Chart, &'static str> {
    view.wears()?;
    let columns = [
        Column::DissipatedEnergy,
        Column::ScarRadius,
        Column::ScarDepth,
    ];
    let columns = view.over_cycles(run, columns);
    let [work, radii, depths] = columns.ok_or(NO_HISTORY)?;
    let radius = Curve::new("radius", work.clone(), radii, Role::Contact);
    let expected = view.expected_wear();
    let deepest = depths.iter().copied().fold(expected, f64::max);
    let times = match view.scale {
        Scale::Linear => magnification(deepest, radius.highest()),
        Scale::Log => 1.0,
    };
    let drawn: Vec<f64> = depths.iter().map(|depth| times * depth).collect();
    let depth = Curve::new("depth", work, drawn, Role::Profile);
    let others = ghosts::both(run, [RADIUS, DEPTH], |curve| {
        curve.true_values.clone_from(&curve.ys);
        curve.scale(|depth| times * depth);
    });
    let (mut work_axis, axis) = (Axis::new("E_d", "J").from_zero(), Axis::new("scar", "m"));
    let mut reach = 0.0;
    if let Some(live) = view.live() {
        reach = live.observation.moment.contact_radius;
        let of_others = others.iter().flat_map(|ghost| &ghost.xs).copied();
        let end = of_others.fold(shown_work(run, view).ok_or(NO_CYCLE)?, f64::max);
        work_axis = work_axis.bounds([0.0, end]);
    }
    Ok(Chart::new("", work_axis, axis.from_zero().expecting(reach))
        .curves(others)
        .curve(radius.dashed())
        .curve(depth.magnified(times, depths)))
}

//! The scar's radius and depth over the work of friction: what a profilometer and a loop give of a test.

use super::{NO_HISTORY, Recipe, Run, View, Words, ghosts, magnification};
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve, Scale};
use crate::traces::Axes;

/// The chart.
pub static RECIPE: Recipe = Recipe {
    name: "scar-growth",
    title: "scar over friction work",
    can_be_log: true,
    is_calm: true,
    overlays: &[DEPTH, RADIUS],
    words: Words {
        text: "The outer radius of the wear scar and its depth over the energy that friction has dissipated. At \
               first the ring deepens where it is; then it grows outwards, and the depth per energy falls. The \
               depth is drawn magnified by the factor in the legend, which a logarithmic scale does not need.",
        symbols: &[
            ("E_d", "energy lost to friction since the start"),
            ("radius", "outermost radius that has worn"),
            ("depth", "largest f - f0 over the radius"),
        ],
    },
    ..Recipe::new(make)
};

/// The columns.
const DEPTH: Axes = Axes::new("dissipated_energy_J", "scar_depth_m", "depth");
const RADIUS: Axes = Axes::new("dissipated_energy_J", "scar_radius_m", "radius");

fn make(run: &Run, view: &View) -> Result<Chart, &'static str> {
    run.wears()?;
    let columns = run.over_cycles(["dissipated_energy_J", "scar_radius_m", "scar_depth_m"]);
    let [work, radii, mut depths] = columns.ok_or(NO_HISTORY)?;
    let radius = Curve::new("radius", work.clone(), radii, Role::Contact);
    let expected = run.expected_wear();
    let deepest = depths.iter().copied().fold(expected, f64::max);
    let times = match view.scale {
        Scale::Linear => magnification(deepest, radius.highest()),
        Scale::Log => 1.0,
    };
    depths.iter_mut().for_each(|depth| *depth *= times);
    let name = match times {
        1.0 => "depth".to_owned(),
        times => format!("depth ×{times}"),
    };
    let mut others = ghosts::both(run, [DEPTH, RADIUS]);
    for (_, ghost) in others.iter_mut().filter(|(axes, _)| *axes == DEPTH) {
        ghost.ys.iter_mut().for_each(|depth| *depth *= times);
    }
    let (work_axis, axis) = (Axis::new("E_d", "J").from_zero(), Axis::new("scar", "m"));
    let reach = run
        .live
        .as_ref()
        .map_or(0.0, |live| live.moment.contact_radius);
    Ok(Chart::new("", work_axis, axis.from_zero().expecting(reach))
        .curves(others.into_iter().map(|(_, ghost)| ghost))
        .curve(radius.dashed())
        .curve(Curve::new(name, work, depths, Role::Profile)))
}

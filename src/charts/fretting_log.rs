//! The fretting log: loops of F_x over u_x from earlier cycles and the last one, each drawn at the height of its cycle.

use super::{F_X, NO_CYCLE, NO_MOTION, Recipe, Subject, U_X, View};
use crate::charts::run::Run;
use crate::math::scan::thinned;
use crate::plot::theme::Role;
use crate::plot::units::format_value;
use crate::plot::{Axis, Chart, Curve};
use crate::traces::Loop;

/// The chart.
pub static RECIPE: Recipe = Recipe {
    title: "fretting log",
    is_calm: true,
    subject: Subject::Motion,
    text: "The fretting loops of earlier cycles and of the last one: each stands at the cycle that it ends, and \
           its height is the tangential force, as large as the note says. Loops that grow fatter or tilt show \
           that the contact changes.",
    symbols: &[U_X, F_X],
    ..Recipe::new(make)
};

/// Maximum number of loops drawn.
const MOST: usize = 12;

/// Height of a loop, relative to the distance between neighbouring loops.
const HEIGHT: f64 = 1.6;

/// How the loops of the other log are drawn.
const OTHER: Role = Role::Ghost(0);

fn make(_: &Run, view: &View) -> Result<Chart, &'static str> {
    let live = view.live().filter(|live| live.moves());
    let log = live.ok_or(NO_MOTION)?.log.iter().map(AsRef::as_ref);
    of_logs([&log.collect::<Vec<_>>(), &[]]).ok_or(NO_CYCLE)
}

/// Draws a log of loops, and over it the loops of another one of the same cycles; `None` without a loop.
pub fn of_logs(logs: [&[&Loop]; 2]) -> Option<Chart> {
    let logs = logs.map(|log| thinned(log, MOST));
    let (first, last) = logs[0].first().zip(logs[0].last())?;
    let forces = logs.iter().flatten().flat_map(|one| &one.forces);
    let most = forces.map(|force| force.abs()).fold(0.0, f64::max);
    let apart = ((last.end - first.end) / (logs[0].len() - 1).max(1) as f64).max(1.0);
    let height = 0.5 * HEIGHT * apart;
    let scale = if most > 0.0 { height / most } else { 0.0 };
    let bounds = [(first.end - height).min(0.0), last.end + height];
    let cycles = Axis::new("cycle", "").bounds(bounds);
    let mut chart = Chart::new("", Axis::new("u_x", "m"), cycles);
    chart.note = format!("F_x up to {}", format_value(most, "N", 3));
    let [newest, others] = [Role::Shear, Role::Unworn];
    for (log, last_role, role) in [(&logs[0], newest, others), (&logs[1], OTHER, OTHER)] {
        // Draws the newest loop last, on top of the others.
        chart = chart.curves(log.iter().enumerate().map(|(k, one)| {
            let heights = one.forces.iter().map(|force| one.end + scale * force);
            let role = if k + 1 == log.len() { last_role } else { role };
            let heights: Vec<f64> = heights.collect();
            let mut curve = Curve::new("", one.shifts.clone(), heights, role);
            curve.true_values.clone_from(&one.forces);
            curve
        }));
    }
    Some(chart)
}

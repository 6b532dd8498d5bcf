//! The fretting loop: tangential force over displacement in the last cycle. Its area is the energy that the cycle
//! dissipates. An arrow marks the present moment and its direction. On a compliant rig the loop that its sensor sees is
//! drawn too; it has the same forces and the same area as the contact's loop.

use super::{F_X, NO_MOTION, Recipe, Subject, U_X, View, ghosts, state_name};
use crate::charts::{Live, Run};
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve, Point};
use crate::traces::{Axes, Loop};

/// The chart.
pub static RECIPE: Recipe = Recipe {
    name: "loop",
    title: "fretting loop",
    keeps_abscissa: true,
    subject: Subject::Motion,
    overlays: &[Axes::LOOP],
    text: "Tangential force against tangential displacement in the last cycle. The area inside is the energy \
           lost to friction. A line means full stick, a thin loop partial slip, a parallelogram with flat ends \
           gross slip. The arrow marks the present moment.",
    symbols: &[U_X, F_X],
    ..Recipe::new(make)
};

/// Free space on both sides of a loop on paper, relative to its width.
const MARGIN: f64 = 0.05;

/// Returns the range of the values, made symmetric about zero if they lie on both sides of it.
fn symmetric<'a>(values: impl Iterator<Item = &'a f64> + Clone) -> [f64; 2] {
    let finite = || values.clone().copied().filter(|value| value.is_finite());
    let (low, high) = (finite().fold(0.0, f64::min), finite().fold(0.0, f64::max));
    // A one-sided motion stays one-sided.
    if low < -0.1 * high && high > -0.1 * low {
        let most = high.max(-low);
        [-most, most]
    } else {
        [low, high]
    }
}

/// Returns the loop before each state of a run, or the last loop if there are no states. On a compliant rig, the
/// sensor's loop comes before the contact's.
fn loops(run: &Run, view: &View) -> Vec<Curve> {
    let ends: Vec<f64> = match &run.states[..] {
        [] => run.end().into_iter().collect(),
        states => states.iter().map(|state| state.cycle()).collect(),
    };
    let count = ends.len();
    let fewest = view.pick(1, Loop::SHORTEST);
    let mut curves = Vec::new();
    for (k, end) in ends.into_iter().enumerate() {
        let one = run.loop_at(end);
        let Some(one) = one.filter(|one| one.shifts.len() >= fewest) else {
            continue;
        };
        let sensed = one.sensed.iter().zip(&one.forces);
        let sensed = sensed.filter(|(u, _)| u.is_finite());
        let (sensed, forces): (Vec<f64>, Vec<f64>) = sensed.unzip();
        let is_sensed = sensed.len() >= fewest;
        let alone = if is_sensed { "contact" } else { "" };
        let (name, role) = state_name(k, count, end, (alone, Role::Shear));
        let (sensor, of_sensor) = match count {
            1 => ("rig's sensor".to_owned(), Role::Unworn),
            _ => (format!("{name} (rig's sensor)"), role),
        };
        if is_sensed {
            let curve = Curve::new(sensor, sensed, forces, of_sensor);
            curves.push(curve.dashed_if(!view.is_on_screen()));
        }
        // The contact's loop comes last: another figure takes the last curve as its ghost.
        curves.push(Curve::new(name, one.shifts, one.forces, role));
    }
    curves
}

fn make(run: &Run, view: &View) -> Result<Chart, &'static str> {
    if view.live().is_some_and(|live| !live.moves()) {
        return Err(NO_MOTION);
    }
    let loops = loops(run, view);
    let moves = |curve: &Curve| curve.xs.iter().any(|&x| x != curve.xs[0]);
    if !view.is_on_screen() && !loops.iter().any(moves) {
        return Err(if loops.is_empty() {
            "there is no loop.csv, and the history has one row per cycle; run writes loop.csv if there is a \
             tangential motion, and run --history every-step records all loops"
        } else {
            "the indenter does not move tangentially"
        });
    }
    let mut chart = Chart::new("", Axis::new("u_x", "m"), Axis::new("F_x", "N"))
        .curves(ghosts::curves_on(run, Axes::LOOP))
        .curves(loops);
    chart.margin = MARGIN;
    if let Some(live) = view.live() {
        let across = symmetric(chart.curves.iter().flat_map(|curve| &curve.xs));
        let upwards = symmetric(chart.curves.iter().flat_map(|curve| &curve.ys));
        (chart.x.bounds, chart.y.bounds) = (Some(across), Some(upwards));
        // Leaves room for the loop under gross slip.
        let slip_per_depth = run.theory.as_ref().map(|theory| theory.slip_per_depth);
        chart.x.expects = slip_per_depth.unwrap_or(0.0) * live.observation.moment.depth;
        chart.y.expects = live.friction() * live.observation.moment.normal_force;
        chart.points.push(present_point(run, live));
    }
    Ok(chart)
}

/// Returns an arrow at the present moment.
fn present_point(run: &Run, live: &Live) -> Point {
    Point {
        at: [
            live.observation.moment.shift,
            live.observation.moment.tangential_force,
        ],
        sign: if run.loops.last().is_none_or(Loop::rises) {
            '▶'
        } else {
            '◀'
        },
        role: Role::Alarm,
    }
}

//! The running-condition map: normal load over displacement amplitude, with the border between partial and gross slip,
//! the present point and the path that it took as the contact wore.
//!
//! Gross slip begins at the amplitude u_t = max(d − g)/κ for any profile (κ = G*/(μE*)). For an unworn power-law tip,
//! depth and load give this in closed form; for a sphere, u_t ∝ N^(2/3). The second border belongs to the present, worn
//! profile and passes through the present load and u_t.

use super::{NO_CYCLE, NO_MOTION, Recipe, Subject, View};
use crate::charts::run::Run;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve, Point};
use crate::reading::{Column, Curves};

/// The chart.
pub static RECIPE: Recipe = Recipe {
    title: "running-condition map",
    needs: Curves::SPRINGS,
    subject: Subject::Motion,
    history: &[Column::ShiftAmplitude, Column::MeanNormalForce],
    text: "Load and displacement amplitude of the cycles so far. Right of the border the whole contact slips \
           in each cycle; left of it the middle sticks. The border is dashed for the unworn shape, solid for \
           the present one.",
    symbols: &[("F_z", "mean normal force of a cycle")],
    ..Recipe::new(make)
};

/// Number of points per border.
const POINTS: usize = 64;

/// The load axis reaches this many times the largest load.
const BEYOND: f64 = 1.5;

fn make(run: &Run, view: &View) -> Result<Chart, &'static str> {
    let live = view.live().filter(|live| live.moves()).ok_or(NO_MOTION)?;
    // The path so far, oldest first: m, N.
    let path = view.over_cycles(run, [Column::ShiftAmplitude, Column::MeanNormalForce]);
    let [amplitudes, loads] = path.unwrap_or_default();
    let path = amplitudes.into_iter().zip(loads);
    let known = path.filter(|(amplitude, load)| *amplitude > 0.0 && *load > 0.0);
    let (amplitudes, loads): (Vec<f64>, Vec<f64>) = known.unzip();
    let last = amplitudes.last().copied().zip(loads.last().copied());
    let (amplitude, load) = last.ok_or(NO_CYCLE)?;
    let top = BEYOND * loads.iter().copied().fold(0.0, f64::max);
    let theory = run.theory.as_deref();
    let steps = (0..=POINTS).map(|k| top * k as f64 / POINTS as f64);
    let unworn = steps.filter_map(|load| Some((theory?.gross_slip_amplitude(load)?, load)));
    let (unworn_u, unworn_load): (Vec<f64>, Vec<f64>) = unworn.unzip();
    let worn = live.slip_border.filter(|&border| border > 0.0);
    // Once wear has fixed a, the border is proportional to the load.
    let worn_u = worn.map(|border| [0.0, border * top / load]);
    let right = unworn_u.iter().chain(&amplitudes).copied();
    let right = right.chain(worn_u.map(|u| u[1])).fold(0.0, f64::max);
    let unworn = Curve::new("border, unworn", unworn_u, unworn_load, Role::Limit).dashed();
    let worn = worn_u.map(|u| Curve::new("border, now", u, [0.0, top], Role::Slip));
    let regime = live.figures.as_ref().map(|figures| figures.regime.title());
    let (name, here) = (regime.unwrap_or("now"), [[amplitude; 2], [load; 2]]);
    let mut chart = Chart::new(
        "",
        Axis::new("amplitude of u_x", "m").bounds([0.0, 1.1 * right]),
        Axis::new("F_z", "N").bounds([0.0, top]),
    )
    .curves(Some(unworn).filter(|unworn| !unworn.xs.is_empty()))
    .curves(worn)
    .curve(Curve::new("path", amplitudes, loads, Role::Unworn))
    .curve(Curve::new(name, here[0], here[1], Role::Alarm));
    chart.points.push(Point {
        at: [amplitude, load],
        sign: '●',
        role: Role::Alarm,
    });
    Ok(chart)
}

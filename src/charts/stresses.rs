//! Pressure p(r) and shear stress τ(r). On a screen τ is drawn as τ/μ, which meets ±p where the contact slips.

use super::{A, C, Medium, NO_STATE, Recipe, View, ghosts, over_r};
use crate::charts::run::Run;
use crate::plot::theme::Role;
use crate::plot::{Chart, Curve, Scale};
use crate::reading::{Column, Curves};
use crate::traces::Axes;

/// The chart.
pub static RECIPE: Recipe = Recipe {
    name: "stresses",
    title: "stresses",
    can_be_log: true,
    needs: Curves::PRESSURE.union(Curves::SHEAR),
    has_spikes: true,
    overlays: &[Axes::PRESSURE, Axes::SHEAR],
    text: "Pressure p and shear stress against the radius. The shear stress is divided by μ, so it lies on p \
           or -p where the contact slips and between them where it sticks. The unworn p is Hertz's \
           half-ellipse; wear moves the load into the stick zone.",
    symbols: &[
        ("p", "pressure"),
        ("τ/μ", "shear stress over the friction coefficient"),
        A,
        C,
    ],
    ..Recipe::new(make)
};

fn make(run: &Run, view: &View) -> Result<Chart, &'static str> {
    let state = run.states.last().ok_or(NO_STATE)?;
    let columns = state
        .column(Column::Radius)
        .zip(state.column(Column::Pressure));
    let (radii, pressure) = columns.ok_or("the state has no column p_Pa")?;
    let is_log = view.scale == Scale::Log;
    // What τ is divided by; on paper, nothing.
    let (name, divisor) = match view.medium {
        Medium::Paper => ("τ", Some(1.0)),
        Medium::Screen(_) if is_log => ("|τ|/μ", view.friction()),
        Medium::Screen(_) => ("τ/μ", view.friction()),
    };
    // On a logarithmic ordinate, |τ| is drawn.
    let scaled = |shear: f64| {
        let shear = shear / divisor.unwrap_or(1.0);
        if is_log { shear.abs() } else { shear }
    };
    let curve = |name, ys: Vec<f64>, role| Curve::new(name, radii, ys, role);
    let others = match divisor {
        Some(_) => ghosts::both(run, [Axes::PRESSURE, Axes::SHEAR], |curve| {
            curve.scale(scaled);
        }),
        None => ghosts::curves_on(run, Axes::PRESSURE),
    };
    let mut chart = over_r(view, "r", ("stress", "Pa"))
        .curves(others)
        .curve(curve("p", pressure.to_vec(), Role::Pressure));
    let shear = state.column(Column::Shear).filter(|_| divisor.is_some());
    let is_seen = |shear: &&[f64]| view.is_on_screen() || shear.iter().any(|&tau| tau != 0.0);
    if let Some(shear) = shear.filter(is_seen) {
        let shear = shear.iter().copied().map(scaled).collect();
        let shear = curve(name, shear, Role::Shear);
        // Dashes: where the contact slips the pressure lies under it, and is still seen.
        chart = chart.curve(shear.dashed_if(view.is_on_screen()));
        chart.y.is_symmetric = true;
    }
    let (Some(theory), Some(live)) = (view.theory(run), view.live()) else {
        return Ok(chart);
    };
    let moment = &live.observation.moment;
    let hertz = theory.unworn_pressure(moment.depth, radii);
    let hertz = hertz.map(|p| curve("unworn p", p, Role::Limit));
    let cattaneo =
        theory.unworn_shear(moment.cycle, [moment.shift, moment.tangential_force], radii);
    let cattaneo = cattaneo.map(|shear| shear.iter().copied().map(scaled).collect());
    let cattaneo = cattaneo.map(|shear| curve("Cattaneo", shear, Role::Unworn));
    let closed_forms = [hertz, cattaneo].into_iter().flatten();
    Ok(chart.curves(closed_forms.map(Curve::theory)))
}

//! Pressure p(r) and shear stress τ(r). τ is drawn as τ/μ: it meets ±p where the contact slips.

use super::{A, C, Declared, Frame, View, Words, ghosts, over_r};
use crate::plot::theme::Role;
use crate::plot::{Chart, Curve, Scale};
use crate::simulation::Curves;
use crate::studies::ghost::Axes;

/// The panel.
pub const PANEL: Declared = Declared {
    title: "stresses",
    can_be_log: true,
    needs: Curves::PRESSURE.union(Curves::SHEAR),
    over_r: true,
    has_spikes: true,
    compared: Axes::Pressure,
    words: Words {
        text: "Pressure p and shear stress against the radius. The shear stress is divided by \
                 μ, so it lies on p or -p where the contact slips and between them where it \
                 sticks. The unworn p is Hertz's half-ellipse; wear moves the load into the stick \
                 zone.",
        symbols: &[
            ("p", "pressure"),
            ("τ/μ", "shear stress over the friction coefficient"),
            A,
            C,
        ],
    },
    ..Declared::chart(draw)
};

fn draw(frame: &Frame, view: &View) -> Result<Chart, &'static str> {
    let (seen, moment) = (&frame.observation, &frame.observation.moment);
    // A logarithmic ordinate shows the size of τ.
    let is_log = view.scale == Scale::Log;
    let scaled = |shear: &f64| if is_log { shear.abs() } else { *shear } / frame.friction;
    let curve = |name, ys: Vec<f64>, role| Curve::new(name, &seen.radii[..], ys, role);
    let mut chart =
        over_r(frame, "r", ("stress", "Pa")).curves(ghosts::on(frame, Axes::Pressure, 1.0));
    let has_shear = frame.friction > 0.0 && moment.stick_radius.is_some();
    if has_shear {
        // Shear stresses of other sources, below their pressures, need no name.
        for mut ghost in ghosts::on(frame, Axes::Shear, 1.0 / frame.friction) {
            if is_log {
                ghost.ys.iter_mut().for_each(|shear| *shear = shear.abs());
            }
            ghost.name.clear();
            chart.curves.push(ghost);
        }
    }
    chart = chart.curve(curve("p", seen.pressure.clone(), Role::Pressure));
    if has_shear && !seen.shear.is_empty() {
        let name = if is_log { "|τ|/μ" } else { "τ/μ" };
        let shear = seen.shear.iter().map(scaled).collect();
        // Dashes: where the contact slips the pressure lies under it, and is still seen.
        chart = chart.curve(curve(name, shear, Role::Shear).dashed());
    }
    let Some(theory) = view.theory(frame) else {
        return Ok(chart);
    };
    let hertz = theory.unworn_pressure(moment.depth, &seen.radii);
    let hertz = hertz.map(|p| curve("unworn p", p, Role::Limit));
    let cattaneo = theory.unworn_shear(moment.cycle, moment.shift, &seen.radii);
    let cattaneo = cattaneo.map(|shear| shear.iter().map(scaled).collect());
    let cattaneo = cattaneo.map(|shear| curve("Cattaneo", shear, Role::Unworn));
    let closed_forms = [hertz, cattaneo].into_iter().flatten();
    Ok(chart.curves(closed_forms.map(|curve| curve.dashed().theory())))
}

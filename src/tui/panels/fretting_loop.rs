//! The fretting loop: tangential force over displacement in the last cycle. Its area is the energy
//! that the cycle dissipates. An arrow stands at the present moment and points the way it goes. On a rig that
//! yields the loop of its sensor is drawn beside that of the contact: both have the same forces and the same area.

use super::{Declared, Frame, NO_MOTION, View, Words, ghosts};
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve, Point};
use crate::studies::ghost::Axes;

/// The panel.
pub const PANEL: Declared = Declared {
    title: "fretting loop",
    keeps_abscissa: true,
    compared: Axes::Loop,
    words: Words {
        text: "Tangential force against tangential displacement in the last cycle. The area \
                 inside is the energy lost to friction. A line means full stick, a thin loop \
                 partial slip, a parallelogram with flat ends gross slip. The arrow marks the \
                 present moment.",
        symbols: &[
            ("u_x", "tangential displacement of the indenter"),
            ("F_x", "tangential force (Q in fretting tests)"),
        ],
    },
    ..Declared::chart(draw)
};

/// The range of values; as far on both sides of zero where they are on both.
fn symmetric<'a>(values: impl Iterator<Item = &'a f64> + Clone) -> [f64; 2] {
    let finite = || values.clone().copied().filter(|value| value.is_finite());
    let (low, high) = (finite().fold(0.0, f64::min), finite().fold(0.0, f64::max));
    // A motion to one side has no other.
    if low < -0.1 * high && high > -0.1 * low {
        let most = high.max(-low);
        [-most, most]
    } else {
        [low, high]
    }
}

fn draw(frame: &Frame, _: &View) -> Result<Chart, &'static str> {
    let moment = &frame.observation.moment;
    moment.stick_radius.ok_or(NO_MOTION)?;
    let (shifts, forces) = frame.trend.fretting_loop();
    let before = shifts.iter().rev().nth(1).copied();
    let back = before.is_some_and(|before| before > moment.shift);
    let (sensed, sensed_forces) = frame.trend.sensed_loop();
    let is_sensed = !sensed.is_empty();
    let name = if is_sensed { "contact" } else { "" };
    let sensor = Curve::new("rig's sensor", sensed, sensed_forces, Role::Quiet);
    let mut chart = Chart::new("", Axis::new("u_x", "m"), Axis::new("F_x", "N"))
        .curves(ghosts::on(frame, Axes::Loop, 1.0))
        .curves(is_sensed.then_some(sensor))
        .curve(Curve::new(name, shifts, forces, Role::Shear));
    let across = symmetric(chart.curves.iter().flat_map(|curve| &curve.xs));
    let upwards = symmetric(chart.curves.iter().flat_map(|curve| &curve.ys));
    (chart.x.bounds, chart.y.bounds) = (Some(across), Some(upwards));
    chart.points.push(Point {
        at: [moment.shift, moment.tangential_force],
        sign: if back { '◀' } else { '▶' },
        role: Role::Alarm,
    });
    Ok(chart)
}

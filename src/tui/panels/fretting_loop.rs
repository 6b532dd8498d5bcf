//! The fretting loop: tangential force over displacement in the last cycle. Its area is the energy
//! that the cycle dissipates. An arrow stands at the present moment and points the way it goes. On a rig that
//! yields the loop of its sensor is drawn beside that of the contact: both have the same forces and the same area.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;

use super::{App, Frame, Panel, ghosts, nothing, plot};
use crate::plot::{Axis, Curve, Point};
use crate::studies::ghost::Axes;
use crate::tui::theme::Role;

/// What the ordinate must hold.
pub fn ordinates(frame: &Frame) -> Vec<f64> {
    if frame.observation.moment.stick_radius.is_none() {
        return Vec::new();
    }
    let ghosts = ghosts::ordinates(&ghosts::on(frame, Axes::Loop, 1.0));
    let values = [frame.trend.fretting_loop().1, ghosts].concat();
    symmetric(&values).to_vec()
}

/// The range of u_x, m.
pub fn abscissae(frame: &Frame) -> Option<[f64; 2]> {
    frame.observation.moment.stick_radius?;
    let (shifts, _) = frame.trend.fretting_loop();
    let (sensed, _) = frame.trend.sensed_loop();
    let ghosts = ghosts::abscissae(&ghosts::on(frame, Axes::Loop, 1.0));
    Some(symmetric(&[shifts, sensed, ghosts].concat()))
}

/// The range of values; as far on both sides of zero where they are on both.
fn symmetric(values: &[f64]) -> [f64; 2] {
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    let (low, high) = (finite().fold(0.0, f64::min), finite().fold(0.0, f64::max));
    // A motion to one side has no other.
    if low < -0.1 * high && high > -0.1 * low {
        let most = high.max(-low);
        [-most, most]
    } else {
        [low, high]
    }
}

/// Draws the panel.
pub fn draw(frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
    let theme = &app.theme;
    let moment = &frame.observation.moment;
    if moment.stick_radius.is_none() {
        return nothing("no tangential motion in this scenario", app, area, buffer);
    }
    let (shifts, forces) = frame.trend.fretting_loop();
    let before = shifts.iter().rev().nth(1).copied();
    let back = before.is_some_and(|before| before > moment.shift);
    let here = Point {
        at: [moment.shift, moment.tangential_force],
        sign: if back { '◀' } else { '▶' },
        style: theme.style(Role::Alarm),
    };
    let (sensed, sensed_forces) = frame.trend.sensed_loop();
    let is_sensed = !sensed.is_empty();
    let name = if is_sensed { "contact" } else { "" };
    let mut ghosts = ghosts::on(frame, Axes::Loop, 1.0);
    let mut plot = plot(
        Panel::Loop,
        app,
        app.across(Panel::Loop, Axis::new("u_x", "m")),
        Axis::new("F_x", "N"),
    )
    .curves(ghosts::curves(&mut ghosts, app));
    if is_sensed {
        let style = theme.style(Role::Quiet);
        plot = plot.curve(Curve::new("rig's sensor", &sensed, &sensed_forces, style));
    }
    plot.curve(Curve::new(name, &shifts, &forces, theme.style(Role::Shear)))
        .point(here)
        .render(area, buffer);
}

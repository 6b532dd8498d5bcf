//! The running-condition map: normal load over displacement amplitude, with the border between partial and
//! gross slip, the present point and its path as the contact wears.
//!
//! Gross slip begins at the amplitude u_t = max(d − g)/κ for any profile (κ = G*/(μE*)). While unworn,
//! depth and load of a power-law tip give it in closed form, u_t ∝ N^(2/3) for a sphere. The second border
//! is that of the present, worn profile through the present point of load and u_t.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::widgets::Widget;

use super::{App, Frame, Panel, nothing, plot};
use crate::plot::{Axis, Curve, Point};
use crate::tui::theme::Role;

/// Points of a border.
const POINTS: usize = 64;

/// Loads up to this many times the largest are shown.
const BEYOND: f64 = 1.5;

/// Amplitudes (m) and loads (N) of the path so far, oldest first.
fn path(frame: &Frame) -> (Vec<f64>, Vec<f64>) {
    let cycles = frame.trend.cycles();
    let known = cycles.filter(|cycle| cycle.amplitude > 0.0 && cycle.normal_force > 0.0);
    known
        .map(|cycle| (cycle.amplitude, cycle.normal_force))
        .unzip()
}

/// The largest load of the map, N.
fn largest_load(frame: &Frame) -> f64 {
    let (_, loads) = path(frame);
    BEYOND * loads.into_iter().fold(0.0, f64::max)
}

/// What the ordinate must hold.
pub fn ordinates(frame: &Frame) -> Vec<f64> {
    match largest_load(frame) {
        load if load > 0.0 => vec![0.0, load],
        _ => Vec::new(),
    }
}

/// Draws the panel.
pub fn draw(frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
    if frame.observation.moment.stick_radius.is_none() {
        return nothing("no tangential motion in this scenario", app, area, buffer);
    }
    let (amplitudes, loads) = path(frame);
    let (Some(&amplitude), Some(&load)) = (amplitudes.last(), loads.last()) else {
        return nothing("no cycle is complete yet", app, area, buffer);
    };
    let top = largest_load(frame);
    let theme = &app.theme;
    let steps = (0..=POINTS).map(|k| k as f64 / POINTS as f64);
    let unworn: Vec<[f64; 2]> = steps
        .filter_map(|share| {
            let load = top * share;
            Some([frame.theory.gross_slip_amplitude(load)?, load])
        })
        .collect();
    let (unworn_u, unworn_load): (Vec<f64>, Vec<f64>) = unworn.iter().map(|p| (p[0], p[1])).unzip();
    let worn = frame.slip_border.filter(|&border| border > 0.0);
    // Once wear has fixed a, the border goes with the load.
    let worn_u = worn.map(|border| [0.0, border * top / load]);
    let ends = [0.0, top];
    let right = unworn_u.iter().copied().chain(amplitudes.iter().copied());
    let right = right.chain(worn_u.map(|u| u[1])).fold(0.0, f64::max);
    let x = Axis::new("amplitude of u_x", "m").bounds([0.0, 1.1 * right]);
    let mut chart = plot(Panel::Condition, app, x, Axis::new("F_z", "N"));
    if !unworn_u.is_empty() {
        let style = theme.style(Role::Limit);
        chart = chart.curve(Curve::new("border, unworn", &unworn_u, &unworn_load, style).dashed());
    }
    if let Some(worn_u) = &worn_u {
        let style = theme.style(Role::Slip);
        chart = chart.curve(Curve::new("border, now", worn_u, &ends, style));
    }
    let here = [[amplitude; 2], [load; 2]];
    let style: Style = theme.style(Role::Unworn);
    chart = chart.curve(Curve::new("path", &amplitudes, &loads, style));
    let regime = frame.figures.as_ref().map(|figures| figures.regime.title());
    let name = regime.unwrap_or("now");
    let style = theme.style(Role::Alarm);
    chart
        .curve(Curve::new(name, &here[0], &here[1], style))
        .point(Point {
            at: [amplitude, load],
            sign: '●',
            style,
        })
        .render(area, buffer);
}

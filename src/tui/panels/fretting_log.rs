//! The fretting log: the loops F_x over u_x of earlier cycles behind that of the last one, each a step
//! further to the right and up. The axes are those of the last loop.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;

use super::{App, Frame, Panel, nothing, plot};
use crate::plot::{Axis, Curve};
use crate::tui::theme::Role;

/// The most loops that are drawn.
const MOST: usize = 12;

/// How far the oldest loop lies behind the newest, in widths and heights of the largest.
const SHIFT: [f64; 2] = [0.6, 1.2];

/// The cycle that a loop ends, its u_x (m) and its F_x (N).
type Seen = (f64, Vec<f64>, Vec<f64>);

/// One loop in its place.
struct Placed {
    shifts: Vec<f64>,
    forces: Vec<f64>,
}

/// The loops from the oldest to the newest, moved to their places, and the cycles of both ends.
fn placed(frame: &Frame) -> Option<(Vec<Placed>, [f64; 2])> {
    frame.observation.moment.stick_radius?;
    let mut loops: Vec<Seen> = frame.trend.loops().collect();
    if loops.len() > MOST {
        let every = loops.len().div_ceil(MOST);
        let last = loops.len() - 1;
        let mut k = 0;
        loops.retain(|_| {
            k += 1;
            (last + 1 - k).is_multiple_of(every)
        });
    }
    let ends = [loops.first()?.0, loops.last()?.0];
    let extent = |of: fn(&Seen) -> &Vec<f64>| {
        let values = loops.iter().flat_map(of);
        let bounds = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &v| {
            (a.min(v), b.max(v))
        });
        bounds.1 - bounds.0
    };
    let size = [extent(|entry| &entry.1), extent(|entry| &entry.2)];
    let count = loops.len().max(2) - 1;
    let loops = loops
        .into_iter()
        .rev()
        .enumerate()
        .map(|(k, (_, shifts, forces))| {
            let step = k as f64 / count as f64;
            Placed {
                shifts: shifts
                    .iter()
                    .map(|u| u + step * SHIFT[0] * size[0])
                    .collect(),
                forces: forces
                    .iter()
                    .map(|f| f + step * SHIFT[1] * size[1])
                    .collect(),
            }
        });
    let mut loops: Vec<Placed> = loops.collect();
    // The newest is drawn last, over the others.
    loops.reverse();
    Some((loops, ends))
}

/// What the ordinate must hold.
pub fn ordinates(frame: &Frame) -> Vec<f64> {
    let placed = placed(frame).map_or_else(Vec::new, |(loops, _)| loops);
    placed.into_iter().flat_map(|one| one.forces).collect()
}

/// Draws the panel.
pub fn draw(frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
    if frame.observation.moment.stick_radius.is_none() {
        return nothing("no tangential motion in this scenario", app, area, buffer);
    }
    let Some((loops, [first, last])) = placed(frame) else {
        return nothing("no cycle is complete yet", app, area, buffer);
    };
    let note = format!("cycles {first:.0} (back) to {last:.0}");
    let mut chart = plot(
        Panel::Log,
        app,
        Axis::new("u_x", "m"),
        Axis::new("F_x", "N"),
    )
    .note(&note);
    let newest = loops.len() - 1;
    for (k, one) in loops.iter().enumerate() {
        let role = if k == newest {
            Role::Shear
        } else {
            Role::Unworn
        };
        chart = chart.curve(Curve::new(
            "",
            &one.shifts,
            &one.forces,
            app.theme.style(role),
        ));
    }
    chart.render(area, buffer);
}

//! Time per step on this machine, over finished cycles.

use super::{Declared, Frame, View, Words, finished_series, over_cycles};
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart};

/// The panel.
pub const PANEL: Declared = Declared {
    title: "time per step",
    can_be_log: true,
    has_spikes: true,
    is_calm: true,
    words: Words {
        text: "How long one step of the simulation takes on this machine.",
        symbols: &[("t", "time per step")],
    },
    ..Declared::chart(draw)
};

fn draw(frame: &Frame, _: &View) -> Result<Chart, &'static str> {
    let cost = finished_series(frame, Role::Shear, |entry| entry.step_cost);
    if !cost.ys.iter().any(|value| value.is_finite()) {
        return Err("measured while it runs");
    }
    let ordinate = Axis::new("t", "s").from_zero();
    Ok(over_cycles(frame, ordinate).curve(cost))
}

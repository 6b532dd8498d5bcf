//! The largest worn depth over cycles.

use super::{Declared, Frame, NO_WEAR, View, Words, ghosts, over_cycles, series};
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart};
use crate::studies::ghost::Axes;

/// The panel.
pub const PANEL: Declared = Declared {
    title: "depth over cycles",
    can_be_log: true,
    is_calm: true,
    compared: Axes::Depth,
    words: Words {
        text: "The largest worn depth of the profile over cycles: what a profilometer reads in the deepest point of \
                 the scar. Measured depths lie over it with --overlay.",
        symbols: &[("depth", "largest f - f0 over the radius")],
    },
    ..Declared::chart(draw)
};

fn draw(frame: &Frame, _: &View) -> Result<Chart, &'static str> {
    frame.observation.law.ok_or(NO_WEAR)?;
    let ordinate = Axis::new("depth", "m").from_zero();
    Ok(over_cycles(frame, ordinate)
        .curves(ghosts::on(frame, Axes::Depth, 1.0))
        .curve(series(frame, "", Role::Profile, |entry| entry.scar_depth)))
}

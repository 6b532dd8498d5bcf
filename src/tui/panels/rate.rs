//! Worn volume per cycle, over cycles. The unfinished cycle is left out: most of the wear of a cycle falls
//! into a part of it, so a rate over less than a cycle means little.

use super::{Declared, Frame, NO_WEAR, View, Words, finished_series, over_cycles};
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart};
use crate::studies::ghost::Axes;

/// The panel.
pub const PANEL: Declared = Declared {
    title: "wear rate",
    can_be_log: true,
    has_spikes: true,
    is_calm: true,
    compared: Axes::Volume,
    words: Words {
        text: "The wear volume of each cycle. It falls as the ring wears free of load, and \
                 stays up if a force keeps pressing the indenter in.",
        symbols: &[("V per cycle", "wear volume of one cycle")],
    },
    ..Declared::chart(draw)
};

fn draw(frame: &Frame, _: &View) -> Result<Chart, &'static str> {
    frame.observation.law.ok_or(NO_WEAR)?;
    let rate = finished_series(frame, Role::Profile, |entry| entry.wear_rate);
    let ordinate = Axis::new("V per cycle", "m³").from_zero();
    Ok(over_cycles(frame, ordinate).curve(rate))
}

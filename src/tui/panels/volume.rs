//! Wear volume V over cycles. What the work of friction says of it, V = k E_d, differs by less than a line
//! is wide: the panel beside shows the difference.

use super::{Declared, Frame, NO_WEAR, View, Words, ghosts, over_cycles, series};
use crate::plot::theme::Role;
use crate::plot::units::format_value;
use crate::plot::{Axis, Chart};
use crate::studies::ghost::Axes;

/// The panel.
pub const PANEL: Declared = Declared {
    title: "wear volume",
    can_be_log: true,
    is_calm: true,
    compared: Axes::Volume,
    words: Words {
        text: "The wear volume since the start. It grows by k times the energy that friction dissipates.",
        symbols: &[
            ("V", "wear volume"),
            ("E_d", "energy lost to friction since the start"),
        ],
    },
    ..Declared::chart(draw)
};

fn draw(frame: &Frame, _: &View) -> Result<Chart, &'static str> {
    frame.observation.law.ok_or(NO_WEAR)?;
    let work = frame.observation.moment.dissipated_energy;
    let mut chart = over_cycles(frame, Axis::new("V", "m³").from_zero());
    chart.note = format!("E_d {}", format_value(work, "J", 4));
    Ok(chart
        .curves(ghosts::on(frame, Axes::Volume, 1.0))
        .curve(series(frame, "", Role::Profile, |entry| entry.wear_volume)))
}

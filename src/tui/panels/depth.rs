//! The worn depth f − f₀ over the radius.

use super::{A, BAND, C, Declared, Frame, View, Words, ghosts, limit, over_r, zones};
use crate::plot::theme::Role;
use crate::plot::{Chart, Curve, Fill, Scale};
use crate::simulation::Curves;

/// The panel.
pub const PANEL: Declared = Declared {
    title: "worn depth",
    can_be_log: true,
    needs: Curves::PROFILE,
    over_r: true,
    words: Words {
        text: "How much has worn off, against the radius. Inside the permanent stick zone it is \
                 zero; the \
                 ring outside it grows towards the limiting shape (t) if the depth is held.",
        symbols: &[("f - f0", "worn depth"), A, C, BAND],
    },
    ..Declared::chart(draw)
};

fn draw(frame: &Frame, view: &View) -> Result<Chart, &'static str> {
    let seen = &frame.observation;
    // Without a base on a log axis, the area would reach for minus infinity.
    let fill = match view.scale {
        Scale::Linear => Fill::To(0.0),
        Scale::Log => Fill::None,
    };
    let worn = Curve::new("worn", &seen.radii[..], seen.wear.clone(), Role::Profile);
    let mut chart = over_r(frame, "r", ("f - f0", "m"));
    chart.band = zones(frame);
    Ok(chart
        .curves(limit(frame, view, None))
        .curves(ghosts::worn(frame, None))
        .curve(worn.filled(fill)))
}

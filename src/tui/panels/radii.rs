//! The largest contact radius and the smallest stick radius of every cycle.

use super::{Declared, Frame, View, Words, cycles_shown, ghosts, over_cycles, series};
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve};
use crate::studies::ghost::Axes;

/// The panel.
pub const PANEL: Declared = Declared {
    title: "radii over cycles",
    is_calm: true,
    compared: Axes::Contact,
    words: Words {
        text: "The largest contact radius and the smallest stick radius of each cycle. As the \
                 ring wears, a grows; c settles, because what has stuck through a whole cycle \
                 keeps sticking.",
        symbols: &[
            ("a", "contact radius"),
            ("c", "stick radius: the smallest of the cycle"),
        ],
    },
    ..Declared::chart(draw)
};

fn draw(frame: &Frame, view: &View) -> Result<Chart, &'static str> {
    let contact = series(frame, "contact a", Role::Contact, |entry| {
        entry.contact_radius
    });
    let stick = series(frame, "stick c", Role::Stick, |entry| entry.stick_radius).dashed();
    let has_stick = stick.ys.iter().any(|radius| radius.is_finite());
    // Stick radii of other sources, below their contact radii, need no name.
    let mut stick_of_ghosts = ghosts::on(frame, Axes::Stick, 1.0);
    stick_of_ghosts
        .iter_mut()
        .for_each(|ghost| ghost.name.clear());
    let theory = view.theory(frame).and_then(|theory| theory.stick_radius);
    let theory = theory.map(|c| {
        let ends = cycles_shown(frame);
        Curve::new("theory c", ends, [c; 2], Role::Limit).theory()
    });
    Ok(over_cycles(frame, Axis::new("radius", "m").from_zero())
        .curves(ghosts::on(frame, Axes::Contact, 1.0))
        .curves(stick_of_ghosts)
        .curve(contact)
        .curves(has_stick.then_some(stick))
        .curves(theory))
}

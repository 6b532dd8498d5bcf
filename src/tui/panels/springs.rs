//! The 1D profile g(x) against the depth to which it is pressed: springs touch where g is less.

use super::{A, C, Declared, Frame, View, Words, ghosts, over_r};
use crate::plot::theme::Role;
use crate::plot::{Chart, Curve};
use crate::simulation::Curves;
use crate::studies::ghost::Axes;

/// The panel.
pub const PANEL: Declared = Declared {
    title: "1D profile",
    needs: Curves::PROFILE_1D,
    over_r: true,
    compared: Axes::Springs,
    words: Words {
        text: "The method replaces the 3D contact with a row of independent springs, and the \
                 shape f with its 1D image g. A spring at x touches where g(x) is below the depth \
                 d. The contact force is exactly the sum of the spring forces.",
        symbols: &[("g", "1D profile"), ("d", "indentation depth"), A, C],
    },
    ..Declared::chart(draw)
};

fn draw(frame: &Frame, _: &View) -> Result<Chart, &'static str> {
    let seen = &frame.observation;
    let (ends, g) = ([0.0, super::edge(frame)], seen.profile_1d.clone());
    let depth = Curve::new("depth d", ends, [seen.moment.depth; 2], Role::Contact);
    Ok(over_r(frame, "x", ("g", "m"))
        .curve(depth.dashed())
        .curves(ghosts::on(frame, Axes::Springs, 1.0))
        .curve(Curve::new("g", &seen.radii[..], g, Role::Profile1d)))
}

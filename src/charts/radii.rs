//! The largest contact radius and the smallest stick radius of every cycle.

use super::{Recipe, View, cycles_shown, ghosts, over_cycles, series};
use crate::charts::run::Run;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve};
use crate::reading::Column;
use crate::traces::Axes;

/// The chart.
pub static RECIPE: Recipe = Recipe {
    name: "radii",
    title: "radii over cycles",
    is_calm: true,
    overlays: &[Axes::CONTACT, Axes::STICK],
    history: &[Column::ContactRadius, Column::PermanentStickRadius],
    text: "The largest contact radius and the smallest stick radius of each cycle. As the ring wears, a grows; \
           c settles, because what has stuck through a whole cycle keeps sticking.",
    symbols: &[
        ("a", "contact radius"),
        ("c", "stick radius: the smallest of the cycle"),
    ],
    ..Recipe::new(make)
};

fn make(run: &Run, view: &View) -> Result<Chart, &'static str> {
    let names = view.pick(
        ["contact a", "stick c"],
        ["contact radius a", "stick radius c"],
    );
    let contact = series(run, view, Column::ContactRadius, names[0], Role::Contact)?;
    let stick = series(
        run,
        view,
        Column::PermanentStickRadius,
        names[1],
        Role::Stick,
    )
    .ok()
    .filter(|stick| stick.ys.iter().any(|radius| radius.is_finite()))
    .map(|stick| stick.dashed_if(view.is_on_screen()));
    let theory = view.theory(run).and_then(|theory| theory.stick_radius);
    let theory = theory
        .zip(cycles_shown(run, view))
        .map(|(c, ends)| Curve::new("theory c", ends, [c; 2], Role::Limit).theory());
    let mut ordinate = Axis::new("radius", "m").from_zero();
    if !view.is_on_screen() {
        let largest = contact.highest();
        ordinate.bounds = (largest > 0.0).then_some([0.0, 1.1 * largest]);
    }
    let others = ghosts::both(run, [Axes::CONTACT, Axes::STICK], |_| {});
    Ok(over_cycles(run, view, ordinate)
        .curves(others)
        .curve(contact)
        .curves(stick)
        .curves(theory))
}

//! The numbers of the moment, most important first: a small panel shows fewer.

use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::{Picture, Shown};
use crate::charts::Recipe;
use crate::math::number::shown;
use crate::plot::theme::Role;
use crate::plot::units::format_value;
use crate::reading::CycleFigures;
use crate::scenario::units::shown_in;
use crate::tui::canvas::Canvas;
use crate::tui::frame::Frame;

/// The panel.
pub static RECIPE: Recipe<Picture> = Recipe {
    title: "numbers",
    is_calm: true,
    text: "The state in numbers, and what a fretting test reports for the last complete cycle. A, B and D \
           are ratios of the loop: at the border of gross slip an unworn sphere has A = 0.2, B = 0.77 and \
           D = 0.26. k is wear per friction work; Archard's, per normal force and distance, is μ k.",
    symbols: &[
        ("E_d", "energy lost to friction"),
        ("Q*/(μP)", "amplitude of F_x divided by the friction limit"),
        (
            "slip ratio",
            "mean slip of the contact divided by the amplitude",
        ),
        ("D, A, B", "sliding ratio and energy ratios of the loop"),
        ("V/E_d", "wear volume divided by accumulated energy"),
    ],
    ..Recipe::new(Picture {
        draw,
        extent: |_| None,
    })
};

fn draw(shown: &Shown, mut canvas: Canvas) {
    let mut canvas = canvas.titled(RECIPE.title, shown.role);
    let area = canvas.area;
    let columns = (area.width / 30).clamp(1, 2);
    let width = area.width / columns;
    let rows: Vec<_> = rows(shown.frame).collect();
    let below = rows
        .len()
        .saturating_sub(usize::from(columns * area.height));
    for ((name, value), i) in rows.into_iter().zip(0..columns * area.height) {
        let (column, row) = (i / area.height, i % area.height);
        let (x, y) = (area.x + column * width, area.y + row);
        let cell = Rect::new(x, y, width.saturating_sub(1), 1);
        let term = shown.frame.live.observation.geometry.term(name);
        let [term, value] = [&term, &value].map(|text| canvas.printable(text));
        // The name is cut rather than the value: its last words and the symbol say the most.
        let room = usize::from(cell.width).saturating_sub(value.chars().count() + 2);
        let mut name = term.as_str();
        while name.chars().count() > room
            && let Some((_, rest)) = name.split_once(' ')
        {
            name = rest;
        }
        let label = Span::styled(format!(" {name:room$.room$} "), canvas.style(Role::Quiet));
        canvas.at(cell).show(Line::from(vec![label, value.into()]));
    }
    // Writes into the rule, since every row is needed.
    let rule = Rect::new(area.x, area.y.saturating_sub(1), area.width, 1);
    canvas.at(rule).write_more_below(below);
}

/// Returns all of them, one per line.
pub fn text(frame: &Frame) -> String {
    let moment = format!("cycle {}\n", frame.live.observation.moment.cycle);
    rows(frame).fold(moment, |text, (name, value)| {
        text + &format!("{}: {value}\n", name.trim())
    })
}

/// Returns the names and values of the numbers that are known.
fn rows(frame: &Frame) -> impl Iterator<Item = (&'static str, String)> {
    let (moment, figures) = (&frame.live.observation.moment, frame.live.figures.as_ref());
    let setup = frame.live.scenario.setup();
    let k = setup.wear.map(|law| law.coefficient());
    let [mises, tension] = frame.peaks().map_or([None; 2], |peaks| peaks.map(Some));
    let (moves, c) = (moment.stick_radius.is_some(), moment.permanent_stick_radius);
    let (cells, steps) = (
        frame.live.observation.grid.cells(),
        setup.steps_in_a_cycle(),
    );

    let value = |value: Option<f64>, unit| Some(format_value(value?, unit, 4));
    let always = |number, unit| value(Some(number), unit);
    let plain = |value: Option<f64>, digits| Some(shown(value?, digits));
    let with_unit = |number: Option<String>, unit| Some(format!("{} {unit}", number?));
    // In the same unit as in the list of parameters.
    let in_words = |value: Option<f64>, unit| {
        let (of, factor) = shown_in(unit)?;
        with_unit(plain(value.map(|value| value / factor), 4), of)
    };
    let ratio = |of: fn(&CycleFigures) -> Option<f64>| Some(format!("{:.3}", of(figures?)?));
    let per_load = k.map(|k| k * setup.material.friction());
    let place = |x: Option<f64>| with_unit(plain(x.map(|x| x / moment.contact_radius), 3), "a");
    let rows = [
        ("regime", figures.map(|of| of.regime.title().to_owned())),
        ("contact radius a", always(moment.contact_radius, "m")),
        ("stick radius now", value(moment.stick_radius, "m")),
        ("permanent stick radius c", value(c, "m")),
        ("depth d", always(moment.depth, "m")),
        ("length of the line", value(setup.geometry.length(), "m")),
        ("F_z", always(moment.normal_force, "N")),
        ("u_x", value(moves.then_some(moment.shift), "m")),
        ("F_x", value(moves.then_some(moment.tangential_force), "N")),
        ("E_d per cycle", value(figures.map(|of| of.energy), "J")),
        ("Q*/(μP)", ratio(|of| of.force_ratio)),
        ("slip ratio", ratio(|of| of.slip_ratio)),
        ("sliding ratio D", ratio(|of| of.sliding_ratio)),
        ("energy ratio A", ratio(|of| of.energy_ratio)),
        ("energy ratio B", ratio(|of| of.energy_ratio_b)),
        ("wear volume V", always(moment.wear_volume, "m³")),
        ("friction work E_d", always(moment.dissipated_energy, "J")),
        ("V/E_d", in_words(moment.wear_per_energy(), "1/Pa")),
        ("k per friction work", in_words(k, "1/Pa")),
        ("k per load", in_words(per_load, "m^3/(N*m)")),
        ("1 - V/(k E_d)", plain(moment.energy_residual, 2)),
        ("stability margin", plain(moment.stability_margin, 2)),
        ("time per step", value(frame.step_cost, "s")),
        ("largest von Mises", value(mises.map(|at| at.value), "Pa")),
        ("  at depth", place(mises.map(|at| at.z))),
        ("largest tension", value(tension.map(|at| at.value), "Pa")),
        ("  at x", place(tension.map(|at| at.x))),
        ("cells", Some(cells.to_string())),
        ("steps per cycle", Some(steps.to_string())),
    ];
    let rows = rows.into_iter();
    rows.filter_map(|(name, value)| Some((name, value?)))
}

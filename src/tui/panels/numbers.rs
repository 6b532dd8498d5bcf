//! The numbers of the moment, most important first: a small panel shows fewer.

use super::*;
use crate::reading::CycleFigures;

/// The panel.
pub static PICTURE: Picture = Picture {
    recipe: Recipe {
        title: "numbers",
        is_calm: true,
        text: "The state in numbers, and what a fretting test reports for the last complete \
             cycle. A, B and D \
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
        ..Recipe::new(|_, _| Err(""))
    },
    draw,
    extent: |_| None,
};

fn draw(shown: &Shown, mut canvas: Canvas) {
    let mut canvas = canvas.titled(PICTURE.recipe.title, shown.role);
    let area = canvas.area;
    let columns = (area.width / 30).clamp(1, 2);
    let width = area.width / columns;
    for ((name, value), i) in rows(shown.frame).into_iter().zip(0..columns * area.height) {
        let (column, row) = (i / area.height, i % area.height);
        let (x, y) = (area.x + column * width, area.y + row);
        let cell = Rect::new(x, y, width.saturating_sub(1), 1);
        let [name, value] = [name, &value].map(|text| canvas.printable(text));
        // Rather than the value, the name is cut: its last words, and the symbol, tell most.
        let room = usize::from(cell.width).saturating_sub(value.chars().count() + 2);
        let mut name = name.as_str();
        while name.chars().count() > room
            && let Some((_, rest)) = name.split_once(' ')
        {
            name = rest;
        }
        let name = format!(" {name:room$.room$} ");
        let name = Span::styled(name, canvas.style(Role::Quiet));
        canvas.at(cell).show(Line::from(vec![name, value.into()]));
    }
}

fn rows(frame: &Frame) -> Vec<(&'static str, String)> {
    let (facts, moment, figures) = (&frame.facts, &frame.observation.moment, &frame.figures);
    let figures = figures.as_ref();
    let setup = facts.scenario.setup();
    let k = setup.wear.map(|law| law.coefficient());
    let per_load = |k: f64| format_number(k * setup.material.friction() * 1e9, 3);
    let [equivalent, tension] = frame.peaks.map_or([None; 2], |peaks| peaks.map(Some));
    let cells = frame.observation.radii.len() - 1;

    let value = |name, value: Option<f64>, unit| Some((name, format_value(value?, unit, 4)));
    let always = |name, number, unit| value(name, Some(number), unit);
    let moving = |name, number, unit| value(name, moment.stick_radius.map(|_| number), unit);
    let ratio =
        |name, of: fn(&CycleFigures) -> Option<f64>| Some((name, format!("{:.3}", of(figures?)?)));
    let plain = |name, value: Option<f64>| Some((name, format_number(value?, 2)));
    let per_energy = |name, volume: Option<f64>| {
        Some((name, format!("{} µm³/J", format_number(volume? * 1e18, 3))))
    };
    let place = |name, x: Option<f64>| {
        let share = format_number(x? / moment.contact_radius, 3);
        Some((name, format!("{share} a")))
    };
    let rows = [
        figures.map(|figures| ("regime", figures.regime.title().to_owned())),
        always("contact radius a", moment.contact_radius, "m"),
        value("stick radius now", moment.stick_radius, "m"),
        value(
            "permanent stick radius c",
            moment.permanent_stick_radius,
            "m",
        ),
        always("depth d", moment.depth, "m"),
        always("F_z", moment.normal_force, "N"),
        moving("u_x", moment.shift, "m"),
        moving("F_x", moment.tangential_force, "N"),
        value("E_d per cycle", figures.map(|figures| figures.energy), "J"),
        ratio("Q*/(μP)", |figures| figures.force_ratio),
        ratio("slip ratio", |figures| figures.slip_ratio),
        ratio("sliding ratio D", |figures| figures.sliding_ratio),
        ratio("energy ratio A", |figures| figures.energy_ratio),
        ratio("energy ratio B", |figures| figures.energy_ratio_b),
        always("wear volume V", moment.wear_volume, "m³"),
        always("friction work E_d", moment.dissipated_energy, "J"),
        per_energy("V/E_d", moment.wear_per_energy()),
        per_energy("k per friction work", k),
        k.map(|k| ("k per load", format!("{} mm³/(N·m)", per_load(k)))),
        plain("1 - V/(k E_d)", moment.energy_residual),
        plain("stability margin", moment.stability_margin),
        value("time per step", frame.step_cost, "s"),
        value("largest von Mises", equivalent.map(|peak| peak.value), "Pa"),
        place("  at depth", equivalent.map(|peak| peak.z)),
        value("largest tension", tension.map(|peak| peak.value), "Pa"),
        place("  at x", tension.map(|peak| peak.x)),
        Some(("cells", cells.to_string())),
        Some(("steps per cycle", setup.steps_in_a_cycle().to_string())),
    ];
    rows.into_iter().flatten().collect()
}

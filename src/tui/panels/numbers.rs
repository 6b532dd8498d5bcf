//! The numbers of the moment, most important first: a small panel shows fewer.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::{Frame, Pane, Picture, Recipe, Words};
use crate::plot::units::{format_number, format_value};
use crate::tui::theme::Role;

/// The panel.
pub static PICTURE: Picture = Picture {
    recipe: Recipe {
        title: "numbers",
        is_calm: true,
        words: Words {
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
        },
        ..Recipe::new(|_, _| Err(""))
    },
    draw,
    extent: |_| None,
};

fn draw(frame: &Frame, pane: &Pane, area: Rect, buffer: &mut Buffer) {
    let rows = rows(frame).into_iter();
    let rows = rows.map(|row| [row.0, &row.1].map(|text| pane.theme.printable(text)));
    let columns = (area.width / 30).clamp(1, 2);
    let width = area.width / columns;
    for (i, [name, value]) in rows.enumerate() {
        let (column, row) = (i as u16 / area.height.max(1), i as u16 % area.height.max(1));
        if column >= columns {
            return;
        }
        let cell = Rect::new(
            area.x + column * width,
            area.y + row,
            width.saturating_sub(1),
            1,
        );
        // Rather than the value, the name is cut: its last words, and the symbol, tell most.
        let room = usize::from(cell.width).saturating_sub(value.chars().count() + 2);
        let mut name = name.as_str();
        while name.chars().count() > room
            && let Some((_, rest)) = name.split_once(' ')
        {
            name = rest;
        }
        let name: String = name.chars().take(room).collect();
        let pad = room - name.chars().count();
        let line = Line::from(vec![
            Span::styled(
                format!(" {name} {}", " ".repeat(pad)),
                pane.theme.style(Role::Quiet),
            ),
            Span::raw(value),
        ]);
        line.render(cell, buffer);
    }
}

fn rows(frame: &Frame) -> Vec<(&'static str, String)> {
    let moment = &frame.observation.moment;
    let value = |value: f64, unit: &str| format_value(value, unit, 4);
    let ratio = |value: Option<f64>| value.map(|value| format!("{value:.3}"));
    let mut rows = Vec::new();
    if let Some(figures) = &frame.figures {
        rows.push(("regime", figures.regime.title().to_owned()));
    }
    rows.push(("contact radius a", value(moment.contact_radius, "m")));
    if let (Some(stick), Some(permanent)) = (moment.stick_radius, moment.permanent_stick_radius) {
        rows.push(("stick radius now", value(stick, "m")));
        rows.push(("permanent stick radius c", value(permanent, "m")));
    }
    rows.push(("depth d", value(moment.depth, "m")));
    rows.push(("F_z", value(moment.normal_force, "N")));
    if moment.stick_radius.is_some() {
        rows.push(("u_x", value(moment.shift, "m")));
        rows.push(("F_x", value(moment.tangential_force, "N")));
    }
    if let Some(figures) = &frame.figures {
        rows.push(("E_d per cycle", value(figures.energy, "J")));
        let ratios = [
            ("Q*/(μP)", figures.force_ratio),
            ("slip ratio", figures.slip_ratio),
            ("sliding ratio D", figures.sliding_ratio),
            ("energy ratio A", figures.energy_ratio),
            ("energy ratio B", figures.energy_ratio_b),
        ];
        rows.extend(
            ratios
                .into_iter()
                .filter_map(|(name, of)| Some((name, ratio(of)?))),
        );
    }
    rows.push(("wear volume V", value(moment.wear_volume, "m³")));
    rows.push(("friction work E_d", value(moment.dissipated_energy, "J")));
    if let Some(per_energy) = moment.wear_per_energy() {
        rows.push(("V/E_d", cubic_micrometres(per_energy)));
    }
    if let Some(k) = frame.facts.wear_coefficient {
        let per_load = format_number(k * frame.facts.friction * 1e9, 3);
        rows.push(("k per friction work", cubic_micrometres(k)));
        rows.push(("k per load", format!("{per_load} mm³/(N·m)")));
    }
    if let Some(residual) = moment.energy_residual {
        rows.push(("1 - V/(k E_d)", format_number(residual, 2)));
    }
    if let Some(margin) = moment.stability_margin {
        rows.push(("stability margin", format_number(margin, 2)));
    }
    if let Some(cost) = frame.step_cost {
        rows.push(("time per step", value(cost, "s")));
    }
    if let Some([equivalent, tension]) = frame.peaks {
        let place = |x: f64| format!("{} a", format_number(x / moment.contact_radius, 3));
        rows.push(("largest von Mises", value(equivalent.value, "Pa")));
        rows.push(("  at depth", place(equivalent.z)));
        rows.push(("largest tension", value(tension.value, "Pa")));
        rows.push(("  at x", place(tension.x)));
    }
    rows.push(("cells", (frame.observation.radii.len() - 1).to_string()));
    rows.push(("steps per cycle", frame.facts.steps_per_cycle.to_string()));
    rows
}

/// A volume per energy (1/Pa) in µm³/J.
fn cubic_micrometres(per_energy: f64) -> String {
    format!("{} µm³/J", format_number(per_energy * 1e18, 3))
}

//! The numbers of the moment, the most wanted first: a small panel shows fewer.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use ratatui::widgets::Widget;

use super::{App, Frame};
use crate::tui::plot::units::{format_number, format_value_in};
use crate::tui::theme::Role;

/// Draws the panel.
pub fn draw(frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
    let rows = rows(frame, app.theme.ascii());
    let columns = (area.width / 26).clamp(1, 2);
    let width = area.width / columns;
    for (i, (name, value)) in rows.iter().enumerate() {
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
        let pad = usize::from(cell.width)
            .saturating_sub(name.chars().count() + value.chars().count() + 2);
        let line = Line::from(vec![
            Span::styled(
                format!(" {name} {}", " ".repeat(pad)),
                app.theme.style(Role::Quiet),
            ),
            Span::raw(value.clone()),
        ]);
        line.render(cell, buffer);
    }
}

fn rows(frame: &Frame, ascii: bool) -> Vec<(&'static str, String)> {
    let moment = &frame.observation.moment;
    let value = |value: f64, unit: &str| format_value_in(value, unit, 4, ascii);
    let mut rows = vec![("contact a", value(moment.contact_radius, "m"))];
    if let (Some(stick), Some(permanent)) = (moment.stick_radius, moment.permanent_stick_radius) {
        rows.push(("stick c, now", value(stick, "m")));
        rows.push(("stick c, cycle", value(permanent, "m")));
    }
    rows.push(("depth", value(moment.depth, "m")));
    rows.push(("F_z", value(moment.normal_force, "N")));
    if moment.stick_radius.is_some() {
        rows.push(("shift u_x", value(moment.shift, "m")));
        rows.push(("F_x", value(moment.tangential_force, "N")));
    }
    rows.push(("worn volume", value(moment.wear_volume, "m³")));
    rows.push(("friction work", value(moment.dissipated_energy, "J")));
    if let Some(residual) = moment.energy_residual {
        rows.push(("1 - V/(k E_d)", format_number(residual, 2)));
    }
    if let Some(margin) = moment.stability_margin {
        rows.push(("stability margin", format_number(margin, 2)));
    }
    if let Some(cost) = frame.step_cost {
        rows.push(("a step costs", value(cost, "s")));
    }
    rows.push(("cells", (frame.observation.radii.len() - 1).to_string()));
    rows.push(("steps a cycle", frame.steps_per_cycle.to_string()));
    if let Some(error) = frame.expected_error {
        rows.push(("error expected", format!("{error:.0e} d")));
    }
    rows
}

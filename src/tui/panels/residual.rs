//! The difference between wear volume and friction work: V/(k E_d) − 1 since the start, in
//! thousandths. The wear law says zero.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;

use super::{App, Frame, Panel, curve, cycles_shown, nothing, over_cycles, series};
use crate::plot::Axis;
use crate::tui::theme::Role;
use crate::tui::trend::Cycle;

/// V/(k E_d) − 1 at the end of an entry, in ‰; NaN under laws that do not follow energy.
fn difference(entry: &Cycle) -> f64 {
    1e3 * (entry.wear_volume / entry.expected_volume - 1.0)
}

/// What the ordinate must hold: the differences, and zero.
pub fn ordinates(frame: &Frame) -> Vec<f64> {
    let mut values = series(frame, difference).1;
    values.push(0.0);
    values
}

/// Draws the panel.
pub fn draw(frame: &Frame, app: &App, area: Rect, buffer: &mut Buffer) {
    let (cycles, differences) = series(frame, difference);
    if !differences.iter().any(|value| value.is_finite()) {
        return nothing("nothing to compare yet", app, area, buffer);
    }
    let theme = &app.theme;
    let zero = [0.0; 2];
    let ends = cycles_shown(frame);
    over_cycles(
        Panel::Residual,
        frame,
        app,
        Axis::new("V/(k E_d) - 1", "1e-3"),
    )
    .curve(curve("", &ends, &zero, theme, Role::Faint).dashed())
    .curve(curve("", &cycles, &differences, theme, Role::Profile))
    .render(area, buffer);
}

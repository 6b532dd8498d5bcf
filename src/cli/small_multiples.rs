//! Text plots side by side, each with its axes, so that they can be compared without colour.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;

use crate::math::scan::range;
use crate::plot::theme::{Look, Theme};
use crate::plot::{Axis, Chart, Marker, Plot, Scale};

/// Size of one plot, in cells.
const SIZE: (u16, u16) = (39, 11);

/// Gap between two plots, in cells.
const GAP: u16 = 2;

/// Plots per row.
const ACROSS: usize = 2;

/// Draws the charts in rows of two.
pub fn draw(charts: &[Chart], marker: Marker) -> String {
    let theme = Theme::new(Look::Mono, marker);
    let (width, height) = SIZE;
    let mut text = String::new();
    for charts in charts.chunks(ACROSS) {
        let mut buffer = Buffer::empty(Rect::new(0, 0, (width + GAP) * ACROSS as u16, height));
        for (at, chart) in charts.iter().enumerate() {
            let area = Rect::new(at as u16 * (width + GAP), 0, width, height);
            Plot::new(chart, &theme).render(area, &mut buffer);
        }
        text.push('\n');
        for row in buffer.area.rows() {
            let line: String = row.positions().map(|at| buffer[at].symbol()).collect();
            text.push_str(line.trim_end());
            text.push('\n');
        }
    }
    text
}

/// Like [`draw`], but with the same axes for all charts, which hold all of their curves. Returns nothing if a
/// logarithmic axis has nothing to show.
pub fn draw_alike(mut charts: Vec<Chart>, marker: Marker) -> String {
    let ends = charts.first().and_then(|first| {
        let curves = || charts.iter().flat_map(|chart| &chart.curves);
        let x = ends(&first.x, curves().flat_map(|curve| &curve.xs))?;
        Some((x, ends(&first.y, curves().flat_map(|curve| &curve.ys))?))
    });
    let Some((x, y)) = ends else {
        return String::new();
    };
    for chart in &mut charts {
        (chart.x.bounds, chart.y.bounds) = (Some(x), Some(y));
    }
    draw(&charts, marker)
}

/// The smallest value on a logarithmic axis; anything smaller is rounding error.
const FLOOR: f64 = 1e-17;

/// Returns the ends of an axis that holds all values it can show; `None` without any.
fn ends<'a>(axis: &Axis, values: impl Iterator<Item = &'a f64>) -> Option<[f64; 2]> {
    let floor = match axis.scale {
        Scale::Log => FLOOR,
        Scale::Linear => f64::NEG_INFINITY,
    };
    let seen = values.filter(|value| value.is_finite() && **value > floor);
    let range = range(seen.copied())?;
    Some(axis.resolve(Some(range), true))
}

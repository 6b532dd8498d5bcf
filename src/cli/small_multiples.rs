//! Text plots side by side, each on its own axes, so that they can be compared without colour.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::widgets::Widget;

use crate::plot::theme::{Look, Theme};
use crate::plot::{Chart, Curve, Marker, Plot, Scale};

/// Size of one plot, cells.
const SIZE: (u16, u16) = (39, 11);

/// Columns between two plots.
const GAP: u16 = 2;

/// Plots beside each other.
const ACROSS: usize = 2;

/// The charts in rows of two.
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

/// [`draw`] with the axes that hold the curves of all of them, so that they can be compared; nothing where a
/// logarithmic axis has nothing to show.
pub fn draw_alike(mut charts: Vec<Chart>, marker: Marker) -> String {
    let all = |values: fn(&Curve) -> &Vec<f64>, scale: Scale| {
        let curves = charts.iter().flat_map(|chart| &chart.curves);
        let values = curves.flat_map(values).copied();
        match scale {
            Scale::Log => decades(values),
            Scale::Linear => Some([0.0, values.fold(0.0, f64::max)]),
        }
    };
    let scales = charts.first().map(|chart| (chart.x.scale, chart.y.scale));
    let ends = scales.map(|(x, y)| (all(|curve| &curve.xs, x), all(|curve| &curve.ys, y)));
    let Some((Some(x), Some(y))) = ends else {
        return String::new();
    };
    for chart in &mut charts {
        (chart.x.bounds, chart.y.bounds) = (Some(x), Some(y));
    }
    draw(&charts, marker)
}

/// The smallest value on a logarithmic axis; anything below is rounding.
const FLOOR: f64 = 1e-17;

/// The ends of an axis in full decades that holds all positive values; `None` without any.
fn decades(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let seen = values.filter(|value| value.is_finite() && *value > FLOOR);
    let (least, most) = seen.fold((f64::INFINITY, 0.0), |(a, b): (f64, f64), value| {
        (a.min(value), b.max(value))
    });
    if most == 0.0 {
        return None;
    }
    let ends = [least.log10().floor(), most.log10().ceil()];
    let top = if ends[1] <= ends[0] {
        ends[0] + 1.0
    } else {
        ends[1]
    };
    Some([10f64.powf(ends[0]), 10f64.powf(top)])
}

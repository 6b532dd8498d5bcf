//! The legend: names of the curves and, with a cursor, their values there.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::Span;

use super::raster::Raster;
use super::theme::Role;
use super::units::{AxisUnit, format_value};
use super::{Axis, Plot, Scale};
use crate::math::number::shown;

/// Significant digits of a value in the legend.
const DIGITS: usize = 4;

/// Maximum length of a name, in cells; longer names are cut.
const LONGEST_NAME: usize = 24;

/// One line of a legend: its left-aligned and right-aligned text, and its style.
#[derive(Debug, Clone)]
struct Entry {
    left: String,
    right: String,
    style: Style,
}

/// Lines with their position.
#[derive(Debug, Clone)]
pub(super) struct Legend {
    lines: Vec<Entry>,
    /// The area on the screen.
    pub(super) area: Rect,
    /// The number of dots of curves that it covers.
    pub(super) covered: u32,
}

impl Legend {
    /// Places the legend of a plot whose curves are drawn in `raster`. With a cursor it shows the values there if they
    /// fit, with `units` or, if that covers fewer curve dots, as bare numbers; otherwise only names. `None` if nothing
    /// fits or there is nothing to show.
    pub(super) fn arrange(plot: &Plot<'_>, units: [&AxisUnit; 2], raster: &Raster) -> Option<Self> {
        let placed = |x, is_full| Self::place(lines(plot, units, x, is_full), raster);
        let cursor = plot.cursor.filter(|x| x.is_finite());
        let readings = cursor.map(|_| [true, false].map(|is_full| placed(cursor, is_full)));
        let readings = readings.into_iter().flatten().flatten();
        let least = readings.min_by_key(|legend| legend.covered);
        least.or_else(|| placed(None, false))
    }

    /// Places the lines where they cover the fewest dots: in a corner, preferably the top right, or else in the free
    /// place nearest to it. `None` if they take more than half of the width or the height.
    fn place(lines: Vec<Entry>, raster: &Raster) -> Option<Self> {
        let (area, height) = (raster.area, lines.len() as u16);
        let width = lines.iter().map(Entry::width).max().unwrap_or(0);
        if width == 0 || width > area.width / 2 || lines.len() > usize::from(area.height / 2) {
            return None;
        }
        // A blank on the left keeps the swatch from looking like a piece of a curve.
        let covered = |&(x, y): &(u16, u16)| {
            raster.dots_in(Rect::new(x.saturating_sub(1), y, width + 1, height))
        };
        let (right, bottom) = (area.right() - width, area.bottom() - height);
        let corners = [
            (right, area.y),
            (area.x, area.y),
            (right, bottom),
            (area.x, bottom),
        ];
        let corner = corners.into_iter().min_by_key(covered)?;
        let columns = || (area.x..=right).rev().step_by(2);
        let mut others = (area.y..=bottom).flat_map(|y| columns().map(move |x| (x, y)));
        let free = match covered(&corner) {
            0 => None,
            _ => others.find(|place| covered(place) == 0),
        };
        let place = free.unwrap_or(corner);
        Some(Self {
            lines,
            area: Rect::new(place.0, place.1, width, height),
            covered: covered(&place),
        })
    }

    /// Writes the lines.
    pub(super) fn render(&self, buf: &mut Buffer) {
        for (row, line) in self.area.rows().zip(&self.lines) {
            let width = usize::from(row.width);
            buf.set_stringn(row.x, row.y, &line.left, width, line.style);
            let x = row.right().saturating_sub(cells(&line.right));
            buf.set_stringn(x, row.y, &line.right, width, line.style);
        }
    }
}

impl Entry {
    fn width(&self) -> u16 {
        let gap = if self.right.is_empty() { 0 } else { 2 };
        cells(&self.left) + gap + cells(&self.right)
    }
}

/// Returns a line for `x` and one for each named curve. If there is an `x`, a curve's line has its value there: with
/// unit and prefix if `is_full`, else as a bare number in the axis' unit.
fn lines(plot: &Plot<'_>, units: [&AxisUnit; 2], x: Option<f64>, is_full: bool) -> Vec<Entry> {
    let (theme, chart, [x_unit, y_unit]) = (plot.theme, plot.chart, units);
    let header = x.map(|x| Entry {
        left: theme.printable(&chart.x.label),
        right: theme.printable(&with_unit(x, &chart.x, x_unit)),
        style: theme.style(Role::Quiet),
    });
    let curves = chart.named_curves().map(|curve| {
        let swatch = theme.printable(&curve.stroke().swatch().to_string());
        let name = theme.printable(&curve.name);
        let name: String = name.chars().take(LONGEST_NAME).collect();
        let read = match x.map(|x| curve.value_at(x)) {
            None => String::new(),
            Some(None) => "–".to_owned(),
            Some(Some(y)) if is_full => with_unit(y, &chart.y, y_unit),
            Some(Some(y)) => shown(y / y_unit.factor, DIGITS),
        };
        Entry {
            left: format!("{swatch} {name}"),
            right: theme.printable(&read),
            style: theme.style(curve.role),
        }
    });
    header.into_iter().chain(curves).collect()
}

/// Formats a value in the unit of the axis' labels, or in a suitable one if that does not work (log axes, powers of
/// ten, values far below the axis' range).
fn with_unit(value: f64, axis: &Axis, unit: &AxisUnit) -> String {
    let scaled = value / unit.factor;
    let power = unit.text.starts_with(|c: char| c.is_ascii_digit());
    let small = scaled.abs() < 1e-3 && scaled != 0.0;
    if axis.scale == Scale::Log || power || small {
        return format_value(value, axis.unit, DIGITS);
    }
    let text = format!("{} {}", shown(scaled, DIGITS), unit.text);
    text.trim_end().to_owned()
}

/// Returns the values at the cursor in one short line, for a plot too small for a legend: x and as many curve values as
/// fit into `width`, in the axes' `units`.
pub(super) fn short_reading(
    plot: &Plot<'_>,
    [x_unit, y_unit]: [&AxisUnit; 2],
    width: u16,
) -> Option<String> {
    let x = plot.cursor.filter(|x| x.is_finite())?;
    let curves = plot.chart.curves.iter();
    let mut line = format!("{}:", shown(x / x_unit.factor, 3));
    for y in curves.filter_map(|curve| curve.value_at(x)) {
        let longer = format!("{line} {}", shown(y / y_unit.factor, 3));
        if cells(&longer) > width {
            break;
        }
        line = longer;
    }
    line.contains(' ').then_some(line)
}

/// Returns the width of a text in cells.
pub(super) fn cells(text: &str) -> u16 {
    Span::raw(text).width().min(usize::from(u16::MAX)) as u16
}

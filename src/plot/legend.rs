//! The legend: names of the curves and, with a cursor, their values there.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::Span;

use super::raster::Raster;
use super::theme::Role;
use super::units::{AxisUnit, format_number, format_value_in, to_ascii};
use super::{Axis, Curve, Plot, Scale};

/// Significant digits of a reading.
const DIGITS: usize = 4;

/// Names longer than this are cut, in cells.
const LONGEST_NAME: usize = 24;

/// One line: what is left-aligned, what is right-aligned, and how it looks.
#[derive(Debug, Clone)]
struct Line {
    left: String,
    right: String,
    style: Style,
}

/// How the values at the cursor are given.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Reading {
    /// With unit and prefix.
    Full,
    /// As bare numbers, in the axis' unit.
    Bare,
    /// Not at all.
    None,
}

/// A block of lines of one width.
#[derive(Debug, Clone)]
pub(super) struct Legend {
    lines: Vec<Line>,
    width: u16,
}

impl Legend {
    /// The legend of `plot` and its place in `area` (a plot area in buffer cells): with
    /// readings in the axes' `units` if there is a cursor and they fit, as bare numbers
    /// rather than over a curve, else names only; with the dots of curves that it covers. `None` if
    /// nothing fits or there is nothing to say.
    pub(super) fn arrange(
        plot: &Plot<'_>,
        units: [&AxisUnit; 2],
        area: Rect,
        raster: &Raster,
    ) -> Option<(Legend, Rect, u32)> {
        let placed = |reading: Reading| {
            let legend = Legend::new(plot, units, reading);
            let lines = legend.lines.len();
            let fits = legend.width <= area.width / 2 && lines <= usize::from(area.height / 2);
            (fits && legend.width > 0).then(|| {
                let (place, covered) = legend.place(area, raster);
                (legend, place, covered)
            })
        };
        let readings = match plot.cursor {
            Some(x) if x.is_finite() => {
                let (full, bare) = (placed(Reading::Full), placed(Reading::Bare));
                match (full, bare) {
                    (Some(full), Some(bare)) if bare.2 < full.2 => Some(bare),
                    (full, bare) => full.or(bare),
                }
            }
            _ => None,
        };
        readings.or_else(|| placed(Reading::None))
    }

    fn new(plot: &Plot<'_>, units: [&AxisUnit; 2], reading: Reading) -> Legend {
        let header = plot.cursor.filter(|_| reading != Reading::None);
        let named = plot
            .chart
            .curves
            .iter()
            .filter(|curve| !curve.name.is_empty());
        let header = header.map(|x| header_line(plot, units[0], x));
        let curves = named.map(|curve| curve_line(plot, curve, units[1], reading));
        Legend::block(header.into_iter().chain(curves).collect())
    }

    fn block(lines: Vec<Line>) -> Legend {
        let width = |line: &Line| {
            let gap = if line.right.is_empty() { 0 } else { 2 };
            cells(&line.left) + gap + cells(&line.right)
        };
        let width = lines.iter().map(width).max().unwrap_or(0);
        Legend { lines, width }
    }

    /// The place in `area` where the legend covers the fewest dots, and how many: a corner, the top right
    /// one first, or the place nearest to the top right where no curve is.
    fn place(&self, area: Rect, raster: &Raster) -> (Rect, u32) {
        let height = self.lines.len() as u16;
        let (right, bottom) = (area.width - self.width, area.height - height);
        // A blank to the left keeps the swatch from looking like a piece of a curve.
        let covered = |x: u16, y: u16| {
            let left = x.saturating_sub(1);
            raster.dots_in(Rect::new(left, y, self.width + x - left, height))
        };
        let corners = [(right, 0), (0, 0), (right, bottom), (0, bottom)];
        let mut best = (u32::MAX, right, 0);
        for (x, y) in corners {
            let dots = covered(x, y);
            if dots < best.0 {
                best = (dots, x, y);
            }
        }
        if best.0 > 0 {
            let rows = (0..=bottom).flat_map(|y| (0..=right).rev().step_by(2).map(move |x| (x, y)));
            if let Some((x, y)) = rows.into_iter().find(|&(x, y)| covered(x, y) == 0) {
                best = (0, x, y);
            }
        }
        let place = Rect::new(area.x + best.1, area.y + best.2, self.width, height);
        (place, best.0)
    }

    /// Writes the lines into `area`, which [`Legend::arrange`] gave.
    pub(super) fn render(&self, area: Rect, buf: &mut Buffer) {
        for (row, line) in area.rows().zip(&self.lines) {
            let width = usize::from(row.width);
            buf.set_stringn(row.x, row.y, &line.left, width, line.style);
            let x = row.right().saturating_sub(cells(&line.right));
            buf.set_stringn(x, row.y, &line.right, width, line.style);
        }
    }
}

/// The reading of the cursor itself.
fn header_line(plot: &Plot<'_>, unit: &AxisUnit, x: f64) -> Line {
    let (axis, ascii) = (&plot.chart.x, plot.theme.ascii());
    Line {
        left: text(&axis.label, ascii),
        right: with_unit(x, axis, unit, ascii),
        style: plot.theme.style(Role::Quiet),
    }
}

fn curve_line(plot: &Plot<'_>, curve: &Curve, unit: &AxisUnit, reading: Reading) -> Line {
    let ascii = plot.theme.ascii();
    let swatch = curve.stroke().swatch(ascii);
    let name = plot.theme.printable(&curve.name);
    let name: String = name.chars().take(LONGEST_NAME).collect();
    let value = plot.cursor.and_then(|x| curve.value_at(x));
    Line {
        left: format!("{swatch} {name}"),
        right: match (reading, value) {
            (Reading::None, _) => String::new(),
            (_, None) => if ascii { "-" } else { "–" }.to_owned(),
            (Reading::Full, Some(y)) => with_unit(y, &plot.chart.y, unit, ascii),
            (Reading::Bare, Some(y)) => format_number(y / unit.factor, DIGITS),
        },
        style: Style {
            bg: None,
            ..plot.theme.style(curve.role)
        },
    }
}

/// A reading in the unit its axis is labelled in; in one of its own where the axis has none
/// for it (log axes, powers of ten, values far below the axis' range).
fn with_unit(value: f64, axis: &Axis, unit: &AxisUnit, ascii: bool) -> String {
    let scaled = value / unit.factor;
    let power = unit.text.starts_with(|c: char| c.is_ascii_digit());
    let small = scaled.abs() < 1e-3 && scaled != 0.0;
    if axis.scale == Scale::Log || power || small {
        return format_value_in(value, axis.unit, DIGITS, ascii);
    }
    let text = format!("{} {}", format_number(scaled, DIGITS), unit.text);
    text.trim_end().to_owned()
}

/// The cursor's readings in one short line, for a plot too small for a legend: its place
/// and as many values of curves as fit `width`, in multiples `factors` of the axes' units.
pub(super) fn short_reading(plot: &Plot<'_>, factors: [f64; 2], width: u16) -> Option<String> {
    let x = plot.cursor.filter(|x| x.is_finite())?;
    let mut line = format!("{}:", format_number(x / factors[0], 3));
    for y in plot
        .chart
        .curves
        .iter()
        .filter_map(|curve| curve.value_at(x))
    {
        let longer = format!("{line} {}", format_number(y / factors[1], 3));
        if cells(&longer) > width {
            break;
        }
        line = longer;
    }
    line.contains(' ').then_some(line)
}

/// A label as it is shown.
pub(super) fn text(label: &str, ascii: bool) -> String {
    let folded = if ascii { to_ascii(label) } else { label.into() };
    folded.into_owned()
}

/// The width of a text in cells.
pub(super) fn cells(text: &str) -> u16 {
    Span::raw(text).width().min(usize::from(u16::MAX)) as u16
}

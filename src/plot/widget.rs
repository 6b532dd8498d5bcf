//! The layout: where titles, ticks, plot area, band and labels go.

use std::ops::Range;

use ratatui::buffer::Buffer;
use ratatui::layout::{self, Rect};
use ratatui::style::{Color, Style};
use ratatui::widgets::Widget;

use super::Plot;
use super::axis::{Scale, titled};
use super::chart::Fill;
use super::legend::{self, Legend, cells, text};
use super::marker::Under;
use super::raster::{Position, Raster};
use super::stroke::Stroke;
use super::theme::Role;
use super::ticks::{Labels, Tick, ticks};
use super::units::AxisUnit;
use super::window::Window;

/// The smallest area that gets axes, in cells.
const SMALLEST: (u16, u16) = (12, 4);

impl Widget for Plot<'_> {
    fn render(self, area: Rect, buf: &mut Buffer) {
        (&self).render(area, buf);
    }
}

impl Plot<'_> {
    /// The abscissa, in the x axis' unit, under a cell of the screen where the plot is drawn in `area`;
    /// none outside of the curves' own part of it.
    pub fn abscissa_at(&self, area: Rect, cell: layout::Position) -> Option<f64> {
        if area.is_empty() {
            return None;
        }
        let frame = Frame::of(self, area);
        let column = cell.x.checked_sub(frame.inner.x)?;
        let middle = frame.x.cell_middle(column);
        frame.inner.contains(cell).then(|| frame.x.value(middle))
    }
}

impl Widget for &Plot<'_> {
    fn render(self, area: Rect, buf: &mut Buffer) {
        let area = area.intersection(buf.area);
        if area.is_empty() {
            return;
        }
        let frame = Frame::of(self, area);
        let mut raster = frame.raster();
        if area.width >= SMALLEST.0 && area.height >= SMALLEST.1 {
            frame.words(&mut raster, buf);
            frame.axes(buf);
        }
        raster.render(frame.inner.x, frame.inner.y, buf);
        frame.signs(buf);
    }
}

/// The same window with an upper end a little higher, so that the ticks of a linear axis are the same
/// number of rows apart; as it was where that would leave too much of it empty.
fn even(window: Window, unit: &AxisUnit) -> Window {
    let [lo, hi] = window.bounds();
    let found = ticks(&window, unit.factor, Labels::Column);
    let [first, second, ..] = &found[..] else {
        return window;
    };
    let dots = window.dots() as f64 - 1.0;
    let per_cell = (window.dots() / usize::from(window.cells()).max(1)) as f64;
    let step = second.value - first.value;
    // The lower end must lie on a tick, or its row would not be the one that the others count from.
    let on_tick = ((lo / step).round() * step - lo).abs() < 1e-6 * step;
    if window.scale() == Scale::Log || !on_tick {
        return window;
    }
    [1.0, 2.0, 5.0]
        .into_iter()
        .filter_map(|times| {
            let step = times * step;
            let rows = (dots / per_cell / ((hi - lo) / step) + 1e-9).floor();
            let end = lo + step * dots / (per_cell * rows);
            let aligned = ((lo / step).round() * step - lo).abs() < 1e-6 * step;
            (rows >= 1.0 && aligned && end <= lo + 1.3 * (hi - lo)).then_some(end)
        })
        .reduce(f64::min)
        .map_or(window, |end| window.up_to(end))
}

/// Where the name of a zone of `width` cells from `first` on begins, in a band of `cells`. Zones change
/// with every frame, and a name that stayed in their middle could not be read: it keeps to the end that the
/// zone shares with the band, else to every fourth cell.
fn name_start(first: u16, width: u16, name: u16, cells: u16) -> u16 {
    const MARGIN: u16 = 2;
    const EVERY: u16 = 4;
    let (room, middle) = (width - name, first + (width - name) / 2);
    if first == 0 {
        room.min(MARGIN)
    } else if first + width == cells {
        first + room - room.min(MARGIN)
    } else {
        let near = (middle + EVERY / 2) / EVERY * EVERY;
        if (first..=first + room).contains(&near) {
            near
        } else {
            middle
        }
    }
}

/// Everything placed: the plot area, the maps on it, and the ticks around it.
struct Frame<'p> {
    plot: &'p Plot<'p>,
    area: Rect,
    inner: Rect,
    /// Rows of the band, the axis line and the tick labels.
    band_row: Option<u16>,
    line_row: Option<u16>,
    label_row: u16,
    x: Window,
    y: Window,
    x_unit: AxisUnit,
    y_unit: AxisUnit,
    x_ticks: Vec<Tick>,
    y_ticks: Vec<Tick>,
}

impl<'p> Frame<'p> {
    fn of(plot: &'p Plot<'p>, area: Rect) -> Self {
        let [x_data, y_data] = plot.chart.extent(|_| true);
        let x_bounds = plot.chart.x.resolve(x_data, false);
        let y_bounds = plot.chart.y.resolve(y_data, true);
        Self::new(plot, area, x_bounds, y_bounds)
    }

    fn new(plot: &'p Plot<'p>, area: Rect, x_bounds: [f64; 2], y_bounds: [f64; 2]) -> Self {
        let bare = area.width < SMALLEST.0 || area.height < SMALLEST.1;
        let ascii = plot.theme.ascii();
        let x_unit = plot.chart.x.unit_for(x_bounds, ascii);
        let y_unit = plot.chart.y.unit_for(y_bounds, ascii);
        let (across, down) = plot.theme.marker.dots();

        // Rows, from the bottom up: labels, axis line, band, plot; the title on top.
        let mut bottom = area.bottom();
        let mut take = |wanted: bool| {
            bottom -= u16::from(wanted);
            wanted.then_some(bottom)
        };
        let label_row = take(!bare).unwrap_or(0);
        let has_band = !bare && !plot.chart.band.is_empty() && area.height >= 5;
        let line_row = take(!bare && area.height >= 8 + u16::from(has_band));
        let band_row = take(has_band);
        let top = area.y + u16::from(!bare);
        let rows = bottom.saturating_sub(top);

        let y = even(
            Window::new(y_bounds, plot.chart.y.scale, rows, down),
            &y_unit,
        );
        let mut y_ticks = ticks(&y, y_unit.factor, Labels::Column);
        let mut gutter = y_ticks
            .iter()
            .map(|tick| cells(&tick.label))
            .max()
            .unwrap_or(0);
        if bare || gutter > area.width / 3 {
            y_ticks.clear();
            gutter = 0;
        }
        let left = if bare { 0 } else { gutter + 1 };
        let inner = Rect::new(area.x + left, top, area.width - left, rows);
        let x = Window::new(x_bounds, plot.chart.x.scale, inner.width, across);
        let row = Labels::Row {
            before: left,
            apart: 0,
        };
        let x_ticks = ticks(&x, x_unit.factor, row);
        Frame {
            plot,
            area,
            inner,
            band_row,
            line_row,
            label_row,
            x,
            y,
            x_unit,
            y_unit,
            x_ticks,
            y_ticks,
        }
    }

    /// The dots: fills, rules, curves in their order.
    fn raster(&self) -> Raster {
        let (plot, rule) = (self.plot, self.plot.theme.style(Role::Faint));
        let style = |role| plot.theme.style(role);
        let mut raster = Raster::new(self.inner.width, self.inner.height, plot.theme.marker);
        let place =
            |(x, y): (f64, f64)| -> Position { Some((self.x.position(x)?, self.y.position(y)?)) };
        for curve in &plot.chart.curves {
            let style = style(curve.role);
            match &curve.fill {
                Fill::None => {}
                Fill::To(base) => {
                    // A base without a place (zero on a log axis) lies below everything.
                    let base = self.y.position(*base).unwrap_or(-1.0);
                    let points = curve.points();
                    raster.fill(points.map(|point| (place(point), Some(base))), style);
                }
                Fill::From(bases) => {
                    let between = curve.points().zip(bases);
                    let between = between.map(|(at, &base)| (place(at), self.y.position(base)));
                    raster.fill(between, style);
                }
            }
        }
        let crosses = |[lo, hi]: [f64; 2]| lo < 0.0 && hi > 0.0;
        if let Some(row) = self.y.dot(0.0).filter(|_| crosses(self.y.bounds())) {
            raster.zero_line(row, rule);
        }
        if let Some(column) = self.x.dot(0.0).filter(|_| crosses(self.x.bounds())) {
            raster.vertical(column, Under::Zero, rule);
        }
        for mark in &plot.chart.marks {
            if let Some(column) = self.x.dot(mark.x) {
                raster.vertical(column, Under::Mark, style(mark.role));
            }
        }
        if let Some(column) = plot.cursor.and_then(|x| self.x.dot(x)) {
            raster.vertical(column, Under::Cursor, style(Role::Quiet));
        }
        for curve in &plot.chart.curves {
            let style = style(curve.role);
            raster.line(curve.points().map(place), style, curve.stroke());
            raster.line(curve.bars().map(place), style, Stroke::Solid);
        }
        raster
    }

    /// Points with a sign of their own, and arrows where a curve leaves through the top.
    fn signs(&self, buf: &mut Buffer) {
        let ascii = self.plot.theme.ascii();
        let top = self.y.bounds()[1];
        for curve in &self.plot.chart.curves {
            let style = self.plot.theme.style(curve.role);
            let beyond = curve.points().chain(curve.bars());
            let beyond = beyond.filter(|(x, y)| x.is_finite() && *y > top * (1.0 + 1e-9));
            for column in beyond.filter_map(|(x, _)| self.x.cell(x)) {
                let sign = if ascii { '^' } else { '▲' };
                glyph(buf, self.inner.x + column, self.inner.y, sign, style);
            }
        }
        for point in &self.plot.chart.points {
            if let (Some(column), Some(row)) = (self.x.cell(point.at[0]), self.y.cell(point.at[1]))
            {
                let y = self.inner.bottom() - 1 - row;
                let sign = text(point.sign.encode_utf8(&mut [0; 4]), ascii);
                let sign = sign.chars().next().unwrap_or('o');
                let style = self.plot.theme.style(point.role);
                glyph(buf, self.inner.x + column, y, sign, style);
            }
        }
    }

    /// Axis lines, ticks and their labels, and the band.
    fn axes(&self, buf: &mut Buffer) {
        let ascii = self.plot.theme.ascii();
        let [upright, y_tick, level, x_tick, corner] = if ascii {
            ['|', '+', '-', '+', '+']
        } else {
            ['│', '┤', '─', '┬', '└']
        };
        let (theme, inner) = (self.plot.theme, self.inner);
        let (style, rule) = (theme.style(Role::Quiet), theme.style(Role::Faint));
        let axis_x = inner.x.saturating_sub(1);
        for y in inner.y..self.line_row.unwrap_or(self.label_row) {
            glyph(buf, axis_x, y, upright, rule);
        }
        for tick in &self.y_ticks {
            let y = inner.bottom() - 1 - tick.cell;
            glyph(buf, axis_x, y, y_tick, rule);
            let x = axis_x.saturating_sub(cells(&tick.label));
            self.write(buf, x, y, &tick.label, style);
        }
        if let Some(y) = self.line_row {
            glyph(buf, axis_x, y, corner, rule);
            for x in inner.left()..inner.right() {
                glyph(buf, x, y, level, rule);
            }
            for tick in &self.x_ticks {
                glyph(buf, inner.x + tick.cell, y, x_tick, rule);
            }
        }
        if let Some(y) = self.band_row {
            self.band(y, buf);
        }
        for tick in &self.x_ticks {
            let start = tick.label_start(inner.width, inner.x - self.area.x);
            let x = inner.x.saturating_add_signed(start as i16);
            self.write(buf, x, self.label_row, &tick.label, style);
        }
    }

    fn band(&self, y: u16, buf: &mut Buffer) {
        let ascii = self.plot.theme.ascii();
        for zone in &self.plot.chart.band {
            let style = self.plot.theme.style(zone.role);
            let ends = [zone.from, zone.to].map(|x| self.x.position(x));
            let [Some(a), Some(b)] = ends else { continue };
            let (from, to) = (a.min(b), a.max(b));
            let inside = |cell: &u16| (from..=to).contains(&self.x.cell_middle(*cell));
            let mut painted: Vec<u16> = (0..self.x.cells()).filter(inside).collect();
            let last = self.x.dots() as f64 - 0.5;
            let middle = (from / 2.0 + to / 2.0).round();
            if painted.is_empty() && from < to && middle >= 0.0 && middle <= last {
                let (across, _) = self.plot.theme.marker.dots();
                painted.push(middle as u16 / across);
            }
            let coloured = style.fg.is_some_and(|colour| colour != Color::Reset);
            let letter = text(zone.glyph.encode_utf8(&mut [0; 4]), ascii);
            let letter = letter.chars().next().unwrap_or(' ');
            let sign = if coloured && !ascii { '▀' } else { letter };
            let (first, width) = (painted.first().copied(), painted.len() as u16);
            for cell in painted {
                glyph(buf, self.inner.x + cell, y, sign, style);
            }
            let name = format!(" {} ", text(zone.name, ascii));
            if let Some(first) = first.filter(|_| !zone.name.is_empty() && cells(&name) <= width) {
                let start = name_start(first, width, cells(&name), self.x.cells());
                self.write(buf, self.inner.x + start, y, &name, style);
            }
        }
    }

    /// The legend, the title row, and the labels of the marks; the dots below them go.
    fn words(&self, raster: &mut Raster, buf: &mut Buffer) {
        let (plot, area, inner) = (self.plot, self.area, self.inner);
        let quiet = plot.theme.style(Role::Quiet);
        let local = |spot: Rect| Rect {
            x: spot.x.saturating_sub(inner.x),
            y: spot.y.saturating_sub(inner.y),
            ..spot
        };
        let ascii = plot.theme.ascii();
        let legend = Legend::arrange(plot, [&self.x_unit, &self.y_unit], inner, raster);
        // Rather than over a curve, its name stands at its end.
        let covers = matches!(legend, Some((.., covered)) if covered > 0 && plot.cursor.is_none());
        let at_ends = if covers {
            self.names_at_ends(raster)
        } else {
            None
        };
        let legend = legend.filter(|_| at_ends.is_none());
        for (place, name, style) in at_ends.into_iter().flatten() {
            self.write(buf, place.x, place.y, &name, style);
        }
        let legend = legend.map(|(legend, block, _)| (legend, block));
        if let Some((legend, block)) = &legend {
            raster.blank(local(*block));
            legend.render(*block, buf);
        }

        let title = text(&plot.chart.y.label, ascii);
        let title = titled(&title, &self.y_unit.text, ['[', ']']);
        self.write(buf, area.x, area.y, &title, quiet);
        let left = (area.x + cells(&title)).min(area.right());
        let mut free = left + u16::from(left > area.x)..area.right();
        free.end -= self.x_title(free.clone(), buf);

        let room = free.end.saturating_sub(free.start + 1);
        let reading = match &legend {
            None => legend::short_reading(plot, [self.x_unit.factor, self.y_unit.factor], room),
            Some(_) => None,
        };
        let note = reading.unwrap_or_else(|| text(&plot.chart.note, ascii));
        if !note.is_empty() && cells(&note) <= room {
            free.end -= cells(&note);
            self.write(buf, free.end, area.y, &note, quiet);
            free.end -= 1;
        }

        // From left to right: a label takes the room of the title row up to its own end.
        let mut marks: Vec<_> = plot.chart.marks.iter().collect();
        marks.sort_by(|a, b| a.x.total_cmp(&b.x));
        for mark in marks {
            let label = text(mark.label, ascii);
            let Some(cell) = self.x.cell(mark.x).filter(|_| !label.is_empty()) else {
                continue;
            };
            let (column, width) = (inner.x + cell, cells(&label));
            let x = column.saturating_sub(width / 2);
            if x >= free.start && x + width <= free.end {
                self.write(buf, x, area.y, &label, plot.theme.style(mark.role));
                free.start = x + width + 1;
                continue;
            }
            // No place above the line: beside its upper end, unless a curve passes there.
            let beside = [Some(column + 1), column.checked_sub(width)];
            let place = beside.into_iter().flatten().find(|&x| {
                let spot = Rect::new(x, inner.y, width, 1);
                let around = Rect::new(x.saturating_sub(1), inner.y, width + 2, 1);
                inner.intersection(spot) == spot
                    && raster.dots_in(local(spot)) == 0
                    && legend
                        .as_ref()
                        .is_none_or(|(_, block)| !block.intersects(around))
            });
            if let Some(x) = place {
                raster.blank(local(Rect::new(x, inner.y, width, 1)));
                self.write(buf, x, inner.y, &label, plot.theme.style(mark.role));
            }
        }
    }

    /// Writes what the abscissa is into the rule above the plot, where there is one with room for it, else to the
    /// right end of the `free` part of the title row; returns the cells that it takes there. In the row of the ticks
    /// it would stand where the last of them is.
    fn x_title(&self, free: Range<u16>, buf: &mut Buffer) -> u16 {
        let ascii = self.plot.theme.ascii();
        let label = text(&self.plot.chart.x.label, ascii);
        let title = |label: &str| match titled(label, &self.x_unit.text, ['[', ']']) {
            title if title.is_empty() => title,
            title => format!(" {title} {}", if ascii { ">" } else { "→" }),
        };
        let quiet = self.plot.theme.style(Role::Quiet);
        let whole = title(&label);
        if let Some(rule) = self.plot.rule.filter(|rule| cells(&whole) <= rule.width) {
            // The rule is dim; what stands in it is not.
            let style = Style::reset().patch(quiet);
            buf.set_string(rule.right() - cells(&whole), rule.y, whole, style);
            return 0;
        }
        let room = free.end.saturating_sub(free.start);
        let fitting = [whole, title("")];
        let Some(title) = fitting.iter().find(|title| cells(title) <= room) else {
            return 0;
        };
        self.write(buf, free.end - cells(title), self.area.y, title, quiet);
        cells(title)
    }

    /// The names of the curves above or below their last points, where no curve is; `None` unless each has its place.
    fn names_at_ends(&self, raster: &Raster) -> Option<Vec<(Rect, String, Style)>> {
        let (theme, inner) = (self.plot.theme, self.inner);
        let mut placed: Vec<(Rect, String, Style)> = Vec::new();
        let named = self.plot.chart.curves.iter();
        for curve in named.filter(|curve| !curve.name.is_empty()) {
            let name = theme.printable(&curve.name);
            let width = cells(&name);
            let seen = curve.points();
            let seen = seen.filter_map(|(x, y)| Some((self.x.cell(x)?, self.y.cell(y)?)));
            let (column, row) = seen.last()?;
            let start = (column + 1).saturating_sub(width);
            let row = inner.height - 1 - row;
            let rows = [row.checked_sub(1), Some(row + 1)].into_iter().flatten();
            let mut spots = rows.map(|row| Rect::new(start, row, width, 1));
            let spot = spots.find(|spot| {
                spot.right() <= inner.width
                    && spot.bottom() <= inner.height
                    && raster.dots_in(*spot) == 0
            })?;
            let place = Rect::new(inner.x + spot.x, inner.y + spot.y, width, 1);
            if placed.iter().any(|(other, ..)| other.intersects(place)) {
                return None;
            }
            placed.push((place, name, theme.style(curve.role)));
        }
        Some(placed)
    }

    /// Writes `words` from (`x`, `y`) on, no farther than the area.
    fn write(&self, buf: &mut Buffer, x: u16, y: u16, words: &str, style: Style) {
        let room = usize::from(self.area.right().saturating_sub(x));
        if room > 0 && (self.area.top()..self.area.bottom()).contains(&y) {
            buf.set_stringn(x, y, words, room, style);
        }
    }
}

fn glyph(buf: &mut Buffer, x: u16, y: u16, sign: char, style: Style) {
    if let Some(cell) = buf.cell_mut((x, y)) {
        cell.set_char(sign).set_style(style);
    }
}

//! The layout: where titles, ticks, plot area, band and labels go.

use std::ops::Range;

use ratatui::buffer::Buffer;
use ratatui::buffer::Cell;
use ratatui::layout::{self, Rect, Size};
use ratatui::style::{Color, Style};
use ratatui::widgets::Widget;

use super::Plot;
use super::axis::{Axis, titled};
use super::chart::Fill;
use super::legend::{self, Legend, cells};
use super::map::{Map, ink_on};
use super::marker::Under;
use super::raster::{Position, Raster};
use super::shades::{has_blocks, paint_halves};
use super::stroke::Stroke;
use super::theme::Role;
use super::ticks::{Labels, Ruler};
use super::window::Window;

/// The smallest area that gets axes, in cells.
const SMALLEST: (u16, u16) = (12, 4);

impl Plot<'_> {
    /// The abscissa, in the x axis' unit, under a cell of the screen where the plot is drawn in `area`;
    /// none outside of the curves' own part of it.
    pub fn abscissa_at(&self, area: Rect, cell: layout::Position) -> Option<f64> {
        if area.is_empty() {
            return None;
        }
        let frame = Frame::new(self, area);
        let window = frame.x.window;
        let column = cell.x.checked_sub(frame.inner.x)?;
        frame.inner.contains(cell).then(|| window.middle(column, 1))
    }
}

impl Widget for Plot<'_> {
    fn render(self, area: Rect, buf: &mut Buffer) {
        let area = area.intersection(buf.area);
        if area.is_empty() {
            return;
        }
        let frame = Frame::new(&self, area);
        let mut raster = frame.raster();
        if !is_bare(area) {
            frame.words(&mut raster, buf);
            frame.axes(buf);
        }
        let map = self.chart.map.as_ref();
        map.inspect(|map| frame.map(map, buf));
        raster.render(buf);
        if map.is_some() {
            let places = frame.inner.positions();
            for place in places.filter(|place| raster.dots_in((*place, SINGLE).into()) > 0) {
                frame.ink(buf.cell_mut(place));
            }
        }
        frame.signs(buf);
    }
}

/// One cell.
const SINGLE: Size = Size::new(1, 1);

/// Whether an area has no room for axes.
fn is_bare(area: Rect) -> bool {
    area.width < SMALLEST.0 || area.height < SMALLEST.1
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
        let near = Some((middle + EVERY / 2) / EVERY * EVERY);
        near.filter(|near| (first..=first + room).contains(near))
            .unwrap_or(middle)
    }
}

/// Everything placed: the plot area, and the axes around it.
struct Frame<'p> {
    plot: &'p Plot<'p>,
    area: Rect,
    inner: Rect,
    /// Rows of the band, the axis line and the tick labels.
    band_row: Option<u16>,
    line_row: Option<u16>,
    label_row: u16,
    x: Ruler,
    y: Ruler,
}

impl<'p> Frame<'p> {
    fn new(plot: &'p Plot<'p>, area: Rect) -> Self {
        let (chart, bare) = (plot.chart, is_bare(area));
        let [x_data, y_data] = chart.extent(|_| true);
        let (x_bounds, y_bounds) = (
            chart.x.resolve(x_data, false),
            chart.y.resolve(y_data, true),
        );
        let ascii = plot.theme.ascii();
        let (across, down) = plot.theme.marker.dots();

        // Rows, from the bottom up: labels, axis line, band, plot; the title on top.
        let mut bottom = area.bottom();
        let mut take = |wanted: bool| {
            bottom -= u16::from(wanted);
            wanted.then_some(bottom)
        };
        let label_row = take(!bare).unwrap_or(0);
        let has_band = !bare && !chart.band.is_empty() && area.height >= 5;
        let line_row = take(!bare && area.height >= 8 + u16::from(has_band));
        let band_row = take(has_band);
        let top = area.y + u16::from(!bare);
        let rows = bottom.saturating_sub(top);

        let window = Window::new(y_bounds, chart.y.scale, rows, down);
        let unit = chart.y.unit_for(y_bounds, ascii);
        let mut y = Ruler::new(window, unit, Labels::Column);
        if chart.map.is_none() {
            y = y.even();
        }
        let labels = y.ticks.iter().map(|tick| cells(&tick.label));
        let mut gutter = labels.max().unwrap_or(0);
        if bare || gutter > area.width / 3 {
            y.ticks.clear();
            gutter = 0;
        }
        let left = if bare { 0 } else { gutter + 1 };
        let inner = Rect::new(area.x + left, top, area.width - left, rows);
        let window = Window::new(x_bounds, chart.x.scale, inner.width, across);
        let unit = chart.x.unit_for(x_bounds, ascii);
        Frame {
            plot,
            area,
            inner,
            band_row,
            line_row,
            label_row,
            x: Ruler::new(window, unit, Labels::Row(left)),
            y,
        }
    }

    /// The dots: fills, rules, curves in their order.
    fn raster(&self) -> Raster {
        let (plot, x, y) = (self.plot, self.x.window, self.y.window);
        let (theme, curves) = (plot.theme, &plot.chart.curves);
        let rule = theme.style(Role::Faint);
        let mut raster = Raster::new(self.inner, theme.marker);
        let place = |(a, b): (f64, f64)| -> Position { Some([x.position(a)?, y.position(b)?]) };
        for curve in curves {
            let (points, style) = (curve.points(), theme.style(curve.role));
            match &curve.fill {
                Fill::None => {}
                Fill::To(base) => {
                    // A base without a place (zero on a log axis) lies below everything.
                    let base = y.position(*base).unwrap_or(-1.0);
                    raster.fill(points.map(|point| (place(point), Some(base))), style);
                }
                Fill::From(bases) => {
                    let between = points.zip(bases);
                    let between = between.map(|(at, &base)| (place(at), y.position(base)));
                    raster.fill(between, style);
                }
            }
        }
        let zero = |window: Window| {
            let [lo, hi] = window.bounds;
            let is_within = lo < 0.0 && hi > 0.0 && plot.chart.map.is_none();
            window.dot(0.0).filter(|_| is_within)
        };
        if let Some(row) = zero(y) {
            raster.zero_line(row, rule);
        }
        if let Some(column) = zero(x) {
            raster.vertical(column, Under::Zero, rule);
        }
        for mark in &plot.chart.marks {
            if let Some(column) = x.dot(mark.x) {
                raster.vertical(column, Under::Mark, theme.style(mark.role));
            }
        }
        if let Some(column) = plot.cursor.and_then(|at| x.dot(at)) {
            raster.vertical(column, Under::Cursor, theme.style(Role::Quiet));
        }
        for curve in curves {
            let style = theme.style(curve.role);
            raster.line(curve.points().map(place), style, curve.stroke());
            raster.line(curve.bars().map(place), style, Stroke::Solid);
        }
        raster
    }

    /// The map, upwards in half cells where there are colours: each shows the place that its middle belongs to.
    fn map(&self, map: &Map, buf: &mut Buffer) {
        let (theme, chart, range) = (self.plot.theme, self.plot.chart, map.range());
        let parts = 1 + u16::from(has_blocks(theme));
        // The places of cells or halves: as many edges lie before their middles.
        let places = |axis: &Axis, places: &[f64], window: Window, parts: u16| -> Vec<usize> {
            let edges = axis.edges(places);
            let (inner, rises) = (&edges[1..places.len()], edges[0] < edges[places.len()]);
            let is_before = |edge: f64, middle: f64| (edge <= middle) == rises;
            let middles = (0..window.cells * parts).map(|part| window.middle(part, parts));
            let before = |middle| inner.iter().filter(move |&&edge| is_before(edge, middle));
            middles.map(|middle| before(middle).count()).collect()
        };
        let [xs, ys] = &map.places;
        let columns = places(&chart.x, xs, self.x.window, 1);
        let rows = places(&chart.y, ys, self.y.window, parts);
        for (column, x) in columns.into_iter().enumerate() {
            for (row, halves) in rows.chunks(usize::from(parts)).enumerate() {
                let [column, row] = [column, row].map(|place| place as u16);
                let place = (self.inner.x + column, self.inner.bottom() - 1 - row);
                let seen = |half: usize| {
                    let value = map.values[halves[half] * xs.len() + x];
                    map.look(value, range, theme)
                };
                let Some(cell) = buf.cell_mut(place) else {
                    continue;
                };
                match parts {
                    1 => _ = cell.set_char(seen(0).1),
                    _ => paint_halves(cell, [seen(1).0, seen(0).0]),
                }
            }
        }
    }

    /// Gives a sign on the map a colour that is seen there.
    fn ink(&self, cell: Option<&mut Cell>) {
        if let Some(cell) = cell.filter(|_| self.plot.theme.colored()) {
            cell.fg = ink_on(cell.bg);
        }
    }

    /// Points with a sign of their own, and arrows where a curve leaves through the top.
    fn signs(&self, buf: &mut Buffer) {
        let (plot, x, y) = (self.plot, self.x.window, self.y.window);
        let top = y.bounds[1] * (1.0 + 1e-9);
        for curve in &plot.chart.curves {
            let style = plot.theme.style(curve.role);
            let beyond = curve.points().chain(curve.bars());
            let beyond = beyond.filter(|(x, y)| x.is_finite() && *y > top);
            for column in beyond.filter_map(|(at, _)| x.cell(at)) {
                let place = (self.inner.x + column, self.inner.y);
                glyph(buf, place, self.sign('▲'), style);
            }
        }
        for point in &plot.chart.points {
            if let (Some(column), Some(row)) = (x.cell(point.at[0]), y.cell(point.at[1])) {
                let place = (self.inner.x + column, self.inner.bottom() - 1 - row);
                let style = plot.theme.style(point.role);
                glyph(buf, place, self.sign(point.sign), style);
                if plot.chart.map.is_some() {
                    self.ink(buf.cell_mut(place));
                }
            }
        }
    }

    /// A sign as the terminal can show it.
    fn sign(&self, sign: char) -> char {
        let text = self.plot.theme.printable(&sign.to_string());
        text.chars().next().unwrap_or(' ')
    }

    /// Axis lines, ticks and their labels, and the band.
    fn axes(&self, buf: &mut Buffer) {
        let [upright, y_tick, level, x_tick, corner] = if self.plot.theme.ascii() {
            ['|', '+', '-', '+', '+']
        } else {
            ['│', '┤', '─', '┬', '└']
        };
        let (theme, inner) = (self.plot.theme, self.inner);
        let (style, rule) = (theme.style(Role::Quiet), theme.style(Role::Faint));
        let axis_x = inner.x.saturating_sub(1);
        for y in inner.y..self.line_row.unwrap_or(self.label_row) {
            glyph(buf, (axis_x, y), upright, rule);
        }
        for tick in &self.y.ticks {
            let y = inner.bottom() - 1 - tick.cell;
            glyph(buf, (axis_x, y), y_tick, rule);
            let x = axis_x.saturating_sub(cells(&tick.label));
            self.write(buf, x, y, &tick.label, style);
        }
        if let Some(y) = self.line_row {
            glyph(buf, (axis_x, y), corner, rule);
            for x in inner.left()..inner.right() {
                glyph(buf, (x, y), level, rule);
            }
        }
        self.band(buf);
        for tick in &self.x.ticks {
            if let Some(y) = self.line_row {
                glyph(buf, (inner.x + tick.cell, y), x_tick, rule);
            }
            let start = tick.label_start(inner.width, inner.x - self.area.x);
            let x = inner.x.saturating_add_signed(start as i16);
            self.write(buf, x, self.label_row, &tick.label, style);
        }
    }

    fn band(&self, buf: &mut Buffer) {
        let (theme, window) = (self.plot.theme, self.x.window);
        let Some(y) = self.band_row else { return };
        for zone in &self.plot.chart.band {
            let style = theme.style(zone.role);
            let ends = [zone.from, zone.to].map(|x| window.position(x));
            let [Some(a), Some(b)] = ends else { continue };
            let (from, to) = (a.min(b), a.max(b));
            let inside = |cell: &u16| (from..=to).contains(&window.cell_middle(*cell));
            let mut painted: Vec<u16> = (0..window.cells).filter(inside).collect();
            let last = window.dots() as f64 - 0.5;
            let middle = (from / 2.0 + to / 2.0).round();
            if painted.is_empty() && from < to && middle >= 0.0 && middle <= last {
                painted.push(middle as u16 / theme.marker.dots().0);
            }
            let Some(&first) = painted.first() else {
                continue;
            };
            let coloured = style.fg.is_some_and(|colour| colour != Color::Reset);
            let sign = match coloured && !theme.ascii() {
                true => '▀',
                false => self.sign(zone.glyph),
            };
            let width = painted.len() as u16;
            for cell in painted {
                glyph(buf, (self.inner.x + cell, y), sign, style);
            }
            let name = format!(" {} ", theme.printable(zone.name));
            if !zone.name.is_empty() && cells(&name) <= width {
                let start = name_start(first, width, cells(&name), window.cells);
                self.write(buf, self.inner.x + start, y, &name, style);
            }
        }
    }

    /// The legend, the title row, and the labels of the marks; the dots below them go.
    fn words(&self, raster: &mut Raster, buf: &mut Buffer) {
        let (plot, area, inner) = (self.plot, self.area, self.inner);
        let (theme, units) = (plot.theme, [&self.x.unit, &self.y.unit]);
        let quiet = theme.style(Role::Quiet);
        let legend = Legend::arrange(plot, units, raster);
        // Rather than over a curve, its name stands at its end.
        let covers = |legend: &Legend| legend.covered > 0 && plot.cursor.is_none();
        let covers = legend.as_ref().is_some_and(covers);
        let at_ends = covers.then(|| self.names_at_ends(raster)).flatten();
        let legend = legend.filter(|_| at_ends.is_none());
        for (place, name, style) in at_ends.into_iter().flatten() {
            self.write(buf, place.x, place.y, &name, style);
        }
        if let Some(legend) = &legend {
            raster.blank(legend.area);
            legend.render(buf);
        }

        let title = theme.printable(&plot.chart.y.label);
        let title = titled(&title, &self.y.unit.text, ['[', ']']);
        self.write(buf, area.x, area.y, &title, quiet);
        let left = (area.x + cells(&title)).min(area.right());
        let mut free = left + u16::from(left > area.x)..area.right();
        free.end -= self.x_title(free.clone(), buf);

        let room = free.end.saturating_sub(free.start + 1);
        let reading = match &legend {
            None => legend::short_reading(plot, units, room),
            Some(_) => None,
        };
        let note = reading.unwrap_or_else(|| theme.printable(&plot.chart.note));
        if !note.is_empty() && cells(&note) <= room {
            free.end -= cells(&note);
            self.write(buf, free.end, area.y, &note, quiet);
            free.end -= 1;
        }

        // From left to right: a label takes the room of the title row up to its own end.
        let mut marks: Vec<_> = plot.chart.marks.iter().collect();
        marks.sort_by(|a, b| a.x.total_cmp(&b.x));
        for mark in marks {
            let (label, style) = (theme.printable(mark.label), theme.style(mark.role));
            let Some(cell) = self.x.window.cell(mark.x).filter(|_| !label.is_empty()) else {
                continue;
            };
            let (column, width) = (inner.x + cell, cells(&label));
            let x = column.saturating_sub(width / 2);
            if x >= free.start && x + width <= free.end {
                self.write(buf, x, area.y, &label, style);
                free.start = x + width + 1;
                continue;
            }
            // No place above the line: beside its upper end, unless a curve passes there.
            let beside = [Some(column + 1), column.checked_sub(width)];
            let mut spots = beside.into_iter().flatten();
            let spot = spots.find_map(|x| {
                let around = Rect::new(x.saturating_sub(1), inner.y, width + 2, 1);
                let is_taken = legend.as_ref().is_some_and(|it| it.area.intersects(around));
                let spot = Rect::new(x, inner.y, width, 1);
                (!is_taken && raster.is_free(spot)).then_some(spot)
            });
            if let Some(spot) = spot {
                raster.blank(spot);
                self.write(buf, spot.x, spot.y, &label, style);
            }
        }
    }

    /// Writes what the abscissa is into the rule above the plot, where there is one with room for it, else to the
    /// right end of the `free` part of the title row; returns the cells that it takes there. In the row of the ticks
    /// it would stand where the last of them is.
    fn x_title(&self, free: Range<u16>, buf: &mut Buffer) -> u16 {
        let theme = self.plot.theme;
        let arrow = if theme.ascii() { '>' } else { '→' };
        let label = theme.printable(&self.plot.chart.x.label);
        let title = |label: &str| match titled(label, &self.x.unit.text, ['[', ']']) {
            title if title.is_empty() => title,
            title => format!(" {title} {arrow}"),
        };
        let quiet = theme.style(Role::Quiet);
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
            let cell = |(x, y)| Some((self.x.window.cell(x)?, self.y.window.cell(y)?));
            let (column, row) = curve.points().filter_map(cell).last()?;
            let start = inner.x + (column + 1).saturating_sub(width);
            let row = inner.bottom() - 1 - row;
            let spots = [row - 1, row + 1].map(|row| Rect::new(start, row, width, 1));
            let spot = spots.into_iter().find(|spot| raster.is_free(*spot))?;
            if placed.iter().any(|(other, ..)| other.intersects(spot)) {
                return None;
            }
            placed.push((spot, name, theme.style(curve.role)));
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

fn glyph(buf: &mut Buffer, place: (u16, u16), sign: char, style: Style) {
    if let Some(cell) = buf.cell_mut(place) {
        cell.set_char(sign).set_style(style);
    }
}

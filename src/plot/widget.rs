//! The layout: where ticks, plot area, band and labels go.

use ratatui::buffer::Buffer;
use ratatui::buffer::Cell;
use ratatui::layout::Constraint::{Fill, Length};
use ratatui::layout::{self, Layout, Rect, Size};
use ratatui::style::Style;
use ratatui::text::{Line, Span, Text};
use ratatui::widgets::Widget;

use super::axis::Axis;
use super::legend::cells;
use super::map::{Map, ink_on, side_by_side};
use super::marker::Under;
use super::raster::{Position, Raster};
use super::shades::{has_blocks, paint_halves};
use super::stroke::DashPattern;
use super::theme::{Role, look_of};
use super::ticks::{Labels, Ruler};
use super::window::Window;
use super::{Curve, Plot, Point};

/// The smallest area that gets axes, in cells.
const SMALLEST: (u16, u16) = (12, 4);

impl Plot<'_> {
    /// Returns the abscissa, in the x axis' unit, at a cell of the screen if the plot is drawn in `area`; `None`
    /// outside the curves' area.
    pub fn abscissa_at(&self, area: Rect, cell: layout::Position) -> Option<f64> {
        if area.is_empty() {
            return None;
        }
        let frame = PlotLayout::new(self, area);
        let window = frame.x.window;
        let column = cell.x.checked_sub(frame.inner.x)?;
        frame.inner.contains(cell).then(|| window.middle(column, 1))
    }

    /// Draws the key to the colours and lines of a map; returns the area below it.
    fn key(&self, area: Rect, buf: &mut Buffer) -> Rect {
        let map = self.chart.map.as_ref().filter(|_| !is_bare(area));
        let colors = map.map(|map| map.key(self.theme));
        let names = self.chart.named_curves().filter(|_| map.is_some());
        let names = names.map(|curve| {
            let name = format!("{} {}", letter(curve), curve.name);
            let quiet = self.theme.style(Role::Quiet);
            Line::from(Span::styled(self.theme.printable(&name), quiet))
        });
        let mut lines = side_by_side(colors.into_iter().flatten().chain(names), area.width);
        lines.truncate(usize::from(area.height / 4));
        let layout = Layout::vertical([Length(lines.len() as u16), Fill(1)]);
        let [key, below] = layout.areas(area);
        Text::from(lines).render(key, buf);
        below
    }
}

impl Widget for Plot<'_> {
    fn render(self, area: Rect, buf: &mut Buffer) {
        let area = area.intersection(buf.area);
        if area.is_empty() {
            return;
        }
        let area = self.key(area, buf);
        let frame = PlotLayout::new(&self, area);
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
            let cell = Size::new(1, 1);
            for place in places.filter(|place| raster.dots_in((*place, cell).into()) > 0) {
                frame.ink(buf.cell_mut(place));
            }
        }
        frame.signs(buf);
    }
}

/// Returns the letter that marks a curve on a map: the first of its name.
fn letter(curve: &Curve) -> char {
    let first = curve.name.chars().next().unwrap_or(' ');
    first.to_ascii_uppercase()
}

/// Whether an area is too small for axes.
fn is_bare(area: Rect) -> bool {
    area.width < SMALLEST.0 || area.height < SMALLEST.1
}

/// Returns where the name of a zone begins: the zone has `width` cells from `first` on, in a band of `cells`. Zones
/// change in every frame, and a name always centred in its zone could not be read. It stays at the end that the zone
/// shares with the band, or else snaps to every fourth cell.
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

/// The layout: the plot area, and the axes around it.
pub(super) struct PlotLayout<'p> {
    pub plot: &'p Plot<'p>,
    pub area: Rect,
    pub inner: Rect,
    /// Rows of the band, the axis line and the tick labels.
    band_row: Option<u16>,
    line_row: Option<u16>,
    label_row: u16,
    pub x: Ruler,
    pub y: Ruler,
}

impl<'p> PlotLayout<'p> {
    fn new(plot: &'p Plot<'p>, area: Rect) -> Self {
        let (chart, bare) = (plot.chart, is_bare(area));
        let [x_data, y_data] = chart.extent(|_| true);
        let x_bounds = chart.x.resolve(x_data, false);
        let y_bounds = chart.y.resolve(y_data, true);
        let (across, down) = plot.theme.marker.dots();

        // Rows from the bottom up: labels, axis line, band, plot; the title is at the top.
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
        let unit = chart.y.unit_for(y_bounds);
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
        let unit = chart.x.unit_for(x_bounds);
        PlotLayout {
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

    /// Draws the dots: fills, rules, and curves in their order.
    fn raster(&self) -> Raster {
        let (plot, x, y) = (self.plot, self.x.window, self.y.window);
        let (theme, curves) = (plot.theme, &plot.chart.curves);
        let rule = theme.style(Role::Faint);
        let mut raster = Raster::new(self.inner, theme.marker);
        let place = |(a, b): (f64, f64)| -> Position { Some([x.position(a)?, y.position(b)?]) };
        for curve in curves {
            let (points, style) = (curve.points(), theme.style(curve.role));
            let between = points.zip(&curve.fill);
            let between = between.map(|(at, &base)| (place(at), y.position(base)));
            raster.fill(between, style);
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
            raster.line(curve.bars().map(place), style, DashPattern::Solid);
        }
        raster
    }

    /// Draws the map, in half cells vertically if there are colours; each shows the place that contains its middle.
    fn map(&self, map: &Map, buf: &mut Buffer) {
        let (theme, chart, range) = (self.plot.theme, self.plot.chart, map.range());
        let parts = 1 + u16::from(has_blocks(theme));
        // Finds the places of cells or half cells by counting the edges before their middles.
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
                let cell = &mut buf[place];
                match parts {
                    1 => _ = cell.set_char(seen(0).1),
                    _ => paint_halves(cell, [seen(1).0, seen(0).0]),
                }
            }
        }
    }

    /// Gives a character on the map a colour that is visible there.
    fn ink(&self, cell: Option<&mut Cell>) {
        if let Some(cell) = cell.filter(|_| self.plot.theme.colored()) {
            cell.fg = ink_on(cell.bg);
        }
    }

    /// Draws marked points, and arrows where a curve leaves through the top.
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
        let lines = plot.chart.named_curves();
        let lines = lines.filter(|_| plot.chart.map.is_some());
        let ends = lines.filter_map(|line| {
            let mut points = line
                .points()
                .filter(|(x, y)| x.is_finite() && y.is_finite());
            let (x, y) = points.next_back()?;
            let (sign, role) = (letter(line), Role::Title);
            Some(Point {
                at: [x, y],
                sign,
                role,
            })
        });
        let ends = Vec::from_iter(ends);
        for point in ends.iter().chain(&plot.chart.points) {
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

    /// Returns a character that the terminal can show.
    fn sign(&self, sign: char) -> char {
        let text = self.plot.theme.printable(&sign.to_string());
        text.chars().next().unwrap_or(' ')
    }

    /// Draws axis lines, ticks with their labels, and the band.
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
        for (ends, zone) in &self.plot.chart.band {
            let (role, letter) = look_of(*zone);
            let style = theme.style(role);
            let [Some(a), Some(b)] = ends.map(|x| window.position(x)) else {
                continue;
            };
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
            let sign = if style.fg.is_some() && !theme.ascii() {
                '▀'
            } else {
                letter
            };
            let width = painted.len() as u16;
            for cell in painted {
                glyph(buf, (self.inner.x + cell, y), sign, style);
            }
            let name = format!(" {} ", zone.name());
            if cells(&name) <= width {
                let start = name_start(first, width, cells(&name), window.cells);
                self.write(buf, self.inner.x + start, y, &name, style);
            }
        }
    }

    /// Writes `words` from (`x`, `y`) on, within the area.
    pub(super) fn write(&self, buf: &mut Buffer, x: u16, y: u16, words: &str, style: Style) {
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

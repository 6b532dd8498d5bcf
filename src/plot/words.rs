//! The text of a chart in a terminal: legend, title row, labels of marks, names at the ends of curves.

use std::ops::Range;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::axis::titled;
use super::legend::{self, Legend, cells};
use super::raster::Raster;
use super::theme::Role;
use super::widget::PlotLayout;

impl PlotLayout<'_> {
    /// Writes the legend, the title row and the labels of the marks, and removes the dots below them.
    pub(super) fn words(&self, raster: &mut Raster, buf: &mut Buffer) {
        let (plot, area, inner) = (self.plot, self.area, self.inner);
        let (theme, units) = (plot.theme, [&self.x.unit, &self.y.unit]);
        let quiet = theme.style(Role::Quiet);
        // A map has its key above.
        let is_map = plot.chart.map.is_some();
        let legend = Legend::arrange(plot, units, raster).filter(|_| !is_map);
        // If the legend would cover a curve, the curves are named at their ends instead; without room for a legend, those
        // that have room there.
        let is_read = plot.cursor.is_some();
        let at_ends = match &legend {
            _ if is_read || is_map => None,
            Some(legend) if legend.covered == 0 => None,
            Some(_) => self.names_at_ends(raster, true),
            None => self.names_at_ends(raster, false),
        };
        let legend = legend.filter(|_| at_ends.is_none());
        for (place, name, style) in at_ends.into_iter().flatten() {
            raster.blank(place);
            self.write(buf, place.x, place.y, &name, style);
        }
        if let Some(legend) = &legend {
            raster.blank(legend.area);
            legend.render(buf);
        }

        let title = titled(&plot.chart.y.label, &self.y.unit.text, ['[', ']']);
        let title = theme.printable(&title);
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

        // From left to right, because a label takes the title row up to its own end.
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
            // Without room above the line, the label goes next to its upper end, unless a curve passes there.
            let neighbours = [Some(column + 1), column.checked_sub(width)];
            let mut spots = neighbours.into_iter().flatten();
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

    /// Writes the abscissa's title into the rule above the plot if there is room, else at the right end of the `free`
    /// part of the title row; returns the number of cells that it takes there. In the row of tick labels it would
    /// collide with the last one.
    fn x_title(&self, free: Range<u16>, buf: &mut Buffer) -> u16 {
        let theme = self.plot.theme;
        let arrow = if theme.ascii() { '>' } else { '→' };
        let title = |label: &str| match titled(label, &self.x.unit.text, ['[', ']']) {
            title if title.is_empty() => title,
            title => format!(" {} {arrow}", theme.printable(&title)),
        };
        let quiet = theme.style(Role::Quiet);
        let whole = title(&self.plot.chart.x.label);
        if let Some(rule) = self.plot.rule.filter(|rule| cells(&whole) <= rule.width) {
            // The rule is dim; text in it is not.
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

    /// Places the names of the curves above or below their last points, in free areas, the last curve's first. `None` if
    /// some do not fit and `all` are wanted.
    fn names_at_ends(&self, raster: &Raster, all: bool) -> Option<Vec<(Rect, String, Style)>> {
        let (theme, inner) = (self.plot.theme, self.inner);
        let mut placed: Vec<(Rect, String, Style)> = Vec::new();
        let curves: Vec<_> = self.plot.chart.named_curves().collect();
        for curve in curves.into_iter().rev() {
            let name = theme.printable(&curve.name);
            let width = cells(&name);
            let cell = |(x, y)| Some((self.x.window.cell(x)?, self.y.window.cell(y)?));
            let spot = curve
                .points()
                .filter_map(cell)
                .next_back()
                .and_then(|(column, row)| {
                    let start = inner.x + (column + 1).saturating_sub(width);
                    let row = inner.bottom() - 1 - row;
                    let spots = [row - 1, row + 1].map(|row| Rect::new(start, row, width, 1));
                    let is_free = |spot: &Rect| {
                        let is_taken = placed.iter().any(|(other, ..)| other.intersects(*spot));
                        raster.is_free(*spot) && !is_taken
                    };
                    spots.into_iter().find(is_free)
                });
            match spot {
                Some(spot) => placed.push((spot, name, theme.style(curve.role))),
                None if all => return None,
                None => {}
            }
        }
        Some(placed)
    }
}

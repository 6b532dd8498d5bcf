//! The sub-cell raster: dots smaller than a terminal cell.
//!
//! Curves are drawn as exact straight segments between their points, clipped to the raster before any dot is set, so
//! that a far point costs no more than a near one. Points that share a column of dots are drawn as that column's range,
//! which keeps every peak however many points there are. Below the curves lies a second, weaker layer (fills, rules).
//! It is hidden in every cell that a curve touches, so that none of its dots can be mistaken for the curve's.
//!
//! Dots are counted from the left and from the bottom; the centre of dot `i` is at position `i`.

use ratatui::buffer::Buffer;
use ratatui::layout::{self, Rect};
use ratatui::style::{Color, Modifier, Style};

use super::marker::{Marker, Under};
use super::segment::walk;
use super::stroke::{DashPattern, draws};

#[derive(Debug, Clone, Copy, Default)]
struct DotCell {
    /// Dots of curves and of the layer below, one bit each: bit `x + across * y`, y downwards.
    curve: u8,
    under: u8,
    /// Styles of the curve (upper, lower half) and of the layer below.
    ink: [Style; 2],
    under_ink: Style,
    kind: Option<Under>,
}

/// A point's position in dots; `None` is a gap.
pub(super) type Position = Option<[f64; 2]>;

/// Dots over a rectangle of cells.
#[derive(Debug)]
pub(super) struct Raster {
    marker: Marker,
    /// The area of the screen that it covers.
    pub(super) area: Rect,
    cells: Vec<DotCell>,
}

impl Raster {
    /// An empty raster over `area`.
    pub(super) fn new(area: Rect, marker: Marker) -> Self {
        Raster {
            marker,
            area,
            cells: vec![DotCell::default(); usize::from(area.width) * usize::from(area.height)],
        }
    }

    /// Draws the line through `points`; the style must not have a background.
    pub(super) fn line(
        &mut self,
        points: impl Iterator<Item = Position>,
        style: Style,
        stroke: DashPattern,
    ) {
        let (size, [across, down]) = (self.size(), stroke.runs(self.marker));
        let mut draw = |from: [f64; 2], to: [f64; 2]| {
            walk(from, to, size, |column, row, is_steep| {
                let (along, runs) = if is_steep {
                    (row, down)
                } else {
                    (column, across)
                };
                self.set(column, row, style, draws(runs, along));
            });
        };
        let mut previous: Position = None;
        // The lowest and the highest of the last points that share a column of dots.
        let mut range: Option<[[f64; 2]; 2]> = None;
        for point in points.chain([None]) {
            if let (Some([x, y]), Some([low, high])) = (point, &mut range)
                && x.round() == low[0]
            {
                low[1] = low[1].min(y);
                high[1] = high[1].max(y);
            } else {
                if let Some([low, high]) = range {
                    draw(low, high);
                }
                if let (Some(from), Some(to)) = (previous, point) {
                    draw(from, to);
                }
                range = point.map(|[x, y]| [[x.round(), y]; 2]);
            }
            previous = point;
        }
    }

    /// Fills the area between `points` and the base under each with a loose pattern.
    pub(super) fn fill(
        &mut self,
        points: impl Iterator<Item = (Position, Option<f64>)>,
        style: Style,
    ) {
        let style = style.add_modifier(Modifier::DIM);
        // The range of dots from one position to another.
        let dots = |from: f64, to: f64, size: f64| {
            from.max(0.0) as usize..(to.min(size - 1.0) + 1.0).max(0.0) as usize
        };
        let [width, height] = self.size();
        let mut previous: Option<([f64; 2], f64)> = None;
        for (point, base) in points {
            let point = point.zip(base);
            if let (Some(a), Some(b)) = (previous, point)
                && a.0[0] != b.0[0]
            {
                let [(a, base_a), (b, base_b)] = if a.0[0] < b.0[0] { [a, b] } else { [b, a] };
                for column in dots(a[0].ceil(), b[0].floor(), width) {
                    let share = (column as f64 - a[0]) / (b[0] - a[0]);
                    let y = a[1] + (b[1] - a[1]) * share;
                    let base = base_a + (base_b - base_a) * share;
                    for row in dots(y.min(base).round(), y.max(base).round(), height) {
                        let is_seen = (column + 2 * row).is_multiple_of(4);
                        if is_seen || self.marker != Marker::Braille {
                            self.set_under(column, row, Under::Fill, style);
                        }
                    }
                }
            }
            previous = point;
        }
    }

    /// Draws a faint line along dot row `row`.
    pub(super) fn zero_line(&mut self, row: usize, style: Style) {
        let every = if self.marker == Marker::Braille { 2 } else { 1 };
        for column in (0..self.size()[0] as usize).step_by(every) {
            self.set_under(column, row, Under::Zero, style);
        }
    }

    /// Draws a line along dot column `column`: dotted for a mark, full for the cursor. A mark moves with the contact
    /// all the time, so only every third cell of it has dots, beginning at the top next to its label.
    pub(super) fn vertical(&mut self, column: usize, kind: Under, style: Style) {
        let is_sparse = self.marker == Marker::Braille && kind == Under::Mark;
        let down = usize::from(self.marker.dots().1);
        for row in 0..self.size()[1] as usize {
            let cell = usize::from(self.area.height) - 1 - row / down;
            if !is_sparse || (cell.is_multiple_of(3) && row.is_multiple_of(2)) {
                self.set_under(column, row, kind, style);
            }
        }
    }

    /// Returns the number of curve dots in a rectangle of the screen.
    pub(super) fn dots_in(&self, area: Rect) -> u32 {
        let places = self.area.intersection(area).positions();
        let cells = places.filter_map(|place| self.cells.get(self.index(place)));
        cells.map(|cell| cell.curve.count_ones()).sum()
    }

    /// Whether a rectangle of the screen lies on the raster and contains no curve.
    pub(super) fn is_free(&self, spot: Rect) -> bool {
        self.area.intersection(spot) == spot && self.dots_in(spot) == 0
    }

    /// Removes everything in a rectangle of the screen.
    pub(super) fn blank(&mut self, area: Rect) {
        for place in self.area.intersection(area).positions() {
            let index = self.index(place);
            self.cells[index] = DotCell::default();
        }
    }

    /// Writes the dots into `buf`.
    pub(super) fn render(&self, buf: &mut Buffer) {
        for (place, cell) in self.area.positions().zip(&self.cells) {
            if let Some((glyph, style)) = self.look(cell)
                && let Some(target) = buf.cell_mut(place)
            {
                target.set_char(glyph).set_style(style);
            }
        }
    }

    /// Returns the index of a cell from its place on the screen.
    fn index(&self, place: layout::Position) -> usize {
        let [column, row] = [place.x - self.area.x, place.y - self.area.y].map(usize::from);
        row * usize::from(self.area.width) + column
    }

    /// Returns the width and height in dots.
    fn size(&self) -> [f64; 2] {
        let (across, down) = self.marker.dots();
        let width = f64::from(self.area.width) * f64::from(across);
        [width, f64::from(self.area.height) * f64::from(down)]
    }

    /// Sets a dot of a curve. A dot in a gap between dashes only hides the layer below.
    fn set(&mut self, column: usize, row: usize, style: Style, drawn: bool) {
        let ((across, _), marker) = (self.marker.dots(), self.marker);
        if let Some((cell, bit)) = self.locate(column, row) {
            cell.kind = None;
            if !drawn {
                return;
            }
            cell.curve |= 1 << bit;
            if marker == Marker::HalfBlock {
                cell.ink[usize::from(bit / across)] = style;
            } else {
                cell.ink = [style; 2];
            }
        }
    }

    fn set_under(&mut self, column: usize, row: usize, kind: Under, style: Style) {
        if let Some((cell, bit)) = self.locate(column, row) {
            if cell.kind != Some(kind) || cell.under_ink != style {
                cell.under = 0;
            }
            cell.under |= 1 << bit;
            cell.kind = Some(kind);
            cell.under_ink = style;
        }
    }

    /// Returns the cell that holds a dot, and the dot's bit in it; `None` outside.
    fn locate(&mut self, column: usize, row: usize) -> Option<(&mut DotCell, u16)> {
        let (across, down) = self.marker.dots();
        let (across, down) = (usize::from(across), usize::from(down));
        let row = (usize::from(self.area.height) * down).checked_sub(row + 1)?;
        let columns = usize::from(self.area.width);
        if column >= columns * across {
            return None;
        }
        let bit = column % across + across * (row % down);
        let index = row / down * columns + column / across;
        Some((self.cells.get_mut(index)?, bit as u16))
    }

    /// Returns the character of a cell and its style; `None` if it is empty.
    fn look(&self, cell: &DotCell) -> Option<(char, Style)> {
        if cell.curve == 0 {
            let glyph = self.marker.under_glyph(cell.kind?, cell.under);
            return Some((glyph, cell.under_ink));
        }
        let [upper, lower] = cell.ink;
        // A foreground that can also be used as a background.
        let colour = |style: Style| style.fg.filter(|&colour| colour != Color::Reset);
        let style = match (self.marker, cell.curve, colour(upper), colour(lower)) {
            // One character with two colours: the lower half shows the background.
            (Marker::HalfBlock, 3, Some(a), Some(b)) if a != b => {
                return Some(('▀', upper.bg(b)));
            }
            (Marker::HalfBlock, 2 | 3, ..) => lower,
            _ => upper,
        };
        Some((self.marker.glyph(cell.curve), style))
    }
}

#[cfg(test)]
#[path = "raster_tests.rs"]
mod tests;

//! The sub-cell raster: dots smaller than a terminal cell.
//!
//! Curves are drawn as exact straight segments between the positions of their points,
//! clipped to the raster before a dot is set, so that a far point costs no more than a near
//! one. Points that share a column of dots are drawn as that column's range, which keeps
//! every peak however many points there are. Below the curves lies a second, weaker layer
//! (fills, rules); it gives way in every cell that a curve touches, so that no dot of it
//! can be mistaken for the curve's.
//!
//! Dots are counted from the left and from the bottom, dot `i` being centred on position `i`.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier, Style};

use super::marker::{Marker, Under};
use super::segment::walk;
use super::stroke::{Stroke, draws};

#[derive(Debug, Clone, Copy, Default)]
struct Cell {
    /// Dots of curves and of the layer below, a bit each; bit `x + across * y`, y downwards.
    curve: u8,
    under: u8,
    /// Indices into the inks: of the curve (upper, lower half) and of the layer below.
    ink: [u16; 2],
    under_ink: u16,
    kind: Option<Under>,
}

/// A point's position in dots; `None` is a gap.
pub(super) type Position = Option<(f64, f64)>;

/// Dots over a rectangle of cells.
#[derive(Debug)]
pub(super) struct Raster {
    marker: Marker,
    columns: usize,
    rows: usize,
    cells: Vec<Cell>,
    inks: Vec<Style>,
}

impl Raster {
    /// An empty raster of `columns` by `rows` cells.
    pub(super) fn new(columns: u16, rows: u16, marker: Marker) -> Self {
        let (columns, rows) = (usize::from(columns), usize::from(rows));
        Raster {
            marker,
            columns,
            rows,
            cells: vec![Cell::default(); columns * rows],
            inks: Vec::new(),
        }
    }

    /// Draws the line through `points`, in the foreground colour and modifiers of `style`.
    pub(super) fn line(
        &mut self,
        points: impl Iterator<Item = Position>,
        style: Style,
        stroke: Stroke,
    ) {
        let pen = self.pen(style, stroke);
        let mut previous: Position = None;
        let mut run: Option<Run> = None;
        for point in points {
            if let (Some((x, y)), Some(run)) = (point, run.as_mut())
                && x.round() == run.column
            {
                run.low = run.low.min(y);
                run.high = run.high.max(y);
                previous = point;
                continue;
            }
            if let Some(run) = run.take() {
                self.segment((run.column, run.low), (run.column, run.high), pen);
            }
            if let (Some(from), Some(to)) = (previous, point) {
                self.segment(from, to, pen);
            }
            run = point.map(|(x, y)| Run {
                column: x.round(),
                low: y,
                high: y,
            });
            previous = point;
        }
        if let Some(run) = run {
            self.segment((run.column, run.low), (run.column, run.high), pen);
        }
    }

    /// Fills between `points` and the position of the base under each with a loose pattern.
    pub(super) fn fill(
        &mut self,
        points: impl Iterator<Item = (Position, Option<f64>)>,
        style: Style,
    ) {
        let ink = self.ink(style.add_modifier(Modifier::DIM));
        let (width, height) = self.size();
        let mut previous: Option<((f64, f64), f64)> = None;
        for (point, base) in points {
            let point = point.zip(base);
            if let (Some(a), Some(b)) = (previous, point) {
                let (((xa, ya), base_a), ((xb, yb), base_b)) =
                    if a.0.0 <= b.0.0 { (a, b) } else { (b, a) };
                let columns = xa.ceil().max(0.0)..=xb.floor().min(width - 1.0);
                let mut column = *columns.start();
                while columns.contains(&column) && xb > xa {
                    let share = (column - xa) / (xb - xa);
                    let y = ya + (yb - ya) * share;
                    let base = base_a + (base_b - base_a) * share;
                    let low = y.min(base).round().max(0.0) as usize;
                    let high = y.max(base).round().min(height - 1.0);
                    let end = if high < 0.0 { 0 } else { high as usize + 1 };
                    for row in low..end {
                        if (column as usize + 2 * row).is_multiple_of(4)
                            || self.marker != Marker::Braille
                        {
                            self.set_under(column as usize, row, Under::Fill, ink);
                        }
                    }
                    column += 1.0;
                }
            }
            previous = point;
        }
    }

    /// A faint line along dot row `row`.
    pub(super) fn zero_line(&mut self, row: usize, style: Style) {
        let ink = self.ink(style);
        for column in (0..self.size().0 as usize).step_by(2) {
            self.set_under(column, row, Under::Zero, ink);
            if self.marker != Marker::Braille {
                self.set_under(column + 1, row, Under::Zero, ink);
            }
        }
    }

    /// A line along dot column `column`: dotted for a mark, full for the cursor. A mark moves with the
    /// contact all the time, so two of three cells of it stay empty: the top one has dots, next to the
    /// mark's label.
    pub(super) fn vertical(&mut self, column: usize, kind: Under, style: Style) {
        let ink = self.ink(style);
        let sparse = self.marker == Marker::Braille && kind == Under::Mark;
        let down = usize::from(self.marker.dots().1);
        let rows = 0..self.size().1 as usize;
        let drawn = |&row: &usize| {
            let cell = self.rows - 1 - row / down;
            !sparse || (cell.is_multiple_of(3) && row.is_multiple_of(2))
        };
        let rows: Vec<usize> = rows.filter(drawn).collect();
        for row in rows {
            self.set_under(column, row, kind, ink);
        }
    }

    /// How many curve dots lie in the rectangle of cells (columns from the left, rows from
    /// the top, clipped).
    pub(super) fn dots_in(&self, area: Rect) -> u32 {
        let [left, top] = [area.x, area.y].map(usize::from);
        let right = usize::from(area.right()).min(self.columns);
        let bottom = usize::from(area.bottom()).min(self.rows);
        let rows = top..bottom;
        rows.flat_map(|row| {
            self.cells
                .get(row * self.columns + left..row * self.columns + right)
        })
        .flatten()
        .map(|cell| cell.curve.count_ones())
        .sum()
    }

    /// Writes the dots into `buf`, the raster's top left cell at (`x`, `y`).
    pub(super) fn render(&self, x: u16, y: u16, buf: &mut Buffer) {
        for (index, cell) in self.cells.iter().enumerate() {
            let place = (
                x + (index % self.columns) as u16,
                y + (index / self.columns) as u16,
            );
            if let Some((glyph, style)) = self.look(cell)
                && let Some(target) = buf.cell_mut(place)
            {
                target.set_char(glyph).set_style(style);
            }
        }
    }

    /// Removes everything in the rectangle of cells (as in [`Raster::dots_in`]).
    pub(super) fn blank(&mut self, area: Rect) {
        let right = usize::from(area.right()).min(self.columns);
        let bottom = usize::from(area.bottom()).min(self.rows);
        for row in usize::from(area.y)..bottom {
            let start = row * self.columns;
            let range = start + usize::from(area.x)..start + right;
            if let Some(cells) = self.cells.get_mut(range) {
                cells.fill(Cell::default());
            }
        }
    }

    /// Width and height in dots.
    fn size(&self) -> (f64, f64) {
        let (across, down) = self.marker.dots();
        let width = self.columns * usize::from(across);
        let height = self.rows * usize::from(down);
        (width as f64, height as f64)
    }

    fn ink(&mut self, style: Style) -> u16 {
        let style = Style { bg: None, ..style };
        let known = self.inks.iter().position(|&ink| ink == style);
        let index = known.unwrap_or_else(|| {
            self.inks.push(style);
            self.inks.len() - 1
        });
        index.min(usize::from(u16::MAX)) as u16
    }

    fn pen(&mut self, style: Style, stroke: Stroke) -> Pen {
        let [across, down] = stroke.runs(self.marker);
        Pen {
            ink: self.ink(style),
            across,
            down,
        }
    }

    fn segment(&mut self, a: (f64, f64), b: (f64, f64), pen: Pen) {
        walk(a, b, self.size(), |column, row, steep| {
            let (along, runs) = match steep {
                false => (column, pen.across),
                true => (row, pen.down),
            };
            self.set(column, row, pen.ink, draws(runs, along));
        });
    }

    /// Sets a dot of a curve; between two dashes only the layer below gives way.
    fn set(&mut self, column: usize, row: usize, ink: u16, drawn: bool) {
        let ((across, _), marker) = (self.marker.dots(), self.marker);
        if let Some((cell, bit)) = self.locate(column, row) {
            cell.kind = None;
            if !drawn {
                return;
            }
            cell.curve |= 1 << bit;
            if marker == Marker::HalfBlock {
                cell.ink[usize::from(bit / across)] = ink;
            } else {
                cell.ink = [ink; 2];
            }
        }
    }

    fn set_under(&mut self, column: usize, row: usize, kind: Under, ink: u16) {
        if let Some((cell, bit)) = self.locate(column, row) {
            if cell.kind != Some(kind) || cell.under_ink != ink {
                cell.under = 0;
            }
            cell.under |= 1 << bit;
            cell.kind = Some(kind);
            cell.under_ink = ink;
        }
    }

    /// The cell that holds a dot, and the dot's bit in it; `None` outside.
    fn locate(&mut self, column: usize, row: usize) -> Option<(&mut Cell, u16)> {
        let (across, down) = self.marker.dots();
        let (across, down) = (usize::from(across), usize::from(down));
        let row = (self.rows * down).checked_sub(row + 1)?;
        if column >= self.columns * across {
            return None;
        }
        let bit = column % across + across * (row % down);
        let index = row / down * self.columns + column / across;
        Some((self.cells.get_mut(index)?, bit as u16))
    }

    /// The character of a cell and its style; `None` if it is empty.
    fn look(&self, cell: &Cell) -> Option<(char, Style)> {
        let ink = |index: u16| {
            let style = self.inks.get(usize::from(index)).copied();
            style.unwrap_or_default()
        };
        if cell.curve == 0 {
            let glyph = self.marker.under_glyph(cell.kind?, cell.under);
            return Some((glyph, ink(cell.under_ink)));
        }
        let [upper, lower] = cell.ink.map(ink);
        let style = match (self.marker, cell.curve, colour(upper), colour(lower)) {
            // One glyph, two colours: the lower half shows the background.
            (Marker::HalfBlock, 3, Some(a), Some(b)) if a != b => {
                return Some(('▀', upper.bg(b)));
            }
            (Marker::HalfBlock, 2 | 3, ..) => lower,
            _ => upper,
        };
        Some((self.marker.glyph(cell.curve), style))
    }
}

/// The points seen so far in one column of dots.
#[derive(Debug, Clone, Copy)]
struct Run {
    column: f64,
    low: f64,
    high: f64,
}

/// An ink and its pattern, across and down.
#[derive(Debug, Clone, Copy)]
struct Pen {
    ink: u16,
    across: &'static [usize],
    down: &'static [usize],
}

/// A foreground that can also serve as a background.
fn colour(style: Style) -> Option<Color> {
    style.fg.filter(|&colour| colour != Color::Reset)
}

#[cfg(test)]
#[path = "raster_tests.rs"]
mod tests;

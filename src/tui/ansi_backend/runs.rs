//! Changed cells as runs that one move and one pen write, and the order in which they go out.
//!
//! A frame is shown as a whole, so its cells may be written in any order. Most bytes of a frame are
//! colour changes (ten bytes each) and moves (two to seven), and few are the signs themselves: the runs
//! of one colour go out together, each to the one that is next at the least cost.

use std::ops::Range;

use ratatui::buffer::Cell;
use ratatui::layout::{Position, Size};
use ratatui::style::Color;

use super::moves::move_to;
use super::pen::Pen;
use super::sink::bytes_of;

/// The next run is searched among this many, in the order of the rows: the time of a large frame grows
/// with its size and not with its square.
const SEARCHED: usize = 192;

/// The longest gap that is worth a look: a move over it takes at most as many bytes.
const LONGEST_GAP: u16 = 5;

/// Neighbours in a row that are written with one pen.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Run {
    pub start: Position,
    /// The column behind it.
    pub end: u16,
    pen: Pen,
    /// Whether it is of blanks only, whose ink is not seen.
    is_blank: bool,
    /// Whether the cursor is certain to be behind it.
    pub is_certain: bool,
}

impl Run {
    /// The pen to write it with where the terminal has `now`: blanks need only the ground.
    pub fn pen(&self, now: Option<Pen>) -> Pen {
        match now {
            Some(now) if self.is_blank && !now.inks_blanks() => Pen {
                bg: self.pen.bg,
                ..now
            },
            _ => self.pen,
        }
    }

    /// Continues this run over a cell, if one pen writes both.
    fn join(&mut self, cell: &Cell) -> bool {
        let pen = Pen::of(cell);
        let is_blank = is_inkless(cell);
        let fits = match (self.is_blank, is_blank) {
            (false, false) => pen == self.pen,
            _ => pen.fills_like(self.pen),
        };
        if !fits || !self.is_certain {
            return false;
        }
        if self.is_blank && !is_blank {
            (self.pen, self.is_blank) = (pen, false);
        }
        self.end += 1;
        self.is_certain = is_certain(cell);
        true
    }
}

/// Whether a cell shows nothing but its ground.
fn is_inkless(cell: &Cell) -> bool {
    cell.symbol() == " " && !Pen::of(cell).inks_blanks()
}

/// Whether all terminals agree on the width of a cell's sign.
fn is_certain(cell: &Cell) -> bool {
    let mut signs = cell.symbol().chars();
    let certain =
        |sign: char| matches!(sign, ' '..='~' | '\u{2500}'..='\u{259f}' | '\u{2800}'..='\u{28ff}');
    signs.next().is_some_and(certain) && signs.next().is_none()
}

/// The same picture with fewer pens: of two halves of a cell in two colours either one may have the ink, and
/// the one whose colour comes first gets it.
fn with_ink_first(mut cell: Cell) -> Cell {
    let other = match cell.symbol() {
        "▀" => "▄",
        "▄" => "▀",
        _ => return cell,
    };
    let of = |color: Color| match color {
        Color::Indexed(index) => Some(index),
        _ => None,
    };
    if let (Some(ink), Some(ground)) = (of(cell.fg), of(cell.bg))
        && ground < ink
        && cell.modifier.is_empty()
    {
        cell.set_symbol(other);
        std::mem::swap(&mut cell.fg, &mut cell.bg);
    }
    cell
}

/// What the terminal shows, as far as this program has written it; blank at first, as the drawing
/// library takes it to be.
#[derive(Debug, Default)]
pub(super) struct Shown {
    size: Size,
    cells: Vec<Cell>,
}

impl Shown {
    /// Takes over the size of the terminal: one of another size was cleared.
    pub fn resize(&mut self, size: Size) {
        if self.size != size {
            self.size = size;
            self.clear();
        }
    }

    /// Nothing is shown any more.
    pub fn clear(&mut self) {
        self.cells.clear();
        let count = usize::from(self.size.width) * usize::from(self.size.height);
        self.cells.resize(count, Cell::EMPTY);
    }

    /// Takes over changed cells. Returns the places of those that look different, in the order of rows.
    pub fn change<'a>(
        &mut self,
        content: impl Iterator<Item = (u16, u16, &'a Cell)>,
    ) -> Vec<Position> {
        let mut places = Vec::new();
        for (x, y, cell) in content {
            let Some(index) = self.index(x, y) else {
                continue;
            };
            let shown = &mut self.cells[index];
            let look_alike =
                is_inkless(shown) && is_inkless(cell) && Pen::of(shown).fills_like(Pen::of(cell));
            if !look_alike {
                places.push(Position::new(x, y));
            }
            *shown = with_ink_first(cell.clone());
        }
        places.sort_unstable_by_key(|place| (place.y, place.x));
        places
    }

    /// The runs that write the cells at `places`, in the order of rows. A gap is written again where
    /// that takes no more bytes than to move over it.
    pub fn runs(&self, places: &[Position]) -> Vec<Run> {
        let mut runs: Vec<Run> = Vec::new();
        for &place in places {
            let Some(index) = self.index(place.x, place.y) else {
                continue;
            };
            let cell = &self.cells[index];
            let near = runs
                .last_mut()
                .filter(|run| run.start.y == place.y && place.x - run.end <= LONGEST_GAP);
            if let Some(run) = near {
                let behind = Position::new(run.end, place.y);
                let way = bytes_of(|count| move_to(Some(behind), place, count));
                let gap = &self.cells[index - usize::from(place.x - run.end)..index];
                let mut joined = run.clone();
                let fits = self.text(run.end..place.x, place.y).len() <= way
                    && gap.iter().all(|cell| is_certain(cell) && joined.join(cell))
                    && joined.join(cell);
                if fits {
                    *run = joined;
                    continue;
                }
            }
            runs.push(Run {
                start: place,
                end: place.x + 1,
                pen: Pen::of(cell),
                is_blank: is_inkless(cell),
                is_certain: is_certain(cell),
            });
        }
        runs
    }

    /// The signs of columns of a row.
    pub fn text(&self, columns: Range<u16>, y: u16) -> String {
        let cells = columns.filter_map(|x| self.cells.get(self.index(x, y)?));
        cells.map(Cell::symbol).collect()
    }

    fn index(&self, x: u16, y: u16) -> Option<usize> {
        let is_inside = x < self.size.width && y < self.size.height;
        is_inside.then(|| usize::from(y) * usize::from(self.size.width) + usize::from(x))
    }
}

/// The runs not written yet.
pub(super) struct Queue {
    rest: std::vec::IntoIter<Run>,
    searched: Vec<Run>,
}

impl Queue {
    pub fn new(runs: Vec<Run>) -> Self {
        Self {
            rest: runs.into_iter(),
            searched: Vec::with_capacity(SEARCHED),
        }
    }

    /// Takes out the run that costs least where the cursor is at `at` and the terminal has the pen
    /// `pen`; of equal ones the first in the order of rows.
    pub fn next(&mut self, at: Option<Position>, pen: Option<Pen>) -> Option<Run> {
        let room = SEARCHED - self.searched.len();
        self.searched.extend(self.rest.by_ref().take(room));
        // Few pens, many runs: each change of pen is counted once.
        let mut changes: Vec<(Pen, usize)> = Vec::new();
        let mut change = |run: &Run| {
            let wanted = run.pen(pen);
            if let Some((_, bytes)) = changes.iter().find(|(known, _)| *known == wanted) {
                return *bytes;
            }
            let bytes = bytes_of(|count| wanted.take(pen, count));
            changes.push((wanted, bytes));
            bytes
        };
        let mut rank = |run: &Run| {
            let way = bytes_of(|count| move_to(at, run.start, count));
            (change(run) + way, run.start.y, run.start.x)
        };
        let (best, _) = self
            .searched
            .iter()
            .enumerate()
            .min_by_key(|(_, run)| rank(run))?;
        Some(self.searched.swap_remove(best))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratatui::style::Color;

    /// The runs of changed cells: place, sign, colour.
    fn runs(shown: &mut Shown, cells: &[(u16, u16, &str, Color)]) -> Vec<Run> {
        let cells: Vec<(u16, u16, Cell)> = cells
            .iter()
            .map(|&(x, y, sign, color)| {
                let mut cell = Cell::EMPTY;
                cell.set_symbol(sign).set_fg(color);
                (x, y, cell)
            })
            .collect();
        let places = shown.change(cells.iter().map(|(x, y, cell)| (*x, *y, cell)));
        shown.runs(&places)
    }

    fn blank() -> Shown {
        let mut shown = Shown::default();
        shown.resize(Size::new(40, 10));
        shown
    }

    #[test]
    fn cells_of_one_colour_go_out_together() {
        use Color::{Green, Red};
        let mut shown = blank();
        let runs = runs(
            &mut shown,
            &[
                (0, 0, "a", Red),
                (20, 0, "b", Green),
                (0, 1, "c", Red),
                (20, 1, "d", Green),
            ],
        );
        let mut queue = Queue::new(runs);
        let (mut at, mut pen, mut order) = (None, None, String::new());
        while let Some(run) = queue.next(at, pen) {
            order += &shown.text(run.start.x..run.end, run.start.y);
            at = Some(Position::new(run.end, run.start.y));
            pen = Some(run.pen(pen));
        }
        assert_eq!(order, "acdb");
    }

    #[test]
    fn two_colours_in_a_cell_make_one_pen() {
        let cell = |sign: &str, fg: u8, bg: u8| {
            let mut cell = Cell::EMPTY;
            let (fg, bg) = (Color::Indexed(fg), Color::Indexed(bg));
            cell.set_symbol(sign).set_fg(fg).set_bg(bg);
            cell
        };
        for (written, expected) in [
            (cell("▀", 30, 20), cell("▄", 20, 30)),
            (cell("▄", 30, 20), cell("▀", 20, 30)),
            (cell("▀", 20, 30), cell("▀", 20, 30)),
            (cell("▂", 30, 20), cell("▂", 30, 20)),
        ] {
            assert_eq!(with_ink_first(written), expected);
        }
    }

    #[test]
    fn a_gap_is_written_again_where_a_move_is_no_shorter() {
        use Color::{Green, Red};
        let mut shown = blank();
        for (cells, expected) in [
            // Two blanks are shorter than a move over them, and so is a letter in the same colour.
            (&[(0, 0, "a", Red), (3, 0, "b", Red)][..], &["a  b"][..]),
            (&[(2, 0, "x", Red), (4, 0, "y", Red)], &["xby"]),
            (&[(0, 0, "c", Red), (3, 0, "d", Red)], &["c xd"]),
            // Another colour is between, or too much, or a sign whose width is not certain.
            (&[(1, 1, "e", Green)], &["e"]),
            (&[(0, 1, "f", Red), (2, 1, "g", Red)], &["f", "g"]),
            (&[(0, 2, "h", Red), (9, 2, "i", Red)], &["h", "i"]),
            (&[(0, 3, "µ", Red), (1, 3, "j", Red)], &["µ", "j"]),
            // A blank has no colour of its own.
            (
                &[(0, 4, "k", Red), (1, 4, " ", Green), (2, 4, "l", Red)],
                &["k l"],
            ),
        ] {
            let runs = runs(&mut shown, cells);
            let texts: Vec<String> = runs
                .iter()
                .map(|run| shown.text(run.start.x..run.end, run.start.y))
                .collect();
            assert_eq!(texts, expected, "{cells:?}");
        }
    }
}

//! Turns changed cells into few bytes, since they may go over a slow line for hours.
//!
//! The stock backend writes every move as an absolute position and every style in full. Here cells of
//! one style go out together, a move is relative where that is shorter, and only what differs between
//! two styles is written. A frame is wrapped in a synchronized update (DEC private mode 2026), so that
//! the order of its cells is not seen; a frame without changes writes nothing. A slow line gets a frame in chunks.

use ratatui::buffer::Cell;
use ratatui::prelude::*;

use crate::plot::colormap::NAMED;

/// The modifiers that are visible on a blank.
const ON_BLANKS: Modifier = Modifier::REVERSED.union(Modifier::UNDERLINED);

/// Shorter frames need no synchronized update: the order of their cells cannot be seen.
const SHORT: usize = 256;

/// About how many bytes a move and a style take before cells of one style: over 311 frames of the explorer, the signs
/// and this are 0.83 to 1.10 of what was written.
const RUN: usize = 7;

/// Minimum bytes per chunk for cells between the first and the last row.
const FEW: usize = 24;

/// Colours and modifiers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct Pen {
    fg: Color,
    bg: Color,
    modifier: Modifier,
}

impl Pen {
    /// Returns a cell's text and the pen to write it with. A full block in a colour becomes a blank on that background:
    /// one byte instead of three.
    fn from_cell(cell: &Cell) -> (&str, Self) {
        let is_block = cell.symbol() == "█" && cell.modifier.is_empty() && cell.fg != Color::Reset;
        let (symbol, fg, bg) = if is_block {
            (" ", Color::Reset, cell.fg)
        } else {
            (cell.symbol(), cell.fg, cell.bg)
        };
        let modifier = cell.modifier;
        (symbol, Self { fg, bg, modifier })
    }

    /// Returns the codes that turn the pen `now` into this one without a reset, each after a semicolon.
    fn codes(self, now: Self) -> String {
        // Modifiers stand in the order of their codes, from 1 on.
        let added = (self.modifier - now.modifier).iter();
        let added = added.map(|modifier| format!(";{}", modifier.bits().trailing_zeros() + 1));
        let colors = [(now.fg, self.fg, 30), (now.bg, self.bg, 40)].into_iter();
        let colors = colors.filter(|(now, next, _)| now != next);
        added
            .chain(colors.map(|(_, next, base)| code(next, base)))
            .collect()
    }

    /// Returns the sequence that sets this pen, whatever the pen was: an empty code resets it.
    fn full_sequence(self) -> String {
        format!("\x1b[{}m", self.codes(Self::default()))
    }

    /// Returns the shortest sequence that changes the pen `now` to this one.
    fn sequence(self, now: Self) -> String {
        let (in_full, codes) = (self.full_sequence(), self.codes(now));
        let adds = self.modifier.contains(now.modifier);
        match codes.strip_prefix(';').filter(|_| adds) {
            _ if now == self => String::new(),
            Some(codes) if codes.len() + 3 <= in_full.len() => format!("\x1b[{codes}m"),
            _ => in_full,
        }
    }
}

/// Returns a semicolon and the code of a colour. `base` is the code of black: 30 for ink, 40 for the ground.
fn code(color: Color, base: usize) -> String {
    match color {
        Color::Indexed(index) => format!(";{};5;{index}", base + 8),
        Color::Rgb(red, green, blue) => format!(";{};2;{red};{green};{blue}", base + 8),
        color => match NAMED.iter().position(|(name, _)| *name == color) {
            Some(at) => format!(";{}", base + at % 8 + at / 8 * 60),
            None => format!(";{}", base + 9),
        },
    }
}

/// Returns the shortest sequence that moves the cursor from `at`, if known, to `goal`.
fn move_cursor(at: Option<Position>, goal: Position) -> String {
    let absolute = format!("\x1b[{};{}H", goal.y + 1, goal.x + 1);
    let Some(at) = at.filter(|at| at.y <= goal.y) else {
        return absolute;
    };
    let along = match i32::from(goal.x) - i32::from(at.x) {
        1 => "\x1b[C".to_owned(),
        right @ 2.. => format!("\x1b[{right}C"),
        back => "\x08".repeat(back.unsigned_abs() as usize),
    };
    let column = match goal.x {
        0 => "\r".to_owned(),
        x => format!("\x1b[{}G", x + 1),
    };
    // In raw mode a line feed does not return to the first column.
    let down = "\n".repeat(usize::from(goal.y - at.y));
    let ways = [down.clone() + &along, down + &column, absolute];
    let shortest = ways.into_iter().min_by_key(String::len);
    shortest.unwrap_or_default()
}

/// Whether all terminals agree on the width of a cell's character.
fn is_certain(cell: &Cell) -> bool {
    let certain =
        |sign| matches!(sign, ' '..='~' | '\u{2500}'..='\u{259f}' | '\u{2800}'..='\u{28ff}');
    cell.symbol().parse().is_ok_and(certain)
}

/// Keeps track of what a terminal shows, and writes the changes.
#[derive(Debug, Default)]
pub struct AnsiWriter {
    /// What the terminal shows; has no size while that is unknown.
    pub shown: Buffer,
    /// The pen with which the terminal writes now.
    pen: Pen,
    /// The position of the terminal's cursor, if certain.
    at: Option<Position>,
    /// Row and column from which the next chunk continues.
    place: (u16, u16),
}

impl AnsiWriter {
    /// Returns about `room` bytes that bring the terminal closer to `wanted`, and whether it then shows `wanted`. Clears a
    /// terminal that shows a screen of another size.
    pub fn chunk(&mut self, wanted: &Buffer, room: usize) -> (String, bool) {
        let mut text = String::new();
        if self.shown.area != wanted.area {
            text += "\x1b[m\x1b[2J\x1b[?25l";
            *self = Self::default();
            self.shown = Buffer::empty(wanted.area);
        }
        let mut changes = self.shown.diff(wanted);
        let is_whole = self.cut(&mut changes, room);
        // A style takes more bytes than a move, so the cells of one style go out together. The status
        // line goes first: a slow line shows it at once, and it shows that a key was received.
        changes.sort_by_cached_key(|&(x, y, cell)| {
            (y > 0, Pen::from_cell(cell).1.full_sequence(), y, x)
        });
        for (x, y, cell) in changes {
            let goal = Position::new(x, y);
            if self.at != Some(goal) {
                text += &move_cursor(self.at, goal);
            }
            let (symbol, mut pen) = Pen::from_cell(cell);
            // Only the background of a blank is visible.
            if symbol == " " && !(self.pen.modifier | pen.modifier).intersects(ON_BLANKS) {
                (pen.fg, pen.modifier) = (self.pen.fg, self.pen.modifier);
            }
            text += &pen.sequence(self.pen);
            text += symbol;
            self.pen = pen;
            // At the edge of the screen the cursor is nowhere certain.
            let is_certain = is_certain(cell) && x + 1 < wanted.area.width;
            self.at = is_certain.then_some(Position::new(x + 1, y));
            self.shown[goal].clone_from(cell);
        }
        if text.len() >= SHORT {
            text = format!("\x1b[?2026h{text}\x1b[?2026l");
        }
        (text, is_whole)
    }

    /// Keeps only the changes that fit into about `room` bytes; returns whether all do. The first and the last row show the
    /// state of the run and the keys, so they are sent whole. The other cells take turns, a few in each chunk. (Cells, not
    /// rows: a wide row may be larger than a chunk.)
    fn cut(&mut self, changes: &mut Vec<(u16, u16, &Cell)>, room: usize) -> bool {
        let last = self.shown.area.height.saturating_sub(1);
        let is_edge = |y| y == 0 || y == last;
        changes.sort_by_key(|&(x, y, _)| (!is_edge(y), (y, x) < self.place));
        let (mut taken, mut room, mut before) = (0, room.max(FEW), None);
        let next = changes.iter().position(|&(x, y, cell)| {
            let pen = Pen::from_cell(cell).1;
            let is_run = before.replace((x + 1, y, pen)) == Some((x, y, pen));
            taken += cell.symbol().len() + if is_run { 0 } else { RUN };
            if is_edge(y) {
                room = room.max(taken + FEW);
            }
            taken > room
        });
        if let Some(next) = next {
            self.place = (changes[next].1, changes[next].0);
            changes.truncate(next);
        }
        next.is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_way_is_taken() {
        let at = Position::new(40, 12);
        for (goal, expected) in [
            ((40, 12), ""),
            ((41, 12), "\x1b[C"),
            ((45, 12), "\x1b[5C"),
            ((39, 13), "\n\x08"),
            ((70, 13), "\n\x1b[30C"),
            ((0, 13), "\n\r"),
            ((2, 13), "\n\x1b[3G"),
            ((70, 30), "\x1b[31;71H"),
            ((70, 3), "\x1b[4;71H"),
        ] {
            assert_eq!(move_cursor(Some(at), goal.into()), expected, "{goal:?}");
        }
        assert_eq!(move_cursor(None, at), "\x1b[13;41H");
    }

    #[test]
    fn only_the_difference_is_written_unless_a_reset_is_shorter() {
        let pen = |fg, modifier| Pen {
            fg,
            modifier,
            ..Pen::default()
        };
        let (none, bold) = (Modifier::empty(), Modifier::BOLD);
        let red = pen(Color::Red, none);
        for (now, next, expected) in [
            (red, red, ""),
            (red, pen(Color::LightGreen, none), "\x1b[92m"),
            (red, Pen::default(), "\x1b[m"),
            (
                pen(Color::Red, bold),
                pen(Color::Indexed(178), bold),
                "\x1b[38;5;178m",
            ),
            (
                pen(Color::Red, bold | Modifier::DIM),
                pen(Color::Red, bold),
                "\x1b[;1;31m",
            ),
        ] {
            assert_eq!(next.sequence(now), expected, "{now:?} {next:?}");
        }
    }
}

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
    fn of(cell: &Cell) -> (&str, Self) {
        let is_block = cell.symbol() == "█" && cell.modifier.is_empty() && cell.fg != Color::Reset;
        let (symbol, fg, bg) = match is_block {
            true => (" ", Color::Reset, cell.fg),
            false => (cell.symbol(), cell.fg, cell.bg),
        };
        let modifier = cell.modifier;
        (symbol, Self { fg, bg, modifier })
    }

    /// The codes that lead from the pen `now` to this one, if that needs no reset.
    fn codes(self, now: Self) -> Option<Vec<String>> {
        if !self.modifier.contains(now.modifier) {
            return None;
        }
        // Modifiers stand in the order of their codes, from 1 on.
        let added = (self.modifier - now.modifier).iter();
        let added = added.map(|modifier| (modifier.bits().trailing_zeros() + 1).to_string());
        let mut codes: Vec<String> = added.collect();
        codes.extend((now.fg != self.fg).then(|| code(self.fg, 30)));
        codes.extend((now.bg != self.bg).then(|| code(self.bg, 40)));
        Some(codes)
    }

    /// The sequence that makes this the pen, whatever it is.
    fn anew(self) -> String {
        let codes = self.codes(Self::default()).unwrap_or_default();
        // No code, or an empty one, is a reset.
        let codes = codes.into_iter().map(|code| format!(";{code}"));
        format!("\x1b[{}m", codes.collect::<String>())
    }

    /// Returns the shortest sequence that changes the pen `now` to this one.
    fn sequence(self, now: Self) -> String {
        if now == self {
            return String::new();
        }
        let anew = self.anew();
        match self.codes(now).map(|codes| codes.join(";")) {
            Some(codes) if codes.len() + 3 <= anew.len() => format!("\x1b[{codes}m"),
            _ => anew,
        }
    }
}

/// The code of a colour, `base` being that of black: 30 for ink, 40 for ground.
fn code(color: Color, base: usize) -> String {
    match color {
        Color::Indexed(index) => format!("{};5;{index}", base + 8),
        Color::Rgb(red, green, blue) => format!("{};2;{red};{green};{blue}", base + 8),
        color => match NAMED.iter().position(|(name, _)| *name == color) {
            Some(at) => (base + at % 8 + at / 8 * 60).to_string(),
            None => (base + 9).to_string(),
        },
    }
}

/// Returns the shortest sequence that moves the cursor from `at`, if known, to `goal`.
fn way(at: Option<Position>, goal: Position) -> String {
    let absolute = format!("\x1b[{};{}H", goal.y + 1, goal.x + 1);
    let Some(at) = at.filter(|at| at.y <= goal.y) else {
        return absolute;
    };
    let along = match (goal.x.saturating_sub(at.x), at.x.saturating_sub(goal.x)) {
        (0, 0) => String::new(),
        (1, _) => "\x1b[C".to_owned(),
        (right, 0) => format!("\x1b[{right}C"),
        (_, back) => "\x08".repeat(usize::from(back)),
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
    let mut signs = cell.symbol().chars();
    let certain =
        |sign: char| matches!(sign, ' '..='~' | '\u{2500}'..='\u{259f}' | '\u{2800}'..='\u{28ff}');
    signs.next().is_some_and(certain) && signs.next().is_none()
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
    /// The cell from which the next chunk continues.
    place: usize,
}

impl AnsiWriter {
    /// About `room` bytes that bring the terminal closer to `wanted`; none if it shows that. The first and the last row
    /// tell of the run and of keys, and come whole; the rest in turn, a few cells in each chunk.
    pub fn chunk(&mut self, wanted: &Buffer, room: usize) -> String {
        let mut next = match self.shown.area == wanted.area {
            true => self.shown.clone(),
            false => Buffer::empty(wanted.area),
        };
        let [width, height] = [wanted.area.width, wanted.area.height].map(usize::from);
        let last = (width * height).saturating_sub(width).max(width);
        // A cell, not a row: a wide row may be larger than a chunk.
        let place = self.place.clamp(width, last);
        let edges = (0..width).chain(last..width * height);
        let inner = (place..last).chain(width..place);
        let (mut left, mut few, mut before) = (room, FEW, None);
        for i in edges.chain(inner) {
            let Some(cell) = wanted
                .content
                .get(i)
                .filter(|cell| **cell != next.content[i])
            else {
                continue;
            };
            let pen = Pen::of(cell).1;
            let is_run = before.replace((i + 1, pen)) == Some((i, pen));
            let cost = cell.symbol().len() + if is_run { 0 } else { RUN };
            if (width..last).contains(&i) {
                left = left.max(std::mem::take(&mut few));
                if cost > left {
                    self.place = i;
                    break;
                }
            }
            left = left.saturating_sub(cost);
            next.content[i].clone_from(cell);
        }
        self.frame(next)
    }

    /// The bytes that have the terminal show `next`; none if it does. One that shows a screen of another size is
    /// cleared first.
    pub fn frame(&mut self, next: Buffer) -> String {
        let mut text = String::new();
        if self.shown.area != next.area {
            text += "\x1b[m\x1b[2J\x1b[?25l";
            *self = Self {
                shown: Buffer::empty(next.area),
                ..Self::default()
            };
        }
        // A style takes more bytes than a move, so the cells of one style go out together. The status
        // line goes first: a slow line shows it at once, and it tells of a key.
        let mut changes = self.shown.diff(&next);
        changes.sort_by_cached_key(|(_, y, cell)| (*y > 0, Pen::of(cell).1.anew()));
        for (x, y, cell) in changes {
            let goal = Position::new(x, y);
            if self.at != Some(goal) {
                text += &way(self.at, goal);
            }
            let (symbol, mut pen) = Pen::of(cell);
            // Only the background of a blank is visible.
            if symbol == " " && !(self.pen.modifier | pen.modifier).intersects(ON_BLANKS) {
                pen = Pen {
                    bg: pen.bg,
                    ..self.pen
                };
            }
            text += &pen.sequence(self.pen);
            text += symbol;
            self.pen = pen;
            // At the edge of the screen the cursor is nowhere certain.
            let is_certain = is_certain(cell) && x + 1 < next.area.width;
            self.at = is_certain.then_some(Position::new(x + 1, y));
        }
        self.shown = next;
        if text.len() < SHORT {
            return text;
        }
        format!("\x1b[?2026h{text}\x1b[?2026l")
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
            assert_eq!(way(Some(at), goal.into()), expected, "{goal:?}");
        }
        assert_eq!(way(None, at), "\x1b[13;41H");
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

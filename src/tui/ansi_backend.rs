//! Turns changed cells into few bytes, since they may go over a slow line for hours.
//!
//! The stock backend writes every move as an absolute position and every style in full. Here cells of
//! one style go out together, a move is relative where that is shorter, and only what differs between
//! two styles is written. A frame is wrapped in a synchronized update (DEC private mode 2026), so that
//! the order of its cells is not seen; a frame without changes writes nothing.

use std::io::{self, Write};

use ratatui::backend::{Backend, ClearType, WindowSize};
use ratatui::buffer::Cell;
use ratatui::layout::{Position, Size};
use ratatui::style::{Color, Modifier};

/// The modifiers that the screen uses, and the codes that set them.
const MODIFIERS: [(Modifier, &str); 5] = [
    (Modifier::BOLD, "1"),
    (Modifier::DIM, "2"),
    (Modifier::ITALIC, "3"),
    (Modifier::UNDERLINED, "4"),
    (Modifier::REVERSED, "7"),
];

/// The colours that have short codes, in the order of these.
const BASIC: [Color; 16] = [
    Color::Black,
    Color::Red,
    Color::Green,
    Color::Yellow,
    Color::Blue,
    Color::Magenta,
    Color::Cyan,
    Color::Gray,
    Color::DarkGray,
    Color::LightRed,
    Color::LightGreen,
    Color::LightYellow,
    Color::LightBlue,
    Color::LightMagenta,
    Color::LightCyan,
    Color::White,
];

/// Colours and modifiers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct Pen {
    fg: Color,
    bg: Color,
    modifier: Modifier,
}

impl Pen {
    /// The sign of a cell, and the pen to write it with where the terminal has `now`. A blank needs only
    /// the ground, and a full block in a colour is a blank on that ground: one byte instead of three.
    fn of(cell: &Cell, now: Option<Self>) -> (&str, Self) {
        let inks_blanks = Modifier::REVERSED | Modifier::UNDERLINED;
        let is_block = cell.symbol() == "█" && cell.modifier.is_empty() && cell.fg != Color::Reset;
        let (symbol, bg) = match is_block {
            true => (" ", cell.fg),
            false => (cell.symbol(), cell.bg),
        };
        let pen = match now {
            Some(now)
                if symbol == " " && !(now.modifier | cell.modifier).intersects(inks_blanks) =>
            {
                Self { bg, ..now }
            }
            _ => Self {
                fg: if is_block { Color::Reset } else { cell.fg },
                bg,
                modifier: cell.modifier,
            },
        };
        (symbol, pen)
    }

    /// The codes that lead from the pen `now` to this one, if that needs no reset.
    fn codes(self, now: Self) -> Option<Vec<String>> {
        if !self.modifier.contains(now.modifier) {
            return None;
        }
        let added = self.modifier - now.modifier;
        let added = MODIFIERS
            .iter()
            .filter(|(modifier, _)| added.contains(*modifier));
        let mut codes: Vec<String> = added.map(|(_, code)| (*code).to_owned()).collect();
        codes.extend((now.fg != self.fg).then(|| code(self.fg, 30)));
        codes.extend((now.bg != self.bg).then(|| code(self.bg, 40)));
        Some(codes)
    }

    /// The shortest sequence that changes the pen `now`, if that is known, to this one.
    fn sequence(self, now: Option<Self>) -> String {
        if now == Some(self) {
            return String::new();
        }
        let difference = now.and_then(|now| self.codes(now));
        // No code, or an empty one, is a reset.
        let mut anew = self.codes(Self::default()).unwrap_or_default();
        anew.insert(0, String::new());
        let ways = difference.into_iter().chain([anew]);
        let ways = ways.map(|codes| format!("\x1b[{}m", codes.join(";")));
        ways.min_by_key(String::len).unwrap_or_default()
    }
}

/// The code of a colour, `base` being that of black: 30 for ink, 40 for ground.
fn code(color: Color, base: usize) -> String {
    match color {
        Color::Indexed(index) => format!("{};5;{index}", base + 8),
        Color::Rgb(red, green, blue) => format!("{};2;{red};{green};{blue}", base + 8),
        color => match BASIC.iter().position(|basic| *basic == color) {
            Some(at) => (base + at % 8 + at / 8 * 60).to_string(),
            None => (base + 9).to_string(),
        },
    }
}

/// The shortest sequence that moves the cursor from `at`, if that is known, to `goal`.
fn way(at: Option<Position>, goal: Position) -> String {
    let absolute = format!("\x1b[{};{}H", goal.y + 1, goal.x + 1);
    let Some(at) = at.filter(|at| at.y <= goal.y) else {
        return absolute;
    };
    let along = |from: u16| match (goal.x.saturating_sub(from), from.saturating_sub(goal.x)) {
        (0, 0) => String::new(),
        (1, _) => "\x1b[C".to_owned(),
        (right, 0) => format!("\x1b[{right}C"),
        (_, back) => "\x08".repeat(usize::from(back)),
    };
    // In raw mode a line feed does not return.
    let down = "\n".repeat(usize::from(goal.y - at.y));
    let ways = [
        along(at.x),
        format!("\r{}", along(0)),
        format!("\x1b[{}G", goal.x + 1),
    ];
    let ways = ways.into_iter().map(|along| down.clone() + &along);
    ways.chain([absolute])
        .min_by_key(String::len)
        .unwrap_or_default()
}

/// Whether all terminals agree on the width of a cell's sign.
fn is_certain(cell: &Cell) -> bool {
    let mut signs = cell.symbol().chars();
    let certain =
        |sign: char| matches!(sign, ' '..='~' | '\u{2500}'..='\u{259f}' | '\u{2800}'..='\u{28ff}');
    signs.next().is_some_and(certain) && signs.next().is_none()
}

/// A terminal at the other end of `out`.
#[derive(Debug)]
pub struct AnsiBackend<W: Write, S = fn() -> io::Result<Size>> {
    out: W,
    /// The bytes of the frame that is being written.
    frame: String,
    size: S,
    /// How the terminal writes now; unknown at first.
    pen: Option<Pen>,
    /// Where the terminal's cursor is, while that is certain.
    at: Option<Position>,
    is_hidden: bool,
}

impl<W: Write, S: Fn() -> io::Result<Size>> AnsiBackend<W, S> {
    /// Writes to `out`, a terminal whose size `size` tells.
    pub fn new(out: W, size: S) -> Self {
        Self {
            out,
            frame: String::new(),
            size,
            pen: None,
            at: None,
            is_hidden: false,
        }
    }

    /// Where the bytes go.
    pub fn get_ref(&self) -> &W {
        &self.out
    }
}

impl<W: Write, S: Fn() -> io::Result<Size>> Backend for AnsiBackend<W, S> {
    type Error = io::Error;

    fn draw<'a, I>(&mut self, content: I) -> io::Result<()>
    where
        I: Iterator<Item = (u16, u16, &'a Cell)>,
    {
        let columns = self.size()?.width;
        // A style takes more bytes than a move, so the cells of one style go out together. The status
        // line goes first: a slow line shows it at once, and it tells of a key.
        let mut content: Vec<_> = content.collect();
        content.sort_by_cached_key(|(_, y, cell)| (*y > 0, Pen::of(cell, None).1.sequence(None)));
        for (x, y, cell) in content {
            self.set_cursor_position((x, y))?;
            let (symbol, pen) = Pen::of(cell, self.pen);
            self.frame += &pen.sequence(self.pen);
            self.pen = Some(pen);
            self.frame += symbol;
            // At the edge of the screen the cursor is nowhere certain.
            let is_certain = is_certain(cell) && x + 1 < columns;
            self.at = is_certain.then(|| Position::new(x + 1, y));
        }
        Ok(())
    }

    fn hide_cursor(&mut self) -> io::Result<()> {
        if !self.is_hidden {
            self.frame += "\x1b[?25l";
            self.is_hidden = true;
        }
        Ok(())
    }

    fn show_cursor(&mut self) -> io::Result<()> {
        self.frame += "\x1b[?25h";
        self.is_hidden = false;
        Ok(())
    }

    /// Where the cursor was put: the terminal is not asked, for not every one answers.
    fn get_cursor_position(&mut self) -> io::Result<Position> {
        Ok(self.at.unwrap_or_default())
    }

    fn set_cursor_position<P: Into<Position>>(&mut self, position: P) -> io::Result<()> {
        let goal = position.into();
        if self.at != Some(goal) {
            self.frame += &way(self.at, goal);
            self.at = Some(goal);
        }
        Ok(())
    }

    fn clear(&mut self) -> io::Result<()> {
        self.clear_region(ClearType::All)
    }

    /// The whole screen, whatever is asked for: nothing else is ever cleared. All that was known of
    /// the terminal is forgotten.
    fn clear_region(&mut self, _: ClearType) -> io::Result<()> {
        (self.pen, self.at, self.is_hidden) = (Some(Pen::default()), None, false);
        self.frame += "\x1b[m\x1b[2J";
        Ok(())
    }

    fn size(&self) -> io::Result<Size> {
        (self.size)()
    }

    fn window_size(&mut self) -> io::Result<WindowSize> {
        Ok(WindowSize {
            columns_rows: self.size()?,
            pixels: Size::default(),
        })
    }

    fn flush(&mut self) -> io::Result<()> {
        if self.frame.is_empty() {
            return Ok(());
        }
        write!(self.out, "\x1b[?2026h{}\x1b[?2026l", self.frame)?;
        self.frame.clear();
        self.out.flush()
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
            (None, Pen::default(), "\x1b[m"),
            (None, pen(Color::Red, bold), "\x1b[;1;31m"),
            (Some(red), red, ""),
            (Some(red), pen(Color::LightGreen, none), "\x1b[92m"),
            (Some(red), Pen::default(), "\x1b[m"),
            (
                Some(pen(Color::Red, bold)),
                pen(Color::Indexed(178), bold),
                "\x1b[38;5;178m",
            ),
            (
                Some(pen(Color::Red, bold | Modifier::DIM)),
                pen(Color::Red, bold),
                "\x1b[;1;31m",
            ),
        ] {
            assert_eq!(next.sequence(now), expected, "{now:?} {next:?}");
        }
    }
}

//! Turns changed cells into the fewest bytes, since they may go over a slow line for hours.
//!
//! The stock backend writes every move as an absolute position and every colour as one of 256. Here
//! a move is a line feed, a backspace or a relative jump if that is shorter, the 16 basic colours
//! have short codes, and only the difference between two styles is written. A frame is wrapped in a
//! synchronized update (DEC private mode 2026); a frame without changes writes nothing.

use std::io::{self, Write};

use ratatui::backend::{Backend, ClearType, WindowSize};
use ratatui::buffer::Cell;
use ratatui::layout::{Position, Size};
use ratatui::style::{Color, Modifier};

/// Modifiers that the screen uses, with the numbers that set and unset them.
const MODIFIERS: [(Modifier, u8, u8); 5] = [
    (Modifier::BOLD, 1, 22),
    (Modifier::DIM, 2, 22),
    (Modifier::ITALIC, 3, 23),
    (Modifier::UNDERLINED, 4, 24),
    (Modifier::REVERSED, 7, 27),
];

/// How cells are being written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct Pen {
    fg: Color,
    bg: Color,
    modifier: Modifier,
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
    columns: u16,
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
            columns: 0,
        }
    }

    /// Where the bytes go.
    pub fn get_ref(&self) -> &W {
        &self.out
    }

    /// Where the bytes go, to take them.
    pub fn get_mut(&mut self) -> &mut W {
        &mut self.out
    }

    fn csi(&mut self, sequence: &str) {
        self.frame.push_str("\x1b[");
        self.frame.push_str(sequence);
    }

    /// Moves the cursor by the fewest bytes.
    fn move_to(&mut self, goal: Position) {
        let Some(at) = self.at else {
            return self.frame.push_str(&absolute(goal));
        };
        if at == goal {
            return;
        }
        let far = absolute(goal);
        match relative(at, goal) {
            Some(near) if near.len() < far.len() => self.frame.push_str(&near),
            _ => self.frame.push_str(&far),
        }
    }

    /// Changes the pen by the fewest bytes.
    fn take(&mut self, pen: Pen) {
        let fresh = numbers_from(Pen::default(), pen, true);
        let text = match self.pen {
            Some(now) if now == pen => return,
            Some(now) => {
                let change = numbers_from(now, pen, false);
                // Nothing at all would be read as a reset.
                if change.is_empty() || change.len() > fresh.len() {
                    fresh
                } else {
                    change
                }
            }
            None => fresh,
        };
        self.csi(&text);
        self.frame.push('m');
        self.pen = Some(pen);
    }

    fn write(&mut self, place: Position, cell: &Cell) {
        self.move_to(place);
        let mut pen = Pen {
            fg: cell.fg,
            bg: cell.bg,
            modifier: cell.modifier,
        };
        let symbol = cell.symbol();
        if let (" ", Some(now)) = (symbol, self.pen) {
            // A blank has no ink: only what fills the cell matters.
            let fills = Modifier::REVERSED | Modifier::UNDERLINED;
            if !pen.modifier.intersects(fills) && !now.modifier.intersects(fills) {
                (pen.fg, pen.modifier) = (now.fg, now.modifier);
            }
        }
        self.take(pen);
        self.frame.push_str(symbol);
        // Terminals disagree on the width of other signs, and on where the cursor is at the edge.
        let certain = |sign: char| matches!(sign, ' '..='~' | '\u{2500}'..='\u{259f}' | '\u{2800}'..='\u{28ff}');
        let mut signs = symbol.chars();
        let is_certain = signs.next().is_some_and(certain) && signs.next().is_none();
        self.at =
            (is_certain && place.x + 1 < self.columns).then(|| Position::new(place.x + 1, place.y));
    }
}

/// The sequence for an absolute position.
fn absolute(goal: Position) -> String {
    match (goal.x, goal.y) {
        (0, 0) => "\x1b[H".to_owned(),
        (0, y) => format!("\x1b[{}H", y + 1),
        (x, y) => format!("\x1b[{};{}H", y + 1, x + 1),
    }
}

/// The way from a known position: down by line feeds (which do not return in raw mode), then along
/// the row. None upwards.
fn relative(at: Position, goal: Position) -> Option<String> {
    let down = goal.y.checked_sub(at.y)?;
    let mut way = match down {
        0..=3 => "\n".repeat(usize::from(down)),
        down => format!("\x1b[{down}B"),
    };
    let (x, now) = (goal.x, at.x);
    if x == 0 && now > 0 {
        way.push('\r');
    } else if x < now && now - x <= 4 {
        way.push_str(&"\x08".repeat(usize::from(now - x)));
    } else if x < now {
        way.push_str(&format!("\x1b[{}D", now - x));
    } else if x == now + 1 {
        way.push_str("\x1b[C");
    } else if x > now {
        way.push_str(&format!("\x1b[{}C", x - now));
    }
    Some(way)
}

/// The numbers that lead from one pen to another, after a reset or not.
fn numbers_from(now: Pen, pen: Pen, after_reset: bool) -> String {
    let mut numbers: Vec<String> = Vec::new();
    if after_reset {
        numbers.push(String::new());
    }
    let removed = now.modifier - pen.modifier;
    let mut added = pen.modifier - now.modifier;
    for (modifier, _, unset) in MODIFIERS {
        if removed.contains(modifier) && !numbers.contains(&unset.to_string()) {
            numbers.push(unset.to_string());
        }
    }
    // Bold and dim are unset together: what stays of them is set again.
    let weights = Modifier::BOLD | Modifier::DIM;
    if removed.intersects(weights) {
        added |= pen.modifier & weights;
    }
    for (modifier, set, _) in MODIFIERS {
        if added.contains(modifier) {
            numbers.push(set.to_string());
        }
    }
    if now.fg != pen.fg {
        numbers.push(color(pen.fg, 30));
    }
    if now.bg != pen.bg {
        numbers.push(color(pen.bg, 40));
    }
    numbers.join(";")
}

/// The number of a colour, `base` being that of black: 30 for ink, 40 for ground.
fn color(color: Color, base: u8) -> String {
    let bright = base + 60;
    let number = match color {
        Color::Reset => base + 9,
        Color::Black => base,
        Color::Red => base + 1,
        Color::Green => base + 2,
        Color::Yellow => base + 3,
        Color::Blue => base + 4,
        Color::Magenta => base + 5,
        Color::Cyan => base + 6,
        Color::Gray => base + 7,
        Color::DarkGray => bright,
        Color::LightRed => bright + 1,
        Color::LightGreen => bright + 2,
        Color::LightYellow => bright + 3,
        Color::LightBlue => bright + 4,
        Color::LightMagenta => bright + 5,
        Color::LightCyan => bright + 6,
        Color::White => bright + 7,
        Color::Indexed(index) => return format!("{};5;{index}", base + 8),
        Color::Rgb(r, g, b) => return format!("{};2;{r};{g};{b}", base + 8),
    };
    number.to_string()
}

impl<W: Write, S: Fn() -> io::Result<Size>> Backend for AnsiBackend<W, S> {
    type Error = io::Error;

    fn draw<'a, I>(&mut self, content: I) -> io::Result<()>
    where
        I: Iterator<Item = (u16, u16, &'a Cell)>,
    {
        // At the edge of the screen the cursor is nowhere certain.
        self.columns = self.size()?.width;
        for (x, y, cell) in content {
            self.write(Position::new(x, y), cell);
        }
        Ok(())
    }

    fn hide_cursor(&mut self) -> io::Result<()> {
        if !self.is_hidden {
            self.csi("?25l");
            self.is_hidden = true;
        }
        Ok(())
    }

    fn show_cursor(&mut self) -> io::Result<()> {
        self.csi("?25h");
        self.is_hidden = false;
        Ok(())
    }

    /// Where the cursor was put: the terminal is not asked, for not every one answers.
    fn get_cursor_position(&mut self) -> io::Result<Position> {
        Ok(self.at.unwrap_or_default())
    }

    fn set_cursor_position<P: Into<Position>>(&mut self, position: P) -> io::Result<()> {
        let goal = position.into();
        self.move_to(goal);
        self.at = Some(goal);
        Ok(())
    }

    fn clear(&mut self) -> io::Result<()> {
        self.clear_region(ClearType::All)
    }

    /// The whole screen, whatever is asked for: nothing else is ever cleared. All that was known of
    /// the terminal is forgotten.
    fn clear_region(&mut self, _: ClearType) -> io::Result<()> {
        (self.pen, self.at, self.is_hidden) = (None, None, false);
        self.take(Pen::default());
        self.csi("2J");
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
        self.out.write_all(b"\x1b[?2026h")?;
        self.out.write_all(self.frame.as_bytes())?;
        self.out.write_all(b"\x1b[?2026l")?;
        self.frame.clear();
        self.out.flush()
    }
}

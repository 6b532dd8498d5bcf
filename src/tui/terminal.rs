//! The terminal: taken over at the start and restored on every way out.

use std::io;
use std::sync::mpsc::Sender;
use std::time::Instant;

use crossterm::terminal::{disable_raw_mode, enable_raw_mode};
use ratatui::buffer::Cell;
use ratatui::prelude::*;

use super::ansi_writer::AnsiWriter;
use super::event::Event;
use super::flow::Flow;
use super::output::Output;

/// Takes the terminal over: the alternate screen (DEC private mode 1049), and a paste is marked as one (2004).
const TAKE_OVER: &str = "\x1b[?1049h\x1b[?2004h";

/// Restores it: ends a synchronized update (2026) and the marks, resets the style, leaves the alternate screen, and
/// shows the cursor (25).
const GIVE_BACK: &str = "\x1b[?2026l\x1b[?2004l\x1b[m\x1b[?1049l\x1b[?25h";

/// Asks for presses, releases and the wheel (mode 1000), in numbers that hold on any screen (1006).
/// The terminal is not asked for the mouse's movements: each would be bytes on the wire.
const MOUSE_ON: &str = "\x1b[?1000h\x1b[?1006h";

/// Undoes that.
const MOUSE_OFF: &str = "\x1b[?1006l\x1b[?1000l";

/// Asks what the background is (OSC 11). The first frame does not wait for the answer, and there may be
/// none.
const BACKGROUND: &str = "\x1b]11;?\x1b\\";

/// The terminal in raw mode on its alternate screen, until dropped.
pub struct Screen {
    output: Output,
    writer: AnsiWriter,
    mouse: bool,
    /// What is known of the line to the terminal.
    pub flow: Flow,
    /// Whether the terminal was restored successfully.
    is_restored: bool,
}

/// The most columns and rows that are drawn, as with `--print`: a terminal that says it has more shows the
/// rest empty.
const LARGEST: u16 = 1000;

/// How many screens there must be memory for: what is shown, what is wanted, what of it comes next, its text on the way
/// out, and room for what other threads take meanwhile.
const SCREENS: usize = 8;

/// The size of the terminal, as far as it is drawn on.
///
/// # Errors
///
/// If nothing tells the size, or if there is no memory for so many characters.
pub fn size() -> io::Result<Size> {
    let (columns, rows) = crossterm::terminal::size()?;
    let size = Size::new(columns.min(LARGEST), rows.min(LARGEST));
    let cells = SCREENS * usize::from(size.width) * usize::from(size.height);
    // An allocation that fails later on ends the process, and leaves the terminal as it is.
    match Vec::<Cell>::new().try_reserve_exact(cells) {
        Ok(()) => Ok(size),
        Err(_) => Err(io::Error::other(format!(
            "no memory for a screen of {columns} by {rows} characters"
        ))),
    }
}

impl Screen {
    /// Takes the terminal over, and the mouse as well if it was asked for. `events` is told when the
    /// terminal has taken what was drawn, and when it is gone; with `asks`, also what the background is.
    pub fn open(mouse: bool, asks: bool, events: Sender<Event>) -> io::Result<Self> {
        let mut screen = Self {
            output: Output::open(events)?,
            writer: AnsiWriter::default(),
            mouse,
            flow: Flow::default(),
            is_restored: true,
        };
        screen.take_back()?;
        if asks {
            screen.output.send(BACKGROUND);
        }
        Ok(screen)
    }

    /// Starts from an empty screen of the present size. Between two drawings a terminal can have
    /// become smaller and large again, so that its size says nothing of what is left on it.
    pub fn start_afresh(&mut self) {
        self.writer = AnsiWriter::default();
    }

    /// Gives the terminal back, for a while or for good. True if it has taken that.
    pub fn give_back(&mut self) -> bool {
        let mouse = if self.mouse { MOUSE_OFF } else { "" };
        self.is_restored = self.output.finish(&format!("{mouse}{GIVE_BACK}"));
        let _ = disable_raw_mode();
        self.is_restored
    }

    /// Takes the terminal over, also again, as it may be anything by now.
    pub fn take_back(&mut self) -> io::Result<()> {
        enable_raw_mode()?;
        self.is_restored = false;
        let mouse = if self.mouse { MOUSE_ON } else { "" };
        self.output.send(&format!("{TAKE_OVER}{mouse}"));
        self.flow.forget();
        self.start_afresh();
        Ok(())
    }

    /// Draws a screen: only changes are sent, and on a slow line only as many rows as do not delay a
    /// key. Returns false if rows are left for the next frame.
    pub fn draw(&mut self, draw: impl FnOnce(Rect, &mut Buffer)) -> io::Result<bool> {
        let area = Rect::from(size()?);
        let mut wanted = Buffer::empty(area);
        draw(area, &mut wanted);
        let now = Instant::now();
        let rooms: &[Option<usize>] = match self.flow.room(now) {
            Some(_) if self.flow.acknowledges(now) => &[Some(0)],
            // Where nothing tells how slow the line is, a key is answered whole, but the lines that
            // tell of the run before the rest.
            Some(_) if self.flow.hurries(now) && !self.flow.answers() => &[Some(0), None],
            room => &[room],
        };
        let (mut bytes, mut frames) = (0, 0);
        for room in rooms {
            let next = match room {
                Some(room) => rows_within(&self.writer.shown, &wanted, *room),
                None => wanted.clone(),
            };
            let frame = self.writer.frame(next);
            if !frame.is_empty() {
                bytes += self.output.frame(frame);
                frames += 1;
            }
        }
        self.flow.sent(now, bytes, frames);
        Ok(self.writer.shown == wanted)
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        if !self.is_restored {
            self.give_back();
        }
    }
}

/// Returns `shown`, or an empty screen where that has another size, with as many rows of `wanted` as fit into
/// `room` bytes: the lines above and below the panels first, and at least one row that differs.
fn rows_within(shown: &Buffer, wanted: &Buffer, room: usize) -> Buffer {
    let mut next = match shown.area == wanted.area {
        true => shown.clone(),
        false => Buffer::empty(wanted.area),
    };
    let [width, height] = [wanted.area.width, wanted.area.height].map(usize::from);
    let (mut left, mut is_new) = (room, false);
    let edges = [0, height.saturating_sub(1)];
    let inner = 1..height.saturating_sub(1);
    for (i, row) in edges.into_iter().chain(inner).enumerate() {
        let cells = row * width..((row + 1) * width).min(wanted.content.len());
        let (wanted, shown) = (&wanted.content[cells.clone()], &mut next.content[cells]);
        let pairs = wanted.iter().zip(&*shown);
        let changed = pairs.filter(|(wanted, shown)| wanted != shown);
        let cost: usize = changed.map(|(wanted, _)| wanted.symbol().len() + 1).sum();
        if cost == 0 {
            continue;
        }
        // A move and a style or two.
        let cost = cost + 12;
        if i >= edges.len() && cost > left && is_new {
            break;
        }
        is_new = true;
        left = left.saturating_sub(cost);
        shown.clone_from_slice(wanted);
    }
    next
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn on_a_slow_line_the_lines_around_the_panels_come_first_and_all_rows_at_last() {
        let wanted = Buffer::with_lines((0..24).map(|row| row.to_string().repeat(30)));
        let mut shown = Buffer::empty(wanted.area);
        let first = rows_within(&shown, &wanted, 200);
        let is_there = |buffer: &Buffer, row: u16| buffer[(0, row)] == wanted[(0, row)];
        assert!(is_there(&first, 0) && is_there(&first, 23));
        assert!(!is_there(&first, 5), "too much for one frame");
        let mut frames = 0;
        while shown != wanted {
            shown = rows_within(&shown, &wanted, 200);
            frames += 1;
        }
        assert!((5..=24).contains(&frames), "{frames}");
    }
}

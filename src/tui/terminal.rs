//! The terminal: taken over at the start and restored on every way out.

use std::io;
use std::sync::mpsc::Sender;
use std::time::Instant;

use ratatui::buffer::Cell;
use ratatui::prelude::*;

use super::ansi_writer::AnsiWriter;
use super::event::Event;
use super::flow::Flow;
use super::modes::Modes;
use super::output::TerminalOutput;

/// Takes over the terminal: the alternate screen (DEC private mode 1049), and marks around pasted text (2004).
const TAKE_OVER: &str = "\x1b[?1049h\x1b[?2004h";

/// Restores it: ends a synchronized update (2026) and the marks, resets the style, leaves the alternate screen, and
/// shows the cursor (25).
const GIVE_BACK: &str = "\x1b[?2026l\x1b[?2004l\x1b[m\x1b[?1049l\x1b[?25h";

/// Asks for presses, releases and the wheel (mode 1000), in numbers that hold on any screen (1006).
/// The terminal is not asked for the mouse's movements: each would be bytes on the wire. The second string undoes the
/// first.
const MOUSE: [&str; 2] = ["\x1b[?1000h\x1b[?1006h", "\x1b[?1006l\x1b[?1000l"];

/// Asks what the background is (OSC 11). The first frame does not wait for the answer, and there may be
/// none.
const BACKGROUND: &str = "\x1b]11;?\x1b\\";

/// The terminal in raw mode on its alternate screen, until dropped.
pub struct TerminalScreen {
    /// The way to the terminal. What is sent must draw nothing.
    pub output: TerminalOutput,
    writer: AnsiWriter,
    modes: Modes,
    /// What turns the mouse on and off.
    mouse: [&'static str; 2],
    opened: Instant,
    /// The state of the line to the terminal.
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

/// The drawn size of the terminal, within limits.
///
/// # Errors
///
/// If nothing tells the size, or if there is no memory for so many characters.
pub fn size() -> io::Result<Size> {
    // The size is all that crossterm does: its raw mode keeps the modes that it found first, which are wrong after SIGSTOP
    // and `fg`, and its events hold back the status reports by which the line is measured.
    let window = crossterm::terminal::window_size()?;
    let (columns, rows) = (window.columns, window.rows);
    let size = Size::new(columns.min(LARGEST), rows.min(LARGEST));
    let cells = SCREENS * usize::from(size.width) * usize::from(size.height);
    // A failed allocation would end the process and leave the terminal in raw mode.
    let refusal = format!("no memory for a screen of {columns} by {rows} characters");
    let reserved = Vec::<Cell>::new().try_reserve_exact(cells);
    reserved.map_or(Err(io::Error::other(refusal)), |()| Ok(size))
}

impl TerminalScreen {
    /// Takes the terminal over, and the mouse as well if it was asked for. `events` is notified when the
    /// terminal has taken what was drawn, and when it is gone; with `asks`, also what the background is.
    pub fn open(mouse: bool, asks: bool, events: Sender<Event>) -> io::Result<Self> {
        let mut screen = Self {
            output: TerminalOutput::open(events)?,
            writer: AnsiWriter::default(),
            modes: Modes::note()?,
            mouse: if mouse { MOUSE } else { ["", ""] },
            opened: Instant::now(),
            flow: Flow::default(),
            is_restored: true,
        };
        screen.acquire()?;
        if asks {
            screen.output.send(BACKGROUND);
        }
        Ok(screen)
    }

    /// Returns the time for the flow control: seconds since the terminal was opened.
    pub fn now(&self) -> f64 {
        self.opened.elapsed().as_secs_f64()
    }

    /// Starts from an empty screen of the present size. Between two drawings a terminal can have
    /// become smaller and large again, so that its size says nothing of what is left on it.
    pub fn forget_contents(&mut self) {
        self.writer = AnsiWriter::default();
    }

    /// Restores the terminal, temporarily or finally, unless already done. Returns true if the terminal accepted it.
    pub fn release(&mut self) -> bool {
        if !self.is_restored {
            self.is_restored = self.output.finish(&[self.mouse[1], GIVE_BACK].concat());
            self.modes.restore();
        }
        self.is_restored
    }

    /// Takes over the terminal, also after a suspension, when it may be in any state.
    pub fn acquire(&mut self) -> io::Result<()> {
        self.modes.set_raw()?;
        self.is_restored = false;
        self.flow.forget();
        let measures = self.flow.measure(self.now());
        self.output
            .send(&[measures, TAKE_OVER, self.mouse[0]].concat());
        self.forget_contents();
        Ok(())
    }

    /// Draws a screen: only changes are sent, and no more than the line carries in a moment. Returns false if cells are
    /// left for the next chunk.
    pub fn draw(&mut self, draw: impl FnOnce(Rect, &mut Buffer)) -> io::Result<bool> {
        let area = Rect::from(size()?);
        let mut wanted = Buffer::empty(area);
        draw(area, &mut wanted);
        let now = self.now();
        let (room, measures) = self.flow.room(now);
        let (chunk, is_whole) = self.writer.chunk(&wanted, room);
        if !chunk.is_empty() {
            if measures {
                self.output.send(self.flow.measure(now));
            }
            let bytes = self.output.frame(chunk);
            self.flow.note_sent(now, bytes);
        }
        Ok(is_whole)
    }
}

impl Drop for TerminalScreen {
    fn drop(&mut self) {
        self.release();
    }
}

//! The terminal: taken over at the start and restored on every way out.

use std::io;
use std::mem::ManuallyDrop;
use std::sync::mpsc::Sender;
use std::time::Instant;

use crossterm::cursor::Show;
use crossterm::event::{DisableBracketedPaste, EnableBracketedPaste};
use crossterm::queue;
use crossterm::style::{Attribute, Print, SetAttribute};
use crossterm::terminal::{
    Clear, ClearType, EndSynchronizedUpdate, EnterAlternateScreen, LeaveAlternateScreen,
    disable_raw_mode, enable_raw_mode,
};
use ratatui::Terminal;
use ratatui::buffer::{Buffer, Cell};
use ratatui::layout::{Rect, Size};

use super::Event;
use super::ansi_backend::AnsiBackend;
use super::flow::{Flow, When};
use super::output::Output;

/// Asks for presses, releases and the wheel (mode 1000), in numbers that hold on any screen (1006).
/// The terminal is not asked for the mouse's movements: each would be bytes on the wire.
const MOUSE_ON: &str = "\x1b[?1000h\x1b[?1006h";

/// Undoes that.
const MOUSE_OFF: &str = "\x1b[?1006l\x1b[?1000l";

/// Asks what the background is (OSC 11). The first frame does not wait for the answer, and there may be
/// none.
const BACKGROUND: &[u8] = b"\x1b]11;?\x1b\\";

/// Who handles the mouse.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Capture {
    /// The terminal, which selects text with it.
    None,
    /// The explorer, which is told of clicks and the wheel.
    Clicks,
}

type Backend = AnsiBackend<Output>;

/// The terminal in raw mode on its alternate screen, until dropped.
pub struct Screen {
    /// Never dropped: that would write the rest of a frame behind the restored screen, and panic
    /// where the terminal is gone.
    terminal: ManuallyDrop<Terminal<Backend>>,
    mouse: Capture,
    flow: Flow,
    /// What the terminal shows.
    shown: Buffer,
    /// Whether the terminal was restored successfully.
    is_restored: bool,
}

/// The most columns and rows that are drawn, as with `--print`: a terminal that says it has more shows the
/// rest empty.
const LARGEST: u16 = 1000;

/// How many screens are in memory at once: what is shown and what is wanted, here and in the libraries.
const SCREENS: usize = 6;

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
    pub fn open(mouse: Capture, asks: bool, events: Sender<Event>) -> io::Result<Self> {
        enable_raw_mode()?;
        let restore = RestoreOnFailure;
        let backend = AnsiBackend::new(Output::open(events)?, size as fn() -> io::Result<Size>);
        backend.get_ref().send(&taking_over(mouse)?);
        if asks {
            backend.get_ref().send(BACKGROUND);
        }
        let terminal = ManuallyDrop::new(Terminal::new(backend)?);
        std::mem::forget(restore);
        Ok(Self {
            terminal,
            mouse,
            flow: Flow::default(),
            shown: Buffer::empty(Rect::ZERO),
            is_restored: false,
        })
    }

    /// Starts from an empty screen of the present size. Between two drawings a terminal can have
    /// become smaller and large again, so that its size says nothing of what is left on it.
    pub fn start_afresh(&mut self) -> io::Result<()> {
        let size = self.terminal.size()?;
        self.shown = Buffer::empty(Rect::ZERO);
        self.terminal.resize(size.into())
    }

    /// Gives the terminal back, for a while or for good. True if it has taken that.
    pub fn give_back(&mut self) -> bool {
        let output = self.terminal.backend().get_ref();
        self.is_restored = giving_back(self.mouse).is_ok_and(|bytes| output.finish(&bytes));
        let _ = disable_raw_mode();
        self.is_restored
    }

    /// Takes the terminal over again, as it may be anything by now.
    pub fn take_back(&mut self) -> io::Result<()> {
        enable_raw_mode()?;
        let output = self.terminal.backend().get_ref();
        output.send(&taking_over(self.mouse)?);
        // The backend's knowledge of the terminal is outdated.
        self.flow.forget();
        self.is_restored = false;
        self.start_afresh()
    }

    /// When the next frame may be drawn.
    pub fn when(&self) -> When {
        self.flow.when(Instant::now())
    }

    /// Reports progress on the line to the terminal.
    pub fn flow(&mut self) -> &mut Flow {
        &mut self.flow
    }

    /// Draws a screen: only changes are sent, and on a slow line only as many rows as do not delay a
    /// key. Returns false if rows are left for the next frame.
    pub fn draw(&mut self, draw: impl FnOnce(Rect, &mut Buffer)) -> io::Result<bool> {
        self.terminal.autoresize()?;
        let area = self.terminal.get_frame().area();
        let mut wanted = Buffer::empty(area);
        draw(area, &mut wanted);
        if self.shown.area != area {
            self.shown = Buffer::empty(area);
        }
        let now = Instant::now();
        let before = self.terminal.backend().get_ref().sent();
        let room = match self.flow.hurries(now) && !self.flow.answers() {
            true if self.flow.acknowledges(now) && self.flow.room(now).is_some() => Some(0),
            // Where nothing tells how slow the line is, a key is answered whole, but the lines that
            // tell of the run before the rest.
            true => {
                if self.flow.room(now).is_some() {
                    let next = rows_within(&self.shown, &wanted, 0);
                    self.put(next)?;
                }
                None
            }
            false => self.flow.room(now),
        };
        let next = match room {
            Some(room) => rows_within(&self.shown, &wanted, room),
            None => wanted.clone(),
        };
        self.put(next)?;
        let (bytes, frames) = self.terminal.backend().get_ref().sent();
        self.flow.sent(now, bytes - before.0, frames - before.1);
        Ok(self.shown == wanted)
    }

    /// Has the terminal show `next`.
    fn put(&mut self, next: Buffer) -> io::Result<()> {
        let mut fits = false;
        self.terminal.draw(|frame| {
            // Between two looks at its size a terminal may have changed it; a signal tells of that.
            fits = frame.area() == next.area;
            if fits {
                frame.buffer_mut().clone_from(&next);
            }
        })?;
        if fits {
            self.shown = next;
        }
        Ok(())
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        if !self.is_restored {
            self.give_back();
        }
    }
}

/// Returns `shown` with as many rows of `wanted` as fit into `room` bytes: the lines above and below
/// the panels first, and at least one row that differs.
fn rows_within(shown: &Buffer, wanted: &Buffer, room: usize) -> Buffer {
    let mut next = shown.clone();
    let (width, height) = (
        usize::from(wanted.area.width),
        usize::from(wanted.area.height),
    );
    let mut left = room;
    let edges = [0, height.saturating_sub(1)];
    let inner = 1..height.saturating_sub(1);
    for (i, row) in edges.into_iter().chain(inner).enumerate() {
        let cells = row * width..((row + 1) * width).min(wanted.content.len());
        let pairs = wanted.content[cells.clone()]
            .iter()
            .zip(&shown.content[cells.clone()]);
        let changed = pairs.filter(|(wanted, shown)| wanted != shown);
        let cost: usize = changed.map(|(wanted, _)| wanted.symbol().len() + 1).sum();
        if cost == 0 {
            continue;
        }
        // A move and a style or two.
        let cost = cost + 12;
        if i >= edges.len() && cost > left && next != *shown {
            break;
        }
        left = left.saturating_sub(cost);
        next.content[cells.clone()].clone_from_slice(&wanted.content[cells]);
    }
    next
}

struct RestoreOnFailure;

impl Drop for RestoreOnFailure {
    fn drop(&mut self) {
        let _ = disable_raw_mode();
    }
}

/// The sequences that take a terminal over.
fn taking_over(mouse: Capture) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    // Not the clear of ratatui: it asks where the cursor is, and not every terminal answers.
    queue!(
        bytes,
        EnterAlternateScreen,
        Clear(ClearType::All),
        EnableBracketedPaste
    )?;
    if mouse == Capture::Clicks {
        queue!(bytes, Print(MOUSE_ON))?;
    }
    Ok(bytes)
}

/// The sequences that restore it.
fn giving_back(mouse: Capture) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    if mouse == Capture::Clicks {
        queue!(bytes, Print(MOUSE_OFF))?;
    }
    queue!(
        bytes,
        EndSynchronizedUpdate,
        DisableBracketedPaste,
        SetAttribute(Attribute::Reset),
        LeaveAlternateScreen,
        Show
    )?;
    Ok(bytes)
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

//! Turns changed cells into the fewest bytes, since they may go over a slow line for hours.
//!
//! The stock backend writes every move as an absolute position and every colour as one of 256, row by
//! row. Here a move is a line feed, a backspace or a relative jump if that is shorter, the 16 basic
//! colours have short codes, only the difference between two styles is written, and cells of one colour
//! go out together. A frame is wrapped in a synchronized update (DEC private mode 2026); a frame without
//! changes writes nothing.

use std::io::{self, Write};

use ratatui::backend::{Backend, ClearType, WindowSize};
use ratatui::buffer::Cell;
use ratatui::layout::{Position, Size};

use moves::move_to;
use pen::Pen;
use runs::{Queue, Run, Shown};

mod moves;
mod pen;
mod runs;
mod sink;

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
    shown: Shown,
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
            shown: Shown::default(),
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

    /// Writes a run from where the cursor is.
    fn write(&mut self, run: &Run) {
        move_to(self.at, run.start, &mut self.frame);
        let pen = run.pen(self.pen);
        pen.take(self.pen, &mut self.frame);
        self.pen = Some(pen);
        let text = self.shown.text(run.start.x..run.end, run.start.y);
        self.frame.push_str(&text);
        // At the edge of the screen the cursor is nowhere certain.
        let is_certain = run.is_certain && run.end < self.columns;
        self.at = is_certain.then(|| Position::new(run.end, run.start.y));
    }
}

impl<W: Write, S: Fn() -> io::Result<Size>> Backend for AnsiBackend<W, S> {
    type Error = io::Error;

    fn draw<'a, I>(&mut self, content: I) -> io::Result<()>
    where
        I: Iterator<Item = (u16, u16, &'a Cell)>,
    {
        let size = self.size()?;
        self.columns = size.width;
        self.shown.resize(size);
        let places = self.shown.change(content);
        let mut queue = Queue::new(self.shown.runs(&places));
        while let Some(run) = queue.next(self.at, self.pen) {
            self.write(&run);
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
        move_to(self.at, goal, &mut self.frame);
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
        self.shown.clear();
        Pen::default().take(None, &mut self.frame);
        self.pen = Some(Pen::default());
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

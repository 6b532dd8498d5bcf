//! `history.csv`: one row per recorded moment.
//!
//! During the run, rows go to a separate file, so that neither memory nor checkpoints grow with the number of rows. The
//! header describes the end of the run and is written then. A checkpoint holds the newest rows and the length of the
//! file. Rows that cannot be written stay in memory and in the checkpoint.

use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::header::{head, lines};
use super::safe_open;
use crate::reading::{Column, Recorder};
use crate::scenario::scalars::{self, Reading};
use crate::scenario::session::Session;

/// Rows kept in memory before they are written.
const ROWS: usize = 256;

/// Bytes of the file that are read at once.
const CHUNK: usize = 64 << 10;

/// The rows recorded so far.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct History {
    /// The newest rows, not yet in the file.
    rows: Recorder,
    /// The length of this history's part of the file, in bytes.
    written: u64,
    last_cycle: Option<f64>,
}

impl Default for History {
    /// Makes an empty history that records the standard columns.
    fn default() -> Self {
        Self {
            rows: Recorder::of_moments(Column::HISTORY),
            written: 0,
            last_cycle: None,
        }
    }
}

impl History {
    /// Makes an empty history that records the scalars `further` in addition to the standard columns.
    ///
    /// # Errors
    ///
    /// Names, in one line, the first of them that is not a scalar or is already a column.
    pub fn with_columns(further: &[String]) -> Result<Self, String> {
        let mut columns = Column::HISTORY.to_vec();
        for name in further {
            columns.push(scalars::find_scalar(name)?);
        }
        let history = Self {
            rows: Recorder::of_moments(columns),
            ..Self::default()
        };
        history.check_columns()?;
        Ok(history)
    }

    /// Makes a history that begins with the whole cycles of `past` up to the cycle `now`.
    pub fn of_cycles(past: &Recorder, now: f64) -> Self {
        let mut history = Self::default();
        let cycles = past.table(&Column::HISTORY);
        history.rows.record_table(&cycles, now.floor());
        history
    }

    /// Refuses a column that stands twice.
    fn check_columns(&self) -> Result<(), String> {
        let columns = self.columns();
        let mut further = columns.iter().enumerate().skip(Column::HISTORY.len());
        match further.find(|(at, column)| columns[..*at].contains(column)) {
            Some((_, column)) => Err(format!(
                "{} is a column of the history already",
                column.name()
            )),
            None => Ok(()),
        }
    }

    /// The columns.
    pub fn columns(&self) -> &[Column] {
        self.rows.columns()
    }

    /// Whether nothing is recorded yet.
    pub fn is_empty(&self) -> bool {
        self.written == 0 && self.rows.rows().is_empty()
    }

    /// Returns the buffered rows as lines of the file.
    fn text(&self) -> String {
        lines(&self.rows.table(self.columns()))
    }

    /// Drops what was recorded after `earlier` was copied from this history.
    pub fn rewind(&mut self, earlier: &Self) {
        if self.written == earlier.written {
            let count = earlier.rows.rows().len();
            self.rows.keep(|row| row < count);
        } else {
            // The rows that the copy holds have been written since.
            self.written = earlier.written + earlier.text().len() as u64;
            self.rows.keep(|_| false);
        }
        self.last_cycle = earlier.last_cycle;
    }

    /// Records the present moment of `session`, but no moment twice.
    pub fn record(&mut self, session: &Session) {
        let simulation = session.simulation();
        if self.last_cycle == Some(simulation.cycle()) {
            return;
        }
        self.last_cycle = Some(simulation.cycle());
        let reading = Reading::new(session);
        self.rows.record(|column| reading.number(column));
    }

    /// Whether there are enough buffered rows to [`spill`](Self::spill).
    pub fn is_full(&self) -> bool {
        self.rows.rows().len() >= ROWS
    }

    /// Appends the buffered rows to the file at `path`. On an error they stay in memory and the file is unchanged.
    pub fn spill(&mut self, path: &Path) -> io::Result<()> {
        let text = self.text();
        let mut file = safe_open::open_or_make(path)?;
        // A killed run may have written rows beyond this length.
        file.set_len(self.written)?;
        file.seek(SeekFrom::Start(self.written))?;
        file.write_all(text.as_bytes())?;
        // From now on a checkpoint may rely on these rows.
        file.sync_data()?;
        self.written += text.len() as u64;
        self.rows.keep(|_| false);
        Ok(())
    }

    /// Drops the rows that are not in memory unless they are in the file at `path`; returns whether any are lost.
    pub fn loses_rows(&mut self, path: &Path) -> bool {
        let about = safe_open::read(path).and_then(|file| file.metadata());
        let length = about.map_or(0, |about| about.len());
        let is_lost = length < self.written;
        if is_lost {
            self.written = 0;
        }
        is_lost
    }

    /// Copies this history's rows from the file at `from`.
    fn copy_rows(&self, from: &Path, to: &mut dyn Write) -> io::Result<()> {
        let mut rows = safe_open::read(from)?.take(self.written);
        let mut chunk = vec![0; CHUNK];
        loop {
            let length = rows.read(&mut chunk)?;
            match &chunk[..length] {
                [] if rows.limit() == 0 => return Ok(()),
                read if is_of_cells(read) && !read.is_empty() => to.write_all(read)?,
                _ => {
                    let why = "does not hold the rows of this run";
                    return Err(io::Error::new(io::ErrorKind::InvalidData, why));
                }
            }
        }
    }

    /// Checks a history read from a checkpoint.
    ///
    /// # Errors
    ///
    /// Says in one line what is invalid.
    pub fn check(&self) -> Result<(), String> {
        self.check_columns()?;
        if !self.columns().starts_with(&Column::HISTORY) || !self.rows.is_whole() {
            return Err("the saved rows of the history are not those of its columns".into());
        }
        Ok(())
    }

    /// Writes the whole table up to the present state of `session`, which its header describes. Rows that are not in
    /// memory are read from the file at `rows`.
    pub fn write(&self, session: &Session, rows: &Path, out: &mut dyn Write) -> io::Result<()> {
        out.write_all(head(session, self.columns()).as_bytes())?;
        if self.written > 0 {
            self.copy_rows(rows, out)?;
        }
        let mut rows = self.clone();
        rows.record(session);
        out.write_all(rows.text().as_bytes())
    }
}

/// Whether a text may consist of rows, whose cells are numbers and plain words.
fn is_of_cells(text: &[u8]) -> bool {
    let plain = |byte: &u8| byte.is_ascii_alphanumeric() || b"+-.,\n".contains(byte);
    text.iter().all(plain)
}

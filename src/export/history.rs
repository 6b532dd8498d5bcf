//! `history.csv`: one row per recorded moment.
//!
//! During the run, rows go to a separate file, so that neither memory nor checkpoints grow with the number of rows. The
//! header describes the end of the run and is written then. A checkpoint holds the newest rows and the length of the
//! file. Rows that cannot be written stay in memory and in the checkpoint.

use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::header::head;
use super::safe_open;
use crate::reading::Column;
use crate::scenario::scalars::{self, Reading, Value};
use crate::scenario::session::Session;

/// Rows buffered in memory before they are written, bytes.
const CHUNK: usize = 64 << 10;

/// The rows recorded so far, as text.
#[derive(Debug, Default, Clone, Serialize, Deserialize)]
pub struct History {
    /// The newest rows, not yet in the file.
    rows: String,
    /// The length of this history's part of the file, in bytes.
    written: u64,
    last_cycle: Option<f64>,
    /// Columns after the ones that every history has.
    further: Vec<Column>,
}

impl History {
    /// Makes an empty history that records the scalars `further` in addition to the standard columns.
    ///
    /// # Errors
    ///
    /// Names, in one line, the first of them that is not a scalar or is already a column.
    pub fn with_columns(further: &[String]) -> Result<Self, String> {
        let further = further.iter().map(|name| scalars::find_scalar(name));
        let history = Self {
            further: further.collect::<Result<_, _>>()?,
            ..Self::default()
        };
        history.check_columns()?;
        Ok(history)
    }

    /// Refuses a column that stands twice.
    fn check_columns(&self) -> Result<(), String> {
        let columns: Vec<Column> = self.columns().collect();
        let mut further = columns.iter().enumerate().skip(Column::HISTORY.len());
        match further.find(|(at, column)| columns[..*at].contains(column)) {
            Some((_, column)) => Err(format!(
                "{} is a column of the history already",
                column.name()
            )),
            None => Ok(()),
        }
    }

    fn columns(&self) -> impl Iterator<Item = Column> {
        Column::HISTORY
            .into_iter()
            .chain(self.further.iter().copied())
    }

    /// The columns of the present moment of `session` with their values.
    pub fn values(&self, session: &Session) -> Vec<(Column, Value)> {
        let reading = Reading::new(session);
        let values = self.columns().map(|column| (column, reading.value(column)));
        values.collect()
    }

    fn row(&self, session: &Session) -> String {
        let values = self.values(session).into_iter();
        let fields: Vec<String> = values.map(|(_, value)| scalars::cell(&value)).collect();
        fields.join(",")
    }

    /// Whether nothing is recorded yet.
    pub fn is_empty(&self) -> bool {
        self.length() == 0
    }

    /// Returns the size of all recorded rows, in bytes.
    fn length(&self) -> u64 {
        self.written + self.rows.len() as u64
    }

    /// Drops what was recorded after `earlier` was copied from this history.
    pub fn rewind(&mut self, earlier: &Self) {
        match earlier.length().checked_sub(self.written) {
            Some(kept) => self.rows.truncate(kept as usize),
            None => {
                self.written = earlier.length();
                self.rows.clear();
            }
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
        self.rows += &(self.row(session) + "\n");
    }

    /// Whether there are enough buffered rows to [`spill`](Self::spill).
    pub fn is_full(&self) -> bool {
        self.rows.len() >= CHUNK
    }

    /// Appends the buffered rows to the file at `path`. On an error they stay in memory and the file is unchanged.
    pub fn spill(&mut self, path: &Path) -> io::Result<()> {
        let mut file = safe_open::open_or_make(path)?;
        // A killed run may have written rows beyond this length.
        file.set_len(self.written)?;
        file.seek(SeekFrom::Start(self.written))?;
        file.write_all(self.rows.as_bytes())?;
        // From now on a checkpoint may rely on these rows.
        file.sync_data()?;
        self.written += self.rows.len() as u64;
        // Frees the buffer, which may have grown large while the disk was full.
        self.rows = String::new();
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
        let commas = self.columns().count() - 1;
        let has_all = |row: &str| row.matches(',').count() == commas;
        let is_whole = self.rows.is_empty() || self.rows.ends_with('\n');
        if !(is_whole && is_of_cells(self.rows.as_bytes()) && self.rows.lines().all(has_all)) {
            return Err("the saved rows of the history are not those of its columns".into());
        }
        Ok(())
    }

    /// Writes the whole table up to the present state of `session`, which its header describes. Rows that are not in
    /// memory are read from the file at `rows`.
    pub fn write(&self, session: &Session, rows: &Path, out: &mut dyn Write) -> io::Result<()> {
        let columns: Vec<Column> = self.columns().collect();
        out.write_all(head(session, &columns).as_bytes())?;
        if self.written > 0 {
            self.copy_rows(rows, out)?;
        }
        out.write_all(self.rows.as_bytes())?;
        if self.last_cycle == Some(session.simulation().cycle()) {
            return Ok(());
        }
        writeln!(out, "{}", self.row(session))
    }
}

/// Whether a text may consist of rows, whose cells are numbers and plain words.
fn is_of_cells(text: &[u8]) -> bool {
    let plain = |byte: &u8| byte.is_ascii_alphanumeric() || b"+-.,\n".contains(byte);
    text.iter().all(plain)
}

/// The fields of a moment, in the order of the columns.
pub fn fields(reading: &Reading) -> [String; Column::HISTORY.len()] {
    Column::HISTORY.map(|column| scalars::cell(&reading.value(column)))
}

//! `history.csv`: one row per recorded moment.
//!
//! During the run, rows go to a separate file, so that neither memory nor checkpoints grow with
//! them; the header describes the end of the run and is added then. A checkpoint holds the newest
//! rows and the length of the file. Rows that cannot be written stay in memory and in the
//! checkpoint.

use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::header::head;
use super::own;
use crate::scenario::scalars::{self, Reading, Value};
use crate::scenario::session::Session;

pub use crate::scenario::scalars::HISTORY as COLUMNS;

/// Rows buffered in memory before they are written, bytes.
const CHUNK: usize = 64 << 10;

/// The rows recorded so far, as text.
#[derive(Debug, Default, Clone, Serialize, Deserialize)]
pub struct History {
    /// The newest rows, which are not in the file yet.
    rows: String,
    /// How much of the file belongs to this history, in bytes.
    written: u64,
    last_cycle: Option<f64>,
    /// Columns after the ones that every history has.
    further: Vec<String>,
}

impl History {
    /// An empty history that records the scalars of these names beside its own columns.
    ///
    /// # Errors
    ///
    /// In one line, the first name that is not a scalar, or a column already.
    pub fn with(further: &[String]) -> Result<Self, String> {
        for (at, name) in further.iter().enumerate() {
            scalars::named(name)?;
            if COLUMNS.contains(&name.as_str()) || further[..at].contains(name) {
                return Err(format!("{name} is a column of the history already"));
            }
        }
        Ok(Self {
            further: further.to_vec(),
            ..Self::default()
        })
    }

    /// The names of all columns.
    fn names(&self) -> impl Iterator<Item = &str> {
        let further = self.further.iter().map(String::as_str);
        COLUMNS.into_iter().chain(further)
    }

    /// The columns of the present moment of `session` with their values.
    pub fn values(&self, session: &Session) -> Vec<(&str, Value)> {
        let reading = Reading::new(session);
        let values = self.names().map(|name| (name, reading.value(name)));
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

    /// All that is recorded, in bytes.
    fn length(&self) -> u64 {
        self.written + self.rows.len() as u64
    }

    /// Forgets what was recorded after `earlier` was copied from it.
    pub fn rewind(&mut self, earlier: &Self) {
        let length = earlier.length();
        let kept = length.saturating_sub(self.written);
        self.rows.truncate(kept as usize);
        self.written = self.written.min(length);
        self.last_cycle = earlier.last_cycle;
    }

    /// Adds the present moment of `session`, once.
    pub fn record(&mut self, session: &Session) {
        let simulation = session.simulation();
        if self.last_cycle == Some(simulation.cycle()) {
            return;
        }
        self.last_cycle = Some(simulation.cycle());
        self.rows += &(self.row(session) + "\n");
    }

    /// Appends the buffered rows to the file at `path`, once there are enough of them. On an error they stay in memory
    /// and the file is unchanged.
    pub fn spill(&mut self, path: &Path) -> io::Result<()> {
        if self.rows.len() < CHUNK {
            return Ok(());
        }
        let mut file = own::open_or_make(path)?;
        // Anything beyond was written by a killed run.
        file.set_len(self.written)?;
        file.seek(SeekFrom::Start(self.written))?;
        file.write_all(self.rows.as_bytes())?;
        // A checkpoint that counts on them may be written at any time from now on.
        file.sync_data()?;
        self.written += self.rows.len() as u64;
        // Not only cleared: while the disk was full, it may have become large.
        self.rows = String::new();
        Ok(())
    }

    /// Copies the rows that are in the file at `from` to the one at `to`.
    ///
    /// # Errors
    ///
    /// If rows are missing; the history then begins with the rows in memory.
    pub fn move_rows(&mut self, from: &Path, to: &Path) -> io::Result<()> {
        if self.written == 0 {
            return Ok(());
        }
        let whole = self.copied(from, to);
        whole.inspect_err(|_| self.written = 0)
    }

    fn copied(&self, from: &Path, to: &Path) -> io::Result<()> {
        let rows = own::read(from)?;
        if rows.metadata()?.len() < self.written {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        if from != to {
            let mut copy = own::open_or_make(to)?;
            copy.set_len(0)?;
            io::copy(&mut rows.take(self.written), &mut copy)?;
            copy.sync_data()?;
        }
        Ok(())
    }

    /// Writes the whole table up to the present state of `session`, of which its header tells; the
    /// rows that are not in memory are read from the file at `rows`.
    pub fn write(&self, session: &Session, rows: &Path, out: &mut dyn Write) -> io::Result<()> {
        let names: Vec<&str> = self.names().collect();
        out.write_all(head(session, &names).as_bytes())?;
        if self.written > 0 {
            let file = own::read(rows)?;
            let copied = io::copy(&mut file.take(self.written), out)?;
            if copied < self.written {
                return Err(io::ErrorKind::UnexpectedEof.into());
            }
        }
        out.write_all(self.rows.as_bytes())?;
        if self.last_cycle == Some(session.simulation().cycle()) {
            return Ok(());
        }
        writeln!(out, "{}", self.row(session))
    }
}

/// The fields of a moment, in the order of the columns.
pub fn fields(reading: &Reading) -> [String; COLUMNS.len()] {
    COLUMNS.map(|name| scalars::cell(&reading.value(name)))
}

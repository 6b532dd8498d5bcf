//! `history.csv`: one row per recorded moment.
//!
//! During the run, rows go to a separate file, so that neither memory nor checkpoints grow with
//! them; the header describes the end of the run and is added then. A checkpoint holds the newest
//! rows and the length of the file. Rows that cannot be written stay in memory and in the
//! checkpoint.

use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::header::head;
use super::safe_open;
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
    /// How much of the file belongs to this history, in bytes, and the CRC-32 of that.
    written: u64,
    checksum: u32,
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
        match earlier.length().checked_sub(self.written) {
            Some(kept) => self.rows.truncate(kept as usize),
            None => {
                self.checksum = earlier.checksum_with_rows();
                self.written = earlier.length();
                self.rows.clear();
            }
        }
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

    /// Appends the buffered rows to the file at a path, which is asked for once there are enough of them. On an error they
    /// stay in memory and the file is unchanged.
    pub fn spill(&mut self, path: impl FnOnce() -> PathBuf) -> io::Result<()> {
        if self.rows.len() < CHUNK {
            return Ok(());
        }
        let mut file = safe_open::open_or_make(&path())?;
        // Anything beyond was written by a killed run.
        file.set_len(self.written)?;
        file.seek(SeekFrom::Start(self.written))?;
        file.write_all(self.rows.as_bytes())?;
        // A checkpoint that counts on them may be written at any time from now on.
        file.sync_data()?;
        self.checksum = self.checksum_with_rows();
        self.written += self.rows.len() as u64;
        // Not only cleared: while the disk was full, it may have become large.
        self.rows = String::new();
        Ok(())
    }

    /// The checksum of the file once the buffered rows are in it.
    fn checksum_with_rows(&self) -> u32 {
        let mut sum = crc32fast::Hasher::new_with_initial_len(self.checksum, self.written);
        sum.update(self.rows.as_bytes());
        sum.finalize()
    }

    /// Whether rows are in a file, not in memory.
    pub fn has_file(&self) -> bool {
        self.written > 0
    }

    /// Forgets the rows in the file: the history then begins with those in memory.
    pub fn forget_file(&mut self) {
        (self.written, self.checksum) = (0, 0);
    }

    /// Copies the rows of this history that are in the file at `from`.
    ///
    /// # Errors
    ///
    /// If the system refuses, and of the kind `InvalidData` if the file holds others.
    pub fn copy_rows(&self, from: &Path, to: &mut dyn Write) -> io::Result<()> {
        let mut rows = safe_open::read(from)?.take(self.written);
        let mut sum = crc32fast::Hasher::new();
        let mut chunk = vec![0; CHUNK];
        loop {
            let length = rows.read(&mut chunk)?;
            let read = &chunk[..length];
            if length == 0 {
                let is_whole = rows.limit() == 0 && sum.finalize() == self.checksum;
                return if is_whole { Ok(()) } else { Err(foreign()) };
            }
            if !is_of_cells(read) {
                return Err(foreign());
            }
            sum.update(read);
            to.write_all(read)?;
        }
    }

    /// Checks what a checkpoint holds as if it were computed here.
    ///
    /// # Errors
    ///
    /// In one line, what no history holds.
    pub fn check(&self) -> Result<(), String> {
        Self::with(&self.further)?;
        let commas = self.names().count() - 1;
        let has_all = |row: &str| row.matches(',').count() == commas;
        let is_whole = self.rows.is_empty() || self.rows.ends_with('\n');
        if !(is_whole && is_of_cells(self.rows.as_bytes()) && self.rows.lines().all(has_all)) {
            return Err("the saved rows of the history are not those of its columns".into());
        }
        Ok(())
    }

    /// Writes the whole table up to the present state of `session`, of which its header tells; the
    /// rows that are not in memory are read from the file at `rows`.
    pub fn write(&self, session: &Session, rows: &Path, out: &mut dyn Write) -> io::Result<()> {
        let names: Vec<&str> = self.names().collect();
        out.write_all(head(session, &names).as_bytes())?;
        if self.has_file() {
            self.copy_rows(rows, out)?;
        }
        out.write_all(self.rows.as_bytes())?;
        if self.last_cycle == Some(session.simulation().cycle()) {
            return Ok(());
        }
        writeln!(out, "{}", self.row(session))
    }
}

/// Whether a text could be of rows: cells are numbers and plain words.
fn is_of_cells(text: &[u8]) -> bool {
    let plain = |byte: &u8| byte.is_ascii_alphanumeric() || b"+-.,\n".contains(byte);
    text.iter().all(plain)
}

/// What is wrong with a file of other rows.
fn foreign() -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, "holds rows of another run")
}

/// The fields of a moment, in the order of the columns.
pub fn fields(reading: &Reading) -> [String; COLUMNS.len()] {
    COLUMNS.map(|name| scalars::cell(&reading.value(name)))
}

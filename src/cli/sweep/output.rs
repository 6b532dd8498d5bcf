//! The output file: rows are appended as they finish, and sorted at the end.

use std::fs::{self, File};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use anyhow::Result;

use super::super::Misuse;
use super::super::args::Sweep;
use crate::export::file::{WriteError, write_whole};
use crate::export::own;
use crate::export::target::Target;
use crate::studies::sweep::record::{self, Record, Rows};
use crate::studies::sweep::{Shard, Study};

/// How often rows are flushed to disk. A killed process loses none, since the system has them
/// already; a crash of the machine loses at most this much.
const FLUSH_INTERVAL: Duration = Duration::from_secs(5);

/// The rows of a study, in memory and in a file.
pub struct Output {
    path: PathBuf,
    target: Target,
    head: String,
    rows: Rows,
    /// The file while rows are added; locked, so that no other process adds to it.
    file: Option<File>,
    /// Its length up to the last whole row.
    length: u64,
    flushed: Instant,
}

impl Output {
    /// Checks that the file can be created or continued; nothing is written yet.
    pub fn open(path: &Path, study: &Study, shard: Shard, options: &Sweep) -> Result<Self> {
        let mut output = Self {
            path: path.to_owned(),
            target: Target::hold_in_new_directory(path)?,
            head: record::head(study, shard),
            rows: Rows::new(study),
            file: None,
            length: 0,
            flushed: Instant::now(),
        };
        let refuse = |why: &str| Err(Misuse(format!("{}: {why}", path.display())).into());
        if output.target.is_stdout() {
            return refuse("rows are sorted at the end, in a file; --json prints them");
        }
        if !output.target.exists() || options.force {
            return Ok(output);
        }
        if !options.resume {
            return refuse(
                "already exists; --resume continues it, --force starts over, --out names another \
                 file",
            );
        }
        let text = match fs::read_to_string(path) {
            Ok(text) => text,
            Err(error) => return refuse(&format!("cannot be read: {error}")),
        };
        let name = path.display().to_string();
        let record = Record::parse(&text, &name)?;
        record.expect(study, "the study now")?;
        if record.shard != shard {
            let (theirs, ours) = (record.shard, shard);
            return refuse(&format!("holds shard {theirs}, not {ours}"));
        }
        for row in record.rows {
            let begins = row.join(",");
            if let Err(why) = output.rows.take(row) {
                return refuse(&format!(
                    "row {begins} does not belong to the study ({why:?})"
                ));
            }
        }
        if options.failed {
            output.rows.forget_failed();
        }
        Ok(output)
    }

    /// Those of `points` that have no row.
    pub fn missing(&self, points: &[usize]) -> Vec<usize> {
        let without = |point: &&usize| self.row(**point).is_none();
        points.iter().filter(without).copied().collect()
    }

    /// Writes the existing rows, so that new ones can be appended.
    pub fn begin(&mut self) -> Result<()> {
        let text = self.rows.text(&self.head);
        write_whole(&self.path, text.as_bytes())?;
        self.length = text.len() as u64;
        let mut file = own::open(&self.path, false).map_err(|cause| self.failed(cause))?;
        let end = file.seek(SeekFrom::End(0));
        end.map_err(|cause| self.failed(cause))?;
        self.file = Some(file);
        Ok(())
    }

    /// Adds the row of a point. On an error the file ends with the last whole row.
    pub fn add(&mut self, point: usize, fields: Vec<String>) -> Result<(), WriteError> {
        let line = record::line(&fields);
        self.rows.put(point, fields);
        let Some(file) = &mut self.file else {
            return Ok(());
        };
        let written = file.write_all(line.as_bytes()).and_then(|()| {
            if self.flushed.elapsed() < FLUSH_INTERVAL {
                return Ok(());
            }
            self.flushed = Instant::now();
            file.sync_data()
        });
        match written {
            Ok(()) => {
                self.length += line.len() as u64;
                Ok(())
            }
            Err(cause) => {
                // Removes the partial row. If that fails, a reader drops it.
                let _ = file.set_len(self.length);
                self.file = None;
                Err(self.failed(cause))
            }
        }
    }

    /// Writes the rows in the order of the points. A file that rows could not be added to is left
    /// as it is: it is whole.
    pub fn close(&mut self) -> Result<(), WriteError> {
        if self.file.is_none() {
            return Ok(());
        }
        let written = write_whole(&self.path, self.rows.text(&self.head).as_bytes());
        self.file = None;
        written
    }

    /// The row of a point.
    pub fn row(&self, point: usize) -> Option<&Vec<String>> {
        self.rows.rows[point].as_ref()
    }

    /// The number of rows, and how many of them failed.
    pub fn count(&self) -> (usize, usize) {
        self.rows.count()
    }

    fn failed(&self, cause: io::Error) -> WriteError {
        WriteError::Io {
            path: self.path.clone(),
            cause,
        }
    }
}

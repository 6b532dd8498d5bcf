//! The output file: rows are appended as they finish, and sorted at the end. Its size is no matter of
//! memory.

use std::env;
use std::io::{self, Write};
use std::path::Path;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, anyhow};

use super::super::args::Sweep;
use crate::export::file::{WriteError, write_with};
use crate::export::target::Target;
use crate::export::{header, own};
use crate::scenario::Refusal;
use crate::studies::sweep::ledger::{Counts, Done, Ledger};
use crate::studies::sweep::record::{self, Arithmetic, Record};
use crate::studies::sweep::{Shard, Study, Success};

/// How often rows are flushed to disk. A killed process loses none, since the system has them
/// already; a crash of the machine loses at most this much.
const FLUSH_INTERVAL: Duration = Duration::from_secs(5);

/// The rows of a study in a file, which no other process writes.
pub struct Output<'a> {
    target: Target,
    study: &'a Study,
    shard: Shard,
    arithmetic: Arithmetic,
    /// The table that is continued.
    earlier: Option<Record>,
    without_failed: bool,
    ledger: Option<Ledger>,
    /// Whether rows could be added up to now.
    is_whole: bool,
    flushed: Instant,
}

impl<'a> Output<'a> {
    /// Checks that the file can be made or continued; nothing is written yet.
    pub fn open(path: &Path, study: &'a Study, shard: Shard, options: &Sweep) -> Result<Self> {
        let mut output = Self {
            target: Target::hold_in_new_directory(path)?,
            study,
            shard,
            arithmetic: [header::arithmetic().to_owned()].into(),
            earlier: None,
            without_failed: options.failed,
            ledger: None,
            is_whole: true,
            flushed: Instant::now(),
        };
        let refuse = |why: &str| Err(Refusal::new(path.display(), why).into());
        if !output.target.exists() || options.force {
            return Ok(output);
        }
        if !options.resume {
            return refuse(
                "already exists; --resume continues it, --force starts over, --out names another \
                 file",
            );
        }
        let file = match own::read(path) {
            Ok(file) => file,
            Err(error) => return refuse(&format!("cannot be read: {error}")),
        };
        let record = Record::open(file, &path.display().to_string())?;
        record.expect(study, "the study now")?;
        if record.shard != shard {
            let (theirs, ours) = (record.shard, shard);
            return refuse(&format!("holds shard {theirs}, not {ours}"));
        }
        output.arithmetic.extend(record.arithmetic.iter().cloned());
        output.earlier = Some(record);
        Ok(output)
    }

    /// Writes the rows that are there already, so that new ones can be appended. What was there before
    /// stays until they are.
    pub fn begin(&mut self) -> Result<()> {
        let (study, path) = (self.study, self.target.path());
        let directory = self.target.directory();
        let mut rows = match self.earlier.take() {
            Some(record) => Some(record.rows(study)?),
            None => None,
        };
        if self.target.is_stdout() {
            // Sorted, they come out at the end.
            let directory = env::temp_dir();
            let ledger = Ledger::unnamed(study, &directory);
            let ledger = ledger.with_context(|| directory.display().to_string())?;
            self.ledger = Some(ledger);
            return Ok(());
        }
        let head = self.head();
        let mut ledger = None;
        let mut refused = None;
        write_with(path, |file| {
            file.write_all(head.as_bytes())?;
            let mut new = Ledger::new(study, file.try_clone()?, directory)?;
            for row in rows.iter_mut().flatten() {
                let row = match row {
                    Ok(row) => row,
                    Err(error) => {
                        refused = Some(anyhow!(error));
                        return Err(io::ErrorKind::InvalidData.into());
                    }
                };
                if self.without_failed && !Success::of_row(&row).has_result() {
                    continue;
                }
                let begins = row.join(",");
                if let Err(why) = new.take(study, row)? {
                    let why = format!("row {begins} does not belong to the study ({why:?})");
                    refused = Some(Refusal::new(path.display(), why).into());
                    return Err(io::ErrorKind::InvalidData.into());
                }
            }
            ledger = Some(new);
            Ok(())
        })
        .map_err(|error| refused.take().unwrap_or_else(|| error.into()))?;
        self.ledger = ledger;
        Ok(())
    }

    /// Whether the rows go to the standard output.
    pub fn is_stdout(&self) -> bool {
        self.target.is_stdout()
    }

    fn head(&self) -> String {
        record::head(self.study, self.shard, &self.arithmetic)
    }

    /// The points that have rows.
    pub fn done(&self) -> Option<Done> {
        self.ledger.as_ref().map(|ledger| ledger.done().clone())
    }

    /// Adds the row of a point. On an error the file ends with the last whole row.
    pub fn add(&mut self, point: usize, fields: &[String]) -> Result<(), WriteError> {
        let Some(ledger) = &mut self.ledger else {
            return Ok(());
        };
        let is_due = self.flushed.elapsed() >= FLUSH_INTERVAL;
        let written = ledger.add(point, fields).and_then(|()| match is_due {
            true => ledger.sync(),
            false => Ok(()),
        });
        if is_due {
            self.flushed = Instant::now();
        }
        written.map_err(|cause| {
            self.is_whole = false;
            self.failed(cause)
        })
    }

    /// Writes the rows in the order of the points. A file that rows could not be added to is left
    /// as it is: it is whole.
    pub fn close(&mut self) -> Result<(), WriteError> {
        let Some(ledger) = self.ledger.as_ref().filter(|_| self.is_whole) else {
            return Ok(());
        };
        let head = self.head();
        self.target.write_with(|out| {
            out.write_all(head.as_bytes())?;
            ledger.each(|line| out.write_all(line))
        })
    }

    /// The row of a point, if it has one.
    pub fn row(&self, point: usize) -> io::Result<Option<Vec<String>>> {
        match self
            .ledger
            .as_ref()
            .filter(|ledger| ledger.done().has(point))
        {
            Some(ledger) => ledger.row(point).map(Some),
            None => Ok(None),
        }
    }

    /// The rows, counted.
    pub fn counts(&self) -> Counts {
        self.ledger.as_ref().map(Ledger::counts).unwrap_or_default()
    }

    fn failed(&self, cause: io::Error) -> WriteError {
        WriteError::Io {
            path: self.target.path().to_owned(),
            cause,
        }
    }
}

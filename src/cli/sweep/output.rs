//! The output file: rows are appended as they finish, and sorted at the end. Memory use does not grow with its size.

use std::env;
use std::io::Write;
use std::path::Path;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, bail, ensure};

use crate::cli::args::Sweep;
use crate::export::file::{WriteError, write_with};
use crate::export::target::Target;
use crate::export::{header, safe_open};
use crate::scenario::Refusal;
use crate::scenario::bounded_read::Unread;
use crate::studies::sweep::ledger::Ledger;
use crate::studies::sweep::record::{self, Arithmetic, Record};
use crate::studies::sweep::{Shard, Study, Success};

/// Interval for flushing rows to disk. A killed process loses none, since the system already has them; a crash of the
/// machine loses at most this much.
const FLUSH_INTERVAL: Duration = Duration::from_secs(5);

/// The rows of a study in a file.
pub struct Output {
    /// The file.
    pub target: Target,
    head: String,
    /// The rows.
    pub ledger: Ledger,
    /// Whether all rows could be written so far.
    is_whole: bool,
    flushed: Instant,
}

impl Output {
    /// Creates the file, or continues it, and claims it. An existing file is replaced only when its rows have been
    /// copied, so that new ones can be appended.
    pub fn open(path: &Path, study: &Study, shard: Shard, options: &Sweep) -> Result<Self> {
        let target = Target::claim_in_new_directory(path)?;
        let mut arithmetic: Arithmetic = [header::arithmetic().to_owned()].into();
        let mut rows = None;
        if target.exists() && !options.force {
            let refuse = |why: String| Refusal::new(path.display(), why);
            let rule = "already exists; --resume continues it, --force starts over, --out names another file";
            ensure!(options.resume, refuse(rule.into()));
            let file = safe_open::read(path);
            let unread = |error| Refusal::unread(path.display(), &Unread::Io(error));
            let file = file.map_err(unread)?;
            let record = Record::open(file, &path.display().to_string())?;
            record.expect(study, "the study now")?;
            let rule = format!("holds shard {}, not {shard}", record.shard);
            ensure!(record.shard == shard, refuse(rule));
            arithmetic.extend(record.arithmetic.iter().cloned());
            rows = Some(record.rows(study)?);
        }
        let head = record::head(study, shard, &arithmetic);
        let ledger = if target.is_stdout() {
            // For stdout, rows are collected in a temporary file and printed in order at the end.
            let directory = env::temp_dir();
            let rows = tempfile::tempfile_in(&directory);
            let ledger = rows.and_then(|rows| Ledger::new(study, rows, &directory));
            ledger.with_context(|| directory.display().to_string())?
        } else {
            write_with(path, |file| -> Result<Ledger> {
                let failed = WriteError::io(path);
                file.write_all(head.as_bytes()).map_err(failed)?;
                let file = file.try_clone().map_err(failed)?;
                let mut ledger = Ledger::new(study, file, target.directory()).map_err(failed)?;
                for row in rows.into_iter().flatten() {
                    let row = row?;
                    if options.failed && !Success::from_row(&row).has_result() {
                        continue;
                    }
                    let begins = row.join(",");
                    if let Err(why) = ledger.add_foreign(study, row).map_err(failed)? {
                        let why = format!("row {begins} does not belong to the study ({why:?})");
                        bail!(Refusal::new(path.display(), why));
                    }
                }
                Ok(ledger)
            })?
        };
        Ok(Self {
            target,
            head,
            ledger,
            is_whole: true,
            flushed: Instant::now(),
        })
    }

    /// Adds the row of a point. On an error the file ends with the last complete row.
    pub fn add(&mut self, point: usize, fields: &[String]) -> Result<(), WriteError> {
        let mut written = self.ledger.add(point, fields);
        if self.flushed.elapsed() >= FLUSH_INTERVAL {
            written = written.and_then(|()| self.ledger.sync());
            self.flushed = Instant::now();
        }
        self.is_whole &= written.is_ok();
        written.map_err(WriteError::io(self.target.path()))
    }

    /// Writes the rows in the order of the points. After a failed [`add`](Self::add) the file stays unsorted, but every
    /// row in it is complete.
    pub fn close(&self) -> Result<(), WriteError> {
        if !self.is_whole {
            return Ok(());
        }
        self.target.write_with(|out| {
            out.write_all(self.head.as_bytes())?;
            self.ledger.each(|line| out.write_all(line))
        })
    }
}

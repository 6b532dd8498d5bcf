//! The output file: rows are appended as they finish, and sorted at the end.

use std::fs::File;
use std::io::Write;
use std::path::Path;
use std::time::{Duration, Instant};

use anyhow::{Result, ensure};

use crate::cli::args::Sweep;
use crate::export::file::{WriteError, write_with};
use crate::export::header;
use crate::export::target::Target;
use crate::scenario::Refusal;
use crate::studies::sweep::record::{self, Arithmetic, StudyFile};
use crate::studies::sweep::{Results, Row, Shard, Study};

/// Interval for flushing rows to disk. A killed process loses none, since the system already has them; a crash of the
/// machine loses at most this much.
const FLUSH_INTERVAL: Duration = Duration::from_secs(5);

/// The rows of a study, in memory and in a file.
pub struct StudyTable {
    /// The file.
    pub target: Target,
    /// The rows.
    pub results: Results,
    head: String,
    /// Where rows are appended, and its length up to the last complete row; `None` for stdout, which gets its rows at the
    /// end.
    file: Option<(File, u64)>,
    /// Whether all rows could be written so far.
    is_whole: bool,
    flushed: Instant,
}

impl StudyTable {
    /// Creates the file, or continues it, and claims it.
    pub fn open(path: &Path, study: Study, shard: Shard, options: &Sweep) -> Result<Self> {
        let target = Target::claim_in_new_directory(path)?;
        let mut arithmetic: Arithmetic = [header::arithmetic().to_owned()].into();
        let mut results = Results::new(study);
        if target.exists() && !options.force {
            let refuse = |why: String| Refusal::new(path.display(), why);
            let rule = "already exists; --resume continues it, --force starts over, --out names another file";
            ensure!(options.resume, refuse(rule.into()));
            let record = StudyFile::of_file(path)?;
            record.expect(&results.study, "the study now")?;
            let rule = format!("holds shard {}, not {shard}", record.shard);
            ensure!(record.shard == shard, refuse(rule));
            arithmetic.extend(record.arithmetic.iter().cloned());
            let (there, doubles) = Results::read(results.study, shard, &[record])?;
            if let Some(double) = doubles.differing.first() {
                let rule = format!("has two rows that differ: {double}");
                return Err(refuse(rule).into());
            }
            results = there;
            if options.failed {
                results.drop_failed();
            }
        }
        let head = record::head(&results.study, shard, &arithmetic);
        let mut file = None;
        if !target.is_stdout() {
            let rows = results.rows().map(|row| results.line(row));
            let text = rows.fold(head.clone(), |text, line| text + &line);
            file = Some(write_with(path, |file| -> Result<_, WriteError> {
                let failed = WriteError::io(path);
                file.write_all(text.as_bytes()).map_err(failed)?;
                Ok((file.try_clone().map_err(failed)?, text.len() as u64))
            })?);
        }
        Ok(Self {
            target,
            results,
            head,
            file,
            is_whole: true,
            flushed: Instant::now(),
        })
    }

    /// Adds the row of a point. On an error the file ends with the last complete row.
    pub fn add(&mut self, row: Row) -> Result<(), WriteError> {
        let line = self.results.line(&row);
        self.results.add(row);
        let Some((file, length)) = &mut self.file else {
            return Ok(());
        };
        let mut written = file.write_all(line.as_bytes());
        if written.is_ok() {
            *length += line.len() as u64;
        } else {
            let _ = file.set_len(*length);
        }
        if self.flushed.elapsed() >= FLUSH_INTERVAL {
            written = written.and_then(|()| file.sync_data());
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
        write(&self.target, &self.head, &self.results)
    }
}

/// Writes a whole table.
pub fn write(target: &Target, head: &str, results: &Results) -> Result<(), WriteError> {
    target.write_with(|out| {
        out.write_all(head.as_bytes())?;
        let mut rows = results.rows();
        rows.try_for_each(|row| out.write_all(results.line(row).as_bytes()))
    })
}

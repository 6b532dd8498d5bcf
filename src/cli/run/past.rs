//! The files that an interrupted run has written so far. They are recognised by checksum, so that files that another
//! run has put in their place are never mistaken for them.

use std::io::{self, Read};
use std::path::{Path, PathBuf};

use anyhow::Result;

use super::file_of;
use crate::cli::job::{RunJob, rows_sum};
use crate::cli::{complain, provenance};
use crate::export::file::write_whole_with;
use crate::export::run_directory::{RUN_ROWS, RunDirectory};
use crate::export::safe_open;
use crate::scenario::Refusal;
use crate::scenario::bounded_read::Unread;

/// The files of a run that its checkpoint relies on.
pub(super) struct Past {
    /// Their directory.
    home: PathBuf,
    /// Files unchanged since the run wrote them.
    own: Vec<String>,
    missing: Vec<String>,
    /// Files that something else has written.
    foreign: Vec<String>,
    /// Whether this run was the last one to complete its files in the directory.
    is_last: bool,
}

impl Past {
    /// Looks for the files of `job` in the directory `home`.
    ///
    /// # Errors
    ///
    /// If one of them cannot be read.
    pub(super) fn find(job: &RunJob, home: Option<&Path>) -> Result<Self, Refusal> {
        let home = home.unwrap_or(Path::new(".")).to_owned();
        let mut past = Self {
            is_last: provenance::run_of(&home).as_ref() == Some(&job.id),
            home,
            own: Vec::new(),
            missing: Vec::new(),
            foreign: Vec::new(),
        };
        for (snapshot, sum) in job.taken() {
            let name = file_of(snapshot);
            // The explorer does not write these snapshots, so a file of this name is something else.
            if sum.is_some() {
                let found = checksum_of(&past.home.join(&name)).map(|found| Some(found) == sum);
                past.sort(name, found)?;
            }
        }
        if job.history.has_file() {
            let rows = past.home.join(RUN_ROWS);
            let found = job.history.copy_rows(&rows, &mut io::sink());
            past.sort(RUN_ROWS.into(), found.map(|()| true))?;
        }
        Ok(past)
    }

    fn sort(&mut self, name: String, is_own: io::Result<bool>) -> Result<(), Refusal> {
        use io::ErrorKind::{InvalidData, NotFound, Other};
        let list = match is_own {
            Ok(true) => &mut self.own,
            Err(error) if error.kind() == NotFound => &mut self.missing,
            Ok(false) => &mut self.foreign,
            Err(error) if [InvalidData, Other].contains(&error.kind()) => &mut self.foreign,
            Err(error) => {
                let path = self.home.join(name);
                return Err(Refusal::unread(path.display(), &Unread::Io(error)));
            }
        };
        list.push(name);
        Ok(())
    }

    /// Whether the run wrote the file of this name.
    pub(super) fn is_own(&self, name: &str) -> bool {
        self.is_last || self.own.iter().any(|own| own == name)
    }

    /// Refuses to continue without files that something else has replaced, unless `force` is set.
    ///
    /// # Errors
    ///
    /// If there is such a file.
    pub(super) fn refuse_foreign(&self, force: bool) -> Result<(), Refusal> {
        let Some(name) = self.foreign.first().filter(|_| !force) else {
            return Ok(());
        };
        let path = self.home.join(name);
        let rule = "is not what this run has written: something else has used its directory since; --force continues \
                    without it";
        Err(Refusal::new(path.display(), rule))
    }

    /// Copies the files into `directory` unless they are already there, and reports what is lost.
    ///
    /// # Errors
    ///
    /// If a file cannot be copied.
    pub(super) fn copy_into(
        &self,
        job: &mut RunJob,
        directory: &RunDirectory,
        is_there: bool,
    ) -> Result<()> {
        for name in self.own.iter().filter(|_| !is_there) {
            let from = self.home.join(name);
            let to = directory.path().join(name);
            write_whole_with(&to, |out| match name.as_str() {
                RUN_ROWS => job.history.copy_rows(&from, out),
                _ => io::copy(&mut safe_open::read(&from)?, out).map(drop),
            })?;
        }
        for name in self.missing.iter().chain(&self.foreign) {
            if name == RUN_ROWS {
                job.history.forget_file();
            }
            let path = self.home.join(name);
            let what = match name.as_str() {
                RUN_ROWS => "the history so far no longer exists",
                _ => "no longer exists",
            };
            complain(&format!("{}: {what}", path.display()));
        }
        Ok(())
    }
}

/// Returns the checksum of the rows in a file.
fn checksum_of(path: &Path) -> io::Result<u32> {
    let mut table = Vec::new();
    safe_open::read(path)?.read_to_end(&mut table)?;
    Ok(rows_sum(&table))
}

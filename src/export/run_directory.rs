//! The directory of one run: claiming it, the files kept there until the run ends, and cleaning it up.

use std::ffi::OsString;
use std::fs;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use super::claim::Claim;
use super::file::{
    INTERNAL, IRREGULAR, WriteError, before_dash, refuse_dash, shell_path, sweep, write_whole_with,
};
use super::header::number;
use super::safe_open;
use crate::scenario::Refusal;
use crate::scenario::bounded_read::Unread;
use crate::scenario::checkpoint::Stamp;

/// The name of the checkpoint in the directory of an unfinished run.
pub const RUN_CHECKPOINT: &str = "run.checkpoint";

/// The name of the file with the history's rows, until the run ends.
pub const RUN_ROWS: &str = ".mdr-tui-history";

/// The directory of one run's files. No other process can claim it until the last copy of this is dropped.
#[derive(Debug, Clone)]
pub struct RunDirectory {
    path: PathBuf,
    claim: Arc<Claim>,
}

impl RunDirectory {
    /// Claims `path` for a run. Creates the directory if necessary, and refuses one that contains anything unless
    /// `force` is set. A directory that a living process writes into is always refused.
    pub fn claim(path: &Path, force: bool) -> Result<Self, WriteError> {
        let failed = WriteError::io(path);
        refuse_dash(path)?;
        if path.is_file() {
            return Err(WriteError::refused(path, "is not a directory"));
        }
        let is_new = !path.exists();
        fs::create_dir_all(path).map_err(failed)?;
        let run = Self::claim_at(path, is_new)?;
        if !force {
            run.refuse_results()?;
        }
        Ok(run)
    }

    /// Refuses a directory that contains anything.
    fn refuse_results(&self) -> Result<(), WriteError> {
        let is_empty = self.results()?.is_empty();
        let checkpoint = self.checkpoint();
        if checkpoint.symlink_metadata().is_ok() {
            let checkpoint = shell_path(&checkpoint);
            let rule = "holds an interrupted run; resume with: mdr-tui run --resume";
            let rule = format!("{rule} {checkpoint} (--force starts over)");
            return Err(WriteError::refused(&self.path, rule));
        }
        let rule = "not empty; choose another directory or add --force";
        if is_empty {
            Ok(())
        } else {
            Err(WriteError::refused(&self.path, rule))
        }
    }

    /// Returns the names of all files except the program's internal ones.
    fn results(&self) -> Result<Vec<OsString>, WriteError> {
        let failed = |cause| Refusal::unread(self.path.display(), &Unread::Io(cause));
        let entries = fs::read_dir(&self.path).map_err(failed)?;
        let names = entries.map(|entry| entry.map(|entry| entry.file_name()));
        let names: Vec<OsString> = names.collect::<Result<_, _>>().map_err(failed)?;
        let is_result = |name: &OsString| !name.to_string_lossy().starts_with(INTERNAL);
        Ok(names.into_iter().filter(is_result).collect())
    }

    /// Reclaims the directory of the run `stamp`, to continue there. `is_own` tells whether that run wrote the file of
    /// a given name.
    ///
    /// # Errors
    ///
    /// Unless `force` is set: if another run has used the directory since, or this run got further there.
    pub fn return_to(
        path: &Path,
        stamp: &Stamp,
        is_own: impl Fn(&str) -> bool,
        force: bool,
    ) -> Result<Self, WriteError> {
        let run = Self::reopen(path)?;
        if force {
            return Ok(run);
        }
        let checkpoint = run.checkpoint();
        if checkpoint.symlink_metadata().is_err() {
            let is_own = |name: OsString| name.to_str().is_some_and(&is_own);
            return if run.results()?.into_iter().all(is_own) {
                Ok(run)
            } else {
                run.refuse_results().map(|()| run)
            };
        }
        let (resume, hint) = (
            shell_path(&checkpoint),
            "choose another directory with --out",
        );
        match Stamp::read(&checkpoint) {
            Some(there) if there.run == stamp.run && there.cycle <= stamp.cycle => Ok(run),
            Some(there) if there.run == stamp.run => {
                let rule = format!(
                    "the run has come further there, to cycle {}; resume with: mdr-tui run --resume {resume}, or {hint} \
                     (--force goes back)",
                    number(there.cycle)
                );
                Err(WriteError::refused(path, rule))
            }
            _ => {
                let rule = "another run has used it since and is interrupted there";
                let rule = format!("{rule} ({resume}); {hint} (--force gives it up)");
                Err(WriteError::refused(path, rule))
            }
        }
    }

    /// Claims a new directory in the working directory: `stem`, or else `stem-2`, `stem-3`, …
    pub fn claim_new(stem: &str) -> Result<Self, WriteError> {
        let place = |name: &str| before_dash(Path::new(name)).into_owned();
        let mut path = place(stem);
        let mut number = 1;
        while let Err(cause) = fs::create_dir(&path) {
            if cause.kind() != io::ErrorKind::AlreadyExists {
                return Err(WriteError::io(&path)(cause));
            }
            number += 1;
            path = place(&format!("{stem}-{number}"));
        }
        let run = Self::claim_at(&path, true)?;
        run.refuse_results().map(|()| run)
    }

    /// Claims the directory of an interrupted run again and removes what a killed process left there. Checks now,
    /// rather than after an hour of computing, that files can be created there.
    pub fn reopen(path: &Path) -> Result<Self, WriteError> {
        Self::claim_at(path, false)
    }

    fn claim_at(path: &Path, is_new: bool) -> Result<Self, WriteError> {
        let path = path.to_owned();
        let mut claim = Claim::of_directory(&path)?;
        claim.is_new = is_new;
        let claim = Arc::new(claim);
        let rows = path.join(RUN_ROWS);
        if rows.symlink_metadata().is_ok_and(|about| !about.is_file()) {
            return Err(WriteError::refused(&rows, IRREGULAR));
        }
        sweep(&path, INTERNAL, Duration::ZERO);
        Ok(Self { path, claim })
    }

    /// Removes the files of an earlier run, which would be mistaken for this run's, except those that `is_own` accepts.
    /// Files that this program did not write stay.
    pub fn clear(&self, is_own: impl Fn(&str) -> bool) -> Result<(), WriteError> {
        for name in self.results()? {
            let path = self.path.join(&name);
            if is_of_a_run(&path) && !name.to_str().is_some_and(&is_own) {
                remove(&path)?;
            }
        }
        if !is_own(RUN_ROWS) {
            remove(&self.rows())?;
        }
        remove(&self.checkpoint())
    }

    /// Returns the path of the run's checkpoint.
    pub fn checkpoint(&self) -> PathBuf {
        self.path.join(RUN_CHECKPOINT)
    }

    /// Returns the path of the history's rows.
    pub fn rows(&self) -> PathBuf {
        self.path.join(RUN_ROWS)
    }

    /// Removes the checkpoint and the separate rows of a finished run.
    pub fn close(&self) -> Result<(), WriteError> {
        self.check()?;
        remove(&self.checkpoint())?;
        remove(&self.rows())
    }

    /// Checks that the directory is still this run's. Another run may have begun in its place.
    ///
    /// # Errors
    ///
    /// If it was moved or removed since it was claimed.
    pub fn check(&self) -> Result<(), WriteError> {
        self.claim.check()
    }

    /// Writes one of the run's files, whole.
    pub fn write(&self, name: &str, contents: impl AsRef<[u8]>) -> Result<(), WriteError> {
        self.write_with(name, |out| out.write_all(contents.as_ref()))
    }

    /// [`write`](Self::write) with what `fill` writes, which need not be in memory at once.
    pub fn write_with(
        &self,
        name: &str,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), WriteError> {
        self.check()?;
        write_whole_with(&self.path.join(name), fill)
    }

    /// Returns the path of the directory.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

/// Files of a run that begin with its header; snapshots, whose names hold the cycle, are recognised separately.
const TABLES: [&str; 5] = [
    "history.csv",
    "state.csv",
    "loop.csv",
    "field.csv",
    "provenance.toml",
];

/// Whether a run wrote this table, judging by its name and its header.
fn is_of_a_run(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let cycle = name.strip_prefix("state-");
    let cycle = cycle.and_then(|rest| rest.strip_suffix(".csv"));
    let is_snapshot = cycle.is_some_and(|cycle| cycle.parse::<f64>().is_ok());
    if !is_snapshot && !TABLES.contains(&&*name) {
        return false;
    }
    let mut start = [0; MARK.len()];
    let read = safe_open::read(path).and_then(|mut file| file.read_exact(&mut start));
    read.is_ok() && start == *MARK
}

/// The first bytes of this program's tables.
const MARK: &[u8; 11] = b"# mdr-tui: ";

/// Removes a file if it exists.
fn remove(path: &Path) -> Result<(), WriteError> {
    match fs::remove_file(path) {
        Err(cause) if cause.kind() != io::ErrorKind::NotFound => Err(WriteError::io(path)(cause)),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_claimed_directory_is_new_empty_or_forced() {
        let base = tempfile::tempdir().expect("a directory");
        let path = base.path().join("deep/run");
        let run = RunDirectory::claim(&path, false).expect("a new directory");
        // Not even `force` overrides the claim of a living run.
        for force in [false, true] {
            let refusal = RunDirectory::claim(&path, force).expect_err("a claimed directory");
            let word = "another run is writing there (process ";
            assert!(
                refusal.is_misuse() && refusal.to_string().contains(word),
                "{refusal}"
            );
        }
        drop(run);
        // Dropping the claim removes the directory if it is empty, unless it existed before.
        assert!(!path.exists());
        fs::create_dir(&path).expect("a directory");
        drop(RunDirectory::claim(&path, false).expect("an empty directory"));
        assert_eq!(fs::read_dir(&path).expect("the directory").count(), 0);
        let run = RunDirectory::claim(&path, false).expect("an empty directory");
        run.write("state.csv", b"r_m\n0\n").expect("a file");
        drop(run);
        let refusal = RunDirectory::claim(&path, false).expect_err("an occupied directory");
        assert!(refusal.to_string().ends_with("add --force"), "{refusal}");
        RunDirectory::claim(&path, true).expect("a forced directory");
        let refusal = RunDirectory::claim(&path.join("state.csv"), true).expect_err("a file");
        assert!(
            refusal.to_string().ends_with("is not a directory"),
            "{refusal}"
        );
    }
}

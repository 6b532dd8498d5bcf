//! The directory of one run: what it claims, holds until the run is at its end, and clears.

use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::claim::Claim;
use super::file::{INTERNAL, IRREGULAR, WriteError, shell_word, sweep, write_whole};
use super::own;

/// The name of the checkpoint in the directory of a run that is not at its end.
pub const RUN_CHECKPOINT: &str = "run.checkpoint";

/// The name of the file with the rows of the history, until the run is at its end.
const RUN_ROWS: &str = ".mdr-tui-history";

/// The directory of one run's files. No other process claims it before this is dropped.
#[derive(Debug)]
pub struct RunDirectory {
    path: PathBuf,
    claim: Claim,
}

impl RunDirectory {
    /// Takes `path` for the files of a run: makes it where there is none, and refuses one that holds
    /// anything already unless `force` is set. A directory that a living process writes into is
    /// refused in any case.
    pub fn claim(path: &Path, force: bool) -> Result<Self, WriteError> {
        let failed = WriteError::io(path);
        if path.is_file() {
            return Err(WriteError::refused(path, "is not a directory"));
        }
        let is_new = !path.exists();
        fs::create_dir_all(path).map_err(failed)?;
        let mut run = Self::reopen(path)?;
        run.claim.is_new = is_new;
        let entries = fs::read_dir(path).map_err(failed)?;
        let name = |entry: fs::DirEntry| entry.file_name().to_string_lossy().into_owned();
        let names = entries.flatten().map(name);
        let mut others = names.filter(|name| !name.starts_with(INTERNAL));
        if force {
            return Ok(run);
        }
        if run.checkpoint().exists() {
            let checkpoint = shell_word(&run.checkpoint());
            let rule = "holds an interrupted run; resume with: mdr-tui run --resume";
            let rule = format!("{rule} {checkpoint} (--force starts over)");
            return Err(WriteError::refused(path, rule));
        }
        if others.next().is_some() {
            let rule = "not empty; choose another directory or add --force";
            return Err(WriteError::refused(path, rule));
        }
        Ok(run)
    }

    /// Takes a directory that is not there yet: `stem`, or `stem-2`, `stem-3`, … in the working
    /// directory.
    pub fn claim_new(stem: &str) -> Result<Self, WriteError> {
        let mut path = PathBuf::from(stem);
        let mut number = 1;
        while let Err(cause) = fs::create_dir(&path) {
            if cause.kind() != io::ErrorKind::AlreadyExists {
                return Err(WriteError::io(&path)(cause));
            }
            number += 1;
            path = PathBuf::from(format!("{stem}-{number}"));
        }
        let mut run = Self::claim(&path, false)?;
        run.claim.is_new = true;
        Ok(run)
    }

    /// Continues in the directory of an interrupted run and removes leftovers of a kill. Checks
    /// now, not after an hour of computing, that files can be created there.
    pub fn reopen(path: &Path) -> Result<Self, WriteError> {
        let path = path.to_owned();
        let claim = Claim::of_directory(&path)?;
        let rows = rows_in(&path);
        if rows.symlink_metadata().is_ok_and(|about| !about.is_file()) {
            return Err(WriteError::refused(&rows, IRREGULAR));
        }
        sweep(&path, INTERNAL, Duration::ZERO);
        Ok(Self { path, claim })
    }

    /// Removes the files of an earlier run, which would be taken for files of this one; what this
    /// program has not written stays.
    pub fn clear(&self) -> Result<(), WriteError> {
        let failed = WriteError::io(&self.path);
        for entry in fs::read_dir(&self.path).map_err(failed)? {
            let path = entry.map_err(failed)?.path();
            if is_of_a_run(&path) {
                remove(&path)?;
            }
        }
        self.close()
    }

    /// Where the checkpoint of the run is until it is at its end.
    pub fn checkpoint(&self) -> PathBuf {
        self.path.join(RUN_CHECKPOINT)
    }

    /// Where the rows of the history are until the run is at its end.
    pub fn rows(&self) -> PathBuf {
        rows_in(&self.path)
    }

    /// Removes the checkpoint of a finished run.
    pub fn close(&self) -> Result<(), WriteError> {
        remove(&self.checkpoint())?;
        remove(&self.rows())
    }

    /// Writes one of the run's files, whole.
    pub fn write(&self, name: &str, contents: impl AsRef<[u8]>) -> Result<(), WriteError> {
        write_whole(&self.path.join(name), contents.as_ref())
    }

    /// Where the files stand.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

/// The files of a run that begin as its tables do, except those of snapshots.
const TABLES: [&str; 5] = [
    "history.csv",
    "state.csv",
    "loop.csv",
    "field.csv",
    "provenance.toml",
];

/// Whether a run has written this table: it has the name and the header of one.
fn is_of_a_run(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let cycle = name.strip_prefix("state-");
    let cycle = cycle.and_then(|rest| rest.strip_suffix(".csv"));
    let is_snapshot = cycle.is_some_and(|cycle| cycle.parse::<f64>().is_ok());
    if !is_snapshot && !TABLES.contains(&&*name) {
        return false;
    }
    let mut start = [0; MARK.len()];
    let read = own::read(path).and_then(|mut file| file.read_exact(&mut start));
    read.is_ok() && start == *MARK
}

/// How tables of this program begin.
const MARK: &[u8; 11] = b"# mdr-tui: ";

/// Where the rows of the history are of a run that was interrupted in `directory`.
pub fn rows_in(directory: &Path) -> PathBuf {
    directory.join(RUN_ROWS)
}

/// Removes a file, if it is there.
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
        // Not even by force, while the run is alive.
        for force in [false, true] {
            let refusal = RunDirectory::claim(&path, force).expect_err("a claimed directory");
            let word = "another run is writing there (process ";
            assert!(
                refusal.is_misuse() && refusal.to_string().contains(word),
                "{refusal}"
            );
        }
        drop(run);
        // Removes the directory if nothing was written into it, unless it existed before.
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

//! The folder of one run. It is complete in itself, so it may be moved, and an interrupted run is resumed where it lies.
//!
//! Besides the results it holds `run.checkpoint` and the rows of the history until the run ends, `provenance.toml`, which
//! names the run and its files, and the lock file of the process that writes there.

use std::fs;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use super::claim::Claim;
use super::file::{
    INTERNAL, IRREGULAR, WriteError, before_dash, refuse_dash, shell_path, sweep, write_whole_with,
};
use super::provenance::{self, Provenance};
use super::safe_open;
use crate::scenario::Refusal;
use crate::scenario::bounded_read::Unread;

/// The name of the checkpoint in the folder of an unfinished run.
pub const RUN_CHECKPOINT: &str = "run.checkpoint";

/// The name of the file with the history's rows, until the run ends.
pub const RUN_ROWS: &str = ".mdr-tui-history";

/// The first bytes of this program's tables, and of the file on their provenance.
const MARK: &[u8; 11] = b"# mdr-tui: ";

/// The folder of one run. No other process can claim it until the last copy of this is dropped.
#[derive(Debug, Clone)]
pub struct RunFolder {
    path: PathBuf,
    claim: Arc<Claim>,
}

impl RunFolder {
    /// Claims `path` for a new run. Creates the folder if necessary, and refuses one that contains anything unless
    /// `force` is set.
    ///
    /// # Errors
    ///
    /// If there is something else, or a living process writes there, or no file can be created there.
    pub fn create(path: &Path, force: bool) -> Result<Self, WriteError> {
        refuse_dash(path)?;
        if path.is_file() {
            return Err(WriteError::refused(path, "is not a directory"));
        }
        let is_new = !path.exists();
        fs::create_dir_all(path).map_err(WriteError::io(path))?;
        let folder = Self::claim(path, is_new)?;
        if !force {
            folder.refuse_results()?;
            // Rows without a checkpoint are nobody's.
            remove(&folder.rows())?;
        }
        Ok(folder)
    }

    /// Claims a new folder in the working directory: `stem`, or else `stem-2`, `stem-3`, …
    ///
    /// # Errors
    ///
    /// If it cannot be created.
    pub fn create_named(stem: &str) -> Result<Self, WriteError> {
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
        let folder = Self::claim(&path, true)?;
        folder.refuse_results().map(|()| folder)
    }

    /// Claims the folder of an interrupted run again. Checks now, rather than after an hour of computing, that files can
    /// be created there.
    ///
    /// # Errors
    ///
    /// As [`create`](Self::create).
    pub fn open(path: &Path) -> Result<Self, WriteError> {
        Self::claim(path, false)
    }

    /// Claims the folder, and removes the temporary files that a killed process has left there.
    fn claim(path: &Path, is_new: bool) -> Result<Self, WriteError> {
        let claim = Arc::new(Claim::new(path, is_new)?);
        let path = path.to_owned();
        let folder = Self { path, claim };
        let rows = folder.rows();
        if rows.symlink_metadata().is_ok_and(|about| !about.is_file()) {
            return Err(WriteError::refused(&rows, IRREGULAR));
        }
        sweep(&folder.path, INTERNAL, Duration::ZERO);
        Ok(folder)
    }

    /// Refuses a folder that contains anything but the program's internal files.
    ///
    /// # Errors
    ///
    /// If it does, or cannot be read.
    pub fn refuse_results(&self) -> Result<(), WriteError> {
        let failed = |cause| Refusal::unread(self.path.display(), &Unread::Io(cause));
        let checkpoint = self.checkpoint();
        if checkpoint.symlink_metadata().is_ok() {
            let checkpoint = shell_path(&checkpoint);
            let rule = "holds an interrupted run; resume with: mdr-tui run --resume";
            let rule = format!("{rule} {checkpoint} (--force starts over)");
            return Err(WriteError::refused(&self.path, rule));
        }
        for entry in fs::read_dir(&self.path).map_err(failed)? {
            let name = entry.map_err(failed)?.file_name();
            if !name.to_string_lossy().starts_with(INTERNAL) {
                let rule = "not empty; choose another directory or add --force";
                return Err(WriteError::refused(&self.path, rule));
            }
        }
        Ok(())
    }

    /// Returns the identity of the run whose folder is at `path`, if that is known.
    pub fn run_in(path: &Path) -> Option<String> {
        Provenance::read(path).map(|of| of.run)
    }

    /// Removes the files that the earlier run has written, which would be mistaken for this run's. Files of the same
    /// names that this program did not write stay.
    ///
    /// # Errors
    ///
    /// If one of them cannot be removed.
    pub fn clear(&self) -> Result<(), WriteError> {
        let earlier = Provenance::read(&self.path);
        for name in earlier.into_iter().flat_map(|earlier| earlier.files) {
            let path = self.path.join(name);
            let mut start = [0; MARK.len()];
            let read = safe_open::read(&path).and_then(|mut file| file.read_exact(&mut start));
            if path.parent() == Some(&self.path) && read.is_ok() && start == *MARK {
                remove(&path)?;
            }
        }
        self.close()
    }

    /// Writes down which run this is and which files it will write. On a full disk the run goes on without.
    pub fn begin(&self, about: &Provenance) {
        let _ = self.write(provenance::FILE, about.text());
    }

    /// Copies files of the run from its folder at `home`, as far as they are there.
    ///
    /// # Errors
    ///
    /// If one cannot be read or written.
    pub fn copy_from(
        &self,
        home: &Path,
        names: impl IntoIterator<Item = String>,
    ) -> Result<(), WriteError> {
        for name in names {
            let from = home.join(&name);
            match safe_open::read(&from) {
                Err(error) if error.kind() == io::ErrorKind::NotFound => {}
                file => {
                    let mut file = file.map_err(WriteError::io(&from))?;
                    self.write_with(&name, |out| io::copy(&mut file, out).map(drop))?;
                }
            }
        }
        Ok(())
    }

    /// Returns the path of the folder.
    pub fn path(&self) -> &Path {
        &self.path
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
    ///
    /// # Errors
    ///
    /// If that fails, or the folder is no longer this run's.
    pub fn close(&self) -> Result<(), WriteError> {
        self.check()?;
        remove(&self.checkpoint())?;
        remove(&self.rows())
    }

    /// Checks that the folder is still this run's. Another run may have begun in its place.
    ///
    /// # Errors
    ///
    /// If it was moved or removed since it was claimed.
    pub fn check(&self) -> Result<(), WriteError> {
        self.claim.check()
    }

    /// Writes one of the run's files, whole.
    ///
    /// # Errors
    ///
    /// If the system refuses, or the folder is no longer this run's.
    pub fn write(&self, name: &str, contents: impl AsRef<[u8]>) -> Result<(), WriteError> {
        self.write_with(name, |out| out.write_all(contents.as_ref()))
    }

    /// [`write`](Self::write) with what `fill` writes, which need not be in memory at once.
    ///
    /// # Errors
    ///
    /// As [`write`](Self::write).
    pub fn write_with(
        &self,
        name: &str,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), WriteError> {
        self.check()?;
        write_whole_with(&self.path.join(name), fill)
    }
}

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
        let run = RunFolder::create(&path, false).expect("a new directory");
        // Not even `force` overrides the claim of a living run.
        for force in [false, true] {
            let refusal = RunFolder::create(&path, force).expect_err("a claimed directory");
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
        drop(RunFolder::create(&path, false).expect("an empty directory"));
        assert_eq!(fs::read_dir(&path).expect("the directory").count(), 0);
        let run = RunFolder::create(&path, false).expect("an empty directory");
        run.write("state.csv", b"r_m\n0\n").expect("a file");
        drop(run);
        let refusal = RunFolder::create(&path, false).expect_err("an occupied directory");
        assert!(refusal.to_string().ends_with("add --force"), "{refusal}");
        RunFolder::create(&path, true).expect("a forced directory");
        let refusal = RunFolder::create(&path.join("state.csv"), true).expect_err("a file");
        assert!(
            refusal.to_string().ends_with("is not a directory"),
            "{refusal}"
        );
    }
}

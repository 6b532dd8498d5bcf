//! An output file of a command: claimed before anything is computed, and written as a whole at the end.
//!
//! While it is claimed, no other process writes the same file. Only regular files are ever replaced. `/dev/stdout` is
//! written directly.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::claim::Claim;
use super::file::{
    IRREGULAR, WriteError, directory_of, refuse_dash, sweep, temporary_of, write_whole_with,
};

/// The path that stands for standard output.
const STDOUT: &str = "/dev/stdout";

/// A file that belongs to this process until this is dropped.
#[derive(Debug)]
pub struct Target {
    path: PathBuf,
    /// `None` for standard output.
    claim: Option<Claim>,
}

impl Target {
    /// Claims `path` for a new file or, with `force`, to replace an existing regular file.
    ///
    /// # Errors
    ///
    /// If the file exists (without `force`), is not a regular file, or is being written by another process.
    pub fn claim(path: &Path, force: bool) -> Result<Self, WriteError> {
        let target = Self::claim_existing(path)?;
        target.refuse_existing(force)?;
        Ok(target)
    }

    /// Like [`claim`](Self::claim), for an optional path.
    ///
    /// # Errors
    ///
    /// As [`claim`](Self::claim).
    pub fn claim_given(path: Option<&Path>, force: bool) -> Result<Option<Self>, WriteError> {
        path.map(|path| Self::claim(path, force)).transpose()
    }

    /// Claims `path`, whether the file exists or not.
    ///
    /// # Errors
    ///
    /// If it is not a regular file, or another process is writing it.
    pub fn claim_existing(path: &Path) -> Result<Self, WriteError> {
        Self::claim_in(false, path)
    }

    /// Like [`claim_existing`](Self::claim_existing), but creates the directory if necessary. It is removed again if
    /// nothing is written into it.
    ///
    /// # Errors
    ///
    /// As [`claim_existing`](Self::claim_existing), and if the directory cannot be created.
    pub fn claim_in_new_directory(path: &Path) -> Result<Self, WriteError> {
        let directory = directory_of(path);
        let is_new = !directory.exists();
        fs::create_dir_all(directory).map_err(WriteError::io(directory))?;
        Self::claim_in(is_new, path)
    }

    fn claim_in(is_new: bool, path: &Path) -> Result<Self, WriteError> {
        let refused = |rule| Err(WriteError::refused(path, rule));
        let mut claim = None;
        if path != Path::new(STDOUT) {
            refuse_dash(path)?;
            if path.file_name().is_none() || path.is_dir() {
                return refused("is not a file name");
            }
            if path.symlink_metadata().is_ok_and(|about| !about.is_file()) {
                return refused(IRREGULAR);
            }
            if !directory_of(path).is_dir() {
                return refused("its directory does not exist");
            }
            claim = Some(Claim::new(path, is_new)?);
            sweep(directory_of(path), &temporary_of(path), Duration::ZERO);
        }
        let path = path.to_owned();
        Ok(Self { path, claim })
    }

    /// Refuses an existing file unless `force` is set.
    ///
    /// # Errors
    ///
    /// If the file exists.
    pub fn refuse_existing(&self, force: bool) -> Result<(), WriteError> {
        let rule = "already exists; choose another name or add --force";
        if self.exists() && !force {
            Err(WriteError::refused(&self.path, rule))
        } else {
            Ok(())
        }
    }

    /// Whether the file already exists.
    pub fn exists(&self) -> bool {
        !self.is_stdout() && self.path.symlink_metadata().is_ok()
    }

    /// Whether the result goes to standard output.
    pub fn is_stdout(&self) -> bool {
        self.claim.is_none()
    }

    /// Returns the directory of the file.
    pub fn directory(&self) -> &Path {
        directory_of(&self.path)
    }

    /// Returns the path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the file as a whole.
    ///
    /// # Errors
    ///
    /// If the system refuses, or the directory has been replaced; the old file then stays.
    pub fn write(&self, contents: &[u8]) -> Result<(), WriteError> {
        self.write_with(|out| out.write_all(contents))
    }

    /// Like [`write`](Self::write), but `fill` writes the contents, which need not be in memory at once.
    ///
    /// # Errors
    ///
    /// As [`write`](Self::write).
    pub fn write_with(
        &self,
        fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), WriteError> {
        if let Some(claim) = &self.claim {
            claim.check()?;
            return write_whole_with(&self.path, fill);
        }
        let mut out = io::stdout().lock();
        let written = fill(&mut out).and_then(|()| out.flush());
        written.map_err(WriteError::io(&self.path))
    }
}

/// Writes several files that belong together. If one cannot be written, the new ones written before it are removed.
///
/// # Errors
///
/// The error of the first file that cannot be written.
pub fn write_all(files: &[(&Target, Vec<u8>)]) -> Result<(), WriteError> {
    let mut made: Vec<&Path> = Vec::new();
    for (target, contents) in files {
        let is_new = !target.is_stdout() && !target.exists();
        if let Err(error) = target.write(contents) {
            for path in made {
                let _ = fs::remove_file(path);
            }
            return Err(error);
        }
        if is_new {
            made.push(target.path());
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_has_one_maker_at_a_time() {
        let base = tempfile::tempdir().expect("a directory");
        let path = base.path().join("map.csv");
        let first = Target::claim(&path, false).expect("a claim");
        for force in [false, true] {
            let refused = Target::claim(&path, force).expect_err("it is taken");
            let word = "another mdr-tui is writing this file (process ";
            assert!(refused.to_string().contains(word), "{refused}");
        }
        first.write(b"one").expect("a file");
        drop(first);
        let refused = Target::claim(&path, false).expect_err("it is there");
        assert!(refused.to_string().contains("already exists"), "{refused}");
        let second = Target::claim(&path, true).expect("a claim");
        second.write(b"two").expect("a file");
        drop(second);
        assert_eq!(fs::read_dir(base.path()).expect("it").count(), 1);
    }

    #[test]
    fn nothing_but_a_regular_file_is_replaced() {
        let base = tempfile::tempdir().expect("a directory");
        let (mine, link) = (base.path().join("mine"), base.path().join("link"));
        fs::write(&mine, "mine").expect("a file");
        let dangling = base.path().join("dangling");
        std::os::unix::fs::symlink(&mine, &link).expect("a link");
        std::os::unix::fs::symlink("nowhere", &dangling).expect("a link");
        for path in [&link, &dangling, Path::new("/dev/null")] {
            let refused = Target::claim(path, true).expect_err("no regular file");
            assert!(refused.to_string().ends_with(IRREGULAR), "{refused}");
        }
        let refused = Target::claim(base.path(), true).expect_err("a directory");
        assert!(
            refused.to_string().ends_with("is not a file name"),
            "{refused}"
        );
        assert_eq!(fs::read_dir(base.path()).expect("it").count(), 3);
    }

    #[test]
    fn what_a_killed_maker_left_unfinished_goes_and_another_file_s_stays() {
        let base = tempfile::tempdir().expect("a directory");
        let left = |name: &str| {
            let path = super::super::file::temporary_of(&base.path().join(name));
            let path = base.path().join(path + "x.tmp");
            fs::write(&path, "half").expect("a file");
            path
        };
        let (ours, other) = (left("map.csv"), left("other.csv"));
        drop(Target::claim(&base.path().join("map.csv"), false).expect("a claim"));
        assert!(!ours.exists() && other.exists());
    }
}

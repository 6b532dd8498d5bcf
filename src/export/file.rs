//! Whole files or none: everything is written beside its place and renamed into it.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use thiserror::Error;

/// A file or directory that could not be written; nothing half-written is left behind.
#[derive(Debug, Error)]
pub enum WriteError {
    /// The directory of another run.
    #[error("{}: already holds files; choose another directory or add --force", .0.display())]
    Occupied(PathBuf),
    /// The directory of a run that was interrupted.
    #[error(
        "{}: holds a run that was interrupted; mdr-tui run --resume {} goes on with it, --force \
         starts anew",
        .0.parent().unwrap_or(.0).display(),
        shell_word(.0)
    )]
    Interrupted(PathBuf),
    /// The path of a directory is taken by something else.
    #[error("{}: is not a directory", .0.display())]
    NotADirectory(PathBuf),
    /// The system refused.
    #[error("{}: cannot write: {cause}", path.display())]
    Io {
        /// What was to be written.
        path: PathBuf,
        /// Why not; the message says it, so it is no further link of the chain.
        cause: io::Error,
    },
}

impl WriteError {
    /// Whether another choice of directory by the user would have avoided it.
    pub fn is_misuse(&self) -> bool {
        !matches!(self, Self::Io { cause, .. } if cause.kind() == io::ErrorKind::StorageFull)
    }
}

/// A path as a shell reads it back.
pub fn shell_word(path: &Path) -> String {
    let text = path.display().to_string();
    let plain = |c: char| c.is_alphanumeric() || "/._-+,:@%".contains(c);
    if text.chars().all(plain) {
        text
    } else {
        format!("'{}'", text.replace('\'', "'\\''"))
    }
}

/// Writes `contents` to `path`: to a temporary file in the same directory, flushed to the disk and
/// renamed over `path`, so that a reader sees the old file or the new one and never a torn one.
pub fn write_whole(path: &Path, contents: &[u8]) -> Result<(), WriteError> {
    let failed = |cause| WriteError::Io {
        path: path.to_owned(),
        cause,
    };
    let directory = path
        .parent()
        .filter(|parent| !parent.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(TEMPORARY).suffix(".tmp");
    #[cfg(unix)]
    {
        // Results are ordinary files, not secrets: what the umask leaves of 0666.
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(directory).map_err(failed)?;
    file.write_all(contents).map_err(failed)?;
    file.as_file().sync_all().map_err(failed)?;
    file.persist(path).map_err(|error| failed(error.error))?;
    Ok(())
}

/// What the name of a file that is not yet whole begins with.
const TEMPORARY: &str = ".mdr-tui-";

fn is_temporary(path: &Path) -> bool {
    let name = path.file_name().map(|name| name.to_string_lossy());
    name.is_some_and(|name| name.starts_with(TEMPORARY))
}

/// Removes temporary files of at least this age, which processes that were killed have left behind.
pub fn sweep(directory: &Path, age: Duration) {
    let Ok(entries) = fs::read_dir(directory) else {
        return;
    };
    for path in entries.flatten().map(|entry| entry.path()) {
        let written = fs::metadata(&path).and_then(|about| about.modified()).ok();
        let old = written.is_some_and(|at| at.elapsed().is_ok_and(|past| past >= age));
        if is_temporary(&path) && (old || age.is_zero()) {
            // One that cannot be removed is in nobody's way.
            let _ = fs::remove_file(path);
        }
    }
}

/// The name of the checkpoint in the directory of a run that is not at its end.
pub const RUN_CHECKPOINT: &str = "run.checkpoint";

/// The directory of one run's files.
#[derive(Debug)]
pub struct RunDirectory {
    path: PathBuf,
}

impl RunDirectory {
    /// Takes `path` for the files of a run: makes it where there is none, and refuses one that holds
    /// anything already unless `force` is set.
    pub fn claim(path: &Path, force: bool) -> Result<Self, WriteError> {
        let failed = |cause| WriteError::Io {
            path: path.to_owned(),
            cause,
        };
        match fs::read_dir(path) {
            Ok(entries) => {
                let checkpoint = path.join(RUN_CHECKPOINT);
                let mut others = entries
                    .flatten()
                    .filter(|entry| !is_temporary(&entry.path()));
                if force {
                    // It would outlive the results that it belongs to.
                    remove(&checkpoint)?;
                } else if checkpoint.exists() {
                    return Err(WriteError::Interrupted(checkpoint));
                } else if others.next().is_some() {
                    return Err(WriteError::Occupied(path.to_owned()));
                }
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                fs::create_dir_all(path).map_err(failed)?;
            }
            Err(_) if path.is_file() => return Err(WriteError::NotADirectory(path.to_owned())),
            Err(error) => return Err(failed(error)),
        }
        Self::reopen(path)
    }

    /// Goes on in the directory of a run that was interrupted; what a kill has left there goes.
    pub fn reopen(path: &Path) -> Result<Self, WriteError> {
        sweep(path, Duration::ZERO);
        Self::try_out(path)
    }

    /// Finds out now, not after an hour of computing, whether files can be made here.
    fn try_out(path: &Path) -> Result<Self, WriteError> {
        tempfile::Builder::new()
            .prefix(TEMPORARY)
            .tempfile_in(path)
            .map_err(|cause| WriteError::Io {
                path: path.to_owned(),
                cause,
            })?;
        Ok(Self {
            path: path.to_owned(),
        })
    }

    /// Where the checkpoint of the run is until it is at its end.
    pub fn checkpoint(&self) -> PathBuf {
        self.path.join(RUN_CHECKPOINT)
    }

    /// The run is at its end: its checkpoint goes.
    pub fn close(&self) -> Result<(), WriteError> {
        remove(&self.checkpoint())
    }

    /// Writes one of the run's files, whole.
    pub fn write(&self, name: &str, contents: &[u8]) -> Result<PathBuf, WriteError> {
        let path = self.path.join(name);
        write_whole(&path, contents)?;
        Ok(path)
    }

    /// Where the files stand.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

/// Removes a file, if it is there.
fn remove(path: &Path) -> Result<(), WriteError> {
    match fs::remove_file(path) {
        Err(cause) if cause.kind() != io::ErrorKind::NotFound => Err(WriteError::Io {
            path: path.to_owned(),
            cause,
        }),
        _ => Ok(()),
    }
}

/// A directory name that is free: `stem`, or `stem-2`, `stem-3`, … in the working directory.
pub fn free_directory(stem: &str) -> PathBuf {
    let plain = PathBuf::from(stem);
    if !plain.exists() {
        return plain;
    }
    (2..)
        .map(|n| PathBuf::from(format!("{stem}-{n}")))
        .find(|path| !path.exists())
        .unwrap_or(plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_claimed_directory_is_new_empty_or_forced() {
        let base = tempfile::tempdir().expect("a directory");
        let path = base.path().join("deep/run");
        let run = RunDirectory::claim(&path, false).expect("a new directory");
        assert_eq!(fs::read_dir(&path).expect("the directory").count(), 0);
        RunDirectory::claim(&path, false).expect("an empty directory");
        run.write("state.csv", b"r_m\n0\n").expect("a file");
        let refusal = RunDirectory::claim(&path, false).expect_err("an occupied directory");
        assert!(refusal.to_string().ends_with("add --force"), "{refusal}");
        RunDirectory::claim(&path, true).expect("a forced directory");
        let file = path.join("state.csv");
        assert!(matches!(
            RunDirectory::claim(&file, true),
            Err(WriteError::NotADirectory(_))
        ));
    }

    #[test]
    fn a_file_is_replaced_whole_and_leaves_no_trace_of_its_making() {
        let base = tempfile::tempdir().expect("a directory");
        let path = base.path().join("x.csv");
        write_whole(&path, b"old").expect("a file");
        write_whole(&path, b"new").expect("a file");
        assert_eq!(fs::read(&path).expect("the file"), b"new");
        assert_eq!(fs::read_dir(base.path()).expect("the directory").count(), 1);
        assert!(write_whole(&base.path().join("no/such/place.csv"), b"").is_err());
    }

    #[test]
    fn a_shell_reads_the_word_back() {
        for (path, word) in [
            ("/a/b-1.checkpoint", "/a/b-1.checkpoint"),
            ("/a b", "'/a b'"),
            ("it's", "'it'\\''s'"),
            ("$(x)", "'$(x)'"),
        ] {
            assert_eq!(shell_word(Path::new(path)), word);
        }
        let interrupted = WriteError::Interrupted("a b/run.checkpoint".into());
        let hint = "mdr-tui run --resume 'a b/run.checkpoint' goes on";
        assert!(interrupted.to_string().contains(hint));
    }
}

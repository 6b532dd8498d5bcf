//! Writes whole files or none: into a temporary file, renamed into place.

use std::fmt::Display;
use std::fs;
use std::io::{self, Read, Write};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::time::Duration;

use thiserror::Error;

use super::claim::Claim;
use super::own;
use crate::scenario::{Refusal, printable};

/// A file or directory that could not be written; nothing half-written is left behind.
#[derive(Debug, Error)]
pub enum WriteError {
    /// Something is there already, or another process writes it.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// The system refused.
    #[error("{}: cannot write: {cause}", path.display())]
    Io {
        /// The path to be written.
        path: PathBuf,
        /// The cause; part of the message, so not a source of the error.
        cause: io::Error,
    },
}

impl WriteError {
    /// Refuses what is at `path`.
    pub(super) fn refused(path: &Path, rule: impl Display) -> Self {
        Refusal::new(path.display(), rule).into()
    }

    /// What becomes of an error of the system at `path`.
    pub fn io(path: &Path) -> impl Fn(io::Error) -> Self + Copy {
        move |cause| Self::Io {
            path: path.to_owned(),
            cause,
        }
    }

    /// Whether another choice of directory by the user would have avoided it.
    pub fn is_misuse(&self) -> bool {
        !matches!(self, Self::Io { cause, .. } if cause.kind() == io::ErrorKind::StorageFull)
    }
}

/// What is said of a link, a device or a pipe, which would be replaced by a file.
pub(super) const IRREGULAR: &str =
    "is not a regular file (but a link, a device or a pipe); choose another name";

/// A path as a shell reads it back.
pub fn shell_word(path: &Path) -> String {
    let plain = |c: char| c.is_alphanumeric() || "/._-+,:@%".contains(c);
    match path.to_str() {
        Some(text) if text.chars().all(plain) => text.to_owned(),
        Some(text) if printable(text) == text => format!("'{}'", text.replace('\'', "'\\''")),
        _ => {
            // Bytes that would break the line, or that a terminal would act on.
            let bytes = path.as_os_str().as_encoded_bytes().iter();
            let escaped = bytes.map(|&byte| match byte {
                b'\'' | b'\\' => format!("\\{}", char::from(byte)),
                b' '..=b'~' => char::from(byte).to_string(),
                _ => format!("\\x{byte:02x}"),
            });
            format!("$'{}'", escaped.collect::<String>())
        }
    }
}

/// Writes `contents` to `path`: to a temporary file in the same directory, flushed to the disk and
/// renamed over `path`, so that a reader sees the old file or the new one and never a torn one.
pub fn write_whole(path: &Path, contents: &[u8]) -> Result<(), WriteError> {
    write_with(path, |file| {
        file.write_all(contents).map_err(WriteError::io(path))
    })
}

/// [`write_whole`] with what `fill` writes, which need not be in memory at once.
pub fn write_with<T, E: From<WriteError>>(
    path: &Path,
    fill: impl FnOnce(&mut fs::File) -> Result<T, E>,
) -> Result<T, E> {
    let failed = WriteError::io(path);
    let prefix = temporary_of(path);
    let mut builder = tempfile::Builder::new();
    // Results are ordinary files, not secrets: what the umask leaves of 0666.
    let permissions = fs::Permissions::from_mode(0o666);
    builder
        .prefix(&prefix)
        .suffix(TEMPORARY)
        .permissions(permissions);
    let mut file = builder.tempfile_in(directory_of(path)).map_err(failed)?;
    let filled = fill(file.as_file_mut())?;
    file.as_file().sync_all().map_err(failed)?;
    let persisted = file.persist(path);
    persisted.map_err(|error| failed(error.error))?;
    Ok(filled)
}

/// The directory of a file.
pub fn directory_of(path: &Path) -> &Path {
    let parent = path.parent();
    let parent = parent.filter(|parent| !parent.as_os_str().is_empty());
    parent.unwrap_or(Path::new("."))
}

/// How the names of unfinished files for `path` begin.
pub(super) fn temporary_of(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default();
    let name = crc32fast::hash(name.as_encoded_bytes());
    format!("{INTERNAL}{name:08x}-")
}

/// Prefix of files that are not results: unfinished files and locks.
pub(super) const INTERNAL: &str = ".mdr-tui-";

/// Suffix of unfinished files.
const TEMPORARY: &str = ".tmp";

/// Removes the temporary files of a directory that begin with `prefix` and are at least of this age: processes that
/// were killed have left them behind. One that cannot be removed does no harm.
pub(super) fn sweep(directory: &Path, prefix: &str, age: Duration) {
    for entry in fs::read_dir(directory).into_iter().flatten().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let written = entry.metadata().and_then(|about| about.modified()).ok();
        let past = written.and_then(|at| at.elapsed().ok()).unwrap_or_default();
        if name.starts_with(prefix) && name.ends_with(TEMPORARY) && past >= age {
            let _ = fs::remove_file(entry.path());
        }
    }
}

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

    /// Writes one of the run's files, whole, with what `fill` writes.
    pub fn write_with(
        &self,
        name: &str,
        fill: impl FnOnce(&mut fs::File) -> io::Result<()>,
    ) -> Result<(), WriteError> {
        let path = self.path.join(name);
        write_with(&path, |file| fill(file).map_err(WriteError::io(&path)))
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
            ("a\nb's \u{a0}\u{1b}", "$'a\\x0ab\\'s \\xc2\\xa0\\x1b'"),
        ] {
            assert_eq!(shell_word(Path::new(path)), word);
        }
    }
}

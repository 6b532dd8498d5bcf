//! Writes whole files or none: first into a temporary file, which is then renamed.

use std::borrow::Cow;
use std::ffi::OsStr;
use std::fmt::Display;
use std::fs;
use std::io::{self, Write};
use std::os::unix::fs::OpenOptionsExt;
use std::path::{Path, PathBuf};
use std::time::Duration;

use thiserror::Error;

use crate::scenario::bounded_read::is_avoidable;
use crate::scenario::{Refusal, printable};

/// A file or directory that could not be written; no half-written file is left behind.
#[derive(Debug, Error)]
pub enum WriteError {
    /// Something already exists there, or another process is writing it.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// The system reported an error.
    #[error("{}: cannot write: {cause}", path.display())]
    Io {
        /// The path that was to be written.
        path: PathBuf,
        /// The cause. It is part of the message and therefore not a source of the error.
        cause: io::Error,
    },
}

impl WriteError {
    /// Refuses to write at `path`.
    pub(super) fn refused(path: &Path, rule: impl Display) -> Self {
        Refusal::new(path.display(), rule).into()
    }

    /// Turns the system's error at `path` into this error.
    pub fn io(path: &Path) -> impl Fn(io::Error) -> Self + Copy {
        move |cause| Self::Io {
            path: path.to_owned(),
            cause,
        }
    }

    /// Whether the user could have avoided the error by choosing another place.
    pub fn is_misuse(&self) -> bool {
        match self {
            Self::Refused(refusal) => !refusal.is_failure(),
            Self::Io { cause, .. } => is_avoidable(cause),
        }
    }
}

/// Message for a link, a device or a pipe, which a new file would replace.
pub(super) const IRREGULAR: &str =
    "is not a regular file (but a link, a device or a pipe); choose another name";

/// Quotes a path for a shell, and so that no command takes it for an option.
pub fn shell_path(path: &Path) -> String {
    shell_word(before_dash(path).as_os_str())
}

/// Prepends `./` to a relative path that begins with a dash; leaves other paths unchanged.
pub fn before_dash(path: &Path) -> Cow<'_, Path> {
    if path.as_os_str().as_encoded_bytes().starts_with(b"-") {
        return Path::new(".").join(path).into();
    }
    path.into()
}

/// Refuses `-`, which usually stands for standard output.
pub(super) fn refuse_dash(path: &Path) -> Result<(), WriteError> {
    let rule =
        "is not a name for files; /dev/stdout is the standard output, ./- is a file of this name";
    if path == Path::new("-") {
        return Err(WriteError::refused(path, rule));
    }
    Ok(())
}

/// Quotes a word for a shell.
pub fn shell_word(word: &OsStr) -> String {
    let plain = |c: char| c.is_alphanumeric() || "/._-+,:@%".contains(c);
    match word.to_str() {
        Some("") => "''".to_owned(),
        Some(text) if text.chars().all(plain) => text.to_owned(),
        Some(text) if printable(text) == text => format!("'{}'", text.replace('\'', "'\\''")),
        _ => {
            // Escapes bytes that would break the line or control the terminal.
            let bytes = word.as_encoded_bytes().iter();
            let escaped = bytes.map(|&byte| match byte {
                b'\'' | b'\\' => format!("\\{}", char::from(byte)),
                b' '..=b'~' => char::from(byte).to_string(),
                _ => format!("\\x{byte:02x}"),
            });
            format!("$'{}'", escaped.collect::<String>())
        }
    }
}

/// Writes `contents` to `path` through a temporary file in the same directory, which is flushed to disk and then
/// renamed, so that a reader sees the old file or the new one, but never a part of it.
pub fn write_whole(path: &Path, contents: &[u8]) -> Result<(), WriteError> {
    write_whole_with(path, |out| out.write_all(contents))
}

/// Like [`write_whole`], but `fill` writes the contents, which need not be in memory at once.
pub fn write_whole_with(
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), WriteError> {
    write_with(path, |file| {
        let mut out = io::BufWriter::new(file);
        let filled = fill(&mut out).and_then(|()| out.flush());
        filled.map_err(WriteError::io(path))
    })
}

/// Like [`write_whole`], but `fill` receives the new file; returns the result of `fill`.
pub fn write_with<T, E: From<WriteError>>(
    path: &Path,
    fill: impl FnOnce(&mut fs::File) -> Result<T, E>,
) -> Result<T, E> {
    let failed = WriteError::io(path);
    let prefix = temporary_of(path);
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix).suffix(TEMPORARY);
    // Results are ordinary files, not secrets, so their mode is 0666 minus the umask. Opening the file here keeps the
    // temporary file's name, which means nothing to a user, out of error messages.
    let mut options = fs::File::options();
    options.read(true).write(true).create_new(true).mode(0o666);
    let made = builder.make_in(directory_of(path), |path| options.open(path));
    let mut file = made.map_err(failed)?;
    let filled = fill(file.as_file_mut())?;
    file.as_file().sync_all().map_err(failed)?;
    let persisted = file.persist(path);
    persisted.map_err(|error| failed(error.error))?;
    Ok(filled)
}

/// Returns the directory of a file.
pub fn directory_of(path: &Path) -> &Path {
    let parent = path.parent();
    let parent = parent.filter(|parent| !parent.as_os_str().is_empty());
    parent.unwrap_or(Path::new("."))
}

/// Returns the prefix of temporary files for `path`.
pub(super) fn temporary_of(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default();
    let name = crc32fast::hash(name.as_encoded_bytes());
    format!("{INTERNAL}{name:08x}-")
}

/// Prefix of temporary files and locks, which are not results.
pub(super) const INTERNAL: &str = ".mdr-tui-";

/// Suffix of temporary files.
const TEMPORARY: &str = ".tmp";

/// Removes temporary files left behind by killed processes: those in `directory` that begin with `prefix` and are at
/// least `age` old. Files that cannot be removed do no harm.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::bounded_read::Unread;

    #[test]
    fn a_file_is_replaced_whole_and_leaves_no_trace_of_its_making() {
        let base = tempfile::tempdir().expect("a directory");
        let path = base.path().join("x.csv");
        write_whole(&path, b"old").expect("a file");
        write_whole(&path, b"new").expect("a file");
        assert_eq!(fs::read(&path).expect("the file"), b"new");
        assert_eq!(fs::read_dir(base.path()).expect("the directory").count(), 1);
        let place = base.path().join("no/such/place.csv");
        let refused = write_whole(&place, b"").expect_err("no such directory");
        let due = format!(
            "{}: cannot write: No such file or directory (os error 2)",
            place.display()
        );
        assert_eq!((refused.to_string(), refused.is_misuse()), (due, true));
        let broken = || io::Error::from_raw_os_error(nix::libc::EIO);
        assert!(!WriteError::io(&place)(broken()).is_misuse());
        let unread = Refusal::unread("x", &Unread::Io(broken()));
        assert!(!WriteError::from(unread).is_misuse());
    }

    #[test]
    fn a_shell_reads_the_word_back() {
        for (path, word) in [
            ("/a/b-1.checkpoint", "/a/b-1.checkpoint"),
            ("/a b", "'/a b'"),
            ("it's", "'it'\\''s'"),
            ("$(x)", "'$(x)'"),
            ("a\nb's \u{a0}\u{1b}", "$'a\\x0ab\\'s \\xc2\\xa0\\x1b'"),
            ("-5C run", "'./-5C run'"),
        ] {
            assert_eq!(shell_path(Path::new(path)), word);
        }
        assert_eq!(shell_word(OsStr::new("-x")), "-x");
        assert_eq!(shell_word(OsStr::new("")), "''");
    }
}

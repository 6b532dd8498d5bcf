//! Reads files that others have written: regular files only, up to a size limit.
//!
//! A pipe or a device could keep the program waiting for ever, so neither is read, even if the user names it.

use std::fs::File;
use std::io::{self, Read};
use std::os::unix::fs::OpenOptionsExt;
use std::path::Path;

use nix::libc::{ELOOP, O_NONBLOCK};

/// Why a file cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum Unread {
    /// It does not exist.
    #[error("no such file")]
    Missing,
    /// It is a directory.
    #[error("is a directory")]
    Directory,
    /// It is a pipe, a device or a socket.
    #[error("is not a file (but a pipe, a device or a socket)")]
    Irregular,
    /// It is larger than the limit, in bytes.
    #[error("is larger than {} MiB", .0 >> 20)]
    TooLarge(u64),
    /// It is not text; the number is the first bad byte.
    #[error("is not UTF-8 text at byte {0}")]
    NotText(usize),
    /// The system reports an error.
    #[error("cannot be read: {0}")]
    Io(io::Error),
}

impl From<io::Error> for Unread {
    fn from(cause: io::Error) -> Self {
        match cause.kind() {
            io::ErrorKind::NotFound => Self::Missing,
            io::ErrorKind::IsADirectory => Self::Directory,
            _ => Self::Io(cause),
        }
    }
}

/// Whether the user could have avoided an error of the system.
pub fn is_avoidable(cause: &io::Error) -> bool {
    use io::ErrorKind as Kind;
    let is_avoidable = matches!(
        cause.kind(),
        Kind::NotFound
            | Kind::PermissionDenied
            | Kind::AlreadyExists
            | Kind::NotADirectory
            | Kind::IsADirectory
            | Kind::ReadOnlyFilesystem
            | Kind::InvalidFilename
            | Kind::InvalidInput
    );
    // An error without a code comes from the program itself.
    is_avoidable || matches!(cause.raw_os_error(), None | Some(ELOOP))
}

/// Opens a regular file for reading.
///
/// # Errors
///
/// [`Unread`].
pub fn open(path: &Path) -> Result<File, Unread> {
    let check = |about: io::Result<std::fs::Metadata>| match about? {
        about if about.is_dir() => Err(Unread::Directory),
        about if !about.is_file() => Err(Unread::Irregular),
        _ => Ok(()),
    };
    // Merely opening a device may affect it, and opening a pipe
    // waits for its other end, so check first, and never wait.
    check(path.metadata())?;
    let file = File::options()
        .read(true)
        .custom_flags(O_NONBLOCK)
        .open(path)?;
    check(file.metadata())?;
    Ok(file)
}

/// Reads a text of at most `most` bytes from a regular file.
///
/// # Errors
///
/// [`Unread`].
pub fn text(path: &Path, most: u64) -> Result<String, Unread> {
    text_from(open(path)?, most)
}

/// Reads a text of at most `most` bytes from an open source, such as the standard input.
///
/// # Errors
///
/// [`Unread`].
pub fn text_from(from: impl Read, most: u64) -> Result<String, Unread> {
    String::from_utf8(bytes_from(from, most)?)
        .map_err(|error| Unread::NotText(error.utf8_error().valid_up_to()))
}

/// Reads at most `most` bytes of a regular file in any encoding.
///
/// # Errors
///
/// [`Unread`].
pub fn bytes(path: &Path, most: u64) -> Result<Vec<u8>, Unread> {
    bytes_from(open(path)?, most)
}

fn bytes_from(from: impl Read, most: u64) -> Result<Vec<u8>, Unread> {
    let mut bytes = Vec::new();
    from.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        Err(Unread::TooLarge(most))
    } else {
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_a_file_is_refused_at_once() {
        let base = tempfile::tempdir().expect("a directory");
        let pipe = base.path().join("pipe");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        assert!(made.expect("mkfifo").success());
        let irregular = "is not a file (but a pipe, a device or a socket)";
        for (path, why) in [
            (Path::new("/dev/zero"), irregular),
            (&pipe, irregular),
            (Path::new("/"), "is a directory"),
            (Path::new("/nowhere"), "no such file"),
        ] {
            let refused = text(path, 1).expect_err("not a file");
            assert_eq!(refused.to_string(), why);
        }
    }

    #[test]
    fn a_text_is_read_up_to_the_limit() {
        let base = tempfile::tempdir().expect("a directory");
        let path = base.path().join("x");
        std::fs::write(&path, "abc").expect("a file");
        assert_eq!(text(&path, 3).expect("a text"), "abc");
        assert!(matches!(text(&path, 2), Err(Unread::TooLarge(2))));
        std::fs::write(&path, b"a\xff").expect("a file");
        assert!(matches!(text(&path, 3), Err(Unread::NotText(1))));
        let refused = text_from(io::repeat(b'x'), 1 << 20).expect_err("no end");
        assert_eq!(refused.to_string(), "is larger than 1 MiB");
    }
}

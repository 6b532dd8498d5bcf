//! Reads files that others have written: text, and not more than a limit of it.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Why a file is not read.
#[derive(Debug, thiserror::Error)]
pub enum Unread {
    /// There is none.
    #[error("no such file")]
    Missing,
    /// It is a directory.
    #[error("is a directory")]
    Directory,
    /// It is no regular file, and nobody has named it.
    #[error("is not a file")]
    Irregular,
    /// It is larger than the limit, in bytes.
    #[error("is larger than {} MiB", .0 >> 20)]
    TooLarge(u64),
    /// It is no text at this byte.
    #[error("is not UTF-8 text at byte {0}")]
    NotText(usize),
    /// The system refuses.
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

/// Reads a text of `most` bytes or fewer from a file that the user has named, which may be a pipe.
///
/// # Errors
///
/// [`Unread`].
pub fn text(path: &Path, most: u64) -> Result<String, Unread> {
    let mut bytes = Vec::new();
    File::open(path)?.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(Unread::TooLarge(most));
    }
    String::from_utf8(bytes).map_err(|error| Unread::NotText(error.utf8_error().valid_up_to()))
}

/// [`text`] of a regular file: a pipe that was found in a folder would never end.
///
/// # Errors
///
/// [`Unread`].
pub fn regular_text(path: &Path, most: u64) -> Result<String, Unread> {
    match path.metadata()? {
        about if about.is_dir() => Err(Unread::Directory),
        about if !about.is_file() => Err(Unread::Irregular),
        _ => text(path, most),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_never_ends_is_read_to_the_limit() {
        let refused = text(Path::new("/dev/zero"), 1 << 20).expect_err("no end");
        assert_eq!(refused.to_string(), "is larger than 1 MiB");
        for (path, why) in [("/dev/zero", "is not a file"), ("/", "is a directory")] {
            let refused = regular_text(Path::new(path), 1).expect_err("no file");
            assert_eq!(refused.to_string(), why);
        }
    }

    #[test]
    fn a_text_of_the_limit_is_read() {
        let base = tempfile::tempdir().expect("a directory");
        let path = base.path().join("x");
        std::fs::write(&path, "abc").expect("a file");
        assert_eq!(text(&path, 3).expect("a text"), "abc");
        assert!(matches!(text(&path, 2), Err(Unread::TooLarge(2))));
        std::fs::write(&path, b"a\xff").expect("a file");
        assert!(matches!(regular_text(&path, 3), Err(Unread::NotText(1))));
    }
}

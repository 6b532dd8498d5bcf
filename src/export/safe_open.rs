//! Opens the files that the program keeps for itself: regular files, never through a link.

use std::fs::{File, OpenOptions};
use std::io;
use std::os::unix::fs::OpenOptionsExt;
use std::path::Path;

use nix::libc::{O_NOFOLLOW, O_NONBLOCK};

/// Opens `path` for reading and writing; a new file where `is_new`, and else one that is there.
///
/// # Errors
///
/// As the system says, and for what is not a regular file.
pub fn open(path: &Path, is_new: bool) -> io::Result<File> {
    let mut options = File::options();
    regular(path, options.read(true).write(true).create_new(is_new))
}

/// Opens `path` for reading and writing, and makes it where it is not there.
///
/// # Errors
///
/// As [`open`].
pub fn open_or_make(path: &Path) -> io::Result<File> {
    let mut options = File::options();
    options.read(true).write(true).create(true).truncate(false);
    regular(path, &mut options)
}

/// Opens `path`, which is there, for reading.
///
/// # Errors
///
/// As [`open`].
pub fn read(path: &Path) -> io::Result<File> {
    regular(path, File::options().read(true))
}

fn regular(path: &Path, options: &mut OpenOptions) -> io::Result<File> {
    // Opening a pipe must not wait for its other end.
    let file = options.custom_flags(O_NOFOLLOW | O_NONBLOCK).open(path);
    let is_other = || path.symlink_metadata().is_ok_and(|about| !about.is_file());
    match file {
        Ok(file) if file.metadata()?.is_file() => Ok(file),
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists || !is_other() => Err(error),
        _ => Err(io::Error::other("it is not a regular file")),
    }
}

//! Opens the program's own files: only regular files, never through a link.

use std::fs::{File, OpenOptions};
use std::io;
use std::os::unix::fs::OpenOptionsExt;
use std::path::Path;

use nix::libc::{O_NOFOLLOW, O_NONBLOCK};

/// Opens `path` for reading and writing: a new file if `is_new`, else an existing one.
///
/// # Errors
///
/// The system's error, or an error for anything but a regular file.
pub fn open(path: &Path, is_new: bool) -> io::Result<File> {
    let mut options = File::options();
    regular(path, options.read(true).write(true).create_new(is_new))
}

/// Opens `path` for reading and writing; creates the file if necessary.
///
/// # Errors
///
/// As [`open`].
pub fn open_or_make(path: &Path) -> io::Result<File> {
    let mut options = File::options();
    options.read(true).write(true).create(true).truncate(false);
    regular(path, &mut options)
}

/// Opens the existing file `path` for reading.
///
/// # Errors
///
/// As [`open`].
pub fn read(path: &Path) -> io::Result<File> {
    regular(path, File::options().read(true))
}

fn regular(path: &Path, options: &mut OpenOptions) -> io::Result<File> {
    // Opening a pipe must not block until its other end is opened.
    let file = options.custom_flags(O_NOFOLLOW | O_NONBLOCK).open(path);
    let is_other = || path.symlink_metadata().is_ok_and(|about| !about.is_file());
    match file {
        Ok(file) if file.metadata()?.is_file() => Ok(file),
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists || !is_other() => Err(error),
        _ => Err(io::Error::other("it is not a regular file")),
    }
}

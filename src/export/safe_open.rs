//! Opens the program's own files: only regular files, never through a link.

use std::fs::{File, OpenOptions};
use std::io;
use std::os::unix::fs::OpenOptionsExt;
use std::path::{Path, PathBuf};

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

/// Returns the program's directory inside the one that the environment variable names, or else inside `fallback` in the
/// home directory; `None` without a home directory.
pub fn directory(variable: &str, fallback: &str) -> Option<PathBuf> {
    let given = std::env::var_os(variable).map(PathBuf::from);
    // The XDG specification says to ignore relative paths.
    let base = given.filter(|path| path.is_absolute()).or_else(|| {
        let home = std::env::home_dir().filter(|home| !home.as_os_str().is_empty());
        home.map(|home| home.join(fallback))
    });
    base.map(|base| base.join("mdr-tui"))
}

//! Scenarios named on the command line.

use std::ffi::OsStr;
use std::fs::File;
use std::io;
use std::path::Path;

use crate::scenario::{Refusal, Scenario};

/// The name of standard input in messages and files.
const STDIN: &str = "stdin";

/// Loads the preset or file of this name, or standard input for `-`. A file opened by the shell, such as `/dev/fd/63`,
/// may be a pipe.
///
/// # Errors
///
/// As [`Scenario::load`].
pub(super) fn scenario(name: &OsStr, sets: &[String]) -> Result<Scenario, Refusal> {
    if name == "-" {
        return Scenario::from_reader(io::stdin().lock(), STDIN, sets);
    }
    let path = Path::new(name);
    if path == Path::new("/dev/stdin") || path.starts_with("/dev/fd") {
        let shown = path.to_string_lossy();
        let open = File::open(path);
        let file = open.map_err(|error| Refusal::unread(&shown, &error.into()))?;
        return Scenario::from_reader(file, &shown, sets);
    }
    Scenario::load(name, sets)
}

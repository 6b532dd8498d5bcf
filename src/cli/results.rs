//! The file that a study writes its rows to.

use std::path::Path;

use super::Misuse;

/// Finds out before anything is computed whether the file can be written.
pub fn check(path: &Path, force: bool) -> Result<(), Misuse> {
    let refuse = |why: &str| Err(Misuse(format!("--csv {}: {why}", path.display())));
    if path.is_dir() || path.file_name().is_none() {
        return refuse("is no name of a file");
    }
    if path.exists() && !force {
        return refuse("exists already; choose another name or add --force");
    }
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() && !parent.is_dir() => {
            refuse("its directory does not exist")
        }
        _ => Ok(()),
    }
}

//! Finds the directories of the program's state and preferences, by the XDG base directory specification.

use std::path::PathBuf;

/// Returns the directory of the explorer's checkpoints; `None` without a home directory.
pub fn state() -> Option<PathBuf> {
    directory("XDG_STATE_HOME", ".local/state")
}

/// Returns the directory of the user's preferences; `None` without a home directory.
pub fn config() -> Option<PathBuf> {
    directory("XDG_CONFIG_HOME", ".config")
}

/// The program's directory in the one that the environment names in `variable`, or in `fallback` in the home directory.
fn directory(variable: &str, fallback: &str) -> Option<PathBuf> {
    let given = std::env::var_os(variable).map(PathBuf::from);
    // The specification says to ignore relative paths.
    let base = given.filter(|path| path.is_absolute()).or_else(|| {
        let home = std::env::home_dir().filter(|home| !home.as_os_str().is_empty());
        home.map(|home| home.join(fallback))
    });
    base.map(|base| base.join("mdr-tui"))
}

//! From a file to a text, to a TOML table.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use toml::Table;

use super::error::{Origin, ScenarioError, printable};

/// The largest file that is read as a scenario, in bytes.
const LARGEST_FILE: u64 = 1 << 20;

/// Reads a file that can be a scenario: text, and not too long.
pub(super) fn file(path: &str) -> Result<String, ScenarioError> {
    let unreadable = |reason: String| ScenarioError::Unreadable {
        origin: printable(path),
        reason,
    };
    if Path::new(path).is_dir() {
        return Err(unreadable(
            "is a directory; a scenario is a TOML file".into(),
        ));
    }
    let failed = |error: std::io::Error| {
        unreadable(match error.kind() {
            std::io::ErrorKind::NotFound => "no such file; mdr-tui presets lists what ships".into(),
            _ => format!("cannot be read: {error}"),
        })
    };
    let file = File::open(path).map_err(failed)?;
    let mut bytes = Vec::new();
    file.take(LARGEST_FILE + 1)
        .read_to_end(&mut bytes)
        .map_err(failed)?;
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(unreadable(
            "is larger than 1 MiB; a scenario is a short TOML file".into(),
        ));
    }
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        unreadable(format!(
            "is not UTF-8 text at byte {at}; a scenario is a TOML file"
        ))
    })
}

/// The text as a TOML table.
pub(super) fn table(text: &str, origin: &Origin) -> Result<Table, ScenarioError> {
    toml::from_str(text).map_err(|error| {
        let at = error.span().map_or(0, |span| span.start);
        let before = text.get(..at).unwrap_or(text);
        let line = before.rsplit('\n').next().unwrap_or_default();
        ScenarioError::Syntax {
            origin: origin.name().to_owned(),
            line: before.matches('\n').count() + 1,
            column: line.chars().count() + 1,
            message: printable(&error.message().replace('\n', "; ")),
        }
    })
}

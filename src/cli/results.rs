//! Output of the rows of a study: a file, or JSON on stdout.

use std::io::Write;
use std::path::Path;

use anyhow::Result;
use serde::Serialize;

use super::Misuse;
use super::args::Rows;
use crate::export::file::write_whole;

impl Rows {
    /// Checks that the file can be written before anything is computed.
    pub(super) fn check(&self) -> Result<(), Misuse> {
        match &self.csv {
            Some(path) => check(path, self.force),
            None => Ok(()),
        }
    }

    /// Writes the file of a study if requested: program, study, `notes` and table.
    pub(super) fn write(
        &self,
        study: &str,
        notes: &[String],
        table: impl FnOnce() -> String,
    ) -> Result<()> {
        let Some(path) = &self.csv else {
            return Ok(());
        };
        let version = env!("CARGO_PKG_VERSION");
        let mut text = format!("# mdr-tui: {version}\n# study: {study}\n");
        for note in notes {
            text.push_str(&format!("# {note}\n"));
        }
        text.push_str(&table());
        Ok(write_whole(path, text.as_bytes())?)
    }
}

fn check(path: &Path, force: bool) -> Result<(), Misuse> {
    let refuse = |why: &str| Err(Misuse(format!("--csv {}: {why}", path.display())));
    if path.is_dir() || path.file_name().is_none() {
        return refuse("is not a file name");
    }
    if path.exists() && !force {
        return refuse("already exists; choose another name or add --force");
    }
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() && !parent.is_dir() => {
            refuse("its directory does not exist")
        }
        _ => Ok(()),
    }
}

/// Prints rows as JSON.
pub fn print_json(rows: &impl Serialize, out: &mut impl Write) -> Result<()> {
    writeln!(out, "{}", serde_json::to_string_pretty(rows)?)?;
    Ok(())
}

//! Output of the rows of a study: a file, or JSON on stdout.

use std::io::Write;

use anyhow::Result;
use serde::Serialize;

use super::args::Output;
use crate::export::file::WriteError;
use crate::export::target::Target;

impl Output {
    /// Claims the file that is asked for, before anything is computed.
    pub(super) fn claim(&self) -> Result<Option<Target>, WriteError> {
        Target::claim_given(self.csv.as_deref(), self.force)
    }
}

/// Writes the file of a study, if there is one: program, study, `notes` and table.
pub fn write(
    target: Option<&Target>,
    study: &str,
    notes: &[String],
    table: impl FnOnce() -> String,
) -> Result<(), WriteError> {
    let Some(target) = target else {
        return Ok(());
    };
    let version = env!("CARGO_PKG_VERSION");
    let mut text = format!("# mdr-tui: {version}\n# study: {study}\n");
    for note in notes {
        text.push_str(&format!("# {note}\n"));
    }
    text.push_str(&table());
    target.write(text.as_bytes())
}

/// Prints rows as JSON.
pub fn print_json(rows: &impl Serialize, out: &mut impl Write) -> Result<()> {
    writeln!(out, "{}", serde_json::to_string_pretty(rows)?)?;
    Ok(())
}

//! Output of a study's results: a file, and text or JSON on stdout.

use std::io::{self, Write};

use anyhow::Result;
use serde::Serialize;

use super::args::Output;
use super::stop;
use crate::export::file::WriteError;
use crate::export::target::Target;
use crate::scenario::escape;
use crate::studies::table::Report;

impl Output {
    /// Claims the output file, if there is one, before anything is computed.
    pub(super) fn claim(&self) -> Result<Option<Target>, WriteError> {
        Target::claim_given(self.csv.as_deref(), self.force)
    }
}

/// Writes the file of a study, if there is one: program, study, `notes` and rows. Call it before printing, so that a
/// closed pipe on stdout does not cost the file.
pub fn write(
    target: Option<&Target>,
    study: &str,
    notes: &[String],
    rows: &Report,
) -> Result<(), WriteError> {
    let Some(target) = target else {
        return Ok(());
    };
    let version = env!("CARGO_PKG_VERSION");
    let notes = notes.iter().map(|note| format!("# {note}\n"));
    let head = format!("# mdr-tui: {version}\n# study: {study}\n");
    let text = head + &notes.collect::<String>() + &rows.csv();
    target.write(text.as_bytes())
}

/// Prints the results as JSON if given, otherwise as text.
pub fn print<T: Serialize>(json: Option<&T>, text: impl FnOnce() -> String) -> Result<()> {
    stop::nothing_is_left_to_save();
    let text = match json {
        Some(found) => escape::json(found, true)? + "\n",
        None => text(),
    };
    Ok(io::stdout().lock().write_all(text.as_bytes())?)
}

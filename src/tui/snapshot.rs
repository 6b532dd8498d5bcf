//! Snapshots, written by `s`, and opening them again: the state, the scenario that reproduces it, history and last loop
//! as tables, and a checkpoint.

use std::path::{Path, PathBuf};

use serde::de::IgnoredAny;

use super::recorded::Recorded;
use crate::export::autosave::Work;
use crate::export::file::WriteError;
use crate::export::header;
use crate::export::run_folder::{RUN_CHECKPOINT, RunFolder};
use crate::export::{last_loop, state};
use crate::math::number::exact;
use crate::reading::Column;
use crate::scenario::columns::Columns;
use crate::scenario::{checkpoint, printable};
use crate::traces::Table;

/// The checkpoint's file name.
const CHECKPOINT: &str = "state.checkpoint";

/// Writes the state of `run` to a new directory, with the user's note, and returns the path of the state.
pub(super) fn write(run: &Recorded, note: Option<&str>) -> Result<PathBuf, WriteError> {
    // The note is about this state; a run that continues from it does not carry it.
    let kept = run.checkpoint();
    let noted = note.map(|note| run.session.noted(note));
    let session = noted.as_ref().unwrap_or(&run.session);
    let cycle = exact(session.simulation().cycle());
    let stem = session.loaded().stem();
    let directory = RunFolder::create_named(&format!("{stem}-cycle-{cycle}"))?;
    let scenario = session.as_run(Vec::new()).to_toml();
    let mut files = vec![
        ("scenario.toml", scenario.into_bytes()),
        (
            "history.csv",
            header::file(session, &run.history()).into_bytes(),
        ),
        (CHECKPOINT, kept),
    ];
    let last_loop = last_loop::file(session);
    files.extend(last_loop.map(|table| ("loop.csv", table.into_bytes())));
    files.push(("state.csv", state::table(session).into_bytes()));
    for (name, bytes) in &files {
        if let Err(error) = directory.write(name, bytes) {
            // Leaves no half-written snapshot: the directory is removed with its last file.
            for (name, _) in &files {
                let _ = std::fs::remove_file(directory.path().join(name));
            }
            return Err(error);
        }
    }
    Ok(directory.path().join("state.csv").components().collect())
}

/// Finds the checkpoint of a snapshot or of an interrupted run in a directory.
fn checkpoint_in(directory: &Path) -> Option<PathBuf> {
    let kept = [CHECKPOINT, RUN_CHECKPOINT].map(|name| directory.join(name));
    kept.into_iter().find(|path| path.is_file())
}

/// Describes the state in the directory `path` in one line: its cycle, title and note; `None` if there is none.
pub(super) fn about(path: &Path) -> Option<String> {
    checkpoint_in(path)?;
    let header = Columns::header_of(&path.join("state.csv")).ok()?;
    let fact = |key: &str| {
        let (_, value) = header.iter().find(|(known, _)| known == key)?;
        Some(value)
    };
    let (cycle, title) = (fact(Column::Cycle.name())?, fact("scenario")?);
    let note = fact("note").map_or_else(String::new, |note| format!(" Note: {note}."));
    let next = "Enter goes on from there";
    Some(format!("{title}, cycle {cycle}.{note} {next}"))
}

/// Opens the state in a directory, with as much of its past as is recorded.
///
/// # Errors
/// In one line: there is no such state, or the checkpoint is damaged or of another version.
pub fn open(directory: &Path) -> Result<Recorded, String> {
    let Some(path) = checkpoint_in(directory) else {
        let shown = printable(&directory.display().to_string());
        return Err(format!(
            "{shown}: is a directory without a {CHECKPOINT} to go on from; its scenario.toml starts a new run"
        ));
    };
    let kept = checkpoint::read::<IgnoredAny>(&path).map_err(|error| error.to_string())?;
    let session = kept.session;
    let read = |name: &str| Columns::read(&directory.join(name)).ok();
    let Some(history) = read("history.csv") else {
        return Ok(session.into());
    };
    let last_loop = read("loop.csv").map(|file| Table::of_file(&file));
    let (history, last_loop) = (Table::of_file(&history), last_loop.unwrap_or_default());
    Ok(Recorded::with_past(session, &history, &last_loop))
}

//! Snapshots, written by `s`, and opening them again: the state, the scenario that reproduces it, history and last loop
//! as tables, and a checkpoint.

use std::path::{Path, PathBuf};

use serde::de::IgnoredAny;

use super::trend::{Recorded, Trend};
use crate::export::file::WriteError;
use crate::export::header::table;
use crate::export::run_folder::{RUN_CHECKPOINT, RunFolder};
use crate::export::{history, last_loop, state};
use crate::math::number::exact;
use crate::reading::Column;
use crate::scenario::columns::Columns;
use crate::scenario::scalars::Reading;
use crate::scenario::session::Session;
use crate::scenario::{checkpoint, printable};
use crate::traces::Table;

/// The checkpoint's file name.
const CHECKPOINT: &str = "state.checkpoint";

/// Writes the state of `run` to a new directory, with the user's note, and returns the path of the state.
pub(super) fn write(run: &Recorded, note: Option<&str>) -> Result<PathBuf, WriteError> {
    // The note is about this state; a run that continues from it does not carry it.
    let kept = checkpoint::encode(&run.session, None::<&()>);
    let noted = note.map(|note| run.session.noted(note));
    let session = noted.as_ref().unwrap_or(&run.session);
    let cycle = exact(session.simulation().cycle());
    let stem = session.loaded().stem();
    let directory = RunFolder::create_named(&format!("{stem}-cycle-{cycle}"))?;
    let scenario = session.as_run(Vec::new()).to_toml();
    let mut files = vec![
        ("scenario.toml", scenario.into_bytes()),
        ("history.csv", history(session, &run.trend).into_bytes()),
        (CHECKPOINT, kept),
    ];
    if session.simulation().moment().stick_radius.is_some() {
        files.push(("loop.csv", loop_table(session).into_bytes()));
    }
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

/// Returns the history with the columns of a run's `history.csv`. As on the screen, contact radii and stick radii are
/// the largest and the smallest of each cycle.
fn history(session: &Session, trend: &Trend) -> String {
    let cycles = trend.history.column(Column::Cycle).unwrap_or_default();
    let now = session.simulation().cycle();
    let rows = trend.fields.iter().enumerate().map(|(row, fields)| {
        let mut fields = match fields {
            Some(fields) => fields.to_vec(),
            None if cycles[row] == now => history::fields(&Reading::new(session)).to_vec(),
            None => vec![String::new(); Column::HISTORY.len()],
        };
        for (column, values) in trend.history.columns() {
            let is_of_cycle =
                [Column::ContactRadius, Column::PermanentStickRadius].contains(&column);
            let at = Column::HISTORY.iter().position(|known| *known == column);
            if let Some(field) = at.map(|at| &mut fields[at])
                && (is_of_cycle || field.is_empty())
            {
                *field = exact(values[row]);
            }
        }
        fields
    });
    table(session, &Column::HISTORY, rows)
}

/// Returns the last period, with the columns of a measured loop.
fn loop_table(session: &Session) -> String {
    let rows = last_loop::rows(session.simulation()).into_iter();
    let rows = rows.map(|[cycle, shift, force, _]| [cycle, shift, force].map(exact));
    table(
        session,
        &[Column::Cycle, Column::LoopShift, Column::LoopForce],
        rows,
    )
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
            "{shown}: is a directory without a {CHECKPOINT} to go on from; its scenario.toml starts anew"
        ));
    };
    let kept = checkpoint::read::<IgnoredAny>(&path).map_err(|error| error.to_string())?;
    let session = kept.session;
    let moment = session.simulation().moment();
    Ok(match past(directory, moment.cycle, moment.initial_volume) {
        Some(trend) => Recorded { session, trend },
        None => session.into(),
    })
}

/// Reads the past up to `cycle` from the tables beside a checkpoint.
fn past(directory: &Path, cycle: f64, initial: f64) -> Option<Trend> {
    let read = |name: &str| Columns::read(&directory.join(name)).ok();
    let file = read("history.csv")?;
    let history = Table::of_file(&file);
    let cycles = history.column(Column::Cycle)?;
    let has_all = file.names == Column::HISTORY.map(Column::name);
    let entries = (0..cycles.len()).filter(|&row| cycles[row] <= cycle);
    let entries = entries.map(|row| {
        let column = |column| history.column(column);
        let value = move |of| column(of).map_or(f64::NAN, |values| values[row]);
        (value, has_all.then(|| file.fields(row).into()))
    });
    let last = read("loop.csv").map(|file| Table::of_file(&file));
    let last = last.unwrap_or_default();
    let [cycles, shifts, forces] = [Column::Cycle, Column::LoopShift, Column::LoopForce]
        .map(|column| last.column(column).unwrap_or_default());
    let steps = cycles.iter().zip(shifts).zip(forces);
    let steps = steps.map(|((cycle, shift), force)| [*cycle, *shift, *force, f64::NAN]);
    Some(Trend::of_past(entries, steps, initial))
}

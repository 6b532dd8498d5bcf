//! What `s` writes and how it is opened again: the state, the scenario that reproduces it, history and
//! last loop as tables, and a checkpoint.

use std::fmt::Write;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

use serde::de::IgnoredAny;

use super::trend::{self, Cycle, Recorded, Trend};
use crate::export::file::{RUN_CHECKPOINT, RunDirectory, WriteError};
use crate::export::header::{field as written, lines, number};
use crate::export::{history, own, state};
use crate::scenario::columns::Columns;
use crate::scenario::scalars::Reading;
use crate::scenario::session::Session;
use crate::scenario::{checkpoint, printable};
use crate::traces::Table;

/// The checkpoint of a snapshot.
const CHECKPOINT: &str = "state.checkpoint";

/// Lines of a table that are searched for its header.
const HEADER: usize = 50;

/// And the most bytes.
const LONGEST_HEADER: u64 = 1 << 20;

/// Writes the state of `run` to a new directory, with the user's note, and returns the path of the state.
pub(super) fn write(run: &Recorded, note: Option<&str>) -> Result<PathBuf, WriteError> {
    // The note is about this state: what goes on from it does not carry it.
    let kept = checkpoint::encode(&run.session, None::<&()>);
    let noted = note.map(|note| run.session.noted(note));
    let session = noted.as_ref().unwrap_or(&run.session);
    let cycle = number(session.simulation().cycle());
    let stem = session.loaded().stem();
    let directory = RunDirectory::claim_new(&format!("{stem}-cycle-{cycle}"))?;
    let written = fill(&directory, session, &run.trend, &kept);
    if written.is_err() {
        // Nothing half: the directory goes with its last file.
        for name in FILES {
            let _ = std::fs::remove_file(directory.path().join(name));
        }
    }
    written.map(|()| directory.path().join("state.csv").components().collect())
}

/// The files of a state.
const FILES: [&str; 5] = [
    "scenario.toml",
    "history.csv",
    "loop.csv",
    CHECKPOINT,
    "state.csv",
];

fn fill(
    directory: &RunDirectory,
    session: &Session,
    trend: &Trend,
    kept: &[u8],
) -> Result<(), WriteError> {
    let scenario = session.as_run(Vec::new()).to_toml();
    directory.write("scenario.toml", scenario.as_bytes())?;
    directory.write("history.csv", history(session, trend).as_bytes())?;
    if session.simulation().moment().stick_radius.is_some() {
        directory.write("loop.csv", last_loop(session, trend).as_bytes())?;
    }
    directory.write(CHECKPOINT, kept)?;
    let state = state::table(session);
    directory.write("state.csv", state.as_bytes()).map(|_| ())
}

/// The history in the columns of a run's. Contact radii and stick radii are those that the screen shows: the
/// largest and the smallest of each cycle.
fn history(session: &Session, trend: &Trend) -> String {
    let mut text = format!("{}{}\n", lines(session), history::COLUMNS.join(","));
    for entry in trend.cycles() {
        let (mut fields, is_open) = match &entry.fields {
            Some(fields) => (fields.to_vec(), false),
            None => (vec![String::new(); history::COLUMNS.len()], true),
        };
        if is_open && entry.end() == session.simulation().cycle() {
            fields = history::fields(&Reading::new(session)).to_vec();
        }
        for ((name, _), value) in trend::COLUMNS.into_iter().zip(entry.values) {
            let is_of_cycle = ["contact_radius_m", "permanent_stick_radius_m"].contains(&name);
            let at = history::COLUMNS.iter().position(|column| *column == name);
            if let Some(field) = at.map(|at| &mut fields[at])
                && (is_of_cycle || field.is_empty())
            {
                *field = written(value);
            }
        }
        let _ = writeln!(text, "{}", fields.join(","));
    }
    text
}

/// The last cycle, in the columns of a measured loop.
fn last_loop(session: &Session, trend: &Trend) -> String {
    let mut text = format!("{}cycle,u_m,F_N\n", lines(session));
    for [cycle, shift, force, _] in &trend.loops.steps {
        let fields = [cycle, shift, force].map(|value| written(*value));
        let _ = writeln!(text, "{}", fields.join(","));
    }
    text
}

/// Where in a directory a state to go on from is: that of a snapshot, or of a run that was interrupted.
fn checkpoint_in(directory: &Path) -> Option<PathBuf> {
    let kept = [CHECKPOINT, RUN_CHECKPOINT].map(|name| directory.join(name));
    kept.into_iter().find(|path| path.is_file())
}

/// What `path` is if a state can be opened from there: its cycle, title and note, in a line.
pub(super) fn about(path: &Path) -> Option<String> {
    checkpoint_in(path)?;
    let file = own::read(&path.join("state.csv")).ok()?;
    let head = BufReader::new(file.take(LONGEST_HEADER))
        .lines()
        .take(HEADER);
    let head: Vec<String> = head.map_while(Result::ok).collect();
    let fact = |key: &str| {
        let start = format!("# {key}: ");
        let found = head.iter().find_map(|line| line.strip_prefix(&start));
        found.map(printable)
    };
    let (cycle, title) = (fact("cycle")?, fact("scenario")?);
    let note = fact("note").map_or_else(String::new, |note| format!(" Note: {note}."));
    Some(format!(
        "{title}, cycle {cycle}.{note} Enter goes on from there"
    ))
}

/// Opens the state in a directory, with its past as far as it is known.
///
/// # Errors
/// One line: a directory without such a state, a checkpoint that is torn or of another version.
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

/// The past up to `cycle` as the tables beside a checkpoint tell of it.
fn past(directory: &Path, cycle: f64, initial: f64) -> Option<Trend> {
    let read = |name: &str| Columns::read(&directory.join(name)).ok();
    let file = read("history.csv")?;
    let history = Table::of_file(&file);
    let cycles = history.column("cycle")?;
    let has_all = file.names == history::COLUMNS;
    let entries = (0..cycles.len()).filter(|&row| cycles[row] <= cycle);
    let entries = entries.map(|row| {
        let value = |name| history.column(name).map_or(f64::NAN, |column| column[row]);
        Cycle {
            values: trend::COLUMNS.map(|(name, _)| value(name)),
            fields: has_all.then(|| file.fields(row).into()),
        }
    });
    let rows = read("loop.csv").and_then(|file| {
        let table = Table::of_file(&file);
        let columns = ["cycle", "u_m", "F_N"].map(|name| table.column(name));
        let [Some(cycles), Some(shifts), Some(forces)] = columns else {
            return None;
        };
        let rows = 0..cycles.len();
        Some(
            rows.map(|row| [cycles[row], shifts[row], forces[row]])
                .collect(),
        )
    });
    Some(Trend::of_past(entries, rows.unwrap_or_default(), initial))
}

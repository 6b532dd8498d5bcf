//! What `s` writes and how it is opened again: the state, the scenario that reproduces it, history and
//! last loop as tables, and a checkpoint.

use std::fmt::Write;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

use serde::de::IgnoredAny;

use super::trend::{Cycle, OfCycle, Trend};
use crate::export::file::{RUN_CHECKPOINT, RunDirectory, WriteError};
use crate::export::header::{lines, number};
use crate::export::{own, state};
use crate::scenario::columns::{Columns, Quantity};
use crate::scenario::session::Session;
use crate::scenario::{checkpoint, printable};

/// The checkpoint of a snapshot.
const CHECKPOINT: &str = "state.checkpoint";

/// Lines of a table that are searched for its header.
const HEADER: usize = 50;

/// And the most bytes.
const LONGEST_HEADER: u64 = 1 << 20;

/// A state to go on from, with its past as far as it is known.
#[derive(Debug)]
pub struct Opened {
    /// The run.
    pub session: Session,
    /// The cycles and the loop before.
    pub trend: Trend,
}

/// Writes `session` to a new directory, with the user's note, and returns the path of the state.
pub(super) fn write(
    session: &Session,
    trend: &Trend,
    note: Option<&str>,
) -> Result<PathBuf, WriteError> {
    // The note is about this state: what goes on from it does not carry it.
    let kept = checkpoint::encode(session, None::<&()>);
    let noted = note.map(|note| session.noted(note));
    let session = noted.as_ref().unwrap_or(session);
    let cycle = number(session.simulation().cycle());
    let stem = session.loaded().stem();
    let directory = RunDirectory::claim_new(&format!("{stem}-cycle-{cycle}"))?;
    let written = fill(&directory, session, trend, &kept);
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

/// The columns of the history and what they are of a cycle.
const COLUMNS: [(&str, OfCycle); 8] = [
    ("cycle", |entry| entry.cycle),
    ("contact_radius_m", |entry| entry.contact_radius),
    ("permanent_stick_radius_m", |entry| entry.stick_radius),
    ("wear_volume_m3", |entry| entry.wear_volume),
    ("scar_depth_m", |entry| entry.scar_depth),
    ("scar_radius_m", |entry| entry.scar_radius),
    ("dissipated_energy_J", |entry| entry.dissipated_energy),
    ("period_energy_residual", |entry| entry.residual),
];

fn history(session: &Session, trend: &Trend) -> String {
    let names = COLUMNS.map(|(name, _)| name).join(",");
    let mut text = format!("{}{names}\n", lines(session));
    for entry in trend.cycles() {
        let _ = writeln!(
            text,
            "{}",
            COLUMNS.map(|(_, of)| field(of(entry))).join(",")
        );
    }
    text
}

/// The last cycle, in the columns of a measured loop.
fn last_loop(session: &Session, trend: &Trend) -> String {
    let mut text = format!("{}cycle,u_m,F_N\n", lines(session));
    for row in trend.loop_rows() {
        let _ = writeln!(text, "{}", row.map(field).join(","));
    }
    text
}

fn field(value: f64) -> String {
    match value.is_finite() {
        true => number(value),
        false => String::new(),
    }
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

/// Opens the state in a directory.
///
/// # Errors
/// One line: a directory without such a state, a checkpoint that is torn or of another version.
pub fn open(directory: &Path) -> Result<Opened, String> {
    let Some(path) = checkpoint_in(directory) else {
        let shown = printable(&directory.display().to_string());
        return Err(format!(
            "{shown}: is a directory without a {CHECKPOINT} to go on from; its scenario.toml starts anew"
        ));
    };
    let kept = checkpoint::read::<IgnoredAny>(&path).map_err(|error| error.to_string())?;
    let session = kept.session;
    let moment = session.simulation().moment();
    let trend = past(directory, moment.cycle, moment.initial_volume).unwrap_or_else(|| {
        let mut trend = Trend::default();
        super::ghosts::record(&mut trend, &session);
        trend
    });
    Ok(Opened { session, trend })
}

/// The past up to `cycle` as the tables beside a checkpoint tell of it.
fn past(directory: &Path, cycle: f64, initial: f64) -> Option<Trend> {
    let table = |name: &str| Columns::read(&directory.join(name)).ok();
    let history = table("history.csv")?;
    let column = |name: &str, quantity| {
        let values = history.column_with_gaps(name, quantity);
        values.unwrap_or_else(|| vec![f64::NAN; history.rows()])
    };
    let cycles = column("cycle", Quantity::Number);
    let contact = column("contact_radius", Quantity::Length);
    let stick = column("permanent_stick_radius", Quantity::Length);
    let volume = column("wear_volume", Quantity::Volume);
    let depth = column("scar_depth", Quantity::Length);
    let radius = column("scar_radius", Quantity::Length);
    let energy = column("dissipated_energy", Quantity::Energy);
    let residual = column("period_energy_residual", Quantity::Number);
    let entries = (0..history.rows()).filter(|&row| cycles[row] <= cycle);
    let entries = entries.map(|row| Cycle {
        cycle: cycles[row],
        contact_radius: contact[row],
        stick_radius: stick[row],
        wear_volume: volume[row],
        scar_depth: depth[row],
        scar_radius: radius[row],
        dissipated_energy: energy[row],
        residual: residual[row],
        ..Cycle::UNKNOWN
    });
    let rows = table("loop.csv").and_then(|table| {
        let cycles = table.column_with_gaps("cycle", Quantity::Number)?;
        let shifts = table.column_with_gaps("u", Quantity::Length)?;
        let forces = table.column_with_gaps("F", Quantity::Force)?;
        let rows = 0..cycles.len();
        Some(
            rows.map(|row| [cycles[row], shifts[row], forces[row]])
                .collect(),
        )
    });
    Some(Trend::of_past(entries, rows.unwrap_or_default(), initial))
}

//! What `s` writes: the state, and the scenario that reproduces it.

use std::path::PathBuf;

use crate::export::file::{RunDirectory, WriteError};
use crate::export::header::number;
use crate::export::state;
use crate::scenario::session::Session;

/// Writes `state.csv` and `scenario.toml` of `session` to a new directory, with the user's note, and
/// returns the path of the state.
pub(super) fn write(session: &Session, note: Option<&str>) -> Result<PathBuf, WriteError> {
    let noted = note.map(|note| session.noted(note));
    let session = noted.as_ref().unwrap_or(session);
    let cycle = number(session.simulation().cycle());
    let stem = session.loaded().stem();
    let directory = RunDirectory::claim_new(&format!("{stem}-cycle-{cycle}"))?;
    let scenario = session.as_run(Vec::new()).to_toml();
    directory.write("scenario.toml", scenario.as_bytes())?;
    let path = directory.write("state.csv", state::table(session).as_bytes())?;
    Ok(path.components().collect())
}

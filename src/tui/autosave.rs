//! The explorer's checkpoints: on a timer while something changes, and on exit.

use std::path::PathBuf;
use std::time::Duration;

use crate::export::autosave::{Autosave, Recent};
use crate::export::file::shell_path;
use crate::export::header::number;
use crate::scenario::checkpoint;
use crate::scenario::session::Session;

/// Saves a session.
#[derive(Debug)]
pub struct ScreenAutosave {
    autosave: Autosave,
    /// The state last saved or loaded.
    kept: Mark,
    /// The session a moment ago.
    copy: Recent<Session>,
    /// Whether nothing more is saved: the session has ended, or there is no directory.
    is_finished: bool,
}

/// Distinguishes the states of a run: steps, cycle, and number of changes.
type Mark = (u64, f64, usize);

/// Returns the mark of the present state of `session`.
pub(super) fn mark(session: &Session) -> Mark {
    let simulation = session.simulation();
    let changes = session.changes().len();
    (simulation.steps(), simulation.cycle(), changes)
}

impl ScreenAutosave {
    /// Saves `session` in `directory`, once per interval `every` while it changes, or only at the end if `every` is 0.
    /// Without a directory, nothing is saved.
    pub fn new(directory: Option<PathBuf>, every: Duration, session: &Session) -> Self {
        Self {
            is_finished: directory.is_none(),
            autosave: Autosave::new(None, directory, every),
            kept: mark(session),
            copy: Recent::new(session.clone()),
        }
    }

    /// Returns the time until a checkpoint is due; `None` while there is nothing new to save.
    pub fn time_until_due(&self, session: &Session) -> Option<Duration> {
        let wait = self
            .autosave
            .time_until_due()
            .filter(|_| !self.is_finished)?;
        (self.kept != mark(session)).then_some(wait)
    }

    /// Saves if due; returns a message when saving begins to fail.
    pub fn save_if_due(&mut self, session: &Session) -> Option<String> {
        if self.is_finished {
            return None;
        }
        self.copy.refresh(|| session.clone());
        match self.time_until_due(session) {
            Some(Duration::ZERO) => self.save(session),
            _ => None,
        }
    }

    /// Saves this session and switches to another one, whose checkpoints replace its own from the first step on.
    pub fn begin_session(&mut self, from: &Session, to: &Session) {
        if self.is_finished {
            return;
        }
        self.save(from);
        self.kept = mark(to);
        self.copy = Recent::new(to.clone());
    }

    /// Saves `session`, or the copy after a bug, and returns the message for the user. Only the first call has an
    /// effect.
    pub fn finish(&mut self, session: Option<&Session>) -> Option<String> {
        if std::mem::replace(&mut self.is_finished, true) {
            return None;
        }
        let copy = self.copy.get().clone();
        self.save(session.unwrap_or(&copy));
        self.autosave.end();
        let place = self.autosave.kept().map(|(path, cycle)| {
            let (cycle, path) = (number(cycle), shell_path(path));
            format!("saved at cycle {cycle}; resume with: mdr-tui --resume {path}")
        });
        match (self.autosave.failure(), place) {
            (None, place) => place,
            (Some(failure), Some(place)) => Some(format!("{failure}; {place}")),
            (Some(failure), None) => Some(format!("nothing was saved: {failure}")),
        }
    }

    /// Saves a session unless it is already saved; returns a message when saving begins to fail.
    fn save(&mut self, session: &Session) -> Option<String> {
        if self.kept == mark(session) {
            return None;
        }
        let checkpoint = checkpoint::encode(session, None::<&()>);
        let word = self.autosave.save(session, &checkpoint);
        if self.autosave.failure().is_none() {
            self.kept = mark(session);
        }
        word
    }
}

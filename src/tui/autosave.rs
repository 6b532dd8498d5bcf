//! Checkpoints of an explorer: on a timer while something changes, and on exit.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use crate::export::autosave::{Autosave, COPY_INTERVAL};
use crate::export::file::{WriteError, shell_word};
use crate::export::header::number;
use crate::scenario::checkpoint;
use crate::scenario::session::Session;

/// Saves a session.
#[derive(Debug)]
pub struct ScreenAutosave {
    directory: PathBuf,
    every: Option<Duration>,
    /// `None` until there is something to save.
    autosave: Option<Autosave>,
    /// What was last saved or loaded.
    kept: Mark,
    /// When the last checkpoint was due.
    since: Instant,
    /// The session a moment ago, and the moment.
    copy: Session,
    copied: Instant,
    /// The last attempt failed, and how.
    failure: Option<String>,
    /// The session is at its end.
    is_finished: bool,
}

/// Identifies a state of a session.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Mark {
    steps: u64,
    cycle: u64,
    changes: usize,
}

impl Mark {
    fn of(session: &Session) -> Self {
        let simulation = session.simulation();
        Self {
            steps: simulation.steps(),
            cycle: simulation.cycle().to_bits(),
            changes: session.changes().len(),
        }
    }
}

impl ScreenAutosave {
    /// Saves `session` in `directory`, once per interval `every` while it changes, or only at the
    /// end if `None`.
    pub fn new(directory: PathBuf, every: Option<Duration>, session: &Session) -> Self {
        Self {
            directory,
            every,
            autosave: None,
            kept: Mark::of(session),
            since: Instant::now(),
            copy: session.clone(),
            copied: Instant::now(),
            failure: None,
            is_finished: false,
        }
    }

    /// Time until a checkpoint is due; `None` while there is nothing new to save.
    pub fn wait(&self, session: &Session) -> Option<Duration> {
        let every = self.every?;
        (self.kept != Mark::of(session)).then(|| every.saturating_sub(self.since.elapsed()))
    }

    /// Saves what is due; returns a message when that begins to fail.
    pub fn look_after(&mut self, session: &Session) -> Option<String> {
        if self.is_finished {
            return None;
        }
        if self.copied.elapsed() >= COPY_INTERVAL {
            self.copy = session.clone();
            self.copied = Instant::now();
        }
        if self.wait(session) != Some(Duration::ZERO) {
            return None;
        }
        let had_failed = self.failure.is_some();
        self.keep(session);
        let failure = self.failure.as_ref().filter(|_| !had_failed)?;
        Some(format!("{failure}; the run continues without a checkpoint"))
    }

    /// Switches to another session; the file of this one stays.
    pub fn turn_over(&mut self, from: &Session, to: &Session) {
        if self.is_finished {
            return;
        }
        if self.kept != Mark::of(from) {
            self.keep(from);
        }
        (self.autosave, self.kept) = (None, Mark::of(to));
        self.copy = to.clone();
    }

    /// Saves `session`, or the copy after a bug, and returns the message for the user. Only the
    /// first call does anything.
    pub fn finish(&mut self, session: Option<&Session>) -> Option<String> {
        if std::mem::replace(&mut self.is_finished, true) {
            return None;
        }
        let copy = self.copy.clone();
        let session = session.unwrap_or(&copy);
        if self.kept != Mark::of(session) {
            self.keep(session);
        }
        let place = self.autosave.as_ref().map(|autosave| {
            let (cycle, path) = (f64::from_bits(self.kept.cycle), shell_word(autosave.path()));
            format!(
                "saved at cycle {}; resume with: mdr-tui --resume {path}",
                number(cycle)
            )
        });
        match (self.failure.take(), place) {
            (None, place) => place,
            (Some(failure), Some(place)) => Some(format!("{failure}; {place}")),
            (Some(failure), None) => Some(format!("nothing was saved: {failure}")),
        }
    }

    fn keep(&mut self, session: &Session) {
        let written = self.write(session);
        self.since = Instant::now();
        self.failure = written.err().map(|error| error.to_string());
        if self.failure.is_none() {
            self.kept = Mark::of(session);
        } else {
            self.autosave = self.autosave.take().and_then(Autosave::if_ever);
        }
    }

    fn write(&mut self, session: &Session) -> Result<(), WriteError> {
        let autosave = match &mut self.autosave {
            Some(autosave) => autosave,
            none => {
                let stem = session.loaded().stem();
                none.insert(Autosave::in_free_place(&self.directory, &stem, self.every)?)
            }
        };
        autosave.keep(&checkpoint::encode(session, None::<&()>))
    }
}

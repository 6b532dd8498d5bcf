//! Checkpoints of an explorer: on a timer while something has changed, and at every end.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use crate::export::autosave::{Autosave, COPY_INTERVAL};
use crate::export::file::{WriteError, shell_word};
use crate::export::header::number;
use crate::scenario::checkpoint;
use crate::scenario::session::Session;

/// Keeps a session.
#[derive(Debug)]
pub struct ScreenAutosave {
    directory: PathBuf,
    every: Option<Duration>,
    /// None until there was something to keep.
    autosave: Option<Autosave>,
    /// What was last kept, or taken up.
    kept: Mark,
    /// Since when checkpoints are due.
    since: Instant,
    /// The session a moment ago, and the moment.
    copy: Session,
    copied: Instant,
    /// The last attempt failed, and how.
    failure: Option<String>,
    /// The session is at its end.
    is_finished: bool,
}

/// Tells one state of a session from another.
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
    /// Keeps `session` in `directory`, `every` so often while it changes; if none, at the end.
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

    /// How long until a checkpoint is due; none while there is nothing new to keep.
    pub fn wait(&self, session: &Session) -> Option<Duration> {
        let every = self.every?;
        (self.kept != Mark::of(session)).then(|| every.saturating_sub(self.since.elapsed()))
    }

    /// Keeps what is due; a word for the user where that begins to fail.
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
        Some(format!("{failure}; the run goes on without a checkpoint"))
    }

    /// Another session takes the place of this one, which stays where it is kept.
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

    /// Keeps `session`, or after a defect the copy; what there is to say of it. Only the first call
    /// does anything.
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
                "kept at cycle {}; mdr-tui --resume {path} goes on",
                number(cycle)
            )
        });
        match (self.failure.take(), place) {
            (None, place) => place,
            (Some(failure), Some(place)) => Some(format!("{failure}; {place}")),
            (Some(failure), None) => Some(format!("nothing is kept: {failure}")),
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

//! Where a run keeps its checkpoints: in its own directory or, while that takes none, where explorers
//! keep theirs.

use std::path::{Path, PathBuf};
use std::time::Duration;

use super::job::RunJob;
use crate::export::autosave::{Autosave, state_directory};
use crate::export::file::shell_word;
use crate::export::header::number;
use crate::scenario::checkpoint;
use crate::scenario::session::Session;

/// Keeps the newest state of a run wherever there is room.
#[derive(Debug)]
pub struct Keeper {
    home: Autosave,
    /// In use since the last attempt at home failed.
    elsewhere: Option<Autosave>,
    /// The newest checkpoint, and its cycle.
    kept: Option<(PathBuf, f64)>,
    /// Whether the user knows where checkpoints go, and that they fail if they do.
    has_warned: bool,
}

impl Keeper {
    /// Keeps checkpoints at `path`, due `every` so often; if none, only when asked for.
    pub fn new(path: PathBuf, every: Option<Duration>) -> Self {
        Self {
            home: Autosave::new(path, every),
            elsewhere: None,
            kept: None,
            has_warned: false,
        }
    }

    /// Takes note of the checkpoint that the run goes on from.
    pub fn remember(&mut self, path: &Path, cycle: f64) {
        self.kept = Some((path.to_owned(), cycle));
    }

    /// Whether it is time for the next checkpoint.
    pub fn is_due(&self) -> bool {
        self.home.is_due()
    }

    /// Writes a checkpoint; a word for the user where that begins to fail, or to go elsewhere.
    pub fn keep(&mut self, session: &Session, job: &RunJob) -> Option<String> {
        let bytes = checkpoint::encode(session, Some(job));
        let cycle = session.simulation().cycle();
        let Err(error) = self.home.keep(&bytes) else {
            self.kept = Some((self.home.path().to_owned(), cycle));
            if let Some(elsewhere) = self.elsewhere.take() {
                elsewhere.discard();
            }
            self.has_warned = false;
            return None;
        };
        let word = match self.keep_elsewhere(&session.loaded().stem(), &bytes) {
            Some(path) => {
                let word = format!("{error}; checkpoints go to {}", path.display());
                self.kept = Some((path, cycle));
                word
            }
            None => format!("{error}; the run goes on without a checkpoint"),
        };
        (!std::mem::replace(&mut self.has_warned, true)).then_some(word)
    }

    fn keep_elsewhere(&mut self, stem: &str, bytes: &[u8]) -> Option<PathBuf> {
        if self.elsewhere.is_none() {
            let place = Autosave::in_free_place(&state_directory()?, stem, None);
            self.elsewhere = place.ok();
        }
        let elsewhere = self.elsewhere.as_mut()?;
        let path = elsewhere.path().to_owned();
        if elsewhere.keep(bytes).is_ok() {
            return Some(path);
        }
        // What was kept there before is better than nothing.
        self.elsewhere = self.elsewhere.take().and_then(Autosave::if_ever);
        None
    }

    /// How to go on with a run that has stopped at the cycle `now`, and from where on nothing of it is
    /// kept.
    pub fn way_on(&self, now: f64) -> String {
        let kept = self.kept.as_ref().filter(|(path, _)| path.exists());
        let Some((path, cycle)) = kept else {
            return "there is no checkpoint".into();
        };
        let path = shell_word(path);
        if *cycle == now {
            return format!("mdr-tui run --resume {path} goes on");
        }
        let (cycle, now) = (number(*cycle), number(now));
        format!(
            "mdr-tui run --resume {path} goes on from cycle {cycle}: nothing between there and cycle \
             {now} could be kept"
        )
    }
}

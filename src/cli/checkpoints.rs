//! Where a run saves its checkpoints: in its own directory or, while that fails, in the directory
//! of the explorer's checkpoints.

use std::path::{Path, PathBuf};
use std::time::Duration;

use super::job::RunJob;
use crate::export::autosave::{Autosave, state_directory};
use crate::export::file::shell_word;
use crate::export::header::number;
use crate::scenario::checkpoint;
use crate::scenario::session::Session;

/// Saves the newest state of a run wherever there is room.
#[derive(Debug)]
pub struct Checkpoints {
    home: Autosave,
    /// In use since the last attempt at home failed.
    elsewhere: Option<Autosave>,
    /// The newest checkpoint, and its cycle.
    kept: Option<(PathBuf, f64)>,
    /// Whether the user has been told that checkpoints fail or go elsewhere.
    has_warned: bool,
}

impl Checkpoints {
    /// Saves checkpoints at `path`, one per interval `every`, or only on request if `None`.
    pub fn new(path: PathBuf, every: Option<Duration>) -> Self {
        Self {
            home: Autosave::new(path, every),
            elsewhere: None,
            kept: None,
            has_warned: false,
        }
    }

    /// Notes the checkpoint that the run continues from.
    pub fn remember(&mut self, path: &Path, cycle: f64) {
        self.kept = Some((path.to_owned(), cycle));
    }

    /// Whether it is time for the next checkpoint.
    pub fn is_due(&self) -> bool {
        self.home.is_due()
    }

    /// Writes a checkpoint; returns a message when that begins to fail or to go elsewhere.
    pub fn save(&mut self, session: &Session, job: &RunJob) -> Option<String> {
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
        let word = match self.save_elsewhere(&session.loaded().stem(), &bytes) {
            Some(path) => {
                let word = format!("{error}; checkpoints go to {}", path.display());
                self.kept = Some((path, cycle));
                word
            }
            None => format!("{error}; the run continues without a checkpoint"),
        };
        (!std::mem::replace(&mut self.has_warned, true)).then_some(word)
    }

    fn save_elsewhere(&mut self, stem: &str, bytes: &[u8]) -> Option<PathBuf> {
        if self.elsewhere.is_none() {
            let place = Autosave::in_free_place(&state_directory()?, stem, None);
            self.elsewhere = place.ok();
        }
        let elsewhere = self.elsewhere.as_mut()?;
        let path = elsewhere.path().to_owned();
        if elsewhere.keep(bytes).is_ok() {
            return Some(path);
        }
        // An older checkpoint there is better than nothing.
        self.elsewhere = self.elsewhere.take().and_then(Autosave::if_ever);
        None
    }

    /// Says how to resume a run that stopped at the cycle `now`, and which cycles are lost.
    pub fn how_to_resume(&self, now: f64) -> String {
        let kept = self.kept.as_ref().filter(|(path, _)| path.exists());
        let Some((path, cycle)) = kept else {
            return "there is no checkpoint".into();
        };
        let path = shell_word(path);
        if *cycle == now {
            return format!("resume with: mdr-tui run --resume {path}");
        }
        let (cycle, now) = (number(*cycle), number(now));
        format!(
            "resume from cycle {cycle} with: mdr-tui run --resume {path} \
             (cycles up to {now} could not be saved)"
        )
    }
}

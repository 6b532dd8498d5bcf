//! Checkpoints on a timer: one file, replaced each time, whole or not at all; and a copy in memory.

use std::fs::{self, File, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime};

use super::claim::{is_at, try_lock};
use super::file::{WriteError, sweep, write_with};
use super::own;
use crate::scenario::session::Session;

/// Maximum age of the copy in memory that survives a bug.
const COPY_INTERVAL: Duration = Duration::from_millis(100);

/// The ending of a checkpoint's name.
const ENDING: &str = "checkpoint";

/// Maximum number of the explorer's checkpoints; the oldest are removed.
const KEPT: usize = 20;

/// A temporary file of this age is abandoned.
const STALE: Duration = Duration::from_secs(3600);

/// The newest state of a session on disk: in the file of its run or, while that fails, in a free one of a directory.
#[derive(Debug)]
pub struct Autosave {
    /// The run's own file.
    home: Option<Place>,
    /// Where free places are.
    directory: Option<PathBuf>,
    /// In use since the last attempt at home failed, or where there is none.
    elsewhere: Option<Place>,
    every: Option<Duration>,
    last: Instant,
    /// The newest checkpoint, and its cycle.
    kept: Option<(PathBuf, f64)>,
    failure: Option<String>,
}

impl Autosave {
    /// Saves in a free place of `directory`, once per interval `every`, or only on request if `None`.
    pub fn new(directory: Option<PathBuf>, every: Option<Duration>) -> Self {
        Self {
            home: None,
            directory,
            elsewhere: None,
            every,
            last: Instant::now(),
            kept: None,
            failure: None,
        }
    }

    /// Saves at `path`, and elsewhere only while that fails.
    #[must_use]
    pub fn at_home(mut self, path: PathBuf) -> Self {
        self.home = Some(Place { path, file: None });
        self
    }

    /// Notes the checkpoint that the session continues from.
    pub fn remember(&mut self, path: &Path, cycle: f64) {
        self.kept = Some((path.to_owned(), cycle));
    }

    /// Time until the next checkpoint is due; `None` if only on request.
    pub fn wait(&self) -> Option<Duration> {
        let every = self.every?;
        Some(every.saturating_sub(self.last.elapsed()))
    }

    /// Whether it is time for the next.
    pub fn is_due(&self) -> bool {
        self.wait() == Some(Duration::ZERO)
    }

    /// Writes `checkpoint`, which holds `session`; returns a message when that begins to fail or to go elsewhere. The
    /// next one is due an interval later, even if this fails.
    pub fn save(&mut self, session: &Session, checkpoint: &[u8]) -> Option<String> {
        let word = self.try_to_save(session, checkpoint);
        self.last = Instant::now();
        word
    }

    fn try_to_save(&mut self, session: &Session, checkpoint: &[u8]) -> Option<String> {
        let cycle = session.simulation().cycle();
        let at_home = self.home.as_mut().map(|home| home.write(checkpoint));
        if let Some(Ok(path)) = at_home {
            (self.kept, self.failure) = (Some((path, cycle)), None);
            if let Some(elsewhere) = self.elsewhere.take() {
                elsewhere.discard();
            }
            return None;
        }
        let at_home = at_home.and_then(Result::err);
        let (error, outcome) = match (at_home, self.save_elsewhere(session, checkpoint)) {
            (error, Some(Ok(path))) => {
                let outcome = format!("checkpoints go to {}", path.display());
                self.kept = Some((path, cycle));
                (error, outcome)
            }
            (error, elsewhere) => {
                let elsewhere = elsewhere.and_then(Result::err);
                let outcome = "the run continues without a checkpoint".to_owned();
                (error.or(elsewhere), outcome)
            }
        };
        let had_failed = self.failure.is_some();
        self.failure = error.map(|error| error.to_string());
        let failure = self.failure.as_ref().filter(|_| !had_failed)?;
        Some(format!("{failure}; {outcome}"))
    }

    /// `None` without a directory.
    fn save_elsewhere(
        &mut self,
        session: &Session,
        checkpoint: &[u8],
    ) -> Option<Result<PathBuf, WriteError>> {
        let place = match self.elsewhere.take() {
            Some(place) => Ok(place),
            None => Place::free(self.directory.as_deref()?, &session.loaded().stem()),
        };
        let mut place = match place {
            Ok(place) => place,
            Err(error) => return Some(Err(error)),
        };
        let kept = place.write(checkpoint);
        // An older checkpoint there is better than nothing.
        self.elsewhere = match kept {
            Ok(_) => Some(place),
            Err(_) => place.if_ever(),
        };
        Some(kept)
    }

    /// Continues with another session; the checkpoint of this one stays.
    pub fn turn_over(&mut self) {
        (self.elsewhere, self.kept) = (None, None);
    }

    /// The newest checkpoint that is still there, and its cycle.
    pub fn kept(&self) -> Option<(&Path, f64)> {
        let (path, cycle) = self.kept.as_ref()?;
        path.exists().then_some((path, *cycle))
    }

    /// Why the last checkpoint could not be saved in its place.
    pub fn failure(&self) -> Option<&str> {
        self.failure.as_deref()
    }
}

/// A copy of what is computed that survives a bug: never older than [`COPY_INTERVAL`] where it is refreshed at every step.
#[derive(Debug)]
pub struct Recent<T> {
    copy: T,
    at: Instant,
}

impl<T> Recent<T> {
    /// The first copy.
    pub fn new(copy: T) -> Self {
        Self {
            copy,
            at: Instant::now(),
        }
    }

    /// The copy.
    pub fn get(&self) -> &T {
        &self.copy
    }

    /// Replaces the copy by what `make` makes, if it is too old.
    pub fn refresh(&mut self, make: impl FnOnce() -> T) {
        if self.at.elapsed() >= COPY_INTERVAL {
            *self = Self::new(make());
        }
    }
}

/// A file that each checkpoint replaces.
#[derive(Debug)]
struct Place {
    path: PathBuf,
    /// Locked as long as it is open, so that others see a running process owns the file.
    file: Option<File>,
}

impl Place {
    /// A new file for a session on a scenario called `stem`: creates the directory, in which only the newest
    /// checkpoints stay beside it and those of running sessions. A number that was given out is not given out
    /// again.
    fn free(directory: &Path, stem: &str) -> Result<Self, WriteError> {
        let failed = |cause| WriteError::Io {
            path: directory.to_owned(),
            cause,
        };
        fs::create_dir_all(directory).map_err(failed)?;
        sweep(directory, STALE);
        let others = checkpoints(directory).map_err(failed)?;
        let highest = others.iter().map(|other| other.number).max();
        prune(others, highest);
        for number in highest.unwrap_or(0) + 1.. {
            let path = directory.join(format!("{stem}-{number}.{ENDING}"));
            // An empty file claims the name, so that two explorers never share one.
            match File::create_new(&path) {
                Ok(file) => {
                    let _ = try_lock(&file);
                    let file = Some(file);
                    return Ok(Self { path, file });
                }
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(failed(error)),
            }
        }
        unreachable!("the number of names is unlimited")
    }

    /// Replaces the checkpoint, and says where it is.
    fn write(&mut self, checkpoint: &[u8]) -> Result<PathBuf, WriteError> {
        let written = write_with(&self.path, |file| file.write_all(checkpoint));
        // The new file is locked before the lock on the old one is given up.
        self.file = Some(written?);
        Ok(self.path.clone())
    }

    /// Returns itself, unless nothing was ever saved: then removes its empty file.
    fn if_ever(self) -> Option<Self> {
        if fs::metadata(&self.path).is_ok_and(|about| about.len() > 0) {
            return Some(self);
        }
        self.discard();
        None
    }

    /// Removes the checkpoint, which another one has replaced.
    fn discard(self) {
        let _ = fs::remove_file(self.path);
    }
}

/// Removes the oldest checkpoints, except those of running sessions and the one with the highest
/// number, so that the next number is new.
fn prune(mut others: Vec<Found>, highest: Option<u64>) {
    others.sort_by_key(|other| other.written);
    let mut excess = (others.len() + 1).saturating_sub(KEPT);
    for other in others {
        if excess == 0 {
            return;
        }
        if Some(other.number) == highest {
            continue;
        }
        let Ok(file) = own::open(&other.path, false) else {
            continue;
        };
        let is_live = matches!(try_lock(&file), Err(TryLockError::WouldBlock));
        if !is_live && is_at(&file, &other.path) {
            // One that cannot be removed does no harm.
            let _ = fs::remove_file(&other.path);
            excess -= 1;
        }
    }
}

/// A checkpoint in a directory.
#[derive(Debug)]
struct Found {
    path: PathBuf,
    written: SystemTime,
    /// The number at the end of its name; 0 if there is none.
    number: u64,
}

/// The checkpoints in a directory.
fn checkpoints(directory: &Path) -> io::Result<Vec<Found>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(directory)? {
        let path = entry?.path();
        let is_one = path.extension().is_some_and(|ending| ending == ENDING);
        // Skips files that have disappeared in the meantime.
        if let (true, Ok(about)) = (is_one, fs::metadata(&path)) {
            let stem = path.file_stem().map(|stem| stem.to_string_lossy());
            let number = stem.and_then(|stem| stem.rsplit_once('-')?.1.parse().ok());
            found.push(Found {
                written: about.modified()?,
                number: number.unwrap_or(0),
                path,
            });
        }
    }
    Ok(found)
}

/// Directory of the explorer's checkpoints; `None` without a home directory.
pub fn state_directory() -> Option<PathBuf> {
    own::directory("XDG_STATE_HOME", ".local/state")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;

    /// A session that comes, is kept, and goes.
    fn come_and_go(directory: &Path, stem: &str) -> PathBuf {
        let mut place = Place::free(directory, stem).expect("a place");
        place.write(stem.as_bytes()).expect("a file");
        place.path.clone()
    }

    #[test]
    fn checkpoints_do_not_pile_up() {
        let base = tempfile::tempdir().expect("a directory");
        let directory = base.path().join("state/mdr-tui");
        let mut places = Vec::new();
        for _ in 0..50 {
            places.push(come_and_go(&directory, "hertz"));
        }
        let left = checkpoints(&directory).expect("a directory");
        assert_eq!(left.len(), KEPT);
        assert!(left.iter().any(|found| Some(&found.path) == places.last()));
        fs::write(directory.join("notes.txt"), b"mine").expect("a file");
        come_and_go(&directory, "cone");
        assert!(directory.join("notes.txt").exists());
    }

    #[test]
    fn a_living_session_keeps_its_file_and_no_name_is_given_out_twice() {
        let base = tempfile::tempdir().expect("a directory");
        let mut paused = Place::free(base.path(), "hertz").expect("a place");
        paused.write(b"paused").expect("a file");
        let unkept = Place::free(base.path(), "hertz").expect("a place");
        let mut names = vec![paused.path.clone(), unkept.path.clone()];
        for round in 0..60 {
            names.push(come_and_go(base.path(), ["hertz", "cone"][round % 2]));
        }
        assert_eq!(fs::read(&paused.path).expect("its file"), b"paused");
        assert!(unkept.path.exists());
        paused.write(b"later").expect("a file");
        come_and_go(base.path(), "hertz");
        assert_eq!(fs::read(&paused.path).expect("its file"), b"later");
        let count = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), count, "a name was given out twice");
        // Once it is gone, its file is like any other.
        let path = paused.path.clone();
        drop(paused);
        for _ in 0..KEPT + 2 {
            come_and_go(base.path(), "hertz");
        }
        assert!(!path.exists());
    }

    #[test]
    fn a_checkpoint_is_due_when_its_time_has_come() {
        let base = tempfile::tempdir().expect("a directory");
        let path = base.path().join("run.checkpoint");
        let every = |every| Autosave::new(None, every).at_home(path.clone());
        assert!(!every(None).is_due());
        assert!(!every(Some(Duration::from_secs(60))).is_due());
        let mut always = every(Some(Duration::ZERO));
        assert!(always.is_due());
        let scenario = Scenario::load("hertz", &[]).expect("a preset");
        let session = Session::start(scenario).expect("a contact");
        for bytes in [b"one", b"two"] {
            assert_eq!(always.save(&session, bytes), None);
        }
        assert_eq!(fs::read(&path).expect("the file"), b"two");
        assert_eq!(always.kept(), Some((path.as_path(), 0.0)));
    }

    #[test]
    fn what_cannot_be_saved_at_home_goes_elsewhere_and_comes_back_and_is_told_once() {
        let base = tempfile::tempdir().expect("a directory");
        let home = base.path().join("run/run.checkpoint");
        let mut autosave = Autosave::new(Some(base.path().join("state")), None);
        autosave = autosave.at_home(home.clone());
        let scenario = Scenario::load("hertz", &[]).expect("a preset");
        let session = Session::start(scenario).expect("a contact");
        let word = autosave.save(&session, b"one").expect("a word");
        assert!(word.contains("; checkpoints go to "), "{word}");
        assert_eq!(autosave.save(&session, b"two"), None);
        let elsewhere = autosave.kept().expect("a checkpoint").0.to_owned();
        assert_eq!(fs::read(&elsewhere).expect("the file"), b"two");
        fs::create_dir(base.path().join("run")).expect("a directory");
        assert_eq!(autosave.save(&session, b"three"), None);
        assert_eq!(autosave.kept(), Some((home.as_path(), 0.0)));
        assert!(!elsewhere.exists());
    }
}

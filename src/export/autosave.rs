//! Checkpoints on a timer: one file, replaced as a whole each time, and a copy in memory.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime};

use super::file::{INTERNAL, WriteError, sweep};
use super::run_directory::{RUN_CHECKPOINT, RunDirectory};
use super::target::Target;
use crate::scenario::session::Session;

/// Maximum age of the copy in memory that survives a bug.
const COPY_INTERVAL: Duration = Duration::from_millis(100);

/// The ending of a checkpoint's name.
const ENDING: &str = "checkpoint";

/// Maximum number of the explorer's checkpoints; the oldest are removed.
const KEPT: usize = 20;

/// Maximum number of names tried for a new checkpoint.
const MOST_AT_ONCE: u64 = 1000;

/// The largest number in a checkpoint's name. Names with larger numbers were not made by this program.
const LARGEST_NUMBER: u64 = 1_000_000_000_000;

/// Temporary files older than this are considered abandoned.
const STALE: Duration = Duration::from_secs(3600);

/// Keeps the newest state of a session on disk: in the file of its run or, if that fails, in a new file in a directory.
#[derive(Debug)]
pub struct Autosave {
    /// The run's own directory.
    home: Option<RunDirectory>,
    /// Where free places are.
    directory: Option<PathBuf>,
    /// The fallback file, in use since `home` failed or if there is no `home`.
    elsewhere: Option<Target>,
    /// The interval; 0 saves only on request.
    every: Duration,
    last: Instant,
    /// The newest checkpoint, and its cycle.
    kept: Option<(PathBuf, f64)>,
    failure: Option<String>,
}

impl Autosave {
    /// Saves to `home`; falls back to a new file in `directory`. Once per interval `every`, or only on request if that
    /// is 0.
    pub fn new(home: Option<RunDirectory>, directory: Option<PathBuf>, every: Duration) -> Self {
        Self {
            home,
            directory,
            elsewhere: None,
            every,
            last: Instant::now(),
            kept: None,
            failure: None,
        }
    }

    /// Notes the checkpoint that the session continues from.
    pub fn remember(&mut self, path: &Path, cycle: f64) {
        self.kept = Some((path.to_owned(), cycle));
    }

    /// Time until the next checkpoint is due; `None` if only on request.
    pub fn time_until_due(&self) -> Option<Duration> {
        let left = self.every.saturating_sub(self.last.elapsed());
        (!self.every.is_zero()).then_some(left)
    }

    /// Whether the next checkpoint is due.
    pub fn is_due(&self) -> bool {
        self.time_until_due() == Some(Duration::ZERO)
    }

    /// Writes `checkpoint`, the state of `session`. Returns a message when saving begins to fail or moves to the
    /// fallback. The next checkpoint is due one interval later, even if this one fails.
    pub fn save(&mut self, session: &Session, checkpoint: &[u8]) -> Option<String> {
        let (mut saved, mut failure) = (None, None);
        if let Some(home) = &self.home {
            match home.write(RUN_CHECKPOINT, checkpoint) {
                Ok(()) => saved = Some(home.checkpoint()),
                Err(error) => failure = Some(error.to_string()),
            }
        }
        if saved.is_none() {
            match self.save_elsewhere(&session.loaded().stem(), checkpoint) {
                Ok(place) => saved = place,
                Err(error) => failure = failure.or(Some(error.to_string())),
            }
        } else if let Some(elsewhere) = self.elsewhere.take() {
            let _ = fs::remove_file(elsewhere.path());
        }
        self.last = Instant::now();
        let outcome = match &saved {
            Some(path) => format!("checkpoints go to {}", path.display()),
            None => "the run continues without a checkpoint".to_owned(),
        };
        if let Some(path) = saved {
            self.kept = Some((path, session.simulation().cycle()));
        }
        let had_failed = std::mem::replace(&mut self.failure, failure).is_some();
        let failure = self.failure.as_ref().filter(|_| !had_failed)?;
        Some(format!("{failure}; {outcome}"))
    }

    /// Writes the checkpoint into the fallback file; `None` without a directory.
    fn save_elsewhere(
        &mut self,
        stem: &str,
        checkpoint: &[u8],
    ) -> Result<Option<PathBuf>, WriteError> {
        let place = match (self.elsewhere.take(), &self.directory) {
            (Some(place), _) => place,
            (None, Some(directory)) => claim_new_file(directory, stem)?,
            (None, None) => return Ok(None),
        };
        let path = place.path().to_owned();
        // If writing fails, an older checkpoint in this place is better than nothing.
        self.elsewhere.insert(place).write(checkpoint)?;
        Ok(Some(path))
    }

    /// Continues with another session; keeps the checkpoint of the previous one.
    pub fn begin_session(&mut self) {
        (self.elsewhere, self.kept) = (None, None);
    }

    /// Returns the newest checkpoint that still exists, and its cycle.
    pub fn kept(&self) -> Option<(&Path, f64)> {
        let (path, cycle) = self.kept.as_ref()?;
        path.exists().then_some((path, *cycle))
    }

    /// Returns why the last checkpoint could not be saved in its proper place.
    pub fn failure(&self) -> Option<&str> {
        self.failure.as_deref()
    }
}

/// A copy of computed data that survives a bug; at most `COPY_INTERVAL` old if refreshed at every step.
#[derive(Debug)]
pub struct Recent<T> {
    copy: T,
    at: Instant,
}

impl<T> Recent<T> {
    /// Makes the first copy.
    pub fn new(copy: T) -> Self {
        Self {
            copy,
            at: Instant::now(),
        }
    }

    /// Returns the copy.
    pub fn get(&self) -> &T {
        &self.copy
    }

    /// Replaces the copy with the result of `make` if it is too old.
    pub fn refresh(&mut self, make: impl FnOnce() -> T) {
        if self.at.elapsed() >= COPY_INTERVAL {
            *self = Self::new(make());
        }
    }
}

/// Claims a new file for a session on a scenario called `stem`, numbered above all checkpoints in the directory.
/// Creates the directory, and removes old checkpoints of finished sessions from it.
fn claim_new_file(directory: &Path, stem: &str) -> Result<Target, WriteError> {
    let failed = WriteError::io(directory);
    fs::create_dir_all(directory).map_err(failed)?;
    sweep(directory, INTERNAL, STALE);
    let mut others = checkpoints(directory).map_err(failed)?;
    others.sort();
    let highest = others.iter().map(|(_, number, _)| *number).max();
    let mut excess = (others.len() + 1).saturating_sub(KEPT);
    for (_, number, path) in others {
        // What can be claimed belongs to no running session. The highest number stays, so that the next one is new.
        if excess > 0
            && Some(number) != highest
            && let Ok(claimed) = Target::claim_existing(&path)
        {
            // A file that cannot be removed does no harm.
            let _ = fs::remove_file(claimed.path());
            excess -= 1;
        }
    }
    let first = highest.unwrap_or(0) + 1;
    for number in first..first + MOST_AT_ONCE {
        let path = directory.join(format!("{stem}-{number}.{ENDING}"));
        match Target::claim(&path, false) {
            // Another explorer has it, or had it a moment ago.
            Err(WriteError::Refused(_)) => {}
            claimed => return claimed,
        }
    }
    Err(failed(io::ErrorKind::AlreadyExists.into()))
}

/// Lists the checkpoints in a directory: time of writing, number at the end of the name (0 without one), and path.
fn checkpoints(directory: &Path) -> io::Result<Vec<(SystemTime, u64, PathBuf)>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(directory)? {
        let path = entry?.path();
        let is_one = path.extension().is_some_and(|ending| ending == ENDING);
        // Skips files that have disappeared in the meantime.
        if let (true, Ok(about)) = (is_one, fs::metadata(&path)) {
            let stem = path.file_stem().map(|stem| stem.to_string_lossy());
            let number = stem.and_then(|stem| stem.rsplit_once('-')?.1.parse().ok());
            let number = number.filter(|&number| number <= LARGEST_NUMBER);
            found.push((about.modified()?, number.unwrap_or(0), path));
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;

    /// Makes the checkpoint of a short session and returns its path.
    fn come_and_go(directory: &Path, stem: &str) -> PathBuf {
        let place = claim_new_file(directory, stem).expect("a place");
        place.write(stem.as_bytes()).expect("a file");
        place.path().to_owned()
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
        assert!(left.iter().any(|(.., path)| Some(path) == places.last()));
        fs::write(directory.join("notes.txt"), b"mine").expect("a file");
        come_and_go(&directory, "cone");
        assert!(directory.join("notes.txt").exists());
    }

    #[test]
    fn a_living_session_keeps_its_file_and_no_name_is_given_out_twice() {
        let base = tempfile::tempdir().expect("a directory");
        let paused = claim_new_file(base.path(), "hertz").expect("a place");
        paused.write(b"paused").expect("a file");
        let unkept = claim_new_file(base.path(), "hertz").expect("a place");
        let mut names = vec![paused.path().to_owned(), unkept.path().to_owned()];
        for round in 0..60 {
            names.push(come_and_go(base.path(), ["hertz", "cone"][round % 2]));
        }
        assert_eq!(fs::read(paused.path()).expect("its file"), b"paused");
        unkept.write(b"at last").expect("a file");
        paused.write(b"later").expect("a file");
        come_and_go(base.path(), "hertz");
        assert_eq!(fs::read(paused.path()).expect("its file"), b"later");
        let count = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), count, "a name was given out twice");
        // After its session has ended, its file can be removed like any other.
        let path = paused.path().to_owned();
        drop(paused);
        for _ in 0..KEPT + 2 {
            come_and_go(base.path(), "hertz");
        }
        assert!(!path.exists());
    }

    #[test]
    fn any_name_beside_it_or_of_its_scenario_leaves_room_for_another() {
        let base = tempfile::tempdir().expect("a directory");
        for number in [u64::MAX, LARGEST_NUMBER + 1] {
            let path = base.path().join(format!("x-{number}.{ENDING}"));
            fs::write(path, b"theirs").expect("a file");
        }
        come_and_go(base.path(), "hertz");
        let name = format!("{}.toml", "\u{3bc}".repeat(120));
        let path = base.path().join(&name);
        let hertz = Scenario::load("hertz", &[]).expect("a preset").to_toml();
        fs::write(&path, hertz).expect("a file");
        let scenario = Scenario::load(&path, &[]).expect("a scenario");
        come_and_go(base.path(), &scenario.stem());
    }

    #[test]
    fn a_clock_that_was_wrong_loses_nothing() {
        let base = tempfile::tempdir().expect("a directory");
        let days = |days: u64| Duration::from_secs(86400 * days);
        let now = SystemTime::now();
        for (name, at) in [
            ("past-7.checkpoint", now - days(11_000)),
            ("future-8.checkpoint", now + days(2)),
            (".mdr-tui-future.tmp", now + days(2)),
        ] {
            let file = fs::File::create(base.path().join(name)).expect("a file");
            file.set_modified(at).expect("a time");
        }
        for _ in 0..2 * KEPT {
            let place = come_and_go(base.path(), "hertz");
            assert!(place.exists());
        }
        assert_eq!(checkpoints(base.path()).expect("a directory").len(), KEPT);
        assert!(!base.path().join("past-7.checkpoint").exists());
        // One that could belong to a living process stays.
        assert!(base.path().join(".mdr-tui-future.tmp").exists());
    }

    #[test]
    fn a_checkpoint_is_due_when_its_time_has_come() {
        let base = tempfile::tempdir().expect("a directory");
        let run = RunDirectory::claim(base.path(), false).expect("a directory");
        let path = run.checkpoint();
        let every = |every| Autosave::new(Some(run.clone()), None, every);
        assert!(!every(Duration::ZERO).is_due());
        assert!(!every(Duration::from_secs(60)).is_due());
        let mut always = every(Duration::from_nanos(1));
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
        let [place, away, state] = ["run", "away", "state"].map(|name| base.path().join(name));
        let run = RunDirectory::claim(&place, false).expect("a directory");
        let home = run.checkpoint();
        let mut autosave = Autosave::new(Some(run), Some(state), Duration::ZERO);
        let scenario = Scenario::load("hertz", &[]).expect("a preset");
        let session = Session::start(scenario).expect("a contact");
        fs::rename(&place, &away).expect("a move");
        let word = autosave.save(&session, b"one").expect("a word");
        assert!(word.contains("; checkpoints go to "), "{word}");
        assert_eq!(autosave.save(&session, b"two"), None);
        let elsewhere = autosave.kept().expect("a checkpoint").0.to_owned();
        assert_eq!(fs::read(&elsewhere).expect("the file"), b"two");
        // In its place another run begins.
        let other = RunDirectory::claim(&place, false).expect("a directory");
        other.write(RUN_CHECKPOINT, b"theirs").expect("a file");
        assert_eq!(autosave.save(&session, b"two"), None);
        assert_eq!(fs::read(&home).expect("its file"), b"theirs");
        drop(other);
        fs::remove_dir_all(&place).expect("a directory");
        fs::rename(&away, &place).expect("a move");
        assert_eq!(autosave.save(&session, b"three"), None);
        assert_eq!(autosave.kept(), Some((home.as_path(), 0.0)));
        assert!(!elsewhere.exists());
    }
}

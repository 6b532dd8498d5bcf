//! Checkpoints on a timer: one file, replaced as a whole each time, and a copy in memory.

use std::cmp::Reverse;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::claim::was_killed;
use super::file::{INTERNAL, WriteError, sweep};
use super::run_folder::{RUN_CHECKPOINT, RunFolder};
use super::target::Target;
use crate::scenario::session::Session;

/// Maximum age of the copy in memory that survives a bug.
const COPY_INTERVAL: Duration = Duration::from_millis(100);

/// The ending of a checkpoint's name.
const ENDING: &str = "checkpoint";

/// Maximum number of checkpoints left by explorers that have ended; the oldest are removed.
const MOST_LEFT: usize = 20;

/// Temporary files older than this are considered abandoned.
const STALE: Duration = Duration::from_secs(3600);

/// Keeps the newest state of a session on disk: in the folder of its run, or in a file of this process in a directory if
/// there is no such folder, or nothing can be written there.
#[derive(Debug)]
pub struct Autosave {
    folder: Option<RunFolder>,
    directory: Option<PathBuf>,
    /// The file in the directory, since it is needed.
    file: Option<Target>,
    /// The interval; 0 saves only on request.
    every: Duration,
    last: Instant,
    /// The newest checkpoint, and its cycle.
    kept: Option<(PathBuf, f64)>,
    failure: Option<String>,
}

impl Autosave {
    /// Saves once per interval `every`, or only on request if that is 0.
    pub fn new(folder: Option<RunFolder>, directory: Option<PathBuf>, every: Duration) -> Self {
        Self {
            folder,
            directory,
            file: None,
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
        if let Some(folder) = &self.folder {
            match folder.write(RUN_CHECKPOINT, checkpoint) {
                Ok(()) => saved = Some(folder.checkpoint()),
                Err(error) => failure = Some(error.to_string()),
            }
        }
        if saved.is_none() {
            match self.save_in_directory(&session.loaded().stem(), checkpoint) {
                Ok(path) => saved = path,
                Err(error) => failure = failure.or(Some(error.to_string())),
            }
        } else if let Some(file) = self.file.take() {
            let _ = fs::remove_file(file.path());
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

    /// Writes the checkpoint into the file of this process; `None` without a directory.
    fn save_in_directory(
        &mut self,
        stem: &str,
        checkpoint: &[u8],
    ) -> Result<Option<PathBuf>, WriteError> {
        let file = match (self.file.take(), &self.directory) {
            (Some(file), _) => file,
            (None, Some(directory)) => claim_new_file(directory, stem)?,
            (None, None) => return Ok(None),
        };
        let path = file.path().to_owned();
        // If writing fails, an older checkpoint in this file is better than nothing.
        self.file.insert(file).write(checkpoint)?;
        Ok(Some(path))
    }

    /// Gives the file up at the end of the session.
    pub fn end(&mut self) {
        self.file = None;
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
/// Creates the directory, and removes the oldest checkpoints of explorers that have ended.
fn claim_new_file(directory: &Path, stem: &str) -> Result<Target, WriteError> {
    let failed = WriteError::io(directory);
    fs::create_dir_all(directory).map_err(failed)?;
    sweep(directory, INTERNAL, STALE);
    let all = checkpoints(directory).map_err(failed)?;
    let number = |path: &PathBuf| path.file_stem()?.to_str()?.rsplit_once('-')?.1.parse().ok();
    let highest: u32 = all.iter().filter_map(number).max().unwrap_or(0);
    let has_ended = |path: &&PathBuf| was_killed(path).is_none();
    for path in all.iter().filter(has_ended).skip(MOST_LEFT - 1) {
        // A file that cannot be removed does no harm.
        let _ = fs::remove_file(path);
    }
    for number in u64::from(highest) + 1.. {
        let path = directory.join(format!("{stem}-{number}.{ENDING}"));
        match Target::claim(&path, false) {
            // Another explorer has it, or had it a moment ago.
            Err(WriteError::Refused(_)) => {}
            claimed => return claimed,
        }
    }
    Err(failed(io::ErrorKind::AlreadyExists.into()))
}

/// Returns the checkpoints in a directory, the newest first.
fn checkpoints(directory: &Path) -> io::Result<Vec<PathBuf>> {
    let paths = fs::read_dir(directory)?.map(|entry| Ok(entry?.path()));
    let mut found: Vec<PathBuf> = paths.collect::<io::Result<_>>()?;
    found.retain(|path| path.extension().is_some_and(|ending| ending == ENDING));
    // Those that have disappeared in the meantime come last.
    let written = |path: &PathBuf| path.metadata().and_then(|about| about.modified()).ok();
    found.sort_by_cached_key(|path| Reverse(written(path)));
    Ok(found)
}

/// Returns the newest checkpoint in a directory whose process was killed.
pub fn left_by_a_crash(directory: &Path) -> Option<PathBuf> {
    let mut all = checkpoints(directory).unwrap_or_default().into_iter();
    all.find(|path| was_killed(path) == Some(true))
}

/// Removes the mark of a killed process from its checkpoint, since the session goes on.
pub fn forget_crash(path: &Path) {
    if was_killed(path) == Some(true) {
        drop(Target::claim_existing(path));
    }
}

#[cfg(test)]
mod tests {
    use std::time::SystemTime;

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
        assert_eq!(left.len(), MOST_LEFT);
        assert!(left.iter().any(|path| Some(path) == places.last()));
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
        for _ in 0..MOST_LEFT + 2 {
            come_and_go(base.path(), "hertz");
        }
        assert!(!path.exists());
    }

    #[test]
    fn any_name_beside_it_or_of_its_scenario_leaves_room_for_another() {
        let base = tempfile::tempdir().expect("a directory");
        for number in [u64::MAX, u64::from(u32::MAX)] {
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
        for _ in 0..2 * MOST_LEFT {
            let place = come_and_go(base.path(), "hertz");
            assert!(place.exists());
        }
        assert_eq!(
            checkpoints(base.path()).expect("a directory").len(),
            MOST_LEFT
        );
        assert!(!base.path().join("past-7.checkpoint").exists());
        // One that could belong to a living process stays.
        assert!(base.path().join(".mdr-tui-future.tmp").exists());
    }

    #[test]
    fn a_checkpoint_is_due_when_its_time_has_come() {
        let base = tempfile::tempdir().expect("a directory");
        let run = RunFolder::create(base.path(), false).expect("a directory");
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
        let run = RunFolder::create(&place, false).expect("a directory");
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
        let other = RunFolder::create(&place, false).expect("a directory");
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

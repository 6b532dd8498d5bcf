//! Checkpoints on a timer: one file, replaced as a whole each time, and a copy in memory.

use std::cmp::Reverse;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::claim::was_killed;
use super::file::{INTERNAL, WriteError, shell_path, sweep};
use super::run_folder::{RUN_CHECKPOINT, RunFolder};
use super::target::Target;
use crate::math::number::exact;
use crate::scenario::session::Session;

/// Maximum age of the copy in memory that survives a bug.
const COPY_INTERVAL: Duration = Duration::from_millis(100);

/// The ending of a checkpoint's name.
const ENDING: &str = "checkpoint";

/// Maximum number of checkpoints left by explorers that have ended; the oldest are removed.
const MOST_LEFT: usize = 20;

/// Temporary files older than this are considered abandoned.
const STALE: Duration = Duration::from_secs(3600);

/// What is saved: a session, and the data of the program that drives it.
pub trait Work: Clone {
    /// Returns the session.
    fn session(&self) -> &Session;

    /// Returns the checkpoint.
    fn checkpoint(&self) -> Vec<u8>;
}

/// Distinguishes the states of a session: steps, cycle, and number of changes.
pub type StateMark = (u64, f64, usize);

/// Returns the mark of the present state of `session`.
pub fn mark(session: &Session) -> StateMark {
    let simulation = session.simulation();
    let changes = session.changes().len();
    (simulation.steps(), simulation.cycle(), changes)
}

/// Keeps the newest state of a session on disk: in the folder of its run, or in a file of this process in a directory if
/// there is no such folder, or nothing can be written there.
#[derive(Debug)]
pub struct Autosave<T> {
    folder: Option<RunFolder>,
    directory: Option<PathBuf>,
    /// The file in the directory, since it is needed.
    file: Option<Target>,
    /// The interval; 0 saves only on request.
    every: Duration,
    last: Instant,
    /// The state last saved, or with which an explorer began.
    saved: Option<StateMark>,
    /// The session a moment ago, which survives a bug, and when that was.
    copy: (T, Instant),
    /// The newest checkpoint, and its cycle.
    kept: Option<(PathBuf, f64)>,
    failure: Option<String>,
    /// Whether nothing more is saved: the session has ended, or there is no place.
    is_finished: bool,
}

impl<T: Work> Autosave<T> {
    /// Saves once per interval `every` while something changes, or only on request if that is 0.
    pub fn new(
        folder: Option<RunFolder>,
        directory: Option<PathBuf>,
        every: Duration,
        start: T,
    ) -> Self {
        Self {
            is_finished: folder.is_none() && directory.is_none(),
            saved: folder.is_none().then(|| mark(start.session())),
            copy: (start, Instant::now()),
            last: Instant::now(),
            file: None,
            kept: None,
            failure: None,
            folder,
            directory,
            every,
        }
    }

    /// Notes the checkpoint that the session continues from.
    pub fn remember(&mut self, path: &Path, cycle: f64) {
        self.kept = Some((path.to_owned(), cycle));
    }

    /// Returns the time until a checkpoint is due; `None` if there is nothing new, or only on request.
    pub fn time_until_due(&self, session: &Session) -> Option<Duration> {
        let is_new = !self.is_finished && self.saved != Some(mark(session));
        let left = self.every.saturating_sub(self.last.elapsed());
        (is_new && !self.every.is_zero()).then_some(left)
    }

    /// Keeps the copy in memory up to date, and saves if due; returns a message as [`save`](Self::save).
    pub fn update(&mut self, session: &Session, work: impl Fn() -> T) -> Option<String> {
        if self.is_finished {
            return None;
        }
        if self.copy.1.elapsed() >= COPY_INTERVAL {
            self.copy = (work(), Instant::now());
        }
        let is_due = self.time_until_due(session) == Some(Duration::ZERO);
        is_due.then(|| self.save(&work())).flatten()
    }

    /// Saves a state unless it is saved already. Returns a message when saving begins to fail or moves to the directory.
    /// The next checkpoint is due one interval later, even if this one fails.
    pub fn save(&mut self, work: &T) -> Option<String> {
        let session = work.session();
        if self.saved == Some(mark(session)) {
            return None;
        }
        let checkpoint = work.checkpoint();
        let (mut saved, mut failure) = (None, None);
        if let Some(folder) = &self.folder {
            match folder.write(RUN_CHECKPOINT, &checkpoint) {
                Ok(()) => saved = Some(folder.checkpoint()),
                Err(error) => failure = Some(error.to_string()),
            }
        }
        if saved.is_none() {
            match self.save_in_directory(&session.loaded().stem(), &checkpoint) {
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
        if failure.is_none() {
            self.saved = Some(mark(session));
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

    /// Saves this session and switches to another one, whose checkpoints replace its own from the first step on.
    pub fn begin_session(&mut self, from: &T, to: &T) {
        if !self.is_finished {
            self.save(from);
            self.saved = Some(mark(to.session()));
            self.copy = (to.clone(), Instant::now());
        }
    }

    /// Saves the last state, or the copy after a bug, and gives the file up; returns the message for the user of an
    /// explorer. Only the first call has an effect.
    pub fn finish(&mut self, work: Option<&T>) -> Option<String> {
        if std::mem::replace(&mut self.is_finished, true) {
            return None;
        }
        let copy = self.copy().clone();
        self.save(work.unwrap_or(&copy));
        self.file = None;
        let place = self.kept().map(|(path, cycle)| {
            let (cycle, path) = (exact(cycle), shell_path(path));
            format!("saved at cycle {cycle}; resume with: mdr-tui --resume {path}")
        });
        match (&self.failure, place) {
            (None, place) => place,
            (Some(failure), Some(place)) => Some(format!("{failure}; {place}")),
            (Some(failure), None) => Some(format!("nothing was saved: {failure}")),
        }
    }

    /// Says how to resume a run that stopped at the cycle `now`, and which cycles are lost.
    pub fn how_to_resume(&self, now: f64) -> String {
        let Some((path, cycle)) = self.kept() else {
            return "there is no checkpoint".into();
        };
        let path = shell_path(path);
        if cycle == now {
            return format!("resume with: mdr-tui run --resume {path}");
        }
        let (cycle, now) = (exact(cycle), exact(now));
        format!(
            "resume from cycle {cycle} with: mdr-tui run --resume {path} (cycles up to {now} could not be saved)"
        )
    }

    /// Returns the session a moment ago.
    pub fn copy(&self) -> &T {
        &self.copy.0
    }

    /// Returns the newest checkpoint that still exists, and its cycle.
    pub fn kept(&self) -> Option<(&Path, f64)> {
        let (path, cycle) = self.kept.as_ref()?;
        path.exists().then_some((path, *cycle))
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
    use crate::scenario::{Scenario, checkpoint};

    impl Work for Session {
        fn session(&self) -> &Session {
            self
        }

        fn checkpoint(&self) -> Vec<u8> {
            checkpoint::encode(self, None::<&()>)
        }
    }

    fn hertz() -> Session {
        let scenario = Scenario::load("hertz", &[]).expect("a preset");
        Session::start(scenario).expect("a contact")
    }

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
    fn any_name_next_to_it_or_of_its_scenario_leaves_room_for_another() {
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
        let mut session = hertz();
        let every = |every| Autosave::new(Some(run.clone()), None, every, session.clone());
        let due = |of: &Autosave<Session>| of.time_until_due(&hertz());
        assert_eq!(due(&every(Duration::ZERO)), None);
        assert!(due(&every(Duration::from_secs(60))) > Some(Duration::from_secs(50)));
        let mut always = every(Duration::from_nanos(1));
        assert_eq!(due(&always), Some(Duration::ZERO));
        for cycle in [0.0, 0.25] {
            session.advance_to(cycle).expect("a quarter");
            assert_eq!(always.update(&session, || session.clone()), None);
            assert!(fs::read(&path).expect("the file") == session.checkpoint());
            assert_eq!(always.kept(), Some((path.as_path(), cycle)));
            assert_eq!(always.time_until_due(&session), None);
        }
    }

    /// An explorer has one file, in which each of its sessions replaces the one before it.
    #[test]
    fn an_explorer_has_one_file_and_one_that_was_killed_is_found() {
        let base = tempfile::tempdir().expect("a directory");
        let home = base.path().join("state");
        let mut session = hertz();
        let begin = || Autosave::new(None, Some(home.clone()), Duration::ZERO, hertz());
        let (mut first, mut second) = (begin(), begin());
        assert_eq!(first.finish(None), None);
        first = begin();
        session.advance_to(0.25).expect("a quarter");
        let mut next = Session::start(Scenario::load("cone", &[]).expect("it")).expect("a contact");
        first.begin_session(&session, &next);
        assert_eq!(second.save(&session), None);
        let count = || checkpoints(&home).expect("a directory").len();
        assert_eq!((count(), left_by_a_crash(&home)), (2, None));
        next.advance_to(0.5).expect("a half");
        first.save(&next);
        let [first_file, second_file] =
            [&first, &second].map(|of| of.kept().expect("it").0.to_owned());
        assert!(fs::read(&first_file).expect("its file") == next.checkpoint());
        assert!(fs::read(&second_file).expect("its file") == session.checkpoint());
        let word = first.finish(Some(&next)).expect("a word");
        assert!(
            word.starts_with("saved at cycle 0.5; resume with: mdr-tui --resume "),
            "{word}"
        );
        assert_eq!((count(), left_by_a_crash(&home)), (2, None));
        // A lock file without a lock.
        let name = first_file.file_name().expect("a name").to_string_lossy();
        let lock = home.join(format!(".mdr-tui-{name}.lock"));
        fs::write(&lock, "1 elsewhere\n").expect("a file");
        assert_eq!(left_by_a_crash(&home).as_ref(), Some(&first_file));
        for _ in 0..2 * MOST_LEFT {
            come_and_go(&home, "hertz");
        }
        assert_eq!(left_by_a_crash(&home).as_ref(), Some(&first_file));
        forget_crash(&first_file);
        assert_eq!(left_by_a_crash(&home), None);
    }

    #[test]
    fn what_cannot_be_saved_at_home_goes_elsewhere_and_comes_back_with_one_notice() {
        let base = tempfile::tempdir().expect("a directory");
        let [place, away, state] = ["run", "away", "state"].map(|name| base.path().join(name));
        let run = RunFolder::create(&place, false).expect("a directory");
        let home = run.checkpoint();
        let session = hertz();
        let mut autosave = Autosave::new(Some(run), Some(state), Duration::ZERO, session.clone());
        fs::rename(&place, &away).expect("a move");
        let word = autosave.save(&session).expect("a word");
        assert!(word.contains("; checkpoints go to "), "{word}");
        assert_eq!(autosave.save(&session), None);
        let elsewhere = autosave.kept().expect("a checkpoint").0.to_owned();
        assert!(fs::read(&elsewhere).expect("the file") == session.checkpoint());
        // In its place another run begins.
        let other = RunFolder::create(&place, false).expect("a directory");
        other.write(RUN_CHECKPOINT, b"theirs").expect("a file");
        assert_eq!(autosave.save(&session), None);
        assert_eq!(fs::read(&home).expect("its file"), b"theirs");
        drop(other);
        fs::remove_dir_all(&place).expect("a directory");
        fs::rename(&away, &place).expect("a move");
        assert_eq!(autosave.save(&session), None);
        assert_eq!(autosave.kept(), Some((home.as_path(), 0.0)));
        assert!(!elsewhere.exists());
    }
}

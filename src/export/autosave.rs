//! Checkpoints on a timer: one file, replaced each time, whole or not at all.

use std::fs::{self, File, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime};

use super::claim::{is_at, try_lock};
use super::file::{WriteError, sweep, write_with};
use super::own;

/// Maximum age of the copy in memory that survives a bug.
pub const COPY_INTERVAL: Duration = Duration::from_millis(100);

/// The ending of a checkpoint's name.
pub const ENDING: &str = "checkpoint";

/// Maximum number of the explorer's checkpoints; the oldest are removed.
const KEPT: usize = 20;

/// A temporary file of this age is abandoned.
const STALE: Duration = Duration::from_secs(3600);

/// The checkpoint file of a run, and when the next one is due.
#[derive(Debug)]
pub struct Autosave {
    path: PathBuf,
    every: Option<Duration>,
    last: Instant,
    /// Locked as long as it is open, so that others see a running process owns the file.
    file: Option<File>,
}

impl Autosave {
    /// Saves a checkpoint at `path`, one per interval `every`, or only on request if `None`.
    pub fn new(path: PathBuf, every: Option<Duration>) -> Self {
        Self {
            path,
            every,
            last: Instant::now(),
            file: None,
        }
    }

    /// Saves checkpoints of a session on a scenario called `stem` in a new file: creates the directory,
    /// in which only the newest checkpoints stay beside it and those of running
    /// sessions. A number that was given out is not given out again.
    pub fn in_free_place(
        directory: &Path,
        stem: &str,
        every: Option<Duration>,
    ) -> Result<Self, WriteError> {
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
                    return Ok(Self {
                        file,
                        ..Self::new(path, every)
                    });
                }
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(failed(error)),
            }
        }
        unreachable!("the number of names is unlimited")
    }

    /// Where the checkpoint is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether it is time for the next.
    pub fn is_due(&self) -> bool {
        self.every.is_some_and(|every| self.last.elapsed() >= every)
    }

    /// Replaces the checkpoint. The next one is due an interval later, even if this fails.
    pub fn keep(&mut self, checkpoint: &[u8]) -> Result<(), WriteError> {
        let written = write_with(&self.path, |file| file.write_all(checkpoint));
        self.last = Instant::now();
        // The new file is locked before the lock on the old one is given up.
        self.file = Some(written?);
        Ok(())
    }

    /// Returns itself, unless nothing was ever saved: then removes its empty file.
    pub fn if_ever(self) -> Option<Self> {
        if fs::metadata(&self.path).is_ok_and(|about| about.len() > 0) {
            return Some(self);
        }
        self.discard();
        None
    }

    /// Removes the checkpoint, which another one has replaced.
    pub fn discard(self) {
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

/// Directory of the explorer's checkpoints: `mdr-tui` in `$XDG_STATE_HOME` or in `~/.local/state`;
/// `None` without a home directory.
pub fn state_directory() -> Option<PathBuf> {
    let given = std::env::var_os("XDG_STATE_HOME").map(PathBuf::from);
    // The specification says to ignore relative paths.
    let base = given.filter(|path| path.is_absolute()).or_else(|| {
        let home = std::env::home_dir().filter(|home| !home.as_os_str().is_empty());
        home.map(|home| home.join(".local/state"))
    });
    base.map(|base| base.join("mdr-tui"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A session that comes, is kept, and goes.
    fn come_and_go(directory: &Path, stem: &str) -> PathBuf {
        let mut autosave = Autosave::in_free_place(directory, stem, None).expect("a place");
        autosave.keep(stem.as_bytes()).expect("a file");
        autosave.path().to_owned()
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
        let mut paused = Autosave::in_free_place(base.path(), "hertz", None).expect("a place");
        paused.keep(b"paused").expect("a file");
        let unkept = Autosave::in_free_place(base.path(), "hertz", None).expect("a place");
        let mut names = vec![paused.path().to_owned(), unkept.path().to_owned()];
        for round in 0..60 {
            names.push(come_and_go(base.path(), ["hertz", "cone"][round % 2]));
        }
        assert_eq!(fs::read(paused.path()).expect("its file"), b"paused");
        assert!(unkept.path().exists());
        paused.keep(b"later").expect("a file");
        come_and_go(base.path(), "hertz");
        assert_eq!(fs::read(paused.path()).expect("its file"), b"later");
        let count = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), count, "a name was given out twice");
        // Once it is gone, its file is like any other.
        let path = paused.path().to_owned();
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
        let never = Autosave::new(path.clone(), None);
        assert!(!never.is_due());
        let mut always = Autosave::new(path.clone(), Some(Duration::ZERO));
        assert!(always.is_due());
        always.keep(b"one").expect("a file");
        always.keep(b"two").expect("a file");
        assert_eq!(fs::read(always.path()).expect("the file"), b"two");
        assert!(!Autosave::new(path, Some(Duration::from_secs(60))).is_due());
    }
}

//! Checkpoints on a timer: one file, written anew each time, whole or not at all.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::file::{WriteError, sweep, write_whole};

/// How old the copy in memory may be that a defect of the program leaves of a session.
pub const COPY_INTERVAL: Duration = Duration::from_millis(100);

/// The ending of a checkpoint's name.
pub const ENDING: &str = "checkpoint";

/// How many checkpoints of explorers are kept; the oldest give way.
const KEPT: usize = 20;

/// A temporary file of this age belongs to nobody any more.
const STALE: Duration = Duration::from_secs(3600);

/// Where a run keeps its checkpoint, and when the next one is due.
#[derive(Debug)]
pub struct Keeper {
    path: PathBuf,
    every: Option<Duration>,
    last: Instant,
}

impl Keeper {
    /// Keeps a checkpoint at `path`, due `every` so often; if none, only when asked for.
    pub fn new(path: PathBuf, every: Option<Duration>) -> Self {
        Self {
            path,
            every,
            last: Instant::now(),
        }
    }

    /// Where the checkpoint is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether it is time for the next.
    pub fn is_due(&self) -> bool {
        self.every.is_some_and(|every| self.last.elapsed() >= every)
    }

    /// Puts `checkpoint` in the place of the one before. Well or ill, the next is due an interval on.
    pub fn keep(&mut self, checkpoint: &[u8]) -> Result<(), WriteError> {
        let written = write_whole(&self.path, checkpoint);
        self.last = Instant::now();
        written
    }

    /// Itself, unless nothing was ever kept: then it gives its place back.
    pub fn if_ever(self) -> Option<Self> {
        if fs::metadata(&self.path).is_ok_and(|about| about.len() > 0) {
            return Some(self);
        }
        let _ = fs::remove_file(self.path);
        None
    }
}

/// A free place for the checkpoint of an explorer on a scenario called `stem`: the directory is made,
/// and only the newest checkpoints stay there beside the new one.
pub fn place(directory: &Path, stem: &str) -> Result<PathBuf, WriteError> {
    let failed = |cause| WriteError::Io {
        path: directory.to_owned(),
        cause,
    };
    fs::create_dir_all(directory).map_err(failed)?;
    sweep(directory, STALE);
    let mut others = checkpoints(directory).map_err(failed)?;
    others.sort();
    let excess = (others.len() + 1).saturating_sub(KEPT);
    for (_, path) in others.drain(..excess) {
        // One that cannot be removed is in nobody's way.
        let _ = fs::remove_file(path);
    }
    for number in 1.. {
        let path = directory.join(format!("{stem}-{number}.{ENDING}"));
        // An empty file claims the name, so that two explorers never share one.
        match fs::File::create_new(&path) {
            Ok(_) => return Ok(path),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(failed(error)),
        }
    }
    unreachable!("numbers do not end")
}

/// The checkpoints in a directory, each with the time it was written.
fn checkpoints(directory: &Path) -> io::Result<Vec<(std::time::SystemTime, PathBuf)>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(directory)? {
        let path = entry?.path();
        let is_one = path.extension().is_some_and(|ending| ending == ENDING);
        // What has gone in the meantime is passed over.
        if let (true, Ok(about)) = (is_one, fs::metadata(&path)) {
            found.push((about.modified()?, path));
        }
    }
    Ok(found)
}

/// Where explorers keep their checkpoints: `mdr-tui` in `$XDG_STATE_HOME`, or in `~/.local/state`;
/// none where there is no home.
pub fn state_directory() -> Option<PathBuf> {
    let given = std::env::var_os("XDG_STATE_HOME").map(PathBuf::from);
    // The specification has relative paths ignored.
    let base = given.filter(|path| path.is_absolute()).or_else(|| {
        let home = std::env::home_dir().filter(|home| !home.as_os_str().is_empty());
        home.map(|home| home.join(".local/state"))
    });
    base.map(|base| base.join("mdr-tui"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checkpoints_do_not_pile_up() {
        let base = tempfile::tempdir().expect("a directory");
        let directory = base.path().join("state/mdr-tui");
        let mut places = Vec::new();
        for _ in 0..50 {
            let path = place(&directory, "hertz").expect("a place");
            write_whole(&path, b"x").expect("a file");
            places.push(path);
        }
        let left = checkpoints(&directory).expect("a directory");
        assert_eq!(left.len(), KEPT);
        assert!(left.iter().any(|(_, path)| Some(path) == places.last()));
        fs::write(directory.join("notes.txt"), b"mine").expect("a file");
        place(&directory, "cone").expect("a place");
        assert!(directory.join("notes.txt").exists());
    }

    #[test]
    fn a_checkpoint_is_due_when_its_time_has_come() {
        let base = tempfile::tempdir().expect("a directory");
        let path = base.path().join("run.checkpoint");
        let never = Keeper::new(path.clone(), None);
        assert!(!never.is_due());
        let mut always = Keeper::new(path.clone(), Some(Duration::ZERO));
        assert!(always.is_due());
        always.keep(b"one").expect("a file");
        always.keep(b"two").expect("a file");
        assert_eq!(fs::read(always.path()).expect("the file"), b"two");
        assert!(!Keeper::new(path, Some(Duration::from_secs(60))).is_due());
    }
}

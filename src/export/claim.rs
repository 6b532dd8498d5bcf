//! Claims a directory for one process, by a lock file that lives as long as the process.
//!
//! The system's lock decides, so the file of a killed process is recognised as stale. The contents,
//! `PROCESS HOST`, are for people and for file systems without locks.

use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};

/// The name of the lock file in a directory.
pub const LOCK: &str = ".mdr-tui-lock";

/// A directory that belongs to this process until this is dropped.
#[derive(Debug)]
pub struct Claim {
    path: PathBuf,
    /// Whether the directory goes too if nothing has been written into it.
    pub(super) is_new: bool,
    /// Locked as long as it is open.
    _file: File,
}

/// Why a directory cannot be claimed.
#[derive(Debug)]
pub enum Refusal {
    /// Another process writes there; its identity, if known.
    Taken(Option<Owner>),
    /// The system refused.
    Io(io::Error),
}

impl From<io::Error> for Refusal {
    fn from(cause: io::Error) -> Self {
        Self::Io(cause)
    }
}

/// A process and the machine that it runs on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Owner {
    /// The process.
    pub process: u32,
    /// Its machine.
    pub host: String,
}

impl Owner {
    fn this() -> Self {
        let host = nix::unistd::gethostname().unwrap_or_default();
        Self {
            process: std::process::id(),
            host: host.to_string_lossy().replace(char::is_whitespace, "-"),
        }
    }

    /// Who has written this file, where anybody has.
    fn of(file: &mut File) -> Option<Self> {
        let mut text = String::new();
        file.rewind().ok()?;
        file.take(1000).read_to_string(&mut text).ok()?;
        let (process, host) = text.trim_end().split_once(' ')?;
        Some(Self {
            process: process.parse().ok()?,
            host: host.to_owned(),
        })
    }

    /// Whether the process may still be there. Always true for another machine.
    fn may_live(&self) -> bool {
        self.host != Self::this().host || Path::new(&format!("/proc/{}", self.process)).exists()
    }
}

impl Claim {
    /// Claims `directory`, which exists, for this process.
    ///
    /// # Errors
    ///
    /// [`Refusal::Taken`] if a living process has claimed it, [`Refusal::Io`] if no file can be made.
    pub fn take(directory: &Path) -> Result<Self, Refusal> {
        let path = directory.join(LOCK);
        loop {
            let mut options = OpenOptions::new();
            options.read(true).write(true).create(true).truncate(false);
            let mut file = options.open(&path)?;
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => return Err(Refusal::Taken(Owner::of(&mut file))),
                // On a file system without locks, relies on the contents.
                Err(TryLockError::Error(_)) => {
                    if let Some(owner) = Owner::of(&mut file).filter(Owner::may_live) {
                        return Err(Refusal::Taken(Some(owner)));
                    }
                }
            }
            // The previous owner may have removed it in the meantime.
            if !is_at(&file, &path) {
                continue;
            }
            let Owner { process, host } = Owner::this();
            // On a full disk the lock has to do.
            let _ = file
                .set_len(0)
                .and_then(|()| file.rewind())
                .and_then(|()| writeln!(file, "{process} {host}"));
            return Ok(Self {
                path,
                is_new: false,
                _file: file,
            });
        }
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        // It is still locked: nobody else has claimed what is removed here.
        let _ = std::fs::remove_file(&self.path);
        if let Some(directory) = self.path.parent().filter(|_| self.is_new) {
            let _ = std::fs::remove_dir(directory);
        }
    }
}

/// Whether the open file is the one that the path names now.
#[cfg(unix)]
pub(super) fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let (Ok(one), Ok(other)) = (file.metadata(), std::fs::metadata(path)) else {
        return false;
    };
    (one.dev(), one.ino()) == (other.dev(), other.ino())
}

/// Whether the open file is the one that the path names now: elsewhere an open file is not removed.
#[cfg(not(unix))]
pub(super) fn is_at(_: &File, path: &Path) -> bool {
    path.exists()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_directory_belongs_to_one_and_a_stale_lock_to_nobody() {
        let base = tempfile::tempdir().expect("a directory");
        let first = Claim::take(base.path()).expect("a free directory");
        match Claim::take(base.path()) {
            Err(Refusal::Taken(Some(owner))) => assert_eq!(owner, Owner::this()),
            other => panic!("{other:?}"),
        }
        drop(first);
        assert!(!base.path().join(LOCK).exists());
        // What a process leaves behind that was killed.
        for stale in ["1 elsewhere\n", "999999999 here\n", "", "no number"] {
            std::fs::write(base.path().join(LOCK), stale).expect("a file");
            drop(Claim::take(base.path()).expect("a stale lock"));
        }
    }

    #[test]
    fn of_many_at_once_one_at_a_time_has_it() {
        let base = tempfile::tempdir().expect("a directory");
        let inside = std::sync::atomic::AtomicUsize::new(0);
        let taken = std::sync::atomic::AtomicUsize::new(0);
        use std::sync::atomic::Ordering::SeqCst;
        std::thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| {
                    for _ in 0..200 {
                        if let Ok(claim) = Claim::take(base.path()) {
                            assert_eq!(inside.fetch_add(1, SeqCst), 0, "two have it");
                            taken.fetch_add(1, SeqCst);
                            inside.fetch_sub(1, SeqCst);
                            drop(claim);
                        }
                    }
                });
            }
        });
        assert!(taken.load(SeqCst) > 0);
    }
}

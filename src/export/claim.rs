//! Claims a directory or a file for one process, with a lock file that exists as long as the process.
//!
//! The system's file lock decides, so the lock file of a killed process is recognised as stale. On a file system
//! without locks the contents, `PROCESS HOST`, decide: the process that creates the file has the claim.

use std::fs::{self, File, TryLockError};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use nix::errno::Errno;
use nix::sys::signal::kill;
use nix::unistd::Pid;

use super::file::{WriteError, directory_of};
use super::safe_open;
use crate::scenario::printable;

/// The name of the lock file in a directory.
pub const LOCK: &str = ".mdr-tui-lock";

/// Maximum length of a file name that its lock's name repeats; with longer ones, the lock's name would be too long.
const LONGEST: usize = 200;

/// Without locks: how long a lock file may be empty before its maker is considered dead.
const UNWRITTEN: Duration = Duration::from_secs(10);

/// A directory or file that belongs to this process until the claim is dropped.
#[derive(Debug)]
pub struct Claim {
    path: PathBuf,
    /// Whether to remove the directory, too, if it is still empty.
    pub(super) is_new: bool,
    /// Locked while it is open.
    file: File,
}

/// A process and the machine that it runs on.
#[derive(Debug)]
struct Owner {
    process: u32,
    host: String,
}

impl Owner {
    fn this_process() -> Self {
        let host = nix::unistd::gethostname().unwrap_or_default();
        Self {
            process: std::process::id(),
            host: host.to_string_lossy().replace(char::is_whitespace, "-"),
        }
    }

    /// Returns who wrote this lock file, if anyone.
    fn read(file: &mut File) -> Option<Self> {
        let mut text = String::new();
        file.rewind().ok()?;
        file.take(1000).read_to_string(&mut text).ok()?;
        let (process, host) = text.trim_end().split_once(' ')?;
        Some(Self {
            process: process.parse().ok()?,
            host: host.to_owned(),
        })
    }

    fn is_here(&self) -> bool {
        self.host == Self::this_process().host
    }

    /// Whether the process may still be alive. It cannot be checked on another machine.
    fn may_live(&self) -> bool {
        let process = i32::try_from(self.process).map(Pid::from_raw);
        !self.is_here() || process.is_ok_and(|process| kill(process, None) != Err(Errno::ESRCH))
    }

    /// Names the process, in brackets.
    fn describe(&self) -> String {
        let (process, host) = (self.process, printable(&self.host));
        let hint = if self.is_here() {
            ""
        } else {
            "; if it is gone, remove the lock file"
        };
        format!(" (process {process} on {host}{hint})")
    }
}

impl Claim {
    /// Claims `directory`, which must exist, for this process.
    ///
    /// # Errors
    ///
    /// If another living process has claimed it, or no file can be created in it.
    pub fn of_directory(directory: &Path) -> Result<Self, WriteError> {
        let words = ["another run is writing there", "choose another directory"];
        Self::with_lock(directory.join(LOCK), directory, words)
    }

    /// Claims the file at `path`, whether it exists or not, for this process.
    ///
    /// # Errors
    ///
    /// As [`of_directory`](Self::of_directory).
    pub fn of_file(path: &Path) -> Result<Self, WriteError> {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let name = match name.len() {
            0..=LONGEST => format!(".mdr-tui-{name}.lock"),
            _ => format!(".mdr-tui-{:08x}.lock", crc32fast::hash(name.as_bytes())),
        };
        let words = [
            "another mdr-tui is writing this file",
            "choose another name",
        ];
        Self::with_lock(directory_of(path).join(name), path, words)
    }

    /// Claims what is at `path` with the file `lock`. If another process has it, the error says so in `words`, with
    /// what to do instead.
    fn with_lock(lock: PathBuf, path: &Path, words: [&str; 2]) -> Result<Self, WriteError> {
        match Self::locked(&lock) {
            Ok(Ok(file)) => Ok(Self {
                path: lock,
                is_new: false,
                file,
            }),
            Ok(Err(owner)) => {
                let owner = owner.as_ref().map_or_else(String::new, Owner::describe);
                let rule = format!("{}{owner}; wait for it to end or {}", words[0], words[1]);
                Err(WriteError::refused(path, rule))
            }
            // If the lock cannot be created, no file can be created there.
            Err(cause) => match lock.symlink_metadata() {
                Ok(_) => Err(WriteError::io(&lock)(cause)),
                Err(_) => Err(WriteError::io(path)(cause)),
            },
        }
    }

    /// Checks that what was claimed was neither moved nor removed: its place may belong to another process by now.
    ///
    /// # Errors
    ///
    /// If the lock file is no longer at its place.
    pub fn check(&self) -> Result<(), WriteError> {
        if is_at(&self.file, &self.path) {
            Ok(())
        } else {
            let rule =
                "was moved, removed or cleared meanwhile, and may belong to another run by now";
            Err(WriteError::refused(directory_of(&self.path), rule))
        }
    }

    /// The file, locked and with this process in it, or who has it.
    fn locked(path: &Path) -> io::Result<Result<File, Option<Owner>>> {
        loop {
            let (mut file, is_made_here) = match safe_open::open(path, true) {
                Ok(file) => (file, true),
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                    match safe_open::open(path, false) {
                        Ok(file) => (file, false),
                        // Another user's file can be locked, too, but not removed.
                        Err(error) if error.kind() == io::ErrorKind::PermissionDenied => {
                            (safe_open::read(path)?, false)
                        }
                        // The previous owner has just removed it.
                        Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
                        Err(error) => return Err(error),
                    }
                }
                Err(error) => return Err(error),
            };
            let has_lock = match try_lock(&file) {
                Ok(()) => true,
                Err(TryLockError::WouldBlock) => return Ok(Err(Owner::read(&mut file))),
                Err(TryLockError::Error(_)) => false,
            };
            if has_lock && !is_at(&file, path) {
                continue;
            }
            if !has_lock && !is_made_here {
                let owner = Owner::read(&mut file);
                let may_live = match &owner {
                    Some(owner) => owner.may_live(),
                    None => is_young(&file),
                };
                if may_live {
                    return Ok(Err(owner));
                }
                remove_stale(&file, path)?;
                continue;
            }
            let Owner { process, host } = Owner::this_process();
            let written = file
                .set_len(0)
                .and_then(|()| file.rewind())
                .and_then(|()| writeln!(file, "{process} {host}"));
            // On a full disk the lock alone is enough.
            if let (false, Err(error)) = (has_lock, written) {
                let _ = fs::remove_file(path);
                return Err(error);
            }
            return Ok(Ok(file));
        }
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        // The file is still locked, so no other process can have claimed it.
        if is_at(&self.file, &self.path) {
            let _ = fs::remove_file(&self.path);
            if self.is_new {
                let _ = fs::remove_dir(directory_of(&self.path));
            }
        }
    }
}

/// Locks a file until it is closed, if the file system supports locks.
fn try_lock(file: &File) -> Result<(), TryLockError> {
    if crate::failpoint::is_asked_for("no locks") {
        return Err(TryLockError::Error(io::ErrorKind::Unsupported.into()));
    }
    file.try_lock()
}

/// Whether a file is so new that its maker may still be about to write into it.
fn is_young(file: &File) -> bool {
    let made = file.metadata().and_then(|about| about.modified());
    made.is_ok_and(|at| at.elapsed().is_ok_and(|age| age < UNWRITTEN))
}

/// Removes a stale lock file. If several processes do so at once, only one of them succeeds in renaming it; if the
/// renamed file turns out to be another process's new lock, it is put back.
fn remove_stale(file: &File, path: &Path) -> io::Result<()> {
    let aside = path.with_file_name(format!(".mdr-tui-{}.tmp", std::process::id()));
    match fs::rename(path, &aside) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        other => other?,
    }
    if !is_at(file, &aside) {
        let _ = fs::hard_link(&aside, path);
    }
    fs::remove_file(aside)
}

/// Whether the open file is still the one at this path.
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let (Ok(one), Ok(other)) = (file.metadata(), path.symlink_metadata()) else {
        return false;
    };
    (one.dev(), one.ino()) == (other.dev(), other.ino())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_directory_belongs_to_one_and_a_stale_lock_to_nobody() {
        let base = tempfile::tempdir().expect("a directory");
        let first = Claim::of_directory(base.path()).expect("a free directory");
        let refused = Claim::of_directory(base.path()).expect_err("it is taken");
        let owner = format!("(process {} on ", std::process::id());
        assert!(refused.to_string().contains(&owner), "{refused}");
        drop(first);
        assert!(!base.path().join(LOCK).exists());
        // What a killed process leaves behind.
        for stale in ["1 elsewhere\n", "999999999 here\n", "", "no number"] {
            std::fs::write(base.path().join(LOCK), stale).expect("a file");
            drop(Claim::of_directory(base.path()).expect("a stale lock"));
        }
    }

    #[test]
    fn a_directory_in_the_place_of_a_removed_one_is_left_alone() {
        let base = tempfile::tempdir().expect("a directory");
        let place = base.path().join("x");
        fs::create_dir(&place).expect("a directory");
        let mut claim = Claim::of_directory(&place).expect("a free directory");
        claim.is_new = true;
        claim.check().expect("its place");
        fs::remove_dir_all(&place).expect("a directory");
        fs::create_dir(&place).expect("another one");
        let other = Claim::of_directory(&place).expect("a free directory");
        assert!(claim.check().is_err());
        drop(claim);
        other.check().expect("its place");
        drop(other);
        assert!(place.exists());
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
                        if let Ok(claim) = Claim::of_directory(base.path()) {
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

    #[test]
    fn a_lock_that_is_a_link_or_a_socket_is_refused_and_its_target_stays() {
        let base = tempfile::tempdir().expect("a directory");
        let (lock, mine) = (base.path().join(LOCK), base.path().join("mine"));
        fs::write(&mine, "mine").expect("a file");
        std::os::unix::fs::symlink(&mine, &lock).expect("a link");
        let refused = || match Claim::of_directory(base.path()) {
            Err(WriteError::Io { path, cause }) => {
                assert_eq!(path, lock);
                assert!(cause.to_string().contains("not a regular file"), "{cause}");
            }
            other => panic!("{other:?}"),
        };
        refused();
        assert_eq!(fs::read(&mine).expect("the file"), b"mine");
        fs::remove_file(&lock).expect("the link");
        let _socket = std::os::unix::net::UnixListener::bind(&lock).expect("a socket");
        refused();
    }

    #[test]
    fn a_file_of_any_name_is_claimed_by_itself() {
        let base = tempfile::tempdir().expect("a directory");
        let paths = ["a.csv", "b.csv", &"x".repeat(255)].map(|name| base.path().join(name));
        let claims = [0, 1, 2].map(|k| Claim::of_file(&paths[k]).expect("a claim"));
        for path in &paths {
            let again = Claim::of_file(path).expect_err("it is taken");
            assert!(again.to_string().contains("(process "), "{again}");
        }
        drop(claims);
        assert_eq!(fs::read_dir(base.path()).expect("it").count(), 0);
    }
}

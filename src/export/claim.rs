//! Claims a directory or a file for one process, with a lock file that exists as long as the process.
//!
//! The system's file lock decides, so the lock file of a killed process is recognised as stale. On a file system
//! without locks the contents, `PROCESS HOST`, decide: the process that creates the file has the claim.

use std::fs::{self, File, Metadata, TryLockError};
use std::io::{self, Read, Seek, Write};
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::Duration;

use nix::errno::Errno;
use nix::sys::signal::kill;
use nix::unistd::Pid;

use super::file::{WriteError, directory_of};
use super::safe_open;
use crate::panics::locked;
use crate::scenario::printable;

/// The name of the lock file in a directory.
pub const LOCK: &str = ".mdr-tui-lock";

/// Maximum length of a file name that its lock's name repeats; with longer ones, the lock's name would be too long.
const LONGEST: usize = 200;

/// Without locks: how long a lock file may be empty before its maker is considered dead.
const UNWRITTEN: Duration = Duration::from_secs(10);

/// The lock files of this process, for [`release_all`].
static HELD: Mutex<Vec<LockFile>> = Mutex::new(Vec::new());

/// A directory or file that belongs to this process until the claim is dropped.
#[derive(Debug)]
pub struct Claim {
    lock: LockFile,
    /// Locked while it is open.
    _file: File,
}

/// A lock file of this process.
#[derive(Debug, Clone, PartialEq)]
struct LockFile {
    path: PathBuf,
    identity: (u64, u64),
    /// Whether its directory is to be removed with it if nothing else is in there.
    is_new: bool,
}

impl LockFile {
    fn is_there(&self) -> bool {
        identity(self.path.symlink_metadata()) == Some(self.identity)
    }

    fn remove(&self) {
        if self.is_there() {
            let _ = fs::remove_file(&self.path);
            if self.is_new {
                let _ = fs::remove_dir(directory_of(&self.path));
            }
        }
    }
}

/// Removes all lock files of this process, which writes nothing from now on.
pub fn release_all() {
    locked(&HELD).drain(..).for_each(|lock| lock.remove());
}

impl Claim {
    /// Claims a directory, or a file whether it exists or not, for this process. If `is_new`, the directory is removed
    /// with the claim unless something was written into it.
    ///
    /// # Errors
    ///
    /// If another living process has claimed it, or no file can be created there.
    pub fn new(claimed: &Path, is_new: bool) -> Result<Self, WriteError> {
        let path = lock_of(claimed);
        let failed = |cause| match path.symlink_metadata() {
            Ok(_) => WriteError::io(&path)(cause),
            // If the lock cannot be created, no file can be created there.
            Err(_) => WriteError::io(claimed)(cause),
        };
        // A signal between making the file and remembering it would leave it behind.
        let mut held = locked(&HELD);
        let file = lock(&path).map_err(failed)?.map_err(|owner| {
            let owner = owner.as_ref().map_or_else(String::new, Owner::describe);
            let [is_busy, place] = if claimed.is_dir() {
                ["another run is writing there", "directory"]
            } else {
                ["another mdr-tui is writing this file", "name"]
            };
            let rule = format!("{is_busy}{owner}; wait for it to end or choose another {place}");
            WriteError::refused(claimed, rule)
        })?;
        let identity = identity(file.metadata()).unwrap_or_default();
        let lock = LockFile {
            path,
            identity,
            is_new,
        };
        held.push(lock.clone());
        Ok(Self { lock, _file: file })
    }

    /// Checks that what was claimed was neither moved nor removed: its place may belong to another process by now.
    ///
    /// # Errors
    ///
    /// If the lock file is no longer at its place.
    pub fn check(&self) -> Result<(), WriteError> {
        if self.lock.is_there() {
            return Ok(());
        }
        let rule = "was moved, removed or cleared meanwhile, and may belong to another run by now";
        Err(WriteError::refused(directory_of(&self.lock.path), rule))
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        locked(&HELD).retain(|held| *held != self.lock);
        // The file is still locked, so no other process can have claimed it.
        self.lock.remove();
    }
}

/// Whether the process that has claimed the file at `path` was killed; `None` if none has claimed it.
pub fn was_killed(path: &Path) -> Option<bool> {
    let mut file = safe_open::open(&lock_of(path), false).ok()?;
    Some(match try_lock(&file) {
        Ok(()) => true,
        Err(TryLockError::WouldBlock) => false,
        Err(TryLockError::Error(_)) => {
            Owner::read(&mut file).is_some_and(|owner| !owner.may_live())
        }
    })
}

/// Returns the path of the lock file.
fn lock_of(claimed: &Path) -> PathBuf {
    if claimed.is_dir() {
        return claimed.join(LOCK);
    }
    let name = claimed.file_name().unwrap_or_default().to_string_lossy();
    directory_of(claimed).join(match name.len() {
        0..=LONGEST => format!(".mdr-tui-{name}.lock"),
        _ => format!(".mdr-tui-{:08x}.lock", crc32fast::hash(name.as_bytes())),
    })
}

/// Returns the file, locked and with this process in it, or who has it.
fn lock(path: &Path) -> io::Result<Result<File, Option<Owner>>> {
    loop {
        let Some((mut file, is_made_here)) = open(path)? else {
            continue;
        };
        match try_lock(&file) {
            // The previous owner has just removed it.
            Ok(()) if !is_at(&file, path) => {}
            Ok(()) => {
                // On a full disk the lock alone is enough.
                let _ = Owner::this_process().write(&mut file);
                return Ok(Ok(file));
            }
            Err(TryLockError::WouldBlock) => return Ok(Err(Owner::read(&mut file))),
            Err(TryLockError::Error(_)) if is_made_here => {
                let written = Owner::this_process().write(&mut file);
                if written.is_err() {
                    let _ = fs::remove_file(path);
                }
                return written.map(|()| Ok(file));
            }
            Err(TryLockError::Error(_)) => {
                let owner = Owner::read(&mut file);
                if owner
                    .as_ref()
                    .map_or_else(|| is_young(&file), Owner::may_live)
                {
                    return Ok(Err(owner));
                }
                remove_stale(&file, path)?;
            }
        }
    }
}

/// Opens the lock file, and says whether it was made here; `None` if its owner has just removed it.
fn open(path: &Path) -> io::Result<Option<(File, bool)>> {
    use io::ErrorKind::{AlreadyExists, NotFound, PermissionDenied};
    match safe_open::open(path, true) {
        Err(error) if error.kind() == AlreadyExists => {}
        made => return made.map(|file| Some((file, true))),
    }
    let opened = match safe_open::open(path, false) {
        // Another user's file can be locked, too, but not removed.
        Err(error) if error.kind() == PermissionDenied => safe_open::read(path),
        Err(error) if error.kind() == NotFound => return Ok(None),
        opened => opened,
    };
    opened.map(|file| Some((file, false)))
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
    let open = identity(file.metadata());
    open.is_some() && open == identity(path.symlink_metadata())
}

/// Returns device and inode of a file.
fn identity(about: io::Result<Metadata>) -> Option<(u64, u64)> {
    about.ok().map(|about| (about.dev(), about.ino()))
}

/// A process and the machine that it runs on.
#[derive(Debug)]
struct Owner {
    process: i32,
    host: String,
}

impl Owner {
    fn this_process() -> Self {
        let host = nix::unistd::gethostname().unwrap_or_default();
        Self {
            process: Pid::this().as_raw(),
            host: host.to_string_lossy().replace(char::is_whitespace, "-"),
        }
    }

    /// Returns who wrote this lock file, if anyone.
    fn read(file: &mut File) -> Option<Self> {
        let mut text = String::new();
        file.rewind().ok()?;
        file.take(1000).read_to_string(&mut text).ok()?;
        let (process, host) = text.trim_end().split_once(' ')?;
        let (process, host) = (process.parse().ok()?, host.to_owned());
        Some(Self { process, host })
    }

    fn write(&self, file: &mut File) -> io::Result<()> {
        file.set_len(0)?;
        file.rewind()?;
        writeln!(file, "{} {}", self.process, self.host)
    }

    fn is_here(&self) -> bool {
        self.host == Self::this_process().host
    }

    /// Whether the process may still be alive. It cannot be checked on another machine.
    fn may_live(&self) -> bool {
        !self.is_here() || kill(Pid::from_raw(self.process), None) != Err(Errno::ESRCH)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_directory_belongs_to_one_and_a_stale_lock_to_nobody() {
        let base = tempfile::tempdir().expect("a directory");
        let first = Claim::new(base.path(), false).expect("a free directory");
        let refused = Claim::new(base.path(), false).expect_err("it is taken");
        let owner = format!("(process {} on ", std::process::id());
        assert!(refused.to_string().contains(&owner), "{refused}");
        drop(first);
        assert!(!base.path().join(LOCK).exists());
        // What a killed process leaves behind.
        for stale in ["1 elsewhere\n", "999999999 here\n", "", "no number"] {
            std::fs::write(base.path().join(LOCK), stale).expect("a file");
            drop(Claim::new(base.path(), false).expect("a stale lock"));
        }
    }

    #[test]
    fn a_directory_in_the_place_of_a_removed_one_is_left_alone() {
        let base = tempfile::tempdir().expect("a directory");
        let place = base.path().join("x");
        fs::create_dir(&place).expect("a directory");
        let claim = Claim::new(&place, true).expect("a free directory");
        claim.check().expect("its place");
        fs::remove_dir_all(&place).expect("a directory");
        fs::create_dir(&place).expect("another one");
        let other = Claim::new(&place, false).expect("a free directory");
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
                        if let Ok(claim) = Claim::new(base.path(), false) {
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
        let refused = || match Claim::new(base.path(), false) {
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
        let claims = [0, 1, 2].map(|k| Claim::new(&paths[k], false).expect("a claim"));
        for path in &paths {
            let again = Claim::new(path, false).expect_err("it is taken");
            assert!(again.to_string().contains("(process "), "{again}");
        }
        drop(claims);
        assert_eq!(fs::read_dir(base.path()).expect("it").count(), 0);
    }
}

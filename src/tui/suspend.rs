//! Ctrl-Z: the process stops, and its shell has the terminal until `fg`.

use rustix::process::{Pid, Signal, getpgid, getpgrp, getpid, getsid, kill_current_process_group};

/// Stops the process group, as the terminal would. Returns at once, false, where nobody could wake
/// it: a stopped session leader's child is stopped for good.
pub fn stop() -> bool {
    is_under_job_control() && kill_current_process_group(Signal::STOP).is_ok()
}

/// Whether a shell waits for the process group: some member's parent is in the same session, in
/// another group. (A group without one is called orphaned, and the system does not stop it either.)
fn is_under_job_control() -> bool {
    let (group, session) = (getpgrp(), getsid(None));
    let mut member = getpid();
    // No family tree is this high.
    for _ in 0..100 {
        let Some(parent) = parent_of(member) else {
            return false;
        };
        if getsid(Some(parent)) != session {
            return false;
        }
        if getpgid(Some(parent)) != Ok(group) {
            return true;
        }
        member = parent;
    }
    false
}

/// The parent of a process. Where the system does not tell, only one's own is known.
fn parent_of(process: Pid) -> Option<Pid> {
    if process == getpid() {
        return rustix::process::getppid();
    }
    let id = process.as_raw_nonzero();
    let stat = std::fs::read_to_string(format!("/proc/{id}/stat")).ok()?;
    // "id (name) state parent ...", and the name may hold anything.
    let (_, fields) = stat.rsplit_once(") ")?;
    let parent = fields.split(' ').nth(1)?.parse().ok()?;
    Pid::from_raw(parent)
}

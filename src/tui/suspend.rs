//! Ctrl-Z: suspends the process and returns the terminal to the shell until `fg`.

use std::iter::successors;
use std::time::Duration;
use std::{io, thread};

use nix::sys::signal::{Signal, kill};
use nix::unistd::{Pid, getpgid, getpgrp, getpid, getppid, getsid, tcgetpgrp};

/// What the system gives for a process of another pid namespace, as a container has one; to
/// [`kill`], the caller's own group.
const NOBODY: Pid = Pid::from_raw(0);

/// Stops the process group, as the terminal would. Returns at once, false, where nobody could wake
/// it: a stopped session leader's child is stopped for good.
pub fn stop() -> bool {
    let whose = |process| Some((getpgid(Some(process)).ok()?, getsid(Some(process)).ok()?));
    is_under_job_control(getpid(), parent_of, whose) && kill(NOBODY, Signal::SIGSTOP).is_ok()
}

/// Time for the signal thread to see what came together with SIGCONT; generous, for busy machines.
const HEARD: Duration = Duration::from_millis(250);

/// Stays stopped while another job has the terminal, until the session `is_over`. Setting the terminal's modes from the
/// background would also stop the process, but inside a system call, where only SIGKILL could end it.
pub fn wait_for_terminal(is_over: impl Fn() -> bool) {
    let is_behind = || tcgetpgrp(io::stdin()).is_ok_and(|front| front != getpgrp());
    while !is_over() && is_behind() && stop() {
        thread::sleep(HEARD);
    }
}

/// Whether a shell waits for the group of a process: some member's parent is in the same session,
/// in another group. (A group without one is called orphaned, and the system does not stop it
/// either.) `whose` gives a process's group and session.
fn is_under_job_control(
    process: Pid,
    parent_of: impl Fn(Pid) -> Option<Pid>,
    whose: impl Fn(Pid) -> Option<(Pid, Pid)>,
) -> bool {
    // More ancestors than any process has.
    let ancestors = successors(parent_of(process), |member| parent_of(*member)).take(100);
    let own = whose(process);
    let other = ancestors.map(whose).find(|place| *place != own).flatten();
    own.zip(other).is_some_and(|(own, other)| own.1 == other.1)
}

/// Returns the parent of a process. If the system does not say, only the parent of this process is known.
fn parent_of(process: Pid) -> Option<Pid> {
    let parent = if process == getpid() {
        getppid()
    } else {
        let stat = std::fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
        // The format is "id (name) state parent ...", and the name may contain anything.
        let (_, fields) = stat.rsplit_once(") ")?;
        Pid::from_raw(fields.split(' ').nth(1)?.parse().ok()?)
    };
    (parent != NOBODY).then_some(parent)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether a shell waits for process 10, whose ancestors are given from the parent on, each
    /// with its group and session; process 10 is of group 10 and of session 5.
    fn waits(ancestors: &[(i32, i32, i32)]) -> bool {
        let family: Vec<_> = [(10, 10, 5)].iter().chain(ancestors).copied().collect();
        let place = |process: Pid| {
            let found = family.iter().position(|(id, ..)| *id == process.as_raw());
            found.expect("only ancestors are asked for")
        };
        is_under_job_control(
            Pid::from_raw(10),
            |process| {
                let (id, ..) = family.get(place(process) + 1)?;
                Some(Pid::from_raw(*id))
            },
            |process| {
                let (_, group, session) = family[place(process)];
                Some((Pid::from_raw(group), Pid::from_raw(session)))
            },
        )
    }

    #[test]
    fn a_shell_is_a_parent_in_the_same_session_and_another_group() {
        assert!(waits(&[(5, 5, 5), (1, 1, 1)]));
        // Through a script that runs in the explorer's group.
        assert!(waits(&[(9, 10, 5), (5, 5, 5)]));
    }

    #[test]
    fn without_a_shell_in_the_session_nobody_waits() {
        assert!(!waits(&[]));
        assert!(!waits(&[(4, 4, 4), (1, 1, 1)]));
        assert!(!waits(&[(9, 10, 5), (4, 4, 4)]));
        // A parent in the container whose session is outside.
        assert!(!waits(&[(1, 0, 0)]));
    }
}

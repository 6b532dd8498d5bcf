//! Signals that ask a run to stop.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Context, Result};
use signal_hook::consts::{
    SIGABRT, SIGALRM, SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU,
};
use signal_hook::flag;
use signal_hook::iterator::Signals;

use super::{FAILED, complain};
use crate::export::claim;

/// Signals that ask a program to end. Queueing systems send SIGUSR1 or SIGUSR2 shortly before the time limit; the
/// system sends SIGXCPU.
pub const ENDING: [i32; 9] = [
    SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGABRT, SIGALRM, SIGUSR1, SIGUSR2, SIGXCPU,
];

/// Signals that a user can send from the keyboard.
const TYPED: [i32; 2] = [SIGINT, SIGQUIT];

/// Polling interval for signals.
const GLANCE: Duration = Duration::from_millis(20);

/// Maximum time for stopping and saving after the first signal.
const GRACE: Duration = Duration::from_secs(2);

const NO_SIGNALS: &str = "cannot listen for signals";

/// Whether everything is saved and only output remains.
static DONE: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);

/// Makes any further signal end the process at once, since the reader of its output may have stopped reading.
pub fn nothing_is_left_to_save() {
    claim::release_all();
    DONE.store(true, Ordering::SeqCst);
}

/// Returns a flag that is set by the first signal that asks to end. Later signals change nothing, since a scheduler may
/// send several; but Ctrl-C ends the process at once if it has not stopped within [`GRACE`].
pub fn signal() -> Result<Arc<AtomicBool>> {
    let stop = Arc::new(AtomicBool::new(false));
    let heard = ENDING.into_iter();
    // Under `nohup` a run outlives its terminal, as intended.
    for signal in heard.filter(|&signal| signal != SIGHUP || !is_ignored(SIGHUP)) {
        let at_once = flag::register_conditional_shutdown(signal, FAILED.into(), DONE.clone());
        at_once.context(NO_SIGNALS)?;
        flag::register(signal, Arc::clone(&stop)).context(NO_SIGNALS)?;
    }
    let mut typed = Signals::new(TYPED).context(NO_SIGNALS)?;
    let is_stopping = Arc::clone(&stop);
    let watch = move || {
        let mut first = None;
        for _ in typed.forever() {
            let first = *first.get_or_insert_with(Instant::now);
            if is_stopping.load(Ordering::Relaxed) && first.elapsed() > GRACE {
                exit(FAILED);
            }
        }
    };
    // If the system cannot start a thread, the first signal still works.
    let _ = thread::Builder::new().spawn(watch);
    Ok(stop)
}

/// Calls `end` in a separate thread once `stop` is set and the time `grace` has passed.
pub fn after(stop: &Arc<AtomicBool>, grace: Duration, end: impl FnOnce() + Send + 'static) {
    let stop = Arc::clone(stop);
    let watch = move || {
        while !stop.load(Ordering::Relaxed) {
            thread::sleep(GLANCE);
        }
        thread::sleep(grace);
        end();
    };
    // If the system cannot start a thread, a command ends only where it looks at `stop`.
    let _ = thread::Builder::new().spawn(watch);
}

/// Has the first signal end a command that has nothing to save.
pub fn end_at_signal() -> Result<()> {
    after(&signal()?, Duration::ZERO, || {
        complain("interrupted");
        exit(FAILED);
    });
    Ok(())
}

/// Ends the process, which leaves no lock files behind.
pub fn exit(code: u8) -> ! {
    claim::release_all();
    std::process::exit(code.into());
}

/// Returns a function that says to continue until `stop` is set.
pub fn until_stopped(stop: Arc<AtomicBool>) -> impl Fn() -> bool {
    move || !stop.load(Ordering::Relaxed)
}

/// Whether the process was started with this signal ignored; `false` if unknown.
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}

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

use super::FAILED;

/// Signals that ask a program to end. Queueing systems send SIGUSR1 or SIGUSR2 shortly before the
/// time limit, and the system SIGXCPU.
pub const ENDING: [i32; 9] = [
    SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGABRT, SIGALRM, SIGUSR1, SIGUSR2, SIGXCPU,
];

/// Signals that a user sends from the keyboard.
const TYPED: [i32; 2] = [SIGINT, SIGQUIT];

/// How long a program may take to stop and save after the first signal.
const GRACE: Duration = Duration::from_secs(2);

/// Whether everything is done but for what is printed.
static DONE: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);

/// From here on any signal ends the process at once: a reader of what is printed may not read.
pub fn nothing_is_left_to_save() {
    DONE.store(true, Ordering::SeqCst);
}

/// Returns a flag that is set by the first signal that asks to end. Later signals change nothing, since a scheduler may
/// send several; but Ctrl-C ends the process at once if it has not stopped in [`GRACE`].
pub fn signal() -> Result<Arc<AtomicBool>> {
    let stop = Arc::new(AtomicBool::new(false));
    let heard = ENDING.into_iter();
    // Under `nohup` a run outlives its terminal, as intended.
    let heard: Vec<i32> = heard
        .filter(|&signal| signal != SIGHUP || !is_ignored(SIGHUP))
        .collect();
    let no_signals = "cannot listen for signals";
    for signal in &heard {
        let at_once = flag::register_conditional_shutdown(*signal, FAILED.into(), DONE.clone());
        at_once.context(no_signals)?;
        flag::register(*signal, Arc::clone(&stop)).context(no_signals)?;
    }
    let mut typed = Signals::new(TYPED).context(no_signals)?;
    let is_stopping = Arc::clone(&stop);
    let watch = move || {
        let mut first = None;
        for _ in typed.forever() {
            let first = *first.get_or_insert_with(Instant::now);
            if is_stopping.load(Ordering::Relaxed) && first.elapsed() > GRACE {
                std::process::exit(FAILED.into());
            }
        }
    };
    // Where the system has no thread left, the first signal still counts.
    let _ = thread::Builder::new().spawn(watch);
    Ok(stop)
}

/// Whether to go on: as long as this is not set.
pub fn unless(stop: Arc<AtomicBool>) -> impl Fn() -> bool {
    move || !stop.load(Ordering::Relaxed)
}

/// Whether the process was started with this signal ignored; `false` if the system cannot tell.
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}

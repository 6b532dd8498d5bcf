//! Signals that ask a run to stop.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context, Result};
use signal_hook::consts::{
    SIGABRT, SIGALRM, SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU,
};
use signal_hook::flag;

use super::FAILED;

/// Signals that ask a program to end. Queueing systems send SIGUSR1 or SIGUSR2 shortly before the
/// time limit, and the system SIGXCPU.
pub const ENDING: [i32; 9] = [
    SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGABRT, SIGALRM, SIGUSR1, SIGUSR2, SIGXCPU,
];

/// Set by the first signal that asks to end: stop after the step and save. A second one ends the
/// process at once.
pub fn signal() -> Result<Arc<AtomicBool>> {
    set_by(&ENDING, &ENDING)
}

/// Like [`signal`], but only a second Ctrl-C ends the process at once: a scheduler may send SIGTERM
/// twice.
pub fn patient_signal() -> Result<Arc<AtomicBool>> {
    set_by(&[SIGINT, SIGTERM, SIGHUP], &[SIGINT])
}

/// Whether to go on: as long as this is not set.
pub fn unless(stop: Arc<AtomicBool>) -> impl Fn() -> bool {
    move || !stop.load(Ordering::Relaxed)
}

/// A flag that these signals set; the second of those that end `at_once` ends the process. Under `nohup` a run
/// outlives its terminal, as intended.
fn set_by(signals: &[i32], at_once: &[i32]) -> Result<Arc<AtomicBool>> {
    let stop = Arc::new(AtomicBool::new(false));
    let exit = i32::from(FAILED);
    let is_heard = |signal: &&i32| **signal != SIGHUP || !is_ignored(SIGHUP);
    for at_once in at_once.iter().filter(is_heard) {
        let ended = flag::register_conditional_shutdown(*at_once, exit, Arc::clone(&stop));
        ended.context("cannot listen for signals")?;
    }
    for signal in signals.iter().filter(is_heard) {
        let noted = flag::register(*signal, Arc::clone(&stop));
        noted.context("cannot listen for signals")?;
    }
    Ok(stop)
}

/// Whether the process was started with this signal ignored; `false` if the system cannot tell.
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}

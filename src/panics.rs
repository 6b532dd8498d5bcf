//! Keeps the first panic message until the terminal is restored.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The message of the first panic in any thread. If it were printed at once, the explorer would draw over it.
static PANIC: Mutex<Option<String>> = Mutex::new(None);

/// Stores the messages of panics here instead of printing them.
pub fn capture() {
    std::panic::set_hook(Box::new(|panic| {
        let mut kept = locked(&PANIC);
        if kept.is_none() {
            *kept = Some(panic.to_string().replace('\n', " "));
        }
    }));
}

/// Takes the message, if there was a panic.
pub fn take_message() -> Option<String> {
    locked(&PANIC).take()
}

/// Locks the mutex, even after a panic: the value is always replaced as a whole, so it is never half written.
pub fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Runs `action`. If it panics, returns the default; the caller reports the panic after restoring the terminal.
///
/// # Errors
/// The errors of the action.
pub fn catch<T: Default>(action: impl FnOnce() -> anyhow::Result<T>) -> anyhow::Result<T> {
    catch_unwind(AssertUnwindSafe(action)).unwrap_or_else(|_| Ok(T::default()))
}

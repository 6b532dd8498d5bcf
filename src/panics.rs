//! Keeps the first panic message until the terminal is restored.

use std::sync::{Mutex, PoisonError};

/// The message of the first panic in any thread. Printed at once, the explorer would draw over it.
static PANIC: Mutex<Option<String>> = Mutex::new(None);

/// Stores the messages of panics here instead of printing them.
pub fn capture() {
    std::panic::set_hook(Box::new(|panic| {
        let mut kept = PANIC.lock().unwrap_or_else(PoisonError::into_inner);
        if kept.is_none() {
            *kept = Some(panic.to_string().replace('\n', " "));
        }
    }));
}

/// Takes the message, if there was a panic.
pub fn take_message() -> Option<String> {
    PANIC.lock().unwrap_or_else(PoisonError::into_inner).take()
}

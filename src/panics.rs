//! The word of a panic, kept until there is a place to say it.

use std::sync::{Mutex, PoisonError};

/// What the first panic in any thread said. It is told when the terminal is itself again: printed
/// at once, it would be drawn over.
static PANIC: Mutex<Option<String>> = Mutex::new(None);

/// Has panics leave their word here instead of on the screen.
pub fn keep() {
    std::panic::set_hook(Box::new(|panic| {
        let mut kept = PANIC.lock().unwrap_or_else(PoisonError::into_inner);
        if kept.is_none() {
            *kept = Some(panic.to_string().replace('\n', " "));
        }
    }));
}

/// What a panic said, if there was one.
pub fn word() -> Option<String> {
    PANIC.lock().unwrap_or_else(PoisonError::into_inner).take()
}

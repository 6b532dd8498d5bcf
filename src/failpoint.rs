//! Panics on demand, in debug builds only, so that tests can check that the terminal survives.

/// Sleeps for an hour if the environment variable `MDR_TUI_FAULT` names this place.
pub(crate) fn stall(place: &str) {
    if is_asked_for(place) {
        std::thread::sleep(std::time::Duration::from_secs(3600));
    }
}

/// Panics if the environment variable `MDR_TUI_FAULT` names this place.
pub(crate) fn hit(place: &str) {
    assert!(!is_asked_for(place), "a fault in the {place}, as asked for");
}

/// Whether the environment variable `MDR_TUI_FAULT` names this place.
pub(crate) fn is_asked_for(place: &str) -> bool {
    cfg!(debug_assertions) && std::env::var("MDR_TUI_FAULT").as_deref() == Ok(place)
}

//! Panics on demand, in debug builds only: tests hold that the terminal survives them.

/// Panics if the environment variable `MDR_TUI_FAULT` names this place.
pub(crate) fn strike(place: &str) {
    assert!(
        std::env::var("MDR_TUI_FAULT").as_deref() != Ok(place),
        "a fault in the {place}, as asked for"
    );
}

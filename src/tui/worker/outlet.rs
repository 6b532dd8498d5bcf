//! What the worker tells the screen.

use std::fmt::Display;
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::Sender;
use std::time::{Duration, Instant};

use crate::tui::Event;
use crate::tui::frame::{Frame, Slot};
use crate::tui::line::one_line;

/// Frames go into a slot, at most one an interval; all else is an event.
pub(super) struct Outlet {
    slot: Arc<Slot>,
    pub events: Sender<Event>,
    pub interval: Duration,
    shown: Instant,
}

impl Outlet {
    pub fn new(events: Sender<Event>, interval: Duration) -> Self {
        Self {
            slot: Arc::default(),
            events,
            interval,
            shown: Instant::now(),
        }
    }

    /// Whether the next frame is due.
    pub fn is_due(&self) -> bool {
        self.is_due_after(self.interval)
    }

    /// Whether it is due where one lasts for `interval`.
    pub fn is_due_after(&self, interval: Duration) -> bool {
        self.shown.elapsed() >= interval
    }

    pub fn show(&mut self, frame: Frame) {
        self.shown = Instant::now();
        if self.slot.put(Arc::new(frame)) {
            self.send(Event::Frame(Arc::clone(&self.slot)));
        }
    }

    /// Tells the user something.
    pub fn notice(&self, text: &str) {
        self.send(Event::Notice(one_line(text)));
    }

    /// What there is, or else a notice of why there is nothing.
    pub fn or_notice<T>(&self, result: Result<T, impl Display>) -> Option<T> {
        let told = |error| self.notice(&format!("{error}"));
        result.map_err(told).ok()
    }

    /// Tells the user where `what` was written, or why it was not.
    pub fn written(&self, what: &str, path: Result<impl AsRef<Path>, impl Display>) {
        match path {
            Ok(path) => self.notice(&format!("{what} in {}", path.as_ref().display())),
            Err(error) => self.send(Event::Unwritten(one_line(&error.to_string()))),
        }
    }

    /// A screen that is gone needs no word.
    pub fn send(&self, event: Event) {
        let _ = self.events.send(event);
    }
}

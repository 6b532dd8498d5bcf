//! Reads the terminal in a separate thread. Ctrl-C overtakes all waiting keys.

use std::io;
use std::os::fd::AsFd;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::SeqCst};
use std::sync::mpsc::Sender;
use std::time::Instant;

use nix::errno::Errno;
use nix::poll::{PollFd, PollFlags, poll};

use super::event::Event;
use super::mouse::Mouse;
use super::reader::{Input, Reader};

/// Polling interval for the end of the session, milliseconds.
const GLANCE: u16 = 100;

/// Maximum number of waiting keys; further ones are dropped.
const MOST_WAITING: usize = 4096;

/// The queue of keys between the input thread and the app.
#[derive(Debug, Default)]
pub struct Waiting {
    keys: AtomicUsize,
    has_dropped: AtomicBool,
    is_over: AtomicBool,
    is_closed: AtomicBool,
}

impl Waiting {
    /// Counts one more waiting key; returns false if the queue is full.
    fn enter(&self) -> bool {
        let next = |keys| (keys < MOST_WAITING).then_some(keys + 1);
        let entered = self.keys.fetch_update(SeqCst, SeqCst, next).is_ok();
        self.has_dropped.fetch_or(!entered, SeqCst);
        entered
    }

    /// Notes that a waiting key is being handled.
    pub fn leave(&self) {
        self.keys.fetch_sub(1, SeqCst);
    }

    /// Whether keys were dropped since the last call.
    pub fn has_dropped(&self) -> bool {
        self.has_dropped.swap(false, SeqCst)
    }

    /// Stops reading: further input belongs to another program.
    pub fn close(&self) {
        self.is_closed.store(true, SeqCst);
    }

    /// Ends the session, whatever is waiting.
    pub fn end(&self) {
        self.is_over.store(true, SeqCst);
    }

    /// Whether the session should end.
    pub fn is_over(&self) -> bool {
        self.is_over.load(SeqCst)
    }
}

/// Reads the terminal until it closes or the session ends.
pub fn listen(events: &Sender<Event>, waiting: &Arc<Waiting>, with_mouse: bool) {
    let stdin = io::stdin();
    let (mut reader, mut mouse) = (Reader::default(), Mouse::default());
    let mut bytes = [0; 4096];
    loop {
        let mut fds = [PollFd::new(stdin.as_fd(), PollFlags::POLLIN)];
        let come = match poll(&mut fds, reader.patience().unwrap_or(GLANCE)) {
            Ok(1..) => nix::unistd::read(stdin.as_fd(), &mut bytes).map(Some),
            silence => silence.map(|_| None),
        };
        if waiting.is_closed.load(SeqCst) {
            return;
        }
        let inputs = match come {
            Ok(None) => reader.pause(),
            Ok(Some(count @ 1..)) => reader.read(&bytes[..count]),
            Err(Errno::EINTR | Errno::EAGAIN) => continue,
            Ok(Some(0)) | Err(_) => {
                waiting.end();
                let _ = events.send(Event::HangUp);
                return;
            }
        };
        for input in inputs {
            let event = match input {
                // Keeps reading, so that late answers of the terminal do not reach the shell.
                Input::Interrupt => {
                    waiting.end();
                    Some(Event::HangUp)
                }
                Input::Key(_) | Input::Paste(_) if !waiting.enter() => None,
                Input::Point(_) if !with_mouse => None,
                Input::Point(gesture) => {
                    let gesture = mouse.combine(gesture, Instant::now());
                    gesture.map(|gesture| Event::Input(Input::Point(gesture)))
                }
                input => Some(Event::Input(input)),
            };
            if event.is_some_and(|event| events.send(event).is_err()) {
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn so_many_keys_wait_and_no_more() {
        let waiting = Waiting::default();
        let entered = (0..10_000).filter(|_| waiting.enter()).count();
        assert_eq!(entered, MOST_WAITING);
        assert!(waiting.has_dropped() && !waiting.has_dropped());
        waiting.leave();
        assert!(waiting.enter() && !waiting.enter());
    }
}

//! Output to the terminal, in a separate thread: a terminal that stops reading blocks only that thread.

use std::fs::File;
use std::io::{self, Write};
use std::os::fd::AsFd;
use std::sync::mpsc::{Sender, channel};
use std::thread;
use std::time::Duration;

use nix::sys::termios::{FlushArg, tcflush};

use super::event::Event;
use super::flow::Request;

/// How long the last output waits for a slow terminal; the same time again after everything queued before it has been
/// dropped.
const DRAIN_TIMEOUT: Duration = Duration::from_millis(500);

/// Bytes for the writer, and whom to tell when they are written.
type Chunk = (Vec<u8>, Box<dyn FnOnce() + Send>);

/// The channel to the terminal.
pub struct Output {
    chunks: Sender<Chunk>,
    events: Sender<Event>,
}

impl Output {
    /// Starts the writer, which reports [`Event::Written`] after every frame and [`Event::HangUp`] when the terminal is
    /// gone.
    pub fn open(events: Sender<Event>) -> io::Result<Self> {
        // The standard library's handle has a lock, which other writers would wait for.
        let mut terminal = File::from(io::stdout().as_fd().try_clone_to_owned()?);
        let (chunks, inbox) = channel::<Chunk>();
        let gone = events.clone();
        thread::Builder::new()
            .name("terminal".into())
            .spawn(move || {
                for (bytes, then) in inbox {
                    if terminal.write_all(&bytes).is_err() {
                        let _ = gone.send(Event::HangUp);
                    }
                    then();
                }
            })?;
        Ok(Self { chunks, events })
    }

    /// Hands a text to the writer, which calls `then` when it is written. A writer that has ended has reported it.
    fn queue(&self, text: &str, then: impl FnOnce() + Send + 'static) {
        let _ = self.chunks.send((text.as_bytes().to_vec(), Box::new(then)));
    }

    /// Sends a text without waiting.
    pub fn send(&self, text: &str) {
        self.queue(text, || ());
    }

    /// Sends a chunk of a frame, followed by a status request. Returns the bytes of both.
    pub fn frame(&self, mut frame: String) -> usize {
        frame.push_str(Request::Status.text());
        let events = self.events.clone();
        self.queue(&frame, move || {
            let _ = events.send(Event::Written);
        });
        frame.len()
    }

    /// Sends a text and waits until it is written. If the terminal has stopped reading, drops
    /// what it has not read, and if that does not help, this text too. Returns true if it was written.
    pub fn finish(&self, text: &str) -> bool {
        let (tell, told) = channel();
        self.queue(text, move || {
            let _ = tell.send(());
        });
        if told.recv_timeout(DRAIN_TIMEOUT).is_ok() {
            return true;
        }
        let _ = tcflush(io::stdout().as_fd(), FlushArg::TCOFLUSH);
        told.recv_timeout(DRAIN_TIMEOUT).is_ok()
    }
}

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

/// A text for the writer, and the channel that is notified once it is written.
type Chunk = (String, Option<Sender<Event>>);

/// The channel to the terminal.
pub struct TerminalOutput {
    chunks: Sender<Chunk>,
    events: Sender<Event>,
}

impl TerminalOutput {
    /// Starts the writer, which reports [`Event::Written`] after every frame and [`Event::HangUp`] when the terminal is
    /// gone.
    pub fn open(events: Sender<Event>) -> io::Result<Self> {
        // The standard library's handle has a lock, which other writers would wait for.
        let mut terminal = File::from(io::stdout().as_fd().try_clone_to_owned()?);
        let (chunks, inbox) = channel::<Chunk>();
        let gone = events.clone();
        thread::Builder::new().spawn(move || {
            for (text, to_tell) in inbox {
                if terminal.write_all(text.as_bytes()).is_err() {
                    let _ = gone.send(Event::HangUp);
                }
                let _ = to_tell.map(|to_tell| to_tell.send(Event::Written));
            }
        })?;
        Ok(Self { chunks, events })
    }

    /// Sends a text without waiting. A writer that has ended has reported it.
    pub fn send(&self, text: &str) {
        let _ = self.chunks.send((text.to_owned(), None));
    }

    /// Sends a chunk of a frame, followed by a status request. Returns the bytes of both.
    pub fn frame(&self, mut frame: String) -> usize {
        frame.push_str(Request::Status.text());
        let bytes = frame.len();
        let _ = self.chunks.send((frame, Some(self.events.clone())));
        bytes
    }

    /// Sends a text and waits until it is written. If the terminal has stopped reading, drops
    /// what it has not read, and if that does not help, this text too. Returns true if it was written.
    pub fn finish(&self, text: &str) -> bool {
        let (notify, done) = channel();
        let _ = self.chunks.send((text.to_owned(), Some(notify)));
        if done.recv_timeout(DRAIN_TIMEOUT).is_ok() {
            return true;
        }
        let _ = tcflush(io::stdout().as_fd(), FlushArg::TCOFLUSH);
        done.recv_timeout(DRAIN_TIMEOUT).is_ok()
    }
}

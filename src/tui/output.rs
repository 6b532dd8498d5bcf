//! Output to the terminal, in its own thread: a terminal that stops reading blocks only that
//! thread.

use std::fs::File;
use std::io::{self, Write};
use std::os::fd::AsFd;
use std::sync::mpsc::{Sender, channel};
use std::thread;
use std::time::Duration;

use nix::sys::termios::{FlushArg, tcflush};

use super::Event;
use super::flow::QUESTION;

/// How long the last output waits for a slow terminal, and again after everything queued before it
/// has been dropped.
const DRAIN_TIMEOUT: Duration = Duration::from_millis(500);

/// Bytes for the writer, and whom to tell when they are written.
struct Chunk {
    bytes: Vec<u8>,
    then: Box<dyn FnOnce() + Send>,
}

/// The way to the terminal.
pub struct Output {
    chunks: Sender<Chunk>,
    events: Sender<Event>,
    /// The frame being built.
    frame: Vec<u8>,
    /// All that was sent, in bytes, and in how many frames.
    sent: (usize, usize),
}

impl Output {
    /// Starts the writer, which tells [`Event::Written`] after every frame and [`Event::HangUp`] when
    /// the terminal is gone.
    pub fn open(events: Sender<Event>) -> io::Result<Self> {
        // Not the handle of the standard library: whoever else writes would wait for its lock.
        let mut terminal = File::from(io::stdout().as_fd().try_clone_to_owned()?);
        let (chunks, inbox) = channel::<Chunk>();
        let gone = events.clone();
        thread::Builder::new()
            .name("terminal".into())
            .spawn(move || {
                for chunk in inbox {
                    if terminal.write_all(&chunk.bytes).is_err() {
                        let _ = gone.send(Event::HangUp);
                    }
                    (chunk.then)();
                }
            })?;
        Ok(Self {
            chunks,
            events,
            frame: Vec::new(),
            sent: (0, 0),
        })
    }

    /// All that was sent so far, in bytes, and in how many frames, each with a question behind it.
    pub fn sent(&self) -> (usize, usize) {
        self.sent
    }

    /// Sends bytes without waiting.
    pub fn send(&self, bytes: &[u8]) {
        let then = Box::new(|| ());
        let _ = self.chunks.send(Chunk {
            bytes: bytes.to_vec(),
            then,
        });
    }

    /// Sends bytes and waits until they are written. If the terminal has stopped reading, drops
    /// what it has not read, and if that does not help, these bytes too. Returns true if they were
    /// written.
    pub fn finish(&self, bytes: &[u8]) -> bool {
        let (tell, told) = channel();
        let then = Box::new(move || {
            let _ = tell.send(());
        });
        let bytes = bytes.to_vec();
        let _ = self.chunks.send(Chunk { bytes, then });
        if told.recv_timeout(DRAIN_TIMEOUT).is_ok() {
            return true;
        }
        let _ = tcflush(io::stdout().as_fd(), FlushArg::TCOFLUSH);
        told.recv_timeout(DRAIN_TIMEOUT).is_ok()
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.frame.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    /// Sends the frame, and behind it the question whether the terminal has read it.
    fn flush(&mut self) -> io::Result<()> {
        if self.frame.is_empty() {
            return Ok(());
        }
        let mut bytes = std::mem::take(&mut self.frame);
        bytes.extend_from_slice(QUESTION);
        self.sent.0 += bytes.len();
        self.sent.1 += 1;
        let events = self.events.clone();
        let then = Box::new(move || {
            let _ = events.send(Event::Written);
        });
        // A writer that has ended has reported it.
        let _ = self.chunks.send(Chunk { bytes, then });
        Ok(())
    }
}

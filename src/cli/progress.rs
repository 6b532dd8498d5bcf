//! A line of progress on stderr, if it is a terminal.

use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use super::guide::columns;
use super::without_waiting;
use crate::math::number::{exact, rounded};
use crate::panics::locked;

/// Refresh interval of the line.
const INTERVAL: Duration = Duration::from_millis(100);

/// Cells of the bar.
const CELLS: usize = 32;

/// A bar that estimates the remaining time.
pub const TIMES: bool = true;

/// A bar of runs of different lengths, whose remaining time cannot be estimated.
pub const COUNTS: bool = false;

/// How far a command is, drawn by a separate thread, so that a terminal that stops reading does not stop the command. The
/// line disappears when this is dropped.
pub struct Bar {
    state: Arc<BarState>,
    drawer: Option<JoinHandle<()>>,
}

struct BarState {
    length: f64,
    is_timed: bool,
    /// What is being done, and how much of the length is done.
    reached: Mutex<(String, f64)>,
    has_ended: AtomicBool,
}

/// Makes a bar of `length`, 0 if it is unknown, with the remaining time if `is_timed`; hidden if `quiet` or if stderr
/// is not a terminal.
pub fn bar(length: usize, is_timed: bool, quiet: bool) -> Bar {
    Bar::new("", length as f64, is_timed, quiet)
}

impl Bar {
    /// Makes a bar with a message.
    pub fn new(message: &str, length: f64, is_timed: bool, quiet: bool) -> Self {
        let state = Arc::new(BarState {
            length,
            is_timed,
            reached: Mutex::new((message.to_owned(), 0.0)),
            has_ended: AtomicBool::new(false),
        });
        let is_shown = !quiet && io::stderr().is_terminal();
        let drawer = is_shown.then(|| {
            let state = state.clone();
            thread::spawn(move || state.draw())
        });
        Self { state, drawer }
    }

    /// Says what is being done.
    pub fn set_message(&self, message: impl Into<String>) {
        locked(&self.state.reached).0 = message.into();
    }

    /// Says how much is done.
    pub fn set_position(&self, position: f64) {
        locked(&self.state.reached).1 = position;
    }

    /// Says that one more is done.
    pub fn inc(&self) {
        locked(&self.state.reached).1 += 1.0;
    }

    /// Returns how much is done.
    pub fn position(&self) -> f64 {
        locked(&self.state.reached).1
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.state.has_ended.store(true, Ordering::Relaxed);
        if let Some(drawer) = self.drawer.take() {
            without_waiting(true, move || {
                drawer.thread().unpark();
                let _ = drawer.join();
            });
        }
    }
}

impl BarState {
    /// Draws the line until the bar is dropped, then clears it.
    fn draw(&self) {
        let (start, mut before) = (Instant::now(), None);
        loop {
            thread::park_timeout(INTERVAL);
            if self.has_ended.load(Ordering::Relaxed) {
                break;
            }
            let before = *before.get_or_insert(locked(&self.reached).1);
            let line = self.line(start.elapsed().as_secs_f64(), before);
            let line: String = line.chars().take(columns().saturating_sub(1)).collect();
            let _ = write!(io::stderr(), "\r{line}\x1b[K");
        }
        if before.is_some() {
            let _ = write!(io::stderr(), "\r\x1b[K");
        }
    }

    /// Formats the line after so many seconds, of a command that began with `before`.
    fn line(&self, elapsed: f64, before: f64) -> String {
        let (message, done) = locked(&self.reached).clone();
        let gone = format!("{} gone", time(elapsed));
        let [reached, length] = [done, self.length].map(|part| exact(rounded(part, 4)));
        if self.length <= 0.0 && done > 0.0 {
            return format!("{reached} {message}  {gone}");
        } else if self.length <= 0.0 {
            return format!("{message}  {gone}");
        }
        let share = (done / self.length).clamp(0.0, 1.0);
        let bar = "=".repeat((share * CELLS as f64) as usize) + ">";
        let left = elapsed * (self.length - done) / (done - before);
        let mut line = format!("{message} [{bar:CELLS$.CELLS$}] {reached} of {length}  {gone}");
        if self.is_timed && left.is_finite() {
            line += &format!(", {} to go", time(left));
        }
        line
    }
}

/// Formats a time in its largest unit.
fn time(seconds: f64) -> String {
    match seconds {
        seconds if seconds < 120.0 => format!("{seconds:.0} s"),
        seconds if seconds < 7200.0 => format!("{:.0} min", seconds / 60.0),
        seconds => format!("{:.1} h", seconds / 3600.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_says_what_is_done_and_what_is_left() {
        let bar = Bar::new("cycle", 200.0, TIMES, true);
        bar.set_position(50.04);
        let line = format!(
            "cycle [========>{}] 50.04 of 200  10 s gone, 30 s to go",
            " ".repeat(23)
        );
        assert_eq!(bar.state.line(10.0, 0.0), line);
        let runs = Bar::new("runs", 0.0, COUNTS, true);
        runs.inc();
        assert_eq!(runs.state.line(130.0, 0.0), "1 runs  2 min gone");
    }
}

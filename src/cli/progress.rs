//! Progress bars on stderr, if that is a terminal.

use std::io::{self, IsTerminal};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Units of the bar per cycle.
const PARTS: f64 = 1000.0;

/// Refresh interval of the bar.
const INTERVAL: Duration = Duration::from_millis(100);

/// Template of a bar that can estimate the remaining time.
pub const TIMES: &str = "{percent}%  {elapsed} gone, {eta} to go";

/// A bar of `length`, with `behind` (placeholders of `indicatif`) behind it; silent if `quiet` or if
/// stderr is no terminal.
pub fn bar(length: u64, behind: &str, quiet: bool) -> ProgressBar {
    let bar = ProgressBar::new(length);
    if quiet || !io::stderr().is_terminal() {
        bar.set_draw_target(ProgressDrawTarget::hidden());
    }
    if let Ok(style) = ProgressStyle::with_template(&format!("{{msg}} [{{bar:32}}] {behind}")) {
        bar.set_style(style.progress_chars("=> "));
    }
    bar
}

/// A spinner for work of unknown length.
pub fn spinner(message: &'static str, quiet: bool) -> ProgressBar {
    // These characters exist in every locale.
    let style = ProgressStyle::default_spinner().tick_chars("-\\|/ ");
    let spinner = ProgressBar::new_spinner()
        .with_style(style)
        .with_message(message);
    if quiet || !io::stderr().is_terminal() {
        spinner.set_draw_target(ProgressDrawTarget::hidden());
        return spinner;
    }
    spinner.enable_steady_tick(INTERVAL);
    spinner
}

/// The progress of a run in cycles, drawn by a thread of its own: a terminal that stops reading does
/// not stop the run.
pub struct Progress {
    /// The bits of the cycle that is reached.
    cycle: Arc<AtomicU64>,
    /// Told when the run has ended; `None` where nothing is drawn.
    end: Option<Sender<()>>,
    /// Tells when the bar is gone.
    gone: Receiver<()>,
}

impl Progress {
    /// For `cycles` in all.
    pub fn new(cycles: f64, quiet: bool) -> Self {
        let bar = bar((cycles * PARTS) as u64, TIMES, quiet);
        let reached = Arc::new(AtomicU64::new(0));
        let (end, ended) = channel::<()>();
        let (tell, gone) = channel();
        let is_drawn = !bar.is_hidden();
        let cycle = Arc::clone(&reached);
        if is_drawn {
            thread::spawn(move || {
                while ended.recv_timeout(INTERVAL) == Err(RecvTimeoutError::Timeout) {
                    let cycle = f64::from_bits(reached.load(Ordering::Relaxed));
                    bar.set_message(format!("cycle {cycle:.1}"));
                    bar.set_position((cycle * PARTS) as u64);
                }
                bar.finish_and_clear();
                let _ = tell.send(());
            });
        }
        Self {
            cycle,
            end: is_drawn.then_some(end),
            gone,
        }
    }

    /// Says that `cycle` is reached.
    pub fn at(&self, cycle: f64) {
        self.cycle.store(cycle.to_bits(), Ordering::Relaxed);
    }

    /// Takes the bar away.
    pub fn finish(&mut self) {
        if self.end.take().is_some() {
            let _ = self.gone.recv_timeout(super::TERMINAL_TIMEOUT);
        }
    }
}

//! A progress bar on stderr, when somebody is there to see it.

use std::io::IsTerminal;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Parts of a cycle that the bar counts.
const PARTS: f64 = 1000.0;

/// How often the bar is brought up to date.
const INTERVAL: Duration = Duration::from_millis(100);

/// The progress of a run in cycles.
pub struct Progress {
    bar: ProgressBar,
    last: Instant,
}

impl Progress {
    /// For `cycles` in all; silent if `quiet` or if stderr is no terminal.
    pub fn new(cycles: f64, quiet: bool) -> Self {
        let bar = ProgressBar::new((cycles * PARTS) as u64);
        if quiet || !std::io::stderr().is_terminal() {
            bar.set_draw_target(ProgressDrawTarget::hidden());
        }
        let template = "{msg} [{bar:32}] {percent}%  {elapsed} gone, {eta} to go";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style.progress_chars("=> "));
        }
        Self {
            bar,
            last: Instant::now(),
        }
    }

    /// Says that `cycle` is reached.
    pub fn at(&mut self, cycle: f64) {
        if self.last.elapsed() >= INTERVAL {
            self.last = Instant::now();
            self.bar.set_message(format!("cycle {cycle:.1}"));
            self.bar.set_position((cycle * PARTS) as u64);
        }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

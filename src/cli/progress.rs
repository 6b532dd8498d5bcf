//! Progress bars on stderr, when somebody is there to see them.

use std::io::{self, IsTerminal};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Parts of a cycle that the bar counts.
const PARTS: f64 = 1000.0;

/// How often the bar is brought up to date.
const INTERVAL: Duration = Duration::from_millis(100);

/// What stands behind a bar from whose length the time to go can be told.
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

/// The progress of a run in cycles.
pub struct Progress {
    bar: ProgressBar,
    last: Instant,
}

impl Progress {
    /// For `cycles` in all.
    pub fn new(cycles: f64, quiet: bool) -> Self {
        let bar = bar((cycles * PARTS) as u64, TIMES, quiet);
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

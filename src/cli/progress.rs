//! Progress bars on stderr, if it is a terminal.

use std::fmt;
use std::io::{self, IsTerminal};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

use super::without_waiting;

/// Units of the bar per cycle.
const PARTS: f64 = 1000.0;

/// Refresh interval of the bar.
const INTERVAL: Duration = Duration::from_millis(100);

/// Template of a bar that can estimate the remaining time.
pub const TIMES: &str = "{percent}%  {elapsed} gone, {eta} to go";

/// Template of a bar that counts runs of different lengths, whose remaining time cannot be estimated.
pub const COUNTS: &str = "{pos} of {len}  {elapsed} gone";

/// Makes a bar of `length`, followed by `behind` (placeholders of `indicatif`); hidden if `quiet` or if stderr is not a
/// terminal.
pub fn bar(length: usize, behind: &str, quiet: bool) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(length as u64), target(quiet));
    if let Ok(style) = ProgressStyle::with_template(&format!("{{msg}} [{{bar:32}}] {behind}")) {
        bar.set_style(style.progress_chars("=> "));
    }
    bar
}

/// Makes a spinner for work of unknown length.
pub fn spinner(message: &'static str, quiet: bool) -> ProgressBar {
    // These characters exist in every locale.
    let style = ProgressStyle::default_spinner().tick_chars("-\\|/ ");
    let spinner = ProgressBar::with_draw_target(None, target(quiet)).with_style(style);
    let spinner = spinner.with_message(message);
    if !spinner.is_hidden() {
        spinner.enable_steady_tick(INTERVAL);
    }
    spinner
}

/// Returns where progress is drawn, or a hidden target.
fn target(quiet: bool) -> ProgressDrawTarget {
    if quiet || !io::stderr().is_terminal() {
        ProgressDrawTarget::hidden()
    } else {
        ProgressDrawTarget::stderr()
    }
}

/// The progress of a run in cycles, drawn by a separate thread, so that a terminal that stops reading does not stop the
/// run. The bar disappears when this is dropped.
pub struct Progress(ProgressBar);

impl Progress {
    /// Makes a bar for `cycles` in total.
    pub fn new(cycles: f64, quiet: bool) -> Self {
        let bar = bar((cycles * PARTS) as usize, TIMES, quiet);
        let reached = |state: &ProgressState, out: &mut dyn fmt::Write| {
            let _ = write!(out, "cycle {:.1}", state.pos() as f64 / PARTS);
        };
        bar.set_style(bar.style().with_key("msg", reached));
        if !bar.is_hidden() {
            bar.enable_steady_tick(INTERVAL);
        }
        Self(bar)
    }

    /// Shows that `cycle` is reached.
    pub fn at(&self, cycle: f64) {
        self.0.set_position((cycle * PARTS) as u64);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        let bar = std::mem::replace(&mut self.0, ProgressBar::hidden());
        without_waiting(!bar.is_hidden(), move || bar.finish_and_clear());
    }
}

//! Time travel: back to earlier states, and on from there.

use super::*;
use crate::tui::undo::Kept;

/// Minimum time between stored states while running.
const APART: Duration = Duration::from_millis(50);

impl Worker {
    /// Stores the present state.
    pub(super) fn keep(&mut self) {
        self.past.keep(&self.run);
        self.kept_at = Instant::now();
    }

    /// Stores the end of a cycle, but not so often that it takes noticeable time.
    pub(super) fn keep_cycle(&mut self, before: f64) {
        if ends_cycle(before, self.run.cycle()) && self.kept_at.elapsed() > APART {
            self.keep();
        }
    }

    /// Continues from the state on the screen, if it is in the past. The way back leads to the run that
    /// it leaves; returns the notice about that.
    pub(super) fn branch(&mut self) -> Option<String> {
        let left = self.past.branch()?;
        let (cycle, end) = (self.run.cycle(), left.end.run.cycle());
        if let Some(keeping) = self.keeping.as_ref().filter(|_| left.is_other_run) {
            locked(keeping).turn_over(&left.end.run.session, &self.run.session);
        }
        Some(format!(
            "branch at cycle {cycle:.2}; [ leads back to the run up to {end:.2}"
        ))
    }

    /// Shows another stored state, or says why there is none.
    pub(in crate::tui) fn travel(
        &mut self,
        way: impl FnOnce(&mut Past) -> Option<Arc<Kept>>,
        end: &str,
    ) {
        self.keep();
        match way(&mut self.past) {
            Some(kept) => self.show(&kept),
            None => self.screen.notice(end),
        }
    }

    /// Shows a stored state, paused.
    fn show(&mut self, kept: &Kept) {
        self.run = kept.run.clone();
        self.companions.comparison = None;
        self.activity = Activity::Paused;
        self.facts = Facts::of(&self.run.session);
    }
}

/// Whether a cycle ends between two moments, in cycles.
pub(in crate::tui) fn ends_cycle(before: f64, now: f64) -> bool {
    (now + 1e-9).floor() > (before + 1e-9).floor()
}

//! Time travel: back to earlier states, and on from there.

use super::*;
use crate::tui::undo::Kept;

impl Worker {
    /// Stores the present state.
    pub(super) fn keep(&mut self) {
        self.past.keep(&self.run);
        self.kept_at = Instant::now();
    }

    /// Continues from the state on the screen, if it is in the past. The way back leads to the run that
    /// it leaves; returns the notice about that.
    pub(super) fn branch(&mut self) -> Option<String> {
        let left = self.past.branch()?;
        let (cycle, end) = (self.run.cycle(), left.end.run.cycle());
        if left.is_other_run {
            locked(&self.autosave).turn_over(&left.end.run.session, &self.run.session);
        }
        Some(format!(
            "branch at cycle {cycle:.2}; [ leads back to the run up to {end:.2}"
        ))
    }

    /// Shows another stored state, paused, or says why there is none.
    pub(in crate::tui) fn travel(
        &mut self,
        way: impl FnOnce(&mut Past) -> Option<Arc<Kept>>,
        end: &str,
    ) {
        self.keep();
        let Some(kept) = way(&mut self.past) else {
            return self.screen.notice(end);
        };
        self.run = kept.run.clone();
        self.comparison = None;
        self.activity = Activity::Paused;
        self.facts = Facts::of(&self.run.session);
    }
}

/// Whether a cycle ends between two moments, in cycles.
pub(in crate::tui) fn ends_cycle(before: f64, now: f64) -> bool {
    (now + 1e-9).floor() > (before + 1e-9).floor()
}

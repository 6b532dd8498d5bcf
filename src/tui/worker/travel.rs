//! Time travel: back to earlier states, and on from there.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::Worker;
use crate::tui::frame::Activity;
use crate::tui::trend::Trend;
use crate::tui::undo::{Kept, Past};

/// Minimum time between stored states while running.
const APART: Duration = Duration::from_millis(50);

impl Worker {
    /// Stores the present state.
    pub(super) fn keep(&mut self) {
        self.past.keep(&self.session, &self.trend);
        self.kept_at = Instant::now();
    }

    /// Stores the end of a cycle, but not so often that it takes noticeable time.
    pub(super) fn keep_cycle(&mut self, before: f64) {
        if ends_cycle(before, self.session.simulation().cycle()) && self.kept_at.elapsed() > APART {
            self.keep();
        }
    }

    /// Continues from the state on the screen, if it is in the past. The present that it leaves is
    /// bookmarked, so that `B` finds it again; returns the notice about that.
    pub(super) fn branch(&mut self) -> Option<String> {
        let whole_trend = self.whole_trend.take();
        let present = self.past.present()?;
        let left = self.past.line(&self.session).clone();
        self.past.branch();
        self.past.mark(&left, &whole_trend.unwrap_or_default());
        let cycle = self.session.simulation().cycle();
        Some(format!(
            "branch at cycle {cycle:.2}; B returns to the run up to {present:.2}"
        ))
    }

    /// Shows another stored state, or says why there is none.
    pub(super) fn travel(&mut self, way: fn(&mut Past) -> Option<Arc<Kept>>, end: &str) {
        self.keep();
        match way(&mut self.past) {
            Some(kept) => {
                let trend = self
                    .whole_trend
                    .take()
                    .unwrap_or_else(|| self.trend.clone());
                self.show(&kept, trend);
            }
            None => self.notice(end),
        }
    }

    /// Shows a stored state, paused.
    fn show(&mut self, kept: &Kept, whole_trend: Trend) {
        self.session = kept.session.clone();
        let cycle = self.session.simulation().cycle();
        self.trend = whole_trend.until(cycle, &kept.tip);
        self.whole_trend = self.past.present().is_some().then_some(whole_trend);
        self.comparison = None;
        self.activity = Activity::Paused;
        self.learn();
    }

    /// Bookmarks the state on the screen.
    pub(super) fn mark(&mut self) {
        self.keep();
        let dropped = self.past.mark(&self.session, &self.trend);
        let cycle = self.session.simulation().cycle();
        let marks = self.past.marks();
        let others = match marks {
            1 => String::new(),
            marks => format!(" ({marks} in all)"),
        };
        let full = match dropped {
            0 => "",
            _ => "; memory is full, so the oldest one was dropped",
        };
        self.notice(&format!(
            "bookmark set at cycle {cycle:.2}{others}; B returns to it{full}"
        ));
    }

    /// Goes to the previous bookmark.
    pub(super) fn visit(&mut self) {
        self.keep();
        let Some(mark) = self.past.bookmark_before(&self.session) else {
            return self.notice("no bookmark yet; b sets one here");
        };
        let whole_trend = self.whole_trend.take();
        self.past.visit(&mark);
        // On the present branch the trend continues after the bookmark.
        let trend = match self.past.present() {
            Some(_) => whole_trend.unwrap_or_else(|| self.trend.clone()),
            None => mark.trend.clone(),
        };
        self.show(&mark.kept, trend);
    }
}

/// Whether a cycle ends between two moments, in cycles.
pub(super) fn ends_cycle(before: f64, now: f64) -> bool {
    (now + 1e-9).floor() > (before + 1e-9).floor()
}

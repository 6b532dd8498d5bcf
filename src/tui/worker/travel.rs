//! Going back in time, and on from there.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::Worker;
use crate::tui::frame::Activity;
use crate::tui::trend::Trend;
use crate::tui::undo::{Kept, Past};

/// States to come back to are kept at least this far apart while it runs.
const APART: Duration = Duration::from_millis(50);

impl Worker {
    /// Keeps the present state to come back to.
    pub(super) fn keep(&mut self) {
        self.past.keep(&self.session, &self.trend);
        self.kept_at = Instant::now();
    }

    /// Keeps the end of a cycle, but not so often that it costs time.
    pub(super) fn keep_cycle(&mut self, before: f64) {
        if ends_cycle(before, self.session.simulation().cycle()) && self.kept_at.elapsed() > APART {
            self.keep();
        }
    }

    /// Goes on from the state on the screen, if it is in the past. The present that it leaves is marked,
    /// so that `B` finds it again; returns what there is to say of that.
    pub(super) fn branch(&mut self) -> Option<String> {
        let whole_trend = self.whole_trend.take();
        let present = self.past.present()?;
        let left = self.past.line(&self.session).clone();
        self.past.branch();
        self.past.mark(&left, &whole_trend.unwrap_or_default());
        let cycle = self.session.simulation().cycle();
        Some(format!(
            "branch from cycle {cycle:.2}; the run up to cycle {present:.2} is kept: B goes there"
        ))
    }

    /// Shows another kept state, or says why there is none.
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

    /// Puts a kept state on the screen, paused.
    fn show(&mut self, kept: &Kept, whole_trend: Trend) {
        self.session = kept.session.clone();
        let cycle = self.session.simulation().cycle();
        self.trend = whole_trend.until(cycle, &kept.tip);
        self.whole_trend = self.past.present().is_some().then_some(whole_trend);
        self.comparison = None;
        self.activity = Activity::Paused;
        self.learn();
    }

    /// Marks the state on the screen.
    pub(super) fn mark(&mut self) {
        self.keep();
        let dropped = self.past.mark(&self.session, &self.trend);
        let cycle = self.session.simulation().cycle();
        let marks = self.past.marks();
        let marks = match marks {
            1 => "1 state is marked".to_owned(),
            marks => format!("{marks} states are marked"),
        };
        let full = match dropped {
            0 => "",
            _ => "; memory is full, so the oldest mark was dropped",
        };
        self.notice(&format!(
            "cycle {cycle:.2} is marked; {marks}, B goes to them{full}"
        ));
    }

    /// Goes to the marked state before this one.
    pub(super) fn visit(&mut self) {
        self.keep();
        let Some(mark) = self.past.bookmark_before(&self.session) else {
            return self.notice("no state is marked; b marks this one");
        };
        let whole_trend = self.whole_trend.take();
        self.past.visit(&mark);
        // On the line of the present the trend goes on after the bookmark.
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

//! Time travel: back to earlier states, and on from there.

use super::outlet::ScenarioFacts;
use super::{BROKEN_DOWN, Worker};
use crate::panics::locked;
use crate::scenario::Change;
use crate::tui::frame::Activity;
use crate::tui::recorded::Recorded;
use crate::tui::undo::Way;

impl Worker {
    /// Continues from the state on the screen, if it is in the past. The user can go back to the run that it leaves;
    /// returns the notice about that.
    pub(super) fn branch(&mut self) -> Option<String> {
        let left = self.past.branch()?;
        let (cycle, end) = (self.run.cycle(), left.end.run.cycle());
        if left.is_other_run {
            locked(&self.autosave).begin_session(&left.end.run, &self.run);
        }
        Some(format!(
            "branch at cycle {cycle:.2}; [ leads back to the run up to {end:.2}"
        ))
    }

    /// Shows another stored state and pauses, or says why there is none.
    pub(super) fn travel(&mut self, way: Way) {
        self.past.store(&self.run);
        match self.past.visit(way) {
            Ok(kept) => self.show(kept.run.clone()),
            Err(end) => return self.screen.notice(end),
        }
        (self.pace.activity, self.pace.stop_at) = (Activity::Paused, None);
        self.ghosts.rival = None;
    }

    /// Shows a state of the past.
    fn show(&mut self, run: Recorded) {
        self.facts = ScenarioFacts::new(&run.session);
        self.run = run;
    }

    /// Shows the run at `cycle`. It steps to a past cycle from the stored state before it, and runs to a future one at
    /// full speed.
    pub(super) fn go_to(&mut self, cycle: f64) {
        let end = self.past.line(&self.run).cycle();
        if cycle <= end {
            self.travel(Way::Before(cycle));
            return self.step_within_past(cycle);
        }
        if self.past.present().is_some() {
            self.travel(Way::Present);
        }
        if matches!(self.pace.activity, Activity::Stopped(_)) {
            return self.screen.notice(BROKEN_DOWN);
        }
        (self.pace.activity, self.pace.stop_at) = (Activity::Running, Some(cycle));
        let under_way = format!("on the way to cycle {cycle}; Space stops");
        self.screen.notice(&under_way);
    }

    /// Steps from the past state on the screen to `cycle`, with the same steps and changes as the run.
    fn step_within_past(&mut self, cycle: f64) {
        let (mut run, before) = (self.run.clone(), self.run.cycle());
        let made = run.session.changes().len();
        let changes = self.past.line(&self.run).session.changes();
        let later = changes.iter().skip(made);
        let due = later.take_while(|change| change.at_cycle <= cycle);
        let due: Vec<Change> = due.cloned().collect();
        let ends = due.iter().map(|change| (change.at_cycle, Some(change)));
        for (end, change) in ends.chain([(cycle, None)]) {
            while run.cycle() < end && !self.is_over() {
                let stepped = run.step_until(end);
                if self.screen.or_notice(stepped).is_none() {
                    return;
                }
            }
            let changed = change.map(|change| run.session.make(vec![change.clone()]));
            if self.screen.or_notice(changed.unwrap_or(Ok(()))).is_none() {
                return;
            }
        }
        if run.cycle() > before || !due.is_empty() {
            self.past.insert(run.clone());
            self.show(run);
        }
    }

    /// Goes to the next or the previous cycle at which the scenario writes a state.
    pub(super) fn go_to_planned(&mut self, forward: bool) {
        let (now, plan) = (self.run.cycle(), self.run.session.loaded().run());
        let planned = plan.snapshot_at.iter().chain(&plan.cycles).copied();
        let next = if forward {
            planned.filter(|cycle| *cycle > now + 1e-9).reduce(f64::min)
        } else {
            planned.filter(|cycle| *cycle < now - 1e-9).reduce(f64::max)
        };
        match next {
            Some(cycle) => self.go_to(cycle),
            None => {
                let side = if forward { "later" } else { "earlier" };
                self.screen.notice(&format!(
                    "no {side} cycle is planned to be written (run.snapshot_at)"
                ));
            }
        }
    }
}

/// Whether a cycle ends between two moments, in cycles.
pub(in crate::tui) fn ends_cycle(before: f64, now: f64) -> bool {
    (now + 1e-9).floor() > (before + 1e-9).floor()
}

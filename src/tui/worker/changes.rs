//! Changes during the run: a value, method or law, or another scenario.

use super::Worker;
use super::outlet::Facts;
use crate::math::abel::AbelMethod;
use crate::math::scan::shifted;
use crate::panics::locked;
use crate::scenario::Scenario;
use crate::scenario::session::{Session, SessionError};
use crate::scenario::spec::{Law, Spec};
use crate::studies::refinement::{self, Level};
use crate::tui::beside::Twin;
use crate::tui::event::Event;
use crate::tui::frame::Activity;
use crate::tui::ghosts::Source;
use crate::tui::trend::Recorded;

/// Factor by which each key press refines or coarsens cells and steps.
const STRIDE: f64 = 1.5;

/// Minimum number of cells that the key can reach.
const COARSEST: usize = 8;

impl Worker {
    /// Steps by this many places through the transform methods, of a comparison if there is one.
    pub fn change_method(&mut self, places: isize) {
        if let Some(rival) = &self.rival {
            return self.compare(rival.choice + places, rival.since);
        }
        let setup = self.run.simulation().setup();
        let methods = AbelMethod::for_geometry(setup.geometry);
        if methods.len() < 2 {
            return self
                .screen
                .notice("a line contact has the method product only");
        }
        let method = shifted(methods, setup.method, places);
        self.edit(|spec| spec.numerics.method = Some(method));
    }

    /// Steps by this many places through the wear laws.
    pub fn change_law(&mut self, places: isize) {
        let told = "this scenario has no wear, so it has no wear law to change";
        match self.run.simulation().setup().wear {
            None => self.screen.notice(told),
            Some(_) => self.edit(|spec| {
                if let Some(wear) = &mut spec.wear {
                    wear.law = wear.law.map(|now| shifted(&Law::ALL, now, places));
                }
            }),
        }
    }

    /// Refines or coarsens cells and steps together, by `STRIDE` per place.
    pub fn refine(&mut self, places: isize) {
        let scenario = self.run.session.scenario();
        let now = Level::from_scenario(scenario);
        let factor = STRIDE.powf(places as f64);
        let next = now.scaled(factor, factor);
        let within = COARSEST..=scenario.setup().method.most_cells();
        if next == now || !within.contains(&next.points) {
            let end = if places > 0 { "finest" } else { "coarsest" };
            let told = format!("N = {}: this is the {end} level", now.points);
            return self.screen.notice(&told);
        }
        let Level { points, steps, .. } = next;
        let done = format!("N = {points}, {steps} steps per cycle; a estimates the error");
        self.change_by(|run| {
            run.edit(|spec| next.set(&mut spec.numerics))?;
            Ok(done)
        });
    }

    /// Changes parts of the scenario from here on.
    fn edit(&mut self, edit: impl FnOnce(&mut Spec)) {
        self.change_by(|run| {
            let edits = run.edit(edit)?.into_iter();
            let keys = edits.map(|(key, value)| format!("{key} = {}", value.trim_matches('"')));
            Ok(at_cycle(run, &keys.collect::<Vec<_>>().join(", ")))
        });
    }

    /// Changes a key from here on; further `, KEY=VALUE` in `value` change at the same time.
    pub fn change(&mut self, key: &str, value: &str) {
        self.change_by(|run| {
            run.change_all(&assignments(key, value))?;
            Ok(at_cycle(run, &format!("{key} = {value}")))
        });
    }

    /// Changes a key from here on. Before the first such change, a copy of the run is kept, which continues as a ghost.
    pub(in crate::tui) fn change_beside(&mut self, key: &str, value: &str) {
        let before = self.before.is_none().then(|| self.run.session.clone());
        let made = self.run.session.changes().len();
        self.change(key, value);
        if self.run.session.changes().len() != made {
            self.before = before.map(Source::unchanged).or(self.before.take());
        }
    }

    /// Drops the ghost of the run before the changes.
    pub(in crate::tui) fn end_changes(&mut self) {
        self.before = None;
    }

    /// Has `change` change the run from here on, and tells the user what it has done.
    fn change_by(&mut self, change: impl FnOnce(&mut Session) -> Result<String, SessionError>) {
        self.store();
        let changed = change(&mut self.run.session);
        let Some(done) = self.screen.or_notice(changed) else {
            return;
        };
        let branched = self.branch();
        self.renew();
        if matches!(self.activity, Activity::Stopped(_)) {
            self.activity = Activity::Paused;
        }
        let branched = branched.map_or_else(String::new, |word| format!("; {word}"));
        self.screen.notice(&format!("{done}{branched}"));
    }

    /// Updates the facts and the twin after a change of the scenario.
    pub(super) fn renew(&mut self) {
        self.facts = Facts::new(&self.run.session);
        self.twin = Twin::new(&self.run.session);
    }

    /// Restarts the scenario as it was loaded; the user can go back to the run so far.
    pub fn restart(&mut self) {
        let cycle = self.past.line(&self.run).cycle();
        self.load(self.run.session.loaded().clone());
        if cycle > 0.0 {
            let told = format!("restarted; [ leads back to the run up to cycle {cycle:.2}");
            self.screen.notice(&told);
        }
    }

    /// Starts another scenario; returns whether it can be run.
    pub fn load(&mut self, scenario: Scenario) -> bool {
        let resolved = refinement::resolve_soon(&scenario);
        let Some(resolved) = self.screen.or_notice(resolved) else {
            return false;
        };
        if let Some(word) = resolved.warning {
            self.screen.notice(&word);
        }
        let session = self.screen.or_notice(Session::start(resolved.scenario));
        let begun = session.map(|session| self.replace_run(session.into()));
        begun.is_some()
    }

    /// Loads a point of a study and closes the study's map.
    pub fn open_point(&mut self, scenario: Scenario) {
        if self.load(scenario) {
            self.publish();
            self.screen.send(Event::Opened);
        }
    }

    /// Replaces this run by another one, new or read from a file.
    pub fn replace_run(&mut self, run: Recorded) {
        self.store();
        let left = &self.past.line(&self.run).session;
        locked(&self.autosave).begin_session(left, &run.session);
        self.past.leave();
        self.snapshots.clear();
        self.run = run;
        (self.stop_at, self.rival, self.before) = (None, None, None);
        self.renew();
        if self.activity != Activity::Running {
            self.activity = Activity::Paused;
        }
    }
}

/// What was `done`, and when.
fn at_cycle(run: &Session, done: &str) -> String {
    format!("{done} at cycle {:.2}", run.simulation().cycle())
}

/// Returns the keys and values of `KEY` and `VALUE, KEY=VALUE, ...`.
fn assignments(key: &str, value: &str) -> Vec<(String, String)> {
    let mut parts: Vec<(String, String)> = Vec::new();
    let whole = format!("{key}={value}");
    for part in whole.split(',') {
        match (part.split_once('='), parts.last_mut()) {
            (Some((key, value)), _) => parts.push((key.trim().to_owned(), value.trim().to_owned())),
            // A comma within a value.
            (None, Some((_, value))) => value.push_str(&format!(",{part}")),
            (None, None) => {}
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn several_keys_change_at_once() {
        let parts = assignments("motion.normal.control", "force, motion.normal.mean=30.0");
        let pair = |key: &str, value: &str| (key.to_owned(), value.to_owned());
        let expected = [
            pair("motion.normal.control", "force"),
            pair("motion.normal.mean", "30.0"),
        ];
        assert_eq!(parts, expected);
        assert_eq!(assignments("run.note", "a, b"), [pair("run.note", "a, b")]);
    }
}

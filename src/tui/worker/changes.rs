//! Changes during the run: a value, method or law, or another scenario.

use std::mem::replace;

use strum::VariantArray;

use super::outlet::ScenarioFacts;
use super::{SessionChange, Worker};
use crate::math::abel::AbelMethod;
use crate::math::scan::shifted;
use crate::panics::locked;
use crate::scenario::session::{Session, SessionError};
use crate::scenario::spec::Spec;
use crate::scenario::{Refusal, Scenario};
use crate::studies::refinement::{self, Level};
use crate::tui::following::Twin;
use crate::tui::frame::Activity;
use crate::tui::ghosts::Source;
use crate::tui::recorded::Recorded;
use crate::wear::Law;

/// Factor by which each key press refines or coarsens cells and steps.
const STRIDE: f64 = 1.5;

/// Minimum number of cells that the key can reach.
const COARSEST: usize = 8;

/// Sets a key; further `, KEY=VALUE` in `value` change at the same time.
pub(in crate::tui) fn set(key: impl Into<String>, value: impl Into<String>) -> SessionChange {
    let (key, value) = (key.into(), value.into());
    Box::new(move |run| {
        run.assign(&assignments(&key, &value))?;
        Ok(at_cycle(run, &format!("{key} = {value}")))
    })
}

/// Steps by this many places through the wear laws.
pub(in crate::tui) fn shift_law(places: isize) -> SessionChange {
    Box::new(move |run| {
        if run.simulation().setup().wear.is_none() {
            return refuse("this scenario has no wear, so it has no wear law to change");
        }
        edit(run, |spec| {
            if let Some(wear) = &mut spec.wear {
                wear.law = wear.law.map(|now| shifted(Law::VARIANTS, now, places));
            }
        })
    })
}

/// Refines or coarsens cells and steps together, by `STRIDE` per place.
pub(in crate::tui) fn refine(places: isize) -> SessionChange {
    Box::new(move |run| {
        let now = Level::from_scenario(run.scenario());
        let factor = STRIDE.powf(places as f64);
        let next = now.scaled(factor, factor);
        let within = COARSEST..=run.scenario().setup().method.most_cells();
        if next == now || !within.contains(&next.points) {
            let end = if places > 0 { "finest" } else { "coarsest" };
            return refuse(&format!("N = {}: this is the {end} level", now.points));
        }
        run.edit(|spec| next.set(&mut spec.numerics))?;
        let Level { points, steps, .. } = next;
        Ok(format!(
            "N = {points}, {steps} steps per cycle; a estimates the error"
        ))
    })
}

/// Edits the scenario of a run, and says what has changed.
fn edit(run: &mut Session, edit: impl FnOnce(&mut Spec)) -> Result<String, SessionError> {
    let edits = run.edit(edit)?.into_iter();
    let keys = edits.map(|(key, value)| format!("{} = {}", key.path, value.bare()));
    Ok(at_cycle(run, &keys.collect::<Vec<_>>().join(", ")))
}

fn refuse(reason: &str) -> Result<String, SessionError> {
    Err(Refusal::from(reason.to_owned()).into())
}

/// What was `done`, and when.
fn at_cycle(run: &Session, done: &str) -> String {
    format!("{done} at cycle {:.2}", run.simulation().cycle())
}

impl Worker {
    /// Steps by this many places through the transform methods, of a comparison if there is one.
    pub(super) fn change_method(&mut self, places: isize) {
        if let Some(notice) = self.ghosts.shift_rival(&self.run, places) {
            return self.screen.notice(&notice);
        }
        let shift = Box::new(move |run: &mut Session| {
            let setup = run.simulation().setup();
            let methods = AbelMethod::for_geometry(setup.geometry);
            if methods.len() < 2 {
                return refuse("a line contact has the method product only");
            }
            let method = shifted(&methods, setup.method, places);
            edit(run, |spec| spec.numerics.method = Some(method))
        });
        self.change(shift, false);
    }

    /// Applies `change` to the run from here on, and shows what it has done. If `with_ghost`, the run from before the
    /// first such change continues as a ghost.
    pub(super) fn change(&mut self, change: SessionChange, with_ghost: bool) {
        let mut changed = self.run.clone();
        let Some(done) = self.screen.or_notice(change(&mut changed.session)) else {
            return;
        };
        self.past.store(&self.run);
        let before = replace(&mut self.run, changed).session;
        if with_ghost && before.changes().len() != self.run.session.changes().len() {
            let ghost = &mut self.ghosts.before;
            ghost.get_or_insert_with(|| Source::unchanged(before));
        }
        let branched = self.branch();
        self.renew();
        if matches!(self.pace.activity, Activity::Stopped(_)) {
            self.pace.activity = Activity::Paused;
        }
        let branched = branched.map_or_else(String::new, |word| format!("; {word}"));
        self.screen.notice(&format!("{done}{branched}"));
    }

    /// Updates the facts and the twin after a change of the scenario.
    pub(super) fn renew(&mut self) {
        self.facts = ScenarioFacts::new(&self.run.session);
        self.twin = Twin::new(&self.run.session);
    }

    /// Restarts the scenario as it was loaded; the user can go back to the run so far.
    pub(super) fn restart(&mut self) {
        let cycle = self.past.line(&self.run).cycle();
        self.load(self.run.session.loaded().clone());
        if cycle > 0.0 {
            let notice = format!("restarted; [ leads back to the run up to cycle {cycle:.2}");
            self.screen.notice(&notice);
        }
    }

    /// Starts another scenario; returns whether it can be run.
    pub(super) fn load(&mut self, scenario: Scenario) -> bool {
        let resolved = refinement::resolve_soon(&scenario);
        let Some(resolved) = self.screen.or_notice(resolved) else {
            return false;
        };
        self.screen.tell(resolved.warning);
        let session = self.screen.or_notice(Session::start(resolved.scenario));
        session
            .map(|session| self.replace_run(session.into()))
            .is_some()
    }

    /// Replaces this run by another one, new or read from a file.
    pub(super) fn replace_run(&mut self, run: Recorded) {
        self.past.store(&self.run);
        locked(&self.autosave).begin_session(self.past.line(&self.run), &run);
        self.past.leave();
        self.screen.snapshots.clear();
        self.run = run;
        self.pace.stop_at = None;
        (self.ghosts.rival, self.ghosts.before) = (None, None);
        self.renew();
        if !self.pace.is_running() {
            self.pace.activity = Activity::Paused;
        }
    }
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

//! The scenarios that changes during a run lead to.

use super::change::{Change, MOST_CHANGES, Planned};
use super::escape::echo;
use super::key::{Key, join};
use super::spec::ControlWord;
use super::value::Value;
use super::{Refusal, Scenario, printable, units};

/// Groups changes, in their order, by cycle.
pub(super) fn at_one_cycle(changes: &[Change]) -> impl Iterator<Item = &[Change]> {
    changes.chunk_by(|a, b| a.at_cycle == b.at_cycle)
}

impl Scenario {
    /// Returns the scenario after `changes` of one cycle, which are only valid together; it has no changes itself.
    /// Applied to one cycle after another, it yields the stages of a run.
    ///
    /// # Errors
    ///
    /// Values that are refused.
    pub fn after(&self, changes: &[Change]) -> Result<Self, Refusal> {
        let places: Vec<String> = changes.iter().map(|of| echo(&of.to_string())).collect();
        self.changed(changes, &places)
    }

    /// Reads changes of one cycle, each in the unit that the motion then has.
    pub(super) fn read_changes(&self, planned: &[Planned]) -> Result<Vec<Change>, Refusal> {
        let is_force = |key: Key| {
            let control = join(key.section(), "control");
            let given = planned.iter().rev().find(|of| of.key.path == control);
            given.map_or_else(
                || self.prescribes_force(key.path),
                |of| of.raw.as_str() == Some(ControlWord::Force.into()),
            )
        };
        let read = planned.iter().map(|of| of.change(is_force(of.key)));
        read.collect()
    }

    /// Walks through the stages of a run, those `made` so far and those `planned`, to find a change that cannot be made
    /// before the run starts.
    pub(super) fn plan_changes(
        &self,
        made: Vec<Change>,
        planned: Vec<Planned>,
    ) -> Result<Vec<Change>, Refusal> {
        let origin = printable(&self.origin);
        let made = made.into_iter().enumerate();
        let made = made.map(|(at, change)| Planned {
            place: format!("{origin}: changes[{at}].set = \"{change}\""),
            at_cycle: change.at_cycle,
            key: change.key,
            raw: (&change.value).into(),
        });
        let planned: Vec<Planned> = made.chain(planned).collect();
        let count = planned.len();
        if count > MOST_CHANGES {
            let rule = format!("must have at most {MOST_CHANGES} entries");
            return Err(Refusal::of_value(format!("{origin}: changes"), count, rule));
        }
        for (k, pair) in planned.windows(2).enumerate() {
            let [before, cycle] = [&pair[0], &pair[1]].map(|change| change.at_cycle);
            if cycle < before {
                let at = format!("{origin}: changes[{}].at_cycle", k + 1);
                let rule = format!("must be {before} or greater: changes must be in order");
                return Err(Refusal::of_value(at, cycle, rule));
            }
        }
        let (mut stage, mut changes) = (self.clone(), Vec::new());
        for together in planned.chunk_by(|a, b| a.at_cycle == b.at_cycle) {
            let read = stage.read_changes(together)?;
            let places: Vec<String> = together.iter().map(|of| of.place.clone()).collect();
            stage = stage.changed(&read, &places)?;
            changes.extend(read);
        }
        Ok(changes)
    }

    /// Returns the scenario after `changes` of one cycle; messages call each change by its place.
    pub(super) fn changed(&self, changes: &[Change], places: &[String]) -> Result<Self, Refusal> {
        self.refuse_values_in_other_units(changes, places)?;
        let mut draft = self.draft();
        draft.spec.changes.clear();
        for (change, place) in changes.iter().zip(places) {
            draft.put(change.key, (&change.value).into(), place);
        }
        Self::build(draft)
    }

    /// Refuses a change of control without new values: the motion then has another unit, and metres given for the old
    /// control must not be read as newtons.
    fn refuse_values_in_other_units(
        &self,
        changes: &[Change],
        places: &[String],
    ) -> Result<(), Refusal> {
        let last = |path: &str| changes.iter().rposition(|change| change.key.path == path);
        for (section, before) in self.spec.motion.directions() {
            let Some(at) = last(&join(section, "control")) else {
                continue;
            };
            let control = &changes[at].value;
            let is_same =
                before.control.map(|word| Value::Word(word.into())) == Some(control.clone());
            for (key, value) in [("mean", before.mean), ("amplitude", before.amplitude)] {
                let path = join(section, key);
                let is_stale = !is_same && last(&path).is_none();
                if is_stale && value.is_some_and(|value| value != 0.0) {
                    let is_force = *control == Value::Word(ControlWord::Force.into());
                    let unit = units::unit_of(&Key::known(&path), is_force);
                    let rule = format!("needs {path} in {unit}, changed at the same cycle");
                    return Err(Refusal::new(&places[at], rule));
                }
            }
        }
        Ok(())
    }
}

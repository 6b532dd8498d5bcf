//! Changes made during a run: `[[changes]]`, and the resulting scenarios.

use super::change::Change;
use super::draft::{self, Draft};
use super::error::Origin;
use super::escape::echo;
use super::spec::{Control, Spec};
use super::{Refusal, Scenario, schema, units, values};
use std::path::Path;

impl Change {
    /// Returns the change with another value of the key: what it sets, edited.
    #[must_use]
    pub fn edited(&self, edit: impl FnOnce(&mut Spec)) -> Self {
        let mut edited = self.clone();
        let mut draft = Draft::new(Spec::default(), "");
        if draft.assign(self.key(), self.value(), "").is_ok()
            && let Ok(mut read) = draft.finish(Path::new(""))
        {
            edit(&mut read.spec);
            read.spec.write_changes(std::slice::from_mut(&mut edited));
        }
        edited
    }
}

/// Groups changes, in their order, by cycle.
pub(super) fn at_one_cycle(changes: &[Change]) -> impl Iterator<Item = &[Change]> {
    changes.chunk_by(|a, b| a.at_cycle == b.at_cycle)
}

impl Scenario {
    /// Returns the scenario after `changes` of one cycle, which are only valid together; it has no changes itself.
    /// Applied to one cycle after another, it yields the stages of a run.
    pub fn after(&self, changes: &[Change]) -> Result<Self, Refusal> {
        self.changed(changes, |at| echo(&changes[at].set))
    }

    /// Walks through the stages of a run, to find a change that cannot be made before the run starts.
    pub(super) fn check_changes(&self, changes: &[Change], from: &Origin) -> Result<(), Refusal> {
        for (k, pair) in changes.windows(2).enumerate() {
            let [before, cycle] = [&pair[0], &pair[1]].map(|change| change.at_cycle);
            if cycle < before {
                let at = format!("changes[{}].at_cycle", k + 1);
                let rule = format!("must be {before} or greater: changes must be in order");
                return Err(from.refuse(&at, &cycle.to_string(), rule));
            }
        }
        let (mut stage, mut first) = (self.clone(), 0);
        for together in at_one_cycle(changes) {
            stage = stage.changed(together, |at| {
                let path = format!("changes[{}].set", first + at);
                from.place(&path, &format!("\"{}\"", echo(&together[at].set)))
            })?;
            first += together.len();
        }
        Ok(())
    }

    /// Returns the scenario after `changes` of one cycle; messages call each change by its `place`.
    fn changed(
        &self,
        changes: &[Change],
        place: impl Fn(usize) -> String,
    ) -> Result<Self, Refusal> {
        let mut spec = self.spec.clone();
        spec.changes.clear();
        let mut draft = Draft::new(spec, &self.origin);
        for (at, change) in changes.iter().enumerate() {
            let written = place(at);
            let (key, value) = draft::split(&change.set, &written)?;
            if let Some(because) = schema::find(key).and_then(|known| known.fixed) {
                let rule = format!("{key} cannot change during a run: {because}");
                return Err(Refusal::new(written, rule));
            }
            draft.assign(key, value, &written)?;
        }
        let changed = Self::build(draft, &self.origin, &self.directory);
        let spec = changed.as_ref().map(|changed| &changed.spec);
        self.refuse_values_in_other_units(spec.ok(), changes, place)?;
        changed
    }

    /// Refuses a change of control without new values: the motion then has another unit, and metres given for the old
    /// control must not be read as newtons.
    fn refuse_values_in_other_units(
        &self,
        after: Option<&Spec>,
        changes: &[Change],
        place: impl Fn(usize) -> String,
    ) -> Result<(), Refusal> {
        let changes_at = |path: &str| changes.iter().position(|change| change.key() == path);
        for (section, before) in self.spec.motion.directions() {
            let key = values::join(section, "control");
            let given = changes.iter().rev().find(|change| change.key() == key);
            let control = after
                .and_then(|after| after.motion.directions().find(|of| of.0 == section))
                .and_then(|of| of.1.control)
                .or_else(|| given?.value().trim_matches('"').parse().ok());
            let (Some(at), Some(control)) = (changes_at(&key), control) else {
                continue;
            };
            for (key, value) in [("mean", before.mean), ("amplitude", before.amplitude)] {
                let path = values::join(section, key);
                let is_stale = before.control != Some(control) && changes_at(&path).is_none();
                if is_stale && value.is_some_and(|value| value != 0.0) {
                    let unit = units::unit_of(schema::known(&path), control == Control::Force);
                    let rule = format!("needs {path} in {unit}, changed at the same cycle");
                    return Err(Refusal::new(place(at), rule));
                }
            }
        }
        Ok(())
    }
}

//! Builds coefficients that run in from the keys of a scenario.

use super::keys::{FRICTION_COURSE, WEAR_COURSE};
use super::*;
use crate::simulation::running_in::{Course, Over, RunningIn};

impl Parts<'_> {
    /// The coefficients that run in; `None` if they are constant.
    pub(super) fn running_in(
        &self,
        material: &Material,
    ) -> Result<Option<RunningIn>, ScenarioError> {
        let mut all = RunningIn {
            friction: self.course(&keys::FRICTION, &FRICTION_COURSE)?,
            wear: self.course(&keys::WEAR_COEFFICIENT, &WEAR_COURSE)?,
            wear_per_load: None,
            threshold: match self.has(WEAR_COURSE.section) {
                true => self.require(&keys::WEAR_THRESHOLD)?,
                false => 0.0,
            },
        };
        if let Some(per_load) = self.get(&keys::WEAR_PER_LOAD) {
            all.wear = None;
            all.wear_per_load = self.over_friction(per_load, all.friction.as_ref())?;
        }
        // Behind the threshold the coefficient is what it is without one.
        if all.threshold > 0.0 && all.wear.is_none() && all.wear_per_load.is_none() {
            let coefficient = self.wear_coefficient(material)?;
            let constant = Course::table(&[0.0], &[coefficient], Over::Cycles);
            all.wear =
                Some(constant.map_err(|invalid| self.refused(WEAR_COURSE.section, invalid))?);
        }
        Ok((all != RunningIn::default()).then_some(all))
    }

    /// A coefficient per load and distance, over friction that runs in; `None` where that is constant.
    fn over_friction(
        &self,
        per_load: f64,
        friction: Option<&Course>,
    ) -> Result<Option<f64>, ScenarioError> {
        let Some(friction) = friction else {
            return Ok(None);
        };
        if friction.least() > 0.0 {
            return Ok(Some(per_load));
        }
        let rule = "needs friction greater than 0 at all times: per friction work it is \
                    k = coefficient_per_load / friction";
        Err(self.refuse(keys::WEAR_PER_LOAD.path(), "", rule))
    }

    fn course(&self, first: &Key<f64>, keys: &RunsIn) -> Result<Option<Course>, ScenarioError> {
        let refused = |invalid| self.refused(keys.section, invalid);
        for (at, over) in [
            (&keys.at_cycle, Over::Cycles),
            (&keys.at_energy, Over::Energy),
        ] {
            let Some(rows) = self.get(at) else { continue };
            let course = Course::table(&rows, &self.require(&keys.values)?, over);
            return course.map(Some).map_err(refused);
        }
        for (constant, over) in [(&keys.cycles, Over::Cycles), (&keys.energy, Over::Energy)] {
            let Some(constant) = self.get(constant) else {
                continue;
            };
            let (first, settled) = (self.require(first)?, self.require(&keys.settled)?);
            let course = Course::exponential(first, settled, constant, over);
            return course.map(Some).map_err(refused);
        }
        if self.has(keys.settled.path()) {
            let rule = format!("needs {} or {}", keys.cycles.path(), keys.energy.path());
            return Err(self.refuse(keys.settled.path(), "", rule));
        }
        Ok(None)
    }
}

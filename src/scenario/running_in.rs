//! Builds coefficients that run in from the keys of a scenario.

use super::error::ScenarioError;
use super::keys::{self, FRICTION_COURSE, RunsIn, WEAR_COURSE};
use super::schema::Key;
use super::validate::Parts;
use crate::contact::material::Material;
use crate::math::invalid::Invalid;
use crate::simulation::running_in::{Course, Over, RunningIn};

impl Parts<'_> {
    /// The coefficients that run in; `None` if they are constant.
    pub(super) fn running_in(
        &self,
        material: &Material,
    ) -> Result<Option<RunningIn>, ScenarioError> {
        self.refuse_coefficients_of_both_kinds()?;
        let mut all = RunningIn {
            friction: self.course(&keys::FRICTION, &FRICTION_COURSE)?,
            wear: self.course(&keys::WEAR_COEFFICIENT, &WEAR_COURSE)?,
            threshold: match self.has(WEAR_COURSE.section) {
                true => self.require(&keys::WEAR_THRESHOLD)?,
                false => 0.0,
            },
        };
        if let Some(per_load) = self.get(&keys::WEAR_PER_LOAD) {
            all.wear = self.over_friction(per_load, all.friction.as_ref())?;
        }
        // Behind the threshold the coefficient is what it is without one.
        if all.threshold > 0.0 && all.wear.is_none() {
            let coefficient = self.wear_coefficient(material)?;
            let constant = Course::table(&[0.0], &[coefficient], Over::Cycles);
            all.wear =
                Some(constant.map_err(|invalid| self.refused(WEAR_COURSE.section, invalid))?);
        }
        Ok((all != RunningIn::default()).then_some(all))
    }

    /// Refuses a coefficient per load and distance together with what is told per friction work.
    fn refuse_coefficients_of_both_kinds(&self) -> Result<(), ScenarioError> {
        const PER_WORK: [&str; 5] = [
            keys::WEAR_COEFFICIENT.path(),
            WEAR_COURSE.settled.path(),
            WEAR_COURSE.cycles.path(),
            WEAR_COURSE.energy.path(),
            WEAR_COURSE.values.path(),
        ];
        let path = keys::WEAR_PER_LOAD.path();
        let mut others = PER_WORK.into_iter().filter(|other| self.has(other));
        match others.next().filter(|_| self.has(path)) {
            Some(other) => {
                let rule =
                    format!("conflicts with {other}, which is per friction work; give one of them");
                Err(self.refuse(path, "", rule))
            }
            None => Ok(()),
        }
    }

    /// A coefficient per load and distance, over friction that runs in; `None` where that is constant.
    fn over_friction(
        &self,
        per_load: f64,
        friction: Option<&Course>,
    ) -> Result<Option<Course>, ScenarioError> {
        let course = friction.map(|friction| Course::over(per_load, friction));
        course.transpose().map_err(|_| {
            let rule = "needs friction greater than 0 at all times: per friction work it is \
                        k = coefficient_per_load / friction";
            self.refuse(keys::WEAR_PER_LOAD.path(), "", rule)
        })
    }

    fn course(&self, first: &Key<f64>, keys: &RunsIn) -> Result<Option<Course>, ScenarioError> {
        let table = match (self.get(&keys.at_cycle), self.get(&keys.at_energy)) {
            (Some(at), None) => Some((at, Over::Cycles, keys.at_cycle.path())),
            (None, Some(at)) => Some((at, Over::Energy, keys.at_energy.path())),
            (None, None) => None,
            (Some(_), Some(_)) => {
                let rule = format!("conflicts with {}; give one of them", keys.at_cycle.path());
                return Err(self.refuse(keys.at_energy.path(), "", rule));
            }
        };
        if let Some((at, over, path)) = table {
            for key in [&keys.settled, &keys.cycles, &keys.energy] {
                if self.has(key.path()) {
                    let rule = "conflicts with a table of values; give one of them";
                    return Err(self.refuse(key.path(), "", rule));
                }
            }
            let values = self.require(&keys.values)?;
            let course = Course::table(&at, &values, over).map_err(|invalid| {
                let path = match invalid.field {
                    "at" => path,
                    _ => keys.values.path(),
                };
                self.refuse(path, &invalid.value, invalid.rule)
            })?;
            return Ok(Some(course));
        }
        let constant = match (self.get(&keys.cycles), self.get(&keys.energy)) {
            (Some(cycles), None) => Some((cycles, Over::Cycles)),
            (None, Some(energy)) => Some((energy, Over::Energy)),
            (None, None) => None,
            (Some(_), Some(_)) => {
                let rule = format!("conflicts with {}; give one of them", keys.cycles.path());
                return Err(self.refuse(keys.energy.path(), "", rule));
            }
        };
        let Some((constant, over)) = constant else {
            return match self.has(keys.settled.path()) {
                true => {
                    let rule = format!("needs {} or {}", keys.cycles.path(), keys.energy.path());
                    Err(self.refuse(keys.settled.path(), "", rule))
                }
                false => Ok(None),
            };
        };
        let (first, settled) = (self.require(first)?, self.require(&keys.settled)?);
        Course::exponential(first, settled, constant, over)
            .map(Some)
            .map_err(|invalid: Invalid| self.refused(keys.section, invalid))
    }
}

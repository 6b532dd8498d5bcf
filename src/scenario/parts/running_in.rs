//! Builds coefficients that run in from the keys of a scenario.

use super::{FRICTION, Noted, Parts, Section, WEAR};
use crate::scenario::spec::Coefficient;
use crate::simulation::running_in::{Course, Over, RunningIn};

impl Parts<'_> {
    /// Builds the coefficients that run in; `None` if they are constant.
    pub(super) fn running_in(&self) -> Result<Option<RunningIn>, Noted> {
        let (at, given) = (self.at(WEAR), self.spec.wear.as_ref());
        let friction = course(self.at(FRICTION), &self.spec.friction);
        let wear = given.map(|wear| course(at, &wear.per_work)).transpose();
        let mut all = RunningIn {
            friction: friction?,
            wear: wear?.flatten(),
            wear_per_load: None,
            threshold: given.and_then(|wear| wear.threshold_energy).unwrap_or(0.0),
        };
        if let Some(per_load) = given.and_then(|wear| wear.coefficient_per_load) {
            all.wear = None;
            let least = all.friction.as_ref().map(Course::least);
            all.wear_per_load = least.map(|_| per_load);
            if least.is_some_and(|least| least <= 0.0) {
                let rule = "needs friction greater than 0 at all times: per friction work it is \
                            k = coefficient_per_load / friction";
                return Err(at.refuse("coefficient_per_load", rule));
            }
        }
        // Beyond the threshold the coefficient is the one without a threshold.
        if all.threshold > 0.0 && all.wear.is_none() && all.wear_per_load.is_none() {
            let coefficient = self.wear_coefficient()?;
            let constant = Course::table(&[0.0], &[coefficient], Over::Cycles);
            all.wear = Some(constant.map_err(|invalid| at.refused(invalid))?);
        }
        Ok((all != RunningIn::default()).then_some(all))
    }
}

/// Builds the course of a coefficient; `None` if it is constant.
fn course(at: Section, given: &Coefficient) -> Result<Option<Course>, Noted> {
    let tables = [
        (&given.at_cycle, Over::Cycles),
        (&given.at_energy, Over::Energy),
    ];
    let constants = [
        ("running_in_cycles", given.running_in_cycles, Over::Cycles),
        ("running_in_energy", given.running_in_energy, Over::Energy),
    ];
    let refused = |invalid| at.refused(invalid);
    for (rows, over) in tables {
        if let Some(rows) = rows {
            let values = at.need("values", given.values.as_deref())?;
            return Course::table(rows, values, over).map(Some).map_err(refused);
        }
    }
    for (key, constant, over) in constants {
        if constant.is_some() || at.is_blamed(key) {
            let first = at.need("coefficient", given.coefficient);
            let settled = at.need("settled", given.settled);
            let course = Course::exponential(first?, settled?, at.need(key, constant)?, over);
            return course.map(Some).map_err(refused);
        }
    }
    match given.settled {
        Some(_) => {
            let path = at.path;
            let rule = format!("needs {path}.running_in_cycles or {path}.running_in_energy");
            Err(at.refuse("settled", rule))
        }
        None => Ok(None),
    }
}

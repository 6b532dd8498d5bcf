//! Builds coefficients that run in from the keys of a scenario.

use super::{Faults, Spec, wear};
use crate::scenario::key::join;
use crate::scenario::spec::Coefficient;
use crate::simulation::running_in::{Course, Over, RunningIn};

/// Builds the coefficients that run in, if any does.
pub(super) fn running_in(spec: &Spec, faults: &mut Faults) -> Option<Option<RunningIn>> {
    let given = spec.wear.as_ref();
    let friction = course(spec, faults, "friction", &spec.friction);
    let wear = match given {
        Some(wear) => course(spec, faults, "wear", &wear.per_work),
        None => Some(None),
    };
    let mut all = RunningIn {
        friction: friction?,
        wear: wear?,
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
            return faults.refuse(spec, "wear.coefficient_per_load", rule);
        }
    }
    // Beyond the threshold the coefficient is the one without a threshold.
    if all.threshold > 0.0 && all.wear.is_none() && all.wear_per_load.is_none() {
        let coefficient = wear::coefficient(spec, faults)?;
        let constant = Course::table(&[0.0], &[coefficient], Over::Cycles);
        all.wear = Some(faults.accept(spec, "wear", constant)?);
    }
    Some((all != RunningIn::default()).then_some(all))
}

/// Builds the course of a coefficient, if it is not constant.
fn course(
    spec: &Spec,
    faults: &mut Faults,
    section: &str,
    given: &Coefficient,
) -> Option<Option<Course>> {
    let path = |key: &str| join(section, key);
    let tables = [
        (&given.at_cycle, Over::Cycles),
        (&given.at_energy, Over::Energy),
    ];
    let constants = [
        ("running_in_cycles", given.running_in_cycles, Over::Cycles),
        ("running_in_energy", given.running_in_energy, Over::Energy),
    ];
    for (rows, over) in tables {
        if let Some(rows) = rows {
            let values = faults.need(&path("values"), given.values.as_deref())?;
            let course = Course::table(rows, values, over);
            return faults.accept(spec, section, course).map(Some);
        }
    }
    for (key, constant, over) in constants.map(|(key, of, over)| (path(key), of, over)) {
        if constant.is_some() || faults.covers(&key) {
            let first = faults.need(&path("coefficient"), given.coefficient);
            let settled = faults.need(&path("settled"), given.settled);
            let constant = faults.need(&key, constant);
            let course = Course::exponential(first?, settled?, constant?, over);
            return faults.accept(spec, section, course).map(Some);
        }
    }
    match given.settled {
        Some(_) => {
            let rule = format!("needs {section}.running_in_cycles or {section}.running_in_energy");
            faults.refuse(spec, &path("settled"), rule)
        }
        None => Some(None),
    }
}

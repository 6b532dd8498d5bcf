//! Builds coefficients that run in from the keys of a scenario.

use super::Parts;
use crate::contact::material::Material;
use crate::scenario::error::Refusal;
use crate::scenario::values::join;
use crate::simulation::running_in::{Course, Over, RunningIn};

impl Parts<'_> {
    /// Builds the coefficients that run in; `None` if they are constant.
    pub(super) fn running_in(&self, material: &Material) -> Result<Option<RunningIn>, Refusal> {
        let mut all = RunningIn {
            friction: self.course("friction")?,
            wear: self.course("wear")?,
            wear_per_load: None,
            threshold: if self.has("wear") {
                self.require("wear.threshold_energy")?
            } else {
                0.0
            },
        };
        if let Some(per_load) = self.get("wear.coefficient_per_load") {
            all.wear = None;
            let least = all.friction.as_ref().map(Course::least);
            all.wear_per_load = least.map(|_| per_load);
            if least.is_some_and(|least| least <= 0.0) {
                let rule = "needs friction greater than 0 at all times: per friction work it is \
                            k = coefficient_per_load / friction";
                return Err(self.refuse("wear.coefficient_per_load", rule));
            }
        }
        // Beyond the threshold the coefficient is the one without a threshold.
        if all.threshold > 0.0 && all.wear.is_none() && all.wear_per_load.is_none() {
            let coefficient = self.wear_coefficient(material)?;
            let constant = Course::table(&[0.0], &[coefficient], Over::Cycles);
            all.wear = Some(constant.map_err(self.refused("wear"))?);
        }
        Ok((all != RunningIn::default()).then_some(all))
    }

    /// Builds the course of a section's coefficient; `None` if it is constant.
    fn course(&self, section: &str) -> Result<Option<Course>, Refusal> {
        let key = |key: &str| join(section, key);
        let forms = [
            ("at_cycle", "running_in_cycles", Over::Cycles),
            ("at_energy", "running_in_energy", Over::Energy),
        ];
        for (rows, constant, over) in forms {
            let course = if let Some(rows) = self.get::<Vec<f64>>(&key(rows)) {
                Course::table(&rows, &self.require::<Vec<f64>>(&key("values"))?, over)
            } else if let Some(constant) = self.get(&key(constant)) {
                let first = self.require(&key("coefficient"))?;
                Course::exponential(first, self.require(&key("settled"))?, constant, over)
            } else {
                continue;
            };
            return course.map(Some).map_err(self.refused(section));
        }
        if self.has(&key("settled")) {
            let constants = forms.map(|(_, constant, _)| key(constant));
            let rule = format!("needs {}", constants.join(" or "));
            return Err(self.refuse(&key("settled"), rule));
        }
        Ok(None)
    }
}

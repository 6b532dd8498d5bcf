//! The serde mirror of a scenario's TOML: what is written, before anything is believed.
//!
//! After validation the same structure holds the scenario as it is run: the project's own defaults
//! that may change between versions are filled in, derived ones are not.

use serde::{Deserialize, Serialize};

use super::accuracy::Scene;
use super::{Change, RunPlan};
use crate::math::abel::AbelMethod;

/// A whole scenario.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Raw {
    pub title: Option<String>,
    pub description: Option<String>,
    pub indenter: RawIndenter,
    pub material: RawMaterial,
    pub friction: RawFriction,
    pub motion: RawMotion,
    pub wear: Option<RawWear>,
    pub numerics: RawNumerics,
    pub run: RunPlan,
    pub changes: Vec<Change>,
}

/// `[indenter]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawIndenter {
    pub shape: Option<String>,
    pub radius: Option<f64>,
    pub angle: Option<f64>,
    pub tip_radius: Option<f64>,
    pub coefficient: Option<f64>,
    pub exponent: Option<f64>,
}

/// `[material]`: either effective values or two bodies.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawMaterial {
    pub effective_modulus: Option<f64>,
    pub poisson: Option<f64>,
    pub indenter: Option<RawBody>,
    pub half_space: Option<RawBody>,
}

/// `[material.indenter]` and `[material.half_space]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawBody {
    pub youngs_modulus: Option<f64>,
    pub poisson: Option<f64>,
    pub rigid: Option<bool>,
}

/// `[friction]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawFriction {
    pub coefficient: Option<f64>,
}

/// `[motion]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawMotion {
    pub normal: RawOscillation,
    pub tangential: Option<RawOscillation>,
}

/// `[motion.normal]` and `[motion.tangential]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawOscillation {
    pub control: Option<String>,
    pub mean: Option<f64>,
    pub amplitude: Option<f64>,
    pub angular_frequency: Option<f64>,
    pub phase: Option<f64>,
}

/// `[wear]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawWear {
    pub law: Option<String>,
    pub coefficient: Option<f64>,
    pub stress_exponent: Option<f64>,
    pub slip_rate_exponent: Option<f64>,
    pub reference_stress: Option<f64>,
    pub reference_slip_rate: Option<f64>,
}

/// `[numerics]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct RawNumerics {
    pub accuracy: Option<f64>,
    pub method: Option<String>,
    pub points: Option<i64>,
    pub steps_per_cycle: Option<i64>,
    pub domain_radius: Option<f64>,
    pub grid: Option<String>,
    pub scheme: Option<String>,
    pub stability: Option<String>,
    pub integrator: Option<String>,
    pub tolerance: Option<f64>,
}

impl Raw {
    /// Writes out the defaults that may change between versions, so that a scenario that is kept
    /// means the same later. What follows from the method stays open, so that it goes on following.
    pub fn fill_in(&mut self) {
        let or = |value: &mut Option<String>, default: &str| {
            value.get_or_insert_with(|| default.to_owned());
        };
        or(&mut self.motion.normal.control, "displacement");
        if let Some(tangential) = &mut self.motion.tangential {
            or(&mut tangential.control, "displacement");
        }
        if let Some(wear) = &mut self.wear {
            or(&mut wear.law, "archard");
        }
        or(&mut self.numerics.stability, "sub-step");
        // An accuracy chooses these, and goes on choosing them when it is changed.
        if self.numerics.accuracy.is_none() {
            or(&mut self.numerics.integrator, "direct");
            or(&mut self.numerics.method, DEFAULT_METHOD.name());
            self.numerics.points.get_or_insert(DEFAULT_POINTS);
            self.numerics
                .steps_per_cycle
                .get_or_insert(DEFAULT_STEPS_PER_CYCLE);
        }
    }

    /// The same with what an accuracy chooses for `scene` filled in; an integrator that is given stays.
    pub fn resolved(&self, scene: &Scene) -> Self {
        let mut raw = self.clone();
        if let Some(accuracy) = raw.numerics.accuracy {
            let chosen = scene.choices(accuracy);
            let numerics = &mut raw.numerics;
            numerics.method = Some(DEFAULT_METHOD.name().into());
            numerics.points = Some(chosen.points);
            numerics.steps_per_cycle = Some(chosen.steps);
            numerics.tolerance = Some(chosen.tolerance);
            numerics
                .integrator
                .get_or_insert_with(|| chosen.integrator().to_owned());
        }
        raw
    }
}

/// The best transform method there is.
const DEFAULT_METHOD: AbelMethod = AbelMethod::Product;
/// N, as in the paper.
const DEFAULT_POINTS: i64 = 100;
/// Time steps in a cycle.
const DEFAULT_STEPS_PER_CYCLE: i64 = 100;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::parameters::{Kind, PARAMETERS};
    use serde_json::Value;

    /// A scenario that holds every key of the table, sense or no sense.
    fn everything() -> String {
        let (mut keys, mut changes) = (String::new(), "[[changes]]\n".to_owned());
        for parameter in PARAMETERS {
            let value = match parameter.kind {
                Kind::Number => "1.5",
                Kind::Whole => "3",
                Kind::Flag => "true",
                Kind::Text | Kind::Choice(_) => "\"x\"",
                Kind::Numbers => "[1.5]",
            };
            match parameter.path.strip_prefix("changes.") {
                Some(key) => changes += &format!("{key} = {value}\n"),
                None => keys += &format!("{} = {value}\n", parameter.path),
            }
        }
        keys + &changes
    }

    fn keys(value: &Value, path: &str, found: &mut Vec<String>) {
        match value {
            Value::Object(table) => {
                for (key, value) in table {
                    let dot = if path.is_empty() { "" } else { "." };
                    keys(value, &format!("{path}{dot}{key}"), found);
                }
            }
            Value::Array(tables) if tables.first().is_some_and(Value::is_object) => {
                keys(&tables[0], path, found);
            }
            _ => found.push(path.to_owned()),
        }
    }

    #[test]
    fn the_mirror_and_the_table_know_the_same_keys() {
        let raw: Raw =
            toml::from_str(&everything()).expect("the mirror knows every key of the table");
        let mut mirrored = Vec::new();
        keys(
            &serde_json::to_value(&raw).expect("plain values"),
            "",
            &mut mirrored,
        );
        let mut tabled: Vec<_> = PARAMETERS
            .iter()
            .map(|parameter| parameter.path.to_owned())
            .collect();
        mirrored.sort();
        tabled.sort();
        assert_eq!(mirrored, tabled);
    }
}

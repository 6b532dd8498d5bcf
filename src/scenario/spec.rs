//! The parts of a scenario that code changes, as fields: its keys are found by paths only where a user names them.

use serde::{Deserialize, Serialize};
use toml::Table;

use super::run::RunPlan;
use super::{schema, values};
use crate::math::abel::AbelMethod;
use crate::simulation::{Scheme, Spacing, Stability};

/// The typed parts; what else belongs to a scenario follows one by one.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Spec {
    /// `[numerics]`.
    #[serde(default)]
    pub numerics: Numerics,
    /// `[material]`.
    #[serde(default)]
    pub material: Material,
    /// `[wear]`; `None` where nothing wears.
    pub wear: Option<Wear>,
    /// `[run]`.
    #[serde(default)]
    pub run: RunPlan,
}

/// `[numerics]`. What is not given follows from the method, the contact or the accuracy.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Numerics {
    /// The error to aim at, which chooses points, steps and the tolerance.
    pub accuracy: Option<f64>,
    /// The transforms.
    pub method: Option<AbelMethod>,
    /// Cells.
    pub points: Option<usize>,
    /// Steps per cycle.
    pub steps_per_cycle: Option<u32>,
    /// Where the cells end, m.
    pub domain_radius: Option<f64>,
    /// How they lie.
    pub grid: Option<Spacing>,
    /// Where they lie, m: one more than cells.
    pub nodes: Option<Vec<f64>>,
    /// How a step is taken.
    pub scheme: Option<Scheme>,
    /// What is done about stiff steps.
    pub stability: Option<Stability>,
    /// How cycles are gone through.
    pub integrator: Option<Passage>,
    /// The error of jumps, in units of the depth.
    pub tolerance: Option<f64>,
}

/// How cycles are gone through, whatever the tolerance of jumps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Passage {
    /// Step by step.
    Direct,
    /// Many at once where they are alike.
    CycleJump,
}

/// `[material]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Material {
    /// What stresses are compared with after the run, Pa.
    pub fatigue_limit: Option<f64>,
    /// The same in shear, Pa.
    pub shear_fatigue_limit: Option<f64>,
    /// The other keys.
    #[serde(flatten)]
    rest: Table,
}

/// `[wear]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Wear {
    /// The law.
    pub law: Option<Law>,
    /// k per friction work, 1/Pa.
    pub coefficient: Option<f64>,
    /// k per normal load and distance, 1/Pa.
    pub coefficient_per_load: Option<f64>,
    /// The part of the worn depth that is the indenter's.
    pub share: Option<f64>,
    /// The other keys.
    #[serde(flatten)]
    rest: Table,
}

/// A law of wear.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Law {
    /// By friction work.
    Archard,
    /// By powers of stress and slip rate.
    Power,
}

impl Law {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Archard, Self::Power];
}

/// Paths of keys and their values as TOML.
pub type Edits = Vec<(&'static str, String)>;

impl Spec {
    /// Takes the typed parts out of a table that has passed all checks.
    pub(super) fn take(table: &mut Table) -> Self {
        let parts = ["numerics", "material", "wear", "run"];
        let parts = parts
            .into_iter()
            .filter_map(|name| table.remove_entry(name));
        let parts: Table = parts.collect();
        parts.try_into().expect("keys are checked")
    }

    /// As tables.
    pub(super) fn table(&self) -> Table {
        Table::try_from(self).expect("parts are tables")
    }

    /// What leads from here to `other`: paths and values as TOML, in the order of the schema. Keys that are only left
    /// out go with those that take their place.
    pub fn changes_to(&self, other: &Self) -> Edits {
        let [before, after] = [self, other].map(Self::table);
        let changed = schema::parameters().filter_map(|known| {
            let value = values::at(&after, known.path)?;
            let is_new = values::at(&before, known.path) != Some(value);
            is_new.then(|| (known.path, values::literal(value)))
        });
        changed.collect()
    }
}

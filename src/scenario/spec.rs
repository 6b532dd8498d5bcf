//! A scenario key by key, as fields: paths name its keys only where a user does. What is not given follows from the rest.

use std::sync::LazyLock;

use serde::{Deserialize, Serialize};
use strum::{IntoStaticStr, VariantNames};
use toml::Table;

use super::change::Change;
use super::run::RunPlan;
use super::{schema, values};
use crate::math::abel::AbelMethod;
use crate::simulation::{Scheme, Spacing, Stability};

/// Default accuracy of a run with wear if no numerics are given.
pub const USUAL_ACCURACY: f64 = 1e-2;

/// All keys, but those that name files, whose columns are keys of their own.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Spec {
    /// A short name.
    pub title: Option<String>,
    /// What the scenario shows.
    pub description: Option<String>,
    /// `[indenter]`.
    pub indenter: Indenter,
    /// `[material]`.
    pub material: Material,
    /// `[friction]`.
    pub friction: Coefficient,
    /// `[motion]`.
    pub motion: Motion,
    /// `[wear]`; `None` where nothing wears.
    pub wear: Option<Wear>,
    /// `[numerics]`.
    pub numerics: Numerics,
    /// `[run]`.
    pub run: RunPlan,
    /// `[[changes]]`.
    pub changes: Vec<Change>,
}

/// `[indenter]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Indenter {
    /// The unworn shape; it tells which of the lengths are needed.
    pub shape: Option<Shape>,
    /// Whether it is turned about its axis.
    pub geometry: Option<Geometry>,
    /// Length of a line contact, m.
    pub length: Option<f64>,
    /// Radius of curvature, of a punch, or of its edge, m.
    pub radius: Option<f64>,
    /// Rise of the flank, rad.
    pub angle: Option<f64>,
    /// Radius of the flat tip, m.
    pub tip_radius: Option<f64>,
    /// A of f = A rⁿ, m^(1−n).
    pub coefficient: Option<f64>,
    /// n of f = A rⁿ.
    pub exponent: Option<f64>,
    /// Length over which a table is smoothed, m.
    pub smoothing: Option<f64>,
    /// Radii of a table, m.
    pub radii: Option<Vec<f64>>,
    /// Heights there, m.
    pub heights: Option<Vec<f64>>,
}

/// A shape of the unworn indenter.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr, VariantNames,
)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
#[expect(missing_docs, reason = "keys.toml describes each word")]
pub enum Shape {
    Paraboloid,
    Cone,
    Power,
    FlatPunch,
    TruncatedParaboloid,
    TruncatedCone,
    RoundedPunch,
    Table,
}

/// What the section of the indenter stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, VariantNames)]
#[serde(rename_all = "lowercase")]
#[strum(serialize_all = "lowercase")]
pub enum Geometry {
    /// A shape of revolution.
    Round,
    /// A long cylinder.
    Line,
}

/// `[material]`: a pair, or two bodies.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Material {
    /// E* of the pair, Pa.
    pub effective_modulus: Option<f64>,
    /// Poisson's ratio of the elastic body.
    pub poisson: Option<f64>,
    /// Of the softer body, Pa.
    pub hardness: Option<f64>,
    /// What stresses are compared with after the run, Pa.
    pub fatigue_limit: Option<f64>,
    /// The same in shear, Pa.
    pub shear_fatigue_limit: Option<f64>,
    /// `[material.indenter]`.
    pub indenter: Option<Body>,
    /// `[material.half_space]`.
    pub half_space: Option<Body>,
}

/// One of two bodies.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Body {
    /// Young's modulus, Pa.
    pub youngs_modulus: Option<f64>,
    /// Poisson's ratio.
    pub poisson: Option<f64>,
    /// Hardness, Pa.
    pub hardness: Option<f64>,
    /// Whether it does not yield.
    pub rigid: Option<bool>,
}

/// A coefficient that is constant, runs in, or follows a table.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Coefficient {
    /// The initial value.
    pub coefficient: Option<f64>,
    /// The value after running in.
    pub settled: Option<f64>,
    /// Cycles of running in.
    pub running_in_cycles: Option<f64>,
    /// Friction work of running in, J.
    pub running_in_energy: Option<f64>,
    /// Cycles of a table.
    pub at_cycle: Option<Vec<f64>>,
    /// Energies of a table, J.
    pub at_energy: Option<Vec<f64>>,
    /// Coefficients there.
    pub values: Option<Vec<f64>>,
}

impl Coefficient {
    /// Returns the value at the start.
    pub fn first(&self) -> Option<f64> {
        let first = || self.values.as_ref()?.first().copied();
        self.coefficient.or_else(first)
    }
}

/// Sections of the two directions.
pub(super) const NORMAL: &str = "motion.normal";
pub(super) const TANGENTIAL: &str = "motion.tangential";

/// `[motion]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Motion {
    /// `[motion.normal]`.
    pub normal: Direction,
    /// `[motion.tangential]`; `None` where nothing moves sideways.
    pub tangential: Option<Direction>,
}

impl Motion {
    /// The directions in which something moves, with their sections.
    pub fn directions(&self) -> impl Iterator<Item = (&'static str, &Direction)> {
        let tangential = self.tangential.iter().map(|given| (TANGENTIAL, given));
        [(NORMAL, &self.normal)].into_iter().chain(tangential)
    }
}

/// One direction of the motion: lengths are in m, or in N under a force.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Direction {
    /// What is prescribed.
    pub control: Option<Control>,
    /// Mean.
    pub mean: Option<f64>,
    /// Amplitude.
    pub amplitude: Option<f64>,
    /// rad/s.
    pub angular_frequency: Option<f64>,
    /// The same in Hz.
    pub frequency: Option<f64>,
    /// rad.
    pub phase: Option<f64>,
    /// Stiffness of the rig, N/m.
    pub rig_stiffness: Option<f64>,
    /// Depth of the point that displacements of a line contact are told against, m.
    pub gauge_length: Option<f64>,
    /// Waveform.
    pub waveform: Option<Wave>,
    /// Fraction of a period at rest, of a trapezoid.
    pub hold: Option<f64>,
    /// Times of a table, s.
    pub times: Option<Vec<f64>>,
    /// Values there.
    pub values: Option<Vec<f64>>,
}

/// What a motion prescribes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, VariantNames)]
#[serde(rename_all = "lowercase")]
#[strum(serialize_all = "lowercase")]
pub enum Control {
    /// Lengths.
    Displacement,
    /// Forces.
    Force,
}

/// A waveform.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, VariantNames)]
#[serde(rename_all = "lowercase")]
#[strum(serialize_all = "lowercase")]
#[expect(missing_docs, reason = "keys.toml describes each word")]
pub enum Wave {
    Sine,
    Triangle,
    Trapezoid,
    Table,
}

/// `[wear]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Wear {
    /// The law.
    pub law: Option<Law>,
    /// k per friction work, 1/Pa.
    #[serde(flatten)]
    pub per_work: Coefficient,
    /// k per normal load and distance, 1/Pa.
    pub coefficient_per_load: Option<f64>,
    /// Friction work below which nothing wears, J.
    pub threshold_energy: Option<f64>,
    /// Radii of the scar that the run begins with, m.
    pub initial_radii: Option<Vec<f64>>,
    /// Its depths there, m.
    pub initial_depths: Option<Vec<f64>>,
    /// The part of the worn depth that is the indenter's.
    pub share: Option<f64>,
    /// Exponent of the stress in the power law.
    pub stress_exponent: Option<f64>,
    /// Exponent of the slip rate there.
    pub slip_rate_exponent: Option<f64>,
    /// Stress at which both laws wear alike, Pa.
    pub reference_stress: Option<f64>,
    /// Slip rate at which both laws wear alike, m/s.
    pub reference_slip_rate: Option<f64>,
}

/// A law of wear.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, VariantNames)]
#[serde(rename_all = "lowercase")]
#[strum(serialize_all = "lowercase")]
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

/// `[numerics]`. What is not given follows from the method, the contact or the accuracy.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
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
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, VariantNames)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
pub enum Passage {
    /// Step by step.
    Direct,
    /// Many at once where they are alike.
    CycleJump,
}

/// Paths of keys and their values as TOML.
pub type Edits = Vec<(&'static str, String)>;

impl Spec {
    /// Reads a table that has passed [`check::keys`](super::check::keys), and writes out the defaults that may change
    /// between versions, so that a saved scenario keeps its meaning. Those that depend on the method stay open and keep
    /// following it; those that an accuracy chooses are found before the run.
    pub(super) fn read(written: &Table) -> Self {
        let mut spec = Self::of_table(written.clone());
        let usual = Self::usual();
        let normal = &mut spec.motion.normal;
        for motion in [normal].into_iter().chain(&mut spec.motion.tangential) {
            motion.control = motion.control.or(usual.motion.normal.control);
        }
        if let Some(wear) = &mut spec.wear {
            wear.law = wear.law.or(usual.wear.as_ref().and_then(|wear| wear.law));
        }
        let k = |wear: &Wear| wear.per_work.coefficient.or(wear.coefficient_per_load);
        let wears = spec.wear.as_ref().is_some_and(|wear| k(wear).is_some());
        let (numerics, usual) = (&mut spec.numerics, &usual.numerics);
        numerics.method = numerics.method.or(usual.method);
        numerics.stability = numerics.stability.or(usual.stability);
        if wears && numerics.is_open() {
            numerics.accuracy = numerics.accuracy.or(Some(USUAL_ACCURACY));
        }
        if numerics.accuracy.is_none() {
            numerics.points = numerics.points.or(usual.points);
            numerics.steps_per_cycle = numerics.steps_per_cycle.or(usual.steps_per_cycle);
            numerics.integrator = numerics.integrator.or(usual.integrator);
        }
        spec
    }

    /// The defaults of `keys.toml`.
    pub(super) fn usual() -> &'static Self {
        static USUAL: LazyLock<Spec> = LazyLock::new(|| {
            let mut table = Table::new();
            for known in schema::parameters() {
                if let Some(value) = known.default.value() {
                    values::insert(&mut table, known.path, value.clone());
                }
            }
            Spec::of_table(table)
        });
        &USUAL
    }

    fn of_table(table: Table) -> Self {
        table.try_into().expect("keys are checked")
    }

    /// As tables.
    pub(crate) fn table(&self) -> Table {
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

    /// Writes the values that changes have given to their keys, however these were typed. Of several changes of one key
    /// the last one has given it.
    pub(super) fn write_changes(&self, changes: &mut [Change]) {
        let mut given = self.table();
        for change in changes.iter_mut().rev() {
            if let Some(value) = values::remove(&mut given, change.key()) {
                *change = Change::new(change.at_cycle, change.key(), &values::literal(&value));
            }
        }
    }
}

impl Numerics {
    /// Whether nothing is given that an accuracy chooses.
    fn is_open(&self) -> bool {
        self.points.is_none()
            && self.steps_per_cycle.is_none()
            && self.tolerance.is_none()
            && self.nodes.is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::schema::{Default as Usual, Kind, Parameter};
    use strum::VariantNames;
    use toml::Value;

    fn any(known: &Parameter) -> Value {
        match known.kind {
            Kind::Number => Value::Float(0.5),
            Kind::Whole => Value::Integer(7),
            Kind::Flag => Value::Boolean(true),
            Kind::Text => "a text".into(),
            Kind::Choice(words) => words.last().expect("words").word.into(),
            Kind::Numbers => vec![0.5, 1.5].into(),
        }
    }

    /// Returns all keys, except those of files and of changes.
    fn keys() -> impl Iterator<Item = &'static Parameter> {
        let is_file = |path| schema::SCHEMA.files.iter().any(|file| file.key == path);
        schema::parameters()
            .filter(move |known| !is_file(known.path) && known.section() != "changes")
    }

    #[test]
    fn every_key_has_its_field() {
        let mut table = Table::new();
        for known in keys() {
            values::insert(&mut table, known.path, any(known));
        }
        let written = Spec::of_table(table.clone()).table();
        for known in keys() {
            let [given, field] = [&table, &written].map(|table| values::at(table, known.path));
            assert_eq!(field, given, "{}", known.path);
        }
    }

    #[test]
    fn what_may_change_is_written_out() {
        let given = "[wear]\n[motion.tangential]\n".parse().expect("a table");
        let written = Spec::read(&given).table();
        for known in keys() {
            let default = match &known.default {
                Usual::Written(value) => Some(value),
                _ => None,
            };
            let is_list = known.kind == Kind::Numbers;
            let value = values::at(&written, known.path).filter(|_| !is_list);
            assert_eq!(value, default, "{}", known.path);
        }
    }

    #[test]
    fn the_words_are_those_of_the_table_of_keys() {
        for (path, words) in [
            ("indenter.shape", Shape::VARIANTS),
            ("indenter.geometry", Geometry::VARIANTS),
            ("motion.normal.control", Control::VARIANTS),
            ("motion.tangential.control", Control::VARIANTS),
            ("motion.normal.waveform", Wave::VARIANTS),
            ("motion.tangential.waveform", Wave::VARIANTS),
            ("wear.law", Law::VARIANTS),
            ("numerics.integrator", Passage::VARIANTS),
        ] {
            let known = schema::known(path).kind.words();
            assert_eq!(known.as_deref(), Some(words), "{path}");
        }
    }
}

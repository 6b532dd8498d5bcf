//! A scenario key by key, as fields: paths name its keys only where a user does. What is not given follows from the rest.

use std::sync::LazyLock;

use strum::{EnumString, IntoStaticStr, VariantNames};

use super::change::Change;
use super::run::RunPlan;
use super::schema::{self, Parameter};
use super::value::{Field, Held, Section, Value, fields, section, words};
use crate::math::abel::AbelMethod;
use crate::simulation::{Scheme, Spacing, Stability};
use crate::wear::{Law, Parameters};

/// Default accuracy of a run with wear if no numerics are given.
pub const USUAL_ACCURACY: f64 = 1e-2;

/// All keys, but those that name files, whose columns are keys of their own.
#[derive(Debug, Clone, PartialEq, Default)]
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

section! {
    /// `[indenter]`.
    Indenter {
        /// The unworn shape; it tells which of the lengths are needed.
        shape: Option<Shape>,
        /// Whether it is turned about its axis.
        geometry: Option<Geometry>,
        /// Length of a line contact, m.
        length: Option<f64>,
        /// Radius of curvature, of a punch, or of its edge, m.
        radius: Option<f64>,
        /// Rise of the flank, rad.
        angle: Option<f64>,
        /// Radius of the flat tip, m.
        tip_radius: Option<f64>,
        /// A of f = A rⁿ, m^(1−n).
        coefficient: Option<f64>,
        /// n of f = A rⁿ.
        exponent: Option<f64>,
        /// Length over which a table is smoothed, m.
        smoothing: Option<f64>,
        /// Radii of a table, m.
        radii: Option<Vec<f64>>,
        /// Heights there, m.
        heights: Option<Vec<f64>>,
    }
}

/// A shape of the unworn indenter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumString, IntoStaticStr, VariantNames)]
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
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumString, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "lowercase")]
pub enum Geometry {
    /// A shape of revolution.
    Round,
    /// A long cylinder.
    Line,
}

section! {
    /// `[material]`: a pair, or two bodies.
    Material {
        /// E* of the pair, Pa.
        effective_modulus: Option<f64>,
        /// Poisson's ratio of the elastic body.
        poisson: Option<f64>,
        /// Of the softer body, Pa.
        hardness: Option<f64>,
        /// What stresses are compared with after the run, Pa.
        fatigue_limit: Option<f64>,
        /// The same in shear, Pa.
        shear_fatigue_limit: Option<f64>,
    } {
        /// `[material.indenter]`.
        indenter: Option<Body>,
        /// `[material.half_space]`.
        half_space: Option<Body>,
    }
}

section! {
    /// One of two bodies.
    Body {
        /// Young's modulus, Pa.
        youngs_modulus: Option<f64>,
        /// Poisson's ratio.
        poisson: Option<f64>,
        /// Hardness, Pa.
        hardness: Option<f64>,
        /// Whether it does not yield.
        rigid: Option<bool>,
    }
}

section! {
    /// A coefficient that is constant, runs in, or follows a table.
    Coefficient {
        /// The initial value.
        coefficient: Option<f64>,
        /// The value after running in.
        settled: Option<f64>,
        /// Cycles of running in.
        running_in_cycles: Option<f64>,
        /// Friction work of running in, J.
        running_in_energy: Option<f64>,
        /// Cycles of a table.
        at_cycle: Option<Vec<f64>>,
        /// Energies of a table, J.
        at_energy: Option<Vec<f64>>,
        /// Coefficients there.
        values: Option<Vec<f64>>,
    }
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
#[derive(Debug, Clone, PartialEq, Default)]
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

section! {
    /// One direction of the motion: lengths are in m, or in N under a force.
    Direction {
        /// What is prescribed.
        control: Option<Control>,
        /// Mean.
        mean: Option<f64>,
        /// Amplitude.
        amplitude: Option<f64>,
        /// rad/s.
        angular_frequency: Option<f64>,
        /// The same in Hz.
        frequency: Option<f64>,
        /// rad.
        phase: Option<f64>,
        /// Stiffness of the rig, N/m.
        rig_stiffness: Option<f64>,
        /// Depth of the point that displacements of a line contact are told against, m.
        gauge_length: Option<f64>,
        /// Waveform.
        waveform: Option<Wave>,
        /// Fraction of a period at rest, of a trapezoid.
        hold: Option<f64>,
        /// Times of a table, s.
        times: Option<Vec<f64>>,
        /// Values there.
        values: Option<Vec<f64>>,
    }
}

/// What a motion prescribes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumString, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "lowercase")]
pub enum Control {
    /// Lengths.
    Displacement,
    /// Forces.
    Force,
}

/// A waveform.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumString, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "lowercase")]
#[expect(missing_docs, reason = "keys.toml describes each word")]
pub enum Wave {
    Sine,
    Triangle,
    Trapezoid,
    Table,
}

section! {
    /// `[wear]`.
    Wear {
        /// The law.
        law: Option<Law>,
        /// k per normal load and distance, 1/Pa.
        coefficient_per_load: Option<f64>,
        /// Friction work below which nothing wears, J.
        threshold_energy: Option<f64>,
        /// Radii of the scar that the run begins with, m.
        initial_radii: Option<Vec<f64>>,
        /// Its depths there, m.
        initial_depths: Option<Vec<f64>>,
        /// The part of the worn depth that is the indenter's.
        share: Option<f64>,
    } {
        /// k per friction work, 1/Pa.
        per_work: Coefficient,
        /// Keys of the laws.
        parameters: Parameters,
    }
}

section! {
    /// `[numerics]`. What is not given follows from the method, the contact or the accuracy.
    Numerics {
        /// The error to aim at, which chooses points, steps and the tolerance.
        accuracy: Option<f64>,
        /// The transforms.
        method: Option<AbelMethod>,
        /// Cells.
        points: Option<usize>,
        /// Steps per cycle.
        steps_per_cycle: Option<u32>,
        /// Where the cells end, m.
        domain_radius: Option<f64>,
        /// How they lie.
        grid: Option<Spacing>,
        /// Where they lie, m: one more than cells.
        nodes: Option<Vec<f64>>,
        /// How a step is taken.
        scheme: Option<Scheme>,
        /// What is done about stiff steps.
        stability: Option<Stability>,
        /// How cycles are gone through.
        integrator: Option<Passage>,
        /// The error of jumps, in units of the depth.
        tolerance: Option<f64>,
    }
}

/// How cycles are gone through, whatever the tolerance of jumps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumString, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "kebab-case")]
pub enum Passage {
    /// Step by step.
    Direct,
    /// Many at once where they are alike.
    CycleJump,
}

fields! { Parameters { stress_exponent, slip_rate_exponent, reference_stress, reference_slip_rate } }

words!(
    Shape, Geometry, Control, Wave, Law, Passage, AbelMethod, Spacing, Scheme, Stability
);

/// Keys and their new values.
pub type Edits = Vec<(&'static Parameter, Value)>;

impl Spec {
    fn field(&self, key: &Parameter) -> Option<&dyn Field> {
        let name = key.key();
        match key.section() {
            "" if name == "title" => Some(&self.title),
            "" => Some(&self.description),
            "indenter" => self.indenter.field(name),
            "material" => self.material.field(name),
            "material.indenter" => self.material.indenter.as_ref()?.field(name),
            "material.half_space" => self.material.half_space.as_ref()?.field(name),
            "friction" => self.friction.field(name),
            NORMAL => self.motion.normal.field(name),
            TANGENTIAL => self.motion.tangential.as_ref()?.field(name),
            "wear" => {
                let wear = self.wear.as_ref()?;
                let law = || wear.parameters.field(name);
                wear.field(name)
                    .or_else(|| wear.per_work.field(name))
                    .or_else(law)
            }
            "numerics" => self.numerics.field(name),
            _ => self.run.field(name),
        }
    }

    /// The same, to be changed; adds the table of the key.
    fn field_mut(&mut self, key: &Parameter) -> Option<&mut dyn Field> {
        let name = key.key();
        match key.section() {
            "" if name == "title" => Some(&mut self.title),
            "" => Some(&mut self.description),
            "indenter" => self.indenter.field_mut(name),
            "material" => self.material.field_mut(name),
            "friction" => self.friction.field_mut(name),
            NORMAL => self.motion.normal.field_mut(name),
            "numerics" => self.numerics.field_mut(name),
            "run" => self.run.field_mut(name),
            optional => {
                self.open(optional);
                match optional {
                    "material.indenter" => self.material.indenter.as_mut()?.field_mut(name),
                    "material.half_space" => self.material.half_space.as_mut()?.field_mut(name),
                    TANGENTIAL => self.motion.tangential.as_mut()?.field_mut(name),
                    _ => {
                        let wear = self.wear.as_mut()?;
                        if wear.per_work.field(name).is_some() {
                            wear.per_work.field_mut(name)
                        } else if wear.parameters.field(name).is_some() {
                            wear.parameters.field_mut(name)
                        } else {
                            wear.field_mut(name)
                        }
                    }
                }
            }
        }
    }

    /// Adds a table that may be left out; others are always there.
    pub(super) fn open(&mut self, section: &str) {
        match section {
            "material.indenter" => _ = self.material.indenter.get_or_insert_default(),
            "material.half_space" => _ = self.material.half_space.get_or_insert_default(),
            TANGENTIAL => _ = self.motion.tangential.get_or_insert_default(),
            "wear" => _ = self.wear.get_or_insert_default(),
            _ => {}
        }
    }

    /// Whether a key, or a table that may be left out, is given.
    pub(super) fn has(&self, path: &str) -> bool {
        match path {
            "material.indenter" => self.material.indenter.is_some(),
            "material.half_space" => self.material.half_space.is_some(),
            path => schema::find(path).is_some_and(|key| self.get(key).is_some()),
        }
    }

    /// The value of a key, if it is given.
    pub fn get(&self, key: &Parameter) -> Option<Value> {
        self.field(key)?.get()
    }

    /// Gives a key a value; nothing else changes.
    pub(super) fn put(&mut self, key: &Parameter, value: Value) {
        if let Some(field) = self.field_mut(key) {
            field.put(Some(value));
        }
    }

    /// Takes the value of a key away.
    pub(super) fn clear(&mut self, key: &Parameter) {
        if self.field(key).is_some() {
            self.field_mut(key)
                .into_iter()
                .for_each(|field| field.put(None));
        }
    }

    /// Writes out the defaults that may change between versions, so that a saved scenario keeps its meaning. Those that
    /// depend on the method stay open and keep following it; those that an accuracy chooses are found before the run.
    pub(super) fn fill(&mut self) {
        let usual = Self::usual();
        let normal = &mut self.motion.normal;
        for motion in [normal].into_iter().chain(&mut self.motion.tangential) {
            motion.control = motion.control.or(usual.motion.normal.control);
        }
        if let Some(wear) = &mut self.wear {
            wear.law = wear.law.or(usual.wear.as_ref().and_then(|wear| wear.law));
        }
        let k = |wear: &Wear| wear.per_work.coefficient.or(wear.coefficient_per_load);
        let wears = self.wear.as_ref().is_some_and(|wear| k(wear).is_some());
        let (numerics, usual) = (&mut self.numerics, &usual.numerics);
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
    }

    /// The defaults of `keys.toml`.
    pub(super) fn usual() -> &'static Self {
        static USUAL: LazyLock<Spec> = LazyLock::new(|| {
            let mut usual = Spec::default();
            for known in schema::parameters() {
                if let Some(value) = known.default.value() {
                    let value = Value::read(&mut value.clone(), known, false);
                    usual.put(known, value.expect("a default is a value of its key"));
                }
            }
            usual
        });
        &USUAL
    }

    /// Writes the values that changes have given to their keys, however these were typed. Of several changes of one key
    /// the last one has given it.
    pub(super) fn write_changes(&self, changes: &mut [Change]) {
        let mut given = self.clone();
        for change in changes.iter_mut().rev() {
            let Some(key) = schema::find(change.key()) else {
                continue;
            };
            if let Some(value) = given.get(key) {
                *change = Change::new(change.at_cycle, key.path, &value.literal());
                given.clear(key);
            }
        }
    }

    /// As texts.
    pub fn changes_to(&self, other: &Self) -> Vec<(&'static str, String)> {
        let edits = self.diff(other).into_iter();
        edits
            .map(|(key, value)| (key.path, value.literal()))
            .collect()
    }

    /// What leads from here to `other`, in the order of the schema. Keys that are only left out go with those that take
    /// their place.
    pub fn diff(&self, other: &Self) -> Edits {
        let changed = schema::parameters().filter_map(|key| {
            let value = other.get(key)?;
            (self.get(key).as_ref() != Some(&value)).then_some((key, value))
        });
        changed.collect()
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
    use crate::scenario::schema::Kind;

    fn any(known: &Parameter) -> Value {
        match known.kind {
            Kind::Number => Value::Number(0.5),
            Kind::Whole => Value::Whole(7),
            Kind::Flag => Value::Flag(true),
            Kind::Text => Value::Text("a text".into()),
            Kind::Choice(words) => Value::Word(words.last().expect("words").word),
            Kind::Numbers => Value::Numbers(vec![0.5, 1.5]),
        }
    }

    #[test]
    fn every_key_has_its_field() {
        let is_file = |path| schema::SCHEMA.files.iter().any(|file| file.key == path);
        for known in schema::parameters().filter(|known| known.section() != "changes") {
            let mut spec = Spec::default();
            spec.put(known, any(known));
            let expected = Some(any(known)).filter(|_| !is_file(known.path));
            assert_eq!(spec.get(known), expected, "{}", known.path);
            spec.clear(known);
            assert_eq!(spec.get(known), None, "{}", known.path);
        }
    }
}

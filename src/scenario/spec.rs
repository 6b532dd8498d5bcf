//! A scenario as typed keys; `None`: not given, so it follows from the rest.

use std::sync::LazyLock;

use strum::{EnumString, IntoStaticStr, VariantNames};

use super::change::Change;
use super::key::{Default as Usual, Key, SCHEMA};
use super::value::{KeyField, Section, Value, fields, section, words};
use crate::contact::indenter::{Dimensions, Shape};
use crate::math::abel::AbelMethod;
use crate::simulation::waveform::{self, Wave};
use crate::simulation::{Scheme, Spacing, Stability};
use crate::wear::{Law, LawParameters};

/// Default accuracy of a run with wear if no numerics are given.
pub const USUAL_ACCURACY: f64 = 1e-2;

/// Keys that an accuracy chooses.
const CHOSEN: [&str; 3] = [
    "numerics.points",
    "numerics.steps_per_cycle",
    "numerics.integrator",
];

/// All keys, but those that name files, whose columns are keys of their own.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Spec {
    /// Title and description.
    pub about: About,
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
    /// The keys outside of any table.
    About {
        /// A short name.
        title: Option<String>,
        /// What the scenario shows.
        description: Option<String>,
    }
}

section! {
    /// `[indenter]`.
    Indenter {
        /// The unworn shape; it tells which of the lengths are needed.
        shape: Option<Shape>,
        /// Whether it is turned about its axis.
        geometry: Option<GeometryWord>,
        /// Length of a line contact, m.
        length: Option<f64>,
    } parts {
        /// Keys of the shapes.
        dimensions: Dimensions,
    }
}

/// What the section of the indenter stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumString, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "lowercase")]
pub enum GeometryWord {
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
    } tables {
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
        control: Option<ControlWord>,
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
        /// Depth of the point that displacements of a line contact are measured relative to, m.
        gauge_length: Option<f64>,
        /// Waveform.
        waveform: Option<Wave>,
    } parts {
        /// Keys of the waveforms.
        form: waveform::WaveParameters,
    }
}

/// What a motion prescribes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumString, IntoStaticStr, VariantNames)]
#[strum(serialize_all = "lowercase")]
pub enum ControlWord {
    /// Lengths.
    Displacement,
    /// Forces.
    Force,
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
    } parts {
        /// k per friction work, 1/Pa.
        per_work: Coefficient,
        /// Keys of the laws.
        parameters: LawParameters,
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

/// Maximum length of a run, in cycles.
pub const MOST_CYCLES: f64 = 1e9;

/// Maximum number of snapshots of a run.
pub const MOST_SNAPSHOTS: usize = 10_000;

section! {
    /// `[run]`: the length of a run and its output.
    RunPlan {
        /// Length of the run in cycles, 0 or more; `None` runs until the user stops it.
        cycles: Option<f64>,
        /// Cycles at which the state is written; those after the end of the run are ignored.
        snapshot_at: Vec<f64>,
        /// Cycles at which a step or jump was cut short although the run continued, such as a planned end that the explorer
        /// went past. Without them, a replay would take other steps.
        shortened_at: Vec<f64>,
        /// A remark to store in the files.
        note: Option<String>,
        /// The errors of the recorded run, sealed by [`Scenario::stating`](super::Scenario::stating).
        stated: Option<String>,
    }
}

fields! { Dimensions { radius, angle, tip_radius, coefficient, exponent, smoothing, radii, heights } }

fields! { waveform::WaveParameters { hold, times, values } }

fields! { LawParameters { stress_exponent, slip_rate_exponent, reference_stress, reference_slip_rate } }

words!(
    Shape,
    GeometryWord,
    ControlWord,
    Wave,
    Law,
    Passage,
    AbelMethod,
    Spacing,
    Scheme,
    Stability
);

impl Spec {
    /// Returns the struct of a table; `None` for one that is not given.
    fn section(&self, path: &str) -> Option<&dyn Section> {
        Some(match path {
            "" => &self.about,
            "indenter" => &self.indenter,
            "material" => &self.material,
            "material.indenter" => self.material.indenter.as_ref()?,
            "material.half_space" => self.material.half_space.as_ref()?,
            "friction" => &self.friction,
            NORMAL => &self.motion.normal,
            TANGENTIAL => self.motion.tangential.as_ref()?,
            "wear" => self.wear.as_ref()?,
            "numerics" => &self.numerics,
            "run" => &self.run,
            _ => return None,
        })
    }

    /// Returns the struct of a table; adds one that is not given.
    pub(super) fn open(&mut self, path: &str) -> Option<&mut dyn Section> {
        Some(match path {
            "" => &mut self.about,
            "indenter" => &mut self.indenter,
            "material" => &mut self.material,
            "material.indenter" => self.material.indenter.get_or_insert_default(),
            "material.half_space" => self.material.half_space.get_or_insert_default(),
            "friction" => &mut self.friction,
            NORMAL => &mut self.motion.normal,
            TANGENTIAL => self.motion.tangential.get_or_insert_default(),
            "wear" => self.wear.get_or_insert_default(),
            "numerics" => &mut self.numerics,
            "run" => &mut self.run,
            _ => return None,
        })
    }

    /// Whether a key or a table is given.
    pub(super) fn has(&self, path: &str) -> bool {
        let value = |key| self.get(key);
        self.section(path).is_some() || Key::find(path).and_then(value).is_some()
    }

    /// Returns the value of a key, if it is given.
    pub fn get(&self, key: Key) -> Option<Value> {
        self.section(key.section())?.field(key.key())?.get()
    }

    /// Gives a key a value, in place of what it excludes.
    pub fn set(&mut self, key: Key, value: Value) {
        key.displaces().for_each(|other| self.clear(other));
        self.put(key, Some(value));
    }

    /// Takes the value of a key away.
    pub(super) fn clear(&mut self, key: Key) {
        if self.get(key).is_some() {
            self.put(key, None);
        }
    }

    /// Replaces the value of a key; nothing else changes.
    pub(super) fn put(&mut self, key: Key, value: Option<Value>) {
        let section = self.open(key.section());
        if let Some(field) = section.and_then(|section| section.field_mut(key.key())) {
            field.put(value);
        }
    }

    /// Returns the keys to set for another spec, in the order of the table. Keys that it only lacks are not named.
    pub fn diff(&self, after: &Self) -> Vec<(Key, Value)> {
        let changed = Key::all().filter_map(|key| {
            let value = after.get(key)?;
            (self.get(key).as_ref() != Some(&value)).then_some((key, value))
        });
        changed.collect()
    }

    /// Returns the first key that another one excludes, with the rule.
    pub(super) fn conflict(&self) -> Option<(&'static str, String)> {
        let given = |keys: &[&'static str]| keys.iter().copied().find(|key| self.has(key));
        SCHEMA.exclusive.iter().find_map(|of| {
            let (key, other) = (given(&of.keys)?, given(&of.others)?);
            let rule = of.rule.replace("{}", other);
            Some((key, format!("conflicts with {rule}")))
        })
    }

    /// Writes out the defaults that may change between versions, so that a saved scenario keeps its meaning. Those that
    /// depend on the method stay open and keep following it; those that an accuracy chooses are found before the run.
    pub(super) fn fill(&mut self) {
        let k = |wear: &Wear| wear.per_work.coefficient.or(wear.coefficient_per_load);
        let wears = self.wear.as_ref().and_then(k).is_some();
        if wears && self.numerics.is_open() {
            self.numerics.accuracy.get_or_insert(USUAL_ACCURACY);
        }
        let is_chosen = |key: Key| CHOSEN.contains(&key.path);
        let has_accuracy = self.numerics.accuracy.is_some();
        for key in Key::all().filter(|key| matches!(key.default, Usual::Written(_))) {
            let is_due = self.has(key.section()) && !(has_accuracy && is_chosen(key));
            if is_due && self.get(key).is_none() {
                self.put(key, Self::usual().get(key));
            }
        }
    }

    /// Returns the defaults of `keys.toml`.
    pub(super) fn usual() -> &'static Self {
        static USUAL: LazyLock<Spec> = LazyLock::new(|| {
            let mut usual = Spec::default();
            for key in Key::all() {
                let raw = key.default.value().cloned();
                let value = raw.map(|mut raw| Value::read(&mut raw, key, false));
                let value = value.map(|read| read.expect("a default is a value of its key"));
                usual.put(key, value);
            }
            usual
        });
        &USUAL
    }

    /// Returns what is given, or its default in `keys.toml`.
    pub(super) fn or_usual<T>(&self, of: impl Fn(&Self) -> Option<T>) -> Option<T> {
        of(self).or_else(|| of(Self::usual()))
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
    use crate::scenario::key::Kind;

    fn any(known: Key) -> Value {
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
        let is_file = |path| SCHEMA.files.iter().any(|file| file.key == path);
        for known in Key::all().filter(|known| known.section() != "changes") {
            let mut spec = Spec::default();
            spec.put(known, Some(any(known)));
            let expected = Some(any(known)).filter(|_| !is_file(known.path));
            assert_eq!(spec.get(known), expected, "{}", known.path);
            spec.clear(known);
            assert_eq!(spec.get(known), None, "{}", known.path);
        }
    }
}

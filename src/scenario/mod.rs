//! Scenarios: a TOML text, plus assignments of the command line, becomes parts that can be run.
//!
//! One way in: a text (`read`) is a TOML table; a `draft` holds what it and assignments give, each value under its
//! [`key`], then reads the columns of other files (`embed`, [`columns`]) and each value as one of its key, in SI units
//! ([`value`], [`units`]). A [`spec`] holds all values, typed; `setup` makes the parts that can be run. What is wrong is
//! noted on the way (`fault`), and reported at once: a line each that names the origin, the dotted path, the value and
//! the rule. One way out: `write`.

use std::ffi::OsStr;
use std::io::Read;
use std::path::{Path, PathBuf};

use draft::Draft;

use crate::reading::Errors;
use crate::simulation::{Domain, Setup, Spacing};

pub(crate) mod blocks;
pub(crate) mod bounded_read;
pub(crate) mod change;
mod changes;
pub mod checkpoint;
pub mod columns;
mod draft;
mod embed;
mod error;
pub mod escape;
mod fault;
pub mod hint;
pub mod key;
mod kind;
pub mod preset;
mod read;
pub mod scalars;
pub mod session;
mod setup;
pub mod spec;
pub mod typed;
pub mod units;
pub mod value;
pub(crate) mod write;

pub use change::{Change, MOST_CHANGES};
pub use error::Refusal;
use escape::echo;
pub use escape::printable;
use key::{Key, join, split};
pub use setup::choices;
pub use spec::{MOST_CYCLES, MOST_SNAPSHOTS, RunPlan, Spec, USUAL_ACCURACY};
use value::{Section, Value};

/// Maximum length of the [stem](Scenario::stem), in bytes.
const LONGEST_STEM: usize = 200;

/// A validated scenario: parts that are ready to run, and the text that reproduces them.
#[derive(Debug, Clone)]
pub struct Scenario {
    origin: String,
    /// Base directory of the files that it names.
    directory: PathBuf,
    title: String,
    description: String,
    /// All keys, with the defaults that may change written out.
    spec: Spec,
    setup: Setup,
    /// What was left out of the files that it names, a line each.
    notes: Vec<String>,
}

/// Two scenarios are equal if they run alike; their origin does not matter.
impl PartialEq for Scenario {
    fn eq(&self, other: &Self) -> bool {
        self.spec == other.spec && self.setup == other.setup
    }
}

impl Scenario {
    /// Loads a preset by its name, or a file: anything with a `/` or ending in `.toml` is a path. Each of `sets` is a
    /// `KEY=VALUE` that overrides the scenario.
    pub fn load(name_or_path: impl AsRef<OsStr>, sets: &[String]) -> Result<Self, Refusal> {
        let path = Path::new(&name_or_path);
        let name = path.to_string_lossy();
        if preset::is_path(&name) {
            return Self::in_directory(&read::file(path)?, &name, path.parent(), sets);
        }
        match preset::find(&name) {
            Some(preset) => Self::from_toml(preset.text, preset.name, sets),
            None => {
                let hint = preset::hint(&name);
                let rule = format!("no such preset; {hint} (a path ends in .toml or contains a /)");
                Err(Refusal::new(echo(&name), rule))
            }
        }
    }

    /// Reads a scenario from an open source, such as the standard input, called `origin` in messages.
    pub fn from_reader(from: impl Read, origin: &str, sets: &[String]) -> Result<Self, Refusal> {
        Self::from_toml(&read::text(from, origin)?, origin, sets)
    }

    /// Reads a scenario from a text, called `origin` in messages; files that it names are relative to the directory of
    /// `origin`.
    pub fn from_toml(text: &str, origin: &str, sets: &[String]) -> Result<Self, Refusal> {
        Self::in_directory(text, origin, Path::new(origin).parent(), sets)
    }

    fn in_directory(
        text: &str,
        origin: &str,
        directory: Option<&Path>,
        sets: &[String],
    ) -> Result<Self, Refusal> {
        let directory = directory.unwrap_or(Path::new(""));
        let (table, commas) = read::table(text, origin)?;
        let mut draft = Draft::on(Spec::default(), origin, directory);
        draft.read(table);
        for set in sets {
            let written = format!("--set {}", echo(set));
            let (key, value) = change::split(set, &written)?;
            draft.assign(key, value, &written)?;
        }
        let built = Self::build(draft);
        let errors = commas.into_iter().chain(built.as_ref().err().cloned());
        Refusal::all(errors).map_or(built, Err)
    }

    /// Begins to put a scenario together on top of this one.
    fn draft(&self) -> Draft {
        Draft::on(self.spec.clone(), &self.origin, &self.directory)
    }

    /// Returns the same scenario with keys assigned together, by the rules of `--set`: a value is TOML or a bare word.
    /// Another `indenter.shape` drops the keys of the shape before. Unless the scenario gives `numerics.grid` and
    /// `numerics.scheme`, they follow a change of `numerics.method`.
    ///
    /// # Errors
    ///
    /// Keys that are unknown, and values that are refused.
    pub fn assigned(
        &self,
        assignments: &[(impl AsRef<str>, impl AsRef<str>)],
    ) -> Result<Self, Refusal> {
        let mut draft = self.draft();
        for (key, value) in assignments {
            let (key, value) = (key.as_ref().trim(), value.as_ref().trim());
            draft.assign(key, value, &written(key, value))?;
        }
        let mut changed = Self::build(draft)?;
        changed.notes.splice(..0, self.notes.iter().cloned());
        Ok(changed)
    }

    /// Returns the same scenario with other values, whose types are of their keys.
    ///
    /// # Errors
    ///
    /// Values that are refused.
    pub fn edited(&self, edit: impl FnOnce(&mut Spec)) -> Result<Self, Refusal> {
        let mut draft = self.draft();
        edit(&mut draft.spec);
        Self::build(draft)
    }

    /// What was left out of the files that it names, a line each.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// Where the domain radius comes from.
    pub fn domain(&self) -> Domain {
        let is_given = self.spec.numerics.domain_radius.is_some();
        if is_given || self.setup.indenter.rim().is_some() {
            Domain::Given
        } else {
            Domain::Derived
        }
    }

    /// Returns the same scenario with another `[run]`, which is not checked.
    #[must_use]
    pub fn with_run(&self, run: RunPlan) -> Self {
        let mut scenario = self.clone();
        scenario.spec.run = run;
        scenario
    }

    /// Returns the same scenario with the errors of its run. [`errors`](Self::errors) returns them while the scenario
    /// stays otherwise unchanged.
    #[must_use]
    pub fn stating(mut self, errors: &Errors) -> Self {
        let stated = (*errors != Errors::default()).then(|| format!("{errors} | {}", self.seal()));
        self.spec.run.stated = stated;
        self
    }

    /// Returns the errors of the recorded run, unless the scenario was edited since.
    pub fn errors(&self) -> Option<Errors> {
        let (errors, seal) = self.spec.run.stated.as_deref()?.rsplit_once(" | ")?;
        errors.parse().ok().filter(|_| seal == self.seal())
    }

    /// Identifies this scenario without its errors.
    fn seal(&self) -> String {
        let mut bare = self.clone();
        bare.spec.run.stated = None;
        format!("{:08x}", crc32fast::hash(bare.to_toml().as_bytes()))
    }

    /// Returns the same scenario with other `[[changes]]`, which are not checked: they must be in order, and each
    /// accepted by [`after`](Self::after).
    #[must_use]
    pub fn with_changes(&self, changes: Vec<Change>) -> Self {
        let mut scenario = self.clone();
        scenario.spec.changes = changes;
        scenario
    }

    /// Returns the title, on one line; without one, the origin.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Describes what the scenario shows; may have several lines, or none.
    pub fn description(&self) -> &str {
        &self.description
    }

    /// Returns the preset's name or the path as given.
    pub fn origin(&self) -> &str {
        &self.origin
    }

    /// Returns the origin without directories and extension, in characters valid in any file name.
    pub fn stem(&self) -> String {
        let name = Path::new(&self.origin).file_stem();
        let name = name.map_or_else(|| "scenario".into(), |stem| stem.to_string_lossy());
        let mut stem = name.replace(|c: char| !c.is_alphanumeric() && !"-_.+".contains(c), "-");
        // Leaves room for a number and an extension, so that file systems accept the name.
        let mut ends = (0..=LONGEST_STEM.min(stem.len())).rev();
        stem.truncate(ends.find(|&end| stem.is_char_boundary(end)).unwrap_or(0));
        stem
    }

    /// Returns the parts of the simulation, ready to run.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// Returns length and output of the run.
    pub fn run(&self) -> &RunPlan {
        &self.spec.run
    }

    /// All keys.
    pub fn spec(&self) -> &Spec {
        &self.spec
    }

    /// Returns the changes during the run, in order.
    pub fn changes(&self) -> &[Change] {
        &self.spec.changes
    }

    /// Returns `numerics.accuracy` if given, or [`USUAL_ACCURACY`] if something wears and no numerics are chosen.
    /// [`refinement`](crate::studies::refinement) then has to find points, steps and tolerance; assigning one of them
    /// replaces the accuracy.
    pub fn accuracy(&self) -> Option<f64> {
        self.spec.numerics.accuracy
    }

    /// Returns `wear.share`, the indenter's part of the worn depth, if given. The contact only depends on the sum of
    /// both bodies' wear, so the simulation does not use it.
    pub fn wear_share(&self) -> Option<f64> {
        self.spec.wear.as_ref()?.share
    }

    /// Returns `material.fatigue_limit`, Pa, if given: stresses are compared with it after the run.
    pub fn fatigue_limit(&self) -> Option<f64> {
        self.spec.material.fatigue_limit
    }

    /// Returns the value at a dotted path as TOML, if the scenario gives one.
    pub fn value(&self, path: &str) -> Option<String> {
        Some(self.spec.get(Key::find(path)?)?.literal())
    }

    /// Returns the value of a key as given or, if another key has a word that uses it, as it follows from the rest.
    pub fn value_in_use(&self, key: Key) -> Option<Value> {
        let word = |path: &str| self.spec.or_usual(|of| of.get(Key::known(path)));
        let mut used_by = key.used_by.iter();
        let is_used = used_by.any(|(path, words)| {
            let word = word(path);
            words.iter().any(|of| word == Some(Value::Word(of)))
        });
        let law = || self.setup.wear?.parameters().field(key.key())?.get();
        let derived = || law().or_else(|| Spec::usual().get(key)).filter(|_| is_used);
        self.spec.get(key).or_else(derived)
    }

    /// Returns the number at a dotted path, if the scenario gives one.
    pub fn number(&self, path: &str) -> Option<f64> {
        self.spec.get(Key::find(path)?)?.number()
    }

    /// Whether the key at a dotted path is one of a motion that prescribes a force.
    pub fn prescribes_force(&self, path: &str) -> bool {
        let control = Key::find(&join(split(path).0, "control"));
        let force = Value::Word(spec::ControlWord::Force.into());
        control.and_then(|key| self.spec.get(key)) == Some(force)
    }

    /// Returns the complete scenario for a run. Reading it back gives an equal one, bit for bit. Values that follow
    /// from the method are comments, so that they still follow a change of it.
    pub fn to_toml(&self) -> String {
        let (setup, mut follows) = (&self.setup, Spec::default());
        follows.numerics.scheme = Some(setup.scheme);
        follows.numerics.grid = Some(setup.spacing).filter(|of| *of != Spacing::Given);
        let source = format!("default of method \"{}\"", setup.method);
        write::scenario(&self.spec, &follows, &source)
    }

    /// Reads a draft and makes its parts; errors show values as the user wrote them.
    fn build(mut draft: Draft) -> Result<Self, Refusal> {
        let (planned, notes) = draft.finish()?;
        let Draft {
            mut spec,
            mut faults,
            origin,
            directory,
            ..
        } = draft;
        // Defaults exclude nothing, and parts cannot be made of keys that exclude each other.
        let setup = match spec.conflict() {
            Some((path, rule)) => faults.refuse(&spec, path, rule),
            None => {
                spec.fill();
                setup::setup(&spec, &mut faults)
            }
        };
        let setup = faults.result(setup)?;
        let changes = std::mem::take(&mut spec.changes);
        let about = spec.about.clone();
        let title = about.title.filter(|title| !title.trim().is_empty());
        let description = about.description.unwrap_or_default();
        let lines: Vec<String> = description.lines().map(printable).collect();
        let mut scenario = Self {
            title: printable(title.as_ref().unwrap_or(&origin)),
            description: lines.join("\n"),
            origin,
            directory,
            spec,
            setup,
            notes,
        };
        scenario.spec.changes = scenario.plan_changes(changes, planned)?;
        if scenario.errors().is_none() {
            // They are of the scenario before it was edited.
            scenario.spec.run.stated = None;
        }
        Ok(scenario)
    }
}

/// Formats an assignment for an error message.
fn written(key: &str, value: &str) -> String {
    format!("{} = {}", echo(key), echo(value))
}

//! Scenarios: turns a TOML text, plus assignments of the command line, into parts that can be run.
//!
//! The pipeline: text (`read`) → TOML table → assignments (`assign`) → columns of other files (`embed`, `columns`) →
//! every key checked against the [`schema`], with its number in SI units (`check`, `units`) → fields with defaults
//! ([`spec`], `derive`) → the parts' own constructors (`parts`) → [`Scenario`]. Each step refuses bad input with one line
//! that names the origin, the dotted path, the value and the rule.

use std::ffi::OsStr;
use std::io::Read;
use std::path::{Path, PathBuf};

use draft::{Draft, Read as Drafted};

use crate::simulation::{Domain, Setup, Spacing};

pub(crate) mod blocks;
pub(crate) mod bounded_read;
mod change;
mod changes;
pub mod checkpoint;
pub mod columns;
mod derive;
pub(crate) mod draft;
mod embed;
mod error;
pub mod escape;
pub mod hints;
mod kind;
pub mod nearest;
mod parts;
pub mod preset;
mod read;
mod run;
pub mod scalars;
pub mod schema;
pub mod session;
pub mod spec;
pub mod typed;
pub mod units;
pub mod value;
pub(crate) mod values;
pub(crate) mod write;

pub use change::{Change, MOST_CHANGES};
pub use derive::choices;
use error::Origin;
pub use error::Refusal;
use escape::echo;
pub use escape::printable;
pub use run::{MOST_CYCLES, MOST_SNAPSHOTS, RunPlan};
pub use spec::{Spec, USUAL_ACCURACY};

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
        let (table, commas) = read::table(text, &Origin::new(origin))?;
        let mut draft = Draft::new(Spec::default(), origin);
        draft.read(table);
        for set in sets {
            let written = format!("--set {}", echo(set));
            let (key, value) = draft::split(set, &written)?;
            draft.assign(key, value, &written)?;
        }
        let built = Self::build(draft, origin, directory);
        let errors = commas.into_iter().chain(built.as_ref().err().cloned());
        Refusal::all(errors).map_or(built, Err)
    }

    /// Returns the same scenario with one key changed, by the rules of `--set`: `value` is TOML or a bare word.
    /// Changing `indenter.shape` drops the keys of the previous shape. Unless the scenario gives `numerics.grid` and
    /// `numerics.scheme`, they follow a change of `numerics.method`.
    pub fn with(&self, key: &str, value: &str) -> Result<Self, Refusal> {
        self.with_all(&[(key, value)])
    }

    /// The same scenario with other numbers at dotted paths.
    ///
    /// # Errors
    /// Numbers that are refused.
    pub fn with_numbers<'a>(
        &self,
        numbers: impl IntoIterator<Item = (&'a str, f64)>,
    ) -> Result<Self, Refusal> {
        let mut draft = Draft::new(self.spec.clone(), &self.origin);
        for (key, number) in numbers {
            let written = draft::written(key, &scalars::number(number));
            draft.put(schema::known(key), toml::Value::Float(number), &written);
        }
        Self::build(draft, &self.origin, &self.directory)
    }

    /// [`with`](Self::with) for several keys that are only right together, such as another shape
    /// and its size.
    pub fn with_all(
        &self,
        assignments: &[(impl AsRef<str>, impl AsRef<str>)],
    ) -> Result<Self, Refusal> {
        let mut draft = Draft::new(self.spec.clone(), &self.origin);
        for (key, value) in assignments {
            let (key, value) = (key.as_ref(), value.as_ref());
            let written = draft::written(key, value);
            draft.assign(key.trim(), value.trim(), &written)?;
        }
        let mut changed = Self::build(draft, &self.origin, &self.directory)?;
        changed.notes.splice(..0, self.notes.iter().cloned());
        Ok(changed)
    }

    /// What was left out of the files that it names, a line each.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// The same scenario with other parts.
    ///
    /// # Errors
    /// Values that are refused.
    pub fn edited(&self, edit: impl FnOnce(&mut Spec)) -> Result<Self, Refusal> {
        let mut spec = self.spec.clone();
        edit(&mut spec);
        Self::build(
            Draft::new(spec, &self.origin),
            &self.origin,
            &self.directory,
        )
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

    /// Returns the same scenario with the statements of its files on its errors, keys and values.
    /// [`statements`](Self::statements) returns them while the scenario stays otherwise unchanged.
    #[must_use]
    pub fn stating(mut self, statements: &[(String, String)]) -> Self {
        let seal = self.seal();
        self.spec.run.state(statements, &seal);
        self
    }

    /// Returns the error statements, keys and values, in the files of the recorded run; empty if the scenario records
    /// no run, or was edited since.
    pub fn statements(&self) -> Vec<(String, String)> {
        match self.spec.run.statements() {
            Some((statements, seal)) if seal == self.seal() => statements,
            _ => Vec::new(),
        }
    }

    /// Identifies this scenario without its statements.
    fn seal(&self) -> String {
        let bare = self.with_run(RunPlan {
            stated: None,
            ..self.spec.run.clone()
        });
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
        self.spec
            .get(schema::find(path)?)
            .map(|value| value.literal())
    }

    /// Returns the number at a dotted path, if the scenario gives one.
    pub fn number(&self, path: &str) -> Option<f64> {
        match self.spec.get(schema::find(path)?)? {
            value::Value::Number(number) => Some(number),
            value::Value::Whole(whole) => Some(whole as f64),
            _ => None,
        }
    }

    /// Whether the key at a dotted path is one of a motion that prescribes a force.
    pub fn prescribes_force(&self, path: &str) -> bool {
        let section = values::split(path).0;
        let motion = self.spec.motion.directions().find(|of| of.0 == section);
        motion.is_some_and(|(_, motion)| motion.control == Some(spec::Control::Force))
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

    /// Checks a draft and makes its parts; errors show values as the user wrote them.
    fn build(draft: Draft, origin: &str, directory: &Path) -> Result<Self, Refusal> {
        let Drafted {
            mut spec,
            origin: from,
            faults,
            changes,
            notes,
        } = draft.finish(directory)?;
        let from = &from;
        let before = std::mem::take(&mut spec.changes);
        let setup = parts::setup(&mut spec, from, faults)?;
        let changes = changes
            .into_iter()
            .map(|(at_cycle, set)| Change { at_cycle, set });
        let changes: Vec<Change> = before.into_iter().chain(changes).collect();
        if changes.len() > MOST_CHANGES {
            let rule = format!("must have at most {MOST_CHANGES} entries");
            return Err(from.refuse("changes", &changes.len().to_string(), rule));
        }
        let given = spec.title.as_deref();
        let given = given.filter(|title| !title.trim().is_empty());
        let description = spec.description.as_deref().unwrap_or_default();
        let lines: Vec<String> = description.lines().map(printable).collect();
        let scenario = Self {
            origin: origin.to_owned(),
            directory: directory.to_owned(),
            title: printable(given.unwrap_or(origin)),
            description: lines.join("\n"),
            spec,
            setup,
            notes,
        };
        scenario.check_changes(&changes, from)?;
        let mut scenario = scenario.with_changes(changes);
        if scenario.spec.run.stated.is_some() && scenario.statements().is_empty() {
            // They are about the scenario before it was edited.
            scenario.spec.run.stated = None;
        }
        Ok(scenario)
    }
}

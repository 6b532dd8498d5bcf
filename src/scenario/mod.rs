//! Scenarios: from a TOML text, and what the command line adds to it, to parts that can be run.
//!
//! The way of a scenario: text → TOML table → assignments (`--set`) → every key held against the
//! table of [`parameters`] → the serde mirror → the parts' own constructors → [`Scenario`]. Each
//! step refuses with one line that names the origin, the dotted path, the value and the rule.

use std::path::Path;

use toml::Table;

use crate::math::abel::AbelMethod;
use crate::simulation::{Integrator, Scheme, Setup};

pub mod accuracy;
mod assign;
mod check;
pub mod checkpoint;
mod derive;
mod error;
mod nearest;
pub mod parameters;
pub mod preset;
mod raw;
mod read;
mod run;
pub mod session;
mod table;
mod validate;
mod write;

use accuracy::Scene;
use error::{Origin, echo};
pub use error::{ScenarioError, printable};
pub use run::{Change, MOST_CYCLES, MOST_SNAPSHOTS, RunPlan};

/// A validated scenario: parts that are ready to run, and the text they can be made from again.
#[derive(Debug, Clone)]
pub struct Scenario {
    origin: String,
    title: String,
    description: String,
    /// All keys except `[run]` and `[[changes]]`, with the defaults that may change written out,
    /// but for those that follow the method.
    table: Table,
    setup: Setup,
    /// What is known of its accuracy.
    scene: Scene,
    run: RunPlan,
    changes: Vec<Change>,
}

/// Two scenarios are equal if they run alike; where they came from does not matter.
impl PartialEq for Scenario {
    fn eq(&self, other: &Self) -> bool {
        self.table == other.table
            && self.setup == other.setup
            && self.run == other.run
            && self.changes == other.changes
    }
}

impl Scenario {
    /// Loads a preset by its name, or a file: what has a `/` or ends in `.toml` is a path. Each of
    /// `sets` is a `KEY=VALUE` that replaces what stands there.
    pub fn load(name_or_path: &str, sets: &[String]) -> Result<Self, ScenarioError> {
        let is_path = name_or_path.contains(['/', std::path::MAIN_SEPARATOR])
            || name_or_path.to_lowercase().ends_with(".toml");
        if is_path {
            return Self::from_toml(&read::file(name_or_path)?, name_or_path, sets);
        }
        match preset::find(name_or_path) {
            Some(preset) => Self::from_toml(preset.text, preset.name, sets),
            None => Err(ScenarioError::UnknownPreset {
                name: echo(name_or_path),
                hint: preset::hint(name_or_path),
            }),
        }
    }

    /// Reads a scenario from a text that messages call `origin`.
    pub fn from_toml(text: &str, origin: &str, sets: &[String]) -> Result<Self, ScenarioError> {
        let mut from = Origin::new(origin);
        let mut table = read::table(text, &from)?;
        for set in sets {
            let (key, value) = assign::split(set, "--set ")?;
            let written = format!("--set {}", echo(set));
            assign::assign(&mut table, &mut from, key, value, &written)?;
        }
        Self::build(table, &from, origin)
    }

    /// The same scenario with one key changed, by the rules of `--set`: `value` is TOML or a bare
    /// word. Changing `indenter.shape` drops the keys of the shape before. Where the scenario gives
    /// no `numerics.grid` and `numerics.scheme`, they go with the `numerics.method` it is changed to.
    pub fn with(&self, key: &str, value: &str) -> Result<Self, ScenarioError> {
        self.with_all(&[(key, value)])
    }

    /// [`with`](Self::with) for several keys that are only right together, such as another shape
    /// and its size.
    pub fn with_all(&self, assignments: &[(&str, &str)]) -> Result<Self, ScenarioError> {
        let mut origin = Origin::new(&self.origin);
        let mut table = self.whole();
        for (key, value) in assignments {
            let written = assign::written(key, value);
            assign::assign(&mut table, &mut origin, key.trim(), value.trim(), &written)?;
        }
        Self::build(table, &origin, &self.origin)
    }

    /// The scenario that holds from `change` on; it has no changes of its own. Applied to one
    /// change after the other, it gives the stages of a run.
    pub fn after(&self, change: &Change) -> Result<Self, ScenarioError> {
        self.changed(&change.set, &echo(&change.set))
    }

    /// The same scenario with another `[run]`, which is taken as it is.
    #[must_use]
    pub fn with_run(&self, run: RunPlan) -> Self {
        Self {
            run,
            ..self.clone()
        }
    }

    /// The same scenario with other `[[changes]]`, which are taken as they are: in order, and each
    /// accepted by [`after`](Self::after).
    #[must_use]
    pub fn with_changes(&self, changes: Vec<Change>) -> Self {
        Self {
            changes,
            ..self.clone()
        }
    }

    /// The title, on one line; without one, the origin.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// What the scenario shows; may have several lines, or none.
    pub fn description(&self) -> &str {
        &self.description
    }

    /// The preset's name or the path as it was given.
    pub fn origin(&self) -> &str {
        &self.origin
    }

    /// The origin without directories and ending, in characters that any file name takes.
    pub fn stem(&self) -> String {
        let stem = Path::new(&self.origin).file_stem();
        let stem = stem.map_or_else(|| "scenario".into(), |stem| stem.to_string_lossy());
        let plain = |c: char| {
            if c.is_alphanumeric() || "-_.+".contains(c) {
                c
            } else {
                '-'
            }
        };
        stem.chars().map(plain).collect()
    }

    /// The parts of the simulation, ready to run.
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// How far the run goes and what it keeps.
    pub fn run(&self) -> &RunPlan {
        &self.run
    }

    /// What is changed during the run, in order.
    pub fn changes(&self) -> &[Change] {
        &self.changes
    }

    /// The error that the worn profile must be expected to have at the end, rms in largest depths: what was
    /// asked for, or what is known of the default numerics on so many cells.
    pub fn expected_error(&self) -> Option<f64> {
        let setup = &self.setup;
        let known = setup.method == AbelMethod::Product && setup.scheme == Scheme::Trapezoid;
        (known && setup.wear.is_some()).then(|| self.present_accuracy())
    }

    /// The accuracy that is asked for, or that would choose the finest of the present cells, steps and tolerance
    /// or a coarser one.
    pub fn present_accuracy(&self) -> f64 {
        let setup = &self.setup;
        let tolerance = match setup.integrator {
            Integrator::Direct => None,
            Integrator::CycleJump { tolerance } => Some(tolerance),
        };
        let asked = self.value("numerics.accuracy");
        let asked = asked.and_then(|value| value.parse().ok());
        asked.unwrap_or_else(|| {
            self.scene
                .expected(setup.grid.cells(), setup.steps_per_cycle, tolerance)
        })
    }

    /// The value at a dotted path as TOML, where the scenario gives one.
    pub fn value(&self, path: &str) -> Option<String> {
        let value = |table: &Table| write::at(table, path).map(write::value);
        match path.split('.').next() {
            // These two stand apart; the other keys are looked up as they are, for every frame.
            Some("run" | "changes") => value(&self.whole()),
            _ => value(&self.table),
        }
    }

    /// The whole scenario as it is run. Read back, it gives an equal one, to the last bit. What
    /// follows from the method stands there as a comment, so that it still follows a change of it.
    pub fn to_toml(&self) -> String {
        let setup = &self.setup;
        let quoted = |word: &str| format!("{word:?}");
        let mut follows = vec![
            ("numerics.grid", quoted(setup.spacing.name())),
            ("numerics.scheme", quoted(setup.scheme.name())),
        ];
        let source = match self.value("numerics.accuracy") {
            Some(_) => {
                follows.extend([
                    ("numerics.method", quoted(setup.method.name())),
                    ("numerics.points", setup.grid.cells().to_string()),
                    (
                        "numerics.steps_per_cycle",
                        setup.steps_per_cycle.to_string(),
                    ),
                    ("numerics.integrator", quoted(setup.integrator.name())),
                ]);
                if let Integrator::CycleJump { tolerance } = setup.integrator {
                    follows.push(("numerics.tolerance", write::number(tolerance)));
                }
                "what the accuracy asks for".to_owned()
            }
            None => format!("default of method \"{}\"", setup.method),
        };
        write::scenario(&self.whole(), &follows, &source)
    }

    /// Checks a table and makes its parts; errors show its values as they were written.
    fn build(table: Table, from: &Origin, origin: &str) -> Result<Self, ScenarioError> {
        check::keys(&table, from)?;
        let mut raw = read::mirror(table.clone(), from)?;
        raw.fill_in();
        let changes = std::mem::take(&mut raw.changes);
        validate::accuracy(&raw, &table, from)?;
        let (setup, scene) = validate::setup(&raw, &table, from)?;
        let run = std::mem::take(&mut raw.run);
        let mut table = Table::try_from(&raw).map_err(|error| from.broken(&error))?;
        table.remove("run");
        table.remove("changes");
        let given = raw
            .title
            .as_deref()
            .filter(|title| !title.trim().is_empty());
        let lines: Vec<String> = raw
            .description
            .iter()
            .flat_map(|text| text.lines())
            .map(printable)
            .collect();
        let scenario = Self {
            origin: origin.to_owned(),
            title: printable(given.unwrap_or(origin)),
            description: lines.join("\n"),
            table,
            setup,
            scene,
            run,
            changes: Vec::new(),
        };
        validate::run(&scenario.run, from)?;
        scenario.check_changes(&changes, from)?;
        Ok(scenario.with_changes(changes))
    }

    /// Walks through the stages of a run, so that a change that cannot be made is found before it.
    fn check_changes(&self, changes: &[Change], from: &Origin) -> Result<(), ScenarioError> {
        let mut stage = self.clone();
        let mut before = 0.0;
        for (i, change) in changes.iter().enumerate() {
            let at = format!("changes[{i}].at_cycle");
            if change.at_cycle < before {
                let rule =
                    format!("must be {before} or greater: changes stand in the order of the run");
                return Err(from.refuse(&at, &change.at_cycle.to_string(), rule));
            }
            before = change.at_cycle;
            let set = from.place(
                &format!("changes[{i}].set"),
                &format!("\"{}\"", echo(&change.set)),
            );
            stage = stage.changed(&change.set, &set)?;
        }
        Ok(())
    }

    fn changed(&self, set: &str, written: &str) -> Result<Self, ScenarioError> {
        let (key, value) = assign::split(set, "").map_err(|_| ScenarioError::NotAnAssignment {
            given: written.to_owned(),
        })?;
        if ["title", "description"].contains(&key) || key.starts_with("run.") {
            return Err(ScenarioError::Refused {
                place: written.to_owned(),
                rule: format!("{key} cannot change during a run"),
            });
        }
        let mut origin = Origin::new(&self.origin);
        let mut table = self.with_changes(Vec::new()).whole();
        assign::assign(&mut table, &mut origin, key, value, written)?;
        Self::build(table, &origin, &self.origin)
    }

    /// All keys, `[run]` and `[[changes]]` included.
    fn whole(&self) -> Table {
        let mut table = self.table.clone();
        table.insert("run".into(), self.run.to_table().into());
        let changes: Vec<Table> = self.changes.iter().map(Change::to_table).collect();
        table.insert("changes".into(), changes.into());
        table
    }
}

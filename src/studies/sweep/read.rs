//! Reads a study from a TOML text. Each refusal is one line: what is wrong, where, what would be right.

use std::collections::BTreeSet;
use std::path::Path;

use serde::Deserialize;
use toml::{Table, Value};

use super::design::{Design, MOST_POINTS, MOST_SAMPLED_AXES, MOST_SAMPLES};
use super::points;
use super::refuse::{Result, ensure, error, refuse};
use super::study::Study;
use super::written_axis::{Samples, WrittenAxis, flat};
use crate::reading::Column;
use crate::scenario::preset;
use crate::scenario::scalars;
use crate::scenario::{Refusal, Scenario, printable, typed};

/// The columns of a study that names none.
const COLUMNS: [Column; 4] = [
    Column::WearVolume,
    Column::DissipatedEnergy,
    Column::Regime,
    Column::WornDepthError,
];

/// The way to points that no design makes.
const BY_FILE: &str = "two lines of Python write such points into a file for points = \"file.csv\": see mdr-tui guide studies";

/// A study as written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    title: Option<String>,
    base: String,
    columns: Option<Vec<String>>,
    design: Option<Design>,
    points: Option<String>,
    samples: Option<usize>,
    seed: Option<u32>,
    #[serde(default)]
    set: Table,
    #[serde(default)]
    axis: Vec<WrittenAxis>,
}

impl Study {
    /// Reads a study from a text, called `origin` in messages; the paths of its base and of its points are relative to
    /// `directory`.
    ///
    /// # Errors
    ///
    /// If the text is not TOML, has unknown keys or columns (suggests the nearest known one) or values that break a
    /// rule, or if the base or the points cannot be read.
    pub fn read(text: &str, origin: &str, directory: &Path) -> Result<Self> {
        Self::read_on(text, origin, directory, |name| {
            let path = if preset::is_path(name) {
                directory.join(name).to_string_lossy().into_owned()
            } else {
                name.to_owned()
            };
            Scenario::load(&path, &[])
        })
    }

    /// Reads a study whose base is given as text, as in a record.
    ///
    /// # Errors
    ///
    /// As [`read`](Self::read).
    pub fn read_with_base(text: &str, origin: &str, base: &str) -> Result<Self> {
        let load = |name: &str| Scenario::from_toml(base, name, &[]);
        Self::read_on(text, origin, Path::new(""), load)
    }

    fn read_on(
        text: &str,
        origin: &str,
        directory: &Path,
        load: impl FnOnce(&str) -> Result<Scenario>,
    ) -> Result<Self> {
        let origin = printable(origin);
        let refused = |why: Refusal| Refusal::new(&origin, why);
        let written: Table = typed::read(text).map_err(|why| refused(why.into()))?;
        refuse_gone(&written).map_err(refused)?;
        let given: Written = typed::read(text).map_err(|why| refused(why.into()))?;
        let base = load(&given.base)?;
        given.study(base, written, directory).map_err(refused)
    }
}

impl Written {
    /// Builds the study on its base.
    fn study(self, base: Scenario, written: Table, directory: &Path) -> Result<Study> {
        let samples = self.samples()?;
        let set = flat("set", &self.set)?.into_iter();
        let mut study = Study {
            title: self.title.as_deref().map(printable),
            set: set.map(|(key, value)| (key.to_string(), value)).collect(),
            design: self.design.unwrap_or_default(),
            written,
            ..Study::new(base, columns(self.columns.as_deref())?)
        };
        let mut axes = Vec::new();
        if let Some(file) = &self.points {
            let alone = self.axis.is_empty() && self.design.is_none();
            ensure(
                alone,
                "points names the values of all keys: leave out design and [[axis]]",
            )?;
            axes = points::read(&directory.join(file), &study)?;
            study.set_points(&axes);
        }
        for (at, axis) in self.axis.into_iter().enumerate() {
            axes.push(axis.read(at, &study, samples)?);
        }
        let rule = "there is no axis: add [[axis]] with key and values, linspace or logspace";
        ensure(!axes.is_empty(), rule)?;
        let mut taken: BTreeSet<&str> = study.set.keys().map(String::as_str).collect();
        for (at, axis) in axes.iter().enumerate() {
            for key in std::iter::once(&axis.key).chain(axis.tied.iter().map(|(key, _)| key)) {
                let rule = "[set], the axes and tied keys must name different keys";
                let why = format!("axis[{at}]: {key} is given twice; {rule}");
                ensure(taken.insert(key.path), why)?;
            }
        }
        study.axes = axes;
        check_count(&study)?;
        Ok(study)
    }

    /// Returns the number of samples and the seed of a sampled design.
    fn samples(&self) -> Result<Option<Samples>> {
        if self.design != Some(Design::Sobol) {
            let is_sampled = self.samples.is_some() || self.seed.is_some();
            let why = "samples and seed go with design = \"sobol\"";
            return ensure(!is_sampled, why).map(|()| None);
        }
        let why = format!("design = \"sobol\" takes {MOST_SAMPLED_AXES} axes or fewer");
        ensure(self.axis.len() <= MOST_SAMPLED_AXES, why)?;
        match self.samples {
            None => error("samples is missing: the number of points that design = \"sobol\" draws"),
            Some(count) if (1..=MOST_SAMPLES).contains(&count) => Ok(Some(Samples {
                count,
                seed: self.seed.unwrap_or(0),
            })),
            Some(count) => {
                let rule = format!("must be a whole number from 1 to {MOST_SAMPLES}");
                refuse("samples", count, rule)
            }
        }
    }
}

/// Refuses what studies asked for in earlier versions, and names the new way.
fn refuse_gone(written: &Table) -> Result<()> {
    let design = written.get("design").and_then(Value::as_str);
    if let Some(word @ ("latin-hypercube" | "pairwise")) = design {
        let rule = format!("is gone; design = \"sobol\" fills the space evenly, and {BY_FILE}");
        return refuse("design", format_args!("\"{word}\""), rule);
    }
    let by_table = "make run.cycles an axis, and read from the table where the limit is reached";
    for (key, instead) in [("sensitivity", BY_FILE), ("stop", by_table)] {
        let why = format!("[{key}] is gone; {instead}");
        ensure(!written.contains_key(key), why)?;
    }
    Ok(())
}

fn columns(names: Option<&[String]>) -> Result<Vec<Column>> {
    let Some(names) = names else {
        return Ok(COLUMNS.to_vec());
    };
    let mut columns = Vec::new();
    for name in names {
        let column = scalars::find_scalar(name);
        let column = column.map_err(|why| Refusal::from(format!("columns: {why}")))?;
        if columns.contains(&column) {
            return refuse("columns", Value::from(name.as_str()), "stands twice");
        }
        columns.push(column);
    }
    Ok(columns)
}

/// Refuses too many points, and axes of different lengths that are not combined.
fn check_count(study: &Study) -> Result<()> {
    if study.design == Design::Grid {
        let points: f64 = study.axes.iter().map(|axis| axis.count() as f64).product();
        let why = format!("{points:.3e} points; the limit is {MOST_POINTS}");
        return ensure(points <= MOST_POINTS as f64, why);
    }
    let length = study.points();
    let Some(axis) = study.axes.iter().find(|axis| axis.count() != length) else {
        return Ok(());
    };
    let (key, count) = (&axis.key, axis.count());
    error(format!(
        "axis {key}: has {count} values, the first axis {length}; without a grid, all need the same number"
    ))
}

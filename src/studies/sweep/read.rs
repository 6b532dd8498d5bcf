//! Reads a study from a TOML text. Each refusal is one line: what is wrong, where, what would be right.

use std::collections::BTreeSet;
use std::fmt::Display;
use std::path::Path;

use serde::Deserialize;
use toml::{Table, Value};

use super::axis::{self, StudyAxis};
use super::design::{self, Design, MOST_POINTS, MOST_SAMPLED_AXES, MOST_SAMPLES};
use super::points;
use super::study::Study;
use crate::math::scale::Scale;
use crate::reading::Column;
use crate::scenario::blocks::flatten;
use crate::scenario::key::Key;
use crate::scenario::scalars;
use crate::scenario::{Refusal, Scenario, printable, typed};
use crate::scenario::{preset, units, value};

/// The columns of a study that names none.
const COLUMNS: [Column; 4] = [
    Column::WearVolume,
    Column::DissipatedEnergy,
    Column::Regime,
    Column::WornDepthError,
];

/// The way to points that no design makes.
const BY_FILE: &str = "two lines of Python write such points into a file for points = \"file.csv\": see mdr-tui guide studies";

pub(super) type Result<T> = std::result::Result<T, Refusal>;

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

/// An axis as written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenAxis {
    key: String,
    values: Option<Vec<Value>>,
    linspace: Option<Vec<Value>>,
    logspace: Option<Vec<Value>>,
    scale: Option<Scale>,
    #[serde(default)]
    tied: Table,
}

/// The number of samples of a design that draws them, and its seed.
#[derive(Debug, Clone, Copy)]
struct Samples {
    count: usize,
    seed: u32,
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
            axes.push(read_axis(axis, at, &study, samples)?);
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

fn error<T>(why: impl Display) -> Result<T> {
    Err(Refusal::from(why.to_string()))
}

fn ensure(holds: bool, why: impl Display) -> Result<()> {
    if holds { Ok(()) } else { error(why) }
}

pub(super) fn refuse<T>(place: &str, value: impl Display, rule: impl Display) -> Result<T> {
    Err(Refusal::of_value(place, value, rule))
}

/// Returns the scenario keys of a table at `place` and their values, from dotted keys and nested tables alike.
fn flat(place: &str, table: &Table) -> Result<Vec<(Key, Value)>> {
    let mut found = Vec::new();
    for (key, value) in table {
        flatten(key, value, &mut found);
    }
    let found = found.into_iter();
    let found = found.map(|(key, value)| Ok((Key::named(&key, place)?, value)));
    found.collect()
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

/// Reads axis number `at` of a study.
fn read_axis(
    axis: WrittenAxis,
    at: usize,
    study: &Study,
    samples: Option<Samples>,
) -> Result<StudyAxis> {
    let place = format!("axis[{at}]");
    let key = Key::named(&axis.key, &place)?;
    let (name, list, spread) = match (axis.values, axis.linspace, axis.logspace) {
        (Some(list), None, None) => ("values", list, axis.scale.unwrap_or(Scale::Linear)),
        (None, Some(list), None) => ("linspace", list, Scale::Linear),
        (None, None, Some(list)) => ("logspace", list, Scale::Log),
        _ => {
            let rule = "must have one of values, linspace and logspace";
            return error(format!("{place} ({key}): {rule}"));
        }
    };
    let why = format!("{place}.scale: goes with values, not with {name}");
    ensure(axis.scale.is_none() || name == "values", why)?;
    let named = format!("{place}.{name}");
    let quantities = list
        .into_iter()
        .map(|value| quantity(key, value, study, &named));
    let list: Vec<Value> = quantities.collect::<Result<_>>()?;
    let values = match name {
        "values" if list.is_empty() => {
            return refuse(&named, "[]", "must be a list of one value or more");
        }
        "values" => list.into_iter().map(|value| normal(key, value)).collect(),
        _ => {
            let (ends, count) = ends_and_count(&named, &list, spread, samples)?;
            match samples {
                None => axis::spaced(key, ends, count, spread),
                Some(Samples { seed, .. }) => {
                    let shares = (0..count).map(|index| design::sample(index, at, seed));
                    axis::at_shares(key, ends, spread, shares)
                }
            }
        }
    };
    Ok(StudyAxis {
        tied: read_tied_keys(&axis.tied, &format!("{place}.tied"), &values)?,
        key,
        values,
        spread,
    })
}

/// Converts a text that is a number with a unit to SI, and refuses lists and tables.
pub(super) fn quantity(key: Key, value: Value, study: &Study, place: &str) -> Result<Value> {
    if matches!(value, Value::Array(_) | Value::Table(_)) {
        return refuse(place, value, "must be a number, a text or a flag");
    }
    let text = value.as_str().unwrap_or_default();
    match units::quantity(text, &key, study.is_force(key)) {
        Some(Ok(number)) => Ok(Value::Float(number)),
        Some(Err(rule)) => refuse(place, value, rule),
        None => Ok(value),
    }
}

/// Writes whole numbers alike: 100 and 100.0 are one value.
pub(super) fn normal(key: Key, value: Value) -> Value {
    match value {
        Value::Integer(whole) => axis::value_of(key, whole as f64),
        value => value,
    }
}

/// Reads the ends of an axis and the number of its values: [from, to, number], or [from, to] for samples.
fn ends_and_count(
    place: &str,
    list: &[Value],
    spread: Scale,
    samples: Option<Samples>,
) -> Result<([f64; 2], usize)> {
    let refuse = |rule: &str| refuse(place, Value::from(list.to_vec()), rule);
    let (from, to, number) = match (list, samples) {
        ([from, to], Some(samples)) => (from, to, Some(samples.count)),
        (_, Some(_)) => return refuse("must be [from, to]; samples gives the number"),
        ([from, to, number], None) => {
            let number = number.as_integer();
            (from, to, number.and_then(|number| number.try_into().ok()))
        }
        (_, None) => return refuse("must be [from, to, number]"),
    };
    let (Some(from), Some(to)) = (value::number(from), value::number(to)) else {
        return refuse("must begin with two finite numbers");
    };
    if spread == Scale::Log && from.min(to) <= 0.0 {
        return refuse("must begin with two numbers greater than 0");
    }
    match number.filter(|number| (1..=MOST_POINTS).contains(number)) {
        Some(number) => Ok(([from, to], number)),
        None => {
            let rule = format!("the third must be a whole number from 1 to {MOST_POINTS}");
            refuse(&rule)
        }
    }
}

fn read_tied_keys(table: &Table, place: &str, axis: &[Value]) -> Result<Vec<(Key, f64)>> {
    let are_numbers = axis.iter().all(|value| value::number(value).is_some());
    let why = format!("{place}: needs an axis of numbers");
    ensure(table.is_empty() || are_numbers, why)?;
    let factors = flat(place, table)?.into_iter();
    let factors = factors.map(|(key, value)| match value::number(&value) {
        Some(factor) => Ok((key, factor)),
        None => refuse(&format!("{place}.{key}"), value, "must be a finite factor"),
    });
    factors.collect()
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

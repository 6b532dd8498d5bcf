//! Reads a study from a TOML text. Each refusal is one line: what is wrong, where, what would be right.

use std::collections::BTreeSet;
use std::fmt::Display;
use std::path::Path;

use serde::Deserialize;
use toml::{Table, Value};

use super::axis::{self, StudyAxis, Values, known_key};
use super::design::{Design, MOST_POINTS, MOST_SOBOL_AXES, Spacing};
use super::study::{Stop, Study};
use crate::math::number::exact;
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

type Result<T> = std::result::Result<T, Refusal>;

/// A study as written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    title: Option<String>,
    base: String,
    columns: Option<Vec<String>>,
    #[serde(default)]
    design: Design,
    samples: Option<usize>,
    seed: Option<u32>,
    #[serde(default)]
    set: Table,
    #[serde(default)]
    stop: Stop,
    sensitivity: Option<Table>,
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

impl Study {
    /// Reads a study from a text, called `origin` in messages; the path of its base is relative to `directory`.
    ///
    /// # Errors
    ///
    /// If the text is not TOML, has unknown keys or columns (suggests the nearest known one) or values that break a
    /// rule, or if the base cannot be loaded.
    pub fn read(text: &str, origin: &str, directory: &Path) -> Result<Self> {
        Self::read_on(text, origin, |name| {
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
        Self::read_on(text, origin, |name| Scenario::from_toml(base, name, &[]))
    }

    fn read_on(
        text: &str,
        origin: &str,
        load: impl FnOnce(&str) -> Result<Scenario>,
    ) -> Result<Self> {
        let origin = printable(origin);
        let refused = |why: Refusal| Refusal::new(&origin, why);
        let given: Written = typed::read(text).map_err(|why| refused(why.into()))?;
        let written: Table = typed::read(text).map_err(|why| refused(why.into()))?;
        let base = load(&given.base)?;
        given.study(base, written).map_err(refused)
    }
}

impl Written {
    /// Builds the study on its base.
    fn study(self, base: Scenario, written: Table) -> Result<Study> {
        let samples = samples(&self)?;
        check_stop(self.stop)?;
        let varied = self.sensitivity.as_ref().map(sensitivity).transpose()?;
        let mut study = Study {
            title: self.title.as_deref().map(printable),
            set: flat("set", &self.set)?.into_iter().collect(),
            design: self.design,
            stop: self.stop,
            sensitivity: varied.unwrap_or_default(),
            written,
            ..Study::new(base, columns(self.columns.as_deref())?)
        };
        let has_purpose = !self.axis.is_empty() || self.sensitivity.is_some();
        let rule = "there is no axis: add [[axis]] with key and values, linspace or logspace";
        ensure(has_purpose, rule)?;
        let is_many = study.design == Design::Sobol && self.axis.len() > MOST_SOBOL_AXES;
        let rule = format!("design = \"sobol\" takes {MOST_SOBOL_AXES} axes or fewer");
        ensure(!is_many, rule)?;
        let mut taken: BTreeSet<String> = study.set.keys().cloned().collect();
        for (at, axis) in self.axis.into_iter().enumerate() {
            let place = format!("axis[{at}]");
            let axis = read_axis(axis, &place, &study, samples)?;
            for key in std::iter::once(&axis.key).chain(axis.tied.iter().map(|(key, _)| key)) {
                let rule = "[set], the axes and tied keys must name different keys";
                let why = format!("{place}: {key} is given twice; {rule}");
                ensure(taken.insert(key.clone()), why)?;
            }
            study.axes.push(axis);
        }
        check_count(&study)?;
        Ok(study)
    }
}

fn error<T>(why: impl Display) -> Result<T> {
    Err(Refusal::from(why.to_string()))
}

fn ensure(holds: bool, why: impl Display) -> Result<()> {
    if holds { Ok(()) } else { error(why) }
}

fn refuse<T>(place: &str, value: impl Display, rule: impl Display) -> Result<T> {
    Err(Refusal::of_value(place, value, rule))
}

/// Returns the number of samples and the seed of a sampled design.
fn samples(written: &Written) -> Result<Option<(usize, u32)>> {
    let (design, seed) = (written.design, written.seed);
    let Some(most) = design.most_samples() else {
        let rule = "samples and seed go with design = \"latin-hypercube\" or \"sobol\"";
        return ensure(written.samples.is_none() && seed.is_none(), rule).map(|()| None);
    };
    match written.samples {
        None => error(format!(
            "samples is missing: the number of points that design = \"{design}\" draws"
        )),
        Some(samples) if (1..=most).contains(&samples) => Ok(Some((samples, seed.unwrap_or(0)))),
        Some(samples) => {
            let rule = format!("must be a whole number from 1 to {most}");
            refuse("samples", samples, rule)
        }
    }
}

/// Returns the scenario keys of a table at `place` and their values, from dotted keys and nested tables alike.
fn flat(place: &str, table: &Table) -> Result<Vec<(String, Value)>> {
    let mut found = Vec::new();
    for (key, value) in table {
        flatten(key, value, &mut found);
    }
    let mut keys = found.iter().map(|(key, _)| key);
    keys.try_for_each(|key| known_key(key, place))?;
    Ok(found)
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

fn check_stop(stop: Stop) -> Result<()> {
    for (name, value) in [
        ("worn_depth", stop.worn_depth),
        ("volume", stop.volume),
        ("settled", stop.settled),
    ] {
        if let Some(value) = value.filter(|value| !(value.is_finite() && *value > 0.0)) {
            let place = format!("stop.{name}");
            return refuse(&place, exact(value), "must be a number greater than 0");
        }
    }
    Ok(())
}

fn sensitivity(table: &Table) -> Result<Vec<(String, f64)>> {
    let rule = "must be a standard deviation, 0 if it is not known";
    numbers("sensitivity", table, rule, |number| number >= 0.0)
}

/// Returns the scenario keys of a table at `place` and their values, finite numbers that satisfy a `rule`.
fn numbers(
    place: &str,
    table: &Table,
    rule: &str,
    keeps: fn(f64) -> bool,
) -> Result<Vec<(String, f64)>> {
    let values = flat(place, table)?.into_iter();
    let values = values.map(|(key, value)| match value::number(&value) {
        Some(number) if keeps(number) => Ok((key, number)),
        _ => refuse(&format!("{place}.{key}"), value, rule),
    });
    values.collect()
}

/// Reads the next axis of a study.
fn read_axis(
    axis: WrittenAxis,
    place: &str,
    study: &Study,
    samples: Option<(usize, u32)>,
) -> Result<StudyAxis> {
    let key = axis.key;
    known_key(&key, place)?;
    let (name, mut list, spread) = match (axis.values, axis.linspace, axis.logspace) {
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
    // Texts may be numbers with units.
    for value in &mut list {
        let text = value.as_str().unwrap_or_default();
        let quantity = |known: Key| units::quantity(text, &known, study.is_force(&key));
        match Key::find(&key).and_then(quantity) {
            Some(Ok(number)) => *value = Value::Float(number),
            Some(Err(rule)) => return refuse(&named, value, rule),
            None => {}
        }
    }
    let values = match name {
        "values" => Values::Listed(listed(&key, &named, list)?),
        _ => {
            let at = study.axes.len();
            let sampled =
                samples.map(|(count, seed)| (count, Spacing::new(study.design, at, seed)));
            between(&named, &list, spread, sampled)?
        }
    };
    Ok(StudyAxis {
        tied: read_tied_keys(&axis.tied, &format!("{place}.tied"), &values)?,
        key,
        values,
        spread,
    })
}

fn listed(key: &str, place: &str, list: Vec<Value>) -> Result<Vec<Value>> {
    if list.is_empty() {
        return refuse(place, "[]", "must be a list of one value or more");
    }
    let nested = |value: &Value| matches!(value, Value::Array(_) | Value::Table(_));
    if list.iter().any(nested) {
        let rule = "its values must be numbers, texts or flags";
        return refuse(place, Value::Array(list), rule);
    }
    // 100 and 100.0 are one value, and are written alike.
    let normal = |value: Value| match value {
        Value::Integer(whole) => axis::value_of(key, whole as f64),
        value => value,
    };
    Ok(list.into_iter().map(normal).collect())
}

/// Reads the values from a list [from, to, number], or [from, to] for samples.
fn between(
    place: &str,
    list: &[Value],
    spread: Scale,
    sampled: Option<(usize, Spacing)>,
) -> Result<Values> {
    let refuse = |rule: &str| refuse(place, Value::from(list.to_vec()), rule);
    let (from, to, number) = match (list, sampled) {
        ([from, to], Some(_)) => (from, to, None),
        (_, Some(_)) => return refuse("must be [from, to]; samples gives the number"),
        ([from, to, number], None) => (from, to, number.as_integer()),
        (_, None) => return refuse("must be [from, to, number]"),
    };
    let (Some(from), Some(to)) = (value::number(from), value::number(to)) else {
        return refuse("must begin with two finite numbers");
    };
    if spread == Scale::Log && from.min(to) <= 0.0 {
        return refuse("must begin with two numbers greater than 0");
    }
    let number = number.and_then(|number| usize::try_from(number).ok());
    let number = number.filter(|number| (1..=MOST_POINTS).contains(number));
    match sampled.or(number.map(|number| (number, Spacing::Even))) {
        Some((number, spacing)) => Ok(Values::Between([from, to], number, spacing)),
        None => refuse(&format!(
            "the third must be a whole number from 1 to {MOST_POINTS}"
        )),
    }
}

fn read_tied_keys(table: &Table, place: &str, values: &Values) -> Result<Vec<(String, f64)>> {
    if let Values::Listed(values) = values {
        let are_numbers = values.iter().all(|value| value::number(value).is_some());
        let why = format!("{place}: needs an axis of numbers");
        ensure(table.is_empty() || are_numbers, why)?;
    }
    numbers(place, table, "must be a finite factor", |_| true)
}

/// Refuses too many points, and zipped axes of different lengths.
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
    let (key, count, design) = (&axis.key, axis.count(), study.design);
    error(format!(
        "axis {key}: has {count} values, the first axis {length}; design = \"{design}\" needs the same number on each"
    ))
}

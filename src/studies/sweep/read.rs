//! From a TOML text to a study. Each refusal is one line: what is wrong, where, what would be right.

use std::path::Path;

use toml::{Table, Value};

use super::StudyError;
use super::axis::{self, Axis, Spread, Values};
use super::design::{self, Design, MOST_SOBOL_AXES, Strata};
use super::sensitivity::Varied;
use super::study::{self, Stop, Study};
use crate::scenario::nearest::nearest;
use crate::scenario::scalars::{self, Scalar};
use crate::scenario::{Scenario, printable};
use crate::scenario::{schema, units};

const KEYS: [&str; 10] = [
    "title",
    "base",
    "columns",
    "design",
    "samples",
    "seed",
    "set",
    "stop",
    "sensitivity",
    "axis",
];
const AXIS_KEYS: [&str; 6] = ["key", "values", "linspace", "logspace", "scale", "tied"];

/// The columns of a study that names none.
const COLUMNS: [&str; 4] = [
    "wear_volume_m3",
    "dissipated_energy_J",
    "regime",
    "estimated_error",
];

/// The most points of a study.
const MOST_POINTS: usize = 10_000_000;

type Result<T> = std::result::Result<T, StudyError>;

impl Study {
    /// Reads a study from a text that messages call `origin`; the path of its base is relative to
    /// `directory`.
    ///
    /// # Errors
    ///
    /// Refuses what is not TOML, unknown keys and columns (with the nearest known one), values that
    /// break a rule, and a base that cannot be loaded.
    pub fn read(text: &str, origin: &str, directory: &Path) -> Result<Self> {
        Self::read_on(text, origin, |name| {
            let is_path =
                name.contains(['/', std::path::MAIN_SEPARATOR]) || name.ends_with(".toml");
            let path = match is_path {
                true => directory.join(name).to_string_lossy().into_owned(),
                false => name.to_owned(),
            };
            Scenario::load(&path, &[]).map_err(|error| StudyError(error.to_string()))
        })
    }

    /// Reads a study whose base is given by its own text, as a record holds it.
    ///
    /// # Errors
    ///
    /// As [`read`](Self::read).
    pub fn read_with_base(text: &str, origin: &str, base: &str) -> Result<Self> {
        Self::read_on(text, origin, |name| {
            Scenario::from_toml(base, name, &[]).map_err(|error| StudyError(error.to_string()))
        })
    }

    fn read_on(
        text: &str,
        origin: &str,
        load: impl FnOnce(&str) -> Result<Scenario>,
    ) -> Result<Self> {
        let from = Origin(printable(origin));
        let mut table: Table = toml::from_str(text).map_err(|error| {
            let at = error.span().map_or(0, |span| span.start);
            let line = text.get(..at).unwrap_or(text).matches('\n').count() + 1;
            let message = printable(&error.message().replace('\n', "; "));
            StudyError(format!("{}: line {line}: {message}", from.0))
        })?;
        from.known(&table, "", &KEYS)?;
        let title = from.optional(&table, "title", Value::as_str, "a text")?;
        let Some(base_name) = from.optional(&table, "base", Value::as_str, "a text")? else {
            return Err(StudyError(format!(
                "{}: base is missing: a preset's name or a path to a scenario",
                from.0
            )));
        };
        let (title, base_name) = (title.map(printable), base_name.to_owned());
        let base = load(&base_name)?;
        let (design, samples) = from.design(&table)?;
        let set = from.set(&table)?;
        from.to_si(&mut table, |key| study::is_force(key, &set, &base))?;
        let axes = from.axes(&table, design, samples, &set)?;
        let study = Self {
            title,
            base_name,
            base,
            set,
            axes,
            design,
            samples,
            columns: from.columns(&table)?,
            stop: from.stop(&table)?,
            sensitivity: from.sensitivity(&table)?,
        };
        from.count(&study)?;
        Ok(study)
    }
}

/// What messages call the study.
struct Origin(String);

impl Origin {
    fn refuse<T>(&self, place: &str, value: &Value, rule: impl std::fmt::Display) -> Result<T> {
        let mut shown: String = value.to_string().chars().take(60).collect();
        if shown.len() < value.to_string().len() {
            shown.push_str("...");
        }
        let shown = printable(&shown);
        Err(StudyError(format!("{}: {place} = {shown}: {rule}", self.0)))
    }

    /// Refuses keys of `table`, which stands at `place`, that are not among `keys`.
    fn known(&self, table: &Table, place: &str, keys: &[&str]) -> Result<()> {
        let Some(unknown) = table.keys().find(|key| !keys.contains(&key.as_str())) else {
            return Ok(());
        };
        let hint = match nearest(unknown, keys.iter().copied()) {
            Some(near) => format!("did you mean {near}?"),
            None => format!("known are {}", keys.join(", ")),
        };
        let key = printable(unknown);
        Err(StudyError(format!(
            "{}: unknown key {place}{key}; {hint}",
            self.0
        )))
    }

    fn optional<'a, T>(
        &self,
        table: &'a Table,
        key: &str,
        read: impl FnOnce(&'a Value) -> Option<T>,
        wanted: &str,
    ) -> Result<Option<T>> {
        let Some(value) = table.get(key) else {
            return Ok(None);
        };
        match read(value) {
            Some(read) => Ok(Some(read)),
            None => self.refuse(key, value, format!("must be {wanted}")),
        }
    }

    fn design(&self, table: &Table) -> Result<(Design, Option<(usize, u32)>)> {
        let named = |value: &Value| {
            let name = value.as_str()?;
            Design::ALL.into_iter().find(|design| design.name() == name)
        };
        let names = Design::ALL.map(|design| format!("\"{}\"", design.name()));
        let wanted = format!("one of {}", names.join(", "));
        let design = self.optional(table, "design", named, &wanted)?;
        let design = design.unwrap_or(Design::Grid);
        let most = design.most_samples();
        let whole = |value: &Value| usize::try_from(value.as_integer()?).ok();
        let samples = |value: &Value| whole(value).filter(|n| (1..=most).contains(n));
        let wanted = format!("a whole number from 1 to {most}");
        let samples = self.optional(table, "samples", samples, &wanted)?;
        let seed = |value: &Value| u32::try_from(value.as_integer()?).ok();
        let seed = self.optional(table, "seed", seed, "a whole number from 0 to 4294967295")?;
        match (design.is_sampled(), samples) {
            (true, Some(samples)) => Ok((design, Some((samples, seed.unwrap_or(0))))),
            (true, None) => Err(StudyError(format!(
                "{}: samples is missing: the number of points that design = \"{}\" draws",
                self.0,
                design.name()
            ))),
            (false, None) if seed.is_none() => Ok((design, None)),
            (false, _) => Err(StudyError(format!(
                "{}: samples and seed go with design = \"latin-hypercube\" or \"sobol\"",
                self.0
            ))),
        }
    }

    fn set(&self, table: &Table) -> Result<Vec<(String, Value)>> {
        let set = self.optional(table, "set", Value::as_table, "a table of keys and values")?;
        let mut found = Vec::new();
        for (key, value) in set.into_iter().flatten() {
            self.flatten(key, value, &mut found)?;
        }
        Ok(found)
    }

    /// Takes dotted keys and nested tables alike.
    fn flatten(&self, path: &str, value: &Value, found: &mut Vec<(String, Value)>) -> Result<()> {
        match value {
            Value::Table(table) => {
                for (key, value) in table {
                    self.flatten(&format!("{path}.{key}"), value, found)?;
                }
            }
            value => {
                self.key(path, "set")?;
                found.push((path.to_owned(), value.clone()));
            }
        }
        Ok(())
    }

    /// Refuses a key that no scenario has.
    fn key(&self, key: &str, place: &str) -> Result<()> {
        if schema::find(key).is_some() && !key.starts_with("changes") {
            return Ok(());
        }
        let hint = schema::hint(key);
        let key = printable(key);
        Err(StudyError(format!(
            "{}: {place}: unknown key {key}; {hint}",
            self.0
        )))
    }

    fn columns(&self, table: &Table) -> Result<Vec<&'static Scalar>> {
        let Some(value) = table.get("columns") else {
            return Ok(COLUMNS
                .iter()
                .filter_map(|name| scalars::find(name))
                .collect());
        };
        let names = value
            .as_array()
            .and_then(|list| list.iter().map(Value::as_str).collect::<Option<Vec<_>>>());
        let Some(names) = names else {
            return self.refuse(
                "columns",
                value,
                "must be a list of names, as [\"wear_volume_m3\"]",
            );
        };
        let mut columns: Vec<&Scalar> = Vec::new();
        for name in names {
            let column = scalars::named(name);
            let column = column.map_err(|why| StudyError(format!("{}: columns: {why}", self.0)))?;
            if columns.contains(&column) {
                return self.refuse("columns", &Value::from(name), "stands twice");
            }
            columns.push(column);
        }
        Ok(columns)
    }

    fn stop(&self, table: &Table) -> Result<Stop> {
        let mut stop = Stop::default();
        let Some(given) = self.optional(table, "stop", Value::as_table, "a table")? else {
            return Ok(stop);
        };
        self.known(given, "stop.", &stop.named().map(|(name, _)| name))?;
        for (key, value) in given {
            let number = axis::numeric(value).filter(|number| number.is_finite() && *number > 0.0);
            if number.is_none() {
                return self.refuse(
                    &format!("stop.{key}"),
                    value,
                    "must be a number greater than 0",
                );
            }
            match key.as_str() {
                "worn_depth" => stop.worn_depth = number,
                "volume" => stop.volume = number,
                _ => stop.settled = number,
            }
        }
        Ok(stop)
    }

    fn sensitivity(&self, table: &Table) -> Result<Vec<Varied>> {
        let wanted = "a table of keys and standard deviations";
        let given = self.optional(table, "sensitivity", Value::as_table, wanted)?;
        let mut found = Vec::new();
        for (key, value) in given.into_iter().flatten() {
            self.flatten(key, value, &mut found)?;
        }
        let mut varied = Vec::new();
        for (key, value) in found {
            let number = axis::numeric(&value).filter(|number| *number >= 0.0);
            let Some(deviation) = number.filter(|number| number.is_finite()) else {
                let place = format!("sensitivity.{key}");
                let rule = "must be a standard deviation, 0 if it is not known";
                return self.refuse(&place, &value, rule);
            };
            let deviation = (deviation > 0.0).then_some(deviation);
            varied.push(Varied { key, deviation });
        }
        Ok(varied)
    }

    /// Replaces the texts in the lists of the axes that are numbers with a unit by numbers.
    fn to_si(&self, table: &mut Table, is_force: impl Fn(&str) -> bool) -> Result<()> {
        let axes = table.get_mut("axis").and_then(Value::as_array_mut);
        for (at, axis) in axes.into_iter().flatten().enumerate() {
            let key = axis.get("key").and_then(Value::as_str).map(str::to_owned);
            let Some(known) = key.as_deref().and_then(schema::find) else {
                continue;
            };
            for name in ["values", "linspace", "logspace"] {
                let list = axis.get_mut(name).and_then(Value::as_array_mut);
                for value in list.into_iter().flatten() {
                    let text = value.as_str().unwrap_or_default();
                    match units::quantity(text, known, is_force(known.path)) {
                        Some(Ok(number)) => *value = Value::Float(number),
                        Some(Err(rule)) => {
                            return self.refuse(&format!("axis[{at}].{name}"), value, rule);
                        }
                        None => {}
                    }
                }
            }
        }
        Ok(())
    }

    fn axes(
        &self,
        table: &Table,
        design: Design,
        samples: Option<(usize, u32)>,
        set: &[(String, Value)],
    ) -> Result<Vec<Axis>> {
        let tables = |value: &Value| {
            let list = value.as_array()?;
            list.iter().map(|axis| axis.as_table().cloned()).collect()
        };
        let wanted = "an array of tables, [[axis]] with key and values";
        let given: Option<Vec<Table>> = self.optional(table, "axis", tables, wanted)?;
        let given = given.unwrap_or_default();
        if given.is_empty() && !table.contains_key("sensitivity") {
            return Err(StudyError(format!(
                "{}: there is no axis: add [[axis]] with key and values, linspace or logspace",
                self.0
            )));
        }
        if design == Design::Sobol && given.len() > MOST_SOBOL_AXES {
            return Err(StudyError(format!(
                "{}: design = \"sobol\" takes {MOST_SOBOL_AXES} axes or fewer",
                self.0
            )));
        }
        let mut axes: Vec<Axis> = Vec::new();
        let mut taken: Vec<String> = set.iter().map(|(key, _)| key.clone()).collect();
        for (at, table) in given.iter().enumerate() {
            let axis = self.axis(table, at, samples.map(|(n, seed)| (design, n, seed)))?;
            let keys = std::iter::once(&axis.key).chain(axis.tied.iter().map(|(key, _)| key));
            for key in keys {
                if taken.contains(key) {
                    return Err(StudyError(format!(
                        "{}: axis[{at}]: {key} is given twice; [set], the axes and tied keys \
                         must name different keys",
                        self.0
                    )));
                }
                taken.push(key.clone());
            }
            axes.push(axis);
        }
        Ok(axes)
    }

    fn axis(
        &self,
        table: &Table,
        at: usize,
        sampling: Option<(Design, usize, u32)>,
    ) -> Result<Axis> {
        let place = format!("axis[{at}]");
        self.known(table, &format!("{place}."), &AXIS_KEYS)?;
        let key = match table.get("key") {
            Some(Value::String(key)) => key.clone(),
            Some(other) => return self.refuse(&format!("{place}.key"), other, "must be a string"),
            None => {
                return Err(StudyError(format!(
                    "{}: {place}.key is missing: the dotted path of a scenario's key",
                    self.0
                )));
            }
        };
        self.key(&key, &place)?;
        let given = ["values", "linspace", "logspace"];
        let given: Vec<_> = given
            .iter()
            .filter_map(|name| Some((*name, table.get(*name)?)))
            .collect();
        let [(name, value)] = given[..] else {
            return Err(StudyError(format!(
                "{}: {place} ({key}): must have one of values, linspace and logspace",
                self.0
            )));
        };
        let named = format!("{place}.{name}");
        let mut spread = design::spread_of(name);
        if let Some(scale) = table.get("scale") {
            match (name, scale.as_str()) {
                ("values", Some("log")) => spread = Spread::Logarithmic,
                ("values", Some("linear")) => {}
                ("values", _) => {
                    let rule = "must be \"linear\" or \"log\"";
                    return self.refuse(&format!("{place}.scale"), scale, rule);
                }
                _ => return self.refuse(&format!("{place}.scale"), scale, "goes with values"),
            }
        }
        let values = match (name, sampling) {
            ("values", _) => Values::Listed(self.listed(&key, &named, value)?),
            (_, None) => self.spaced(&named, value, spread)?,
            (_, Some((design, samples, seed))) => {
                let [from, to] = self.ends(&named, value, spread, 2)?;
                match design {
                    Design::Sobol => {
                        let shares = design::sobol(at, samples, seed);
                        let value = |share| axis::between(spread, from, to, share);
                        let values = shares.map(|share| axis::value_of(&key, value(share)));
                        Values::Listed(values.collect())
                    }
                    _ => Values::Drawn([from, to], Strata::new(at, samples, seed)),
                }
            }
        };
        let tied = self.tied(table, &place, &values)?;
        Ok(Axis {
            key,
            values,
            spread,
            tied,
        })
    }

    fn listed(&self, key: &str, place: &str, value: &Value) -> Result<Vec<Value>> {
        let plain = |value: &Value| !matches!(value, Value::Array(_) | Value::Table(_));
        let list = value.as_array().filter(|list| !list.is_empty());
        let Some(list) = list.filter(|list| list.iter().all(plain)) else {
            let rule = match value.as_array() {
                Some(list) if !list.is_empty() => "its values must be numbers, texts or flags",
                _ => "must be a list of one value or more",
            };
            return self.refuse(place, value, rule);
        };
        // 100 and 100.0 are one value, so that both are written alike.
        let normal = |value: &Value| match axis::numeric(value) {
            Some(number) => match value {
                Value::Integer(_) => axis::value_of(key, number),
                _ => value.clone(),
            },
            None => value.clone(),
        };
        Ok(list.iter().map(normal).collect())
    }

    fn spaced(&self, place: &str, value: &Value, spread: Spread) -> Result<Values> {
        let ends = self.ends(place, value, spread, 3)?;
        let count = value.get(2).and_then(Value::as_integer);
        let count = count.and_then(|count| usize::try_from(count).ok());
        let Some(count) = count.filter(|count| (1..=MOST_POINTS).contains(count)) else {
            let rule = format!("the third must be a whole number from 1 to {MOST_POINTS}");
            return self.refuse(place, value, rule);
        };
        Ok(Values::Spaced(ends, count))
    }

    /// The ends of a list [from, to, …] of `length`.
    fn ends(&self, place: &str, value: &Value, spread: Spread, length: usize) -> Result<[f64; 2]> {
        let list = value.as_array().filter(|list| list.len() == length);
        let Some(list) = list else {
            let rule = match length {
                2 => "must be [from, to]; samples gives the number",
                _ => "must be [from, to, number]",
            };
            return self.refuse(place, value, rule);
        };
        let end = |value: &Value| axis::numeric(value).filter(|number| number.is_finite());
        let (Some(from), Some(to)) = (end(&list[0]), end(&list[1])) else {
            return self.refuse(place, value, "must begin with two finite numbers");
        };
        if spread == Spread::Logarithmic && (from <= 0.0 || to <= 0.0) {
            return self.refuse(place, value, "must begin with two numbers greater than 0");
        }
        Ok([from, to])
    }

    fn tied(&self, table: &Table, place: &str, values: &Values) -> Result<Vec<(String, f64)>> {
        let place = format!("{place}.tied");
        let mut tied = Vec::new();
        let Some(given) = table.get("tied") else {
            return Ok(tied);
        };
        let Some(given) = given.as_table() else {
            return self.refuse(&place, given, "must be a table, as { \"some.key\" = 0.1 }");
        };
        if let Values::Listed(values) = values
            && values.iter().any(|value| axis::numeric(value).is_none())
        {
            return Err(StudyError(format!(
                "{}: {place}: needs an axis of numbers",
                self.0
            )));
        }
        let mut flat = Vec::new();
        for (key, value) in given {
            self.flatten(key, value, &mut flat)?;
        }
        for (key, factor) in flat {
            let Some(number) = axis::numeric(&factor).filter(|factor| factor.is_finite()) else {
                return self.refuse(
                    &format!("{place}.{key}"),
                    &factor,
                    "must be a finite factor",
                );
            };
            tied.push((key, number));
        }
        Ok(tied)
    }

    /// Refuses too many points, and zipped axes of different lengths.
    fn count(&self, study: &Study) -> Result<()> {
        let lengths = study.axes.iter().map(|axis| axis.count());
        if study.design == Design::Grid {
            let points = lengths.fold(1.0, |points, length| points * length as f64);
            if points > MOST_POINTS as f64 {
                return Err(StudyError(format!(
                    "{}: {points:.3e} points; the limit is {MOST_POINTS}",
                    self.0
                )));
            }
            return Ok(());
        }
        let length = study.points();
        match study.axes.iter().find(|axis| axis.count() != length) {
            None => Ok(()),
            Some(axis) => Err(StudyError(format!(
                "{}: axis {}: has {} values, the first axis {length}; design = \"{}\" needs the \
                 same number on each",
                self.0,
                axis.key,
                axis.count(),
                study.design.name()
            ))),
        }
    }
}

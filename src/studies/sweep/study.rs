//! A study: the scenario of every point, and the columns to record.

use std::collections::BTreeMap;

use toml::{Table, Value};

use super::Design;
use super::axis::{self, StudyAxis};
use crate::reading::Column;
use crate::scenario::escape::cell;
use crate::scenario::key::{Key, join};
use crate::scenario::value::literal;
use crate::scenario::{Refusal, Scenario, printable};
use crate::scenario::{change, units};

/// One scenario for many values of some of its keys.
#[derive(Debug, Clone)]
pub struct Study {
    /// The `title`, if there is one.
    pub title: Option<String>,
    /// The base scenario.
    pub base: Scenario,
    /// Settings for all points, as for `--set`.
    pub set: BTreeMap<String, Value>,
    /// The varied keys.
    pub axes: Vec<StudyAxis>,
    /// How the axes are combined into points.
    pub design: Design,
    /// The columns after the axes' columns.
    pub columns: Vec<Column>,
    /// The study as written.
    pub(super) written: Table,
}

impl Study {
    /// Makes a study without axes.
    pub fn new(base: Scenario, columns: Vec<Column>) -> Self {
        Self {
            title: None,
            base,
            set: BTreeMap::new(),
            axes: Vec::new(),
            design: Design::Grid,
            columns,
            written: Table::new(),
        }
    }

    /// Returns the number of points.
    pub fn points(&self) -> usize {
        match self.design {
            Design::Grid => self.axes.iter().map(|axis| axis.count()).product(),
            _ => self.axes.first().map_or(1, |axis| axis.count()),
        }
    }

    /// Returns the place of `point` on each axis.
    pub fn places(&self, point: usize) -> Vec<usize> {
        if self.design != Design::Grid {
            return vec![point; self.axes.len()];
        }
        let (mut rest, mut places) = (point, vec![0; self.axes.len()]);
        for (place, axis) in places.iter_mut().zip(&self.axes).rev() {
            *place = rest % axis.count();
            rest /= axis.count();
        }
        places
    }

    /// Returns the values of the axes at `point`, as in its row, each on one line.
    pub fn values(&self, point: usize) -> Vec<String> {
        let places = self.places(point);
        let axes = self.axes.iter().zip(places);
        let shown = axes.map(|(axis, place)| cell(&axis.text(place)));
        shown.collect()
    }

    /// Names `point` by its number and its values.
    pub fn name(&self, point: usize) -> String {
        let values = self.axes.iter().zip(self.values(point));
        let parts = values.map(|(axis, value)| format!("{} = {value}", axis.key));
        let parts: Vec<String> = parts.collect();
        format!("point {point} ({})", parts.join(", "))
    }

    /// Returns the names of all columns, in order: the keys of the axes, the columns, `status`.
    pub fn columns(&self) -> Vec<&str> {
        let axes = self.axes.iter().map(|axis| axis.key.path);
        let columns = self.columns.iter().map(|column| column.name());
        axes.chain(columns).chain(["status"]).collect()
    }

    /// Builds the scenario of `point`.
    ///
    /// # Errors
    ///
    /// If the values are not a valid scenario, or if the scenario has no end.
    pub fn scenario(&self, point: usize) -> Result<Scenario, Refusal> {
        self.scenario_at(&self.places(point), None)
    }

    /// Builds the scenario with the axes at `places`, except for an axis with another value.
    ///
    /// # Errors
    ///
    /// As for [`scenario`](Self::scenario).
    pub fn scenario_at(
        &self,
        places: &[usize],
        other: Option<(usize, f64)>,
    ) -> Result<Scenario, Refusal> {
        let set = self.set.iter();
        let set = set.map(|(key, value)| (key.as_str(), axis::text(value)));
        let axes = self.axes.iter().zip(places).enumerate();
        let axes = axes.flat_map(|(at, (axis, &place))| match other {
            Some((along, value)) if along == at => {
                axis.assignments(&axis::value_of(axis.key, value))
            }
            _ => axis.assignments(&axis.values[place]),
        });
        let all: Vec<(&str, String)> = set.chain(axes).collect();
        let scenario = self.base.assigned(&all)?;
        if scenario.run().cycles.is_none() {
            let (name, key) = (self.base.origin(), "run.cycles");
            let meaning = "number of cycles per point; [set] \"run.cycles\" = 100 gives it";
            return Err(Refusal::missing(name, key, meaning));
        }
        Ok(scenario)
    }

    /// Returns the unit of an axis.
    pub fn unit(&self, axis: &StudyAxis) -> &'static str {
        units::unit_of(&axis.key, self.is_force(axis.key))
    }

    /// Whether the motion of `key` prescribes a force, by the settings for all points or by the base.
    pub(super) fn is_force(&self, key: Key) -> bool {
        let control = self.set.get(&join(key.section(), "control"));
        match control {
            Some(control) => control.as_str() == Some("force"),
            None => self.base.prescribes_force(key.path),
        }
    }

    /// Sets a key for all points, as `--set` does: `KEY=VALUE`. Replaces the value in `[set]`.
    ///
    /// # Errors
    ///
    /// If the text is not an assignment, the key is unknown, or it is the key of an axis.
    pub fn assign(&mut self, set: &str) -> Result<(), Refusal> {
        let place = format!("--set {}", printable(set));
        let (key, value) = change::split(set, &place)?;
        let key = Key::named(key, &place)?;
        let varied =
            |axis: &StudyAxis| axis.key == key || axis.tied.iter().any(|(tied, _)| *tied == key);
        if self.axes.iter().any(varied) {
            let rule = format!("{key} is varied by an axis of the study");
            return Err(Refusal::new(place, rule));
        }
        let value: Value = value.parse().unwrap_or_else(|_| value.into());
        self.set.insert(key.path.to_owned(), value);
        Ok(())
    }

    /// Returns the study as TOML, as written but without comments, including later settings.
    pub fn to_toml(&self) -> String {
        let mut table = self.written.clone();
        table.remove("set");
        if !self.set.is_empty() {
            let set = self.set.clone().into_iter();
            table.insert("set".to_owned(), Value::Table(set.collect()));
        }
        let (mut text, mut sections) = (String::new(), String::new());
        for (key, value) in &table {
            match value {
                Value::Table(rows) => sections += &format!("\n[{key}]\n{}", lines(rows)),
                Value::Array(list) if list.iter().any(Value::is_table) => {
                    for rows in list.iter().filter_map(Value::as_table) {
                        sections += &format!("\n[[{key}]]\n{}", lines(rows));
                    }
                }
                value => text += &line(key, value),
            }
        }
        text + &sections
    }
}

fn lines(rows: &Table) -> String {
    rows.iter().map(|(key, value)| line(key, value)).collect()
}

/// Formats a key and its value. A dotted path is one key; scenario keys need no escapes.
fn line(key: &str, value: &Value) -> String {
    let mut signs = key.chars();
    let is_bare = signs.all(|c| c.is_ascii_alphanumeric() || "_-".contains(c));
    let quote = if is_bare { "" } else { "\"" };
    format!("{quote}{key}{quote} = {}\n", literal(value))
}

//! A study: the scenario of every point, and the columns to record.

use std::fmt::Display;

use serde::Deserialize;
use toml::Value;

use super::Design;
use super::axis::{self, Axis, Values};
use super::sensitivity::Varied;
use crate::scenario::scalars::Scalar;
use crate::scenario::write::value as toml_value;
use crate::scenario::{Refusal, Scenario, ScenarioError, printable};
use crate::scenario::{assign, hints, schema, units};

/// When a point ends before its `run.cycles`: at the end of the first cycle in which one of these is
/// reached.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Stop {
    /// The largest worn depth, m.
    pub worn_depth: Option<f64>,
    /// The worn volume, m³.
    pub volume: Option<f64>,
    /// The wear has come to rest: the second half of the cycles has added at most this share of
    /// the worn volume.
    pub settled: Option<f64>,
}

impl Stop {
    /// Names and values, as in `[stop]`.
    pub(super) fn named(&self) -> [(&'static str, Option<f64>); 3] {
        [
            ("worn_depth", self.worn_depth),
            ("volume", self.volume),
            ("settled", self.settled),
        ]
    }
}

/// One scenario for many values of some of its keys.
#[derive(Debug, Clone)]
pub struct Study {
    /// The `title`, if there is one.
    pub title: Option<String>,
    /// The base as the study names it: a preset, or a path relative to the study.
    pub base_name: String,
    /// The base.
    pub base: Scenario,
    /// What is set for all points, as `--set` takes it.
    pub set: Vec<(String, Value)>,
    /// What is varied.
    pub axes: Vec<Axis>,
    /// How the axes make points.
    pub design: Design,
    /// Number of samples and seed of a sampled design.
    pub samples: Option<(usize, u32)>,
    /// The columns after the axes' columns.
    pub columns: Vec<&'static Scalar>,
    /// When a point ends.
    pub stop: Stop,
    /// Keys whose sensitivities are asked for.
    pub sensitivity: Vec<Varied>,
}

impl Study {
    /// The number of points.
    pub fn points(&self) -> usize {
        match self.design {
            Design::Grid => self.axes.iter().map(|axis| axis.count()).product(),
            _ => self.axes.first().map_or(1, |axis| axis.count()),
        }
    }

    /// The place of `point` on each axis.
    pub fn places(&self, point: usize) -> Vec<usize> {
        if self.design != Design::Grid {
            return vec![point; self.axes.len()];
        }
        let mut rest = point;
        let mut places: Vec<usize> = self
            .axes
            .iter()
            .rev()
            .map(|axis| {
                let place = rest % axis.count();
                rest /= axis.count();
                place
            })
            .collect();
        places.reverse();
        places
    }

    /// The values of the axes at `point`, as its row shows them: on one line, whatever they hold.
    pub fn values(&self, point: usize) -> Vec<String> {
        let places = self.places(point);
        let axes = self.axes.iter().zip(places);
        axes.map(|(axis, place)| printable(&axis.text(place)))
            .collect()
    }

    /// `point` in words: its number and its values.
    pub fn name(&self, point: usize) -> String {
        let values = self.axes.iter().zip(self.values(point));
        let values: Vec<String> = values
            .map(|(axis, value)| format!("{} = {value}", axis.key))
            .collect();
        format!("point {point} ({})", values.join(", "))
    }

    /// The names of all columns, in order: the keys of the axes, the columns, `status`.
    pub fn columns(&self) -> Vec<&str> {
        let axes = self.axes.iter().map(|axis| axis.key.as_str());
        let columns = self.columns.iter().map(|column| column.name);
        axes.chain(columns).chain(["status"]).collect()
    }

    /// The scenario of `point`.
    ///
    /// # Errors
    ///
    /// Refuses values that make no valid scenario, and one without an end.
    pub fn scenario(&self, point: usize) -> Result<Scenario, ScenarioError> {
        self.scenario_at(&self.places(point), None)
    }

    /// The scenario with the axes at `places`, but for an axis that has another value.
    ///
    /// # Errors
    ///
    /// As [`scenario`](Self::scenario).
    pub fn scenario_at(
        &self,
        places: &[usize],
        other: Option<(usize, f64)>,
    ) -> Result<Scenario, ScenarioError> {
        let axes = self.axes.iter().zip(places).enumerate();
        self.build(axes.flat_map(|(at, (axis, &place))| match other {
            Some((along, value)) if along == at => {
                axis.assignments(&axis::value_of(&axis.key, value))
            }
            _ => axis.assignments(&axis.value(place)),
        }))
    }

    /// The base with what is set for all points, and nothing of the axes.
    ///
    /// # Errors
    ///
    /// As [`scenario`](Self::scenario).
    pub fn middle(&self) -> Result<Scenario, ScenarioError> {
        self.build(std::iter::empty())
    }

    /// The keys whose sensitivities are asked for: those in `[sensitivity]`, or the axes' keys.
    pub fn varied(&self) -> Vec<Varied> {
        if !self.sensitivity.is_empty() {
            return self.sensitivity.clone();
        }
        let axes = self.axes.iter().map(|axis| Varied {
            key: axis.key.clone(),
            deviation: None,
        });
        axes.collect()
    }

    /// The unit of an axis.
    pub fn unit(&self, axis: &Axis) -> &'static str {
        let is_force = self.is_force(&axis.key);
        schema::find(&axis.key).map_or("", |known| units::unit_of(known, is_force))
    }

    /// Whether the motion that `key` belongs to prescribes a force, by what is set for all points or by the base.
    pub(super) fn is_force(&self, key: &str) -> bool {
        let Some((motion, _)) = key.rsplit_once('.') else {
            return false;
        };
        let control = format!("{motion}.control");
        let set = self.set.iter().find(|(known, _)| *known == control);
        let control = match set {
            Some((_, value)) => value.as_str().map(str::to_owned),
            None => self.base.value(&control),
        };
        control.is_some_and(|control| control.trim_matches('"') == "force")
    }

    fn build<'a>(
        &'a self,
        axes: impl Iterator<Item = (&'a str, String)>,
    ) -> Result<Scenario, ScenarioError> {
        let set = self.set.iter();
        let set = set.map(|(key, value)| (key.as_str(), axis::text(value)));
        let all: Vec<(&str, String)> = set.chain(axes).collect();
        let scenario = self.base.with_all(&all)?;
        match scenario.run().cycles {
            Some(_) => Ok(scenario),
            None => {
                let meaning = "number of cycles per point; [set] \"run.cycles\" = 100 gives it";
                Err(ScenarioError::missing(
                    &self.base_name,
                    "run.cycles",
                    meaning,
                ))
            }
        }
    }

    /// Sets a key for all points, as `--set` does: `KEY=VALUE`. It takes the place of what `[set]`
    /// says.
    ///
    /// # Errors
    ///
    /// Refuses a text that is not an assignment, an unknown key, and the key of an axis.
    pub fn assign(&mut self, set: &str) -> Result<(), ScenarioError> {
        let (key, value) = assign::split(set, "--set ")?;
        let refuse = |why| Refusal::new(format_args!("--set {}", printable(set)), why);
        if schema::find(key).is_none() {
            let why = format!("unknown key {key}; {}", hints::hint(key));
            return Err(refuse(why).into());
        }
        let varied = |axis: &Axis| axis.key == key || axis.tied.iter().any(|(tied, _)| tied == key);
        if self.axes.iter().any(varied) {
            return Err(refuse(format!("{key} is varied by an axis of the study")).into());
        }
        let value: Value = value.parse().unwrap_or_else(|_| value.into());
        match self.set.iter_mut().find(|(known, _)| known == key) {
            Some((_, known)) => *known = value,
            None => self.set.push((key.to_owned(), value)),
        }
        Ok(())
    }

    /// The study as TOML, in one form for all ways to write it.
    pub fn to_toml(&self) -> String {
        let columns = self.columns.iter().map(|column| column.name.into());
        let mut head: Vec<(&str, Value)> = vec![
            ("base", self.base_name.clone().into()),
            ("columns", Value::Array(columns.collect())),
            ("design", self.design.name().into()),
        ];
        if let Some((samples, seed)) = self.samples {
            head.push(("samples", (samples as i64).into()));
            head.push(("seed", i64::from(seed).into()));
        }
        let title = self.title.clone();
        let title = title.map(|title| ("title", Value::from(title)));
        let mut text = lines(title.into_iter().chain(head));
        let stop = self.stop.named().into_iter();
        let stop = stop.filter_map(|(name, value)| Some((name.into(), value?.into())));
        let varied = self.sensitivity.iter();
        let varied = varied.map(|one| (one.key.clone(), one.deviation.unwrap_or(0.0).into()));
        for (name, mut rows) in [
            ("set", self.set.clone()),
            ("stop", stop.collect()),
            ("sensitivity", varied.collect()),
        ] {
            rows.sort_by(|(one, _): &(String, _), (other, _)| one.cmp(other));
            if !rows.is_empty() {
                text += &format!("\n[{name}]\n");
                text += &lines(rows.iter().map(|(key, value)| (quoted(key), value.clone())));
            }
        }
        for axis in &self.axes {
            text += &format!("\n[[axis]]\n{}", written(axis));
        }
        text
    }
}

/// The most values that an axis of two ends and a number lists in a table's header.
const MOST_LISTED: usize = 1000;

/// An axis as written in a study: its values listed, or its ends if there are many.
fn written(axis: &Axis) -> String {
    let is_logarithmic = axis.spread == axis::Spread::Logarithmic;
    let ends = match axis.values {
        Values::Spaced([from, to], count) if count > MOST_LISTED => {
            Some(vec![from.into(), to.into(), (count as i64).into()])
        }
        Values::Drawn([from, to], strata) if strata.len() > MOST_LISTED => {
            Some(vec![from.into(), to.into()])
        }
        _ => None,
    };
    let (name, list, scale) = match ends {
        Some(ends) if is_logarithmic => ("logspace", ends, None),
        Some(ends) => ("linspace", ends, None),
        None => {
            let values = (0..axis.count()).map(|place| axis.value(place));
            ("values", values.collect(), is_logarithmic.then_some("log"))
        }
    };
    let rows = [("key", axis.key.clone().into()), (name, list.into())];
    let scale = scale.map(|scale| ("scale", scale.into()));
    let mut text = lines(rows.into_iter().chain(scale));
    if !axis.tied.is_empty() {
        let tied = axis.tied.iter();
        let tied = tied.map(|(key, factor)| assignment(quoted(key), &(*factor).into()));
        text += &format!("tied = {{ {} }}\n", tied.collect::<Vec<_>>().join(", "));
    }
    text
}

/// Keys and values, a line each.
fn lines(rows: impl IntoIterator<Item = (impl Display, Value)>) -> String {
    let rows = rows.into_iter();
    rows.map(|(key, value)| assignment(key, &value) + "\n")
        .collect()
}

fn assignment(key: impl Display, value: &Value) -> String {
    format!("{key} = {}", toml_value(value))
}

/// A dotted path as one key of TOML. The keys of scenarios need no escapes.
fn quoted(path: &str) -> String {
    format!("\"{path}\"")
}

//! Points from a file: a CSV table whose header names keys of the scenario, with a row per point.

use std::path::Path;

use toml::{Table, Value};

use super::axis::StudyAxis;
use super::design::{Design, MOST_POINTS};
use super::refuse::{Result, refuse};
use super::study::Study;
use super::written_axis::{normal, quantity};
use crate::math::scale::Scale;
use crate::scenario::bounded_read;
use crate::scenario::key::Key;
use crate::scenario::{Refusal, printable};

/// The largest file to be read, in bytes.
const LARGEST: u64 = 1 << 30;

/// Reads the points of a study from a file: an axis for each of its columns. Values are in SI units, or texts with
/// units; lines that begin with `#` are comments.
///
/// # Errors
///
/// If the file is no such table: the first line with an unknown key, another number of fields, an empty field or a value
/// of another unit.
pub(super) fn read(path: &Path, study: &Study) -> Result<Vec<StudyAxis>> {
    let name = printable(&path.display().to_string());
    let unread = |why| Refusal::unread(&name, &why);
    let text = bounded_read::text(path, LARGEST).map_err(unread)?;
    let lines = text.trim_start_matches('\u{feff}').lines().enumerate();
    let is_empty = |line: &str| line.trim().is_empty() || line.starts_with('#');
    let mut lines = lines.filter(|(_, line)| !is_empty(line));
    let keys = lines.next().map_or(Vec::new(), |(_, line)| fields(line));
    let mut axes = Vec::new();
    for key in keys {
        axes.push(StudyAxis {
            key: Key::named(&key, &name)?,
            values: Vec::new(),
            spread: Scale::Linear,
            tied: Vec::new(),
        });
    }
    for (at, line) in lines {
        let (place, fields) = (format!("{name}:{}", at + 1), fields(line));
        let (given, wanted) = (fields.len(), axes.len());
        if given != wanted {
            let rule = format!("has {given} fields, the header {wanted}");
            return Err(Refusal::new(place, rule));
        }
        for (axis, field) in axes.iter_mut().zip(fields) {
            let place = format!("{place}: {}", axis.key);
            if field.is_empty() {
                return refuse(&place, "\"\"", "must have a value");
            }
            let value = quantity(axis.key, value(field), study, &place)?;
            axis.values.push(normal(axis.key, value));
        }
    }
    match axes.first().map_or(0, StudyAxis::count) {
        1..=MOST_POINTS => Ok(axes),
        count => {
            let rule = format!("has {count} points; a study has 1 to {MOST_POINTS}");
            Err(Refusal::new(name, rule))
        }
    }
}

/// Splits a line into its fields.
fn fields(line: &str) -> Vec<String> {
    let mut reader = csv::ReaderBuilder::new();
    let reader = reader.has_headers(false).trim(csv::Trim::All);
    let rows = reader.from_reader(line.as_bytes()).into_records();
    // Reading from memory cannot fail.
    let row = rows.flatten().next().unwrap_or_default();
    row.iter().map(str::to_owned).collect()
}

/// Reads a field: a number, a flag, or a text.
fn value(field: String) -> Value {
    let whole = field.parse().map(Value::Integer);
    let number = |_| field.parse().map(Value::Float);
    let flag = |_| field.parse().map(Value::Boolean);
    let value = whole.or_else(number).or_else(flag);
    value.unwrap_or(Value::String(field))
}

impl Study {
    /// Makes points that were read from a file part of the study's own text: as axes whose values belong together, so that
    /// the head of its table says all.
    pub(super) fn set_points(&mut self, axes: &[StudyAxis]) {
        let axis = |axis: &StudyAxis| {
            let values = Value::Array(axis.values.clone());
            let key = Value::from(axis.key.path);
            Value::Table(Table::from_iter([
                ("key".to_owned(), key),
                ("values".to_owned(), values),
            ]))
        };
        self.design = Design::Zip;
        self.written.remove("points");
        let axes = axes.iter().map(axis).collect();
        self.written.insert("axis".to_owned(), Value::Array(axes));
        self.written.insert("design".to_owned(), Value::from("zip"));
    }
}

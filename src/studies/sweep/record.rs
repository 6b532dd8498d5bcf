//! The table of a study as text: a header that holds the whole study and its base, the names of the
//! columns, and a row per point.
//!
//! ```text
//! # mdr-tui: 0.1.0
//! # study: base = "li2019-fig3"          the study, line by line
//! # base: [indenter]                     the base scenario, line by line
//! # shard: 3/16                          only in a part of a study
//! motion.normal.mean,wear_volume_m3,status
//! 5e-7,1.2e-18,ok
//! ```
//!
//! While the study runs, rows are in the order in which they finish; a row belongs to the point
//! whose values it begins with. A last line without its end was cut short and does not count.

use std::collections::HashMap;
use std::fmt::Write;

use super::{OK, Row, Shard, Study, StudyError};
use crate::scenario::printable;

/// Returns the lines above the rows: the header and the names of the columns.
pub fn head(study: &Study, shard: Shard) -> String {
    let mut text = lines(study);
    if shard != Shard::WHOLE {
        let _ = writeln!(text, "# shard: {shard}");
    }
    text.push_str(&line(study.columns()));
    text
}

/// The header without the shard: equal for equal studies on equal bases.
fn lines(study: &Study) -> String {
    let mut text = format!("# mdr-tui: {}\n", env!("CARGO_PKG_VERSION"));
    let mut push = |key: &str, toml: &str| {
        for line in toml.lines().filter(|line| !line.trim().is_empty()) {
            let _ = writeln!(text, "# {key}: {}", printable(line));
        }
    };
    push("study", &study.to_toml());
    push("base", &study.base.to_toml());
    text
}

/// Returns one line of a CSV file, with its end.
pub fn line<T: AsRef<[u8]>>(fields: impl IntoIterator<Item = T>) -> String {
    let mut writer = csv::WriterBuilder::new()
        .comment(Some(b'#'))
        .from_writer(Vec::new());
    // Memory does not fail to be written.
    let _ = writer.write_record(fields);
    let bytes = writer.into_inner().unwrap_or_default();
    String::from_utf8(bytes).unwrap_or_default()
}

/// Returns the fields of a point's row.
pub fn fields(study: &Study, point: usize, row: Row) -> Vec<String> {
    let mut fields = study.values(point);
    fields.extend(row.fields);
    fields.push(row.status);
    fields
}

/// Returns a row as one JSON object: numbers as numbers, empty fields as null.
pub fn json<'a>(columns: &[&str], fields: impl IntoIterator<Item = &'a String>) -> String {
    let value = |field: &String| match field.parse::<f64>() {
        _ if field.is_empty() => serde_json::Value::Null,
        Ok(number) if number.is_finite() => number.into(),
        _ => field.clone().into(),
    };
    let mut text = String::from("{");
    for (at, (name, field)) in columns.iter().zip(fields).enumerate() {
        let comma = if at > 0 { "," } else { "" };
        let name = serde_json::Value::from(*name);
        let _ = write!(text, "{comma}{name}:{}", value(field));
    }
    text.push('}');
    text
}

/// A table that was read back.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// What messages call it.
    name: String,
    /// The header without the shard.
    header: String,
    /// The part of the study that it holds.
    pub shard: Shard,
    /// The names of the columns.
    pub columns: Vec<String>,
    /// The rows, as they stand.
    pub rows: Vec<Vec<String>>,
}

impl Record {
    /// Reads a table that messages call `name`.
    ///
    /// # Errors
    ///
    /// Refuses what is no table of a study.
    pub fn parse(text: &str, name: &str) -> Result<Self, StudyError> {
        let name = printable(name);
        let refuse = |why: &str| StudyError(format!("{name}: {why}"));
        let whole = text.rfind('\n').map_or("", |end| &text[..=end]);
        let (mut header, mut shard) = (String::new(), Shard::WHOLE);
        let mut body = whole;
        while body.starts_with('#') {
            let (line, rest) = body.split_once('\n').unwrap_or((body, ""));
            match line.strip_prefix("# shard: ") {
                Some(given) => shard = given.parse().map_err(|why: String| refuse(&why))?,
                None => {
                    header.push_str(line);
                    header.push('\n');
                }
            }
            body = rest;
        }
        if !header.contains("# study: ") {
            return Err(refuse(
                "is not a table of mdr-tui sweep: its header has no study",
            ));
        }
        let reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .comment(Some(b'#'))
            .from_reader(body.as_bytes());
        let mut rows = Vec::new();
        for row in reader.into_records() {
            let row = row.map_err(|error| refuse(&printable(&error.to_string())))?;
            rows.push(row.iter().map(str::to_owned).collect::<Vec<_>>());
        }
        let mut rows = rows.into_iter();
        let columns = rows.next().unwrap_or_default();
        Ok(Self {
            header,
            shard,
            columns,
            rows: rows.collect(),
            name,
        })
    }

    /// The study that the header holds.
    ///
    /// # Errors
    ///
    /// Refuses a header that was changed by hand to something that is no study.
    pub fn study(&self) -> Result<Study, StudyError> {
        let part = |key: &str| -> String {
            let prefix = format!("# {key}: ");
            let lines = self
                .header
                .lines()
                .filter_map(|line| line.strip_prefix(&prefix));
            lines.fold(String::new(), |text, line| text + line + "\n")
        };
        Study::read_with_base(&part("study"), &self.name, &part("base"))
    }

    /// Refuses a table of another study, or one made by another version.
    ///
    /// # Errors
    ///
    /// Names the first line of the headers that differs.
    pub fn expect(&self, study: &Study, told: &str) -> Result<(), StudyError> {
        let expected = lines(study);
        if self.header == expected {
            return Ok(());
        }
        let (mut ours, mut theirs) = (expected.lines(), self.header.lines());
        loop {
            let (our, their) = (ours.next(), theirs.next());
            if our != their || our.is_none() {
                let (our, their) = (our.unwrap_or("nothing"), their.unwrap_or("nothing"));
                return Err(StudyError(format!(
                    "{}: holds another study: {} where {told} has {}",
                    self.name,
                    their.trim_start_matches("# "),
                    our.trim_start_matches("# ")
                )));
            }
        }
    }

    /// The header, for the comparison of records with each other.
    pub fn header(&self) -> &str {
        &self.header
    }
}

/// Rows of a study, each at its point.
#[derive(Debug, Clone, PartialEq)]
pub struct Rows {
    /// Points by the values of their axes, and how many of them have taken their rows. Points with
    /// equal values have equal rows, so which of them takes which row does not matter.
    points: HashMap<Vec<String>, (Vec<usize>, usize)>,
    axes: usize,
    columns: usize,
    /// The fields of each point, none while it has no row.
    pub rows: Vec<Option<Vec<String>>>,
}

/// Why a row cannot be taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refused {
    /// It has another number of fields.
    Length,
    /// No point has these values.
    Foreign,
    /// All points of these values have their rows, equal to this one.
    Double,
    /// All points of these values have their rows, and they differ from this one.
    Contradiction,
}

impl Rows {
    /// No rows yet.
    pub fn new(study: &Study) -> Self {
        let points = study.points();
        let mut by_values: HashMap<Vec<String>, (Vec<usize>, usize)> = HashMap::new();
        for point in 0..points {
            by_values
                .entry(study.values(point))
                .or_default()
                .0
                .push(point);
        }
        Self {
            points: by_values,
            axes: study.axes.len(),
            columns: study.columns().len(),
            rows: vec![None; points],
        }
    }

    /// Takes a row to the point that it belongs to, which is returned.
    ///
    /// # Errors
    ///
    /// Leaves a row that no point waits for.
    pub fn take(&mut self, fields: Vec<String>) -> Result<usize, Refused> {
        if fields.len() != self.columns {
            return Err(Refused::Length);
        }
        let values = &fields[..self.axes];
        let (points, taken) = self.points.get_mut(values).ok_or(Refused::Foreign)?;
        let Some(&point) = points.get(*taken) else {
            let alike = points
                .iter()
                .any(|&point| self.rows[point].as_ref() == Some(&fields));
            return Err(if alike {
                Refused::Double
            } else {
                Refused::Contradiction
            });
        };
        *taken += 1;
        self.rows[point] = Some(fields);
        Ok(point)
    }

    /// Puts the row of a point that was just run.
    pub fn put(&mut self, point: usize, fields: Vec<String>) {
        self.rows[point] = Some(fields);
    }

    /// Forgets the rows of points that failed, so that they are run again.
    pub fn forget_failed(&mut self) {
        for row in &mut self.rows {
            if row.as_ref().is_some_and(|row| !is_ok(row)) {
                *row = None;
            }
        }
    }

    /// The number of rows, and how many of them failed.
    pub fn count(&self) -> (usize, usize) {
        let rows = self.rows.iter().flatten();
        rows.fold((0, 0), |(all, failed), row| {
            (all + 1, failed + usize::from(!is_ok(row)))
        })
    }

    /// The whole file: what is there, in the order of the points.
    pub fn text(&self, head: &str) -> String {
        let mut text = head.to_owned();
        for row in self.rows.iter().flatten() {
            text.push_str(&line(row));
        }
        text
    }
}

fn is_ok(row: &[String]) -> bool {
    row.last().is_some_and(|status| status == OK)
}

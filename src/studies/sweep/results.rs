//! The results of a study, in memory: a row for each point that has been run.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use super::record::StudyFile;
use super::{Row, Shard, Status, Study};
use crate::math::number::exact;
use crate::reading::{Column, Regime};
use crate::scenario::Refusal;
use crate::scenario::escape::{self, csv_line};
use crate::scenario::scalars::{Value, cell};
use crate::studies::table::Object;

/// A study, and the rows of its points.
#[derive(Debug, Clone)]
pub struct Results {
    /// The study.
    pub study: Arc<Study>,
    rows: BTreeMap<usize, Row>,
}

/// Rows of points that had one already, each as its values and its file.
#[derive(Debug, Default)]
pub struct Doubles {
    /// The same rows again.
    pub same: Vec<String>,
    /// Other rows.
    pub differing: Vec<String>,
}

impl Results {
    /// Makes results without rows.
    pub fn new(study: impl Into<Arc<Study>>) -> Self {
        Self {
            study: study.into(),
            rows: BTreeMap::new(),
        }
    }

    /// Reads the rows of `records`, tables of the same study, whose points belong to a shard. A row goes to the first
    /// point with its values that has no row yet.
    ///
    /// # Errors
    ///
    /// If a row belongs to no point.
    pub fn read(
        study: impl Into<Arc<Study>>,
        shard: Shard,
        records: &[StudyFile],
    ) -> Result<(Self, Doubles), Refusal> {
        let (mut results, mut doubles) = (Self::new(study), Doubles::default());
        let study = Arc::clone(&results.study);
        let axes = study.axes.len();
        let mut points: HashMap<String, Vec<usize>> = HashMap::new();
        for point in shard.points(study.points()) {
            let values = key(&study.values(point));
            points.entry(values).or_default().push(point);
        }
        for record in records {
            for fields in record.rows(&study)? {
                let fields = fields?;
                let (name, values) = (&record.name, fields[..axes].join(", "));
                let rule = || format!("row {values} does not belong to the study");
                let alike = points.get(&key(&fields[..axes]));
                let alike = alike.ok_or_else(|| Refusal::new(name, rule()))?;
                let free = alike.iter().find(|&point| results.row(*point).is_none());
                let row = row(free.copied().unwrap_or(alike[0]), &fields[axes..]);
                if free.is_some() {
                    results.add(row);
                } else if results.row(row.point) == Some(&row) {
                    doubles.same.push(format!("{values} ({name})"));
                } else {
                    doubles.differing.push(format!("{values} ({name})"));
                }
            }
        }
        Ok((results, doubles))
    }

    /// Adds the row of a point, or replaces it.
    pub fn add(&mut self, row: Row) {
        self.rows.insert(row.point, row);
    }

    /// Keeps the rows with a result.
    pub fn drop_failed(&mut self) {
        self.rows.retain(|_, row| row.status.has_result());
    }

    /// Returns the row of a point.
    pub fn row(&self, point: usize) -> Option<&Row> {
        self.rows.get(&point)
    }

    /// Returns the rows in the order of the points.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = &Row> {
        self.rows.values()
    }

    /// Returns the number of rows with such a status.
    pub fn count(&self, is_such: impl Fn(&Status) -> bool) -> usize {
        self.rows().filter(|row| is_such(&row.status)).count()
    }

    /// Returns the number of points without a result.
    pub fn failed(&self) -> usize {
        self.count(|status| !status.has_result())
    }

    /// Returns the points of a shard without a row, in order.
    pub fn missing(&self, shard: Shard) -> Vec<usize> {
        let points = shard.points(self.study.points());
        points.filter(|&point| self.row(point).is_none()).collect()
    }

    /// Returns the value of `column` at a point; `None` without a row or a value, or where the point failed.
    pub fn value(&self, point: usize, column: Column) -> Option<&Value> {
        let row = self.row(point).filter(|row| row.status.has_result())?;
        let mut columns = self.study.columns.iter();
        let at = columns.position(|known| *known == column)?;
        row.values.get(at).filter(|value| !value.is_null())
    }

    /// Returns the number in `column` at a point.
    pub fn number(&self, point: usize, column: Column) -> Option<f64> {
        self.value(point, column)?.as_f64()
    }

    /// Returns the regime of a point.
    pub fn regime(&self, point: usize) -> Option<Regime> {
        self.value(point, Column::Regime)?.as_str()?.parse().ok()
    }

    /// Returns a row as a line of a CSV file: the values of the axes, the columns, the status.
    pub fn line(&self, row: &Row) -> String {
        let axes = self.study.values(row.point).into_iter();
        let values = row.values.iter().map(cell);
        csv_line(axes.chain(values).chain([row.status.to_string()]))
    }

    /// Returns a row as one JSON object: numbers as numbers, missing values as null.
    pub fn json(&self, row: &Row) -> String {
        let axes = self.study.values(row.point);
        let axes = axes.iter().map(|field| read_value(field));
        let values = axes.chain(row.values.iter().cloned());
        let values = values.chain([row.status.to_string().into()]);
        let values: Vec<Value> = values.collect();
        escape::json(&Object(&self.study.columns(), &values), false).unwrap_or_default()
    }
}

/// Makes the row of a point from the fields behind its axes.
fn row(point: usize, fields: &[String]) -> Row {
    let (status, values) = fields
        .split_last()
        .map_or(("", fields), |(last, values)| (last, values));
    Row {
        point,
        values: values.iter().map(|field| read_value(field)).collect(),
        status: Status::from(status),
    }
}

/// Reads a field: a number, a word, or null if it is empty.
fn read_value(field: &str) -> Value {
    match field.parse::<f64>() {
        _ if field.is_empty() => Value::Null,
        Ok(number) if number.is_finite() => number.into(),
        _ => field.into(),
    }
}

/// Joins the values of the axes of a row into one text, with numbers in one form however they are written.
fn key(values: &[String]) -> String {
    let normal = |value: &String| value.parse().map_or_else(|_| value.clone(), exact);
    let values: Vec<String> = values.iter().map(normal).collect();
    values.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studies::sweep::record;

    /// Studies with equal, rounded, listed and sampled values.
    const STUDIES: [&str; 4] = [
        "[[axis]]\nkey = \"motion.normal.mean\"\nlinspace = [1e-6, -2e-6, 7]\n\
         [[axis]]\nkey = \"numerics.points\"\nlogspace = [3, 9, 40]\n",
        "[[axis]]\nkey = \"motion.normal.mean\"\nvalues = [1e-6, 2e-6, 1e-6]\n\
         [[axis]]\nkey = \"title\"\nvalues = [\"=a\", \"b,\", \"#c\"]\n",
        "design = \"zip\"\n[[axis]]\nkey = \"motion.normal.mean\"\nlogspace = [1e-6, 3e-6, 50]\n\
         [[axis]]\nkey = \"numerics.points\"\nlinspace = [100, 110, 50]\n",
        "design = \"sobol\"\nsamples = 60\n\
         [[axis]]\nkey = \"motion.normal.mean\"\nlogspace = [1e-6, 3e-6]\n\
         [[axis]]\nkey = \"numerics.points\"\nlinspace = [10, 20]\n",
    ];

    #[test]
    fn rows_in_any_order_go_back_to_their_points() {
        for axes in STUDIES {
            let text = format!("base = \"hertz\"\ncolumns = [\"F_z_N\", \"regime\"]\n{axes}");
            let study = Study::read(&text, "it", "".as_ref()).expect("a study");
            let mut results = Results::new(study);
            let study = Arc::clone(&results.study);
            for point in 0..study.points() {
                // Points with equal values have equal rows.
                let first = (0..=point).find(|&k| study.values(k) == study.values(point));
                let values = vec![(0.1 * first.unwrap_or(0) as f64).into(), "partial".into()];
                let status = Status::Ok;
                results.add(Row {
                    point,
                    values,
                    status,
                });
            }
            let head = record::head(&study, Shard::WHOLE, &record::Arithmetic::new());
            let lines: Vec<String> = results.rows().map(|row| results.line(row)).collect();
            let backwards: String = lines.iter().rev().map(String::as_str).collect();
            let torn = head + &backwards + "1e-6,";
            let read = |text: &str| {
                let record = StudyFile::read(text.as_bytes(), "it").expect("a table");
                let study = record.study().expect("its study");
                Results::read(study, Shard::WHOLE, &[record])
            };
            let (again, doubles) = read(&torn).expect("its rows");
            assert!(doubles.same.is_empty() && doubles.differing.is_empty());
            assert_eq!(again.rows, results.rows, "{axes}");
            let (spelt, _) = read(&torn.replace("e-6,", "E-06,")).expect("its rows");
            assert_eq!(spelt.rows, results.rows, "{axes}");
            let foreign = torn
                .replacen("\n1", "\n7", 1)
                .replacen("\n-2", "\n7", 1)
                .replacen("\n3", "\n7", 1);
            assert!(foreign != torn && read(&foreign).is_err(), "{axes}");
        }
    }
}

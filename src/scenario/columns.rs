//! Columns of numbers from a measured CSV file, or from one written by this program.
//!
//! Lines that begin with `#` are comments; the first other line names the columns, whose last part
//! is the unit: `r_m` and `r_mm` are both radii, and come out in m. Other columns may hold
//! anything, so that a `state.csv` can serve as a scar and a `history.csv` as a history.

use std::path::Path;

use super::error::{Refusal, ScenarioError, echo, printable};
use super::limited::{self, Unread};
use super::units;

/// The largest file that is read, in bytes.
const LARGEST: u64 = 64 << 20;

/// The units that all columns of a file are converted to.
const OWN: [&str; 6] = ["m", "m3", "N", "s", "J", "Pa"];

/// A file of columns, read whole.
#[derive(Debug, Clone)]
pub struct Columns {
    path: String,
    /// The lines `# key: value`.
    header: Vec<(String, String)>,
    names: Vec<String>,
    /// The line of each row, counted from 1, and its fields.
    rows: Vec<(u64, csv::StringRecord)>,
}

impl Columns {
    /// Reads the file at `path`.
    ///
    /// # Errors
    /// A file that cannot be read, is no table, or has rows of different lengths.
    pub fn read(path: &Path) -> Result<Self, ScenarioError> {
        let name = printable(&path.display().to_string());
        let text = limited::regular_text(path, LARGEST).map_err(|why| {
            let hint = match why {
                Unread::Directory | Unread::Irregular => "; must be a CSV file",
                _ => "",
            };
            unreadable(&name, format!("{why}{hint}"))
        })?;
        Self::parse(&text, &name)
    }

    /// The columns of a text that messages call `path`.
    ///
    /// # Errors
    /// As for [`read`](Self::read).
    pub fn parse(text: &str, path: &str) -> Result<Self, ScenarioError> {
        let head = text.lines().find(|line| {
            let line = line.trim();
            !line.is_empty() && !line.starts_with('#')
        });
        let head = head.unwrap_or_default();
        let delimiter = [b',', b';', b'\t']
            .into_iter()
            .find(|&mark| head.as_bytes().contains(&mark));
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .delimiter(delimiter.unwrap_or(b','))
            .from_reader(text.as_bytes());
        let has_semicolons = text
            .lines()
            .any(|line| !line.starts_with('#') && line.contains(';'));
        let refuse = |error: csv::Error| {
            let mut reason = problem(&error);
            if has_semicolons && delimiter != Some(b';') {
                reason.push_str(
                    "; the file has semicolons, but its first line names columns without them",
                );
            }
            unreadable(path, reason)
        };
        let names: Vec<String> = reader
            .headers()
            .map_err(refuse)?
            .iter()
            .map(|name| name.trim_start_matches('\u{feff}').to_owned())
            .collect();
        if names.iter().any(|name| name.parse::<f64>().is_ok()) {
            let reason = "the first line must name the columns, as in r_m,f_m";
            return Err(unreadable(path, reason.into()));
        }
        let mut rows = Vec::new();
        for row in reader.records() {
            let row = row.map_err(refuse)?;
            let line = row.position().map_or(0, csv::Position::line);
            rows.push((line, row));
        }
        let said = text
            .lines()
            .filter_map(|line| line.strip_prefix('#')?.split_once(':'));
        let said = said.map(|(key, value)| (key.trim().to_owned(), value.trim().to_owned()));
        Ok(Self {
            path: path.to_owned(),
            header: said.collect(),
            names,
            rows,
        })
    }

    /// The file's name, fit for a line.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// The lines `# key: value` above the names, which this program's own files have.
    pub fn header(&self) -> &[(String, String)] {
        &self.header
    }

    /// The cycle that the header states.
    pub fn stated_cycle(&self) -> Option<f64> {
        let (_, cycle) = self.header.iter().find(|(key, _)| key == "cycle")?;
        cycle.parse().ok()
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.rows.len()
    }

    /// The line of the file that holds `row`, counted from 1.
    pub fn line(&self, row: usize) -> u64 {
        self.rows.get(row).map_or(0, |(line, _)| *line)
    }

    /// Whether there is a column of this name, with any unit.
    pub fn has(&self, name: &str, unit: &str) -> bool {
        self.find(name, unit).is_some()
    }

    /// The numbers of the column `name` in SI units, one per row.
    ///
    /// # Errors
    /// If the column is missing, or one of its fields is empty or not a finite number.
    pub fn column(&self, name: &str, unit: &str) -> Result<Vec<f64>, ScenarioError> {
        let Some((at, size)) = self.find(name, unit) else {
            let ending = if unit.is_empty() { "" } else { "_" };
            return Err(self.refuse(format!(
                "has no column {name}{ending}{unit}; the first line names {}",
                self.named()
            )));
        };
        self.rows
            .iter()
            .map(|(line, row)| {
                let field = row.get(at).unwrap_or_default();
                let refuse = |what: &str| {
                    let column = &self.names[at];
                    Err(self.refuse(format!("line {line}: {column} {what}")))
                };
                match field.parse::<f64>() {
                    Ok(value) if value.is_finite() => Ok(size * value),
                    _ if field.is_empty() => refuse("is empty; fill in or remove the row"),
                    _ if field.contains(',') => refuse(&format!(
                        "= {}: must be a finite number, with a decimal point",
                        echo(field)
                    )),
                    _ => refuse(&format!("= {}: must be a finite number", echo(field))),
                }
            })
            .collect()
    }

    /// The column `name` as [`column`](Self::column) gives it, but NaN where a field is empty or no finite
    /// number, as in this program's own files; none if there is no such column.
    pub fn column_with_gaps(&self, name: &str, unit: &str) -> Option<Vec<f64>> {
        let (at, size) = self.find(name, unit)?;
        Some(self.values(at, size))
    }

    fn values(&self, at: usize, size: f64) -> Vec<f64> {
        let value = |field: &str| field.parse::<f64>().ok().filter(|value| value.is_finite());
        let values = self.rows.iter().map(|(_, row)| {
            let value = row.get(at).and_then(value);
            value.map_or(f64::NAN, |value| size * value)
        });
        values.collect()
    }

    /// All columns, in SI units and by the names that this program's own files have; NaN where a field is no finite
    /// number.
    pub fn all(&self) -> Vec<(String, Vec<f64>)> {
        let column = |(at, name): (usize, &String)| {
            let in_si = name.rsplit_once('_').and_then(|(base, unit)| {
                let of = |own: &&str| Some((format!("{base}_{own}"), units::ratio(unit, own)?));
                OWN.iter().find_map(of)
            });
            let (name, size) = in_si.unwrap_or((name.clone(), 1.0));
            (name, self.values(at, size))
        };
        self.names.iter().enumerate().map(column).collect()
    }

    /// The names of the columns, as they are in the file.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The fields of a row, as they are in the file.
    pub fn fields(&self, row: usize) -> Vec<String> {
        let fields = self.rows.get(row).map(|(_, row)| row.iter());
        fields.into_iter().flatten().map(str::to_owned).collect()
    }

    /// The names of the columns, fit for a line.
    pub fn named(&self) -> String {
        echo(&self.names.join(", "))
    }

    /// The error that the file has for `reason`.
    pub fn refuse(&self, reason: impl Into<String>) -> ScenarioError {
        unreadable(&self.path, reason.into())
    }

    fn find(&self, name: &str, unit: &str) -> Option<(usize, f64)> {
        let size = |column: &str| match (column.strip_prefix(name)?, unit) {
            ("", "") => Some(1.0),
            (ending, own) => units::ratio(ending.strip_prefix('_')?, own),
        };
        let mut columns = self.names.iter().enumerate();
        columns.find_map(|(at, column)| Some((at, size(column)?)))
    }
}

fn unreadable(path: &str, reason: String) -> ScenarioError {
    Refusal::new(path, reason).into()
}

/// The reader's error in words.
fn problem(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::UnequalLengths {
            pos,
            expected_len,
            len,
        } => {
            let line = pos.as_ref().map_or(0, csv::Position::line);
            format!("line {line}: has {len} fields; must have {expected_len}, one per column")
        }
        _ => printable(&error.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> Columns {
        Columns::parse(text, "scar.csv").expect("columns")
    }

    #[test]
    fn units_in_the_names_lead_to_si() {
        for (text, expected) in [
            ("# by hand\nr_m,f_m\n0,0\n1e-3,2e-6\n", [1e-3, 2e-6]),
            ("r_mm,f_um\n0,0\n1,2\n", [1e-3, 2e-6]),
            ("f_nm; r_um\n0; 0\n2000; 1000\n", [1e-3, 2e-6]),
            (
                "\u{feff}r_mm\tother\tf_mm\n0\tx\t0\n1\t\t2e-3\n",
                [1e-3, 2e-6],
            ),
        ] {
            let columns = parsed(text);
            assert_eq!(columns.rows(), 2);
            for (name, value) in ["r", "f"].into_iter().zip(expected) {
                let column = columns.column(name, "m").expect("a column");
                assert!((column[1] / value - 1.0).abs() < 1e-14, "{text}");
            }
        }
    }

    #[test]
    fn gaps_and_words_are_told_with_their_line() {
        let message = |text: &str| {
            let columns = Columns::parse(text, "scar.csv");
            let column = columns.and_then(|columns| columns.column("f", "m"));
            column.expect_err("a refusal").to_string()
        };
        assert_eq!(
            message("r_m,f_m\n0,0\n1,\n"),
            "scar.csv: line 3: f_m is empty; fill in or remove the row"
        );
        assert_eq!(
            message("# x\nr_m,f_m\n0,nan\n"),
            "scar.csv: line 3: f_m = nan: must be a finite number"
        );
        assert_eq!(
            message("r_m,f_m\n0,\"0,5\"\n"),
            "scar.csv: line 2: f_m = 0,5: must be a finite number, with a decimal point"
        );
        assert_eq!(
            message("r_m,f_m\n0,0\n1\n"),
            "scar.csv: line 3: has 1 fields; must have 2, one per column"
        );
        assert_eq!(
            message("r_m,f_m\n0;0\n"),
            "scar.csv: line 2: has 1 fields; must have 2, one per column; the file has semicolons, but its first \
             line names columns without them"
        );
        assert_eq!(
            message("r_m,z_m\n0,0\n"),
            "scar.csv: has no column f_m; the first line names r_m, z_m"
        );
        assert!(message("0,0\n1,1\n").contains("the first line must name the columns"));
        assert!(message("").contains("has no column f_m"));
    }

    #[test]
    fn what_is_no_file_is_refused() {
        for path in ["/", "/nowhere/at-all.csv", "/dev/zero"] {
            assert!(Columns::read(Path::new(path)).is_err(), "{path}");
        }
    }
}

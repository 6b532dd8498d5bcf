//! Columns of numbers from a measured CSV file, or from one written by this program.
//!
//! Lines that begin with `#` are comments; the first other line names the columns, whose last part
//! is the unit: `r_m` and `r_mm` are both radii, and come out in m. Other columns may hold
//! anything, so that a `state.csv` can serve as a scar and a `history.csv` as a history.

use std::path::Path;

use super::error::{ScenarioError, echo, printable};
use super::limited::{self, Unread};

/// The largest file that is read, in bytes.
const LARGEST: u64 = 64 << 20;

/// What a column holds, and so which units it may name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// m.
    Length,
    /// m³.
    Volume,
    /// N.
    Force,
    /// s.
    Time,
    /// J.
    Energy,
    /// Pa.
    Stress,
    /// A pure number, whose column has no unit.
    Number,
}

impl Quantity {
    const ALL: [Self; 7] = [
        Self::Length,
        Self::Volume,
        Self::Force,
        Self::Time,
        Self::Energy,
        Self::Stress,
        Self::Number,
    ];

    /// The units in column names, each with its size in SI; the first is that of this program's files.
    fn units(self) -> &'static [(&'static str, f64)] {
        match self {
            Self::Length => &[("_m", 1.0), ("_mm", 1e-3), ("_um", 1e-6), ("_nm", 1e-9)],
            Self::Volume => &[("_m3", 1.0), ("_mm3", 1e-9), ("_um3", 1e-18)],
            Self::Force => &[("_N", 1.0), ("_mN", 1e-3), ("_kN", 1e3)],
            Self::Time => &[("_s", 1.0), ("_ms", 1e-3)],
            Self::Energy => &[("_J", 1.0), ("_mJ", 1e-3), ("_kJ", 1e3)],
            Self::Stress => &[("_Pa", 1.0), ("_MPa", 1e6), ("_GPa", 1e9)],
            Self::Number => &[("", 1.0)],
        }
    }
}

/// A file of columns, read whole.
#[derive(Debug, Clone)]
pub struct Columns {
    path: String,
    /// What a line `# cycle: ` says.
    cycle: Option<f64>,
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
        let stated = text.lines().find_map(|line| line.strip_prefix("# cycle:"));
        Ok(Self {
            path: path.to_owned(),
            cycle: stated.and_then(|cycle| cycle.trim().parse().ok()),
            names,
            rows,
        })
    }

    /// The file's name, fit for a line.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// The cycle that the header states, as this program's own files do.
    pub fn stated_cycle(&self) -> Option<f64> {
        self.cycle
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
    pub fn has(&self, name: &str, quantity: Quantity) -> bool {
        self.find(name, quantity).is_some()
    }

    /// The numbers of the column `name` in SI units, one per row.
    ///
    /// # Errors
    /// If the column is missing, or one of its fields is empty or not a finite number.
    pub fn column(&self, name: &str, quantity: Quantity) -> Result<Vec<f64>, ScenarioError> {
        let Some((at, size)) = self.find(name, quantity) else {
            let unit = quantity.units()[0].0;
            return Err(self.refuse(format!(
                "has no column {name}{unit}; the first line names {}",
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
    pub fn column_with_gaps(&self, name: &str, quantity: Quantity) -> Option<Vec<f64>> {
        let (at, size) = self.find(name, quantity)?;
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
        let columns = self.names.iter().enumerate();
        let column = |(at, name): (usize, &String)| {
            let quantities = Quantity::ALL.iter().flat_map(|quantity| {
                let own = quantity.units()[0].0;
                quantity
                    .units()
                    .iter()
                    .map(move |(unit, size)| (own, *unit, *size))
            });
            // "_mm" ends in no "_m", but every name ends in "".
            let unit = quantities.filter(|(_, unit, _)| name.ends_with(unit));
            let longest = unit.max_by_key(|(_, unit, _)| unit.len());
            let (own, unit, size) = longest.unwrap_or(("", "", 1.0));
            let base = &name[..name.len() - unit.len()];
            (format!("{base}{own}"), self.values(at, size))
        };
        columns.map(column).collect()
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

    fn find(&self, name: &str, quantity: Quantity) -> Option<(usize, f64)> {
        quantity.units().iter().find_map(|(unit, size)| {
            let wanted = format!("{name}{unit}");
            let at = self.names.iter().position(|known| *known == wanted)?;
            Some((at, *size))
        })
    }
}

fn unreadable(path: &str, reason: String) -> ScenarioError {
    ScenarioError::Unreadable {
        origin: path.to_owned(),
        reason,
    }
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
                let column = columns.column(name, Quantity::Length).expect("a column");
                assert!((column[1] / value - 1.0).abs() < 1e-14, "{text}");
            }
        }
    }

    #[test]
    fn gaps_and_words_are_told_with_their_line() {
        let message = |text: &str| {
            let columns = Columns::parse(text, "scar.csv");
            let column = columns.and_then(|columns| columns.column("f", Quantity::Length));
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

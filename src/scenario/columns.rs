//! Columns of numbers from a measured CSV file, or from one written by this program.
//!
//! Lines that begin with `#` are comments; the first other line names the columns, whose last part
//! is the unit: `r_m` and `r_mm` are both radii, and come out in m. Other columns may hold
//! anything, so that a `state.csv` can serve as a scar and a `history.csv` as a history.

use std::fmt::Display;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use super::bounded_read::{self, Unread};
use super::error::Refusal;
use super::escape::{echo, printable};
use super::units;

/// The largest file that is read, in bytes.
const LARGEST: u64 = 64 << 20;

/// The largest header that is read without its rows, in bytes.
const LARGEST_HEADER: u64 = 64 << 10;

/// The units of this program's own columns, which those of a file are converted to, as they end a column's name, and as
/// they are written.
pub const OWN: [(&str, &str); 7] = [
    ("m3_per_J", "m³/J"),
    ("m3", "m³"),
    ("m", "m"),
    ("N", "N"),
    ("J", "J"),
    ("Pa", "Pa"),
    ("s", "s"),
];

/// A file of columns, read whole.
#[derive(Debug, Clone)]
pub struct Columns {
    /// The file's name, fit for a line.
    pub path: String,
    /// The lines `# key: value`, which this program's own files have.
    pub header: Vec<(String, String)>,
    /// The names of the columns, as they are in the file.
    pub names: Vec<String>,
    /// The same in units of [`OWN`], and what one of the file's units is worth in those.
    own: Vec<(String, f64)>,
    /// The line of each row, counted from 1, and its fields.
    rows: Vec<(u64, csv::StringRecord)>,
}

impl Columns {
    /// Reads the file at `path`.
    ///
    /// # Errors
    /// A file that cannot be read, is no table, or has rows of different lengths.
    pub fn read(path: &Path) -> Result<Self, Refusal> {
        let name = printable(&path.display().to_string());
        let text = bounded_read::text(path, LARGEST).map_err(|why| {
            let refusal = Refusal::unread(&name, &why);
            match why {
                Unread::Directory | Unread::Irregular => refusal.or("must be a CSV file"),
                _ => refusal,
            }
        })?;
        Self::parse(&text, &name)
    }

    /// The columns of a text that messages call `path`.
    ///
    /// # Errors
    /// As for [`read`](Self::read).
    pub fn parse(text: &str, path: &str) -> Result<Self, Refusal> {
        let is_row = |line: &&str| !line.trim().is_empty() && !line.trim().starts_with('#');
        let head = text.lines().find(is_row).unwrap_or_default();
        let mut delimiters = [b',', b';', b'\t'].into_iter();
        let delimiter = delimiters.find(|&mark| head.as_bytes().contains(&mark));
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .delimiter(delimiter.unwrap_or(b','))
            .from_reader(text.as_bytes());
        let hint = match text.lines().filter(is_row).any(|line| line.contains(';')) {
            true if delimiter != Some(b';') => {
                "; the file has semicolons, but its first line names columns without them"
            }
            _ => "",
        };
        let refuse = |error| Refusal::new(path, format!("{}{hint}", problem(&error)));
        let names = reader.headers().map_err(refuse)?.iter();
        let names = names.map(|name| name.trim_start_matches('\u{feff}').to_owned());
        let names: Vec<String> = names.collect();
        if names.iter().any(|name| name.parse::<f64>().is_ok()) {
            let rule = "the first line must name the columns, as in r_m,f_m";
            return Err(Refusal::new(path, rule));
        }
        let rows = reader.records().map(|row| {
            let row = row.map_err(refuse)?;
            Ok((row.position().map_or(0, csv::Position::line), row))
        });
        let rows = rows.collect::<Result<_, Refusal>>()?;
        Ok(Self {
            path: path.to_owned(),
            header: text.lines().filter_map(said).collect(),
            own: names.iter().map(|name| in_own_unit(name)).collect(),
            names,
            rows,
        })
    }

    /// The lines `# key: value` at the top of the file at `path`, of which no more is read.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn header_of(path: &Path) -> Result<Vec<(String, String)>, Unread> {
        let file = bounded_read::open(path)?.take(LARGEST_HEADER);
        let lines = BufReader::new(file).lines();
        let header = lines.map_while(|line| line.ok().filter(|line| line.starts_with('#')));
        Ok(header.filter_map(|line| said(&line)).collect())
    }

    /// The line of the file that holds `row`, counted from 1.
    pub fn line(&self, row: usize) -> u64 {
        self.rows.get(row).map_or(0, |(line, _)| *line)
    }

    /// Whether there is a column of this name, as `r_m`, in any unit of its kind.
    pub fn has(&self, name: &str) -> bool {
        self.find(name).is_some()
    }

    /// The numbers of the column `name`, as `r_m`, in the unit of the name, one per row.
    ///
    /// # Errors
    /// If the column is missing, or one of its fields is empty or not a finite number.
    pub fn column(&self, name: &str) -> Result<Vec<f64>, Refusal> {
        let Some((at, size)) = self.find(name) else {
            let named = self.named();
            return Err(self.refuse(format!(
                "has no column {name}; the first line names {named}"
            )));
        };
        let number = |(line, row): &(u64, csv::StringRecord)| {
            let field = row.get(at).unwrap_or_default();
            let rule = match field.parse::<f64>() {
                Ok(value) if value.is_finite() => return Ok(size * value),
                _ if field.is_empty() => "is empty; fill in or remove the row".to_owned(),
                _ => {
                    let hint = match field.contains(',') {
                        true => ", with a decimal point",
                        false => "",
                    };
                    format!("= {}: must be a finite number{hint}", echo(field))
                }
            };
            Err(self.refuse(format!("line {line}: {} {rule}", self.names[at])))
        };
        self.rows.iter().map(number).collect()
    }

    /// All columns, in SI units and by the names that this program's own files have; NaN where a field is no finite
    /// number.
    pub fn all(&self) -> Vec<(String, Vec<f64>)> {
        let column = |(at, (name, size)): (usize, &(String, f64))| {
            let value = |row: &csv::StringRecord| row.get(at)?.parse::<f64>().ok();
            let values = self.rows.iter().map(|(_, row)| value(row));
            let finite = values.map(|value| value.filter(|value| value.is_finite()));
            let in_si = finite.map(|value| value.map_or(f64::NAN, |value| size * value));
            (name.clone(), in_si.collect())
        };
        self.own.iter().enumerate().map(column).collect()
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
    pub fn refuse(&self, reason: impl Display) -> Refusal {
        Refusal::new(&self.path, reason)
    }

    fn find(&self, name: &str) -> Option<(usize, f64)> {
        let at = self.own.iter().position(|(own, _)| own == name)?;
        Some((at, self.own[at].1))
    }
}

/// The name of a column in one of the units of [`OWN`], and what one of the unit in its name is worth in that.
fn in_own_unit(name: &str) -> (String, f64) {
    let found = name.rsplit_once('_').and_then(|(base, unit)| {
        let of = |(own, _): &(&str, _)| Some((format!("{base}_{own}"), units::ratio(unit, own)?));
        OWN.iter().find_map(of)
    });
    found.unwrap_or_else(|| (name.to_owned(), 1.0))
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

/// Key and value of a line `# key: value`. They reach screens, pictures and other files.
fn said(line: &str) -> Option<(String, String)> {
    let (key, value) = line.strip_prefix('#')?.split_once(':')?;
    Some((printable(key.trim()), printable(value.trim())))
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
            assert_eq!(columns.rows.len(), 2);
            for (name, value) in ["r", "f"].into_iter().zip(expected) {
                let column = columns.column(&format!("{name}_m")).expect("a column");
                assert!((column[1] / value - 1.0).abs() < 1e-14, "{text}");
            }
        }
    }

    #[test]
    fn gaps_and_words_are_told_with_their_line() {
        let message = |text: &str| {
            let columns = Columns::parse(text, "scar.csv");
            let column = columns.and_then(|columns| columns.column("f_m"));
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

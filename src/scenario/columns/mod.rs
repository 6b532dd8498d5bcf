//! Columns of numbers from a measured file, or from one written by this program.
//!
//! The table is found in the text, whatever the instrument has written around it: see [`layout`]. A name's last part is
//! its unit: `r_m` and `r [mm]` are both radii, and come out in m. Other columns may hold anything, so that a
//! `state.csv` can serve as a scar and a `history.csv` as a history.

use std::fmt::Display;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use super::bounded_read::{self, Unread};
use super::error::Refusal;
use super::escape::{echo, printable};
use super::units;
use layout::{Layout, NumberedLine, is_missing, number};

mod layout;
mod names;
mod naming;
mod text;

pub use layout::Separator;
pub use naming::{NamedField, Naming};

/// The largest file that is read, in bytes.
const LARGEST: u64 = 64 << 20;

/// The largest header that is read without its rows, in bytes.
const LARGEST_HEADER: u64 = 64 << 10;

/// A file of columns, read whole.
#[derive(Debug, Clone)]
pub struct Columns {
    /// The file's name, fit for a line.
    pub path: String,
    /// The lines `# key: value`, which this program's own files have.
    pub header: Vec<(String, String)>,
    /// The names of the columns, as they are in the file.
    pub names: Vec<String>,
    /// How the text is written: its encoding, its separators, its decimal mark.
    pub written: String,
    /// The same names in units of [`UNITS`](crate::reading::column::UNITS), and the value of one of the file's units in
    /// these.
    own: Vec<(String, f64)>,
    /// The line of each row, counted from 1, and its fields.
    rows: Vec<NumberedLine>,
    naming: Naming,
}

impl Columns {
    /// Reads the file at `path`.
    ///
    /// # Errors
    /// A file that cannot be read, is no table, or has rows of different lengths.
    pub fn read(path: &Path) -> Result<Self, Refusal> {
        Self::read_as(path, &Naming::default())
    }

    /// Reads the file at `path`, with what `naming` says of its columns.
    ///
    /// # Errors
    /// As for [`read`](Self::read), and a column that is not there.
    pub fn read_as(path: &Path, naming: &Naming) -> Result<Self, Refusal> {
        let name = printable(&path.display().to_string());
        let bytes = bounded_read::bytes(path, LARGEST).map_err(|why| {
            let refusal = Refusal::unread(&name, &why);
            match why {
                Unread::Directory | Unread::Irregular => refusal.or("must be a CSV file"),
                _ => refusal,
            }
        })?;
        let (text, encoding) = text::decode(&bytes)
            .ok_or_else(|| Refusal::new(&name, "is not a text; export the table as CSV"))?;
        let mut columns = Self::parse_as(&text, &name, naming)?;
        columns.written = format!("{encoding}, {}", columns.written);
        Ok(columns)
    }

    /// The columns of a text that messages call `path`.
    ///
    /// # Errors
    /// As for [`read`](Self::read).
    pub fn parse(text: &str, path: &str) -> Result<Self, Refusal> {
        Self::parse_as(text, path, &Naming::default())
    }

    fn parse_as(text: &str, path: &str, naming: &Naming) -> Result<Self, Refusal> {
        let text = text.trim_start_matches('\u{feff}');
        let refuse = |rule: String| Refusal::new(path, rule);
        let found = Layout::find(text).map_err(|error| refuse(printable(&error.to_string())))?;
        let fields = found.fields;
        let names = found.names.unwrap_or_default();
        let is_comma = if found.has_decimal_commas {
            ", decimal commas"
        } else {
            ""
        };
        let mut columns = Self {
            path: path.to_owned(),
            header: text.lines().filter_map(header_entry).collect(),
            written: format!("separated by {}{is_comma}", found.separator.name()),
            own: (0..fields)
                .map(|at| {
                    let unit = found.units.get(at).map_or("", String::as_str);
                    names::in_own_unit(names.get(at).map_or("", String::as_str), unit)
                })
                .collect(),
            names,
            rows: found.rows,
            naming: naming.clone(),
        };
        columns.rename(naming)?;
        if let (true, Some((line, _))) = (
            columns.names.is_empty() && naming.fields.is_empty(),
            columns.rows.first(),
        ) {
            // Twice as many fields as names: each number is cut in two.
            if found.separator == Separator::Comma && fields == 2 * found.fields_above {
                return Err(refuse(format!(
                    "line {line}: has {fields} fields, but the line before names {}; decimal commas need another \
                     separator, such as semicolons",
                    found.fields_above
                )));
            }
            return Err(refuse(format!(
                "line {line}: begins the numbers, and a line before must name the columns, as in r_m,f_m; or name them \
                 with {}",
                naming.example("r=1,wear=2", "um,nm")
            )));
        }
        if let Some((line, _)) = found.mixed {
            return Err(refuse(format!(
                "line {line}: a comma in a number, and points in others; export without separators of thousands"
            )));
        }
        if let Some((line, row)) = found.uneven {
            let hint = match (
                found.separator,
                found.has_decimal_commas || row.len() > fields,
            ) {
                (Separator::Comma, true) => {
                    "; decimal commas need another separator, such as semicolons"
                }
                _ => "",
            };
            let len = row.len();
            return Err(refuse(format!(
                "line {line}: has {len} fields; must have {fields}, one per column{hint}"
            )));
        }
        Ok(columns)
    }

    /// The lines `# key: value` at the top of the file at `path`, of which no more is read.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn header_of(path: &Path) -> Result<Vec<(String, String)>, Unread> {
        let file = bounded_read::open(path)?.take(LARGEST_HEADER);
        let lines = BufReader::new(file).lines();
        let header = lines.map_while(|line| line.ok().filter(|line| line.starts_with('#')));
        Ok(header.filter_map(|line| header_entry(&line)).collect())
    }

    /// The line of the file that holds `row`, counted from 1.
    pub fn line(&self, row: usize) -> u64 {
        self.rows.get(row).map_or(0, |(line, _)| *line)
    }

    /// The number of rows.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether it has no row.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Whether there is a column of this name, as `r_m`, in any unit of its kind.
    pub fn has(&self, name: impl AsRef<str>) -> bool {
        self.find(name.as_ref()).is_some()
    }

    /// The numbers of the column `name`, as `r_m`, in the unit of the name, one per row.
    ///
    /// # Errors
    /// If the column is missing, or one of its fields is no finite number.
    pub fn column(&self, name: &str) -> Result<Vec<f64>, Refusal> {
        let ([values], rows) = self.whole_rows([name])?;
        let missing = (0..self.len()).find(|row| rows.get(*row) != Some(row));
        missing.map_or(Ok(values), |row| {
            let rule = format!(
                "line {}: {name} is missing; fill in or remove the row",
                self.line(row)
            );
            Err(self.refuse(rule))
        })
    }

    /// The columns of these names in the rows that have a value in each, and the numbers of those rows.
    ///
    /// # Errors
    /// If a column is missing, or one of its fields is neither a number nor a word for a missing one.
    pub fn whole_rows<const N: usize>(
        &self,
        names: [impl AsRef<str>; N],
    ) -> Result<([Vec<f64>; N], Vec<usize>), Refusal> {
        let mut places = [(0, 1.0); N];
        for (place, name) in places.iter_mut().zip(names) {
            *place = self.place(name.as_ref())?;
        }
        let (mut columns, mut kept) = ([const { Vec::new() }; N], Vec::new());
        for (k, row) in self.rows.iter().enumerate() {
            let mut values = [None; N];
            for (value, (at, size)) in values.iter_mut().zip(places) {
                *value = self.number(row, at)?.map(|value| size * value);
            }
            if values.iter().all(Option::is_some) {
                kept.push(k);
                let whole = columns.iter_mut().zip(values.into_iter().flatten());
                whole.for_each(|(column, value)| column.push(value));
            }
        }
        Ok((columns, kept))
    }

    /// Says how many rows are not among those that were `kept`, if there are any.
    pub fn left_out(&self, kept: &[usize]) -> Option<String> {
        let (all, left_out) = (self.len(), self.len() - kept.len());
        (left_out > 0)
            .then(|| format!("{left_out} of {all} rows have missing values and are left out"))
    }

    /// The number in a field; `None` if it is missing.
    fn number(&self, (line, row): &NumberedLine, at: usize) -> Result<Option<f64>, Refusal> {
        let field = row.get(at).unwrap_or_default();
        match number(field) {
            None if !is_missing(field) => Err(self.refuse(format!(
                "line {line}: {} = {}: must be a finite number; NaN, Bad, - and empty fields count as missing",
                self.name(at), echo(field)
            ))),
            found => Ok(found),
        }
    }

    /// All columns, in SI units and by the names that this program's own files have; NaN where a field is no finite
    /// number.
    pub fn all(&self) -> Vec<(String, Vec<f64>)> {
        let column = |(at, (name, size)): (usize, &(String, f64))| {
            let value = |row: &NumberedLine| {
                row.1
                    .get(at)
                    .and_then(number)
                    .map_or(f64::NAN, |value| size * value)
            };
            (name.clone(), self.rows.iter().map(value).collect())
        };
        self.own.iter().enumerate().map(column).collect()
    }

    /// Each column as in the file, its name in one of the [`UNITS`](crate::reading::column::UNITS), and the factor to
    /// that unit.
    pub fn described(&self) -> impl Iterator<Item = (&str, &str, f64)> {
        let own = self.own.iter().enumerate();
        own.map(|(at, (own, size))| {
            (
                self.names.get(at).map_or("", String::as_str),
                own.as_str(),
                *size,
            )
        })
    }

    /// The fields of the column `name`, as they are in the file; empty where there is none.
    pub fn words<'a>(&'a self, name: &str) -> impl Iterator<Item = &'a str> {
        let at = self.own.iter().position(|(own, _)| own == name);
        let word = move |(_, row): &'a NumberedLine| row.get(at?);
        self.rows
            .iter()
            .map(move |row| word(row).unwrap_or_default())
    }

    /// The names of the columns, fit for a line.
    pub fn list_names(&self) -> String {
        echo(&self.names.join(", "))
    }

    /// The error that the file has for `reason`.
    pub fn refuse(&self, reason: impl Display) -> Refusal {
        Refusal::new(&self.path, reason)
    }

    /// What messages call a column.
    fn name(&self, at: usize) -> &str {
        self.names.get(at).map_or(&self.own[at].0, |name| name)
    }

    fn place(&self, name: &str) -> Result<(usize, f64), Refusal> {
        self.find(name).ok_or_else(|| {
            let (base, unit) = name.rsplit_once('_').unwrap_or((name, ""));
            let is_base = |base: String| self.own.iter().position(|(own, _)| own.eq_ignore_ascii_case(&base));
            let mut bases = names::names_of(name).map(|name| name.strip_suffix(&format!("_{unit}")).unwrap_or(&name).to_owned());
            let hint = match bases.find_map(is_base) {
                Some(at) if !unit.is_empty() => {
                    let example = if unit == "m" { "um" } else { unit };
                    let units = self.naming.example("", "um,nm");
                    format!("{} has no unit; name it as in {base}_{example}, or give {units}, one per column", self.name(at))
                }
                _ => format!("the first line names {}; {} says which it is", self.list_names(), self.naming.example(&format!("{base}=1"), "")),
            };
            self.refuse(format!("has no column {name}; {hint}"))
        })
    }

    fn find(&self, name: &str) -> Option<(usize, f64)> {
        let exact = self.own.iter().position(|(own, _)| own == name);
        let alike = |name: String| {
            self.own
                .iter()
                .position(|(own, _)| own.eq_ignore_ascii_case(&name))
        };
        let at = exact.or_else(|| names::names_of(name).find_map(alike))?;
        Some((at, self.own[at].1))
    }
}

/// Key and value of a line `# key: value`. They reach screens, pictures and other files.
fn header_entry(line: &str) -> Option<(String, String)> {
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
    fn gaps_and_words_are_refused_with_their_line() {
        let message = |text: &str| {
            let columns = Columns::parse(text, "scar.csv");
            let column = columns.and_then(|columns| columns.column("f_m"));
            column.expect_err("a refusal").to_string()
        };
        assert_eq!(
            message("r_m,f_m\n0,0\n1,\n"),
            "scar.csv: line 3: f_m is missing; fill in or remove the row"
        );
        assert_eq!(
            message("# x\nr_m,f_m\n0,nan\n"),
            "scar.csv: line 3: f_m is missing; fill in or remove the row"
        );
        assert_eq!(
            message("r_m,f_m\n0,0\n1\n"),
            "scar.csv: line 3: has 1 fields; must have 2, one per column"
        );
        assert_eq!(
            message("r_m,q_m\n0,0\n"),
            "scar.csv: has no column f_m; the first line names r_m, q_m; --fields f=1 says which it is"
        );
        assert_eq!(
            message("r_m,f\n0,0\n"),
            "scar.csv: has no column f_m; f has no unit; name it as in f_um, or give --units um,nm, one per column"
        );
        assert_eq!(
            message("0,1\n1,2\n"),
            "scar.csv: line 1: begins the numbers, and a line before must name the columns, as in r_m,f_m; or name \
             them with --fields r=1,wear=2 --units um,nm"
        );
        assert!(message("").contains("has no column f_m"));
    }

    /// What instruments write around a table, and between its fields.
    #[test]
    fn tables_are_found_as_instruments_write_them() {
        for (text, lines) in [
            ("r_um,wear_nm\n0,1\n2.5,-3\n", [2, 3]),
            (
                "Operator: -\nDate: 12.03.2024\nFilter 2 um\n\nr_um,wear_nm\n0,1\n2.5,-3\n",
                [6, 7],
            ),
            (
                "Rate;1000\nLength;5,6\nr_um;wear_nm\n0,0;1,0\n2,5;-3,0\n",
                [4, 5],
            ),
            ("r_um wear_nm\n 0.0   1.0\n 2.5  -3.0\n", [2, 3]),
            ("r [µm]  wear_depth (nm)\n0 1\n2.5 -3\n", [2, 3]),
            ("r_um,wear_nm\n0;1\n2.5;-3\n", [2, 3]),
            ("r,wear\nµm,nm\n0,1\n2.5,-3\n", [3, 4]),
            (
                "Position\tWear depth\t\n[mm]\t[µm]\t\n0\t0.001\t\n0.0025\t-0.003\t\n",
                [3, 4],
            ),
            ("# r_um, wear_nm\n0, 1\n2.5, -3\n", [2, 3]),
            ("wear_nm,n,r_um\n\"1,0\",a,0\n\"−3,0\",b,\"2,5\"\n", [2, 3]),
        ] {
            let columns = parsed(text);
            for (name, expected) in [("r_m", [0.0, 2.5e-6]), ("wear_m", [1e-9, -3e-9])] {
                let found = columns
                    .column(name)
                    .unwrap_or_else(|why| panic!("{text}: {why}"));
                let is_near = |(found, expected): (&f64, f64)| (found - expected).abs() < 1e-20;
                assert!(
                    found.len() == 2 && found.iter().zip(expected).all(is_near),
                    "{text}: {found:?}"
                );
            }
            assert_eq!([0, 1].map(|row| columns.line(row)), lines, "{text}");
        }
    }

    #[test]
    fn commas_that_cannot_be_decimal_marks_are_refused() {
        for (text, expected) in [
            (
                "r_um,wear_nm\n1,5,2,5\n3,5,4,5\n5,0,4,0\n",
                "line 2: has 4 fields, but the line before names 2; decimal commas need another separator",
            ),
            (
                "r_nm,wear_nm\n\"1,500\",2.5\n\"3,500\",4.5\n",
                "line 2: a comma in a number, and points in others; export without separators of thousands",
            ),
        ] {
            let refused = Columns::parse(text, "scar.csv")
                .expect_err(text)
                .to_string();
            assert!(refused.contains(expected), "{refused}");
        }
    }

    #[test]
    fn missing_values_are_passed_over_and_other_words_are_not() {
        let columns = parsed("r_um,wear_nm\n0,Bad\n1,2\n2,\nNaN,3\n4,5\n");
        let ([r, wear], rows) = columns.whole_rows(["r_m", "wear_m"]).expect("columns");
        assert_eq!((rows, r.len(), wear.len()), (vec![1, 4], 2, 2));
        let refused = parsed("r_um,wear_nm\n0,1\n1,2x\n2,3\n").whole_rows(["r_m", "wear_m"]);
        let line = "line 3: wear_nm = 2x: must be a finite number; NaN, Bad, - and empty fields count as missing";
        assert!(refused.expect_err("refused").to_string().contains(line));
    }

    #[test]
    fn columns_without_names_are_named_by_the_user() {
        let naming = |fields: &[&str], units: &[&str]| Naming {
            fields: fields
                .iter()
                .map(|field| field.parse().expect("a field"))
                .collect(),
            units: units.iter().map(|unit| (*unit).to_owned()).collect(),
            key: None,
        };
        let read = |text, naming| Columns::parse_as(text, "scar.csv", &naming);
        let named = read(
            "7 0 1\n7 2.5 -3\n",
            naming(&["r=2", "wear=3"], &["um", "nm"]),
        )
        .expect("columns");
        assert_eq!(named.column("wear_m").expect("a column")[0], 1e-9);
        let units = read("r,wear\n0,1\n2,3\n", naming(&[], &["um", "nm"])).expect("columns");
        assert!((units.column("r_m").expect("a column")[1] / 2e-6 - 1.0).abs() < 1e-12);
        let kept =
            read("a_um,b_nm\n0,1\n2,3\n", naming(&["r=a_um", "wear=2"], &[])).expect("columns");
        assert!((kept.column("wear_m").expect("a column")[1] / 3e-9 - 1.0).abs() < 1e-12);
        let refused = read("0 1\n", naming(&["r=4"], &["um"])).expect_err("refused");
        assert!(refused.to_string().contains("--fields r=4: has 2 columns"));
    }

    #[test]
    fn what_is_no_file_is_refused() {
        for path in ["/", "/nowhere/at-all.csv", "/dev/zero"] {
            assert!(Columns::read(Path::new(path)).is_err(), "{path}");
        }
    }
}

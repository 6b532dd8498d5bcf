//! The table of a study as text: a header that contains the whole study and its base, the names of the columns, and a
//! row per point.
//!
//! ```text
//! # mdr-tui: 0.1.0
//! # study: base = "li2019-fig3"          the study, line by line
//! # base: [indenter]                     the base scenario, line by line
//! # arithmetic: x86_64, fused multiply-add    of each machine that has run points
//! # shard: 3/16                          only in a part of a study
//! motion.normal.mean,wear_volume_m3,status
//! 5e-7,1.2e-18,ok
//! ```
//!
//! While the study runs, rows appear in the order in which they finish; a row belongs to the point whose values it
//! begins with. A last line without a line end was cut short and does not count.
//!
//! Changes made by a spreadsheet are tolerated: columns are read by name, numbers in any form, lines with any line end,
//! and a byte order mark is skipped.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;

use super::{Shard, Study};
use crate::scenario::bounded_read::{self, Unread};
use crate::scenario::escape::{self, csv_line};
use crate::scenario::scalars::Value;
use crate::scenario::{Refusal, printable};
use crate::studies::table::Object;

/// Maximum length of a line, and of the header, in bytes.
const LONGEST: u64 = 1 << 26;

/// The arithmetic of each machine that has run some of the rows: their last digits depend on it.
pub type Arithmetic = BTreeSet<String>;

/// Returns the lines above the rows: the header and the names of the columns.
pub fn head(study: &Study, shard: Shard, arithmetic: &Arithmetic) -> String {
    let mut text = header(study);
    if !arithmetic.is_empty() {
        let known: Vec<&str> = arithmetic.iter().map(String::as_str).collect();
        let _ = writeln!(text, "# arithmetic: {}", known.join("; "));
    }
    if shard != Shard::WHOLE {
        let _ = writeln!(text, "# shard: {shard}");
    }
    text.push_str(&csv_line(study.columns()));
    text
}

/// Returns the header without arithmetic and shard: equal for equal studies on equal bases.
pub fn header(study: &Study) -> String {
    let mut text = format!("# mdr-tui: {}\n", env!("CARGO_PKG_VERSION"));
    // TOML's escapes keep any text on one line.
    let mut push = |key: &str, toml: &str| {
        for line in toml.lines().filter(|line| !line.trim().is_empty()) {
            let _ = writeln!(text, "# {key}: {line}");
        }
    };
    push("study", &study.to_toml());
    push("base", &study.base.to_toml());
    text
}

/// Splits one line of a CSV file into fields.
pub(super) fn split(line: &str) -> Vec<String> {
    let mut reader = csv::ReaderBuilder::new();
    let mut reader = reader.has_headers(false).from_reader(line.as_bytes());
    let mut row = csv::StringRecord::new();
    // Reading from memory cannot fail.
    let _ = reader.read_record(&mut row);
    row.iter().map(str::to_owned).collect()
}

/// Returns a row as one JSON object: numbers as numbers, empty fields as null.
pub fn json<'a>(columns: &[&str], fields: impl IntoIterator<Item = &'a String>) -> String {
    let value = |field: &String| match field.parse::<f64>() {
        _ if field.is_empty() => Value::Null,
        Ok(number) if number.is_finite() => number.into(),
        _ => field.clone().into(),
    };
    let values: Vec<Value> = fields.into_iter().map(value).collect();
    escape::json(&Object(columns, &values), false).unwrap_or_default()
}

/// A table read back row by row.
pub struct Record {
    /// Name in messages.
    name: String,
    /// The header without arithmetic and shard.
    header: String,
    /// The arithmetic of its rows.
    pub arithmetic: Arithmetic,
    /// The shard of the study that it contains.
    pub shard: Shard,
    /// The names of the columns, in the file's order.
    columns: Vec<String>,
    lines: Box<dyn BufRead>,
}

impl Record {
    /// Starts reading the table in a file.
    ///
    /// # Errors
    ///
    /// As for [`open`](Self::open), and if the file cannot be opened.
    pub fn of_file(path: &Path) -> Result<Self, Refusal> {
        let name = path.display();
        let file = bounded_read::open(path).map_err(|why| Refusal::unread(&name, &why))?;
        Self::open(file, &name.to_string())
    }

    /// Starts reading a table, called `name` in messages.
    ///
    /// # Errors
    ///
    /// If the file is not the table of a study.
    pub fn open(source: impl Read + 'static, name: &str) -> Result<Self, Refusal> {
        let name = printable(name);
        let refuse = |why: &str| Refusal::new(&name, why);
        let unread = |error: io::Error| Refusal::unread(&name, &Unread::Io(error));
        let mut lines: Box<dyn BufRead> = Box::new(BufReader::new(source));
        let (mut header, mut shard) = (String::new(), Shard::WHOLE);
        let mut arithmetic = Arithmetic::new();
        let columns = loop {
            let line = next_line(&mut *lines).map_err(unread)?.unwrap_or_default();
            let line = line.trim_start_matches('\u{feff}');
            if line.starts_with("\"#") {
                let rule = "a spreadsheet has put the lines of its header in quotes";
                return Err(refuse(rule).or("take them from the original"));
            }
            if !line.starts_with('#') {
                break split(line);
            }
            if let Some(given) = line.strip_prefix("# shard: ") {
                shard = given.parse().map_err(|why: String| refuse(&why))?;
            } else if let Some(given) = line.strip_prefix("# arithmetic: ") {
                arithmetic.extend(given.split("; ").map(printable));
            } else {
                header.push_str(line);
                header.push('\n');
            }
            if header.len() as u64 > LONGEST {
                return Err(refuse("its header is too long"));
            }
        };
        if !header.contains("# study: ") {
            let rule = "is not a table of mdr-tui sweep: its header has no study";
            return Err(refuse(rule));
        }
        Ok(Self {
            header,
            arithmetic,
            shard,
            columns,
            lines,
            name,
        })
    }

    /// Returns the study in the header.
    ///
    /// # Errors
    ///
    /// If the header was edited and no longer describes a study.
    pub fn study(&self) -> Result<Study, Refusal> {
        let part = |key: &str| -> String {
            let prefix = format!("# {key}: ");
            let lines = self.header.lines();
            let lines = lines.filter_map(|line| line.strip_prefix(&prefix));
            lines.fold(String::new(), |text, line| text + line + "\n")
        };
        Study::read_with_base(&part("study"), &self.name, &part("base"))
    }

    /// Refuses a table of another study, or one written by another version.
    ///
    /// # Errors
    ///
    /// The first line of the headers that differs.
    pub fn expect(&self, study: &Study, origin: &str) -> Result<(), Refusal> {
        let expected = header(study);
        if self.header == expected {
            return Ok(());
        }
        let ours = expected.lines().chain(["nothing"]);
        let theirs = self.header.lines().chain(["nothing"]);
        let differing = ours.zip(theirs).find(|(our, their)| our != their);
        let (our, their) = differing.unwrap_or_default();
        let [our, their] = [our, their].map(|line| line.trim_start_matches("# "));
        let rule = format!("holds another study: {their} where {origin} has {our}");
        Err(Refusal::new(&self.name, rule))
    }

    /// Iterates over the remaining rows, with the columns in the order of `study`.
    ///
    /// # Errors
    ///
    /// If the columns differ from the study's.
    pub fn rows(
        mut self,
        study: &Study,
    ) -> Result<impl Iterator<Item = Result<Vec<String>, Refusal>> + use<>, Refusal> {
        let refuse = |why: String| Refusal::new(&self.name, why);
        let wanted = study.columns();
        if let Some(more) = self.columns.iter().find(|name| !wanted.contains(&&***name)) {
            let more = printable(more);
            return Err(refuse(format!(
                "has a column {more}, which the study does not have"
            )));
        }
        let place = |name: &&str| {
            let at = self.columns.iter().position(|column| column == name);
            at.ok_or_else(|| refuse(format!("has no column {name}")))
        };
        let order: Vec<usize> = wanted.iter().map(place).collect::<Result<_, _>>()?;
        if self.columns.len() > wanted.len() {
            return Err(refuse("has a column twice".into()));
        }
        let unread = move |error| Refusal::unread(&self.name, &Unread::Io(error));
        Ok(std::iter::from_fn(move || {
            loop {
                let line = match next_line(&mut *self.lines) {
                    Ok(line) => line?,
                    Err(error) => return Some(Err(unread(error))),
                };
                if line.trim_end().is_empty() || line.starts_with('#') {
                    continue;
                }
                let mut row = split(&line);
                if row.len() == order.len() {
                    let order = order.iter();
                    row = order.map(|&at| std::mem::take(&mut row[at])).collect();
                }
                return Some(Ok(row));
            }
        }))
    }
}

/// Returns the next line without its line end; a line without one does not count.
fn next_line(lines: &mut dyn BufRead) -> io::Result<Option<String>> {
    let mut line = Vec::new();
    let read = lines.take(LONGEST).read_until(b'\n', &mut line)?;
    if line.pop() != Some(b'\n') {
        return match read as u64 {
            LONGEST => Err(io::Error::other("a line is too long")),
            _ => Ok(None),
        };
    }
    line.pop_if(|last| *last == b'\r');
    let line = String::from_utf8(line).map_err(|_| io::Error::other("is not UTF-8"))?;
    Ok(Some(line))
}

/// Why a row is not accepted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refused {
    /// It has another number of fields, or no point has these values.
    Foreign,
    /// All points with these values have their rows, and one of them equals this row.
    Double,
    /// All points with these values have their rows, and they differ from this one.
    Contradiction,
}

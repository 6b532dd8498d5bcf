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
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use super::{Shard, Study};
use crate::scenario::bounded_read::{self, Unread};
use crate::scenario::escape::csv_line;
use crate::scenario::{Refusal, printable};

/// The largest table to be read, in bytes.
const LARGEST: u64 = 1 << 33;

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

/// A table read back.
pub struct StudyFile {
    /// Name in messages.
    pub name: String,
    /// The header without arithmetic and shard.
    header: String,
    /// The arithmetic of the machines that have run its points.
    pub arithmetic: Arithmetic,
    /// The part of the study that it holds.
    pub shard: Shard,
    /// The names of the columns, and the rows.
    body: String,
}

impl StudyFile {
    /// Reads the table in a file.
    ///
    /// # Errors
    ///
    /// As for [`read`](Self::read), and if the file cannot be opened.
    pub fn of_file(path: &Path) -> Result<Self, Refusal> {
        let name = path.display();
        let file = bounded_read::open(path).map_err(|why| Refusal::unread(&name, &why))?;
        Self::read(file, &name.to_string())
    }

    /// Reads a table, called `name` in messages.
    ///
    /// # Errors
    ///
    /// If the file cannot be read, or is not the table of a study.
    pub fn read(from: impl Read, name: &str) -> Result<Self, Refusal> {
        let name = printable(name);
        let refuse = |why: &str| Refusal::new(&name, why);
        let unread = |error| Refusal::unread(&name, &Unread::Io(error));
        let mut lines = BufReader::new(from.take(LARGEST));
        let (mut header, mut shard) = (String::new(), Shard::WHOLE);
        let mut arithmetic = Arithmetic::new();
        let mut line = String::new();
        let mut body = loop {
            line.clear();
            lines.read_line(&mut line).map_err(unread)?;
            let text = line.trim_start_matches('\u{feff}').trim_end();
            if text.starts_with("\"#") {
                let rule = "a spreadsheet has put the lines of its header in quotes";
                return Err(refuse(rule).or("take them from the original"));
            }
            if !text.starts_with('#') {
                break line;
            }
            if let Some(given) = text.strip_prefix("# shard: ") {
                shard = given.parse().map_err(|why: String| refuse(&why))?;
            } else if let Some(given) = text.strip_prefix("# arithmetic: ") {
                arithmetic.extend(given.split("; ").map(printable));
            } else {
                header += text;
                header.push('\n');
            }
        };
        if !header.contains("# study: ") {
            let rule = "is not a table of mdr-tui sweep: its header has no study";
            return Err(refuse(rule));
        }
        lines.read_to_string(&mut body).map_err(unread)?;
        // A last line without a line end was cut short.
        body.truncate(body.rfind('\n').map_or(0, |end| end + 1));
        Ok(Self {
            header,
            arithmetic,
            shard,
            body,
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

    /// Returns the rows, with the columns in the order of `study`.
    ///
    /// # Errors
    ///
    /// If the columns differ from the study's; for a row, if it has another number of fields.
    pub(super) fn rows(
        &self,
        study: &Study,
    ) -> Result<impl Iterator<Item = Result<Vec<String>, Refusal>>, Refusal> {
        let refuse = |why: String| Refusal::new(&self.name, why);
        let mut reader = csv::ReaderBuilder::new();
        let mut reader = reader.comment(Some(b'#')).from_reader(self.body.as_bytes());
        let names = reader
            .headers()
            .map_err(|error| refuse(error.to_string()))?;
        let wanted = study.columns();
        if let Some(more) = names.iter().find(|name| !wanted.contains(name)) {
            let more = printable(more);
            return Err(refuse(format!(
                "has a column {more}, which the study does not have"
            )));
        }
        let place = |name: &&str| {
            let at = names.iter().position(|column| column == *name);
            at.ok_or_else(|| refuse(format!("has no column {name}")))
        };
        let order: Vec<usize> = wanted.iter().map(place).collect::<Result<_, _>>()?;
        let in_order = move |row: csv::StringRecord| {
            let fields = order.iter().map(|&at| row[at].to_owned());
            fields.collect()
        };
        let rows = reader.into_records();
        Ok(rows.map(move |row| {
            let row = row.map_err(|error| Refusal::new(&self.name, error));
            row.map(&in_order)
        }))
    }
}

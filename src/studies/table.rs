//! A table with named columns, rendered as aligned text, CSV or JSON.

use serde::{Serialize, Serializer};

use crate::scenario::escape::csv_line;
use crate::scenario::scalars::{self, Value};

/// How a column is formatted as text; files always get every digit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Words, aligned left.
    Words,
    /// Numbers, aligned right: whole ones unchanged, others with two digits and an exponent, 1.2e-3.
    Rough,
    /// Two decimals.
    Fixed,
}

impl Format {
    fn text(self, cell: &Value) -> String {
        match (self, cell.as_f64().filter(|_| cell.is_f64())) {
            (Self::Fixed, Some(value)) => format!("{value:.2}"),
            (_, Some(value)) => format!("{value:.1e}"),
            (_, None) => scalars::cell(cell),
        }
    }

    fn aligned(self, text: &str, width: usize) -> String {
        match self {
            Self::Words => format!("{text:width$}"),
            Self::Rough | Self::Fixed => format!("{text:>width$}"),
        }
    }

    /// Whether a cell spans all following columns of its group: words among numbers.
    fn is_spanned_by(self, cell: &Value) -> bool {
        self != Self::Words && cell.is_string()
    }
}

/// A column: a heading shared with its neighbours, only in texts and empty if there is none; its own heading, which is
/// the key in files; and its format.
pub type Heading = (&'static str, &'static str, Format);

/// Columns and rows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Report {
    columns: Vec<Heading>,
    pub(super) rows: Vec<Vec<Value>>,
}

impl Report {
    /// Makes a table without rows, from groups of columns: their shared heading, their names separated by blanks, and
    /// their format.
    pub fn with_columns(columns: &[Heading]) -> Self {
        let columns = columns.iter().flat_map(|&(group, names, format)| {
            let names = names.split(' ');
            names.map(move |name| (group, name, format))
        });
        Self {
            columns: columns.collect(),
            rows: Vec::new(),
        }
    }

    /// Adds a row, a list or a tuple: absent cells are missing, cells beyond the columns are dropped. Words in a column
    /// of numbers span all following columns of its group, whose own cells are then hidden.
    pub fn push(&mut self, row: impl Serialize) {
        let row = serde_json::to_value(row).expect("numbers and words");
        let mut row = row.as_array().cloned().unwrap_or_default();
        row.resize(self.columns.len(), Value::Null);
        self.rows.push(row);
    }

    fn names(&self) -> Vec<&'static str> {
        self.columns.iter().map(|(_, name, _)| *name).collect()
    }

    /// Formats comma-separated values after a line of names.
    pub fn csv(&self) -> String {
        let rows = self.rows.iter();
        let rows = rows.map(|row| csv_line(row.iter().map(scalars::cell)));
        csv_line(self.names()) + &rows.collect::<String>()
    }

    /// Formats aligned columns under their headings, without trailing blanks.
    pub fn text(&self) -> String {
        let columns = &self.columns;
        let widths: Vec<usize> = (0..columns.len()).map(|at| self.width(at)).collect();
        let mut text = String::new();
        if columns.iter().any(|(group, ..)| !group.is_empty()) {
            let heading = |at: usize, width| match columns[at].0 {
                "" => " ".repeat(width),
                group => format!("{group:-^width$}"),
            };
            text += &line(&widths, |at| self.group_end(at), heading);
        }
        let name = |at: usize, width| columns[at].2.aligned(columns[at].1, width);
        text += &line(&widths, |at| at + 1, name);
        for row in &self.rows {
            let end = |at: usize| {
                if columns[at].2.is_spanned_by(&row[at]) {
                    self.group_end(at)
                } else {
                    at + 1
                }
            };
            let cell = |at: usize, width| {
                let (.., format) = columns[at];
                format.aligned(&format.text(&row[at]), width)
            };
            text += &line(&widths, end, cell);
        }
        text
    }

    fn width(&self, at: usize) -> usize {
        let (_, name, format) = &self.columns[at];
        let cells = self.rows.iter().map(|row| &row[at]);
        let cells = cells.filter(|cell| !format.is_spanned_by(cell));
        let widths = cells.map(|cell| format.text(cell).chars().count());
        widths.fold(name.chars().count(), usize::max)
    }

    /// Returns one past the last column of the group of column `at`.
    fn group_end(&self, at: usize) -> usize {
        let is_of_it = |other: &&Heading| other.0 == self.columns[at].0;
        at + self.columns[at..].iter().take_while(is_of_it).count()
    }
}

/// Between two columns.
const GAP: &str = " ";

/// Formats a line of pieces, each of which spans from its column to the one before `end`, over these widths.
fn line(
    widths: &[usize],
    end: impl Fn(usize) -> usize,
    piece: impl Fn(usize, usize) -> String,
) -> String {
    let (mut line, mut at) = (Vec::new(), 0);
    while at < widths.len() {
        let next = end(at);
        let gaps = GAP.len() * (next - at - 1);
        line.push(piece(at, widths[at..next].iter().sum::<usize>() + gaps));
        at = next;
    }
    line.join(GAP).trim_end().to_owned() + "\n"
}

impl Serialize for Report {
    /// Writes a list of objects, with keys in the order of the columns.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let names = self.names();
        serializer.collect_seq(self.rows.iter().map(|row| Object(&names, row)))
    }
}

/// A row as an object: column names and cells.
pub struct Object<'a>(pub &'a [&'a str], pub &'a [Value]);

impl Serialize for Object<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().zip(self.1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Report {
        let mut table = Report::with_columns(&[
            ("", "method", Format::Words),
            ("", "N", Format::Rough),
            ("g", "max", Format::Rough),
            ("g", "order", Format::Fixed),
        ]);
        table.push(("a", 50, 0.1 + 0.2));
        table.push(("x, \"y\"", 100, "stopped"));
        table
    }

    #[test]
    fn text_is_aligned() {
        let expected = "           -----g------\n\
            method   N    max order\n\
            a       50 3.0e-1\n\
            x, \"y\" 100      stopped\n";
        assert_eq!(table().text(), expected);
    }

    #[test]
    fn files_keep_every_digit_and_quote_what_they_must() {
        assert_eq!(
            table().csv(),
            "method,N,max,order\na,50,0.30000000000000004,\n\"x, \"\"y\"\"\",100,stopped,\n"
        );
        let json = serde_json::to_string(&table()).expect("JSON");
        assert!(
            json.starts_with(r#"[{"method":"a","N":50,"max":0.30000000000000004,"order":null}"#)
        );
    }
}

//! Rows under named columns, rendered as aligned text, CSV or JSON.

use serde::{Serialize, Serializer};

use crate::math::number::shown;
use crate::scenario::escape::csv_line;
use crate::scenario::scalars::{self, Value};

/// Columns and rows. A column of words is aligned left, one of numbers right.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Rows {
    /// Of each column the heading that it shares with its neighbours, only in texts and empty if there is none, and its
    /// own, which is the key in files.
    columns: Vec<(String, String)>,
    pub(super) rows: Vec<Vec<Value>>,
}

impl Rows {
    /// Makes a table without rows, from groups of columns: their shared heading, and their names separated by blanks.
    pub fn with_columns(groups: &[(&str, &str)]) -> Self {
        let mut rows = Self::default();
        for (group, names) in groups {
            names.split(' ').for_each(|name| rows.column(group, name));
        }
        rows
    }

    /// Adds a column to a table without rows.
    pub fn column(&mut self, group: &str, name: &str) {
        self.columns.push((group.to_owned(), name.to_owned()));
    }

    /// Adds a row, a list or a tuple: absent cells are missing, cells beyond the columns are dropped. Words in a column
    /// of numbers span all following columns of its group, whose own cells are then hidden.
    pub fn push(&mut self, row: impl Serialize) {
        let row = serde_json::to_value(row).expect("numbers and words");
        let mut row = row.as_array().cloned().unwrap_or_default();
        row.resize(self.columns.len(), Value::Null);
        self.rows.push(row);
    }

    fn names(&self) -> Vec<&str> {
        self.columns.iter().map(|(_, name)| name.as_str()).collect()
    }

    /// Formats comma-separated values after a line of names; numbers have all their digits.
    pub fn csv(&self) -> String {
        let rows = self.rows.iter();
        let rows = rows.map(|row| csv_line(row.iter().map(scalars::cell)));
        csv_line(self.names()) + &rows.collect::<String>()
    }

    /// Formats aligned columns under their headings, without trailing blanks. Whole numbers are unchanged, others have so
    /// many digits.
    pub fn text(&self, digits: usize) -> String {
        let text = |cell: &Value| match cell.as_f64().filter(|_| cell.is_f64()) {
            Some(value) => shown(value, digits),
            None => scalars::cell(cell),
        };
        let is_words: Vec<bool> = (0..self.columns.len())
            .map(|at| self.is_words(at))
            .collect();
        let spans = |row: &[Value], at: usize| !is_words[at] && row[at].is_string();
        let aligned = |at: usize, text: &str, width: usize| {
            if is_words[at] {
                format!("{text:width$}")
            } else {
                format!("{text:>width$}")
            }
        };
        let width = |(at, (_, name)): (usize, &(String, String))| {
            let cells = self.rows.iter().filter(|row| !spans(row, at));
            let widths = cells.map(|row| text(&row[at]).chars().count());
            widths.fold(name.chars().count(), usize::max)
        };
        let widths: Vec<usize> = self.columns.iter().enumerate().map(width).collect();
        let mut lines = String::new();
        if self.columns.iter().any(|(group, _)| !group.is_empty()) {
            let heading = |at: usize, width| match self.columns[at].0.as_str() {
                "" => " ".repeat(width),
                group => format!("{group:-^width$}"),
            };
            lines += &line(&widths, |at| self.group_end(at), heading);
        }
        let name = |at: usize, width| aligned(at, &self.columns[at].1, width);
        lines += &line(&widths, |at| at + 1, name);
        for row in &self.rows {
            let end = |at: usize| {
                if spans(row, at) {
                    self.group_end(at)
                } else {
                    at + 1
                }
            };
            lines += &line(&widths, end, |at, width| {
                aligned(at, &text(&row[at]), width)
            });
        }
        lines
    }

    /// Whether a column has no cell but words.
    fn is_words(&self, at: usize) -> bool {
        let mut cells = self.rows.iter().map(|row| &row[at]);
        cells.all(|cell| cell.is_string() || cell.is_null())
    }

    /// Returns one past the last column of the group of column `at`.
    fn group_end(&self, at: usize) -> usize {
        let is_of_it = |other: &&(String, String)| other.0 == self.columns[at].0;
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

impl Serialize for Rows {
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

    fn table() -> Rows {
        let mut table = Rows::with_columns(&[("", "method N"), ("g", "max order")]);
        table.push(("a", 50, 0.1 + 0.2));
        table.push(("x, \"y\"", 100, "stopped"));
        table
    }

    #[test]
    fn text_is_aligned() {
        let expected = "           ----g-----\n\
            method   N  max order\n\
            a       50 0.30\n\
            x, \"y\" 100    stopped\n";
        assert_eq!(table().text(2), expected);
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

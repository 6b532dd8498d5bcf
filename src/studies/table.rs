//! A table with named columns, rendered as aligned text, CSV or JSON.

use std::fmt::Write;

use serde::Serialize;
use serde::ser::{SerializeSeq, Serializer};

use crate::scenario::scalars::quoted;

/// How a column is written as text; files always get every digit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Words, to the left.
    Words,
    /// Whole numbers, to the right.
    Count,
    /// Two digits and an exponent: 1.2e-3.
    Rough,
    /// Two digits after the point.
    Fixed,
}

/// A column.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Column {
    /// A heading that neighbouring columns share; empty for none. Text only.
    group: String,
    /// The heading, and the key in files.
    name: String,
    format: Format,
}

/// One cell of a table.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// Words.
    Words(String),
    /// A whole number.
    Count(usize),
    /// A number.
    Number(f64),
    /// Words across all columns of the group from here on, whose own cells are then not shown.
    Across(String),
    /// Nothing to say.
    Missing,
}

impl From<&str> for Cell {
    fn from(words: &str) -> Self {
        Self::Words(words.to_owned())
    }
}

impl From<usize> for Cell {
    fn from(count: usize) -> Self {
        Self::Count(count)
    }
}

impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl<T: Into<Cell>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Missing, T::into)
    }
}

impl Cell {
    fn text(&self, format: Format) -> String {
        match (self, format) {
            (Self::Words(words) | Self::Across(words), _) => words.clone(),
            (Self::Count(count), _) => count.to_string(),
            (Self::Number(value), Format::Fixed) => format!("{value:.2}"),
            (Self::Number(value), _) => format!("{value:.1e}"),
            (Self::Missing, _) => String::new(),
        }
    }

    /// Every digit; the shortest form that reads back to the same bits.
    fn field(&self) -> String {
        match self {
            Self::Words(words) | Self::Across(words) => quoted(words),
            Self::Count(count) => count.to_string(),
            Self::Number(value) if *value == 0.0 => "0".into(),
            Self::Number(value) => format!("{value:e}"),
            Self::Missing => String::new(),
        }
    }
}

impl Serialize for Cell {
    /// What JSON has no word for, NaN and infinities, becomes null.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Words(words) | Self::Across(words) => serializer.serialize_str(words),
            Self::Count(count) => count.serialize(serializer),
            Self::Number(value) => serializer.serialize_f64(*value),
            Self::Missing => serializer.serialize_none(),
        }
    }
}

/// Columns and rows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    columns: Vec<Column>,
    rows: Vec<Vec<Cell>>,
}

impl Table {
    /// A table without rows, of columns by the headings that they share, their names with blanks between them, and how
    /// they are written.
    pub fn of(columns: &[(&str, &str, Format)]) -> Self {
        let columns = columns.iter().flat_map(|(group, names, format)| {
            names.split(' ').map(|name| Column {
                group: (*group).into(),
                name: name.into(),
                format: *format,
            })
        });
        Self {
            columns: columns.collect(),
            rows: Vec::new(),
        }
    }

    /// Adds a row: cells that are not given are missing, cells beyond the columns are dropped.
    pub fn push(&mut self, mut row: Vec<Cell>) {
        row.resize(self.columns.len(), Cell::Missing);
        self.rows.push(row);
    }

    /// The rows.
    pub fn rows(&self) -> &[Vec<Cell>] {
        &self.rows
    }

    /// Comma-separated values under a line of names.
    pub fn csv(&self) -> String {
        let names: Vec<&str> = self.columns.iter().map(|c| c.name.as_str()).collect();
        let mut text = names.join(",");
        text.push('\n');
        for row in &self.rows {
            let fields: Vec<String> = row.iter().map(Cell::field).collect();
            text.push_str(&fields.join(","));
            text.push('\n');
        }
        text
    }

    /// Aligned columns under their headings, no trailing blanks.
    pub fn text(&self) -> String {
        let widths = self.widths();
        let mut text = String::new();
        if self.columns.iter().any(|column| !column.group.is_empty()) {
            push_line(&mut text, &self.group_line(&widths));
        }
        let names = self.columns.iter().zip(&widths);
        let names = names.map(|(column, &width)| aligned(&column.name, column.format, width));
        push_line(&mut text, &names.collect::<Vec<_>>().join(GAP));
        for row in &self.rows {
            push_line(&mut text, &self.line(row, &widths));
        }
        text
    }

    fn widths(&self) -> Vec<usize> {
        let width = |(at, column): (usize, &Column)| {
            let cells = self.rows.iter().map(|row| match &row[at] {
                Cell::Across(_) => 0,
                cell => cell.text(column.format).chars().count(),
            });
            cells.fold(column.name.chars().count(), usize::max)
        };
        self.columns.iter().enumerate().map(width).collect()
    }

    /// One past the last column of the group that column `at` belongs to.
    fn group_end(&self, at: usize) -> usize {
        let group = &self.columns[at].group;
        let others = self.columns[at..].iter();
        at + others.take_while(|column| column.group == *group).count()
    }

    fn group_line(&self, widths: &[usize]) -> String {
        let (mut line, mut at) = (Vec::new(), 0);
        while at < widths.len() {
            let end = self.group_end(at);
            let width = span(&widths[at..end]);
            let group = &self.columns[at].group;
            line.push(if group.is_empty() {
                " ".repeat(width)
            } else {
                format!("{group:-^width$}")
            });
            at = end;
        }
        line.join(GAP)
    }

    fn line(&self, row: &[Cell], widths: &[usize]) -> String {
        let (mut line, mut at) = (Vec::new(), 0);
        while at < row.len() {
            let format = self.columns[at].format;
            let end = match row[at] {
                Cell::Across(_) => self.group_end(at),
                _ => at + 1,
            };
            let text = row[at].text(format);
            line.push(aligned(&text, format, span(&widths[at..end])));
            at = end;
        }
        line.join(GAP)
    }
}

/// Between columns.
const GAP: &str = " ";

/// The width of neighbouring columns with the gaps between them.
fn span(widths: &[usize]) -> usize {
    widths.iter().sum::<usize>() + GAP.len() * widths.len().saturating_sub(1)
}

fn aligned(text: &str, format: Format, width: usize) -> String {
    match format {
        Format::Words => format!("{text:width$}"),
        Format::Count | Format::Rough | Format::Fixed => format!("{text:>width$}"),
    }
}

fn push_line(text: &mut String, line: &str) {
    let _ = writeln!(text, "{}", line.trim_end());
}

impl Serialize for Table {
    /// A list of objects, keys in the order of the columns.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut list = serializer.serialize_seq(Some(self.rows.len()))?;
        for row in &self.rows {
            list.serialize_element(&Object(&self.columns, row))?;
        }
        list.end()
    }
}

struct Object<'a>(&'a [Column], &'a [Cell]);

impl Serialize for Object<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let names = self.0.iter().map(|column| column.name.as_str());
        serializer.collect_map(names.zip(self.1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let mut table = Table::of(&[
            ("", "method", Format::Words),
            ("", "N", Format::Count),
            ("g", "max", Format::Rough),
            ("g", "order", Format::Fixed),
        ]);
        table.push(vec![
            Cell::Words("a".into()),
            Cell::Count(50),
            Cell::Number(0.1 + 0.2),
        ]);
        table.push(vec![
            Cell::Words("x, \"y\"".into()),
            Cell::Count(100),
            Cell::Across("stopped".into()),
        ]);
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
            "method,N,max,order\na,50,3.0000000000000004e-1,\n\"x, \"\"y\"\"\",100,stopped,\n"
        );
        let json = serde_json::to_string(&table()).expect("JSON");
        assert!(
            json.starts_with(r#"[{"method":"a","N":50,"max":0.30000000000000004,"order":null}"#)
        );
    }
}

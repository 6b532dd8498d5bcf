//! Columns of numbers in memory, with the header of the file that they are from or go to.

use super::Column;

/// A table of this program: header lines and columns of numbers, each named with its unit at the end.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// The `# key: value` lines.
    pub header: Vec<(String, String)>,
    pub(super) columns: Vec<(Column, Vec<f64>)>,
}

impl Table {
    /// A table from memory: its header and named columns of one length.
    pub fn of_columns(
        header: Vec<(String, String)>,
        columns: impl IntoIterator<Item = (Column, Vec<f64>)>,
    ) -> Self {
        Self {
            header,
            columns: columns.into_iter().collect(),
        }
    }

    /// Adds a column.
    #[must_use]
    pub fn with(mut self, column: Column, values: Vec<f64>) -> Self {
        self.columns.push((column, values));
        self
    }

    /// The same columns under another header.
    #[must_use]
    pub fn with_header(self, header: Vec<(String, String)>) -> Self {
        Self { header, ..self }
    }

    /// All columns, in order.
    pub fn columns(&self) -> impl Iterator<Item = (Column, &[f64])> {
        let columns = self.columns.iter();
        columns.map(|(column, values)| (*column, &values[..]))
    }

    /// A column, if it is there.
    pub fn column(&self, wanted: Column) -> Option<&[f64]> {
        let (_, values) = self.columns.iter().find(|(column, _)| *column == wanted)?;
        Some(values)
    }

    /// Whether it has all of these columns.
    pub fn has(&self, columns: &[Column]) -> bool {
        columns.iter().all(|column| self.column(*column).is_some())
    }

    /// Returns the value of a header line.
    pub fn fact(&self, key: &str) -> Option<&str> {
        let found = self.header.iter().find(|(name, _)| name == key);
        found.map(|(_, value)| value.as_str())
    }

    /// Returns the cycle given in the header; NaN without one.
    pub fn cycle(&self) -> f64 {
        let cycle = self
            .fact(Column::Cycle.name())
            .and_then(|cycle| cycle.parse().ok());
        cycle.unwrap_or(f64::NAN)
    }

    /// Returns the last cycle of a table over cycles.
    pub fn last_cycle(&self) -> Option<f64> {
        self.column(Column::Cycle)?.last().copied()
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |(_, values)| values.len())
    }
}

//! The recorder of the past: moments of a run as rows of numbers.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::column::Merge;
use super::{Column, Table};

/// Tolerance with which a cycle has ended.
const ROUNDING: f64 = 1e-9;

/// The past of a run: the first column is the cycle. Copies share their rows.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Recorder {
    columns: Vec<Column>,
    rows: Vec<Arc<[f64]>>,
    /// The cycle at which the first row begins.
    start: f64,
    /// Minimum number of cycles per row; 0 if each moment has its own row.
    stride: f64,
    /// Maximum number of rows; then rows are merged in pairs.
    most: usize,
}

impl Recorder {
    /// Makes a recorder with one row per moment.
    pub fn of_moments(columns: impl IntoIterator<Item = Column>) -> Self {
        Self {
            columns: columns.into_iter().collect(),
            // A loop may begin before the run does.
            start: f64::NEG_INFINITY,
            most: usize::MAX,
            ..Self::default()
        }
    }

    /// Makes a recorder with one row per cycle from the cycle `start` on; beyond `most` rows, with one per 2, 4, 8, …
    /// cycles. The first row always belongs to the first cycle.
    pub fn of_cycles(columns: impl IntoIterator<Item = Column>, start: f64, most: usize) -> Self {
        Self {
            start,
            stride: 1.0,
            most,
            ..Self::of_moments(columns)
        }
    }

    /// The columns.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The rows, oldest first: a number per column, NaN where unknown.
    pub fn rows(&self) -> &[Arc<[f64]>] {
        &self.rows
    }

    /// Returns the cycle of the last row.
    pub fn last_cycle(&self) -> Option<f64> {
        self.rows.last().map(|row| row[0])
    }

    /// Whether the last row still grows: it stands for fewer cycles than the others.
    pub fn is_open(&self) -> bool {
        let end = |row: &Arc<[f64]>| row[0];
        match &self.rows[..] {
            [] => false,
            [.., before, last] => end(last) < end(before) + self.stride - ROUNDING,
            [first] => end(first) < self.start + self.stride - ROUNDING,
        }
    }

    /// Records a moment at which the columns are read by `read`. It becomes a row or a part of the last one.
    pub fn record(&mut self, read: impl Fn(Column) -> f64) {
        let closed = self.rows.len() - usize::from(self.is_open());
        let before = self.rows[..closed].last().map_or(self.start, |row| row[0]);
        let ends = read(Column::Cycle) >= before + self.stride - ROUNDING;
        self.add(read, ends);
    }

    /// Adds a moment to the last row if that is open, or else a row, which `ends` there or stays open.
    fn add(&mut self, read: impl Fn(Column) -> f64, ends: bool) {
        let open = if self.is_open() {
            self.rows.pop()
        } else {
            None
        };
        let row = self.columns.iter().enumerate().map(|(k, &column)| {
            let held = open.as_ref().map(|open| open[k]);
            match (column.merge(), held) {
                (Merge::End, _) if !ends => f64::NAN,
                (merge, Some(held)) => merge.merged(held, read(column)),
                (_, None) => read(column),
            }
        });
        self.rows.push(row.collect());
        if ends && self.rows.len() >= self.most {
            self.merge_pairs();
        }
    }

    /// Merges all rows but the first in pairs.
    fn merge_pairs(&mut self) {
        let merged = |pair: &[Arc<[f64]>]| match pair {
            [one, other] => {
                let columns = self.columns.iter().zip(one.iter().zip(&**other));
                let values =
                    columns.map(|(column, (one, other))| column.merge().merged(*one, *other));
                values.collect()
            }
            single => Arc::clone(&single[0]),
        };
        let (first, later) = self.rows.split_at(1);
        self.rows = first
            .iter()
            .cloned()
            .chain(later.chunks(2).map(merged))
            .collect();
        self.stride *= 2.0;
    }

    /// Records the rows of a table up to the cycle `end`.
    pub fn record_table(&mut self, table: &Table, end: f64) {
        let cycles = table.column(Column::Cycle).unwrap_or_default();
        for row in (0..cycles.len()).filter(|&row| cycles[row] <= end) {
            self.record(|column| table.column(column).map_or(f64::NAN, |values| values[row]));
        }
    }

    /// Ends the last row at the present moment, which it was open for; the columns are read by `read`.
    pub fn close(&mut self, read: impl Fn(Column) -> f64) {
        if self.is_open() {
            self.add(read, true);
        }
    }

    /// Forgets the `count` oldest rows.
    pub fn forget_oldest(&mut self, count: usize) {
        self.rows.drain(..count);
    }

    /// Keeps the rows of these numbers, and forgets the others.
    pub fn keep(&mut self, is_kept: impl Fn(usize) -> bool) {
        let mut row = 0..;
        self.rows.retain(|_| row.next().is_some_and(&is_kept));
    }

    /// Whether each row has a number for each column, of which the cycle is the first.
    pub fn is_whole(&self) -> bool {
        let count = self.columns.len();
        self.columns.first() == Some(&Column::Cycle)
            && self.rows.iter().all(|row| row.len() == count)
    }

    /// Returns the columns among `wanted` that are recorded, as a table.
    pub fn table(&self, wanted: &[Column]) -> Table {
        let recorded = self.columns.iter().copied().enumerate();
        let chosen = recorded.filter(|(_, column)| wanted.contains(column));
        let values = |place: usize| self.rows.iter().map(|row| row[place]).collect();
        Table::of_columns(
            Vec::new(),
            chosen.map(|(place, column)| (column, values(place))),
        )
    }
}

impl Merge {
    /// What remains of a value and a later one.
    fn merged(self, one: f64, later: f64) -> f64 {
        match self {
            Self::Last | Self::End => later,
            Self::Max => one.max(later),
            Self::Min => one.min(later),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COLUMNS: [Column; 4] = [
        Column::Cycle,
        Column::ContactRadius,
        Column::PermanentStickRadius,
        Column::MaxPressure,
    ];

    #[test]
    fn memory_is_bounded_and_extremes_and_the_first_cycle_survive() {
        let mut past = Recorder::of_cycles(COLUMNS, 0.0, 512);
        for step in 0..=200_000_u32 {
            let cycle = f64::from(step) / 4.0;
            past.record(|column| match column {
                Column::Cycle => cycle,
                Column::ContactRadius if step == 70_001 => 9.0,
                Column::PermanentStickRadius if step == 777 => 0.1,
                _ => 1.0,
            });
            assert!(past.rows().len() <= 512);
            let is_open = past.rows().last().is_some_and(|last| last[3].is_nan());
            assert!(!is_open || past.is_open());
        }
        let table = past.table(&COLUMNS);
        let column = |column| table.column(column).expect("a column").to_vec();
        assert_eq!(column(Column::Cycle)[0], 1.0);
        assert_eq!(table.last_cycle(), Some(50_000.0));
        let largest = column(Column::ContactRadius)
            .into_iter()
            .fold(0.0, f64::max);
        let smallest = column(Column::PermanentStickRadius)
            .into_iter()
            .fold(9.0, f64::min);
        assert_eq!((largest, smallest), (9.0, 0.1));
        let gaps: Vec<f64> = column(Column::Cycle)
            .windows(2)
            .map(|pair| pair[1] - pair[0])
            .collect();
        assert!(
            gaps[..gaps.len() - 1].iter().all(|gap| *gap == gaps[0]),
            "{gaps:?}"
        );
    }

    #[test]
    fn each_moment_has_its_own_row_if_wanted() {
        let mut past = Recorder::of_moments(COLUMNS);
        for cycle in [-0.75, -0.5, 0.25, 1000.0] {
            past.record(|_| cycle);
            assert!(!past.is_open());
        }
        let cycles: Vec<f64> = past.rows().iter().map(|row| row[3]).collect();
        assert_eq!(cycles, [-0.75, -0.5, 0.25, 1000.0]);
        past.keep(|row| row < 1);
        assert_eq!(past.rows().len(), 1);
    }
}

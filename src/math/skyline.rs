//! A linear operator on nodal values, stored in panels of rows without most of the zeros around their entries.
//!
//! The Abel transforms are triangular, or nearly so: g(x) and w(r) look inwards, p(r) looks outwards. A panel is
//! sixteen rows over the columns that any of them uses. Its sums stay in vector registers during one pass over its
//! entries, and the pass covers only the columns where the input is not zero (within the contact, outside the stick
//! zone). Cost: at most N²/2 multiply-adds.
//!
//! The last digits differ between CPUs with and without fused multiply-add, but never between runs on one machine.

use std::ops::Range;

use nalgebra::DMatrix;

use super::scan::support;
use super::vector::{Fusing, with_widest};

/// Rows per panel.
const ROWS: usize = 16;

/// A square matrix whose rows each hold their entries in one run.
#[derive(Debug, Clone, PartialEq)]
pub struct Skyline {
    size: usize,
    panels: Vec<RowPanel>,
    /// Entries of the panels, column by column, zero where a row has none.
    entries: Vec<PanelColumn>,
}

/// Entries of a panel in one column, aligned so that no vector straddles two cache lines.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
struct PanelColumn([f64; ROWS]);

/// The columns of a panel, possibly empty.
#[derive(Debug, Clone, PartialEq)]
struct RowPanel {
    columns: Range<usize>,
    /// Index of its first column in the entries.
    start: usize,
}

impl RowPanel {
    /// Returns the part of its `columns` within `input`: where their entries are, and which columns these are.
    fn within(&self, input: &Range<usize>) -> (Range<usize>, Range<usize>) {
        let first = input.start.clamp(self.columns.start, self.columns.end);
        let end = self.columns.end.min(input.end).max(first);
        let start = self.start + first - self.columns.start;
        (start..start + (end - first), first..end)
    }
}

/// Sums `columns` times their values, for each row of a panel.
#[inline(always)]
fn sum_columns(fusing: Fusing, columns: &[PanelColumn], values: &[f64]) -> [f64; ROWS] {
    // Two sums per row, so that the processor need not wait for the last addition.
    let mut sums = [[0.0; ROWS]; 2];
    let (fours, rest) = columns.as_chunks::<4>();
    let (fours_of_values, rest_values) = values.as_chunks::<4>();
    for (columns, values) in fours.iter().zip(fours_of_values) {
        for k in 0..4 {
            sums[k % 2] = fusing.multiply_add(&columns[k].0, &[values[k]; ROWS], &sums[k % 2]);
        }
    }
    let [mut all, others] = sums;
    for (PanelColumn(entries), value) in rest.iter().zip(rest_values) {
        all = fusing.multiply_add(entries, &[*value; ROWS], &all);
    }
    for (sum, other) in all.iter_mut().zip(others) {
        *sum += other;
    }
    all
}

impl Skyline {
    /// Packs a square dense matrix; drops the columns of zeros at both ends of a panel.
    pub fn pack(dense: &DMatrix<f64>) -> Self {
        let size = dense.nrows();
        let (mut panels, mut entries) = (Vec::new(), Vec::new());
        for row in (0..size).step_by(ROWS) {
            let rows = ROWS.min(size - row);
            let any = |k: &usize| (row..row + rows).any(|j| dense[(j, *k)] != 0.0);
            let first = (0..size).find(any).unwrap_or(0);
            let end = (0..size).rfind(any).map_or(first, |k| k + 1);
            let (columns, start) = (first..end, entries.len());
            entries.extend(columns.clone().map(|k| {
                let entry = |i| if i < rows { dense[(row + i, k)] } else { 0.0 };
                PanelColumn(std::array::from_fn(entry))
            }));
            panels.push(RowPanel { columns, start });
        }
        Self {
            size,
            panels,
            entries,
        }
    }

    /// Writes the product with `input`, of the operator's size, into `output`, from the panel that contains the row
    /// `first` on; returns the first row written. `output` may cover the first rows only, and is overwritten.
    pub fn apply_from(&self, first: usize, input: &[f64], output: &mut [f64]) -> usize {
        debug_assert_eq!(input.len(), self.size);
        debug_assert!(output.len() <= self.size);
        let panel = (first / ROWS).min(self.panels.len());
        let finite = with_widest(
            #[inline(always)]
            |fusing| self.multiply(fusing, panel, input, output),
        );
        if !finite {
            self.apply_not_finite(input, output);
        }
        panel * ROWS
    }

    /// Computes the rows of the panels from `first` on; returns whether all their sums are finite.
    #[inline(always)]
    fn multiply(&self, fusing: Fusing, first: usize, input: &[f64], output: &mut [f64]) -> bool {
        let support = support(input);
        let start = (first * ROWS).min(output.len());
        let output = &mut output[start..];
        let (whole, rest) = output.as_chunks_mut();
        let (whole_panels, last) = self.panels[first..].split_at(whole.len());
        for (output, panel) in whole.iter_mut().zip(whole_panels) {
            let (at, columns) = panel.within(&support);
            *output = sum_columns(fusing, &self.entries[at], &input[columns]);
        }
        for panel in last.iter().take(1) {
            let (at, columns) = panel.within(&support);
            let sums = sum_columns(fusing, &self.entries[at], &input[columns]);
            rest.copy_from_slice(&sums[..rest.len()]);
        }
        output.iter().fold(true, |all, sum| all & sum.is_finite())
    }

    /// Zero times a value that is not finite is not zero. This passes such values on to the rows that have an entry for
    /// them, not to all rows of their panels. The step then fails, so this need not be quick.
    fn apply_not_finite(&self, input: &[f64], output: &mut [f64]) {
        for (row, output) in output.iter_mut().enumerate() {
            let seen = self.row(row).filter(|(_, entry)| *entry != 0.0);
            *output = seen.map(|(k, entry)| entry * input[k]).sum();
        }
    }

    /// The entries of a row, each with its column.
    fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64)> {
        let RowPanel { columns, start } = &self.panels[row / ROWS];
        let columns = columns.clone().zip(&self.entries[*start..]);
        columns.map(move |(k, column)| (k, column.0[row % ROWS]))
    }
}

/// Access for tests.
#[cfg(test)]
impl Skyline {
    /// Returns the operator as a dense matrix.
    pub fn to_dense(&self) -> DMatrix<f64> {
        let mut dense = DMatrix::zeros(self.size, self.size);
        for row in 0..self.size {
            for (k, entry) in self.row(row) {
                dense[(row, k)] = entry;
            }
        }
        dense
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example() -> DMatrix<f64> {
        DMatrix::from_row_slice(3, 3, &[1.0, 0.0, 0.0, 2.0, 3.0, 0.0, 0.0, 4.0, 5.0])
    }

    #[test]
    fn packing_keeps_every_entry_and_overwrites_dirty_output() {
        let dense = example();
        let packed = Skyline::pack(&dense);
        assert_eq!(packed.to_dense(), dense);
        let mut output = [f64::NAN; 3];
        packed.apply_from(0, &[1.0, 10.0, 100.0], &mut output);
        assert_eq!(output, [1.0, 32.0, 540.0]);
    }

    /// Compares with nalgebra, over sizes that leave every kind of remainder.
    #[test]
    fn it_is_the_product_with_the_matrix() {
        for size in [1, 2, 3, 4, 5, 7, 8, 17, 64, 101] {
            for (below, above) in [(0, 200), (200, 0), (1, 200), (2, 3), (200, 200)] {
                let dense = DMatrix::from_fn(size, size, |i, j| {
                    let inside = i <= j + above && j <= i + below;
                    if inside {
                        (1 + 3 * i + 7 * j) as f64 % 11.0 - 5.0
                    } else {
                        0.0
                    }
                });
                let input: Vec<f64> = (0..size).map(|j| (j as f64 * 1.7).sin()).collect();
                let mut output = vec![f64::NAN; size];
                Skyline::pack(&dense).apply_from(0, &input, &mut output);
                let expected = &dense * nalgebra::DVector::from_column_slice(&input);
                for (found, expected) in output.iter().zip(&expected) {
                    assert!((found - expected).abs() < 1e-12 * size as f64);
                }
            }
        }
    }

    #[test]
    fn not_a_number_is_passed_on_not_skipped() {
        let packed = Skyline::pack(&example());
        let mut output = [0.0; 3];
        packed.apply_from(0, &[0.0, f64::NAN, 0.0], &mut output);
        assert_eq!(output[0], 0.0);
        assert!(output[1].is_nan() && output[2].is_nan());
    }

    /// Inputs that end within a panel's columns, inputs outside them, and empty inputs.
    #[test]
    fn what_lies_outside_the_input_is_passed_over() {
        let dense = DMatrix::from_fn(45, 45, |i, j| {
            let inside = (i..i + 6).contains(&j);
            if inside { (1 + i + 2 * j) as f64 } else { 0.0 }
        });
        let packed = Skyline::pack(&dense);
        assert_eq!(packed.to_dense(), dense);
        for support in [0..45, 0..2, 4..5, 2..9, 20..30, 44..45, 7..7] {
            let mut input = vec![0.0; 45];
            input[support.clone()].fill(1.5);
            let mut output = vec![f64::NAN; 45];
            packed.apply_from(0, &input, &mut output);
            let expected = &dense * nalgebra::DVector::from_column_slice(&input);
            assert_eq!(output, expected.as_slice(), "{support:?}");
        }
    }

    #[test]
    fn packing_keeps_causality() {
        let packed = Skyline::pack(&example()).to_dense();
        assert_eq!(packed, packed.lower_triangle());
        assert_ne!(packed, packed.upper_triangle());
        let packed = Skyline::pack(&example().transpose()).to_dense();
        assert_eq!(packed, packed.upper_triangle());
    }
}

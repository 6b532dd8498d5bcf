//! A linear operator on nodal values, stored by columns with the zeros at both ends left out.
//!
//! The Abel transforms are triangular, or nearly so: g(x) and w(r) look inwards, p(r) looks
//! outwards. Column storage turns their application into a sum of contiguous scaled columns, four at
//! a time in the vector instructions of the processor, and lets columns be skipped where their input
//! is zero (outside the contact, inside the stick zone). Cost: at most N²/2 multiply-adds.
//!
//! Processors that fuse multiplication and addition give other last digits than those that do not; on
//! one machine they are always the same.

use std::ops::Range;

use fearless_simd::{Level, dispatch, f64x4, prelude::*};
use nalgebra::DMatrix;

/// A square matrix whose columns each hold one contiguous run of entries.
#[derive(Debug, Clone, PartialEq)]
pub struct Staircase {
    size: usize,
    columns: Vec<Column>,
    entries: Vec<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Column {
    first_row: usize,
    start: usize,
    end: usize,
}

impl Column {
    fn end_row(&self) -> usize {
        self.first_row + (self.end - self.start)
    }
}

/// Adds four columns of equal length, each times its value.
#[inline(always)]
fn add_four<S: Simd>(simd: S, values: [f64; 4], columns: [&[f64]; 4], output: &mut [f64]) {
    let factors = values.map(|value| f64x4::splat(simd, value));
    let (outputs, rest) = output.as_chunks_mut::<4>();
    let lanes = columns.map(|column| column.as_chunks::<4>().0);
    let [a, b, c, d] = lanes.map(|lanes| &lanes[..outputs.len()]);
    let start = 4 * outputs.len();
    for ((((out, a), b), c), d) in outputs.iter_mut().zip(a).zip(b).zip(c).zip(d) {
        let load = |lanes: &[f64; 4]| f64x4::from_slice(simd, lanes);
        let mut sum = load(out);
        for (factor, lanes) in factors.iter().zip([a, b, c, d]) {
            sum = load(lanes).mul_add(*factor, sum);
        }
        sum.store_slice(out);
    }
    for (i, out) in rest.iter_mut().enumerate() {
        for (value, column) in values.iter().zip(columns) {
            *out += value * column[start + i];
        }
    }
}

impl Staircase {
    /// Packs a square dense matrix; entries between the first and the last non-zero of a column stay.
    pub fn pack(dense: &DMatrix<f64>) -> Self {
        let size = dense.nrows();
        let mut entries = Vec::new();
        let columns = dense
            .column_iter()
            .map(|column| {
                let first_row = column.iter().position(|&v| v != 0.0).unwrap_or(size);
                let last_row = column
                    .iter()
                    .rposition(|&v| v != 0.0)
                    .map_or(first_row, |k| k + 1);
                let start = entries.len();
                entries.extend(column.iter().take(last_row).skip(first_row));
                let end = entries.len();
                Column {
                    first_row,
                    start,
                    end,
                }
            })
            .collect();
        Self {
            size,
            columns,
            entries,
        }
    }

    /// Writes the product with `input` into `output`, both of the operator's size.
    /// Whatever `output` held before is overwritten.
    pub fn apply(&self, input: &[f64], output: &mut [f64]) {
        debug_assert_eq!(input.len(), self.size);
        debug_assert_eq!(output.len(), self.size);
        // Compiled once for every instruction set; the processor's own is chosen.
        dispatch!(Level::new(), simd => self.multiply(simd, input, output));
    }

    /// Columns are taken four at a time, so that each output is loaded and stored once for four of them.
    #[inline(always)]
    fn multiply<S: Simd>(&self, simd: S, input: &[f64], output: &mut [f64]) {
        output.fill(0.0);
        let (inputs, other_inputs) = input.as_chunks::<4>();
        let (columns, other_columns) = self.columns.as_chunks::<4>();
        for (values, columns) in inputs.iter().zip(columns) {
            if *values == [0.0; 4] {
                continue;
            }
            // The rows that all four columns have.
            let first = columns.iter().map(|column| column.first_row).max();
            let end = columns.iter().map(Column::end_row).min();
            let (first, end) = (first.unwrap_or(0), end.unwrap_or(0));
            if first >= end {
                for (value, column) in values.iter().zip(columns) {
                    self.add(simd, *value, column, 0..self.size, output);
                }
                continue;
            }
            let [a, b, c, d] = columns.map(|column| self.entries_of(&column, &(first..end)));
            for (value, column) in values.iter().zip(columns) {
                self.add(simd, *value, column, 0..first, output);
                self.add(simd, *value, column, end..self.size, output);
            }
            add_four(simd, *values, [a, b, c, d], &mut output[first..end]);
        }
        for (value, column) in other_inputs.iter().zip(other_columns) {
            self.add(simd, *value, column, 0..self.size, output);
        }
    }

    /// Adds `value` times the entries of `column` in the given rows.
    #[inline(always)]
    fn add<S: Simd>(
        &self,
        _simd: S,
        value: f64,
        column: &Column,
        rows: Range<usize>,
        output: &mut [f64],
    ) {
        let rows = rows.start.max(column.first_row)..rows.end.min(column.end_row());
        if value == 0.0 || rows.is_empty() {
            return;
        }
        let entries = self.entries_of(column, &rows);
        for (out, entry) in output[rows].iter_mut().zip(entries) {
            *out += value * entry;
        }
    }

    /// The entries of `column` in rows that it has.
    fn entries_of(&self, column: &Column, rows: &Range<usize>) -> &[f64] {
        let start = column.start + rows.start - column.first_row;
        &self.entries[start..start + rows.len()]
    }

    /// The operator as a dense matrix, for eigenvalues and norms.
    pub fn to_dense(&self) -> DMatrix<f64> {
        let mut dense = DMatrix::zeros(self.size, self.size);
        for (k, column) in self.columns.iter().enumerate() {
            for (offset, entry) in self.entries[column.start..column.end].iter().enumerate() {
                dense[(column.first_row + offset, k)] = *entry;
            }
        }
        dense
    }

    /// Whether row j needs input from columns 0..=j only.
    pub fn looks_inwards_only(&self) -> bool {
        self.columns
            .iter()
            .enumerate()
            .all(|(k, column)| column.first_row >= k)
    }

    /// Whether row j needs input from columns j.. only.
    pub fn looks_outwards_only(&self) -> bool {
        self.columns
            .iter()
            .enumerate()
            .all(|(k, column)| column.end_row() <= k + 1)
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
        let packed = Staircase::pack(&dense);
        assert_eq!(packed.to_dense(), dense);
        let mut output = [f64::NAN; 3];
        packed.apply(&[1.0, 10.0, 100.0], &mut output);
        assert_eq!(output, [1.0, 32.0, 540.0]);
    }

    /// Against nalgebra, over shapes that leave a rest in every way.
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
                Staircase::pack(&dense).apply(&input, &mut output);
                let expected = &dense * nalgebra::DVector::from_column_slice(&input);
                for (found, expected) in output.iter().zip(&expected) {
                    assert!((found - expected).abs() < 1e-12 * size as f64);
                }
            }
        }
    }

    #[test]
    fn not_a_number_is_passed_on_not_skipped() {
        let packed = Staircase::pack(&example());
        let mut output = [0.0; 3];
        packed.apply(&[0.0, f64::NAN, 0.0], &mut output);
        assert_eq!(output[0], 0.0);
        assert!(output[1].is_nan() && output[2].is_nan());
    }

    #[test]
    fn causality_is_read_off_the_columns() {
        let packed = Staircase::pack(&example());
        assert!(packed.looks_inwards_only());
        assert!(!packed.looks_outwards_only());
        assert!(Staircase::pack(&example().transpose()).looks_outwards_only());
    }
}

//! A linear operator on nodal values, stored by columns with the zeros at both ends left out.
//!
//! The Abel transforms are triangular, or nearly so: g(x) and w(r) look inwards, p(r) looks
//! outwards. Column storage turns their application into a sum of contiguous scaled columns,
//! which the compiler vectorises, and lets a column be skipped where its input is zero
//! (outside the contact, inside the stick zone). Cost: at most N²/2 multiply-adds.

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
        output.fill(0.0);
        for (&value, column) in input.iter().zip(&self.columns) {
            if value == 0.0 {
                continue;
            }
            let entries = &self.entries[column.start..column.end];
            for (out, entry) in output[column.first_row..].iter_mut().zip(entries) {
                *out += value * entry;
            }
        }
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
            .all(|(k, column)| column.first_row + (column.end - column.start) <= k + 1)
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

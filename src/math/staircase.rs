//! A linear operator on nodal values, stored in panels of rows with the zeros at both ends left out.
//!
//! The Abel transforms are triangular, or nearly so: g(x) and w(r) look inwards, p(r) looks
//! outwards. A panel is eight rows over the columns that any of them has. Their sums stay in the
//! registers of the processor's vector unit while one pass goes through the panel's entries, and the pass
//! covers only the columns where the input is not zero (within the contact, outside the stick zone).
//! Cost: at most N²/2 multiply-adds.
//!
//! Processors that fuse multiplication and addition give other last digits than those that do not; on
//! one machine they are always the same.

use std::ops::Range;

use fearless_simd::{Level, dispatch, f64x4, prelude::*};
use nalgebra::DMatrix;

/// Rows of a panel, and of one vector.
const ROWS: usize = 8;
const LANES: usize = 4;

/// A square matrix whose rows each hold one contiguous run of entries.
#[derive(Debug, Clone, PartialEq)]
pub struct Staircase {
    size: usize,
    panels: Vec<Panel>,
    /// The panels' entries, column by column, zero where a row has none.
    entries: Vec<[f64; ROWS]>,
}

#[derive(Debug, Clone, PartialEq)]
struct Panel {
    columns: Range<usize>,
    /// Its first column in the entries.
    start: usize,
}

impl Panel {
    /// Where the entries of those of its `columns` are that lie within `input`, and which ones these are.
    fn within(&self, input: &Range<usize>) -> (Range<usize>, Range<usize>) {
        let first = self.columns.start.max(input.start);
        let end = self.columns.end.min(input.end).max(first);
        let start = self.start + first - self.columns.start;
        (start..start + (end - first), first..end)
    }
}

/// The sums of a panel's rows over its `columns`, each times its value.
#[inline(always)]
fn sum_panel<S: Simd>(simd: S, columns: &[[f64; ROWS]], values: &[f64]) -> [f64; ROWS] {
    let halves = |column: &[f64; ROWS]| {
        let (lanes, _) = column.as_chunks::<LANES>();
        [0, 1].map(|half| f64x4::from_slice(simd, &lanes[half]))
    };
    // Every other column has sums of its own: the processor need not wait for the last addition.
    let mut sums = [[f64x4::splat(simd, 0.0); 2]; 2];
    let (pairs, last) = columns.as_chunks::<2>();
    let (paired, value_of_last) = values.as_chunks::<2>();
    for (pair, values) in pairs.iter().zip(paired) {
        for ((sums, column), value) in sums.iter_mut().zip(pair).zip(values) {
            let value = f64x4::splat(simd, *value);
            for (sum, entries) in sums.iter_mut().zip(halves(column)) {
                *sum = entries.mul_add(value, *sum);
            }
        }
    }
    for (column, value) in last.iter().zip(value_of_last) {
        let value = f64x4::splat(simd, *value);
        for (sum, entries) in sums[0].iter_mut().zip(halves(column)) {
            *sum = entries.mul_add(value, *sum);
        }
    }
    let mut rows = [0.0; ROWS];
    let [even, odd] = sums;
    let (lanes, _) = rows.as_chunks_mut::<LANES>();
    for ((lanes, even), odd) in lanes.iter_mut().zip(even).zip(odd) {
        (even + odd).store_slice(lanes);
    }
    rows
}

/// The smallest range outside which `values` are zero.
fn support(values: &[f64]) -> Range<usize> {
    let first = values.iter().position(|&value| value != 0.0);
    let last = values.iter().rposition(|&value| value != 0.0);
    match (first, last) {
        (Some(first), Some(last)) => first..last + 1,
        _ => 0..0,
    }
}

impl Staircase {
    /// Packs a square dense matrix; entries between the first and the last non-zero of a row stay.
    pub fn pack(dense: &DMatrix<f64>) -> Self {
        let size = dense.nrows();
        let (mut panels, mut entries) = (Vec::new(), Vec::new());
        for row in (0..size).step_by(ROWS) {
            let rows = ROWS.min(size - row);
            let any = |k: &usize| (row..row + rows).any(|j| dense[(j, *k)] != 0.0);
            let first = (0..size).find(any).unwrap_or(0);
            let end = (0..size).rfind(any).map_or(first, |k| k + 1);
            panels.push(Panel {
                columns: first..end,
                start: entries.len(),
            });
            entries.extend((first..end).map(|k| {
                std::array::from_fn(|i| if i < rows { dense[(row + i, k)] } else { 0.0 })
            }));
        }
        Self {
            size,
            panels,
            entries,
        }
    }

    /// Writes the product with `input` into `output`, both of the operator's size.
    /// Whatever `output` held before is overwritten.
    pub fn apply(&self, input: &[f64], output: &mut [f64]) {
        self.apply_rows(input, output, 0..self.size);
    }

    /// The same for those rows alone that are asked for; what the others receive does not
    /// matter to the caller: zero, or what they would in [`apply`](Self::apply).
    pub fn apply_rows(&self, input: &[f64], output: &mut [f64], rows: Range<usize>) {
        debug_assert_eq!(input.len(), self.size);
        debug_assert_eq!(output.len(), self.size);
        // Compiled once for every instruction set; the processor's own is chosen.
        let finite = dispatch!(Level::new(), simd => self.multiply(simd, input, output, &rows));
        if !finite {
            self.apply_not_finite(input, output);
        }
    }

    /// Tells whether all sums are finite.
    #[inline(always)]
    fn multiply<S: Simd>(
        &self,
        simd: S,
        input: &[f64],
        output: &mut [f64],
        rows: &Range<usize>,
    ) -> bool {
        let support = support(input);
        let mut zeros = [0.0; ROWS];
        let outputs = output.chunks_mut(ROWS).zip((0..).step_by(ROWS));
        for ((output, row), panel) in outputs.zip(&self.panels) {
            if row >= rows.end || row + ROWS <= rows.start {
                output.fill(0.0);
                continue;
            }
            let (at, columns) = panel.within(&support);
            let sums = sum_panel(simd, &self.entries[at], &input[columns]);
            for (zero, sum) in zeros.iter_mut().zip(&sums) {
                *zero += 0.0 * sum;
            }
            output.copy_from_slice(&sums[..output.len()]);
        }
        zeros == [0.0; ROWS]
    }

    /// Zero times a value that is not finite is no zero: it is passed on to the rows that have an entry
    /// for it, and not to all rows of their panels. Such a step fails: this need not be quick.
    fn apply_not_finite(&self, input: &[f64], output: &mut [f64]) {
        for ((output, panel), row) in output.iter_mut().zip(self.rows()).zip(0..) {
            let columns = &self.entries[panel.start..][..panel.columns.len()];
            let terms = columns.iter().zip(&input[panel.columns.clone()]);
            let seen = terms.filter(|(column, _)| column[row % ROWS] != 0.0);
            *output = seen.map(|(column, value)| column[row % ROWS] * value).sum();
        }
    }

    /// The panel of every row.
    fn rows(&self) -> impl Iterator<Item = &Panel> {
        (0..self.size).map(|row| &self.panels[row / ROWS])
    }

    /// The operator as a dense matrix, for eigenvalues and norms.
    pub fn to_dense(&self) -> DMatrix<f64> {
        let mut dense = DMatrix::zeros(self.size, self.size);
        for (row, panel) in self.rows().enumerate() {
            for (k, column) in panel.columns.clone().zip(&self.entries[panel.start..]) {
                dense[(row, k)] = column[row % ROWS];
            }
        }
        dense
    }

    /// Whether row j needs input from columns 0..=j only.
    pub fn looks_inwards_only(&self) -> bool {
        let dense = self.to_dense();
        dense == dense.lower_triangle()
    }

    /// Whether row j needs input from columns j.. only.
    pub fn looks_outwards_only(&self) -> bool {
        let dense = self.to_dense();
        dense == dense.upper_triangle()
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
    fn rows_that_are_asked_for_are_those_of_the_whole() {
        let dense = DMatrix::from_fn(40, 40, |i, j| if j <= i { (1 + i * j) as f64 } else { 0.0 });
        let packed = Staircase::pack(&dense);
        let input: Vec<f64> = (0..40).map(|j| (j as f64 * 1.7).sin()).collect();
        let mut whole = vec![f64::NAN; 40];
        packed.apply(&input, &mut whole);
        for rows in [0..40, 3..17, 16..24, 39..40, 5..5] {
            let mut part = vec![f64::NAN; 40];
            packed.apply_rows(&input, &mut part, rows.clone());
            assert_eq!(part[rows.clone()], whole[rows]);
            assert!(part.iter().all(|value| value.is_finite()));
        }
    }

    #[test]
    fn causality_is_read_off_the_columns() {
        let packed = Staircase::pack(&example());
        assert!(packed.looks_inwards_only());
        assert!(!packed.looks_outwards_only());
        assert!(Staircase::pack(&example().transpose()).looks_outwards_only());
    }
}

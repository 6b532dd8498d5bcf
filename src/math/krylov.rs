//! Solves the linear systems that are known by their products alone.
//!
//! # Formula
//!
//! GMRES: Y. Saad, M. H. Schultz (1986), SIAM J. Sci. Stat. Comput. 7, 856–869, doi 10.1137/0907058. An orthonormal basis
//! of b, Bb, B²b, … in which |b − Bx| is least, one product a vector; the least squares are solved by rotations as
//! the basis grows.

use super::quadrature::weighted;

/// The x with |b − Bx| ≤ `tolerance` |b|, or the best one of `most` products; `product` writes B times its first argument
/// into its second.
pub fn solve(
    b: &[f64],
    tolerance: f64,
    most: usize,
    mut product: impl FnMut(&[f64], &mut [f64]),
) -> Vec<f64> {
    let size = norm(b);
    let mut x = vec![0.0; b.len()];
    if size == 0.0 || !size.is_finite() {
        return x;
    }
    let mut basis = vec![b.iter().map(|b| b / size).collect::<Vec<f64>>()];
    // The columns of the triangular factor, the rotations, and what is left of |b| e₁.
    let (mut columns, mut rotations, mut rest) = (Vec::<Vec<f64>>::new(), Vec::new(), vec![size]);
    while columns.len() < most && rest[columns.len()].abs() > tolerance * size {
        let mut next = vec![0.0; b.len()];
        product(&basis[columns.len()], &mut next);
        let mut column = Vec::with_capacity(basis.len() + 1);
        for vector in &basis {
            let share = weighted(vector, &next);
            subtract(&mut next, share, vector);
            column.push(share);
        }
        let left = norm(&next);
        for (k, &(c, s)) in rotations.iter().enumerate() {
            (column[k], column[k + 1]) = (
                c * column[k] + s * column[k + 1],
                c * column[k + 1] - s * column[k],
            );
        }
        let k = columns.len();
        let length = column[k].hypot(left);
        let (c, s) = (column[k] / length, left / length);
        column[k] = length;
        rest.push(-s * rest[k]);
        rest[k] *= c;
        rotations.push((c, s));
        columns.push(column);
        if left <= f64::EPSILON * length {
            break;
        }
        next.iter_mut().for_each(|value| *value /= left);
        basis.push(next);
    }
    for k in (0..columns.len()).rev() {
        let share = rest[k] / columns[k][k];
        for (rest, entry) in rest.iter_mut().zip(&columns[k][..k]) {
            *rest -= share * entry;
        }
        subtract(&mut x, -share, &basis[k]);
    }
    x
}

fn norm(values: &[f64]) -> f64 {
    weighted(values, values).sqrt()
}

/// Takes `share` times `vector` from `values`.
fn subtract(values: &mut [f64], share: f64, vector: &[f64]) {
    for (value, part) in values.iter_mut().zip(vector) {
        *value -= share * part;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A matrix that is neither symmetric nor small, but near one.
    fn product(x: &[f64], out: &mut [f64]) {
        for (j, out) in out.iter_mut().enumerate() {
            let row = x.iter().enumerate();
            let far = |k: usize| (1.0 + j as f64).recip() / (1.0 + k as f64);
            *out = x[j] * (2.0 + (j % 3) as f64) + row.map(|(k, x)| far(k) * x).sum::<f64>();
        }
    }

    #[test]
    fn the_residual_is_as_small_as_asked_for() {
        let b: Vec<f64> = (0..40).map(|j| f64::from(j).sin()).collect();
        for tolerance in [1e-1, 1e-4, 1e-10] {
            let mut products = 0;
            let x = solve(&b, tolerance, 40, |x, out| {
                products += 1;
                product(x, out);
            });
            let mut rest = vec![0.0; 40];
            product(&x, &mut rest);
            subtract(&mut rest, 1.0, &b);
            assert!(norm(&rest) <= 1.01 * tolerance * norm(&b), "{tolerance}");
            assert!(products <= 12, "{products}");
        }
    }

    #[test]
    fn nothing_solves_nothing() {
        let x = solve(&[0.0; 3], 1e-3, 10, |_, _| panic!("no product is needed"));
        assert_eq!(x, [0.0; 3]);
    }
}

//! Solves systems of three diagonals.

/// The factors of a matrix with the diagonals `below`, `own` and `above`, row by row: what a row has of the one before it
/// is taken from it (L. H. Thomas 1949).
#[derive(Debug, Clone)]
pub struct Tridiagonal {
    below: Vec<f64>,
    inverse: Vec<f64>,
    above: Vec<f64>,
}

impl Tridiagonal {
    /// Factors the matrix; none of its leading minors may vanish.
    pub fn new(rows: impl Iterator<Item = [f64; 3]>) -> Self {
        let (mut below, mut inverse, mut above) = (Vec::new(), Vec::new(), Vec::new());
        let mut before = 0.0;
        for [left, own, right] in rows {
            let pivot = (own - left * before).recip();
            before = right * pivot;
            below.push(left);
            inverse.push(pivot);
            above.push(before);
        }
        Self {
            below,
            inverse,
            above,
        }
    }

    /// Makes the right side `x` into the solution.
    pub fn solve(&self, x: &mut [f64]) {
        let mut before = 0.0;
        for (x, (below, inverse)) in x.iter_mut().zip(self.below.iter().zip(&self.inverse)) {
            before = (*x - below * before) * inverse;
            *x = before;
        }
        let mut behind = 0.0;
        for (x, above) in x.iter_mut().zip(&self.above).rev() {
            behind = *x - above * behind;
            *x = behind;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_solution_gives_back_its_right_side() {
        let rows = [
            [0.0, 4.0, 1.0],
            [-1.0, 3.0, 2.0],
            [0.5, 2.0, -1.0],
            [1.0, 5.0, 0.0],
        ];
        let right = [1.0, -2.0, 3.0, 0.5];
        let mut x = right.to_vec();
        Tridiagonal::new(rows.into_iter()).solve(&mut x);
        for (j, [below, own, above]) in rows.into_iter().enumerate() {
            let at = |k: Option<usize>| k.and_then(|k| x.get(k)).copied().unwrap_or_default();
            let sum = below * at(j.checked_sub(1)) + own * x[j] + above * at(Some(j + 1));
            assert!((sum - right[j]).abs() < 1e-14, "{j}: {sum}");
        }
    }
}

//! The error of nodal results against theory: node by node, the largest, and the root mean square.

use crate::math::quadrature::trapezoid;

/// Errors at the nodes of one result, all non-negative.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct NodalErrors {
    /// r/a of the compared nodes.
    pub radii: Vec<f64>,
    /// The error at each.
    pub errors: Vec<f64>,
    /// r/a of the nodes where theory is infinite, or where it is 0 and the error relative to it.
    pub left_out: Vec<f64>,
    /// Whether [`rms`](Self::rms) averages over the radius instead
    /// of the nodes: fair between grids with different node spacing.
    pub over_radius: bool,
}

/// A node: r/a, result and theory.
pub type NodeSample = (f64, f64, f64);

impl NodalErrors {
    /// Computes |result − theory|/`unit`, or relative to theory without a unit, as in the paper's Fig. 2.
    pub fn new(unit: Option<f64>, samples: impl Iterator<Item = NodeSample>) -> Self {
        let mut all = Self::default();
        for (r, result, theory) in samples {
            let unit = unit.unwrap_or(theory.abs());
            if theory.is_finite() && unit > 0.0 {
                all.radii.push(r);
                all.errors.push((result - theory).abs() / unit);
            } else {
                all.left_out.push(r);
            }
        }
        all
    }

    /// Returns the largest error; NaN if any is NaN.
    pub fn max(&self) -> f64 {
        let larger = |worst: f64, &e: &f64| if e > worst || e.is_nan() { e } else { worst };
        self.errors.iter().fold(0.0, larger)
    }

    /// Returns the root mean square, over the nodes or over the radius.
    pub fn rms(&self) -> f64 {
        let squares: Vec<f64> = self.errors.iter().map(|e| e * e).collect();
        match (self.radii.first(), self.radii.last()) {
            (Some(first), Some(last)) if self.over_radius && last > first => {
                (trapezoid(&self.radii, &squares) / (last - first)).sqrt()
            }
            _ => (squares.iter().sum::<f64>() / squares.len() as f64).sqrt(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_without_a_measure_are_left_out_and_nan_is_seen() {
        let samples = [
            (0.0, 0.1, 0.0),
            (0.5, 1.5, 1.0),
            (0.8, 1.0, 1.0),
            (1.0, 3.0, f64::INFINITY),
        ];
        let errors = NodalErrors::new(None, samples.into_iter());
        assert_eq!(errors.left_out, [0.0, 1.0]);
        assert_eq!((errors.max(), errors.rms()), (0.5, 0.125f64.sqrt()));
        let errors = NodalErrors::new(Some(2.0), samples.into_iter());
        assert_eq!(errors.errors, [0.05, 0.25, 0.0]);
        let broken = [(0.1, f64::NAN, 1.0), (0.2, 1.0, 1.0)];
        assert!(NodalErrors::new(None, broken.into_iter()).max().is_nan());
    }
}

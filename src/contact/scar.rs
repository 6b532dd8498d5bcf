//! A measured scar: the worn depth over the radius at the start of a run.

use std::sync::Arc;

use crate::math::grid;
use crate::math::invalid::{Invalid, check_table, non_negative};

/// Minimum and maximum number of points.
const FEWEST: usize = 3;
const MOST: usize = 100_000;

/// A worn depth f − f₀ over r from a table; cheap to clone.
#[derive(Debug, Clone, PartialEq)]
pub struct Scar {
    radii: Arc<[f64]>,
    depths: Arc<[f64]>,
}

impl Scar {
    /// Makes a scar from radii (m, strictly increasing, 0 or greater) and as many depths (m, 0 or greater).
    ///
    /// # Errors
    /// If the rows do not form a scar; the fields are `initial_radii` and `initial_depths`.
    pub fn new(radii: &[f64], depths: &[f64]) -> Result<Self, Invalid> {
        let columns = ["initial_radii", "initial_depths"];
        check_table((columns[0], radii), (columns[1], depths), FEWEST..=MOST)?;
        non_negative(columns[0], radii[0])?;
        for &depth in depths {
            non_negative(columns[1], depth)?;
        }
        Ok(Self {
            radii: radii.into(),
            depths: depths.into(),
        })
    }

    /// Returns the worn depth at `r`, m: linear in r² between the points, as wear is between nodes; constant inside the
    /// first point, and 0 outside the last one.
    pub fn depth(&self, r: f64) -> f64 {
        if r > self.last_radius() {
            return 0.0;
        }
        grid::interpolate(&self.radii, &self.depths, r)
    }

    /// Returns the greatest depth, m.
    pub fn deepest(&self) -> f64 {
        self.depths.iter().copied().fold(0.0, f64::max)
    }

    /// Returns the first radius from which on nothing is worn, m; the last radius if that is worn as well.
    pub fn edge(&self) -> f64 {
        let last = self.depths.iter().rposition(|&depth| depth > 0.0);
        let edge = last.map_or(0, |last| (last + 1).min(self.radii.len() - 1));
        self.radii[edge]
    }

    /// Returns the last radius of the table, m, and the depth there, m.
    pub fn end(&self) -> (f64, f64) {
        (self.last_radius(), self.depths[self.depths.len() - 1])
    }

    fn last_radius(&self) -> f64 {
        self.radii[self.radii.len() - 1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn depths_lie_between_the_points_and_nothing_is_worn_outside() {
        let scar = Scar::new(&[1.0, 2.0, 3.0, 4.0], &[0.2, 0.5, 0.0, 0.0]).expect("a scar");
        assert_eq!(scar.depth(0.0), 0.2);
        assert_eq!(scar.depth(2.0), 0.5);
        assert!((scar.depth(2.5f64.sqrt()) - 0.35).abs() < 1e-15);
        assert_eq!((scar.depth(3.5), scar.depth(9.0)), (0.0, 0.0));
        assert_eq!(
            (scar.deepest(), scar.edge(), scar.end()),
            (0.5, 3.0, (4.0, 0.0))
        );
        let cut = Scar::new(&[0.0, 1.0, 2.0], &[0.0, 0.1, 0.3]).expect("a scar");
        assert_eq!((cut.edge(), cut.end()), (2.0, (2.0, 0.3)));
    }

    #[test]
    fn rows_that_are_no_scar_are_refused() {
        let field = |radii: &[f64], depths: &[f64]| Scar::new(radii, depths).map_err(|e| e.field);
        assert!(field(&[0.0, 1.0, 2.0], &[0.0; 3]).is_ok());
        for radii in [[0.0, 1.0, 1.0], [-1.0, 0.0, 1.0], [0.0, f64::NAN, 1.0]] {
            assert_eq!(field(&radii, &[0.0; 3]), Err("initial_radii"));
        }
        assert_eq!(field(&[0.0, 1.0], &[0.0; 2]), Err("initial_radii"));
        assert_eq!(field(&[0.0, 1.0, 2.0], &[0.0; 2]), Err("initial_depths"));
        assert_eq!(
            field(&[0.0, 1.0, 2.0], &[0.0, -1e-9, 0.0]),
            Err("initial_depths")
        );
    }
}

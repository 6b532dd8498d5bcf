//! A loop as two functions of the displacement.

use crate::math::scan::value_at;

/// Returns the points of a closed loop at which its motion turns: at the least and the largest displacement.
fn turns(displacements: &[f64]) -> Option<[usize; 2]> {
    let by_value = |a: &usize, b: &usize| displacements[*a].total_cmp(&displacements[*b]);
    let points = 0..displacements.len();
    Some([points.clone().min_by(by_value)?, points.max_by(by_value)?])
}

/// Returns which points of a closed loop belong to the rising stroke, from its least displacement to its largest.
pub fn rises(displacements: &[f64]) -> Vec<bool> {
    let [least, most] = turns(displacements).unwrap_or_default();
    let rises = |i: usize| {
        if least <= most {
            (least..=most).contains(&i)
        } else {
            i >= least || i <= most
        }
    };
    (0..displacements.len()).map(rises).collect()
}

/// A loop as two functions of the displacement: the stroke there and the stroke back.
#[derive(Debug, Clone, PartialEq)]
pub struct Strokes {
    /// u and F of the rising stroke, in order of time.
    rising: (Vec<f64>, Vec<f64>),
    /// u and F of the falling stroke.
    falling: (Vec<f64>, Vec<f64>),
    /// The least and the largest displacement.
    pub ends: [f64; 2],
}

impl Strokes {
    /// Splits a closed loop of displacements and forces into strokes; `None` without a point.
    pub fn new(points: &[(f64, f64)]) -> Option<Self> {
        let displacements: Vec<f64> = points.iter().map(|point| point.0).collect();
        let [least, most] = turns(&displacements)?;
        // Both strokes share the points at which the motion turns.
        let stroke = |from: usize, to: usize| {
            let count = (to + points.len() - from) % points.len();
            let round = (from..=from + count).map(|i| points[i % points.len()]);
            round.unzip()
        };
        Some(Self {
            rising: stroke(least, most),
            falling: stroke(most, least),
            ends: [displacements[least], displacements[most]],
        })
    }

    /// Returns the force at a displacement on one of the strokes; constant beyond their ends.
    pub fn force(&self, displacement: f64, rising: bool) -> f64 {
        let (shifts, forces) = if rising { &self.rising } else { &self.falling };
        let [least, most] = self.ends;
        value_at(shifts, forces, displacement.clamp(least, most)).unwrap_or(f64::NAN)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strokes_are_distinguished_and_interpolated() {
        // An ellipse-like loop that begins in the middle of its rising stroke.
        let points: Vec<(f64, f64)> = (0..400)
            .map(|i| std::f64::consts::TAU * f64::from(i) / 400.0)
            .map(|t| (t.sin(), (t + 0.5).sin()))
            .collect();
        let strokes = Strokes::new(&points).expect("strokes");
        for u in [-0.9f64, -0.2, 0.0, 0.6] {
            let t = u.asin();
            let back = std::f64::consts::PI - t;
            assert!((strokes.force(u, true) - (t + 0.5).sin()).abs() < 1e-3);
            assert!((strokes.force(u, false) - (back + 0.5).sin()).abs() < 1e-3);
        }
        assert_eq!(strokes.force(5.0, true), strokes.force(5.0, false));
    }
}

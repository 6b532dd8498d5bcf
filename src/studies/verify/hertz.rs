//! The three transforms, each of exact data, on the paraboloid of the paper's Fig. 2 with a = d = R = E* = 1.

use super::errors::NodalErrors;
use super::exact;
use crate::math::abel::{AbelMethod, AbelPlan};
use crate::math::grid::RadialGrid;

/// Computes errors of g by Eq. (1), of p by Eq. (3) and of w by Eq. (2), relative to theory.
pub fn transforms(method: AbelMethod, points: usize) -> Vec<NodalErrors> {
    type Transform = fn(&AbelPlan, &[f64], &mut [f64]);
    type Curve = fn(f64) -> f64;
    let grid = RadialGrid::uniform(points, 1.0).expect("a grid");
    let plan = AbelPlan::new(method, &grid);
    let errors = |transform: Transform, source: Curve, theory: Curve| {
        let nodes = grid.nodes();
        let source: Vec<f64> = nodes.iter().map(|&r| source(r)).collect();
        let mut image = vec![f64::NAN; source.len()];
        transform(&plan, &source, &mut image);
        let samples = nodes.iter().zip(&image);
        NodalErrors::new(None, samples.map(|(&r, &value)| (r, value, theory(r))))
    };
    let load = |x: f64| 1.0 - x * x;
    vec![
        errors(AbelPlan::profile, |r| 0.5 * r * r, |x| x * x),
        errors(AbelPlan::stress, load, |r| exact::pressure(1.0, r)),
        errors(AbelPlan::displacement, load, |r| 1.0 - 0.5 * r * r),
    ]
}

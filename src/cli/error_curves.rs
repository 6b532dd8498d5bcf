//! Curves of the error over r/a, drawn as text: a small plot per method, all on the same axes, so
//! that they can be compared without colour.
//!
//! ```text
//! a: g, N = 800                          b: g, N = 800
//! 1e-1 ┤⡀                                1e-1 ┤⡀
//! 1e-3 ┤⠈⠒⠤⢄⣀⣀⣀⣀⣀⣀⣀⣀                     1e-3 ┤⠈⠒⠤⢄⣀⣀⣀⣀⣀⣀⣀⣀
//!      0               1                      0               1   r/a
//! ```

use super::small_multiples;
use crate::math::abel::AbelMethod;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve, Marker, Scale};
use crate::studies::verify::{Outcome, Problem, STICK_RADIUS};

/// The plots of one problem, all its quantities below each other: of each method on its finest grid.
pub fn draw(problem: Problem, outcomes: &[Outcome], marker: Marker) -> String {
    let mut text = String::new();
    for (at, quantity) in problem.facts().quantities.iter().enumerate() {
        let chart = |method| {
            let tried = |o: &&Outcome| o.task.problem == problem && o.task.method == method;
            let (points, errors) = outcomes
                .iter()
                .filter(tried)
                .filter_map(|o| Some((o.task.points, o.errors.as_ref().ok()?.get(at)?)))
                .max_by_key(|(points, _)| *points)?;
            let name = format!("{method}: {}, N = {points}", quantity);
            let y = Axis::new(name, "").scale(Scale::Log);
            let (radii, values) = (errors.radii.clone(), errors.errors.clone());
            let curve = Curve::new("", radii, values, Role::Profile);
            Some(Chart::new("", Axis::new("r/a", ""), y).curve(curve))
        };
        if *quantity != STICK_RADIUS {
            let charts = AbelMethod::ALL.into_iter().filter_map(chart);
            text.push_str(&small_multiples::draw_alike(charts.collect(), marker));
        }
    }
    text
}

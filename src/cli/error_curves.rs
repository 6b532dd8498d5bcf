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
use crate::studies::verify::errors::Errors;
use crate::studies::verify::{Outcome, Problem};

/// The smallest error drawn; anything below is rounding.
const FLOOR: f64 = 1e-17;

/// A method's errors of one quantity on its finest grid.
struct Facet<'a> {
    name: String,
    errors: &'a Errors,
}

/// The plots of one problem, all its quantities below each other.
pub fn draw(problem: Problem, outcomes: &[Outcome], marker: Marker) -> String {
    let mut text = String::new();
    for (at, quantity) in problem.quantities().iter().enumerate() {
        if quantity.single {
            continue;
        }
        let facets: Vec<Facet> = AbelMethod::ALL
            .into_iter()
            .filter_map(|method| facet(problem, method, at, quantity.name, outcomes))
            .collect();
        let Some(bounds) = bounds(&facets) else {
            continue;
        };
        let charts = facets.iter().map(|facet| facet.chart(bounds));
        let charts: Vec<Chart> = charts.collect();
        text.push_str(&small_multiples::draw(&charts, marker));
    }
    text
}

fn facet<'a>(
    problem: Problem,
    method: AbelMethod,
    at: usize,
    quantity: &str,
    outcomes: &'a [Outcome],
) -> Option<Facet<'a>> {
    let mine = outcomes
        .iter()
        .filter(|o| o.task.problem == problem && o.task.method == method);
    let (points, errors) = mine
        .filter_map(|o| Some((o.task.points, o.errors.as_ref().ok()?)))
        .max_by_key(|(points, _)| *points)?;
    Some(Facet {
        name: format!("{method}: {quantity}, N = {points}"),
        errors: &errors[at],
    })
}

/// Ends of the r/a axis and of the error axis, full decades.
type Bounds = [[f64; 2]; 2];

/// Axes that fit all facets; `None` if every error is zero.
fn bounds(facets: &[Facet]) -> Option<Bounds> {
    let all = facets.iter().flat_map(|facet| &facet.errors.errors);
    let errors = small_multiples::decades(all.copied().filter(|error| *error > FLOOR))?;
    let radii = facets.iter().flat_map(|facet| &facet.errors.radii);
    let end = radii.copied().fold(0.0, f64::max);
    Some([[0.0, end], errors])
}

impl Facet<'_> {
    fn chart(&self, [radii, errors]: Bounds) -> Chart {
        let x = Axis::new("r/a", "").bounds(radii);
        let y = Axis::new(self.name.clone(), "");
        let (radii, values) = (self.errors.radii.clone(), self.errors.errors.clone());
        Chart::new("", x, y.bounds(errors).scale(Scale::Log)).curve(Curve::new(
            "",
            radii,
            values,
            Role::Profile,
        ))
    }
}

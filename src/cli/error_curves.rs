//! Curves of the error over r/a, drawn as text: a small plot for each method, all of a quantity on
//! the same axes, so that they can be told apart and compared without colour.
//!
//! ```text
//! a: g, N = 800                          b: g, N = 800
//! 1e-1 ┤⡀                                1e-1 ┤⡀
//! 1e-3 ┤⠈⠒⠤⢄⣀⣀⣀⣀⣀⣀⣀⣀                     1e-3 ┤⠈⠒⠤⢄⣀⣀⣀⣀⣀⣀⣀⣀
//!      0               1                      0               1   r/a
//! ```

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::widgets::Widget;

use crate::math::abel::AbelMethod;
use crate::studies::verify::errors::Errors;
use crate::studies::verify::{Outcome, Problem};
use crate::tui::plot::{Axis, Curve, Marker, Plot, Scale};

/// Cells of one plot.
const SIZE: (u16, u16) = (39, 11);

/// Columns between two plots.
const GAP: u16 = 2;

/// Plots beside each other.
const ACROSS: usize = 2;

/// The least error that is drawn: smaller ones are rounding.
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
        for row in facets.chunks(ACROSS) {
            text.push('\n');
            text.push_str(&row_of(row, bounds, marker));
        }
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

/// What holds all facets; none where every error is zero.
fn bounds(facets: &[Facet]) -> Option<Bounds> {
    let all = || facets.iter().flat_map(|facet| &facet.errors.errors);
    let seen = all().copied().filter(|e| e.is_finite() && *e > FLOOR);
    let (least, most) = seen.fold((f64::INFINITY, 0.0), |(a, b): (f64, f64), e| {
        (a.min(e), b.max(e))
    });
    if most == 0.0 {
        return None;
    }
    let radii = facets.iter().flat_map(|facet| &facet.errors.radii);
    let end = radii.copied().fold(0.0, f64::max);
    let decade = |log: f64| 10f64.powf(log);
    let mut ends = [least.log10().floor(), most.log10().ceil()];
    if ends[1] <= ends[0] {
        ends[1] = ends[0] + 1.0;
    }
    Some([[0.0, end], ends.map(decade)])
}

/// Plots beside each other.
fn row_of(facets: &[Facet], [radii, errors]: Bounds, marker: Marker) -> String {
    let (width, height) = SIZE;
    let mut buffer = Buffer::empty(Rect::new(0, 0, (width + GAP) * ACROSS as u16, height));
    for (at, facet) in facets.iter().enumerate() {
        let area = Rect::new(at as u16 * (width + GAP), 0, width, height);
        let curve = Curve::new("", &facet.errors.radii, &facet.errors.errors, Style::new());
        Plot::new(
            Axis::new("r/a", "").bounds(radii),
            Axis::new(&facet.name, "").bounds(errors).scale(Scale::Log),
        )
        .curve(curve)
        .marker(marker)
        .render(area, &mut buffer);
    }
    let mut text = String::new();
    for row in buffer.area.rows() {
        let line: String = row.positions().map(|at| buffer[at].symbol()).collect();
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

//! Normal contact: g, p and w of shapes whose contact radius is a = 1.

use std::f64::consts::PI;

use super::errors::{Errors, Sample};
use super::scene::{grid, pressed};
use crate::contact::indenter::Indenter;
use crate::math::abel::{AbelMethod, AbelPlan};
use crate::math::grid::RadialGrid;
use crate::oracle::flat_punch::FlatPunch;
use crate::oracle::power_law::PowerLaw;
use crate::oracle::truncated::TruncatedParaboloid;

use crate::simulation::{Breakdown, Simulation};

/// Returns L/a, about 1.5, and an inner radius over a, about a half, of a grid of N = `points`. The contact
/// radius a = 1 and the inner radius, the border c of the stick zone or the rim b of a flat tip, both lie a third
/// of a cell outside a node: otherwise an error that depends on the place within the cell would hide the order.
pub fn between_nodes(points: usize) -> (f64, f64) {
    let cells = |whole: usize| whole as f64 + 1.0 / 3.0;
    let contact = cells(2 * points / 3);
    (points as f64 / contact, cells(points / 3) / contact)
}

/// d, the mean pressure, and f, g and p at nodes, in closed form for a = E* = 1.
struct Exact {
    depth: f64,
    mean_pressure: f64,
    f: Vec<f64>,
    g: Vec<f64>,
    p: Vec<f64>,
}

impl Exact {
    fn power_law(shape: PowerLaw, grid: &RadialGrid) -> Self {
        let depth = shape.depth(1.0);
        Self {
            depth,
            mean_pressure: shape.force(1.0, depth) / PI,
            f: over(grid.nodes(), |r| shape.profile(r)),
            g: over(grid.nodes(), |x| shape.mdr_profile(x)),
            p: over(grid.nodes(), |r| shape.pressure(1.0, 1.0, r)),
        }
    }

    fn truncated(shape: TruncatedParaboloid, grid: &RadialGrid) -> Self {
        Self {
            depth: shape.depth(1.0),
            mean_pressure: shape.force(1.0) / PI,
            f: over(grid.nodes(), |r| shape.profile(r)),
            g: over(grid.nodes(), |x| shape.mdr_profile(x)),
            p: over(grid.nodes(), |r| shape.pressure(1.0, r)),
        }
    }

    /// Computes the errors of g from the exact f, of p from the exact q = d − g with E* = 1 (or by simulating an
    /// indenter), and of w from the exact u: relative to theory, or in d and in the mean pressure.
    fn errors(
        &self,
        method: AbelMethod,
        grid: &RadialGrid,
        indenter: Option<Indenter>,
        is_relative: bool,
    ) -> Result<Vec<Errors>, Breakdown> {
        let plan = AbelPlan::new(method, grid);
        let transform = |source: &[f64], apply: fn(&AbelPlan, &[f64], &mut [f64])| {
            let mut out = vec![f64::NAN; source.len()];
            apply(&plan, source, &mut out);
            out
        };
        let pressed = |profile: &Vec<f64>| -> Vec<f64> {
            profile.iter().map(|depth| self.depth - depth).collect()
        };
        let compression: Vec<f64> = pressed(&self.g).iter().map(|u| u.max(0.0)).collect();
        let profile = transform(&self.f, AbelPlan::profile);
        let pressure = match indenter {
            Some(indenter) => simulated(method, grid, indenter, self.depth)?,
            None => transform(&compression, AbelPlan::stress),
        };
        let displacement = transform(&compression, AbelPlan::displacement);
        let all = [
            (self.depth, profile, &self.g),
            (self.mean_pressure, pressure, &self.p),
            (self.depth, displacement, &pressed(&self.f)),
        ];
        let errors = all.map(|(unit, values, theory)| {
            let unit = (!is_relative).then_some(unit);
            Errors::new(unit, inside(grid, &values, theory))
        });
        Ok(errors.into())
    }
}

/// Returns node, result and theory at the nodes up to a = 1.
fn inside(grid: &RadialGrid, values: &[f64], theory: &[f64]) -> impl Iterator<Item = Sample> {
    let nodes = grid.nodes().iter().zip(values).zip(theory);
    let samples = nodes.map(|((&r, &value), &theory)| (r, value, theory));
    samples.take_while(|(r, ..)| *r <= 1.0)
}

/// Computes p by the simulation, which has to find the edges.
fn simulated(
    method: AbelMethod,
    grid: &RadialGrid,
    indenter: Indenter,
    depth: f64,
) -> Result<Vec<f64>, Breakdown> {
    let setup = pressed(method, grid.clone(), indenter, depth);
    Ok(Simulation::new(setup)?.pressure())
}

/// The paraboloid of the paper's Fig. 2.
pub fn hertz(method: AbelMethod, points: usize) -> Result<Vec<Errors>, Breakdown> {
    let grid = grid(points, 1.0);
    Exact::power_law(PowerLaw::paraboloid(1.0), &grid).errors(method, &grid, None, true)
}

/// A cone of slope 1.
pub fn cone(method: AbelMethod, points: usize) -> Result<Vec<Errors>, Breakdown> {
    let grid = grid(points, 1.0);
    Exact::power_law(PowerLaw::cone(1.0), &grid).errors(method, &grid, None, false)
}

/// f = r⁴, with the edge between nodes.
pub fn quartic(method: AbelMethod, points: usize) -> Result<Vec<Errors>, Breakdown> {
    let grid = grid(points, between_nodes(points).0);
    let exact = Exact::power_law(PowerLaw::quartic(1.0), &grid);
    let indenter = Indenter::power(1.0, 4.0).expect("a shape");
    exact.errors(method, &grid, Some(indenter), false)
}

/// R = 1, b about a/2, with both edges between nodes.
pub fn truncated_paraboloid(method: AbelMethod, points: usize) -> Result<Vec<Errors>, Breakdown> {
    let (domain, inner) = between_nodes(points);
    let grid = grid(points, domain);
    let shape = TruncatedParaboloid {
        e_star: 1.0,
        radius: 1.0,
        tip_radius: inner,
    };
    let exact = Exact::truncated(shape, &grid);
    let indenter = Indenter::truncated_paraboloid(1.0, inner).expect("a shape");
    exact.errors(method, &grid, Some(indenter), false)
}

/// a = d = 1.
pub fn flat_punch(method: AbelMethod, points: usize) -> Result<Vec<Errors>, Breakdown> {
    let grid = grid(points, 1.0);
    let punch = FlatPunch {
        e_star: 1.0,
        g_star: 1.0,
        mu: 0.0,
        radius: 1.0,
        depth: 1.0,
    };
    let indenter = Indenter::flat_punch(1.0).expect("a shape");
    let pressure = simulated(method, &grid, indenter, punch.depth)?;
    let theory = over(grid.nodes(), |r| punch.pressure(r));
    let samples = inside(&grid, &pressure, &theory);
    Ok(vec![Errors::new(Some(punch.force() / PI), samples)])
}

/// Evaluates a function at every radius.
fn over(radii: &[f64], value: impl Fn(f64) -> f64) -> Vec<f64> {
    radii.iter().map(|&r| value(r)).collect()
}

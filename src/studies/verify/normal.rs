//! Normal contact: g, p and w of shapes whose contact radius is a = 1.

use std::f64::consts::PI;

use super::Stop;
use super::errors::Errors;
use super::scene::Scene;
use crate::contact::indenter::Indenter;
use crate::math::abel::{AbelMethod, AbelPlan};
use crate::math::grid::RadialGrid;
use crate::oracle::flat_punch::FlatPunch;
use crate::oracle::power_law::PowerLaw;
use crate::oracle::truncated;
use crate::reading::Curves;
use crate::simulation::Simulation;

/// A grid on which the contact radius a = 1 and an inner radius of about a/2, the border c of the
/// stick zone or the rim b of a flat tip, both lie a third of a cell outside a node, for every N: an
/// error that depends on the place within the cell would else hide the order.
pub struct Between {
    /// L/a, about 1.5.
    pub domain: f64,
    /// The inner radius over a.
    pub inner: f64,
}

impl Between {
    /// For N = `points`.
    pub fn nodes(points: usize) -> Self {
        let cells = |whole: usize| whole as f64 + 1.0 / 3.0;
        let contact = cells(2 * points / 3);
        Self {
            domain: points as f64 / contact,
            inner: cells(points / 3) / contact,
        }
    }
}

type Function = Box<dyn Fn(f64) -> f64>;

/// f, g and p in closed form, for a = E* = 1.
struct Exact {
    depth: f64,
    mean_pressure: f64,
    f: Function,
    g: Function,
    p: Function,
}

impl Exact {
    fn power_law(shape: PowerLaw) -> Self {
        let depth = shape.depth(1.0);
        Self {
            depth,
            mean_pressure: shape.force(1.0, depth) / PI,
            f: Box::new(move |r| shape.profile(r)),
            g: Box::new(move |x| shape.mdr_profile(x)),
            p: Box::new(move |r| shape.pressure(1.0, 1.0, r)),
        }
    }

    fn truncated(shape: truncated::TruncatedParaboloid) -> Self {
        Self {
            depth: shape.depth(1.0),
            mean_pressure: shape.force(1.0) / PI,
            f: Box::new(move |r| shape.profile(r)),
            g: Box::new(move |x| shape.mdr_profile(x)),
            p: Box::new(move |r| shape.pressure(1.0, r)),
        }
    }
}

/// The transforms of exact data, each at the nodes of the contact.
struct Transforms {
    exact: Exact,
    grid: RadialGrid,
    plan: AbelPlan,
}

impl Transforms {
    fn new(exact: Exact, method: AbelMethod, points: usize, domain: f64) -> Result<Self, Stop> {
        let grid = RadialGrid::uniform(points, domain)?;
        let plan = AbelPlan::new(method, &grid);
        Ok(Self { exact, grid, plan })
    }

    fn nodal(&self, source: impl Fn(f64) -> f64) -> Vec<f64> {
        self.grid.nodes().iter().map(|&x| source(x)).collect()
    }

    fn buffer(&self) -> Vec<f64> {
        vec![f64::NAN; self.grid.len()]
    }

    fn profile(&self) -> Vec<f64> {
        let mut out = self.buffer();
        self.plan.profile(&self.nodal(&self.exact.f), &mut out);
        out
    }

    /// d − g where that is positive: q with E* = 1, and u.
    fn compression(&self) -> Vec<f64> {
        self.nodal(|x| (self.exact.depth - (self.exact.g)(x)).max(0.0))
    }

    fn stress(&self) -> Vec<f64> {
        let mut out = self.buffer();
        self.plan.stress(&self.compression(), &mut out);
        out
    }

    fn displacement(&self) -> Vec<f64> {
        let mut out = self.buffer();
        self.plan.displacement(&self.compression(), &mut out);
        out
    }

    fn w(&self, r: f64) -> f64 {
        self.exact.depth - (self.exact.f)(r)
    }

    /// Errors of g, p and w in d and in the mean pressure.
    fn errors(&self, pressure: &[f64]) -> Vec<Errors> {
        let (exact, nodes) = (&self.exact, self.grid.nodes());
        vec![
            Errors::in_units_of(exact.depth, inside(nodes, &self.profile(), &exact.g)),
            Errors::in_units_of(exact.mean_pressure, inside(nodes, pressure, &exact.p)),
            Errors::in_units_of(
                exact.depth,
                inside(nodes, &self.displacement(), |r| self.w(r)),
            ),
        ]
    }
}

/// Node, result and theory at the nodes up to a = 1.
fn inside(
    nodes: &[f64],
    values: &[f64],
    theory: impl Fn(f64) -> f64,
) -> impl Iterator<Item = (f64, f64, f64)> {
    let pairs = nodes.iter().zip(values);
    pairs
        .take_while(|(r, _)| **r <= 1.0)
        .map(move |(&r, &value)| (r, value, theory(r)))
}

/// The paraboloid of the paper's Fig. 2.
pub fn hertz(method: AbelMethod, points: usize) -> Result<Vec<Errors>, Stop> {
    let exact = Exact::power_law(PowerLaw::paraboloid(1.0));
    let case = Transforms::new(exact, method, points, 1.0)?;
    let nodes = case.grid.nodes();
    Ok(vec![
        Errors::relative(inside(nodes, &case.profile(), &case.exact.g)),
        Errors::relative(inside(nodes, &case.stress(), &case.exact.p)),
        Errors::relative(inside(nodes, &case.displacement(), |r| case.w(r))),
    ])
}

/// A cone of slope 1.
pub fn cone(method: AbelMethod, points: usize) -> Result<Vec<Errors>, Stop> {
    let exact = Exact::power_law(PowerLaw::cone(1.0));
    let case = Transforms::new(exact, method, points, 1.0)?;
    Ok(case.errors(&case.stress()))
}

/// f = r⁴.
pub fn quartic(method: AbelMethod, points: usize) -> Result<Vec<Errors>, Stop> {
    let exact = Exact::power_law(PowerLaw::quartic(1.0));
    between(exact, Indenter::power(1.0, 4.0)?, method, points)
}

/// R = 1, b about a/2.
pub fn truncated_paraboloid(method: AbelMethod, points: usize) -> Result<Vec<Errors>, Stop> {
    let tip_radius = Between::nodes(points).inner;
    let exact = Exact::truncated(truncated::TruncatedParaboloid {
        e_star: 1.0,
        radius: 1.0,
        tip_radius,
    });
    let indenter = Indenter::truncated_paraboloid(1.0, tip_radius)?;
    between(exact, indenter, method, points)
}

/// With the edges between nodes: p by the simulation, which has to find them.
fn between(
    exact: Exact,
    indenter: Indenter,
    method: AbelMethod,
    points: usize,
) -> Result<Vec<Errors>, Stop> {
    let domain = Between::nodes(points).domain;
    let scene = Scene::pressed(method, points, domain, indenter, exact.depth);
    let seen = Simulation::new(scene.setup()?)?.observe(Curves::PRESSURE);
    Ok(Transforms::new(exact, method, points, domain)?.errors(&seen.pressure))
}

/// a = d = 1.
pub fn flat_punch(method: AbelMethod, points: usize) -> Result<Vec<Errors>, Stop> {
    let punch = FlatPunch {
        e_star: 1.0,
        g_star: 1.0,
        mu: 0.0,
        radius: 1.0,
        depth: 1.0,
    };
    let scene = Scene::pressed(method, points, 1.0, Indenter::flat_punch(1.0)?, punch.depth);
    let seen = Simulation::new(scene.setup()?)?.observe(Curves::PRESSURE);
    let samples = inside(&seen.radii, &seen.pressure, |r| punch.pressure(r));
    Ok(vec![Errors::in_units_of(punch.force() / PI, samples)])
}

//! Where the border of the permanent stick zone will lie, known before the run, and the grid for it.
//!
//! Melan's theorem gives the depth g(c) at the border. Where the springs shake down in a first
//! cycle that is not yet periodic, they wear a little inside it, and the border ends up a little
//! further in: 0.416435 → 0.415865 a₀ for Fig. 3 of the paper at K = 1. A pilot run over one period
//! of the motion finds it. One node of the graded grid stands there, a hair inside: a node outside
//! would wear and drag the cell before it along.

use super::choices::{Integrator, Spacing};
use super::{Setup, Simulation};
use crate::math::grid::RadialGrid;

/// The fewest and the most cells of a pilot run, and its most steps a cycle.
const PILOT_CELLS: [usize; 2] = [64, 200];
const PILOT_STEPS: u32 = 200;

/// How far inside the border its node stands: in parts of the domain, in parts of the cell outside it,
/// and in parts of what wear has moved the border by, of which the pilot errs by 2 %. Were the node outside, it
/// would slip by a little once a cycle, and as it bears the highest pressure, by a multiple in each.
const INSIDE_DOMAIN: f64 = 2e-6;
const INSIDE_CELL: f64 = 0.02;
const INSIDE_MOVED: f64 = 0.05;

/// Whether a grid graded for `before` serves `after` as well.
pub(super) fn stays(before: &Setup, after: &Setup) -> bool {
    let alike = |setup: &Setup| {
        (
            setup.grid.cells(),
            setup.grid.radius().to_bits(),
            setup.spacing,
            setup.indenter,
            setup.drive,
        )
    };
    alike(before) == alike(after) && before.material == after.material
}

/// The same setup, its grid graded towards the stick border where it asks for that and where there
/// is one; uniform else. `from` is the run that goes on with it, if it is not a new one.
pub(super) fn graded(setup: &Setup, from: Option<&Simulation>) -> Setup {
    let uniform = uniform(setup);
    if setup.spacing == Spacing::Uniform {
        return uniform;
    }
    let graded = melan(&uniform).and_then(|(depth, unworn)| {
        let cells = uniform.grid.cells();
        let [fewest, most] = PILOT_CELLS;
        let of_pilot = cells.clamp(fewest, most);
        let first = with_border(&uniform, unworn, 0.0, of_pilot)?;
        let second = pilot(&first, from, depth)?;
        let second = with_border(&uniform, second, 0.0, of_pilot)?;
        let border = pilot(&second, from, depth)?;
        with_border(&uniform, border, unworn - border, cells)
    });
    graded.unwrap_or(uniform)
}

fn uniform(setup: &Setup) -> Setup {
    let grid = RadialGrid::uniform(setup.grid.cells(), setup.grid.radius());
    Setup {
        grid: grid.unwrap_or_else(|_| setup.grid.clone()),
        ..setup.clone()
    }
}

/// g at the border of the permanent stick zone, and the radius at which the unworn indenter has it.
fn melan(setup: &Setup) -> Option<(f64, f64)> {
    setup.wear?;
    let depth = setup
        .drive
        .shakedown_depth(setup.material.stick_ratio())
        .filter(|&depth| depth > 0.0)?;
    let (mut inside, mut outside) = (0.0, setup.grid.radius());
    if setup.indenter.profile_1d(outside) <= depth {
        return None;
    }
    while outside - inside > 1e-15 * setup.grid.radius() {
        let middle = 0.5 * (inside + outside);
        if middle == inside || middle == outside {
            break;
        }
        if setup.indenter.profile_1d(middle) < depth {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    Some((depth, outside))
}

/// A setup with `cells` cells and a node a hair inside `border`, which wear has `moved` inwards (m).
fn with_border(setup: &Setup, border: f64, moved: f64, cells: usize) -> Option<Setup> {
    let radius = setup.grid.radius();
    let rough = RadialGrid::graded(cells, border, radius).ok()?;
    let at = rough.border()?;
    let cell = rough.nodes()[at + 1] - rough.nodes()[at];
    let hair = f64::max(INSIDE_DOMAIN * radius, INSIDE_CELL * cell);
    let inside = border - hair.max(INSIDE_MOVED * moved);
    let grid = RadialGrid::graded(cells, inside, radius).ok()?;
    Some(Setup {
        grid,
        ..setup.clone()
    })
}

/// Runs one period and reads where g reaches `depth`: by a parabola in x² through the last three
/// nodes inside, which no longer wear.
fn pilot(setup: &Setup, from: Option<&Simulation>, depth: f64) -> Option<f64> {
    let setup = Setup {
        steps_per_cycle: setup.steps_per_cycle.min(PILOT_STEPS),
        integrator: Integrator::Direct,
        ..setup.clone()
    };
    let period = f64::from(super::cycles_to_settle(&setup.drive));
    let mut run = match from {
        None => {
            let state = super::State::new(setup.grid.len(), true);
            Simulation::resume(setup, state).ok()?
        }
        Some(simulation) => {
            let state = simulation.state_on(&setup);
            Simulation::resume(setup, state).ok()?
        }
    };
    run.advance_to(run.cycle() + period).ok()?;
    let (g, t) = (&run.workspace.g, run.setup.grid.squares());
    let k = g
        .iter()
        .position(|&g| g >= depth * (1.0 - 1e-7))?
        .checked_sub(1)?;
    if k < 2 {
        return None;
    }
    let slope = (g[k] - g[k - 1]) / (t[k] - t[k - 1]);
    let before = (g[k - 1] - g[k - 2]) / (t[k - 1] - t[k - 2]);
    let bend = (slope - before) / (t[k] - t[k - 2]);
    let mut square = t[k] + (depth - g[k]) / slope;
    for _ in 0..20 {
        square = t[k] + (depth - g[k]) / (slope + bend * (square - t[k - 1]));
    }
    let radius = square.sqrt();
    (radius.is_finite() && radius > 0.0 && radius < run.setup.grid.radius()).then_some(radius)
}

//! Makes the graded grid before the run, with cells where the wear will be.
//!
//! A pilot run finds out where that is. If there is no permanent stick zone known from prescribed displacements, cells
//! are [placed](super::placing) by the wear of its first two periods.
//!
//! Melan's theorem gives the depth g(c) at the border. If the springs shake down during a first cycle that is not yet
//! periodic, some wear occurs inside the border, which ends up slightly further in: 0.416435 → 0.415865 a₀ for Fig. 3
//! of the paper at K = 1. A pilot run over one period of the motion finds it. One node of the graded grid is placed
//! just inside: a node outside would wear and distort the cell before it.

use super::choices::{Integrator, Spacing};
use super::drive::Control;
use super::placing;
use super::unworn::Unworn;
use super::{Setup, Simulation};
use crate::math::grid::RadialGrid;

/// Minimum and maximum cells of a pilot run.
const PILOT_CELLS: [usize; 2] = [64, 200];

/// Maximum steps per cycle of the pilot run that finds the border.
const BORDER_STEPS: u32 = 200;

/// Periods, and steps per cycle, of the pilot run that places cells: the springs shake down during the first period.
/// The steps are independent of the run's, so that finer steps keep the same cells.
const SCAR_PERIODS: u32 = 2;
const SCAR_STEPS: u32 = 48;

/// Maximum number of steps of a pilot run, which still takes the minimum per cycle; sub-steps of stiff wear count too.
/// A pilot that needs more is abandoned: the run then begins on cells that need no pilot.
const PILOT_WORK: u32 = 20_000;
const FEWEST_STEPS: u32 = 24;

/// How far inside the border its node lies: as a fraction of the domain, of the cell outside it, and of the distance by
/// which wear has moved the border, where the pilot errs by 2 %. A node outside would slip a little once per cycle and,
/// since its pressure is the highest, by a multiple of that in every later one.
const INSIDE_DOMAIN: f64 = 2e-6;
const INSIDE_CELL: f64 = 0.02;
const INSIDE_MOVED: f64 = 0.05;

/// Minimum number of cells between the stick border and the contact's edge, if the grid has enough cells.
const RING_CELLS: usize = 20;

/// Thinnest ring of slip that gets its own cells, in units of the domain.
const THINNEST: f64 = 1e-7;

/// Whether a grid graded for `before` also suits `after`.
pub(super) fn suits_both(before: &Setup, after: &Setup) -> bool {
    let alike = |setup: &Setup| {
        (
            setup.grid.cells(),
            setup.grid.radius().to_bits(),
            setup.spacing,
        )
    };
    alike(before) == alike(after)
        && before.material == after.material
        && before.indenter == after.indenter
        && before.drive == after.drive
        && before.geometry == after.geometry
}

/// Returns the setup on a grid graded towards steep wear, if it asks for one and the pilot run succeeds; otherwise on a
/// uniform grid. `from` is the run that continues on it, unless the run is new.
pub(super) fn graded(setup: &Setup, from: Option<&Simulation>) -> Setup {
    if setup.spacing == Spacing::Given {
        return setup.clone();
    }
    let uniform = uniform(setup);
    if setup.spacing == Spacing::Uniform {
        return uniform;
    }
    let graded = match melan(&uniform) {
        Some((depth, unworn)) => around_border(&uniform, from, depth, unworn),
        None => around_ring(&uniform).or_else(|| around_scar(&uniform, from)),
    };
    graded.unwrap_or(uniform)
}

/// Grades the grid towards the border of the permanent stick zone, where g is `depth` (m). `unworn` (m) is that radius
/// on the unworn indenter.
fn around_border(
    uniform: &Setup,
    from: Option<&Simulation>,
    depth: f64,
    unworn: f64,
) -> Option<Setup> {
    let cells = uniform.grid.cells();
    let of_pilot = cells_of_pilot(cells);
    let steps = uniform.steps_per_cycle.min(BORDER_STEPS);
    let border_on = |setup: Option<Setup>| border(&pilot(&setup?, from, 1, steps)?, depth);
    let first = border_on(with_border(uniform, unworn, 0.0, of_pilot))?;
    let border = border_on(with_border(uniform, first, 0.0, of_pilot))?;
    with_border(uniform, border, unworn - border, cells)
}

/// Grades the grid for a held normal load, towards the border of the unworn contact: if wear will move that border
/// under a held force, and if the ring of slip is too thin for uniform cells. No node counts as the border.
fn around_ring(uniform: &Setup) -> Option<Setup> {
    let ring = Unworn::new(uniform).ring()?;
    let (border, edge, grid) = (ring.stick_radius, ring.contact_radius, &uniform.grid);
    let (cells, radius) = (grid.cells(), grid.radius());
    let is_held = matches!(uniform.drive.normal(), Control::Force(_));
    let graded = match thin_ring(grid, border, edge) {
        Some(within) => RadialGrid::ringed(cells, [border, edge], within, radius),
        None if is_held && uniform.wear.is_some() => RadialGrid::graded(cells, border, radius),
        None => return None,
    };
    Some(uniform.with_grid(graded.ok()?.without_border()))
}

/// Places cells by the scar of a coarser run.
fn around_scar(uniform: &Setup, from: Option<&Simulation>) -> Option<Setup> {
    uniform.wear?;
    uniform.drive.tangential()?;
    let (cells, radius) = (uniform.grid.cells(), uniform.grid.radius());
    let coarse = RadialGrid::uniform(cells_of_pilot(cells), radius).ok()?;
    let run = pilot(&uniform.with_grid(coarse), from, SCAR_PERIODS, SCAR_STEPS)?;
    let grid = placing::place(&run.setup().grid, &run.state.wear, cells, &uniform.indenter);
    Some(uniform.with_grid(grid?))
}

fn cells_of_pilot(cells: usize) -> usize {
    let [fewest, most] = PILOT_CELLS;
    cells.clamp(fewest, most)
}

/// Returns the number of cells for a ring from `border` to `edge` (m) with fewer than [`RING_CELLS`] on a `grid`;
/// `None` if it has enough, or is thinner than any cell.
fn thin_ring(grid: &RadialGrid, border: f64, edge: f64) -> Option<usize> {
    let (cells, radius) = (grid.cells(), grid.radius());
    let seen = grid.nodes().iter().filter(|&&r| r > border && r <= edge);
    let room = border > 0.0 && edge < radius && edge - border >= THINNEST * radius;
    let within = RING_CELLS.max(2 * cells / 5).min(cells / 2);
    // On a coarse grid, taking cells from elsewhere would cost more than it gains.
    (room && seen.count() < RING_CELLS.min(cells / 5)).then_some(within)
}

/// Returns the width, m, of the ring of slip of a held load, if it is thinner than any cell can be.
pub(crate) fn unseen_ring(setup: &Setup) -> Option<f64> {
    let ring = Unworn::new(setup).ring()?;
    let width = ring.contact_radius - ring.stick_radius;
    (setup.indenter.rim().is_none() && width < THINNEST * setup.grid.radius()).then_some(width)
}

fn uniform(setup: &Setup) -> Setup {
    let grid = RadialGrid::uniform(setup.grid.cells(), setup.grid.radius());
    setup.with_grid(grid.unwrap_or_else(|_| setup.grid.clone()))
}

/// Returns g at the border of the permanent stick zone, and the radius of that border on the unworn indenter.
fn melan(setup: &Setup) -> Option<(f64, f64)> {
    setup.wear?;
    // The border moves while friction runs in.
    let running_in = setup.running_in.as_ref();
    let moves = running_in.is_some_and(|all| all.friction.is_some());
    let found = Unworn::new(setup).melan().filter(|_| !moves);
    found.filter(|(_, border)| *border < setup.grid.radius())
}

/// Returns a setup with `cells` cells and a node just inside `border`, which wear has `moved` inwards (m). A thin ring
/// of slip gets its own cells.
fn with_border(setup: &Setup, border: f64, moved: f64, cells: usize) -> Option<Setup> {
    let radius = setup.grid.radius();
    let rough = RadialGrid::graded(cells, border, radius).ok()?;
    let unworn = Unworn::new(setup);
    let edge = unworn.radius(unworn.deepest());
    let inside = |hair: f64| border - hair.max(INSIDE_MOVED * moved);
    let is_line = setup.geometry.is_line();
    let grid = if let Some(within) = thin_ring(&rough, border, edge) {
        let hair = INSIDE_CELL * (edge - border) / RING_CELLS as f64;
        RadialGrid::ringed(cells, [inside(hair), edge], within, radius)
    } else {
        let at = rough.border()?;
        let cell = rough.nodes()[at + 1] - rough.nodes()[at];
        let hair = f64::max(INSIDE_DOMAIN * radius, INSIDE_CELL * cell);
        RadialGrid::graded(cells, inside(hair), radius)
    };
    let grid = grid.ok()?;
    // The basis with a root at the border is not available for line contacts yet.
    Some(setup.with_grid(if is_line { grid.without_border() } else { grid }))
}

/// Runs `setup` over `periods` of the motion, with at most `steps` steps per cycle.
fn pilot(setup: &Setup, from: Option<&Simulation>, periods: u32, steps: u32) -> Option<Simulation> {
    let cycles = periods * setup.drive.cycles_to_settle();
    let affordable = PILOT_WORK / (cycles * setup.drive.turns_of_the_faster());
    let setup = Setup {
        steps_per_cycle: steps.min(affordable.max(FEWEST_STEPS)),
        integrator: Integrator::Direct,
        ..setup.clone()
    };
    let mut run = match from {
        None => Simulation::begin(setup).ok()?,
        Some(simulation) => {
            let state = simulation.state_on(&setup);
            Simulation::resume(setup, state).ok()?
        }
    };
    let (end, begun) = (run.cycle() + f64::from(cycles), run.stats().contacts);
    while run.cycle() < end {
        run.step_until(end).ok()?;
        (run.stats().contacts - begun <= u64::from(PILOT_WORK)).then_some(())?;
    }
    Some(run)
}

/// Returns the radius, m, at which g reaches `depth` after a pilot `run`: by a parabola in x² through the last three
/// nodes inside, which no longer wear.
fn border(run: &Simulation, depth: f64) -> Option<f64> {
    let (g, t) = (&run.profile_1d(), run.setup().grid.squares());
    let k = g
        .iter()
        .position(|&g| g >= depth * (1.0 - 1e-7))?
        .checked_sub(1)?;
    if k < 2 {
        return None;
    }
    let slope = (g[k] - g[k - 1]) / (t[k] - t[k - 1]);
    let before = (g[k - 1] - g[k - 2]) / (t[k - 1] - t[k - 2]);
    let kink = (slope - before) / (t[k] - t[k - 2]);
    let mut square = t[k] + (depth - g[k]) / slope;
    for _ in 0..20 {
        square = t[k] + (depth - g[k]) / (slope + kink * (square - t[k - 1]));
    }
    let radius = square.sqrt();
    (radius.is_finite() && radius > 0.0 && radius < run.setup().grid.radius()).then_some(radius)
}

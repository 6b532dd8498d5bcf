//! The volume that a step wears, by its rate at every place of the surface.
//!
//! # Formula
//!
//! ```text
//! ΔV = π k Σ ∫ τ̄ |Δs| dt    over the cells, τ̄ and Δs of Eqs. (3) and (2), both linear in t = r² there
//! V  = ∫ of the nodes' interpolant + Σ (ΔV − that of the nodes' wear)
//! ```
//!
//! That is not what the nodes' own wear sums up to. The product of two lines is no line, a difference of 3e-4 of
//! a cycle at N = 100. And at the end of the contact the pressure falls
//! like a root or a logarithm within a cell, or rises without bound to the rim of a punch: the volume under the
//! nodes' interpolant lags and leaps when the rim of the worn zone passes a node, by up to 6 % of the wear of a
//! cycle at N = 100. There p̄ of (q_n + q_{n+1})/2 has closed integrals, and they take its place.
//!
//! V says what has worn; the profile stays what its nodes say.

use std::ops::Range;

use super::super::Setup;
use super::super::state::LastStep;
use super::super::workspace::Workspace;
use crate::math::abel::bend::{self, Bend};
use crate::math::abel::rim_edge::RimEdge;
use crate::math::abel::worn;
use crate::math::quadrature::weighted;
use crate::math::scan::{leading, trailing};

/// Cells inside that of the contact's edge whose stress is steep.
const CELLS: usize = 3;

/// Cells from the edges of both loads beyond which the stress is a line in each cell.
const FAR: usize = 12;

/// Where a line load ends that is one of the two whose mean wears.
#[derive(Clone, Copy)]
pub(super) struct LoadEnd<'a> {
    /// How many springs carry it.
    pub nodes: usize,
    /// Its breaks, N/m.
    pub breaks: &'a [Bend],
    /// Its edge, where that lies in the cell of the rim.
    pub rim_edge: Option<&'a RimEdge>,
}

impl<'a> LoadEnd<'a> {
    /// That of the load as solved.
    pub fn now(work: &'a Workspace) -> Self {
        Self {
            nodes: work.contact.normal.nodes,
            breaks: &work.normal_breaks,
            rim_edge: work.rim_edge.as_ref(),
        }
    }

    /// That of the load at the end of the step before.
    pub fn before(last: &'a LastStep) -> Self {
        let load = &last.normal_load;
        Self {
            nodes: load.len() - trailing(load, |&q| q == 0.0),
            breaks: &last.normal_breaks,
            rim_edge: last.rim_edge.as_ref(),
        }
    }
}

/// ∫ of what its breaks, and its edge in the cell of the rim, add to the nodal values of a line load, N.
pub(super) fn between_springs(setup: &Setup, breaks: &[Bend], rim_edge: Option<&RimEdge>) -> f64 {
    let at_rim = rim_edge.map_or(0.0, RimEdge::line_integral);
    bend::line_integral(breaks, setup.grid.radius()) + setup.material.normal_modulus() * at_rim
}

/// What wears by the mean of two loads, `work.friction_work` μ times it, beyond the nodes' interpolant, m³;
/// none where the law or the method does not tell. From the spring `zone` on, all slip in one direction.
pub(super) fn beyond_nodes(
    setup: &Setup,
    work: &Workspace,
    ends: [LoadEnd<'_>; 2],
    zone: usize,
) -> Option<f64> {
    let law = setup.wear.filter(|law| law.follows_energy())?;
    if !work.planned.has_breaks() {
        return None;
    }
    let grid = &work.planned.grid;
    let [was, now] = ends.map(|end| end.nodes);
    let end = was.max(now).min(grid.cells());
    let first = was.min(now).saturating_sub(1 + CELLS);
    let first = first.max(zone).min(end);
    let zone = zone.min(first);
    let inside = between_nodes(work, zone..first);
    let to_edge = |cells: Range<usize>| to_edge(setup, work, ends, cells, end);
    // On a fine grid many cells lie between the two edges, and most of them far from either.
    let far = (was.min(now) + FAR).max(first)..was.max(now).saturating_sub(FAR).min(end);
    let at_edges = if far.is_empty() {
        to_edge(first..end)
    } else {
        to_edge(first..far.start) + between_nodes(work, far.clone()) + to_edge(far.end..end)
    };
    // Further in, wear is what the nodes say: next to the border it rises like no line.
    let still = leading(&work.surface_slip, |&slip| slip == 0.0);
    let inner = still.saturating_sub(1).min(zone)..zone;
    let inner = inner.flat_map(|cell| worn::cell_weights(grid, cell));
    let inner: f64 = inner.map(|(node, weight)| weight * work.worn[node]).sum();
    let nodal = weighted(&work.planned.volume_weights, &work.worn);
    let volume = std::f64::consts::PI * law.coefficient() * (inside + at_edges);
    Some(volume - (nodal - inner))
}

/// ∫ τ̄ |Δs| dt over `cells`, J.
fn between_nodes(work: &Workspace, cells: Range<usize>) -> f64 {
    let nodes = cells.start..cells.end + 1;
    let t = &work.planned.grid.squares()[nodes.clone()];
    let (tau, slip) = (
        &work.working_shear[nodes.clone()],
        &work.surface_slip[nodes],
    );
    let pairs = t.windows(2).zip(tau.windows(2).zip(slip.windows(2)));
    let cell = |(t, (tau, slip)): (&[f64], (&[f64], &[f64]))| {
        // Friction works against slip; where a node says otherwise, nothing wears.
        let ends = (tau[0] * slip[0]).max(0.0) + (tau[1] * slip[1]).max(0.0);
        let mixed = tau[0] * slip[1] + tau[1] * slip[0];
        (t[1] - t[0]) * (2.0 * ends + mixed)
    };
    pairs.map(cell).sum::<f64>() / 6.0
}

/// The same over `cells` next to where one of the two loads ends, or to the rim of a punch, J. Nothing is loaded
/// beyond the node `end`.
fn to_edge(
    setup: &Setup,
    work: &Workspace,
    ends: [LoadEnd<'_>; 2],
    cells: Range<usize>,
    end: usize,
) -> f64 {
    let t = work.planned.grid.squares();
    let (first, last) = (cells.start, t.len() - 1);
    let (origin, load) = (t[first], &work.friction_work);
    let slope = |k: usize| {
        if k < last {
            (load[k + 1] - load[k]) / (t[k + 1] - t[k])
        } else {
            0.0
        }
    };
    let half = 0.5 * setup.material.friction();
    let modulus = setup.material.normal_modulus();
    // ∫ μp̄ dt and ∫ μp̄ (t − t₀) dt beyond a node, t₀ that of the first.
    let beyond = |node: usize| {
        let nodal = (first + 1..=end).map(|j| Bend {
            at: t[j],
            jump: slope(j) - slope(j - 1),
        });
        let between = ends.iter().flat_map(|end| {
            let edge = end.rim_edge.iter();
            let at_rim = edge.flat_map(|edge| edge.load_bends(modulus));
            let bends = end.breaks.iter().copied().chain(at_rim);
            bends.map(move |bend| Bend {
                jump: half * bend.jump,
                ..bend
            })
        });
        let bends = bend::stress_beyond(nodal.chain(between), t[node], origin);
        // Only a punch carries anything where the domain ends.
        let rim = bend::jump_beyond(t[last], load[last], t[node], origin);
        let tails = ends.iter().flat_map(|end| {
            let edge = end.rim_edge.iter();
            edge.map(move |edge| edge.tail_beyond(half * modulus, t[node], origin))
        });
        let parts = tails.chain([bends, rim]);
        parts.fold([0.0; 2], |[sum, arm], [more, further]| {
            [sum + more, arm + further]
        })
    };
    let mut inner = beyond(first);
    let mut sum = 0.0;
    for cell in cells.clone() {
        let outer = beyond(cell + 1);
        let (area, arm) = (inner[0] - outer[0], inner[1] - outer[1]);
        let at_outer = (arm - (t[cell] - origin) * area) / (t[cell + 1] - t[cell]);
        let slip = |node: usize| work.surface_slip[node].abs();
        sum += slip(cell) * (area - at_outer) + slip(cell + 1) * at_outer;
        inner = outer;
    }
    sum
}

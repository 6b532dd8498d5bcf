//! The volume that wears between nodes at the end of the contact.
//!
//! # Formula
//!
//! At the end of the contact the pressure falls like a root or a logarithm within a cell, and the worn
//! depth of that cell is no line between its nodes: the volume under the nodes' interpolant lags and
//! leaps when the rim of the worn zone passes a node, by up to 6 % of the wear of a cycle at N = 100. The
//! volume itself is known, for p of a load with its breaks has closed integrals:
//!
//! ```text
//! ΔV_cell = π k μ ∫ p̄ |Δs| dt,   p̄ of (q_n + q_{n+1})/2,  Δs linear in t = r²
//! V       = ∫ of the nodes' interpolant + Σ (ΔV_cell − that of the nodes' wear)
//! ```
//!
//! the sum over the steps and over the few cells at the edge. It says what has worn; the profile stays
//! what its nodes say.

use super::super::Setup;
use super::super::state::State;
use super::super::workspace::Workspace;
use crate::math::abel::bend::{self, Bend};
use crate::math::abel::worn;

/// Cells inside that of the contact's edge whose stress is steep.
const CELLS: usize = 3;

/// What the step wears beyond its nodes' interpolant, m³; none where the law or the method does not tell.
/// From the spring `zone` on, all slip in one direction.
pub(super) fn beyond_nodes(
    setup: &Setup,
    state: &State,
    work: &Workspace,
    zone: usize,
) -> Option<f64> {
    let law = setup.wear.filter(|law| law.follows_energy())?;
    // At the rim of a punch the pressure is infinite, and what its node wears is no sample of it.
    if !work.planned.has_breaks() || setup.indenter.rim().is_some() {
        return None;
    }
    let grid = &work.planned.grid;
    let before = state.last.normal_load.iter().rposition(|&q| q != 0.0);
    let before = before.map_or(0, |last| last + 1);
    let now = work.contact.normal.nodes;
    let end = before.max(now).min(grid.cells());
    let first = before.min(now).saturating_sub(1 + CELLS).max(zone);
    if first >= end {
        return Some(0.0);
    }
    let t = grid.squares();
    let moments = |node: usize| stress_beyond(setup, state, work, first, end, t[node]);
    let scale = law.coefficient() * std::f64::consts::PI;
    let (mut inner, mut beyond) = (moments(first), 0.0);
    for cell in first..end {
        let outer = moments(cell + 1);
        let (sum, arm) = (inner[0] - outer[0], inner[1] - outer[1]);
        let at_outer = (arm - (t[cell] - t[first]) * sum) / (t[cell + 1] - t[cell]);
        let slip = |node: usize| work.surface_slip[node].abs();
        beyond += scale * (slip(cell) * (sum - at_outer) + slip(cell + 1) * at_outer);
        let nodal = worn::cell_weights(grid, cell).map(|(node, weight)| weight * work.worn[node]);
        beyond -= nodal.iter().sum::<f64>();
        inner = outer;
    }
    Some(beyond)
}

/// ∫ μp̄ dt and ∫ μp̄ (t − t₀) dt beyond the square `from`, t₀ that of the node `first`, for a contact that ends in
/// the cell before the node `end`.
fn stress_beyond(
    setup: &Setup,
    state: &State,
    work: &Workspace,
    first: usize,
    end: usize,
    from: f64,
) -> [f64; 2] {
    let (t, load) = (work.planned.grid.squares(), &work.friction_work);
    let slope = |k: usize| (load[k + 1] - load[k]) / (t[k + 1] - t[k]);
    let nodal = (first + 1..=end.min(t.len() - 2)).map(|j| Bend {
        at: t[j],
        jump: slope(j) - slope(j - 1),
    });
    let half = 0.5 * setup.material.friction();
    let modulus = setup.material.normal_modulus();
    let edges = || [&work.rim_edge, &state.last.rim_edge].into_iter().flatten();
    let between = work.normal_breaks.iter().chain(&state.last.normal_breaks);
    let between = between.copied();
    let between = between.chain(edges().flat_map(|edge| edge.load_bends(modulus)));
    let between = between.map(|bend| Bend {
        jump: half * bend.jump,
        ..bend
    });
    let [mut sum, mut arm] = bend::stress_beyond(nodal.chain(between), from, t[first]);
    for edge in edges() {
        let [more, further] = edge.tail_beyond(half * modulus, from, t[first]);
        sum += more;
        arm += further;
    }
    [sum, arm]
}

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
/// From the spring `zone` on, all slip in the direction of `sign`.
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
    let bends = bends_beyond(setup, state, work, first, end);
    let volume = |cell: usize| {
        let (a, b) = (grid.squares()[cell], grid.squares()[cell + 1]);
        let [mut sum, mut moment] = bend::stress_moments(bends.iter().copied(), [a, b]);
        let friction = 0.5 * setup.material.friction() * setup.material.normal_modulus();
        for edge in [&work.rim_edge, &state.last.rim_edge].into_iter().flatten() {
            let [more, further] = edge.tail_moments(friction, [a, b]);
            sum += more;
            moment += further;
        }
        let outer = moment / (b - a);
        let slip = |node: usize| work.surface_slip[node].abs();
        let exact = law.coefficient()
            * std::f64::consts::PI
            * (slip(cell) * (sum - outer) + slip(cell + 1) * outer);
        let nodal = worn::cell_weights(grid, cell).map(|(node, weight)| weight * work.worn[node]);
        exact - nodal.iter().sum::<f64>()
    };
    Some((first..end).map(volume).sum())
}

/// The bends of μ(q_n + q_{n+1})/2 beyond the node `first`, those between nodes among them, N/m³.
fn bends_beyond(
    setup: &Setup,
    state: &State,
    work: &Workspace,
    first: usize,
    end: usize,
) -> Vec<Bend> {
    let (t, load) = (work.planned.grid.squares(), &work.friction_work);
    let slope = |k: usize| (load[k + 1] - load[k]) / (t[k + 1] - t[k]);
    let nodal = (first + 1..=end.min(t.len() - 2)).map(|j| Bend {
        at: t[j],
        jump: slope(j) - slope(j - 1),
    });
    let half = 0.5 * setup.material.friction();
    let modulus = setup.material.normal_modulus();
    let of_edges = [&work.rim_edge, &state.last.rim_edge]
        .into_iter()
        .flatten()
        .flat_map(|edge| edge.load_bends(modulus));
    let between = work.normal_breaks.iter().chain(&state.last.normal_breaks);
    let between = between.copied().chain(of_edges).map(|bend| Bend {
        jump: half * bend.jump,
        ..bend
    });
    nodal.chain(between).collect()
}

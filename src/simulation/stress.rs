//! The stresses p and τ of the solved contact, Eq. (3).

use std::hint::select_unpredictable as select;
use std::ops::Range;

use super::workspace::Workspace;
use crate::contact::material::Material;
use crate::contact::tangential::Hold;
use crate::math::abel::bend::{self, Bend};
use crate::math::abel::cone::{Cone, Rest};
use crate::math::vector::{add_to, vectorized};

/// Springs beyond the core whose load still drops like a root.
const STEEP: usize = 4;

/// p(r), Pa, of the solved contact by Eq. (3). Nothing slips within the radius `core` (m).
pub(super) fn pressure(
    work: &Workspace,
    material: &Material,
    core: f64,
    rest: &mut Rest,
    out: &mut [f64],
) {
    pressure_of_chords(work, material, rest, out);
    curve(work, material, core, |first, terms| {
        add_to(&mut out[first..first + terms.len()], terms);
    });
}

/// τ(r), Pa, of the solved contact by Eq. (3).
pub(super) fn shear(
    work: &Workspace,
    material: &Material,
    core: f64,
    rest: &mut Rest,
    out: &mut [f64],
) {
    shear_of(0..out.len(), work, material, core, rest, out);
}

/// The same of those `nodes` alone; the others hold something finite.
pub(super) fn shear_of(
    nodes: Range<usize>,
    work: &Workspace,
    material: &Material,
    core: f64,
    rest: &mut Rest,
    out: &mut [f64],
) {
    shear_of_chords(nodes.clone(), work, material, rest, out);
    curve(work, material, core, |first, terms| {
        let asked = within(&nodes, first, terms.len());
        let nodes = first + asked.start..first + asked.end;
        let (tau, hold) = (&mut out[nodes.clone()], &work.hold[nodes]);
        add_to_shear(tau, hold, material.friction(), &terms[asked]);
    });
}

/// Both.
pub(super) fn stresses(
    work: &Workspace,
    material: &Material,
    core: f64,
    rest: &mut Rest,
    p: &mut [f64],
    tau: &mut [f64],
) {
    pressure_of_chords(work, material, rest, p);
    shear_of_chords(0..tau.len(), work, material, rest, tau);
    curve(work, material, core, |first, terms| {
        let nodes = first..first + terms.len();
        add_to(&mut p[nodes.clone()], terms);
        add_to_shear(
            &mut tau[nodes.clone()],
            &work.hold[nodes],
            material.friction(),
            terms,
        );
    });
}

/// p of a line load that is linear in x² between the nodes and its breaks.
fn pressure_of_chords(work: &Workspace, material: &Material, rest: &mut Rest, out: &mut [f64]) {
    let (load, breaks) = (&work.normal_load, &work.normal_breaks);
    of_load(work, load, breaks, 0..out.len(), rest, out);
    if let Some(edge) = &work.rim_edge {
        let modulus = material.normal_modulus();
        edge.add_to_stress(modulus, work.planned.grid.squares(), out);
    }
}

/// τ of such a load, of those `nodes` alone.
fn shear_of_chords(
    nodes: Range<usize>,
    work: &Workspace,
    material: &Material,
    rest: &mut Rest,
    out: &mut [f64],
) {
    let (load, breaks) = (&work.spring, &work.spring_breaks);
    of_load(work, load, breaks, nodes.clone(), rest, out);
    let (modulus, stresses) = (material.tangential_modulus(), &mut out[nodes]);
    vectorized(
        #[inline(always)]
        || {
            for stress in stresses {
                *stress *= modulus;
            }
        },
    );
}

/// Gives to `add`, in pieces with their first nodes, what the curvature of the line load between the nodes adds to p:
/// nothing next to the core or behind a border of stick, where wear may just have made the load steep.
fn curve(work: &Workspace, material: &Material, core: f64, mut add: impl FnMut(usize, &[f64])) {
    let planned = &work.planned;
    let Some(curvature) = &planned.curvature else {
        return;
    };
    let at_rim = work.rim_edge.iter();
    let at_rim = at_rim.flat_map(|edge| edge.load_bends(material.normal_modulus()));
    let breaks = work.normal_breaks.iter().copied().chain(at_rim);
    let core = planned.grid.nodes().partition_point(|&x| x <= core);
    let steep = core.saturating_sub(1)..core + STEEP;
    let (contact, load) = (&work.contact.normal, &work.normal_load);
    let cusp = planned.row.cusp(load, contact.radius);
    curvature.for_each(load, cusp, breaks, contact.nodes, |first, terms| {
        let steep = within(&steep, first, terms.len());
        terms[steep].fill(0.0);
        drop_behind_borders(&work.hold, first, terms);
        add(first, terms);
    });
}

/// Which of a piece of `count` nodes from `first` on are among `nodes`, counted from the first.
fn within(nodes: &Range<usize>, first: usize, count: usize) -> Range<usize> {
    let [start, end] = [nodes.start, nodes.end].map(|j| j.clamp(first, first + count) - first);
    start..end
}

/// Makes the `terms` of nodes from `first` on zero where a border of stick lies within the two cells before.
fn drop_behind_borders(hold: &[Hold], first: usize, terms: &mut [f64]) {
    // The term of the first two nodes is zero.
    let skipped = 2_usize.saturating_sub(first);
    let (Some(terms), Some(hold)) = (terms.get_mut(skipped..), hold.get(first + skipped - 2..))
    else {
        return;
    };
    vectorized(
        #[inline(always)]
        || {
            for (term, hold) in terms.iter_mut().zip(hold.windows(3)) {
                let [second, first, own] = [0, 1, 2].map(|i| hold[i] == Hold::Stick);
                *term = select((second == own) & (first == own), *term, 0.0);
            }
        },
    );
}

/// Adds to `tau`, of nodes that do what `hold` says, its share of what the curvature of the load adds to p: what slips
/// is curved like μq, what sticks keeps the kinks of its history.
fn add_to_shear(tau: &mut [f64], hold: &[Hold], friction: f64, terms: &[f64]) {
    vectorized(
        #[inline(always)]
        || {
            for ((tau, hold), term) in tau.iter_mut().zip(hold).zip(terms) {
                let backward = select(*hold == Hold::Backward, -friction, 0.0);
                *tau += select(*hold == Hold::Forward, friction, backward) * term;
            }
        },
    );
}

/// Eq. (3) with the breaks of the load and the end of its cusp, and nothing outside the contact; of use
/// on those `nodes` alone. `rest` is overwritten where the load has a cusp.
fn of_load(
    work: &Workspace,
    load: &[f64],
    breaks: &[Bend],
    nodes: Range<usize>,
    rest: &mut Rest,
    out: &mut [f64],
) {
    let planned = &work.planned;
    if !planned.has_breaks() {
        planned.plan.stress_rows(load, out, nodes);
        return;
    }
    let (grid, contact) = (&planned.grid, &work.contact.normal);
    let edge = contact.radius;
    let slope = planned.row.cusp(load, edge);
    if slope == 0.0 || edge >= grid.radius() {
        planned.plan.stress_rows(load, out, nodes);
    } else {
        let cone = Cone { slope, edge };
        cone.take_off(grid, load, rest);
        planned.plan.stress_rows(&rest.load, out, nodes);
        bend::add_to_stress(&rest.breaks, grid.squares(), out);
        cone.add_to_stress(grid, out);
    }
    bend::add_to_stress(breaks, grid.squares(), out);
    // The cusp's operator is not causal to the last bit.
    out[contact.nodes..].fill(0.0);
}

//! Computes the wear of a step from tractions and slip, Eqs. (2) and (15).
//!
//! # Formula
//!
//! ```text
//! Δf = wear(τ, Δs)          Δs by Eq. (2) of the slip of the springs, τ by Eq. (3)
//! ```
//!
//! The slip of the springs is what Eq. (2) transforms, not their displacement: the two are the same by linearity,
//! since a rigid shift maps to itself, but the slip is exactly zero inside the stick zone and stays so under a causal
//! transform.
//!
//! The scheme decides which τ a step uses: see [`euler`](super::step) and its siblings.

use std::ops::Range;

use super::contact::Contact;
use super::model::Model;
use super::traction::Pressure;
use crate::contact::tangential::SpringState;
use crate::math::abel::field::Field;
use crate::math::scan::{largest, leading, trailing};
use crate::math::vector::vectorized;
use crate::wear::{Surface, WearLaw};

/// Where the surface slips in a step.
#[derive(Debug, Clone, Default)]
pub(super) struct Sliding {
    /// The nodes that may wear: further in nothing slips, further out nothing is loaded.
    pub nodes: Range<usize>,
    /// Slip of the surface, m.
    pub slip: Vec<f64>,
}

impl Sliding {
    pub fn new(nodes: usize) -> Self {
        Self {
            nodes: 0..0,
            slip: vec![0.0; nodes],
        }
    }

    /// Finds the nodes that wear between two contacts, with the surface slip due to the slip of the springs (m): up to
    /// the edge behind the last node that touches in either; method B's stress looks one node across. The first `stuck`
    /// springs did not slip.
    pub fn find(
        &mut self,
        model: &Model,
        springs: &[f64],
        contacts: [&Contact; 2],
        stuck: usize,
    ) -> &Self {
        let nodes = self.end(contacts);
        model.plan.displacement(springs, &mut self.slip[..nodes]);
        // Nothing slips inside the innermost slipping spring.
        self.slip[..stuck].fill(0.0);
        self.nodes = stuck.min(nodes)..nodes;
        self
    }

    /// Finds the nodes that wear under one contact, from the first one that slips.
    pub fn find_under(&mut self, model: &Model, springs: &[f64], contact: &Contact) -> &Self {
        let nodes = self.end([contact, contact]);
        let slip = &mut self.slip[..nodes];
        model.plan.displacement(springs, slip);
        self.nodes = leading(slip, |&slip| slip == 0.0)..nodes;
        self
    }

    /// The first node whose pressure a step of the law takes that has a use for it from the node `zone` on.
    pub fn pressed_from(&self, law: &WearLaw, zone: usize) -> usize {
        if law.traits().needs_pressure {
            zone.min(self.nodes.start)
        } else {
            zone
        }
    }

    fn end(&self, contacts: [&Contact; 2]) -> usize {
        let [before, after] = contacts.map(|contact| contact.normal.nodes);
        (before.max(after) + 1).min(self.slip.len())
    }
}

/// The wear of a step.
#[derive(Debug, Clone, Default)]
pub(super) struct Increment {
    /// The nodes that may wear.
    pub nodes: Range<usize>,
    /// Worn depth, m; 0 outside these nodes.
    pub depth: Vec<f64>,
    /// p before and after the step at these nodes, Pa; empty if the law does not need it.
    pressure: [Vec<f64>; 2],
    /// Duration, s.
    seconds: f64,
    /// Stiffness of each of these nodes.
    pub stiffness: Vec<f64>,
    /// Work of friction, J.
    pub friction_work: f64,
}

impl Increment {
    /// No wear of `nodes` nodes, of which the first `wearing` may wear.
    pub fn new(nodes: usize, wearing: usize) -> Self {
        Self {
            depth: vec![0.0; nodes],
            stiffness: vec![0.0; wearing],
            ..Self::default()
        }
    }

    /// Computes the wear of a stress `shear` (Pa) on a `sliding` surface over `seconds`. A law that needs it takes the
    /// `pressures` before and after, from the first node that wears.
    pub fn wear(
        &mut self,
        model: &Model,
        shear: &[f64],
        sliding: &Sliding,
        pressures: [&Pressure; 2],
        seconds: f64,
    ) {
        self.nodes = sliding.nodes.clone();
        self.seconds = seconds;
        let nodes = self.nodes.clone();
        self.depth[..nodes.start].fill(0.0);
        self.depth[nodes.end..].fill(0.0);
        let Some(law) = &model.setup.wear else {
            return self.depth[nodes].fill(0.0);
        };
        if law.traits().needs_pressure {
            for (kept, pressure) in self.pressure.iter_mut().zip(pressures) {
                debug_assert!(pressure.from <= nodes.start, "p is known where it wears");
                kept.clear();
                kept.extend_from_slice(&pressure.nodal[nodes.clone()]);
            }
        }
        let (_, depth, surface) = self.surface(law, shear, sliding);
        vectorized(
            #[inline(always)]
            || law.wear(&surface, depth),
        );
    }

    /// The stiffness and the wear of the nodes that wear, and what their surface undergoes.
    fn surface<'a>(
        &'a mut self,
        law: &WearLaw,
        shear: &'a [f64],
        sliding: &'a Sliding,
    ) -> (&'a mut [f64], &'a mut [f64], Surface<'a>) {
        let nodes = || self.nodes.clone();
        let [before, after] = &self.pressure;
        let surface = Surface {
            tau: &shear[nodes()],
            slip: &sliding.slip[nodes()],
            pressure: (law.traits().needs_pressure).then_some([before, after]),
            seconds: self.seconds,
        };
        (
            &mut self.stiffness[nodes()],
            &mut self.depth[nodes()],
            surface,
        )
    }

    /// Corrects wear by the n-th power of the slip rate, n = `exponent`, for `slip` of the springs that is uneven within
    /// the step: by the factor `uneven` everywhere, and by φ^(1−n) where a spring slips only for a share φ of the step,
    /// φ = Δs/(ΔU ∓ (μ/G*) Δq). Without that, steps are of first order.
    pub fn slip_in_less_time(
        &mut self,
        model: &Model,
        slip: &[f64],
        [before, after]: [&Contact; 2],
        exponent: f64,
        uneven: f64,
    ) {
        let reach = model.setup.material.reach();
        let change =
            |of: fn(&Contact) -> &Field, j: usize| of(after).nodal[j] - of(before).nodal[j];
        for j in self.nodes.clone() {
            let slip = slip[j];
            let moved = slip + change(|contact| &contact.spring, j);
            let whole = moved - slip.signum() * reach * change(|contact| &contact.load, j);
            let share = slip / whole;
            let in_contact = before.load.nodal[j].min(after.load.nodal[j]) > 0.0;
            let is_late = in_contact && share > 0.0 && share < 1.0;
            let late = if is_late {
                share.powf(1.0 - exponent)
            } else {
                1.0
            };
            self.depth[j] *= uneven * late;
        }
    }

    /// The stiffness z = ρ μ E* ∂Δf/∂τ / h of every node that wears, into `stiffness`; returns the largest.
    ///
    /// Wear that answers to the stress with ∂Δf/∂τ feeds back with z at a node with cells of the width h, ρ the
    /// [largest eigenvalue](response) of the response of p to wear. That is what limits an explicit step.
    pub fn find_stiffness(&mut self, model: &Model, shear: &[f64], sliding: &Sliding) -> f64 {
        let setup = &model.setup;
        let Some(law) = &setup.wear else { return 0.0 };
        let material = &setup.material;
        let scale =
            setup.method.traits().response * material.friction() * material.normal_modulus();
        let per_width = &model.per_width[self.nodes.clone()];
        let (stiffness, worn, surface) = self.surface(law, shear, sliding);
        vectorized(
            #[inline(always)]
            || {
                law.sensitivity(&surface, worn, stiffness);
                for (z, per_width) in stiffness.iter_mut().zip(per_width) {
                    *z *= scale * per_width;
                }
                largest(stiffness)
            },
        )
    }

    /// Lets every node wear what an implicit step with its own response alone would, Δf/(1 + z): monotone for any z.
    /// The work of friction goes down with the stress that is left at the end of the step.
    pub fn damp(&mut self, model: &Model) {
        let explicit = model.volume(&self.depth);
        let nodes = self.nodes.clone();
        let stiffness = &self.stiffness[nodes.clone()];
        for (worn, z) in self.depth[nodes].iter_mut().zip(stiffness) {
            *worn /= 1.0 + z;
        }
        if explicit > 0.0 {
            self.friction_work *= model.volume(&self.depth) / explicit;
        }
    }
}

/// The first node from which outwards every spring in contact slips in one direction, and that direction. Springs out
/// of contact belong to it.
pub(super) fn outer_slip_zone(states: &[SpringState]) -> (usize, f64) {
    let inside = states.len() - trailing(states, |&state| state == SpringState::Open);
    let outermost = inside.checked_sub(1).map(|j| states[j]);
    let Some((direction, sign)) = outermost.and_then(|state| Some((state, state.sign()?))) else {
        return (states.len(), 0.0);
    };
    let zone = trailing(states, |&state| {
        (state == direction) | (state == SpringState::Open)
    });
    (states.len() - zone, sign)
}

#[cfg(test)]
mod tests {
    use super::*;
    use SpringState::{Backward, Forward, Open, Stick};

    #[test]
    fn the_outer_zone_ends_where_something_else_begins() {
        assert_eq!(
            outer_slip_zone(&[Stick, Stick, Forward, Forward, Open]),
            (2, 1.0)
        );
        assert_eq!(
            outer_slip_zone(&[Forward, Stick, Backward, Open, Open]),
            (2, -1.0)
        );
        assert_eq!(outer_slip_zone(&[Forward, Forward]), (0, 1.0));
        assert_eq!(outer_slip_zone(&[Stick, Stick, Open]), (3, 0.0));
        assert_eq!(outer_slip_zone(&[Open, Open]), (2, 0.0));
    }
}

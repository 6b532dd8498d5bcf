//! Computes the wear of a step from tractions and slip, Eqs. (2) and (15).
//!
//! # Formula
//!
//! ```text
//! Δf = wear(τ, Δs)          Δs by Eq. (2) of the slip of the springs, τ by Eq. (3)
//! ΔE_d = 2∫ q_x Δs dx       the work of friction of the springs
//! ```
//!
//! The slip of the springs is what Eq. (2) transforms, not their displacement: the two are the same by linearity,
//! since a rigid shift maps to itself, but the slip is exactly zero inside the stick zone and stays so under a causal
//! transform.
//!
//! The scheme decides which τ a step uses: see [`euler`](super::step) and its siblings.

use std::hint::select_unpredictable as select;
use std::ops::Range;

use super::contact::Contact;
use super::model::Model;
use super::stability::response;
use super::traction::{self, Pressure};
use super::within_step::Within;
use crate::contact::foundation::NormalContact;
use crate::contact::tangential::SpringState;
use crate::math::abel::dome::Dome;
use crate::math::abel::field::Field;
use crate::math::abel::kink;
use crate::math::scan::{largest, leading, trailing};
use crate::math::vector::{vectorized, write_each};

/// The wear of a step and its causes.
#[derive(Debug, Clone, Default)]
pub(super) struct Increment {
    /// Slip of the springs, m.
    pub slip: Vec<f64>,
    /// Slip of the surface, m.
    pub surface_slip: Vec<f64>,
    /// The stress that wears, Pa.
    pub shear: Vec<f64>,
    /// The nodes that may wear: further in nothing slips, further out nothing is loaded.
    pub nodes: Range<usize>,
    /// Worn depth, m; 0 outside these nodes.
    pub depth: Vec<f64>,
    /// Stiffness of each of these nodes.
    pub stiffness: Vec<f64>,
    /// Work of friction, J.
    pub friction_work: f64,
    /// Friction: a line load, N/m, or its work on the slip, J/m.
    rubbing: Field,
    /// τ at both ends of a step, Pa, if it has been computed.
    shear_at_ends: [Vec<f64>; 2],
    /// Buffer for a load without its dome, N/m.
    pub rest: Vec<f64>,
    /// The springs within the step, if the normal load changes.
    within: Within,
}

impl Increment {
    pub fn new(model: &Model) -> Self {
        let springs = model.springs();
        // Without wear no stress is needed.
        let wearing = if model.setup.wear.is_some() {
            springs
        } else {
            0
        };
        Self {
            slip: vec![0.0; springs],
            surface_slip: vec![0.0; wearing],
            shear: vec![0.0; wearing],
            depth: vec![0.0; model.nodes()],
            stiffness: vec![0.0; wearing],
            rubbing: Field::zeros(springs),
            shear_at_ends: [vec![0.0; wearing], vec![0.0; wearing]],
            within: Within::new(springs),
            ..Self::default()
        }
    }

    /// Computes the wear from `shear` and `surface_slip` over `seconds`.
    pub fn wear(&mut self, model: &Model, seconds: f64) {
        let nodes = self.nodes.clone();
        self.depth[..nodes.start].fill(0.0);
        self.depth[nodes.end..].fill(0.0);
        let Some(law) = &model.setup.wear else {
            return self.depth[nodes].fill(0.0);
        };
        let (tau, slip) = (
            &self.shear[nodes.clone()],
            &self.surface_slip[nodes.clone()],
        );
        let depth = &mut self.depth[nodes];
        vectorized(
            #[inline(always)]
            || law.wear(tau, slip, seconds, depth),
        );
    }

    /// Corrects wear by the n-th power of the slip rate, n = `exponent`, for slip that is uneven within the step: by the
    /// factor `uneven` everywhere, and by φ^(1−n) where a spring slips only for a share φ of the step,
    /// φ = Δs/(ΔU ∓ (μ/G*) Δq). Without that, steps are of first order.
    pub fn slip_in_less_time(
        &mut self,
        model: &Model,
        [before, after]: [&Contact; 2],
        exponent: f64,
        uneven: f64,
    ) {
        let reach = model.setup.material.reach();
        let change =
            |of: fn(&Contact) -> &Field, j: usize| of(after).nodal[j] - of(before).nodal[j];
        for j in self.nodes.clone() {
            let slip = self.slip[j];
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
    pub fn stiffness(&mut self, model: &Model) -> f64 {
        let setup = &model.setup;
        let Some(law) = &setup.wear else { return 0.0 };
        let material = &setup.material;
        let scale = response(setup.method) * material.friction() * material.normal_modulus();
        let nodes = || self.nodes.clone();
        let (tau, slip) = (&self.shear[nodes()], &self.surface_slip[nodes()]);
        let (worn, per_width) = (&self.depth[nodes()], &model.per_width[nodes()]);
        let at = nodes();
        let stiffness = &mut self.stiffness[at];
        vectorized(
            #[inline(always)]
            || {
                law.sensitivity(tau, slip, worn, stiffness);
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

    /// Computes the wear due to the slip so far and the pressure `p` (Pa) of a constant `contact`, and the friction
    /// work: τ = μp and ΔE_d = 2∫ μq |Δs| dx. The first `stuck` nodes do not slip.
    pub fn wear_by_load(&mut self, model: &Model, contact: &Contact, p: &[f64], stuck: usize) {
        let friction = model.setup.material.friction();
        self.shear[..stuck].fill(0.0);
        for (tau, p) in self.shear[stuck..].iter_mut().zip(&p[stuck..]) {
            *tau = friction * p;
        }
        self.nodes = stuck..self.depth.len();
        self.wear(model, 1.0);
        self.rub(model, [contact, contact]);
    }

    /// Computes the friction work 2∫ μ (q_n + q_{n+1})/2 |Δs| dx, the heat generated by each slipping spring.
    ///
    /// Wear makes the load drop at the stick border, within a cell. A line from the sticking spring to an unloaded one
    /// that slips would keep doing work where nothing wears. The load of the first is therefore limited to the
    /// extrapolation of the springs outside.
    pub fn rub(&mut self, model: &Model, [before, after]: [&Contact; 2]) {
        let friction = model.setup.material.friction();
        let load = &mut self.rubbing.nodal;
        write_each(
            load,
            &after.load.nodal,
            &before.load.nodal,
            #[inline(always)]
            move |after, before| 0.5 * friction * (after + before),
        );
        let varies = varies(model);
        if varies {
            (self.within).follow(model, [before, after], load, &mut self.slip);
        }
        let slip = if varies {
            &self.within.slip
        } else {
            &self.slip
        };
        let outside = leading(slip, |&slip| slip == 0.0);
        if outside > 0 && !self.within.is_ragged {
            let led_to = led_to(model.grid.squares(), load, outside - 1, &after.normal);
            load[outside - 1] = load[outside - 1].min(led_to);
        }
        let row = &model.foundation;
        let at_edge = match after.normal.nodes {
            0 => 0.0,
            nodes => row.beyond_rigid(slip, nodes - 1),
        };
        let between_springs = if self.within.is_ragged {
            0.0
        } else {
            row.between_springs(&before.load) + row.between_springs(&after.load)
        };
        let nodal = &self.rubbing.nodal;
        let in_cells = row.work(nodal, slip, after.normal);
        self.friction_work = friction * between_springs * at_edge + in_cells;
    }

    /// Computes the friction work 2∫ q_x Δs dx of explicit Euler; the integrand falls to zero at the contact's edge.
    pub fn rub_explicitly(&mut self, model: &Model, contact: &Contact) {
        if model.setup.geometry.is_line() {
            // Its work is not an integral of the product.
            return self.rub(model, [contact, contact]);
        }
        let modulus = model.setup.material.tangential_modulus();
        // Springs that stick do no work, and those out of contact carry nothing.
        let end = contact.normal.nodes;
        let states = &contact.spring_state[..end];
        let first = leading(states, |&state| state == SpringState::Stick);
        let Field { nodal, kinks, .. } = &mut self.rubbing;
        nodal[..first].fill(0.0);
        nodal[end..].fill(0.0);
        write_each(
            &mut nodal[first..end],
            &contact.spring.nodal[first..end],
            &self.slip[first..end],
            #[inline(always)]
            move |u, slip| modulus * u * slip,
        );
        kinks.clear();
        let (normal, squares) = (&contact.normal, model.grid.squares());
        if end > 0 && end < squares.len() {
            let cell = [squares[end - 1], squares[end]];
            let ends = [nodal[end - 1], nodal[end]];
            let edge = (normal.radius * normal.radius, 0.0);
            kink::polyline(cell, ends, &[edge], kinks);
        }
        let work = model.foundation.force(&self.rubbing, *normal);
        // On a contact of a cell or two, corrections for cusp and edge may exceed the work itself, but friction returns
        // no energy.
        self.friction_work = work.clamp(0.0, f64::INFINITY);
    }

    /// Finds the nodes that wear between two contacts, with their surface slip: up to the edge behind the last node
    /// that touches in either; method B's stress looks one node across. The first `stuck` springs did not slip.
    pub fn find_sliding(&mut self, model: &Model, contacts: [&Contact; 2], stuck: usize) {
        let [before, after] = contacts.map(|contact| contact.normal.nodes);
        let nodes = (before.max(after) + 1).min(self.surface_slip.len());
        let surface_slip = &mut self.surface_slip[..nodes];
        model.plan.displacement(&self.slip, surface_slip);
        // Nothing slips inside the innermost slipping spring.
        self.surface_slip[..stuck].fill(0.0);
        self.nodes = stuck.min(nodes)..nodes;
    }

    /// Sets the stress in the outermost slip zone to its mean over the step: the mean of μp at its ends. Returns the number
    /// of transforms.
    ///
    /// Springs up to a rim that slip for different parts of the step do not carry μp at each node meanwhile: Eq. (3) of
    /// what they carry is the stress, so that V is k E_d.
    pub fn mean_of_load(
        &mut self,
        model: &Model,
        [was, is]: [&Pressure; 2],
        (first, sign): (usize, f64),
    ) -> u64 {
        let reaches_rim = self.rubbing.nodal.last().is_some_and(|&load| load > 0.0);
        if varies(model) && self.within.is_ragged && reaches_rim {
            let Self {
                rubbing,
                shear,
                rest,
                ..
            } = self;
            rubbing.dome = Dome::at_rim(&rubbing.nodal, model.grid.squares());
            let (touching, out) = (shear.len(), (&mut shear[..], rest));
            rubbing.stress_from(first, &model.plan, &model.grid, touching, out);
            rubbing.dome = None;
            shear[first..].iter_mut().for_each(|shear| *shear *= sign);
            return 1;
        }
        let half = 0.5 * sign * model.setup.material.friction();
        write_each(
            &mut self.shear[first..],
            &was.nodal[first..],
            &is.nodal[first..],
            #[inline(always)]
            move |was, is| half * (was + is),
        );
        if varies(model) {
            let shares = self.within.share[first..].iter();
            self.shear[first..]
                .iter_mut()
                .zip(shares)
                .for_each(|(shear, share)| *shear *= share);
        }
        0
    }

    /// Returns the state of each spring in the step that [rubbed](Self::rub) last and ended with the contact `after`.
    pub fn states<'a>(&'a self, model: &Model, after: &'a Contact) -> &'a [SpringState] {
        if varies(model) {
            &self.within.states
        } else {
            &after.spring_state
        }
    }

    /// Sets the stress between the sticking springs in the middle and the outermost slip `zone` to its mean over the
    /// step: of τ if its sign stays, half of τ if it turned and now works with the slip. Returns the number of
    /// transforms, which is 0 in most steps, since nothing slips there.
    pub fn mean_of_shear(&mut self, model: &Model, contacts: [&Contact; 2], zone: usize) -> u64 {
        let zone = zone.min(self.nodes.end);
        let nodes = self.nodes.start.min(zone)..zone;
        let slips = &self.surface_slip[nodes.clone()];
        if slips.iter().all(|&slip| slip == 0.0) {
            self.shear[nodes].fill(0.0);
            return 0;
        }
        for (contact, shear) in contacts.into_iter().zip(&mut self.shear_at_ends) {
            traction::shear(
                model,
                contact,
                nodes.start,
                (&mut shear[..], &mut self.rest),
            );
        }
        let [was, is] = self
            .shear_at_ends
            .each_ref()
            .map(|shear| &shear[nodes.clone()]);
        let means = &mut self.shear[nodes];
        vectorized(
            #[inline(always)]
            move || {
                for ((mean, (was, is)), slip) in means.iter_mut().zip(was.iter().zip(is)).zip(slips)
                {
                    let with_slip = select(is * slip > 0.0, 0.5 * is, 0.0);
                    *mean = select(was * is > 0.0, 0.5 * (was + is), with_slip);
                }
            },
        );
        2
    }
}

/// Whether the normal motion loads and unloads springs within a step.
fn varies(model: &Model) -> bool {
    model.setup.drive.normal().oscillation().amplitude() > 0.0
}

/// Extrapolates the load at the spring `k`, N/m, linearly in x² from its neighbours: from the two outside, of which the
/// edge of the contact may be the second; zero if none touches, since what no node carries wears nothing.
fn led_to(squares: &[f64], load: &[f64], k: usize, contact: &NormalContact) -> f64 {
    let edge = contact.radius * contact.radius;
    let (from, slope, to) = if k + 2 < contact.nodes {
        let falls = (load[k + 1] - load[k + 2]) / (squares[k + 2] - squares[k + 1]);
        (load[k + 1], falls, squares[k + 1])
    } else if k + 1 < contact.nodes {
        let falls = load[k + 1] / (edge - squares[k + 1]);
        (load[k + 1], falls, squares[k + 1])
    } else {
        return 0.0;
    };
    (from + slope * (to - squares[k])).max(0.0)
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

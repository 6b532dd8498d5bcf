//! The stress that wears in a step of the [second-order scheme](super::step): its mean over the step.

use std::hint::select_unpredictable as select;

use super::contact::Contact;
use super::friction::Friction;
use super::model::Model;
use super::traction::{self, Pressure};
use super::wear::Sliding;
use crate::math::vector::{vectorized, write_each};

/// The mean of τ over a step, weighted by slip.
#[derive(Debug, Clone)]
pub(super) struct MeanShear {
    /// Pa.
    pub nodal: Vec<f64>,
    /// τ at both ends of the step, Pa, if it has been computed.
    at_ends: [Vec<f64>; 2],
}

impl MeanShear {
    pub fn new(nodes: usize) -> Self {
        Self {
            nodal: vec![0.0; nodes],
            at_ends: [vec![0.0; nodes], vec![0.0; nodes]],
        }
    }

    /// Computes the mean of a step between two contacts with their `pressures`, in which the outermost slip `zone` begins
    /// at a node and slips with a sign. Overwrites `rest`.
    pub fn find(
        &mut self,
        model: &Model,
        contacts: [&Contact; 2],
        (friction, sliding): (&Friction, &Sliding),
        pressures: [&Pressure; 2],
        zone: (usize, f64),
        rest: &mut Vec<f64>,
    ) -> &[f64] {
        self.set_outside(model, friction, pressures, zone, rest);
        self.set_inside(model, contacts, sliding, zone.0, rest);
        &self.nodal
    }

    /// Sets the stress in the outermost slip zone to its mean over the step: the mean of μp at its ends.
    ///
    /// Springs up to a rim that slip for different parts of the step do not carry μp at each node meanwhile: Eq. (3) of
    /// what they carry is the stress, so that V is k E_d.
    fn set_outside(
        &mut self,
        model: &Model,
        friction: &Friction,
        [was, is]: [&Pressure; 2],
        (first, sign): (usize, f64),
        rest: &mut Vec<f64>,
    ) {
        let shear = &mut self.nodal;
        if let Some(load) = friction.uneven_load() {
            let (touching, out) = (shear.len(), (&mut shear[..], rest));
            load.stress_from(first, &model.plan, &model.grid, touching, out);
            shear[first..].iter_mut().for_each(|shear| *shear *= sign);
            return;
        }
        let half = 0.5 * sign * model.setup.material.friction();
        write_each(
            &mut shear[first..],
            &was.nodal[first..],
            &is.nodal[first..],
            #[inline(always)]
            move |was, is| half * (was + is),
        );
        if let Some(shares) = friction.shares(model) {
            let shares = shares[first..].iter();
            let shear = shear[first..].iter_mut().zip(shares);
            shear.for_each(|(shear, share)| *shear *= share);
        }
    }

    /// Sets the stress between the sticking springs in the middle and the outermost slip `zone` to its mean over the
    /// step: of τ if its sign stays, half of τ if it turned and now works with the slip. In most steps nothing slips
    /// there.
    fn set_inside(
        &mut self,
        model: &Model,
        contacts: [&Contact; 2],
        sliding: &Sliding,
        zone: usize,
        rest: &mut Vec<f64>,
    ) {
        let zone = zone.min(sliding.nodes.end);
        let nodes = sliding.nodes.start.min(zone)..zone;
        let slips = &sliding.slip[nodes.clone()];
        if slips.iter().all(|&slip| slip == 0.0) {
            return self.nodal[nodes].fill(0.0);
        }
        for (contact, shear) in contacts.into_iter().zip(&mut self.at_ends) {
            traction::shear(model, contact, nodes.start, (&mut shear[..], &mut *rest));
        }
        let [was, is] = self.at_ends.each_ref().map(|shear| &shear[nodes.clone()]);
        let means = &mut self.nodal[nodes];
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
    }
}

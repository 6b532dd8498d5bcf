//! Solves the springs: loads and displacements from the 1D profile g and the slip history.

use serde::{Deserialize, Serialize};

use super::breakdown::{Cause, advice};
use super::choices::Scheme;
use super::drive::{Prescribed, Targets};
use super::model::Model;
use super::profile::Profile;
use crate::contact::foundation::NormalContact;
use crate::contact::normal;
use crate::contact::tangential::{self, SlipInput, SpringState};
use crate::math::abel::field::Field;
use crate::math::root;
use crate::math::scan::largest;

/// Relative rounding of the indenter's position.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

/// A contact that is being made or lost bends a rig by less than this fraction of its actuator's position. The few
/// springs on the rounding noise of a worn profile then give no meaningful force, and the rig counts as stiff.
const HARDLY_BENT: f64 = 1e-6;

/// A solved contact: the state and loads of all springs at one moment.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Contact {
    /// Depth d = u_z, m; in a line contact the depth of its springs, P/(E*L).
    pub depth: f64,
    /// Tangential displacement of the indenter u_x⁽⁰⁾, m; in a line contact against a point at the gauge length.
    pub shift: f64,
    /// The edge of the contact and its largest load.
    pub normal: NormalContact,
    /// The stick radius, m; `None` without tangential motion.
    pub stick_radius: Option<f64>,
    /// q_z, N/m.
    pub load: Field,
    /// u_x of the tangential springs, m; empty without tangential motion.
    pub spring: Field,
    /// State of each tangential spring in the last step; empty without tangential motion.
    pub spring_state: Vec<SpringState>,
}

impl Contact {
    /// Returns an unloaded contact with `nodes` nodes and `springs` tangential springs.
    pub(super) fn new(nodes: usize, springs: usize) -> Self {
        Self {
            load: Field::zeros(nodes),
            spring: Field::zeros(springs),
            spring_state: vec![SpringState::Stick; springs],
            ..Self::default()
        }
    }

    /// F_z, N.
    pub(crate) fn normal_force(&self, model: &Model) -> f64 {
        model.foundation.force(&self.load, self.normal)
    }

    /// F_x, N; 0 without tangential motion.
    pub(crate) fn tangential_force(&self, model: &Model) -> f64 {
        if self.spring.nodal.is_empty() {
            return 0.0;
        }
        let springs = model.foundation.force(&self.spring, self.normal);
        model.setup.material.tangential_modulus() * springs
    }

    /// Returns how far the springs of a line contact move the indenter against a point at the gauge length, m: the
    /// displacement without the rigid slip.
    pub(super) fn elastic_shift(&self, model: &Model) -> f64 {
        let gauge = model.setup.drive.gauge_length().unwrap_or_default();
        model.foundation.shift_against(gauge, &self.spring)
    }

    /// u_x(r), m, of the surface by Eq. (2).
    pub(crate) fn surface_displacement(&self, model: &Model, out: &mut [f64]) {
        self.spring.displacement(&model.plan, &model.grid, out);
    }

    /// u_z(r), m, of the surface by Eq. (2), downwards.
    pub(crate) fn depression(&self, model: &Model, out: &mut [f64]) {
        self.load.displacement(&model.plan, &model.grid, out);
        let modulus = model.setup.material.normal_modulus();
        for depth in out {
            *depth /= modulus;
        }
    }
}

/// The input of a contact problem.
#[derive(Clone, Copy)]
pub(super) struct ContactProblem<'a> {
    model: &'a Model,
    profile: &'a Profile,
    /// The previous contact.
    before: &'a Contact,
}

impl<'a> ContactProblem<'a> {
    /// Makes the problem of springs on a `profile`, whose previous contact was `before`.
    pub fn new(model: &'a Model, profile: &'a Profile, before: &'a Contact) -> Self {
        Self {
            model,
            profile,
            before,
        }
    }

    /// Presses and shifts the indenter to the targets of the drive. Writes the contact `after`, and how far each
    /// tangential spring slips, m.
    pub fn solve(
        self,
        targets: Targets,
        after: &mut Contact,
        slip: &mut [f64],
    ) -> Result<(), Cause> {
        let Self { before, .. } = self;
        self.press(targets.normal, after)?;
        after.shift = before.shift;
        if self.model.setup.geometry.is_line() {
            return match targets.tangential {
                None => Ok(()),
                Some(target) => self.shift_line(target, after, slip),
            };
        }
        let is_stiff = self.model.setup.drive.rig_compliance() == 0.0;
        let (increment, shift) = match targets.tangential {
            None => return Ok(()),
            Some(Prescribed::Displacement(target)) if is_stiff => (target - before.shift, target),
            Some(target) => {
                let increment = match target {
                    Prescribed::Displacement(target) => {
                        self.increment_on_rig(after, slip, target)?
                    }
                    Prescribed::Force(target) => self.increment_for_force(after, slip, target)?,
                };
                (increment, before.shift + increment)
            }
        };
        self.shift_by(increment, after, slip);
        after.shift = shift;
        Ok(())
    }

    /// Presses the indenter to a target, leaving the tangential springs unchanged.
    fn press(self, target: Prescribed, contact: &mut Contact) -> Result<(), Cause> {
        let Self { model, profile, .. } = self;
        let setup = &model.setup;
        let depth = self.depth_at(target, contact)?;
        let modulus = setup.material.normal_modulus();
        let normal = normal::press(self.springs(), depth, &mut contact.load);
        if !model.foundation.most_force(normal.strongest).is_finite() {
            if profile.g.iter().all(|g| g.is_finite()) {
                return Err(Cause::Overflow { depth });
            }
            return Err(Cause::NotFinite {
                quantity: "normal force",
                advice: advice(setup),
            });
        }
        let last = setup.grid.cells();
        let at_end = contact.load.nodal[last];
        if setup.indenter.rim().is_none() && normal.nodes > last && at_end > 1e-9 * modulus * depth
        {
            let radius = setup.grid.radius();
            // Wear only lowers the surface: where f₀ exceeds the depth, nothing ever touches. A line contact has no
            // such limit.
            let has_end = !setup.geometry.is_line();
            return Err(if has_end && model.unworn[last] >= depth * (1.0 - 1e-9) {
                Cause::BlownUp {
                    radius,
                    advice: advice(setup),
                }
            } else {
                Cause::EdgeReached {
                    domain_radius: radius,
                }
            });
        }
        contact.depth = depth;
        contact.normal = normal;
        Ok(())
    }

    /// Returns the depth, m: prescribed, or the one that carries the prescribed force.
    fn depth_at(self, target: Prescribed, contact: &mut Contact) -> Result<f64, Cause> {
        let Self {
            model,
            profile,
            before,
        } = self;
        let (g, setup) = (&profile.g, &model.setup);
        let force = match target {
            Prescribed::Displacement(depth) => return Ok(depth),
            Prescribed::Force(force) => force,
        };
        let modulus = setup.material.normal_modulus();
        if let Some(length) = setup.geometry.length() {
            return Ok(force / (modulus * length));
        }
        let deepest = match setup.indenter.rim() {
            // A punch carries any load; its springs yield at most as much as the load needs.
            Some(rim) => largest(g) + 2.0 * (force / (2.0 * modulus * rim)).abs(),
            None => g[setup.grid.cells()],
        };
        let (load, around) = (&mut contact.load, [before.depth, deepest]);
        normal::depth_for_load(self.springs(), force, around, load).ok_or(Cause::LoadTooLarge {
            force,
            domain_radius: setup.grid.radius(),
        })
    }

    /// What the profile is pressed on.
    fn springs(self) -> normal::Springs<'a> {
        normal::Springs {
            row: &self.model.foundation,
            g: &self.profile.g,
            modulus: self.model.setup.material.normal_modulus(),
            scar: self.profile.scar,
        }
    }

    /// Moves the tangential springs by `increment` (m) from their previous displacements.
    fn shift_by(self, increment: f64, after: &mut Contact, slip: &mut [f64]) {
        let Self {
            model,
            profile,
            before,
        } = self;
        let material = &model.setup.material;
        let input = SlipInput {
            foundation: &model.foundation,
            normal_load: &after.load.nodal,
            dome: after.load.dome,
            contact: after.normal,
            reach: material.reach(),
            before: &before.spring.nodal,
            held: &before.spring_state,
        };
        let (spring, states) = (&mut after.spring, &mut after.spring_state);
        tangential::slide(input, increment, &mut spring.nodal, slip, states);
        // The published scheme is first-order anyway, and stays as published.
        if model.setup.scheme == Scheme::Trapezoid {
            let depths = [before.depth, after.depth];
            let springs = (&mut spring.nodal[..], &mut *slip, &mut states[..]);
            tangential::correct_late_contact(input, increment, depths, &profile.g, springs);
        }
        after.stick_radius = Some(tangential::borders(input, spring, slip, states));
    }

    /// Moves the springs of a line contact: by the force on them, which the spring at the centre tells, or by the
    /// displacement that the actuator has against a point at the gauge length, U = CF_x + elastic shift + rigid slip.
    ///
    /// It rises with the increment of the springs. Where that is beyond what any spring bears, it is the increment alone,
    /// the rigid slip, that rises.
    fn shift_line(
        self,
        target: Prescribed,
        after: &mut Contact,
        slip: &mut [f64],
    ) -> Result<(), Cause> {
        let Self { model, before, .. } = self;
        let setup = &model.setup;
        let rigid = before.shift - before.elastic_shift(model);
        let place = |after: &Contact, slip: &[f64]| rigid + slip[0] + after.elastic_shift(model);
        let target = match target {
            Prescribed::Force(force) => {
                let limit = setup.material.friction() * after.normal_force(model);
                if force.abs() >= limit && force != 0.0 {
                    return Err(Cause::FrictionExceeded { force, limit });
                }
                let per_spring =
                    setup.material.tangential_modulus() * setup.geometry.length().unwrap_or(1.0);
                let increment = force / per_spring - before.spring.nodal[0];
                self.shift_by(increment, after, slip);
                after.shift = place(after, slip);
                return Ok(());
            }
            Prescribed::Displacement(target) => target,
        };
        let compliance = setup.drive.rig_compliance();
        let span = 2.0 * after.normal.strongest * setup.material.reach();
        let mut beyond = |increment: f64| {
            self.shift_by(increment, after, slip);
            place(after, slip) + compliance * after.tangential_force(model) - target
        };
        let (least, most) = (beyond(-span), beyond(span));
        let increment = if most <= 0.0 {
            span - most
        } else if least >= 0.0 {
            -span - least
        } else {
            let scale = span.max(target.abs());
            root::bracketed(|at| beyond(at) / scale, -span, span, 1e-15 * scale).ok_or(
                Cause::NotFinite {
                    quantity: "tangential displacement",
                    advice: advice(setup),
                },
            )?
        };
        self.shift_by(increment, after, slip);
        after.shift = place(after, slip);
        Ok(())
    }

    /// Returns the increment of displacement (m) that a rig leaves to the contact if its actuator is at `target` (m):
    /// u + C F_x(u) = U. F_x rises with u and never exceeds μF_z, which brackets the root.
    fn increment_on_rig(
        self,
        after: &mut Contact,
        slip: &mut [f64],
        target: f64,
    ) -> Result<f64, Cause> {
        let Self { model, before, .. } = self;
        let setup = &model.setup;
        let compliance = setup.drive.rig_compliance();
        let limit = setup.material.friction() * after.normal_force(model);
        let (wanted, span) = (target - before.shift, 1.1 * compliance * limit);
        // A contact that is being lost or made bends the rig by less than the rounding of its actuator's position, so
        // there is no bracket.
        if span <= ROUNDING * (target.abs() + before.shift.abs()) {
            return Ok(wanted);
        }
        let found = root::bracketed(
            |increment| {
                self.shift_by(increment, after, slip);
                (increment - wanted + compliance * after.tangential_force(model)) / span
            },
            wanted - span,
            wanted + span,
            1e-15 * (span + target.abs()),
        );
        let is_hardly_bent = span <= HARDLY_BENT * (target.abs() + before.shift.abs());
        let found = found.or(is_hardly_bent.then_some(wanted));
        found.ok_or(Cause::NotFinite {
            quantity: "tangential force",
            advice: advice(setup),
        })
    }

    /// Returns the increment of displacement (m) that brings the tangential force to `target` (N).
    fn increment_for_force(
        self,
        after: &mut Contact,
        slip: &mut [f64],
        target: f64,
    ) -> Result<f64, Cause> {
        let model = self.model;
        let material = &model.setup.material;
        let limit = material.friction() * after.normal_force(model);
        let exceeded = Cause::FrictionExceeded {
            force: target,
            limit,
        };
        if target.abs() >= limit {
            return Err(exceeded);
        }
        // Twice the largest strain of a spring reverses every spring.
        let reach = material.reach();
        let span = 2.0 * after.normal.strongest * reach;
        root::bracketed(
            |increment| {
                self.shift_by(increment, after, slip);
                (after.tangential_force(model) - target) / limit
            },
            -span,
            span,
            1e-15 * span,
        )
        .ok_or(exceeded)
    }
}

//! Changes the parts of a run under way, carrying over the wear and the springs.

use super::breakdown::{Breakdown, Cause};
use super::model::Model;
use super::profile::scar_volume;
use super::state::{JumpMemory, State};
use super::{Setup, Simulation, border};
use crate::math::abel::worn;
use crate::math::grid::RadialGrid;

/// Who determines the end of a [`Setup`]'s domain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Domain {
    /// The scenario, by a radius or by the rim of a punch; the domain ends there.
    Given,
    /// The program, by what can touch; the domain may end further out.
    Derived,
}

/// Factor by which a domain grows.
const GROWTH: f64 = 1.25;

/// Widest domain, in units of the depth of indentation: far beyond any contact of small slopes.
const WIDEST: f64 = 1e9;

/// Maximum relative change of the worn volume on another grid.
const MOST_LOST: f64 = 0.02;

impl Simulation {
    /// Replaces the parts mid-run. Carries over the worn profile, the springs and the counters, and interpolates them
    /// on another grid. A derived domain does not shrink while wear lies outside the new one.
    ///
    /// # Errors
    ///
    /// If the new parts cannot hold the contact, or would lose wear; the simulation stays unchanged.
    pub fn reconfigure(&mut self, setup: Setup, domain: Domain) -> Result<(), Breakdown> {
        let setup = self.holding_wear(setup, domain)?;
        let setup = if border::suits_both(self.setup(), &setup) {
            setup.with_grid(self.setup().grid.clone())
        } else {
            border::graded(&setup, Some(self))
        };
        let (mut changed, lost) = self.moved_to(Model::new(setup, Some(&self.model)));
        let worn = self.wear_volume();
        if lost > MOST_LOST * worn {
            return Err(self.refused(Cause::WearBlurred {
                cells: changed.setup().grid.cells(),
                share: lost / worn,
            }));
        }
        changed.solve_contact()?;
        *self = changed;
        Ok(())
    }

    /// Widens the domain for a contact that has reached its edge, by stretching all cells. Interpolates the worn
    /// profile and preserves its volume. Returns false if the indenter ends there.
    pub(super) fn grow(&mut self) -> Result<bool, Breakdown> {
        let before = self.setup();
        let room = before.indenter.end().unwrap_or(f64::INFINITY);
        let radius = (GROWTH * before.grid.radius()).min(room);
        let widest = WIDEST * before.depth_scale(self.state.contact.depth).abs();
        if radius <= before.grid.radius() || radius > widest {
            return Ok(false);
        }
        let Ok(grid) = before.grid.widened(radius) else {
            return Ok(false);
        };
        let mut setup = before.with_grid(grid);
        if before.grid.border().is_some() || before.geometry.is_line() {
            setup = border::graded(&setup, Some(self));
        }
        let (mut wider, _) = self.moved_to(Model::new(setup, None));
        wider.state.jump.length = self.state.jump.length;
        wider.solve_contact()?;
        wider.is_shortened = self.is_shortened;
        *self = wider;
        Ok(true)
    }

    /// Returns the setup on a domain that contains all wear.
    fn holding_wear(&self, setup: Setup, domain: Domain) -> Result<Setup, Breakdown> {
        let (nodes, wear) = (self.setup().grid.nodes(), &self.state.wear);
        let reach = match wear.iter().rposition(|&worn| worn != 0.0) {
            // Between the last worn node and the next one, wear falls to zero.
            Some(last) => nodes[(last + 1).min(nodes.len() - 1)],
            None => 0.0,
        };
        let radius = setup.grid.radius();
        if radius >= reach {
            return Ok(setup);
        }
        let wider = RadialGrid::uniform(setup.grid.cells(), self.setup().grid.radius());
        match (domain, wider) {
            (Domain::Derived, Ok(grid)) => Ok(Setup { grid, ..setup }),
            _ => Err(self.refused(Cause::WearCutOff { reach, radius })),
        }
    }

    /// Returns the present state with other operators. Interpolation on another grid neither adds nor removes wear:
    /// wear since the beginning keeps its volume, and the initial scar is read again from its table. Also returns the
    /// change of volume that interpolation alone would have caused, m³.
    fn moved_to(&self, model: Model) -> (Self, f64) {
        let mut state = self.state_on(&model.setup);
        if model.grid == self.model.grid {
            return (Self::from_parts(model, state), 0.0);
        }
        let scar = self.setup().initial_wear(&model.grid);
        let since = state.wear.iter().zip(&scar);
        let since: Vec<f64> = since.map(|(depth, scar)| depth - scar).collect();
        let (worn, blurred) = (
            self.volume_since_start(),
            scar_volume(&model, &since, self.even_end()),
        );
        if blurred > 0.0 {
            let kept = worn / blurred;
            for (depth, (scar, since)) in state.wear.iter_mut().zip(scar.iter().zip(since)) {
                *depth = scar + kept * since;
            }
        }
        (Self::from_parts(model, state), (worn - blurred).abs())
    }

    /// Returns the present state on the grid of another setup.
    pub(super) fn state_on(&self, setup: &Setup) -> State {
        let (grid, springs) = (&self.setup().grid, setup.springs());
        if setup.grid == *grid && springs == self.model.springs() {
            return State {
                jump: JumpMemory::default(),
                ..self.state.clone()
            };
        }
        let before = &self.state.contact;
        let mut state = State::new(setup.grid.len(), springs > 0);
        state.carry_sums(&self.state);
        state.jump = JumpMemory::default();
        (state.contact.depth, state.contact.shift) = (before.depth, before.shift);
        let nodes = setup.grid.nodes();
        let mut since = self.state.wear.clone();
        let initial = self.setup().initial_wear(grid).into_iter();
        since
            .iter_mut()
            .zip(initial)
            .for_each(|(worn, initial)| *worn -= initial);
        state.wear = self.setup().initial_wear(&setup.grid);
        for (worn, &r) in state.wear.iter_mut().zip(nodes) {
            // Between nodes the interpolant may dip slightly below zero.
            *worn += worn::interpolate(grid, &since, r).max(0.0);
        }
        if springs > 0 && self.model.springs() > 0 {
            for (u, &r) in state.contact.spring.nodal.iter_mut().zip(nodes) {
                *u = grid.interpolate(&before.spring.nodal, r);
            }
        }
        state
    }
}

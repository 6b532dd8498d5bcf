//! Other parts for a run under way: what has been worn, and where the springs stand, is carried over to them.

use super::breakdown::{Breakdown, Cause};
use super::model::Model;
use super::profile::scar_volume;
use super::state::{JumpMemory, State};
use super::{Setup, Simulation, border};
use crate::math::abel::worn;
use crate::math::grid::RadialGrid;

/// Who says where the domain of a [`Setup`] ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Domain {
    /// The scenario, by a radius or by the rim of a punch: it ends there.
    Given,
    /// The program, by what can touch: it may end further out.
    Derived,
}

/// By how much a domain grows at once, in radii.
const GROWTH: f64 = 1.25;

/// The widest domain, in units of the depth of indentation: far beyond any contact of small slopes.
const WIDEST: f64 = 1e9;

/// The most that the worn volume may differ on another grid, relative to it.
const MOST_LOST: f64 = 0.02;

impl Simulation {
    /// Replaces the parts mid-run. The worn profile, the springs and the counters are carried over;
    /// on another grid they are interpolated. A derived domain does not shrink while wear lies outside
    /// of the new one.
    ///
    /// # Errors
    ///
    /// The new parts cannot hold the contact, or would lose wear; the simulation stays as it was.
    pub fn reconfigure(&mut self, setup: Setup, domain: Domain) -> Result<(), Breakdown> {
        let setup = self.holding_wear(setup, domain)?;
        let setup = if border::stays(self.setup(), &setup) {
            setup.on(self.setup().grid.clone())
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
        changed.settle()?;
        *self = changed;
        Ok(())
    }

    /// Makes the domain wider, for a contact that has come to its edge: as many cells, each wider by as much. The
    /// worn profile is interpolated, and its volume kept. False where the indenter ends.
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
        let mut setup = before.on(grid);
        if before.grid.border().is_some() || before.geometry.is_line() {
            setup = border::graded(&setup, Some(self));
        }
        let (mut wider, _) = self.moved_to(Model::new(setup, None));
        wider.state.jump.length = self.state.jump.length;
        wider.settle()?;
        wider.is_shortened = self.is_shortened;
        *self = wider;
        Ok(true)
    }

    /// The setup on a domain that all wear fits into.
    fn holding_wear(&self, setup: Setup, domain: Domain) -> Result<Setup, Breakdown> {
        let (nodes, wear) = (self.setup().grid.nodes(), &self.state.wear);
        let reach = match wear.iter().rposition(|&worn| worn != 0.0) {
            // Between the last node that is worn and the next one, wear falls to zero.
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

    /// The present state with other operators. Interpolation on another grid neither wears nor heals: what has worn
    /// since the beginning keeps its volume, and what was worn before is read anew from its table. Returns as well by how
    /// much interpolation would have changed the volume, m³.
    fn moved_to(&self, model: Model) -> (Self, f64) {
        let mut state = self.state_on(&model.setup);
        if model.grid == self.model.grid {
            return (Self::with(model, state), 0.0);
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
        (Self::with(model, state), (worn - blurred).abs())
    }

    /// The present state on the grid of another setup.
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
            // Between nodes the interpolant may swing below zero by a little.
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

//! A saved run, which continues bit for bit.
//!
//! It contains the nodes, since a pilot run may have chosen them; the state; and those buffers of the last good step
//! that cannot be derived from state and setup. Everything else is recomputed, so that the next step and every
//! observation are the same as without the interruption.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::contact::Contact;
use super::model::Model;
use super::{Setup, Simulation, State};
use crate::math::abel::kink::are_hats;
use crate::math::grid::RadialGrid;

/// A saved simulation, without its setup.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Saved {
    nodes: Vec<f64>,
    border: Option<usize>,
    state: State,
}

impl Saved {
    /// Cycles since the start.
    pub fn cycle(&self) -> f64 {
        self.state.cycle
    }

    /// The domain's edge, m.
    pub fn radius(&self) -> f64 {
        self.nodes.last().copied().unwrap_or_default()
    }
}

/// A saved run that does not fit its setup, or is invalid.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("the saved {what} {rule}")]
pub struct Unfit {
    what: &'static str,
    rule: String,
}

impl Unfit {
    fn new(what: &'static str, rule: impl Into<String>) -> Self {
        let rule = rule.into();
        Self { what, rule }
    }
}

impl Simulation {
    /// Saves the run.
    pub fn save(&self) -> Saved {
        Saved {
            nodes: self.setup().grid.nodes().to_vec(),
            border: self.setup().grid.border(),
            state: self.state.clone(),
        }
    }

    /// Continues a saved run; `setup` must be the one it ran on, except for the grid.
    pub fn restore(setup: Setup, saved: Saved) -> Result<Self, Unfit> {
        let grid = RadialGrid::restored(saved.nodes, saved.border)
            .map_err(|invalid| Unfit::new("grid", invalid.rule))?;
        let of = |grid: &RadialGrid| (grid.cells(), grid.radius().to_bits());
        if of(&grid) != of(&setup.grid) {
            return Err(Unfit::new("grid", "is not that of the scenario"));
        }
        let setup = Setup { grid, ..setup };
        check(&setup, &saved.state)?;
        let model = Model::new(setup, None);
        let mut simulation = Self::from_parts(model, saved.state);
        simulation.run_in();
        simulation.next = simulation.look_ahead();
        Ok(simulation)
    }
}

/// Maximum number of cycles and steps of a run: beyond, a float no longer tells one from the next.
const MOST: f64 = 1e15;

/// Refuses a state that cannot result from a step on this setup.
fn check(setup: &Setup, state: &State) -> Result<(), Unfit> {
    let contact: &Contact = &state.contact;
    let (nodes, springs) = (setup.grid.len(), setup.springs());
    let settled = state.jump.settled.as_ref();
    let [of_cycle, stiff] = settled.map_or([nodes; 2], |settled| {
        [settled.wear.len(), settled.stiffness.len()]
    });
    for (what, length, due) in [
        ("wear", state.wear.len(), nodes),
        ("image of the wear", state.image.len(), nodes),
        ("springs", contact.spring.nodal.len(), springs),
        ("springs' states", contact.spring_state.len(), springs),
        ("growth of g", state.last.growth.len(), nodes),
        ("growth of f", state.last.wear.len(), nodes),
        ("wear of a cycle", of_cycle, nodes),
        ("stiffness of a cycle", stiff, nodes),
        ("line load", contact.load.nodal.len(), nodes),
        ("pressure", state.pressure.nodal.len(), springs),
    ] {
        if length != due {
            let rule = format!("has {length} values, where the scenario has {due}");
            return Err(Unfit::new(what, rule));
        }
    }
    if !(0.0..=MOST).contains(&state.cycle) {
        return Err(Unfit::new(
            "cycle",
            format!("is not a number from 0 to {MOST:e}"),
        ));
    }
    let stats = &state.stats;
    for (what, count) in [
        ("number of steps", state.steps),
        ("number of contacts", stats.contacts),
        ("number of transforms", stats.transforms),
        ("number of sub-steps", stats.parts),
        ("number of stepped cycles", stats.evaluated_cycles),
        ("number of jumps", stats.jumps),
        ("number of rejected jumps", stats.rejected_jumps),
    ] {
        if count as f64 > MOST {
            return Err(Unfit::new(what, format!("is above {MOST:e}")));
        }
    }
    if state.pressure.from > springs {
        return Err(Unfit::new("pressure", "begins beyond the grid"));
    }
    for (what, values) in [
        ("wear", &state.wear[..]),
        ("image of the wear", &state.image),
        ("springs", &contact.spring.nodal),
        ("depth", &[contact.depth]),
        ("shift", &[contact.shift]),
    ] {
        if values.iter().any(|value| !value.is_finite()) {
            return Err(Unfit::new(what, "is not finite"));
        }
    }
    for (what, kinks) in [
        ("springs' kinks", &contact.spring.kinks),
        ("line load's kinks", &contact.load.kinks),
    ] {
        if !are_hats(kinks, setup.grid.squares()) {
            return Err(Unfit::new(what, "do not lie in the grid"));
        }
    }
    let domes = [contact.spring.dome, contact.load.dome];
    if !domes
        .iter()
        .flatten()
        .all(|dome| dome.fits(setup.grid.squares()))
    {
        return Err(Unfit::new(
            "edge of the contact",
            "does not lie in the grid",
        ));
    }
    if contact.normal.nodes > nodes || settled.is_some_and(|settled| settled.touching > nodes) {
        return Err(Unfit::new("contact", "reaches beyond the grid"));
    }
    Ok(())
}

//! Turns the keys of a scenario into parts that can be run. The schema and the parts' constructors
//! check the values; this module adds where in the scenario a refused value is.

use std::fmt::Display;

use toml::{Table, Value};

use super::check::{self, show};
use super::complete;
use super::derive::{self, Contact};
use super::error::{Faults, Origin, ScenarioError};
use super::keys::{self, RunsIn};
use super::schema::{self, Key, Parameter};
use crate::contact::indenter::Indenter;
use crate::contact::material::Material;
use crate::contact::scar::Scar;
use crate::math::abel::AbelMethod;
use crate::math::grid::RadialGrid;
use crate::math::invalid::Invalid;
use crate::simulation::{Integrator, Setup, Spacing};
use crate::wear::WearLaw;

/// Makes the parts of a scenario from the keys that the user gave, and returns them behind the
/// [completed](super::complete::table) keys. Where an accuracy leaves points and steps open, they have their defaults.
///
/// # Errors
///
/// All `faults`, and every key that is missing beside them; without any, what the first part refuses.
pub(super) fn setup(
    table: &mut Table,
    origin: &Origin,
    mut faults: Faults,
) -> Result<(Table, Setup), ScenarioError> {
    // Whatever is wrong, what is missing beside it can be told.
    for path in faults.paths() {
        if schema::remove(table, path).is_some() {
            insert_any_value(table, path);
        }
    }
    loop {
        let complete = complete::table(table);
        let error = match made(&complete, table, origin) {
            Ok(setup) if faults.is_empty() => return Ok((complete, setup)),
            Ok(_) => break,
            Err(error) => error,
        };
        let Some(path) = error.lacks.clone() else {
            return Err(faults.into_error().unwrap_or(error));
        };
        if !faults.covers(&path) {
            faults.note(&path, error);
        }
        if !insert_any_value(table, &path) {
            break;
        }
    }
    Err(faults.into_error().expect("something is missing"))
}

/// Puts some value that is allowed at `path`, if nothing is there and it is that of a key with such values.
fn insert_any_value(table: &mut Table, path: &str) -> bool {
    let known = schema::find(path).filter(|_| schema::at(table, path).is_none());
    let value = known.and_then(Parameter::any_value);
    let is_there = value.is_some();
    if let Some(value) = value {
        schema::insert(table, path, value);
    }
    is_there
}

/// Makes the parts of a scenario, whose keys are `table` with the defaults written out.
fn made(table: &Table, written: &Table, origin: &Origin) -> Result<Setup, ScenarioError> {
    let parts = Parts {
        table,
        written,
        origin,
    };
    check::conflicts(written, origin)?;
    let indenter = parts.indenter()?;
    let drive = parts.drive()?;
    let material = parts.material()?;
    let contact = Contact {
        indenter: &indenter,
        material: &material,
        drive: &drive,
    };
    let wear = parts.wear(&contact)?;
    let running_in = parts.running_in(&material)?;
    let scar = parts.scar()?;
    let domain = parts.get(&keys::DOMAIN_RADIUS).or_else(|| {
        let runs_in = running_in.as_ref().is_some_and(|of| of.friction.is_some());
        contact.domain_radius(!runs_in, scar.as_ref().map_or(0.0, Scar::deepest))
    });
    let method = parts.require(&keys::METHOD)?;
    let (spacing, scheme) = derive::choices(method);
    let grid = parts.grid(method, &indenter, domain)?;
    if let Some(scar) = &scar {
        parts.check_scar(scar, &indenter, grid.radius())?;
    }
    let setup = Setup {
        scar,
        grid,
        hardness: parts.hardness(),
        material,
        indenter,
        drive,
        wear,
        running_in,
        method,
        spacing: parts.spacing(spacing)?,
        scheme: parts.get(&keys::SCHEME).unwrap_or(scheme),
        stability: parts.require(&keys::STABILITY)?,
        steps_per_cycle: parts.require(&keys::STEPS_PER_CYCLE)?,
        integrator: Integrator::new(
            &parts.require(&keys::INTEGRATOR)?,
            parts.require(&keys::TOLERANCE)?,
        )
        .map_err(|invalid| parts.refused("numerics", invalid))?,
    };
    Ok(setup)
}

/// The tables of a scenario, and where they come from: its parts are made from them here and in the modules beside
/// this one, one for each section.
pub(super) struct Parts<'a> {
    /// The values, with the defaults written out.
    table: &'a Table,
    /// The values as the user wrote them, for messages.
    written: &'a Table,
    pub(super) origin: &'a Origin,
}

impl Parts<'_> {
    /// The value of a key, where it is given.
    pub(super) fn get<T>(&self, key: &Key<T>) -> Option<T> {
        key.get(self.table)
    }

    /// A coefficient as a run begins with it: its value, or the first of its table.
    pub(super) fn first(&self, key: &Key<f64>, course: &RunsIn) -> Option<f64> {
        let of_table = || self.get(&course.values)?.first().copied();
        self.get(key).or_else(of_table)
    }

    /// The value of a key, its default, or the error that it is missing.
    pub(super) fn require<T>(&self, key: &Key<T>) -> Result<T, ScenarioError> {
        let value = key.get_or_default(self.table);
        value.ok_or_else(|| self.missing(key))
    }

    /// The error that a key is not given.
    pub(super) fn missing<T>(&self, key: &Key<T>) -> ScenarioError {
        let meaning = key.parameter().described();
        self.origin.missing(key.path(), meaning)
    }

    pub(super) fn has(&self, path: &str) -> bool {
        schema::at(self.written, path).is_some()
    }

    /// Refuses the value that stands at `path`; `otherwise` is shown where none was written.
    pub(super) fn refuse(&self, path: &str, otherwise: &str, rule: impl Display) -> ScenarioError {
        let written = schema::at(self.written, path).map(show);
        let value = written.unwrap_or_else(|| otherwise.to_owned());
        self.origin.refuse(path, &value, rule)
    }

    /// Adds the table to what a constructor refused.
    pub(super) fn refused(&self, section: &str, invalid: Invalid) -> ScenarioError {
        let path = format!("{section}.{}", invalid.field);
        self.refuse(&path, &invalid.value, invalid.rule)
    }

    /// The law of wear. Keys of the power law are judged under either law, so that the law can be
    /// switched during a run.
    fn wear(&self, contact: &Contact) -> Result<Option<WearLaw>, ScenarioError> {
        if !self.has("wear") {
            return Ok(None);
        }
        let is_power = self.require(&keys::LAW)? == "power";
        let coefficient = self.wear_coefficient(contact.material)?;
        let stress = self.get(&keys::REFERENCE_STRESS);
        let slip_rate = self.get(&keys::REFERENCE_SLIP_RATE);
        let (any_stress, any_slip_rate) =
            match is_power && (stress.is_none() || slip_rate.is_none()) {
                true => contact.references().ok_or_else(|| {
                    let meaning = "Pa; none could be found from the contact";
                    self.origin.missing(keys::REFERENCE_STRESS.path(), meaning)
                })?,
                false => (1.0, 1.0),
            };
        let power = WearLaw::power(
            coefficient,
            self.require(&keys::STRESS_EXPONENT)?,
            self.require(&keys::SLIP_RATE_EXPONENT)?,
            stress.unwrap_or(any_stress),
            slip_rate.unwrap_or(any_slip_rate),
        );
        let law = match is_power {
            true => power,
            false => power.and(WearLaw::archard(coefficient)),
        };
        law.map(Some)
            .map_err(|invalid| self.refused("wear", invalid))
    }

    /// k per friction work, 1/Pa: as given, or that per load and distance over the friction that the run
    /// begins with.
    pub(super) fn wear_coefficient(&self, material: &Material) -> Result<f64, ScenarioError> {
        let Some(per_load) = self.get(&keys::WEAR_PER_LOAD) else {
            let given = self.first(&keys::WEAR_COEFFICIENT, &keys::WEAR_COURSE);
            return given.ok_or_else(|| {
                let meaning = keys::WEAR_COEFFICIENT.parameter().described();
                let meaning = format!("{meaning}; or coefficient_per_load, of a pin test");
                self.origin.missing(keys::WEAR_COEFFICIENT.path(), meaning)
            });
        };
        if material.friction() > 0.0 {
            return Ok(per_load / material.friction());
        }
        let rule = "needs friction greater than 0: per friction work it is \
                    k = coefficient_per_load / friction";
        Err(self.refuse(keys::WEAR_PER_LOAD.path(), "", rule))
    }

    fn grid(
        &self,
        method: AbelMethod,
        indenter: &Indenter,
        domain: Option<f64>,
    ) -> Result<RadialGrid, ScenarioError> {
        let points = self.require(&keys::POINTS)? as usize;
        let most = method.most_cells();
        if points > most {
            let rule = format!(
                "must be at most {most} with method = \"{method}\", which has no fast algorithm"
            );
            return Err(self.refuse(keys::POINTS.path(), "", rule));
        }
        if indenter.rim().is_some() && self.get(&keys::DOMAIN_RADIUS).is_some() {
            let shape = indenter.name();
            let rule =
                format!("conflicts with shape = \"{shape}\", whose rim is the domain's edge");
            return Err(self.refuse(keys::DOMAIN_RADIUS.path(), "", rule));
        }
        let radius = domain.ok_or_else(|| {
            self.refuse(
                keys::NORMAL.mean.path(),
                "",
                "no contact can carry this force; must be smaller",
            )
        })?;
        if let Indenter::Table(measured) = indenter {
            self.check_measured(measured, radius)?;
        }
        if indenter
            .flat_face()
            .is_some_and(|tip_radius| tip_radius >= radius)
        {
            let edge = show(&Value::Float(radius));
            let rule = format!("must be less than the domain's edge, {edge} m");
            return Err(self.refuse(keys::TIP_RADIUS.path(), "", rule));
        }
        let grid = match self.get(&keys::NODES) {
            None => RadialGrid::uniform(points, radius),
            Some(nodes) if nodes.len() == points + 1 => RadialGrid::restored(nodes, None),
            Some(nodes) => {
                let rule = format!(
                    "must be {} numbers, one more than points, not {}",
                    points + 1,
                    nodes.len()
                );
                return Err(self.refuse(keys::NODES.path(), "[...]", rule));
            }
        };
        grid.map_err(|invalid| self.refused("numerics", invalid))
    }

    /// Where the nodes lie: as the list says, if there is one.
    fn spacing(&self, default: Spacing) -> Result<Spacing, ScenarioError> {
        let has_nodes = self.get(&keys::NODES).is_some();
        let default = if has_nodes { Spacing::Given } else { default };
        let named = self.get(&keys::GRID).unwrap_or(default);
        match (named, has_nodes) {
            (Spacing::Given, false) => {
                let rule =
                    "needs numerics.nodes, the list that a run with numerics.accuracy writes";
                Err(self.refuse(keys::GRID.path(), "", rule))
            }
            (Spacing::Graded | Spacing::Uniform, true) => {
                let rule = "conflicts with numerics.nodes; give one of them";
                Err(self.refuse(keys::GRID.path(), "", rule))
            }
            _ => Ok(named),
        }
    }
}

//! Turns the keys of a scenario into parts that can be run. The schema and the parts' constructors
//! check the values; this module adds where in the scenario a refused value is.

use std::fmt::Display;

use toml::{Table, Value};

use super::check::show;
use super::error::{Faults, Origin, ScenarioError};
use super::keys;
use super::run::RunPlan;
use super::schema::{self, Key, Parameter};
use super::{complete, derive};
use crate::contact::indenter::Indenter;
use crate::contact::material::Material;
use crate::contact::scar::Scar;
use crate::math::abel::AbelMethod;
use crate::math::grid::RadialGrid;
use crate::math::invalid::Invalid;
use crate::simulation::drive::Drive;
use crate::simulation::running_in::RunningIn;
use crate::simulation::{Integrator, Setup, Spacing};
use crate::wear::WearLaw;

/// Makes the parts of a scenario. Where an accuracy leaves points and steps open, they have their defaults. `table` is the
/// [completed](super::complete::table) one, `written` the one that the user gave.
pub(super) fn setup(
    table: &Table,
    written: &Table,
    origin: &Origin,
) -> Result<Setup, ScenarioError> {
    let parts = Parts {
        table,
        written,
        origin,
    };
    let indenter = parts.indenter()?;
    let drive = parts.drive()?;
    let material = parts.material()?;
    let wear = parts.wear(&indenter, &material, &drive)?;
    let running_in = parts.running_in(&material)?;
    let scar = parts.scar()?;
    let domain = parts.domain_radius(
        &indenter,
        &material,
        &drive,
        running_in.as_ref(),
        scar.as_ref(),
    );
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

/// Notes every key that is missing from `table`, one after the other with a value in its place.
pub(super) fn find_missing(table: &Table, origin: &Origin, faults: &mut Faults) {
    // Each round puts in a key that was not there.
    let mut table = table.clone();
    for _ in 0..keys::PARAMETERS.len() {
        let complete = complete::table(&table);
        let Err(error) = setup(&complete, &table, origin) else {
            return;
        };
        let Some(path) = error.lacks.clone() else {
            return;
        };
        if !faults.covers(&path) {
            faults.note(&path, error);
        }
        match schema::find(&path).and_then(Parameter::any_value) {
            Some(value) => schema::insert(&mut table, &path, value),
            None => return,
        }
    }
}

/// Checks `[run]`.
pub(super) fn run(plan: &RunPlan, origin: &Origin) -> Result<(), ScenarioError> {
    plan.check().map_err(|invalid| {
        let path = format!("run.{}", invalid.field);
        origin.refuse(&path, &invalid.value, invalid.rule)
    })
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

    /// The value of a key, its default, or the error that it is missing.
    pub(super) fn require<T>(&self, key: &Key<T>) -> Result<T, ScenarioError> {
        let value = key.get_or_default(self.table);
        value.ok_or_else(|| self.missing(key))
    }

    /// The error that a key is not given.
    pub(super) fn missing<T>(&self, key: &Key<T>) -> ScenarioError {
        let meaning = key.parameter.described();
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
    fn wear(
        &self,
        indenter: &Indenter,
        material: &Material,
        drive: &Drive,
    ) -> Result<Option<WearLaw>, ScenarioError> {
        if !self.has("wear") {
            return Ok(None);
        }
        let is_power = self.require(&keys::LAW)? == "power";
        let first = self.get(&keys::WEAR_COURSE.values);
        let coefficient = match first.and_then(|values| values.first().copied()) {
            Some(first) => self.get(&keys::WEAR_COEFFICIENT).unwrap_or(first),
            None => self.wear_coefficient(material)?,
        };
        let given = [
            self.get(&keys::REFERENCE_STRESS),
            self.get(&keys::REFERENCE_SLIP_RATE),
        ];
        let (mut stress, mut slip_rate) = (1.0, 1.0);
        if is_power && given.contains(&None) {
            (stress, slip_rate) =
                derive::references(indenter, material, drive).ok_or_else(|| {
                    let meaning = "Pa; none could be found from the contact";
                    self.origin.missing(keys::REFERENCE_STRESS.path(), meaning)
                })?;
        }
        let power = WearLaw::power(
            coefficient,
            self.require(&keys::STRESS_EXPONENT)?,
            self.require(&keys::SLIP_RATE_EXPONENT)?,
            given[0].unwrap_or(stress),
            given[1].unwrap_or(slip_rate),
        );
        let refused = |invalid| self.refused("wear", invalid);
        let power = power.map_err(refused)?;
        let law = if is_power {
            power
        } else {
            WearLaw::archard(coefficient).map_err(refused)?
        };
        Ok(Some(law))
    }

    /// k per friction work, 1/Pa: as given, or that per load and distance over the friction that the run
    /// begins with.
    pub(super) fn wear_coefficient(&self, material: &Material) -> Result<f64, ScenarioError> {
        let Some(per_load) = self.get(&keys::WEAR_PER_LOAD) else {
            let meaning = keys::WEAR_COEFFICIENT.parameter.described();
            let meaning = format!("{meaning}; or coefficient_per_load, of a pin test");
            let given = self.get(&keys::WEAR_COEFFICIENT);
            return given
                .ok_or_else(|| self.origin.missing(keys::WEAR_COEFFICIENT.path(), meaning));
        };
        if material.friction() > 0.0 {
            return Ok(per_load / material.friction());
        }
        let rule = "needs friction greater than 0: per friction work it is \
                    k = coefficient_per_load / friction";
        Err(self.refuse(keys::WEAR_PER_LOAD.path(), "", rule))
    }

    /// The domain's edge, m, as given or as derived.
    fn domain_radius(
        &self,
        indenter: &Indenter,
        material: &Material,
        drive: &Drive,
        running_in: Option<&RunningIn>,
        scar: Option<&Scar>,
    ) -> Option<f64> {
        let given = self.get(&keys::DOMAIN_RADIUS);
        let changes = running_in.is_some_and(|laws| laws.friction.is_some());
        let worn = scar.map_or(0.0, Scar::deepest);
        given.or_else(|| derive::domain_radius(indenter, material, drive, !changes, worn))
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

//! Turns the keys of a scenario into parts that can be run. The schema and the parts' constructors check the values;
//! these modules add where in the scenario a refused value is.
//!
//! Each section of a scenario has its own file.

use std::cell::RefCell;
use std::fmt::Display;
use std::str::FromStr;

use serde::de::DeserializeOwned;
use toml::{Table, Value};

use super::check::{self, show};
use super::complete;
use super::derive;
use super::error::{Faults, Origin, Refusal};
use super::schema::{self, Parameter};
use super::values::{self, join};
use crate::contact::indenter::Indenter;
use crate::contact::material::Material;
use crate::contact::scar::Scar;
use crate::math::abel::{AbelMethod, MOST_DENSE_CELLS};
use crate::math::grid::RadialGrid;
use crate::math::invalid::Invalid;
use crate::simulation::{Integrator, Setup, Spacing, Unworn};
use crate::wear::{Powers, WearLaw};

mod bodies;
mod line;
mod motion;
mod running_in;
mod scar;
mod shape;

/// Ratio beyond which a length is probably in the wrong unit.
const HARDLY_SAME: f64 = 20.0;

/// Makes the parts of a scenario from the keys that the user gave, and returns them after the
/// [completed](super::complete::table) keys. If an accuracy leaves points and steps open, they take their defaults.
///
/// # Errors
///
/// All `faults`, plus every missing key; without any of these, the refusal of the first part that fails.
pub(super) fn setup(
    table: &mut Table,
    origin: &Origin,
    faults: Faults,
) -> Result<(Table, Setup), Refusal> {
    // Replace wrong values, so that missing keys are reported as well.
    for path in faults.paths() {
        let wrong = values::remove(table, path).and_then(|_| schema::find(path));
        if let Some(value) = wrong.and_then(Parameter::any_value) {
            values::insert(table, path, value);
        }
    }
    let complete = complete::table(table);
    let parts = Parts {
        table: &complete,
        written: table,
        origin,
        faults: faults.into(),
    };
    let setup = parts.setup();
    match parts.faults.into_inner().into_error() {
        Some(faults) => Err(faults),
        None => Ok((complete, setup?)),
    }
}

/// The tables of a scenario and their origin. Its parts are made from them here and in the neighbouring modules, one
/// for each section.
pub(super) struct Parts<'a> {
    /// Values including defaults.
    table: &'a Table,
    /// Values as the user wrote them, for messages.
    written: &'a Table,
    origin: &'a Origin,
    /// Errors so far; missing keys are added.
    faults: RefCell<Faults>,
}

impl Parts<'_> {
    /// Makes all parts.
    fn setup(&self) -> Result<Setup, Refusal> {
        check::conflicts(self.written, self.origin)?;
        let indenter = self.indenter()?;
        let geometry = self.geometry(&indenter)?;
        let (drive, material) = self.in_plane(geometry, &indenter)?;
        let contact = Unworn {
            geometry,
            indenter: &indenter,
            material: &material,
            drive: &drive,
        };
        let wear = self.wear(&contact)?;
        let running_in = self.running_in(&material)?;
        let scar = self.scar()?;
        let domain = self.get("numerics.domain_radius").or_else(|| {
            let runs_in = running_in.as_ref().is_some_and(|of| of.friction.is_some());
            contact.domain_radius(!runs_in, scar.as_ref().map_or(0.0, Scar::deepest))
        });
        let method = self.choice("numerics.method")?;
        let (spacing, scheme) = derive::choices(method);
        let grid = self.grid(method, &indenter, domain)?;
        self.check_gauge(&drive, grid.radius())?;
        if let Some(scar) = &scar {
            self.check_scar(scar, &indenter, grid.radius())?;
        }
        Ok(Setup {
            scar,
            grid,
            geometry,
            hardness: self.hardness(),
            material,
            indenter,
            drive,
            wear,
            running_in,
            method,
            spacing: self.spacing(spacing)?,
            scheme: schema::named(self.table, "numerics.scheme").unwrap_or(scheme),
            stability: self.choice("numerics.stability")?,
            steps_per_cycle: self.require("numerics.steps_per_cycle")?,
            integrator: match self.require::<String>("numerics.integrator")?.as_str() {
                "cycle-jump" => Integrator::CycleJump {
                    tolerance: self.require("numerics.tolerance")?,
                },
                _ => Integrator::Direct,
            },
        })
    }

    /// Returns the value of a key, if given.
    fn get<T: DeserializeOwned>(&self, key: &str) -> Option<T> {
        schema::read(self.table, key)
    }

    /// Returns the initial value of a coefficient: its value, or the first in the table of its `section`.
    fn first(&self, key: &str, section: &str) -> Option<f64> {
        let values = || self.get::<Vec<f64>>(&join(section, "values"));
        self.get(key).or_else(|| values()?.first().copied())
    }

    /// Returns the value of a key, or its default. If there is neither, notes the error and returns any allowed value,
    /// so that other missing keys are found too.
    ///
    /// # Errors
    ///
    /// If the key is missing and has no such value.
    fn require<T: DeserializeOwned>(&self, key: &str) -> Result<T, Refusal> {
        let known = schema::known(key);
        let default = || known.default.value()?.clone().try_into().ok();
        let value = self.get(key).or_else(default);
        value.map_or_else(|| self.any(key, known.described()), Ok)
    }

    /// Parses the word of a key.
    ///
    /// # Errors
    ///
    /// As [`require`](Self::require).
    fn choice<T: FromStr>(&self, key: &str) -> Result<T, Refusal> {
        let word: String = self.require(key)?;
        let unknown = |_| self.missing(key, schema::known(key).described());
        word.parse().map_err(unknown)
    }

    /// Returns a list that is read from a `file`, which a key names.
    ///
    /// # Errors
    ///
    /// If there is no list: the key of the file is missing.
    fn list(&self, list: &str, file: &str) -> Result<Vec<f64>, Refusal> {
        let missing = || self.missing(file, schema::known(file).described());
        self.get(list).ok_or_else(missing)
    }

    /// Notes that a key, which means `meaning`, is missing, and returns any allowed value for it.
    fn any<T: DeserializeOwned>(&self, key: &str, meaning: impl Display) -> Result<T, Refusal> {
        let missing = self.missing(key, meaning);
        let any = schema::known(key).any_value();
        any.and_then(|any| any.try_into().ok()).ok_or(missing)
    }

    /// Notes that the value at `path`, which means `meaning`, is missing, unless an error already covers it.
    fn missing(&self, path: &str, meaning: impl Display) -> Refusal {
        let error = self.origin.missing(path, meaning);
        let mut faults = self.faults.borrow_mut();
        if !faults.covers(path) {
            faults.note(path, || error.clone());
        }
        error
    }

    fn has(&self, path: &str) -> bool {
        values::at(self.written, path).is_some()
    }

    /// Refuses the value at `path`, if one was written.
    fn refuse(&self, path: &str, rule: impl Display) -> Refusal {
        let written = values::at(self.written, path).map(show);
        self.origin.refuse(path, &written.unwrap_or_default(), rule)
    }

    /// Turns the refusal of a part's constructor into an error about a key of `section`.
    fn refused(&self, section: &str) -> impl Fn(Invalid) -> Refusal {
        move |invalid| {
            let path = join(section, invalid.field);
            if self.has(&path) {
                self.refuse(&path, invalid.rule)
            } else {
                self.origin.refuse(&path, &invalid.value, invalid.rule)
            }
        }
    }

    /// Builds the wear law. Keys of the power law are checked under either law, so that the law can be switched during
    /// a run.
    fn wear(&self, contact: &Unworn) -> Result<Option<WearLaw>, Refusal> {
        if !self.has("wear") {
            return Ok(None);
        }
        let is_power = self.require::<String>("wear.law")? == "power";
        let coefficient = self.wear_coefficient(contact.material)?;
        let stress = self.get("wear.reference_stress");
        let slip_rate = self.get("wear.reference_slip_rate");
        let (any_stress, any_slip_rate) = if is_power && (stress.is_none() || slip_rate.is_none()) {
            contact.references().ok_or_else(|| {
                let meaning = "Pa; none could be found from the contact";
                self.missing("wear.reference_stress", meaning)
            })?
        } else {
            (1.0, 1.0)
        };
        let powers = Powers {
            stress_exponent: self.require("wear.stress_exponent")?,
            slip_rate_exponent: self.require("wear.slip_rate_exponent")?,
            reference_stress: stress.unwrap_or(any_stress),
            reference_slip_rate: slip_rate.unwrap_or(any_slip_rate),
        };
        let power = WearLaw::power(coefficient, powers);
        let law = if is_power {
            power
        } else {
            power.and(WearLaw::archard(coefficient))
        };
        law.map(Some).map_err(self.refused("wear"))
    }

    /// Returns k per friction work, 1/Pa: as given, or the coefficient
    /// per load and distance divided by the initial friction.
    fn wear_coefficient(&self, material: &Material) -> Result<f64, Refusal> {
        let Some(per_load) = self.get::<f64>("wear.coefficient_per_load") else {
            let given = self.first("wear.coefficient", "wear");
            let key = "wear.coefficient";
            let meaning = schema::known(key).described();
            let meaning = format!("{meaning}; or coefficient_per_load, of a pin test");
            return given.map_or_else(|| self.any(key, meaning), Ok);
        };
        if material.friction() > 0.0 {
            return Ok(per_load / material.friction());
        }
        let rule = "needs friction greater than 0: per friction work it is \
                    k = coefficient_per_load / friction";
        Err(self.refuse("wear.coefficient_per_load", rule))
    }

    fn grid(
        &self,
        method: AbelMethod,
        indenter: &Indenter,
        domain: Option<f64>,
    ) -> Result<RadialGrid, Refusal> {
        let points: usize = self.require("numerics.points")?;
        let (most, what) = if self.is_line() {
            (MOST_DENSE_CELLS, "geometry = \"line\"".to_owned())
        } else {
            (method.most_cells(), format!("method = \"{method}\""))
        };
        if points > most {
            let rule = format!("must be at most {most} with {what}, which has no fast algorithm");
            return Err(self.refuse("numerics.points", rule));
        }
        if indenter.rim().is_some() && self.has("numerics.domain_radius") {
            let shape = indenter.name();
            let rule =
                format!("conflicts with shape = \"{shape}\", whose rim is the domain's edge");
            return Err(self.refuse("numerics.domain_radius", rule));
        }
        let too_large = "no contact can carry this force; must be smaller";
        let radius = domain.ok_or_else(|| self.refuse("motion.normal.mean", too_large))?;
        if let Indenter::Table(measured) = indenter {
            self.check_measured(measured, radius)?;
        }
        if indenter.tip_radius() >= radius {
            let edge = show(&Value::Float(radius));
            let rule = format!("must be less than the domain's edge, {edge} m");
            return Err(self.refuse("indenter.tip_radius", rule));
        }
        let grid = match self.get::<Vec<f64>>("numerics.nodes") {
            None => RadialGrid::uniform(points, radius),
            Some(nodes) if nodes.len() == points + 1 => RadialGrid::restored(nodes, None),
            Some(nodes) => {
                let (wanted, given) = (points + 1, nodes.len());
                let rule = format!("must be {wanted} numbers, one more than points, not {given}");
                return Err(self.refuse("numerics.nodes", rule));
            }
        };
        grid.map_err(self.refused("numerics"))
    }

    /// Returns the spacing of the nodes; a list of nodes takes precedence.
    fn spacing(&self, default: Spacing) -> Result<Spacing, Refusal> {
        let has_nodes = self.has("numerics.nodes");
        let default = if has_nodes { Spacing::Given } else { default };
        let named = schema::named(self.table, "numerics.grid").unwrap_or(default);
        match (named, has_nodes) {
            (Spacing::Given, false) => {
                let rule =
                    "needs numerics.nodes, the list that a run with numerics.accuracy writes";
                Err(self.refuse("numerics.grid", rule))
            }
            (Spacing::Graded | Spacing::Uniform, true) => {
                let rule = "conflicts with numerics.nodes; give one of them";
                Err(self.refuse("numerics.grid", rule))
            }
            _ => Ok(named),
        }
    }
}

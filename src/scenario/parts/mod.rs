//! Turns the keys of a scenario into parts that can be run. The schema and the parts' constructors check the values;
//! these modules add where in the scenario a refused value is.
//!
//! Each section of a scenario has its own file. Parts that do not depend on each other are all made before the first that
//! failed ends it, so that every error is told at once.

use std::cell::RefCell;
use std::fmt::Display;

use toml::Value;

use super::derive;
use super::error::{Faults, Origin, Refusal};
use super::schema;
use super::spec::{Geometry, NORMAL, Passage, Spec, TANGENTIAL, Wear};
use super::values::{join, show};
use crate::contact::indenter::Indenter;
use crate::contact::scar::Scar;
use crate::math::abel::{AbelMethod, MOST_DENSE_CELLS};
use crate::math::grid::RadialGrid;
use crate::math::invalid::Invalid;
use crate::simulation::{Integrator, Setup, Spacing, Unworn};
use crate::wear::{Parameters, Unmade, WearLaw};

mod bodies;
mod line;
mod motion;
mod running_in;
mod scar;
mod shape;

/// Ratio beyond which a length is probably in the wrong unit.
const HARDLY_SAME: f64 = 20.0;

/// Sections of a scenario.
const INDENTER: &str = "indenter";
const FRICTION: &str = "friction";
const WEAR: &str = "wear";
const NUMERICS: &str = "numerics";

/// Makes the parts of a scenario from the keys that the user has `written`, and returns them after all of its keys. If
/// an accuracy leaves points and steps open, they take their defaults.
///
/// # Errors
///
/// All `faults`, plus every missing key and what the parts refuse.
pub(super) fn setup(spec: &mut Spec, origin: &Origin, faults: Faults) -> Result<Setup, Refusal> {
    let conflict = conflicts(spec, origin);
    spec.fill();
    let parts = Parts {
        spec,
        usual: Spec::usual(),
        conflict,
        origin,
        faults: faults.into(),
    };
    let setup = parts.setup();
    match (parts.faults.into_inner().into_error(), setup) {
        (None, Ok(setup)) => Ok(setup),
        (faults, _) => Err(faults.expect("a part that cannot be made has noted why")),
    }
}

/// The first of the keys that exclude each other.
fn conflicts(spec: &Spec, origin: &Origin) -> Option<Refusal> {
    let given = |keys: &[&'static str]| keys.iter().copied().find(|key| spec.has(key));
    schema::SCHEMA.exclusive.iter().find_map(|of| {
        let (key, other) = (given(&of.keys)?, given(&of.others)?);
        let rule = format!("conflicts with {}", of.rule.replace("{}", other));
        let value = || Some(spec.get(schema::find(key)?)?.literal());
        let shown = origin.shown(key).or_else(value).unwrap_or_default();
        Some(origin.refuse(key, &shown, rule))
    })
}

/// An error was noted.
#[derive(Debug)]
struct Noted;

/// The keys of a scenario and their origin. Its parts are made from them here and in the neighbouring modules, one for
/// each section.
pub(super) struct Parts<'a> {
    spec: &'a Spec,
    /// Defaults.
    usual: &'a Spec,
    /// Keys that exclude each other.
    conflict: Option<Refusal>,
    origin: &'a Origin,
    /// Errors so far.
    faults: RefCell<Faults>,
}

/// A section of a scenario, whose keys errors blame.
#[derive(Clone, Copy)]
struct Section<'a> {
    parts: &'a Parts<'a>,
    path: &'static str,
}

impl Section<'_> {
    /// Passes the value of a key.
    ///
    /// # Errors
    ///
    /// If the key is missing or wrong.
    fn need<T>(self, key: &str, value: Option<T>) -> Result<T, Noted> {
        let value = value.filter(|_| !self.is_blamed(key));
        value.ok_or_else(|| self.missing(key, self.described(key)))
    }

    /// Returns `list`, whose values come from the file that a key names.
    ///
    /// # Errors
    ///
    /// If there is no list: the key of the file is missing.
    fn need_list<'b>(
        self,
        key: &str,
        list: &'b Option<Vec<f64>>,
        file: &str,
    ) -> Result<&'b [f64], Noted> {
        match list {
            Some(list) => Ok(list),
            None if self.is_blamed(key) => Err(Noted),
            None => Err(self.missing(file, self.described(file))),
        }
    }

    /// Describes a key.
    fn described(self, key: &str) -> String {
        schema::known(&join(self.path, key)).described()
    }

    /// Whether an error covers a key.
    fn is_blamed(self, key: &str) -> bool {
        self.parts.faults.borrow().covers(&join(self.path, key))
    }

    /// Notes that a key, which means `meaning`, is missing, unless an error already covers it.
    fn missing(self, key: &str, meaning: impl Display) -> Noted {
        let path = join(self.path, key);
        if !self.is_blamed(key) {
            let missing = || self.parts.origin.missing(&path, meaning);
            self.parts.faults.borrow_mut().note(&path, missing);
        }
        Noted
    }

    /// Refuses the value of a key; `value` is shown where none was written.
    fn refuse_value(self, key: &str, value: &str, rule: impl Display) -> Noted {
        let path = join(self.path, key);
        let origin = self.parts.origin;
        let given = || {
            let value = self.parts.spec.get(schema::find(&path)?)?;
            Some(super::escape::echo(&value.literal()))
        };
        let written = origin.shown(&path).or_else(given);
        let shown = written.as_deref().unwrap_or(value);
        let refusal = || self.parts.origin.refuse(&path, shown, rule);
        self.parts.faults.borrow_mut().note(&path, refusal);
        Noted
    }

    /// Refuses the value of a key.
    fn refuse(self, key: &str, rule: impl Display) -> Noted {
        self.refuse_value(key, "", rule)
    }

    /// Turns the refusal of a part's constructor into an error about a key.
    fn refused(self, invalid: Invalid) -> Noted {
        self.refuse_value(invalid.field, &invalid.value, invalid.rule)
    }
}

impl<'a> Parts<'a> {
    fn at(&'a self, path: &'static str) -> Section<'a> {
        Section { parts: self, path }
    }

    /// Makes all parts.
    fn setup(&self) -> Result<Setup, Noted> {
        if let Some(conflict) = &self.conflict {
            self.faults.borrow_mut().note("", || conflict.clone());
            return Err(Noted);
        }
        let (indenter, drive) = (self.indenter(), self.drive());
        let (material, wear_coefficient) = (self.material(), self.wear_coefficient());
        let (running_in, scar) = (self.running_in(), self.scar());
        let indenter = indenter?;
        let geometry = self.geometry(&indenter)?;
        let (drive, material) = self.in_plane(geometry, &indenter, drive?, material?)?;
        let contact = Unworn {
            geometry,
            indenter: &indenter,
            material: &material,
            drive: &drive,
        };
        let wear = match &self.spec.wear {
            Some(wear) => Some(self.wear(wear, wear_coefficient?, &contact)?),
            None => None,
        };
        let (running_in, scar) = (running_in?, scar?);
        let numerics = &self.spec.numerics;
        let domain = numerics.domain_radius.or_else(|| {
            let runs_in = running_in.as_ref().is_some_and(|of| of.friction.is_some());
            contact.domain_radius(!runs_in, scar.as_ref().map_or(0.0, Scar::deepest))
        });
        let (at, usual) = (self.at(NUMERICS), &self.usual.numerics);
        let method = at.need("method", numerics.method)?;
        let (spacing, scheme) = derive::choices(method);
        let grid = self.grid(method, &indenter, domain)?;
        self.check_gauge(&drive, grid.radius())?;
        if let Some(scar) = &scar {
            self.check_scar(scar, &indenter, grid.radius())?;
        }
        let tolerance = numerics.tolerance.or(usual.tolerance);
        let steps = numerics.steps_per_cycle.or(usual.steps_per_cycle);
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
            scheme: numerics.scheme.unwrap_or(scheme),
            stability: at.need("stability", numerics.stability)?,
            steps_per_cycle: at.need("steps_per_cycle", steps)?,
            integrator: match numerics.integrator {
                Some(Passage::CycleJump) => Integrator::CycleJump {
                    tolerance: at.need("tolerance", tolerance)?,
                },
                _ => Integrator::Direct,
            },
        })
    }

    /// Builds the wear law. Keys that are not given follow from the contact, if the law needs them.
    fn wear(&self, wear: &Wear, coefficient: f64, contact: &Unworn) -> Result<WearLaw, Noted> {
        let (at, usual) = (self.at(WEAR), self.usual.wear.as_ref());
        let law = wear
            .law
            .ok_or_else(|| at.missing("law", at.described("law")))?;
        let usual = usual.map_or_else(Parameters::default, |usual| usual.parameters);
        let given = wear.parameters.or(usual);
        let mut made = WearLaw::new(law, coefficient, &given);
        if let Err(Unmade::Missing(_)) = made
            && let Some(contact) = contact.references()
        {
            made = WearLaw::new(law, coefficient, &given.or(Parameters::usual_for(contact)));
        }
        made.map_err(|unmade| match unmade {
            Unmade::Missing(key) => {
                let unit = schema::known(&join(WEAR, key)).unit;
                at.missing(key, format!("{unit}; none could be found from the contact"))
            }
            Unmade::Invalid(invalid) => at.refused(invalid),
        })
    }

    /// Returns k per friction work, 1/Pa: as given, or the coefficient per load and distance divided by the initial
    /// friction; 0 where nothing wears.
    fn wear_coefficient(&self) -> Result<f64, Noted> {
        let Some(wear) = &self.spec.wear else {
            return Ok(0.0);
        };
        let (at, key) = (self.at(WEAR), "coefficient_per_load");
        let Some(per_load) = wear.coefficient_per_load else {
            let meaning = at.described("coefficient") + "; or coefficient_per_load, of a pin test";
            return match wear.per_work.first() {
                Some(coefficient) => Ok(coefficient),
                None if at.is_blamed(key) => Err(Noted),
                None => Err(at.missing("coefficient", meaning)),
            };
        };
        let friction = self.friction()?;
        if friction > 0.0 {
            return Ok(per_load / friction);
        }
        let rule = "needs friction greater than 0: per friction work it is \
                    k = coefficient_per_load / friction";
        Err(at.refuse(key, rule))
    }

    fn grid(
        &self,
        method: AbelMethod,
        indenter: &Indenter,
        domain: Option<f64>,
    ) -> Result<RadialGrid, Noted> {
        let (at, numerics) = (self.at(NUMERICS), &self.spec.numerics);
        let points = numerics.points.or(self.usual.numerics.points);
        let points = at.need("points", points)?;
        let (most, what) = match self.spec.indenter.geometry {
            Some(Geometry::Line) => (MOST_DENSE_CELLS, "geometry = \"line\"".to_owned()),
            _ => (method.most_cells(), format!("method = \"{method}\"")),
        };
        if points > most {
            let rule = format!("must be at most {most} with {what}, which has no fast algorithm");
            return Err(at.refuse("points", rule));
        }
        if indenter.rim().is_some() && numerics.domain_radius.is_some() {
            let shape = indenter.name();
            let rule =
                format!("conflicts with shape = \"{shape}\", whose rim is the domain's edge");
            return Err(at.refuse("domain_radius", rule));
        }
        let too_large = "no contact can carry this force; must be smaller";
        let radius = domain.ok_or_else(|| self.at(NORMAL).refuse("mean", too_large))?;
        if let Indenter::Table(measured) = indenter {
            self.check_measured(measured, radius)?;
        }
        if indenter.tip_radius() >= radius {
            let edge = show(&Value::Float(radius));
            let rule = format!("must be less than the domain's edge, {edge} m");
            return Err(self.at(INDENTER).refuse("tip_radius", rule));
        }
        let grid = match &numerics.nodes {
            None => RadialGrid::uniform(points, radius),
            Some(nodes) if nodes.len() == points + 1 => RadialGrid::restored(nodes.clone(), None),
            Some(nodes) => {
                let (wanted, given) = (points + 1, nodes.len());
                let rule = format!("must be {wanted} numbers, one more than points, not {given}");
                return Err(at.refuse("nodes", rule));
            }
        };
        grid.map_err(|invalid| at.refused(invalid))
    }

    /// Returns the spacing of the nodes; a list of nodes takes precedence.
    fn spacing(&self, default: Spacing) -> Result<Spacing, Noted> {
        let numerics = &self.spec.numerics;
        let has_nodes = numerics.nodes.is_some();
        let default = if has_nodes { Spacing::Given } else { default };
        let named = numerics.grid.unwrap_or(default);
        let rule = match (named, has_nodes) {
            (Spacing::Given, false) => {
                "needs numerics.nodes, the list that a run with numerics.accuracy writes"
            }
            (Spacing::Graded | Spacing::Uniform, true) => {
                "conflicts with numerics.nodes; give one of them"
            }
            _ => return Ok(named),
        };
        Err(self.at(NUMERICS).refuse("grid", rule))
    }
}

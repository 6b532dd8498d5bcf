//! From the serde mirror to parts that can be run: the parts' own constructors judge, and this file
//! says where in the scenario the refused value stands.

use toml::{Table, Value};

use super::accuracy::{self, Choices, RUNGS, Scene};
use super::check::{missing, show};
use super::derive;
use super::error::{Origin, ScenarioError};
use super::parameters::{self, PARAMETERS};
use super::raw::{Raw, RawBody, RawOscillation};
use super::read;
use super::run::RunPlan;
use super::write;
use crate::contact::indenter::Indenter;
use crate::contact::material::{Body, Material};
use crate::math::abel::AbelMethod;
use crate::math::grid::{MAX_CELLS, RadialGrid};
use crate::math::invalid::Invalid;
use crate::simulation::drive::{Control, Drive, Oscillation};
use crate::simulation::{Integrator, Setup};
use crate::wear::WearLaw;

/// The most steps in a cycle.
const MOST_STEPS: i64 = 1_000_000;

/// The most periods of the normal motion in a cycle.
const HIGHEST_RATIO: f64 = 1000.0;

/// Makes the parts of a scenario, and what is known of its accuracy; `table` is what `raw` mirrors.
pub(super) fn setup(
    raw: &Raw,
    table: &Table,
    origin: &Origin,
) -> Result<(Setup, Scene), ScenarioError> {
    let parts = Parts { raw, table, origin };
    let indenter = parts.indenter()?;
    let drive = parts.drive()?;
    let material = parts.material()?;
    let wear = parts.wear(&indenter, &material, &drive)?;
    let cycles = accuracy::planned(&raw.run);
    let domain = parts.domain_radius(&indenter, &material, &drive);
    let scene = Scene::of(&indenter, &material, &drive, wear.as_ref(), domain, cycles);
    let resolved = &raw.resolved(&scene);
    let parts = Parts {
        raw: resolved,
        table,
        origin,
    };
    let numerics = &resolved.numerics;
    let refused = |invalid| parts.refused("numerics", invalid);
    let method = parts.require(numerics.method.as_deref(), "numerics.method")?;
    let method: AbelMethod = method.parse().map_err(refused)?;
    let (spacing, scheme) = derive::choices(method);
    let setup = Setup {
        grid: parts.grid(method, &indenter, domain)?,
        material,
        indenter,
        drive,
        wear,
        method,
        spacing: match numerics.grid.as_deref() {
            Some(name) => name.parse().map_err(refused)?,
            None => spacing,
        },
        scheme: match numerics.scheme.as_deref() {
            Some(name) => name.parse().map_err(refused)?,
            None => scheme,
        },
        stability: parts
            .require(numerics.stability.as_deref(), "numerics.stability")?
            .parse()
            .map_err(refused)?,
        steps_per_cycle: parts.steps_per_cycle()?,
        integrator: Integrator::new(
            &parts.require(numerics.integrator.clone(), "numerics.integrator")?,
            numerics.tolerance.unwrap_or(Integrator::DEFAULT_TOLERANCE),
        )
        .map_err(refused)?,
    };
    Ok((setup, scene))
}

/// What an accuracy chooses in a table; as for any scene where the table makes none yet.
pub(super) fn chosen(table: &Table, accuracy: f64) -> Choices {
    let origin = Origin::new("");
    let scene = read::mirror(table.clone(), &origin).and_then(|mut raw| {
        raw.fill_in();
        setup(&raw, table, &origin)
    });
    let scene = scene.map_or(Scene::ANY, |(_, scene)| scene);
    scene.choices(accuracy)
}

/// Refuses an accuracy out of range, and one beside what it is to choose.
pub(super) fn accuracy(raw: &Raw, table: &Table, origin: &Origin) -> Result<(), ScenarioError> {
    let Some(accuracy) = raw.numerics.accuracy else {
        return Ok(());
    };
    let parts = Parts { raw, table, origin };
    let [most, .., least] = RUNGS;
    if !(least..=most).contains(&accuracy) {
        return Err(parts.out_of_range("numerics.accuracy"));
    }
    for path in CHOSEN_BY_ACCURACY {
        if write::at(table, path).is_some() {
            let rule = format!("does not go with {path}, which it chooses; give either");
            return Err(parts.refuse("numerics.accuracy", "", rule));
        }
    }
    Ok(())
}

/// What `numerics.accuracy` stands for.
pub(super) const CHOSEN_BY_ACCURACY: [&str; 4] = [
    "numerics.method",
    "numerics.points",
    "numerics.steps_per_cycle",
    "numerics.tolerance",
];

/// Checks `[run]`.
pub(super) fn run(plan: &RunPlan, origin: &Origin) -> Result<(), ScenarioError> {
    plan.check().map_err(|invalid| {
        let path = format!("run.{}", invalid.field);
        origin.refuse(&path, &invalid.value, invalid.rule)
    })
}

struct Parts<'a> {
    raw: &'a Raw,
    table: &'a Table,
    origin: &'a Origin,
}

impl Parts<'_> {
    /// The value at `path`, or the error that it is missing.
    fn require<T>(&self, value: Option<T>, path: &str) -> Result<T, ScenarioError> {
        value.ok_or_else(|| match parameters::find(path) {
            Some(parameter) => missing(self.origin, path, parameter),
            None => self.missing(path, "needed here"),
        })
    }

    fn missing(&self, path: &str, meaning: &str) -> ScenarioError {
        ScenarioError::Missing {
            origin: self.origin.name().to_owned(),
            path: path.to_owned(),
            meaning: meaning.to_owned(),
        }
    }

    fn has(&self, path: &str) -> bool {
        write::at(self.table, path).is_some()
    }

    /// Refuses the value that stands at `path`; `otherwise` is shown where none was written.
    fn refuse(&self, path: &str, otherwise: &str, rule: impl Into<String>) -> ScenarioError {
        let written = write::at(self.table, path).map(show);
        let value = written.unwrap_or_else(|| otherwise.to_owned());
        self.origin.refuse(path, &value, rule)
    }

    /// Adds the table to what a constructor refused.
    fn refused(&self, section: &str, invalid: Invalid) -> ScenarioError {
        let path = format!("{section}.{}", invalid.field);
        self.refuse(&path, &invalid.value, invalid.rule)
    }

    fn indenter(&self) -> Result<Indenter, ScenarioError> {
        let raw = &self.raw.indenter;
        let shape = self.require(raw.shape.as_deref(), "indenter.shape")?;
        let of_shapes = || PARAMETERS.iter().filter(|known| !known.shapes.is_empty());
        for parameter in of_shapes() {
            if self.has(parameter.path) && !parameter.shapes.contains(&shape) {
                let takes = of_shapes().filter(|known| known.shapes.contains(&shape));
                let takes: Vec<&str> = takes.map(|known| known.key()).collect();
                let rule = format!(
                    "does not belong to shape = \"{shape}\", which takes {}",
                    takes.join(", ")
                );
                return Err(self.refuse(parameter.path, "", rule));
            }
        }
        let size = |value, path| self.require(value, path);
        let radius = || size(raw.radius, "indenter.radius");
        let angle = || size(raw.angle, "indenter.angle");
        let tip_radius = || size(raw.tip_radius, "indenter.tip_radius");
        match shape {
            "cone" => Indenter::cone(angle()?),
            "power" => Indenter::power(
                size(raw.coefficient, "indenter.coefficient")?,
                size(raw.exponent, "indenter.exponent")?,
            ),
            "flat-punch" => Indenter::flat_punch(radius()?),
            "truncated-paraboloid" => Indenter::truncated_paraboloid(radius()?, tip_radius()?),
            "truncated-cone" => Indenter::truncated_cone(angle()?, tip_radius()?),
            _ => Indenter::paraboloid(radius()?),
        }
        .map_err(|invalid| self.refused("indenter", invalid))
    }

    fn material(&self) -> Result<Material, ScenarioError> {
        let raw = &self.raw.material;
        let friction = match self.raw.friction.coefficient {
            None if self.raw.motion.tangential.is_some() => {
                let meaning = "coefficient of friction, which the tangential motion needs";
                return Err(self.missing("friction.coefficient", meaning));
            }
            friction => friction.unwrap_or(0.0),
        };
        let refused = |invalid: Invalid| match invalid.field {
            "coefficient" => self.refused("friction", invalid),
            "rigid" => self.refused("material.half_space", invalid),
            _ => self.refused("material", invalid),
        };
        if raw.indenter.is_none() && raw.half_space.is_none() {
            let modulus = self.require(raw.effective_modulus, "material.effective_modulus")?;
            let poisson = self.require(raw.poisson, "material.poisson")?;
            return Material::new(modulus, poisson, friction).map_err(refused);
        }
        for path in ["material.effective_modulus", "material.poisson"] {
            if self.has(path) {
                let rule = "does not go with two bodies; give either effective_modulus and poisson, \
                            or [material.indenter] and [material.half_space]";
                return Err(self.refuse(path, "", rule));
            }
        }
        let indenter = self.body(raw.indenter.as_ref(), "material.indenter")?;
        let half_space = self.body(raw.half_space.as_ref(), "material.half_space")?;
        Material::of_bodies(indenter, half_space, friction).map_err(refused)
    }

    fn body(&self, raw: Option<&RawBody>, section: &str) -> Result<Body, ScenarioError> {
        let Some(raw) = raw else {
            let meaning = "the second body, with youngs_modulus and poisson, or rigid = true";
            return Err(self.missing(section, meaning));
        };
        let [modulus, poisson] =
            ["youngs_modulus", "poisson"].map(|key| format!("{section}.{key}"));
        if raw.rigid == Some(true) {
            let given = [&modulus, &poisson].into_iter().find(|path| self.has(path));
            return match given {
                Some(path) => Err(self.refuse(path, "", "does not belong to a body that is rigid")),
                None => Ok(Body::Rigid),
            };
        }
        Body::elastic(
            self.require(raw.youngs_modulus, &modulus)?,
            self.require(raw.poisson, &poisson)?,
        )
        .map_err(|invalid| self.refused(section, invalid))
    }

    fn drive(&self) -> Result<Drive, ScenarioError> {
        let motion = &self.raw.motion;
        let mean = self.require(motion.normal.mean, "motion.normal.mean")?;
        let other = motion
            .tangential
            .as_ref()
            .and_then(|raw| raw.angular_frequency);
        let normal = self.control(&motion.normal, mean, other, "motion.normal")?;
        if normal.oscillation().highest() <= 0.0 {
            let rule = "never touches; mean + amplitude must be greater than 0";
            return Err(self.refuse("motion.normal.mean", "", rule));
        }
        let tangential = motion.tangential.as_ref().map(|raw| {
            let other = motion.normal.angular_frequency;
            self.control(raw, raw.mean.unwrap_or(0.0), other, "motion.tangential")
        });
        let tangential = tangential.transpose()?;
        let frequency = |control: &Control| control.oscillation().angular_frequency();
        let cycle = tangential.as_ref().map(frequency);
        if cycle.is_some_and(|cycle| frequency(&normal) > HIGHEST_RATIO * cycle) {
            let rule = format!(
                "must be at most {HIGHEST_RATIO} times motion.tangential.angular_frequency, \
                 whose period is the cycle"
            );
            return Err(self.refuse("motion.normal.angular_frequency", "", rule));
        }
        Ok(Drive::new(normal, tangential))
    }

    /// One direction of the motion. Where it stands still its frequency is that of the other
    /// direction, so that both share one period.
    fn control(
        &self,
        raw: &RawOscillation,
        mean: f64,
        other_frequency: Option<f64>,
        section: &str,
    ) -> Result<Control, ScenarioError> {
        let amplitude = raw.amplitude.unwrap_or(0.0);
        let frequency = match raw.angular_frequency {
            None if amplitude == 0.0 => other_frequency.filter(|other| *other > 0.0).unwrap_or(1.0),
            given => self.require(given, &format!("{section}.angular_frequency"))?,
        };
        let oscillation = Oscillation::new(mean, amplitude, frequency, raw.phase.unwrap_or(0.0))
            .map_err(|invalid| self.refused(section, invalid))?;
        Ok(match raw.control.as_deref() {
            Some("force") => Control::Force(oscillation),
            _ => Control::Displacement(oscillation),
        })
    }

    /// The law of wear. Keys of the power law are judged under either law, so that the law can be
    /// switched during a run.
    fn wear(
        &self,
        indenter: &Indenter,
        material: &Material,
        drive: &Drive,
    ) -> Result<Option<WearLaw>, ScenarioError> {
        let Some(raw) = &self.raw.wear else {
            return Ok(None);
        };
        let is_power = raw.law.as_deref() == Some("power");
        let coefficient = self.require(raw.coefficient, "wear.coefficient")?;
        let (mut stress, mut slip_rate) = (1.0, 1.0);
        if is_power && (raw.reference_stress.is_none() || raw.reference_slip_rate.is_none()) {
            (stress, slip_rate) =
                derive::references(indenter, material, drive).ok_or_else(|| {
                    self.missing(
                        "wear.reference_stress",
                        "Pa; none could be found from the contact",
                    )
                })?;
        }
        let power = WearLaw::power(
            coefficient,
            raw.stress_exponent.unwrap_or(1.5),
            raw.slip_rate_exponent.unwrap_or(1.0),
            raw.reference_stress.unwrap_or(stress),
            raw.reference_slip_rate.unwrap_or(slip_rate),
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

    /// The domain's edge, m, as given or as derived.
    fn domain_radius(
        &self,
        indenter: &Indenter,
        material: &Material,
        drive: &Drive,
    ) -> Option<f64> {
        let given = self.raw.numerics.domain_radius;
        given.or_else(|| derive::domain_radius(indenter, material, drive.normal()))
    }

    fn grid(
        &self,
        method: AbelMethod,
        indenter: &Indenter,
        domain: Option<f64>,
    ) -> Result<RadialGrid, ScenarioError> {
        let numerics = &self.raw.numerics;
        let points = self.require(numerics.points, "numerics.points")?;
        let points = usize::try_from(points).map_err(|_| self.out_of_range("numerics.points"))?;
        let most = method.most_cells();
        if points > most && points <= MAX_CELLS {
            let rule = format!(
                "must be at most {most} with method = \"{method}\", which has no fast form"
            );
            return Err(self.refuse("numerics.points", "", rule));
        }
        if indenter.rim().is_some() && numerics.domain_radius.is_some() {
            let shape = indenter.name();
            let rule =
                format!("does not go with shape = \"{shape}\", whose rim is the domain's edge");
            return Err(self.refuse("numerics.domain_radius", "", rule));
        }
        let radius = domain.ok_or_else(|| {
            self.refuse(
                "motion.normal.mean",
                "",
                "no contact carries this force; must be smaller",
            )
        })?;
        if indenter
            .kink()
            .is_some_and(|tip_radius| tip_radius >= radius)
        {
            let edge = show(&Value::Float(radius));
            let rule = format!("must be less than the domain's edge, {edge} m");
            return Err(self.refuse("indenter.tip_radius", "", rule));
        }
        RadialGrid::uniform(points, radius).map_err(|invalid| self.refused("numerics", invalid))
    }

    fn steps_per_cycle(&self) -> Result<u32, ScenarioError> {
        let steps = self.require(
            self.raw.numerics.steps_per_cycle,
            "numerics.steps_per_cycle",
        )?;
        let allowed = (1..=MOST_STEPS).contains(&steps);
        let steps = u32::try_from(steps).ok().filter(|_| allowed);
        steps.ok_or_else(|| self.out_of_range("numerics.steps_per_cycle"))
    }

    /// Refuses a number outside the range that the table of parameters gives.
    fn out_of_range(&self, path: &str) -> ScenarioError {
        let range = parameters::find(path).map_or("", |parameter| parameter.range);
        self.refuse(path, "", format!("must be {range}"))
    }
}

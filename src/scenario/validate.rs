//! Turns the keys of a scenario into parts that can be run. The schema and the parts' constructors
//! check the values; this module adds where in the scenario a refused value is.

use toml::{Table, Value};

use super::check::{missing, show};
use super::derive;
use super::error::{Origin, ScenarioError};
use super::keys::{self, CHOSEN_BY_ACCURACY, PARAMETERS};
use super::run::RunPlan;
use super::schema::{self, Key};
use crate::contact::indenter::Indenter;
use crate::contact::material::{Body, Material};
use crate::contact::measured::MeasuredProfile;
use crate::contact::scar::Scar;
use crate::math::abel::AbelMethod;
use crate::math::grid::RadialGrid;
use crate::math::invalid::Invalid;
use crate::simulation::drive::{Control, Drive, Oscillation};
use crate::simulation::running_in::RunningIn;
use crate::simulation::waveform::{Tabled, Waveform};
use crate::simulation::{Integrator, Setup};
use crate::wear::WearLaw;

/// The most periods of the normal motion in a cycle.
const HIGHEST_RATIO: f64 = 1000.0;

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
    let running_in = parts.running_in()?;
    let scar = parts.scar()?;
    let domain = parts.domain_radius(
        &indenter,
        &material,
        &drive,
        running_in.as_ref(),
        scar.as_ref(),
    );
    let refused = |invalid| parts.refused("numerics", invalid);
    let method: AbelMethod = parts.require(&keys::METHOD)?.parse().map_err(refused)?;
    let (spacing, scheme) = derive::choices(method);
    let grid = parts.grid(method, &indenter, domain)?;
    if let Some(scar) = &scar {
        parts.check_scar(scar, &indenter, grid.radius())?;
    }
    let setup = Setup {
        scar,
        grid,
        hardness: parts.hardness()?,
        material,
        indenter,
        drive,
        wear,
        running_in,
        method,
        spacing: match parts.get(&keys::GRID) {
            Some(name) => name.parse().map_err(refused)?,
            None => spacing,
        },
        scheme: match parts.get(&keys::SCHEME) {
            Some(name) => name.parse().map_err(refused)?,
            None => scheme,
        },
        stability: parts.require(&keys::STABILITY)?.parse().map_err(refused)?,
        steps_per_cycle: parts.steps_per_cycle()?,
        integrator: Integrator::new(
            &parts.require(&keys::INTEGRATOR)?,
            parts.require(&keys::TOLERANCE)?,
        )
        .map_err(refused)?,
    };
    Ok(setup)
}

/// Refuses `numerics.accuracy` together with a key that it determines.
pub(super) fn accuracy(written: &Table, origin: &Origin) -> Result<(), ScenarioError> {
    let Some(given) = schema::at(written, keys::ACCURACY.path()) else {
        return Ok(());
    };
    for path in CHOSEN_BY_ACCURACY {
        if schema::at(written, path).is_some() {
            let rule = format!("conflicts with {path}, which it chooses; give one of them");
            return Err(origin.refuse(keys::ACCURACY.path(), &show(given), rule));
        }
    }
    Ok(())
}

/// Checks `[run]`.
pub(super) fn run(plan: &RunPlan, origin: &Origin) -> Result<(), ScenarioError> {
    plan.check().map_err(|invalid| {
        let path = format!("run.{}", invalid.field);
        origin.refuse(&path, &invalid.value, invalid.rule)
    })
}

/// The steepest slope at the contact's edge, a/R, that a table may have, and the shallowest: beyond them
/// one of its columns is in another unit.
const STEEPEST: f64 = 1.0;
const SHALLOWEST: f64 = 1e-6;

/// How far contact may seem to reach beyond a table before its unit is in doubt.
const HARDLY_SAME: f64 = 20.0;

/// The fewest points of a table that are to lie within the domain.
const FEWEST_IN_CONTACT: usize = 4;

pub(super) struct Parts<'a> {
    /// The values, with the defaults written out.
    table: &'a Table,
    /// The values as the user wrote them, for messages.
    written: &'a Table,
    origin: &'a Origin,
}

impl Parts<'_> {
    /// The value of a key, where it is given.
    pub(super) fn get<T>(&self, key: &Key<T>) -> Option<T> {
        key.get(self.table)
    }

    /// The value of a key, its default, or the error that it is missing.
    pub(super) fn require<T>(&self, key: &Key<T>) -> Result<T, ScenarioError> {
        let value = key.get_or_default(self.table);
        value.ok_or_else(|| missing(self.origin, key.path(), &key.parameter))
    }

    fn missing(&self, path: &str, meaning: &str) -> ScenarioError {
        ScenarioError::Missing {
            origin: self.origin.name().to_owned(),
            path: path.to_owned(),
            meaning: meaning.to_owned(),
        }
    }

    pub(super) fn has(&self, path: &str) -> bool {
        schema::at(self.written, path).is_some()
    }

    /// Refuses the value that stands at `path`; `otherwise` is shown where none was written.
    pub(super) fn refuse(
        &self,
        path: &str,
        otherwise: &str,
        rule: impl Into<String>,
    ) -> ScenarioError {
        let written = schema::at(self.written, path).map(show);
        let value = written.unwrap_or_else(|| otherwise.to_owned());
        self.origin.refuse(path, &value, rule)
    }

    /// Adds the table to what a constructor refused.
    pub(super) fn refused(&self, section: &str, invalid: Invalid) -> ScenarioError {
        let path = format!("{section}.{}", invalid.field);
        self.refuse(&path, &invalid.value, invalid.rule)
    }

    fn indenter(&self) -> Result<Indenter, ScenarioError> {
        let shape = self.require(&keys::SHAPE)?;
        self.refuse_keys_of_other_shapes(&shape)?;
        let radius = || self.require(&keys::RADIUS);
        let angle = || self.require(&keys::ANGLE);
        let tip_radius = || self.require(&keys::TIP_RADIUS);
        match shape.as_str() {
            "cone" => Indenter::cone(angle()?),
            "power" => Indenter::power(
                self.require(&keys::SHAPE_COEFFICIENT)?,
                self.require(&keys::SHAPE_EXPONENT)?,
            ),
            "flat-punch" => Indenter::flat_punch(radius()?),
            "truncated-paraboloid" => Indenter::truncated_paraboloid(radius()?, tip_radius()?),
            "truncated-cone" => Indenter::truncated_cone(angle()?, tip_radius()?),
            "rounded-punch" => Indenter::rounded_punch(radius()?, tip_radius()?),
            "table" => {
                let list = |key: &Key<Vec<f64>>| {
                    let lacking = &keys::TABLE_FILE.parameter;
                    let list = self.get(key);
                    list.ok_or_else(|| missing(self.origin, lacking.path, lacking))
                };
                let (radii, heights) = (list(&keys::RADII)?, list(&keys::HEIGHTS)?);
                Indenter::table(&radii, &heights, self.require(&keys::SMOOTHING)?)
            }
            _ => Indenter::paraboloid(radius()?),
        }
        .map_err(|invalid| self.refused("indenter", invalid))
    }

    fn refuse_keys_of_other_shapes(&self, shape: &str) -> Result<(), ScenarioError> {
        let of_shapes = || PARAMETERS.iter().filter(|known| !known.shapes.is_empty());
        let foreign =
            of_shapes().find(|known| self.has(known.path) && !known.shapes.contains(&shape));
        let Some(foreign) = foreign else {
            return Ok(());
        };
        let takes = of_shapes().filter(|known| known.shapes.contains(&shape));
        let takes: Vec<&str> = takes.map(|known| known.key()).collect();
        let rule = format!(
            "shape = \"{shape}\" has no such key; it takes {}",
            takes.join(", ")
        );
        Err(self.refuse(foreign.path, "", rule))
    }

    fn material(&self) -> Result<Material, ScenarioError> {
        let first = self.get(&keys::FRICTION_VALUES);
        let first = first.and_then(|values| values.first().copied());
        let friction = match self.get(&keys::FRICTION).or(first) {
            None if self.has("motion.tangential") => {
                let meaning = "coefficient of friction, which the tangential motion needs";
                return Err(self.missing(keys::FRICTION.path(), meaning));
            }
            friction => friction.unwrap_or(0.0),
        };
        let refused = |invalid: Invalid| match invalid.field {
            "coefficient" => self.refused("friction", invalid),
            "rigid" => self.refused("material.half_space", invalid),
            _ => self.refused("material", invalid),
        };
        if !self.has("material.indenter") && !self.has("material.half_space") {
            let modulus = self.require(&keys::EFFECTIVE_MODULUS)?;
            let poisson = self.require(&keys::POISSON)?;
            return Material::new(modulus, poisson, friction).map_err(refused);
        }
        for path in [keys::EFFECTIVE_MODULUS.path(), keys::POISSON.path()] {
            if self.has(path) {
                let rule = "conflicts with two bodies; give either effective_modulus and poisson, \
                            or [material.indenter] and [material.half_space]";
                return Err(self.refuse(path, "", rule));
            }
        }
        let indenter = self.body(
            "material.indenter",
            &keys::INDENTER_MODULUS,
            &keys::INDENTER_POISSON,
            &keys::INDENTER_RIGID,
        )?;
        let half_space = self.body(
            "material.half_space",
            &keys::HALF_SPACE_MODULUS,
            &keys::HALF_SPACE_POISSON,
            &keys::HALF_SPACE_RIGID,
        )?;
        Material::of_bodies(indenter, half_space, friction).map_err(refused)
    }

    /// The hardness of the softer body, Pa.
    fn hardness(&self) -> Result<Option<f64>, ScenarioError> {
        let of_bodies = [&keys::INDENTER_HARDNESS, &keys::HALF_SPACE_HARDNESS];
        let pair = self.get(&keys::HARDNESS);
        if pair.is_some() && (self.has("material.indenter") || self.has("material.half_space")) {
            let rule = "does not go with two bodies; give material.indenter.hardness or material.half_space.hardness";
            return Err(self.refuse(keys::HARDNESS.path(), "", rule));
        }
        let given = of_bodies.into_iter().filter_map(|key| self.get(key));
        Ok(given.chain(pair).reduce(f64::min))
    }

    fn body(
        &self,
        section: &str,
        modulus: &Key<f64>,
        poisson: &Key<f64>,
        rigid: &Key<bool>,
    ) -> Result<Body, ScenarioError> {
        if !self.has(section) {
            let meaning = "the second body: youngs_modulus and poisson, or rigid = true";
            return Err(self.missing(section, meaning));
        }
        if self.require(rigid)? {
            let given = [modulus, poisson]
                .into_iter()
                .find(|key| self.has(key.path()));
            return match given {
                Some(key) => Err(self.refuse(key.path(), "", "a rigid body has no such key")),
                None => Ok(Body::Rigid),
            };
        }
        Body::elastic(self.require(modulus)?, self.require(poisson)?)
            .map_err(|invalid| self.refused(section, invalid))
    }

    fn drive(&self) -> Result<Drive, ScenarioError> {
        let normal = self.control(&NORMAL, &TANGENTIAL)?;
        if normal.oscillation().highest() <= 0.0 {
            let rule = "never touches; mean + amplitude must be greater than 0";
            return Err(self.refuse(keys::NORMAL_MEAN.path(), "", rule));
        }
        let tangential = self
            .has(TANGENTIAL.section)
            .then(|| self.control(&TANGENTIAL, &NORMAL))
            .transpose()?;
        let frequency = |control: &Control| control.oscillation().angular_frequency();
        let cycle = tangential.as_ref().map(frequency);
        if cycle.is_some_and(|cycle| frequency(&normal) > HIGHEST_RATIO * cycle) {
            let rule = format!(
                "must be at most {HIGHEST_RATIO} times motion.tangential.angular_frequency, \
                 whose period is the cycle"
            );
            return Err(self.refuse(keys::NORMAL_FREQUENCY.path(), "", rule));
        }
        let drive = Drive::new(normal, tangential);
        match self.get(&keys::RIG_STIFFNESS) {
            Some(stiffness) => drive
                .with_rig(stiffness)
                .map_err(|invalid| self.refused(TANGENTIAL.section, invalid)),
            None => Ok(drive),
        }
    }

    /// The motion of waveform = "table"; the table alone says so as well.
    fn tabled_motion(&self, motion: &Motion) -> Result<Option<Tabled>, ScenarioError> {
        let word = self.get(&motion.waveform);
        let (times, values) = (self.get(&motion.times), self.get(&motion.values));
        let is_given = times.is_some() || values.is_some();
        match word.as_deref() {
            Some("table") => {}
            None if is_given => {}
            Some(_) if is_given => {
                let rule = "conflicts with this waveform; give waveform = \"table\"";
                return Err(self.refuse(motion.times.path(), "", rule));
            }
            _ => return Ok(None),
        }
        let lacking = || missing(self.origin, motion.file.path(), &motion.file.parameter);
        let times = times.ok_or_else(lacking)?;
        let tabled = Waveform::table(&times, &values.ok_or_else(lacking)?);
        tabled
            .map(Some)
            .map_err(|invalid| self.refused(motion.section, invalid))
    }

    /// One direction of the motion. Where it stands still its frequency is that of the other
    /// direction, so that both share one period. A table brings its own mean, amplitude and frequency
    /// where the scenario gives none.
    fn control(&self, motion: &Motion, other: &Motion) -> Result<Control, ScenarioError> {
        let refused = |invalid| self.refused(motion.section, invalid);
        let tabled = self.tabled_motion(motion)?;
        let or_of_table = |key: &Key<f64>, value: fn(&Tabled) -> f64| {
            let given = self.get(key);
            given.or_else(|| tabled.as_ref().map(value))
        };
        let mean = match or_of_table(&motion.mean, |table| table.mean) {
            Some(mean) => mean,
            None => self.require(&motion.mean)?,
        };
        let amplitude = match or_of_table(&motion.amplitude, |table| table.amplitude) {
            Some(amplitude) => amplitude,
            None => self.require(&motion.amplitude)?,
        };
        let frequency = match or_of_table(&motion.frequency, |table| table.angular_frequency) {
            Some(frequency) => frequency,
            None if amplitude == 0.0 => self.get(&other.frequency).unwrap_or(1.0),
            None => self.require(&motion.frequency)?,
        };
        let waveform = match self.get(&motion.waveform).as_deref() {
            Some("triangle") => Waveform::triangle(),
            Some("trapezoid") => {
                Waveform::trapezoid(self.require(&motion.hold)?).map_err(refused)?
            }
            _ => tabled.map_or(Waveform::Sine, |table| table.waveform),
        };
        let oscillation =
            Oscillation::new(mean, amplitude, frequency, self.require(&motion.phase)?)
                .map_err(refused)?
                .with_waveform(waveform);
        Ok(match self.require(&motion.control)?.as_str() {
            "force" => Control::Force(oscillation),
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
        if !self.has("wear") {
            return Ok(None);
        }
        let is_power = self.require(&keys::LAW)? == "power";
        let first = self.get(&keys::WEAR_VALUES);
        let coefficient = match first.and_then(|values| values.first().copied()) {
            Some(first) => self.get(&keys::WEAR_COEFFICIENT).unwrap_or(first),
            None => self.require(&keys::WEAR_COEFFICIENT)?,
        };
        let given = [
            self.get(&keys::REFERENCE_STRESS),
            self.get(&keys::REFERENCE_SLIP_RATE),
        ];
        let (mut stress, mut slip_rate) = (1.0, 1.0);
        if is_power && given.contains(&None) {
            (stress, slip_rate) =
                derive::references(indenter, material, drive).ok_or_else(|| {
                    self.missing(
                        keys::REFERENCE_STRESS.path(),
                        "Pa; none could be found from the contact",
                    )
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
        let points = self.require(&keys::POINTS)?;
        let points = usize::try_from(points).map_err(|_| self.out_of_range(&keys::POINTS))?;
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
                keys::NORMAL_MEAN.path(),
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
        RadialGrid::uniform(points, radius).map_err(|invalid| self.refused("numerics", invalid))
    }

    /// Refuses a table that ends inside the domain, has hardly a point in the contact, or has
    /// slopes too steep for a half-space: most often its lengths are in another unit.
    fn check_measured(&self, measured: &MeasuredProfile, domain: f64) -> Result<(), ScenarioError> {
        let length = |value: f64| show(&Value::Float(derive::three_digits(value)));
        let refuse = |rule: String| Err(self.refuse("indenter.radii", "{...}", rule));
        let last = measured.last_radius();
        let points = measured.points_within(domain);
        let slope = 2.0 * measured.profile(domain.min(last)) / domain.min(last);
        let unit = "are r and f in m? columns r_mm and f_um are converted";
        if slope > STEEPEST {
            return refuse(format!(
                "a/R = {slope:.1e} at the contact's edge, where slopes must be small: {unit}"
            ));
        }
        if domain > last {
            let edge = length(domain);
            let hint = if domain > HARDLY_SAME * last || slope < SHALLOWEST {
                format!(": {unit}")
            } else {
                "; a longer trace, or a smaller depth".into()
            };
            return refuse(format!(
                "the table ends at r = {} m, but the contact can reach {edge} m{hint}",
                length(last)
            ));
        }
        if points < FEWEST_IN_CONTACT || slope < SHALLOWEST {
            let edge = length(domain);
            return refuse(format!(
                "only {points} points lie within {edge} m, where contact is possible, \
                 and a/R is {slope:.1e}: {unit}"
            ));
        }
        Ok(())
    }

    fn steps_per_cycle(&self) -> Result<u32, ScenarioError> {
        let steps = self.require(&keys::STEPS_PER_CYCLE)?;
        u32::try_from(steps).map_err(|_| self.out_of_range(&keys::STEPS_PER_CYCLE))
    }

    /// Refuses a number outside the range of its key.
    fn out_of_range<T>(&self, key: &Key<T>) -> ScenarioError {
        let rule = format!("must be {}", key.parameter.range);
        self.refuse(key.path(), "", rule)
    }
}

/// The keys of one direction of the motion.
struct Motion {
    section: &'static str,
    control: Key<String>,
    mean: Key<f64>,
    amplitude: Key<f64>,
    frequency: Key<f64>,
    phase: Key<f64>,
    waveform: Key<String>,
    hold: Key<f64>,
    file: Key<String>,
    times: Key<Vec<f64>>,
    values: Key<Vec<f64>>,
}

const NORMAL: Motion = Motion {
    section: "motion.normal",
    control: keys::NORMAL_CONTROL,
    mean: keys::NORMAL_MEAN,
    amplitude: keys::NORMAL_AMPLITUDE,
    frequency: keys::NORMAL_FREQUENCY,
    phase: keys::NORMAL_PHASE,
    waveform: keys::NORMAL_WAVEFORM,
    hold: keys::NORMAL_HOLD,
    file: keys::NORMAL_FILE,
    times: keys::NORMAL_TIMES,
    values: keys::NORMAL_VALUES,
};

const TANGENTIAL: Motion = Motion {
    section: "motion.tangential",
    control: keys::TANGENTIAL_CONTROL,
    mean: keys::TANGENTIAL_MEAN,
    amplitude: keys::TANGENTIAL_AMPLITUDE,
    frequency: keys::TANGENTIAL_FREQUENCY,
    phase: keys::TANGENTIAL_PHASE,
    waveform: keys::TANGENTIAL_WAVEFORM,
    hold: keys::TANGENTIAL_HOLD,
    file: keys::TANGENTIAL_FILE,
    times: keys::TANGENTIAL_TIMES,
    values: keys::TANGENTIAL_VALUES,
};

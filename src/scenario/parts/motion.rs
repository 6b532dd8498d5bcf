//! Builds the motion from the keys of a scenario: both directions, and the rig.

use std::f64::consts::TAU;

use super::Parts;
use crate::scenario::error::Refusal;
use crate::scenario::values::join;
use crate::simulation::drive::{Control, Drive, Oscillation};
use crate::simulation::waveform::{Tabled, Waveform};

/// Maximum number of periods of the normal motion per cycle.
const HIGHEST_RATIO: f64 = 1000.0;

/// Sections of the two directions.
const NORMAL: &str = "motion.normal";
const TANGENTIAL: &str = "motion.tangential";

impl Parts<'_> {
    /// Builds both directions of the motion, with the rig.
    pub(super) fn drive(&self) -> Result<Drive, Refusal> {
        let normal = self.control(NORMAL, TANGENTIAL)?;
        if normal.oscillation().highest() <= 0.0 {
            let rule = "never touches; mean + amplitude must be greater than 0";
            return Err(self.refuse("motion.normal.mean", rule));
        }
        let tangential = self
            .has(TANGENTIAL)
            .then(|| self.control(TANGENTIAL, NORMAL));
        let tangential = tangential.transpose()?;
        let frequency = |control: &Control| control.oscillation().angular_frequency();
        let cycle = tangential.as_ref().map(frequency);
        if cycle.is_some_and(|cycle| frequency(&normal) > HIGHEST_RATIO * cycle) {
            let rule = format!(
                "must be at most {HIGHEST_RATIO} times motion.tangential.angular_frequency, \
                 whose period is the cycle"
            );
            let given = if self.has("motion.normal.frequency") {
                "motion.normal.frequency"
            } else {
                "motion.normal.angular_frequency"
            };
            return Err(self.refuse(given, rule));
        }
        let drive = Drive::new(normal, tangential);
        match self.get("motion.tangential.rig_stiffness") {
            Some(stiffness) => drive.with_rig(stiffness).map_err(self.refused(TANGENTIAL)),
            None => Ok(drive),
        }
    }

    /// Builds the motion of waveform = "table"; a table alone implies that waveform.
    fn tabled_motion(&self, motion: &str) -> Result<Option<Tabled>, Refusal> {
        let word: Option<String> = self.get(&join(motion, "waveform"));
        let [times, values, file] = ["times", "values", "file"].map(|key| join(motion, key));
        let is_given = self.has(&times) || self.has(&values);
        match word.as_deref() {
            Some("table") => {}
            None if is_given => {}
            Some(_) if is_given => {
                let rule = "conflicts with this waveform; give waveform = \"table\"";
                return Err(self.refuse(&times, rule));
            }
            _ => return Ok(None),
        }
        let table = Waveform::table(&self.list(&times, &file)?, &self.list(&values, &file)?);
        table.map(Some).map_err(self.refused(motion))
    }

    /// Returns the angular frequency, rad/s, if it or the frequency is given.
    fn frequency(&self, motion: &str) -> Option<f64> {
        let hertz = || Some(TAU * self.get::<f64>(&join(motion, "frequency"))?);
        self.get(&join(motion, "angular_frequency")).or_else(hertz)
    }

    /// Builds one direction of the motion. A direction at rest takes the frequency of the other one, so that both share
    /// one period. A table provides its own mean, amplitude and frequency unless the scenario gives them.
    fn control(&self, motion: &str, other: &str) -> Result<Control, Refusal> {
        let key = |key: &str| join(motion, key);
        let refused = self.refused(motion);
        let tabled = self.tabled_motion(motion)?;
        let or_of_table = |name: &str, of: fn(&Tabled) -> f64| {
            let value = self.get(&key(name)).or_else(|| tabled.as_ref().map(of));
            value.map_or_else(|| self.require(&key(name)), Ok)
        };
        let mean = or_of_table("mean", |table| table.mean)?;
        let amplitude = or_of_table("amplitude", |table| table.amplitude)?;
        let of_table = || tabled.as_ref().map(|table| table.angular_frequency);
        let frequency = match self.frequency(motion).or_else(of_table) {
            Some(frequency) => frequency,
            None if amplitude == 0.0 => self.frequency(other).unwrap_or(1.0),
            None => self.require(&key("angular_frequency"))?,
        };
        let waveform = match self.get::<String>(&key("waveform")).as_deref() {
            Some("triangle") => Waveform::triangle(),
            Some("trapezoid") => {
                Waveform::trapezoid(self.require(&key("hold"))?).map_err(&refused)?
            }
            _ => tabled.map_or(Waveform::Sine, |table| table.waveform),
        };
        let oscillation =
            Oscillation::new(mean, amplitude, frequency, self.require(&key("phase"))?)
                .map_err(refused)?
                .with_waveform(waveform);
        Ok(match self.require::<String>(&key("control"))?.as_str() {
            "force" => Control::Force(oscillation),
            _ => Control::Displacement(oscillation),
        })
    }
}

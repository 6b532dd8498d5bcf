//! Builds the motion from the keys of a scenario: each direction, and the rig.

use std::f64::consts::TAU;

use super::keys::{Motion, NORMAL, TANGENTIAL};
use super::*;
use crate::simulation::drive::{Control, Drive, Oscillation};
use crate::simulation::waveform::{Tabled, Waveform};

/// The most periods of the normal motion in a cycle.
const HIGHEST_RATIO: f64 = 1000.0;

impl Parts<'_> {
    /// Both directions of the motion, on their rig.
    pub(super) fn drive(&self) -> Result<Drive, ScenarioError> {
        let normal = self.control(&NORMAL, &TANGENTIAL)?;
        if normal.oscillation().highest() <= 0.0 {
            let rule = "never touches; mean + amplitude must be greater than 0";
            return Err(self.refuse(NORMAL.mean.path(), "", rule));
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
            let given = match self.has(NORMAL.hertz.path()) {
                true => NORMAL.hertz.path(),
                false => NORMAL.frequency.path(),
            };
            return Err(self.refuse(given, "", rule));
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
        let is_given = self.has(motion.times.path()) || self.has(motion.values.path());
        match word.as_deref() {
            Some("table") => {}
            None if is_given => {}
            Some(_) if is_given => {
                let rule = "conflicts with this waveform; give waveform = \"table\"";
                return Err(self.refuse(motion.times.path(), "", rule));
            }
            _ => return Ok(None),
        }
        let list = |key| self.list(key, &motion.file);
        Waveform::table(&list(&motion.times)?, &list(&motion.values)?)
            .map(Some)
            .map_err(|invalid| self.refused(motion.section, invalid))
    }

    /// The angular frequency, rad/s, where it or the frequency is given.
    fn frequency(&self, motion: &Motion) -> Option<f64> {
        let hertz = || Some(TAU * self.get(&motion.hertz)?);
        self.get(&motion.frequency).or_else(hertz)
    }

    /// One direction of the motion. Where it stands still its frequency is that of the other
    /// direction, so that both share one period. A table brings its own mean, amplitude and frequency
    /// where the scenario gives none.
    fn control(&self, motion: &Motion, other: &Motion) -> Result<Control, ScenarioError> {
        let refused = |invalid| self.refused(motion.section, invalid);
        let tabled = self.tabled_motion(motion)?;
        let or_of_table = |key: &Key<f64>, of: fn(&Tabled) -> f64| {
            let value = self.get(key).or_else(|| tabled.as_ref().map(of));
            value.map_or_else(|| self.require(key), Ok)
        };
        let mean = or_of_table(&motion.mean, |table| table.mean)?;
        let amplitude = or_of_table(&motion.amplitude, |table| table.amplitude)?;
        let of_table = || tabled.as_ref().map(|table| table.angular_frequency);
        let frequency = match self.frequency(motion).or_else(of_table) {
            Some(frequency) => frequency,
            None if amplitude == 0.0 => self.frequency(other).unwrap_or(1.0),
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
}

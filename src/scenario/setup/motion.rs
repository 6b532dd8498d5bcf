//! Builds the motion from the keys of a scenario: both directions, and the rig.

use std::f64::consts::TAU;

use super::{Faults, NORMAL, Spec, TANGENTIAL};
use crate::scenario::key::join;
use crate::scenario::spec::{self, Direction};
use crate::simulation::drive::{Control, Drive, Oscillation};
use crate::simulation::waveform::{TableScale, Wave, Waveform};

/// Maximum number of periods of the normal motion per cycle.
const HIGHEST_RATIO: f64 = 1000.0;

impl Direction {
    /// Returns the angular frequency, rad/s, if it or the frequency is given.
    fn in_rad_per_s(&self) -> Option<f64> {
        let hertz = self.frequency.map(|hertz| TAU * hertz);
        self.angular_frequency.or(hertz)
    }
}

/// Builds both directions of the motion, with the rig.
pub(super) fn drive(spec: &Spec, faults: &mut Faults) -> Option<Drive> {
    let (normal, tangential) = (&spec.motion.normal, spec.motion.tangential.as_ref());
    let usual = &Spec::usual().motion;
    let drive = control(spec, faults, NORMAL, [normal, &usual.normal], tangential);
    let sideways = tangential.zip(usual.tangential.as_ref());
    let sideways = sideways
        .map(|(given, usual)| control(spec, faults, TANGENTIAL, [given, usual], Some(normal)));
    let drive = drive?;
    if drive.oscillation().highest() <= 0.0 {
        let rule = "never touches; mean + amplitude must be greater than 0";
        return faults.refuse(spec, "motion.normal.mean", rule);
    }
    let sideways = match sideways {
        Some(made) => Some(made?),
        None => None,
    };
    let frequency = |control: &Control| control.oscillation().angular_frequency();
    let cycle = sideways.as_ref().map(frequency);
    if cycle.is_some_and(|cycle| frequency(&drive) > HIGHEST_RATIO * cycle) {
        let rule = format!(
            "must be at most {HIGHEST_RATIO} times motion.tangential.angular_frequency, \
             whose period is the cycle"
        );
        let given = match normal.frequency {
            Some(_) => "motion.normal.frequency",
            None => "motion.normal.angular_frequency",
        };
        return faults.refuse(spec, given, rule);
    }
    let drive = Drive::new(drive, sideways);
    match tangential.and_then(|given| given.rig_stiffness) {
        Some(stiffness) => faults.accept(spec, TANGENTIAL, drive.with_rig(stiffness)),
        None => Some(drive),
    }
}

/// Builds the waveform; a table alone implies its word.
fn waveform(
    spec: &Spec,
    faults: &mut Faults,
    section: &str,
    given: &Direction,
) -> Option<(Waveform, Option<TableScale>)> {
    let has_table = given.form.times.is_some() || given.form.values.is_some();
    let implied = if has_table { Wave::Table } else { Wave::Sine };
    let wave = given.waveform.unwrap_or(implied);
    if has_table && wave != Wave::Table {
        let rule = "conflicts with this waveform; give waveform = \"table\"";
        return faults.refuse(spec, &join(section, "times"), rule);
    }
    faults.make(spec, section, Waveform::new(wave, &given.form))
}

/// Builds one direction of the motion, `given` with its defaults. A direction at rest takes the frequency of the
/// `other` one, so that both share one period. A table provides its own mean, amplitude and frequency unless the
/// scenario gives them.
fn control(
    spec: &Spec,
    faults: &mut Faults,
    section: &str,
    [given, usual]: [&Direction; 2],
    other: Option<&Direction>,
) -> Option<Control> {
    let path = |key: &str| join(section, key);
    let (waveform, scale) = waveform(spec, faults, section, given)?;
    let mean = given.mean.or(scale.map(|table| table.mean));
    let mean = faults.need(&path("mean"), mean.or(usual.mean));
    let amplitude = given.amplitude.or(scale.map(|table| table.amplitude));
    let amplitude = faults.need(&path("amplitude"), amplitude.or(usual.amplitude));
    let of_table = scale.map(|table| table.angular_frequency);
    let frequency = match given.in_rad_per_s().or(of_table) {
        None if amplitude == Some(0.0) => {
            Some(other.and_then(Direction::in_rad_per_s).unwrap_or(1.0))
        }
        None if faults.covers(&path("frequency")) => None,
        frequency => faults.need(&path("angular_frequency"), frequency),
    };
    let phase = faults.need(&path("phase"), given.phase.or(usual.phase));
    let oscillation = Oscillation::new(mean?, amplitude?, frequency?, phase?);
    let oscillation = faults.accept(spec, section, oscillation)?;
    let oscillation = oscillation.with_waveform(waveform);
    Some(match given.control {
        Some(spec::ControlWord::Force) => Control::Force(oscillation),
        _ => Control::Displacement(oscillation),
    })
}

//! Builds the motion from the keys of a scenario: both directions, and the rig.

use std::f64::consts::TAU;

use super::{NORMAL, Noted, Parts, Section, TANGENTIAL};
use crate::scenario::spec::{self, Direction, Wave};
use crate::simulation::drive::{Control, Drive, Oscillation};
use crate::simulation::waveform::{Tabled, Waveform};

/// Maximum number of periods of the normal motion per cycle.
const HIGHEST_RATIO: f64 = 1000.0;

impl Direction {
    /// Returns the angular frequency, rad/s, if it or the frequency is given.
    fn in_rad_per_s(&self) -> Option<f64> {
        let hertz = self.frequency.map(|hertz| TAU * hertz);
        self.angular_frequency.or(hertz)
    }
}

impl Parts<'_> {
    /// Builds both directions of the motion, with the rig.
    pub(super) fn drive(&self) -> Result<Drive, Noted> {
        let (motion, usual) = (&self.spec.motion, &self.usual.motion);
        let (normal_at, tangential_at) = (self.at(NORMAL), self.at(TANGENTIAL));
        let (normal, tangential) = (&motion.normal, motion.tangential.as_ref());
        let drive = control(normal_at, normal, &usual.normal, tangential);
        let sideways = tangential.zip(usual.tangential.as_ref());
        let sideways = sideways
            .map(|(given, usual)| control(tangential_at, given, usual, Some(normal)))
            .transpose();
        let drive = drive?;
        if drive.oscillation().highest() <= 0.0 {
            let rule = "never touches; mean + amplitude must be greater than 0";
            return Err(normal_at.refuse("mean", rule));
        }
        let sideways = sideways?;
        let frequency = |control: &Control| control.oscillation().angular_frequency();
        let cycle = sideways.as_ref().map(frequency);
        if cycle.is_some_and(|cycle| frequency(&drive) > HIGHEST_RATIO * cycle) {
            let rule = format!(
                "must be at most {HIGHEST_RATIO} times motion.tangential.angular_frequency, \
                 whose period is the cycle"
            );
            let given = match normal.frequency {
                Some(_) => "frequency",
                None => "angular_frequency",
            };
            return Err(normal_at.refuse(given, rule));
        }
        let drive = Drive::new(drive, sideways);
        match tangential.and_then(|given| given.rig_stiffness) {
            Some(stiffness) => {
                let refused = |invalid| tangential_at.refused(invalid);
                drive.with_rig(stiffness).map_err(refused)
            }
            None => Ok(drive),
        }
    }
}

/// Builds the motion of waveform = "table"; a table alone implies that waveform.
fn tabled_motion(at: Section, given: &Direction) -> Result<Option<Tabled>, Noted> {
    let is_given = given.times.is_some() || given.values.is_some();
    match given.waveform {
        Some(Wave::Table) => {}
        None if is_given => {}
        Some(_) if is_given => {
            let rule = "conflicts with this waveform; give waveform = \"table\"";
            return Err(at.refuse("times", rule));
        }
        _ => return Ok(None),
    }
    let times = at.need_list("times", &given.times, "file");
    let values = at.need_list("values", &given.values, "file");
    let table = Waveform::table(times?, values?);
    table.map(Some).map_err(|invalid| at.refused(invalid))
}

/// Builds one direction of the motion. A direction at rest takes the frequency of the `other` one, so that both share
/// one period. A table provides its own mean, amplitude and frequency unless the scenario gives them.
fn control(
    at: Section,
    given: &Direction,
    usual: &Direction,
    other: Option<&Direction>,
) -> Result<Control, Noted> {
    let refused = |invalid| at.refused(invalid);
    let tabled = tabled_motion(at, given)?;
    let tabled = tabled.as_ref();
    let of_table = |of: fn(&Tabled) -> f64| tabled.map(of);
    let mean = given.mean.or(of_table(|table| table.mean));
    let mean = at.need("mean", mean.or(usual.mean));
    let amplitude = given.amplitude.or(of_table(|table| table.amplitude));
    let amplitude = at.need("amplitude", amplitude.or(usual.amplitude));
    let of_table = of_table(|table| table.angular_frequency);
    let frequency = match given.in_rad_per_s().or(of_table) {
        None if matches!(amplitude, Ok(0.0)) => {
            Ok(other.and_then(Direction::in_rad_per_s).unwrap_or(1.0))
        }
        None if at.is_blamed("frequency") => Err(Noted),
        frequency => at.need("angular_frequency", frequency),
    };
    let waveform = match given.waveform {
        Some(Wave::Triangle) => Waveform::triangle(),
        Some(Wave::Trapezoid) => {
            let hold = at.need("hold", given.hold)?;
            Waveform::trapezoid(hold).map_err(refused)?
        }
        _ => tabled.map_or(Waveform::Sine, |table| table.waveform.clone()),
    };
    let phase = at.need("phase", given.phase.or(usual.phase));
    let oscillation = Oscillation::new(mean?, amplitude?, frequency?, phase?)
        .map_err(refused)?
        .with_waveform(waveform);
    Ok(match given.control {
        Some(spec::Control::Force) => Control::Force(oscillation),
        _ => Control::Displacement(oscillation),
    })
}

//! Compares data with the scenario before a fit: strokes, depths, and which way up a profile is.

use anyhow::{Result, bail};

use crate::contact::indenter::Indenter;
use crate::math::scan::{largest, range};
use crate::scenario::{Refusal, Scenario};
use crate::simulation::drive::Control;
use crate::studies::measured::Measured;
use crate::traces::Axes;

/// Key of the stroke.
const STROKE: &str = "motion.tangential.amplitude";

/// Allowed relative difference of strokes.
const OTHER_STROKE: f64 = 0.05;

/// Ratio of depths in data and scenario beyond which their unit is in doubt.
const OTHER_UNIT: f64 = 100.0;

/// Returns the scenario with the stroke of the loops, if it `takes` that; otherwise refuses loops of another stroke.
///
/// # Errors
/// If the strokes of loops differ from the scenario's, or from each other.
pub(super) fn with_stroke(
    scenario: Scenario,
    data: &[Measured],
    free: &[String],
    takes: bool,
) -> Result<Scenario> {
    let setup = scenario.setup();
    let Some(Control::Displacement(motion)) = setup.drive.tangential() else {
        return Ok(scenario);
    };
    let is_free = free.iter().any(|key| key == STROKE);
    let loops = data.iter().filter(|set| set.axes == Axes::LOOP && !is_free);
    let amplitude = |set: &Measured| {
        range(set.at.iter().copied()).map_or(0.0, |[least, most]| 0.5 * (most - least))
    };
    let strokes: Vec<(&str, f64)> = loops
        .map(|set| (set.name.as_str(), amplitude(set)))
        .collect();
    let Some(&(_, first)) = strokes.first().filter(|_| takes) else {
        for (name, found) in strokes {
            let planned = motion.amplitude();
            if (found / planned - 1.0).abs() > OTHER_STROKE {
                let hint = match found / planned {
                    ratio
                        if (300.0..3000.0).contains(&ratio)
                            || (1.0 / 3000.0..1.0 / 300.0).contains(&ratio) =>
                    {
                        "; is its displacement in another unit?"
                    }
                    _ => "",
                };
                bail!(Refusal::new(
                    name,
                    format!(
                        "its displacement has an amplitude of {found:.3e} m, but {STROKE} = {planned:.3e} m: --stroke from-data \
                     takes that of the file, --set {STROKE}=... another{hint}"
                    )
                ));
            }
        }
        return Ok(scenario);
    };
    if let Some((name, other)) = strokes
        .iter()
        .find(|(_, other)| (other / first - 1.0).abs() > OTHER_STROKE)
    {
        bail!(Refusal::new(
            name,
            format!("its amplitude is {other:.3e} m, that of the loop before it {first:.3e} m")
        ));
    }
    Ok(scenario.edited(|spec| {
        if let Some(motion) = &mut spec.motion.tangential {
            motion.amplitude = Some(first);
        }
    })?)
}

/// Refuses depths that can only be in another unit.
///
/// # Errors
/// A line that names both.
pub(super) fn check_depths(set: &Measured, scenario: &Scenario) -> Result<()> {
    let span = range(set.values.iter().copied()).map_or(0.0, |[least, most]| most - least);
    let reach = largest(&set.at.iter().map(|r| r.abs()).collect::<Vec<_>>());
    let unworn = scenario.setup().indenter.profile(reach);
    // A scar is not deeper than the height of the shape at its end, except for a punch.
    if unworn > 0.0 && span > OTHER_UNIT * unworn {
        bail!(Refusal::new(
            &set.name,
            format!(
                "depths of {span:.1e} m over radii up to {reach:.1e} m, where the unworn shape is {unworn:.1e} m high: are \
             they in m?"
            )
        ));
    }
    Ok(())
}

/// Decides whether heights describe the worn shape, the worn shape upside down, or the wear of a flat body.
pub(super) fn decide_profile(set: &mut Measured, unworn: &Indenter) {
    if set.axes != Axes::PROFILE {
        return;
    }
    let centre = if set.is_two_sided() {
        set.centre()
    } else {
        0.0
    };
    let shape: Vec<f64> = set
        .at
        .iter()
        .map(|x| unworn.profile((x - centre).abs()))
        .collect();
    // The variance that remains when the shape is subtracted with a sign.
    let scatter = |sign: f64| {
        let left: Vec<f64> = set
            .values
            .iter()
            .zip(&shape)
            .map(|(value, shape)| value - sign * shape)
            .collect();
        let mean = left.iter().sum::<f64>() / left.len() as f64;
        left.iter().map(|left| (left - mean).powi(2)).sum::<f64>()
    };
    if scatter(-1.0) < 0.5 * scatter(1.0) && scatter(-1.0) < scatter(0.0) {
        set.negate("its profile is upside down: taken with the other sign");
    }
}

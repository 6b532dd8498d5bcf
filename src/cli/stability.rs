//! `mdr-tui stability`: how much wear per cycle each method tolerates.

use std::process::ExitCode;

use anyhow::{Result, bail};

use super::args::{Guard, StabilityOptions};
use super::report::{self, Report};
use super::{given, progress, stop, succeeded};
use crate::math::abel::AbelMethod;
use crate::math::geometry::Geometry;
use crate::math::number::exact;
use crate::scenario::{Refusal, printable};
use crate::studies::stability::report::{boundaries, maps, runs};
use crate::studies::stability::{Limit, StabilityStudy, Variant};

/// Runs the study and prints and writes its results.
pub fn stability(options: &StabilityOptions) -> Result<ExitCode> {
    let target = options.output.claim()?;
    let scenario = given::scenario(&options.scenario, &options.changes.set)?;
    let name = printable(scenario.origin());
    let title = scenario.title().to_owned();
    let settings = settings(options, scenario.setup().geometry);
    let Some(study) = StabilityStudy::new(scenario, options.cycles)? else {
        let rule = "nothing wears: the scenario needs [wear], and contact at its start";
        bail!(Refusal::new(name, rule));
    };
    let go_on = stop::signal().map(stop::until_stopped)?;
    let lines = lines(&study, options, &settings, &go_on)?;
    let interrupted = !go_on();
    let (cycles, steps) = (exact(options.cycles), options.steps);
    let about = "K = k E* d/a at the start";
    let mut notes = vec![format!(
        "{title}, {cycles} cycles, {steps} steps per cycle: {about}"
    )];
    if interrupted {
        notes.push("interrupted: the last line is not complete".to_owned());
    }
    let runs = runs(&lines);
    report::write(target.as_ref(), "stability", &notes, &runs)?;
    let mut report = Report::default();
    report.lines(&notes);
    report.line(". stable  ~ sawtooth # exploded  | where the limit is predicted");
    report.line("");
    report.lines(maps(&lines).lines());
    report.table(&boundaries(&lines), 2);
    report.print(options.output.json.then_some(&runs))?;
    Ok(succeeded(!interrupted))
}

/// Computes the lines of the study, until `go_on` says to stop.
fn lines(
    study: &StabilityStudy,
    options: &StabilityOptions,
    settings: &[Variant],
    go_on: &dyn Fn() -> bool,
) -> Result<Vec<Limit>> {
    let mut wear_numbers = options.wear_numbers.clone();
    wear_numbers.sort_by(f64::total_cmp);
    let length = settings.len() * wear_numbers.len();
    let bar = progress::bar(length, progress::COUNTS, options.output.quiet);
    let mut lines = Vec::new();
    for setting in settings.iter().copied().take_while(|_| go_on()) {
        bar.set_message(format!("{}, N = {}", setting.method, setting.points));
        lines.push(study.line(setting, &wear_numbers, go_on, || bar.inc())?);
    }
    Ok(lines)
}

/// Returns all settings: by method, then guard, then grid.
fn settings(options: &StabilityOptions, geometry: Geometry) -> Vec<Variant> {
    let guards: &[bool] = match options.guard {
        Guard::Off => &[false],
        Guard::On => &[true],
        Guard::Both => &[false, true],
    };
    let mut settings = Vec::new();
    let methods = AbelMethod::for_geometry(geometry);
    for &method in options.methods.iter().filter(|of| methods.contains(of)) {
        for &guard in guards {
            settings.extend(options.points.iter().map(|&points| Variant {
                method,
                points,
                steps: options.steps,
                guard,
            }));
        }
    }
    settings
}

//! `mdr-tui fit`: parameters from measured scars, loops and histories.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};

use anyhow::Result;
use serde::Serialize;

use super::args;
use super::progress::{self, Bar};
use super::report::Report;
use super::{complain, given};
use crate::export::target::Target;
use crate::plot::theme::Role;
use crate::plot::units::reading;
use crate::plot::{Axis, Chart, Curve};
use crate::scenario::columns::Columns;
use crate::studies::fit::{Fit, FitOptions, Fitted, FittedKey, SetResult, Structure};
use crate::studies::measured::Measured;
use crate::traces::Axes;

/// Fits, and prints, draws and writes the results.
pub fn fit(options: &args::FitCommand) -> Result<()> {
    let scenario = given::scenario(&options.scenario, &options.changes.set)?;
    let fit = Fit::new(
        scenario,
        data(options)?,
        &options.free,
        fit_options(options),
    )?;
    let target = Target::claim_given(options.out.as_deref(), options.force)?;
    let (fitted, runs) = run(&fit, options.quiet)?;
    if let Some(target) = target {
        target.write(fitted.scenario.to_toml().as_bytes())?;
    }
    let mut report = report(&fit, &fitted);
    report.line(format!("{runs} runs"));
    if options.drawing.plot {
        report.charts(&residual_charts(&fit, &fitted), options.drawing.marker);
    }
    report.print(options.json.then(|| Told::new(&fitted, runs)).as_ref())?;
    let remarks = fitted.remarks.iter().filter(|_| options.json);
    remarks.for_each(|remark| complain(remark));
    Ok(())
}

fn run(fit: &Fit, quiet: bool) -> Result<(Fitted, u64)> {
    let bar = Bar::new("runs", 0.0, progress::COUNTS, quiet);
    let outcome = fit.run(&|| bar.inc());
    Ok((outcome?, bar.position() as u64))
}

/// Translates the command-line options into options of the fit.
fn fit_options(options: &args::FitCommand) -> FitOptions {
    FitOptions {
        cycles: options.cycles,
        robust: options.robust,
        nuisances: [options.level, options.shift, options.tilt],
        takes_stroke: options.stroke == args::StrokeSource::FromData,
        budget: options.budget,
    }
}

/// The JSON output: the keys, and how they were found.
#[derive(Serialize)]
struct Told<'a> {
    #[serde(flatten)]
    keys: BTreeMap<&'a str, &'a FittedKey>,
    data: &'a [SetResult],
    remarks: &'a [String],
    has_converged: bool,
    runs: u64,
}

impl<'a> Told<'a> {
    fn new(fitted: &'a Fitted, runs: u64) -> Self {
        let keys = fitted
            .values
            .iter()
            .map(|value| (value.key.as_str(), value));
        Self {
            keys: keys.collect(),
            data: &fitted.sets,
            remarks: &fitted.remarks,
            has_converged: fitted.has_converged,
            runs,
        }
    }
}

/// Reads all data sets given by the options.
fn data(options: &args::FitCommand) -> Result<Vec<Measured>> {
    let naming = options.naming.of_columns();
    let mut data = Vec::new();
    for path in &options.scar {
        data.push(Measured::scar(&Columns::read_as(path, &naming)?)?);
    }
    for given in &options.fretting_loop {
        let (path, cycle) = at_cycle(given);
        let mut measured =
            Measured::fretting_loop(&Columns::read_as(&path, &naming)?, options.pick)?;
        measured.cycle = cycle.or(measured.cycle);
        data.push(measured);
    }
    for path in &options.history {
        data.push(Measured::history(
            &Columns::read_as(path, &naming)?,
            options.density,
        )?);
    }
    Ok(data)
}

/// Splits `FILE@CYCLE` into file and cycle; an existing file of that full name takes precedence.
pub(super) fn at_cycle(given: &Path) -> (PathBuf, Option<f64>) {
    let bytes = given.as_os_str().as_bytes();
    let sign = bytes.iter().rposition(|&byte| byte == b'@');
    let parts = sign.filter(|_| !given.exists()).and_then(|at| {
        let cycle = std::str::from_utf8(&bytes[at + 1..]).ok()?;
        Some((OsStr::from_bytes(&bytes[..at]), cycle.parse().ok()?))
    });
    match parts {
        Some((path, cycle)) => (path.into(), Some(cycle)),
        None => (given.to_owned(), None),
    }
}

/// Formats a fitted value with its errors.
fn value(one: &FittedKey, has_converged: bool) -> String {
    let (value, unit) = (one.value, one.unit);
    // A wear coefficient also says what it is per.
    let (unit, per) = match unit {
        "1/Pa" => ("1/Pa", " per friction work"),
        "m^3/(N*m)" => ("m^3/(N*m)", " per load and distance"),
        unit => (unit, ""),
    };
    let error = match (one.stderr, one.interval) {
        (_, Some([Some(low), None])) => return format!("≥ {low:.3e} {unit}{per}"),
        (_, Some([None, Some(high)])) => return format!("≤ {high:.3e} {unit}{per}"),
        (Some(error), _) => {
            let share = 100.0 * (error / value).abs();
            format!("± {error:.2e} {unit} ({share:.2} %)")
        }
        (None, _) if !has_converged => format!("{unit} (not converged)"),
        (None, _) => format!("{unit} (not determined)"),
    };
    // Converts k to mm³/(N·m), the unit of a pin test, and an amplitude to µm.
    let read = match reading(value, one.unit, true) {
        (_, read) if read == one.unit => String::new(),
        (number, read) => format!(", {number} {read}{per}"),
    };
    format!("{value:.6e} {error}{read}")
}

/// Reports the keys with their errors and correlations, and how well each data set is matched.
fn report(fit: &Fit, fitted: &Fitted) -> Report {
    let mut report = Report::default();
    let mut rows = Vec::new();
    for one in &fitted.values {
        rows.push((one.key.as_str(), value(one, fitted.has_converged)));
        if let (Some(numerical), false) = (one.numerical_error, one.is_open()) {
            let share = 100.0 * (numerical / one.value).abs();
            let unit = one.unit;
            rows.push((
                "",
                format!("numerical error {numerical:.1e} {unit} ({share:.2} %)"),
            ));
        }
    }
    report.rows(&rows);
    for (i, one) in fitted.values.iter().enumerate() {
        for other in &fitted.values[..i] {
            let (key, other) = (&one.key, &other.key);
            let correlation = one.correlations[other];
            report.line(format!("correlation {other} - {key}: {correlation:.3}"));
        }
    }
    for (measured, set) in fit.data.iter().zip(&fitted.sets) {
        let (name, unit, points, rms) = (&set.file, measured.axes.y.unit(), set.points, set.rms());
        let at = match (measured.axes, measured.cycle) {
            (Axes::LOOP, Some(cycle)) => format!(" in cycle {cycle}"),
            (Axes::LOOP, None) => {
                let last = fit.cycles;
                format!(" in the last cycle, {last} (--loop {name}@CYCLE for another)")
            }
            _ => String::new(),
        };
        let Structure {
            chi_squared,
            runs,
            expected_runs,
            probability,
            ..
        } = set.structure;
        report.line(format!(
            "{name}: {points} points{at}, residuals {rms:.2e} {unit} rms"
        ));
        report.lines(set.notes.iter().map(|note| format!("  {note}")));
        report.lines(set.nuisances.iter().map(|one| {
            let (name, value, error, unit) = (one.name, one.value, one.stderr, &one.unit);
            format!("  {name} {value:.3e} ± {error:.1e} {unit}")
        }));
        report.line(format!(
            "  χ² per degree of freedom {chi_squared:.2}; {runs} runs of one sign, by chance {expected_runs:.0} (p = \
             {probability:.1e})"
        ));
    }
    report.lines(&fitted.remarks);
    report
}

/// Plots measured minus simulated values, one plot per data set.
fn residual_charts(fit: &Fit, fitted: &Fitted) -> Vec<Chart> {
    let sets = fit.data.iter().zip(&fitted.sets);
    let charts = sets.map(|(measured, set)| {
        let (x, y) = (measured.axes.x, measured.axes.y);
        let y = Axis::new(format!("{}: residual", measured.name), y.unit());
        let curve = Curve::new("", &measured.at[..], &set.residuals[..], Role::Profile);
        Chart::new("", Axis::new(x.quantity(), x.unit()), y).curve(curve)
    });
    charts.collect()
}

//! `mdr-tui fit`: parameters from measured scars, loops and histories.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};

use anyhow::Result;

use super::args;
use super::{accuracy, complain, given, progress, results, small_multiples};
use crate::export::target::Target;
use crate::math::scan::rms;
use crate::plot::theme::Role;
use crate::plot::units::reading;
use crate::plot::{Axis, Chart, Curve, Marker};
use crate::scenario::columns::Columns;
use crate::studies::fit::{Fit, Fitted};
use crate::studies::measured::Measured;
use crate::studies::refinement::{self, Budget};
use crate::traces::Axes;

/// Fits, and prints, draws and writes what was asked for.
pub fn fit(options: &args::Fit) -> Result<()> {
    let scenario = given::scenario(&options.scenario, &options.changes.set)?;
    // The fit runs on the points and steps that its start values need.
    let found = accuracy::resolve(&scenario, options.quiet, |scenario| {
        refinement::resolve(scenario, options.cycles, Budget::UNLIMITED, &|| true)
    })?;
    let (free, cycles, robust) = (&options.free, options.cycles, options.robust);
    let fit = Fit::new(found.scenario, data(options)?, free, cycles, robust)?;
    let target = Target::claim_given(options.out.as_deref(), options.force)?;
    let bar = progress::bar(0, "{pos} runs  {elapsed} gone", options.quiet);
    let outcome = fit.run(&|| bar.inc(1));
    let runs = bar.position();
    bar.finish_and_clear();
    let fitted = outcome?;
    if let Some(target) = target {
        target.write(fitted.scenario.to_toml().as_bytes())?;
    }
    let keys = fitted.values.iter().map(|value| (&value.key, value));
    let keys: BTreeMap<_, _> = keys.collect();
    results::print(options.json.then_some(&keys), || {
        let plots = || residual_plots(&fit, &fitted, options.drawing.marker);
        let plots = options.drawing.plot.then(plots).unwrap_or_default();
        format!("{}{runs} runs\n{plots}", report(&fit, &fitted))
    })?;
    let remarks = fitted.remarks.iter().filter(|_| options.json);
    remarks.for_each(|remark| complain(remark));
    Ok(())
}

/// All data sets that the options name.
fn data(options: &args::Fit) -> Result<Vec<Measured>> {
    let mut data = Vec::new();
    for path in &options.scar {
        data.push(Measured::scar(&Columns::read(path)?)?);
    }
    for given in &options.fretting_loop {
        let (path, cycle) = at_cycle(given);
        let mut measured = Measured::fretting_loop(&Columns::read(&path)?)?;
        measured.cycle = cycle.or(measured.cycle);
        data.push(measured);
    }
    for path in &options.history {
        data.push(Measured::history(&Columns::read(path)?)?);
    }
    Ok(data)
}

/// `FILE@CYCLE` as a file and a cycle; an existing file with such a name takes precedence.
fn at_cycle(given: &Path) -> (PathBuf, Option<f64>) {
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

/// The keys with their errors and correlations, and how well each data set is matched.
fn report(fit: &Fit, fitted: &Fitted) -> String {
    let mut lines = Vec::new();
    let width = fitted.values.iter().map(|value| value.key.len()).max();
    let width = width.unwrap_or(0);
    for one in &fitted.values {
        let (key, value, unit) = (&one.key, one.value, one.unit);
        let error = match one.stderr {
            Some(error) => {
                let share = 100.0 * (error / value).abs();
                format!("± {error:.2e} {unit} ({share:.2} %)")
            }
            None => format!("{unit} (not determined)"),
        };
        // A pin test's k is read in mm³/(N·m), an amplitude in µm.
        let read = match reading(value, unit, true) {
            (_, read) if read == unit => String::new(),
            (number, read) => format!(", {number} {read}"),
        };
        lines.push(format!("{key:width$}  {value:.6e} {error}{read}"));
    }
    for (i, one) in fitted.values.iter().enumerate() {
        for other in &fitted.values[..i] {
            let (key, other) = (&one.key, &other.key);
            let correlation = one.correlations[other];
            lines.push(format!("correlation {other} - {key}: {correlation:.3}"));
        }
    }
    for (set, left) in fit.data.iter().zip(&fitted.residuals) {
        let (rms, points) = (rms(left), left.len());
        let (name, unit) = (&set.name, set.axes.unit());
        let at = match (set.axes, set.cycle) {
            (Axes::LOOP, Some(cycle)) => format!(" in cycle {cycle}"),
            (Axes::LOOP, None) => {
                let last = fit.cycles;
                format!(" in the last cycle, {last} (--loop {name}@CYCLE for another)")
            }
            _ => String::new(),
        };
        let residuals = format!("residuals {rms:.2e} {unit} rms");
        lines.push(format!("{name}: {points} points{at}, {residuals}"));
    }
    lines.extend(fitted.remarks.iter().cloned());
    lines.iter().map(|line| format!("{line}\n")).collect()
}

/// Measured minus simulated values, one plot per data set.
fn residual_plots(fit: &Fit, fitted: &Fitted, marker: Marker) -> String {
    let sets = fit.data.iter().zip(&fitted.residuals);
    let charts = sets.map(|(measured, left)| {
        let abscissa = measured.axes.x;
        let (name, unit) = abscissa.rsplit_once('_').unwrap_or((abscissa, ""));
        let ordinate = Axis::new(format!("{}: residual", measured.name), measured.axes.unit());
        let curve = Curve::new("", &measured.at[..], &left[..], Role::Profile);
        Chart::new("", Axis::new(name, unit), ordinate).curve(curve)
    });
    small_multiples::draw(&charts.collect::<Vec<_>>(), marker)
}

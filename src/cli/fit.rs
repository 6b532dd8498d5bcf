//! `mdr-tui fit`: parameters from measured scars, loops and histories.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};

use anyhow::Result;
use serde::Serialize;

use super::args::{self, Beside};
use super::{complain, given, progress, results, small_multiples};
use crate::export::target::Target;
use crate::plot::theme::Role;
use crate::plot::units::reading;
use crate::plot::{Axis, Chart, Curve, Marker};
use crate::scenario::Scenario;
use crate::scenario::columns::Columns;
use crate::studies::fit::{Fit, Fitted, Options, SetResult, Structure, Switch, Value};
use crate::studies::measured::Measured;
use crate::traces::Axes;

/// Fits, and prints, draws and writes the results.
pub fn fit(options: &args::Fit) -> Result<()> {
    let scenario = given::scenario(&options.scenario, &options.changes.set)?;
    let data = data(options)?;
    if options.each {
        return fit_each(options, &scenario, data);
    }
    let fit = Fit::new(scenario, data, &options.free, fit_options(options))?;
    let target = Target::claim_given(options.out.as_deref(), options.force)?;
    let (fitted, runs) = run(&fit, options.quiet)?;
    if let Some(target) = target {
        target.write(fitted.scenario.to_toml().as_bytes())?;
    }
    results::print(
        options.json.then(|| Told::new(&fitted, runs)).as_ref(),
        || {
            let plots = || residual_plots(&fit, &fitted, options.drawing.marker);
            let plots = options.drawing.plot.then(plots).unwrap_or_default();
            format!("{}{runs} runs\n{plots}", report(&fit, &fitted))
        },
    )?;
    let remarks = fitted.remarks.iter().filter(|_| options.json);
    remarks.for_each(|remark| complain(remark));
    Ok(())
}

fn run(fit: &Fit, quiet: bool) -> Result<(Fitted, u64)> {
    let bar = progress::bar(0, "{pos} runs  {elapsed} gone", quiet);
    let outcome = fit.run(&|| bar.inc(1));
    let runs = bar.position();
    bar.finish_and_clear();
    Ok((outcome?, runs))
}

/// Translates the command-line options into options of the fit.
fn fit_options(options: &args::Fit) -> Options {
    let switch = |beside: Beside| match beside {
        Beside::Auto => Switch::Auto,
        Beside::On => Switch::On,
        Beside::Off => Switch::Off,
    };
    Options {
        cycles: options.cycles,
        robust: options.robust,
        nuisances: [options.level, options.shift, options.tilt].map(switch),
        takes_stroke: options.stroke == args::Stroke::FromData,
        budget: options.budget,
    }
}

/// Fits every file separately and prints one row per file.
fn fit_each(options: &args::Fit, scenario: &Scenario, data: Vec<Measured>) -> Result<()> {
    let outcomes = data.into_iter().map(|set| {
        let name = set.name.clone();
        let fit = Fit::new(
            scenario.clone(),
            vec![set],
            &options.free,
            fit_options(options),
        );
        (name, fit.and_then(|fit| run(&fit, options.quiet)))
    });
    let outcomes: Vec<_> = outcomes.collect();
    let found = outcomes
        .iter()
        .filter_map(|(_, outcome)| outcome.as_ref().ok());
    let told: Vec<_> = found
        .map(|(fitted, runs)| Told::new(fitted, *runs))
        .collect();
    // A file that cannot be fitted gets a row, too.
    let row = |(name, outcome): &(String, Result<(Fitted, u64)>)| match outcome {
        Ok((fitted, _)) => {
            let values = fitted.values.iter().map(value).collect::<Vec<_>>();
            [name.clone(), values.join("  "), fitted.remarks.join("; ")]
        }
        Err(error) => [name.clone(), "not fitted".to_owned(), format!("{error:#}")],
    };
    let rows: Vec<[String; 3]> = outcomes.iter().map(row).collect();
    results::print(options.json.then_some(&told), || {
        let width = |k: usize| {
            rows.iter()
                .map(|row| row[k].chars().count())
                .max()
                .unwrap_or(0)
        };
        let (names, values) = (width(0), width(1));
        let head = format!(
            "{:names$}  {:values$}  remarks\n",
            "file",
            options.free.join("  ")
        );
        let line = |[name, value, remark]: &[String; 3]| {
            format!("{name:names$}  {value:values$}  {remark}")
                .trim_end()
                .to_owned()
                + "\n"
        };
        head + &rows.iter().map(line).collect::<String>()
    })
}

/// The JSON output: the keys, and how they were found.
#[derive(Serialize)]
struct Told<'a> {
    #[serde(flatten)]
    keys: BTreeMap<&'a str, &'a Value>,
    data: &'a [SetResult],
    remarks: &'a [String],
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
            runs,
        }
    }
}

/// Reads all data sets given by the options.
fn data(options: &args::Fit) -> Result<Vec<Measured>> {
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

/// Formats a fitted value with its errors.
fn value(one: &Value) -> String {
    let (value, unit) = (one.value, one.unit);
    // A wear coefficient also says what it is per.
    let (unit, per) = match unit {
        "1/Pa" => ("1/Pa", " per friction work"),
        "m^3/(N*m)" => ("m^3/(N*m)", " per load and distance"),
        unit => (unit, ""),
    };
    // A remark tells the limit on the one side.
    let error = match one.stderr.filter(|_| !one.is_open()) {
        Some(error) => {
            let share = 100.0 * (error / value).abs();
            format!("± {error:.2e} {unit} ({share:.2} %)")
        }
        None => format!("{unit} (not determined)"),
    };
    // Converts k to mm³/(N·m), the unit of a pin test, and an amplitude to µm.
    let read = match reading(value, one.unit, true) {
        (_, read) if read == one.unit => String::new(),
        (number, read) => format!(", {number} {read}{per}"),
    };
    format!("{value:.6e} {error}{read}")
}

/// Reports the keys with their errors and correlations, and how well each data set is matched.
fn report(fit: &Fit, fitted: &Fitted) -> String {
    let mut lines = Vec::new();
    let width = fitted.values.iter().map(|value| value.key.len()).max();
    let width = width.unwrap_or(0);
    for one in &fitted.values {
        lines.push(format!("{:width$}  {}", one.key, value(one)));
        if let (Some(numerical), false) = (one.numerical_error, one.is_open()) {
            let share = 100.0 * (numerical / one.value).abs();
            lines.push(format!(
                "{:width$}  numerical error {numerical:.1e} {} ({share:.2} %)",
                "", one.unit
            ));
        }
    }
    for (i, one) in fitted.values.iter().enumerate() {
        for other in &fitted.values[..i] {
            let (key, other) = (&one.key, &other.key);
            let correlation = one.correlations[other];
            lines.push(format!("correlation {other} - {key}: {correlation:.3}"));
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
        lines.push(format!(
            "{name}: {points} points{at}, residuals {rms:.2e} {unit} rms"
        ));
        lines.extend(set.notes.iter().map(|note| format!("  {note}")));
        lines.extend(set.nuisances.iter().map(|one| {
            format!(
                "  {} {:.3e} ± {:.1e} {}",
                one.name, one.value, one.stderr, one.unit
            )
        }));
        lines.push(format!(
            "  χ² per degree of freedom {chi_squared:.2}; {runs} runs of one sign, by chance {expected_runs:.0} (p = \
             {probability:.1e})"
        ));
    }
    lines.extend(fitted.remarks.iter().cloned());
    lines.iter().map(|line| format!("{line}\n")).collect()
}

/// Plots measured minus simulated values, one plot per data set.
fn residual_plots(fit: &Fit, fitted: &Fitted, marker: Marker) -> String {
    let sets = fit.data.iter().zip(&fitted.sets);
    let charts = sets.map(|(measured, set)| {
        let abscissa = measured.axes.x;
        let ordinate = Axis::new(
            format!("{}: residual", measured.name),
            measured.axes.y.unit(),
        );
        let curve = Curve::new("", &measured.at[..], &set.residuals[..], Role::Profile);
        Chart::new(
            "",
            Axis::new(abscissa.quantity(), abscissa.unit()),
            ordinate,
        )
        .curve(curve)
    });
    small_multiples::draw(&charts.collect::<Vec<_>>(), marker)
}

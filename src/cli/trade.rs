//! `mdr-tui trade`: speed against accuracy, measured on this machine.

use std::io::{self, Write};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context, Result};

use super::args::Trade;
use super::job::end;
use super::{FAILED, Misuse, complain, progress, results, small_multiples, stop};
use crate::export::header::number;
use crate::math::abel::AbelMethod;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve, Scale};
use crate::scenario::Scenario;
use crate::studies::refinement::{Reached, Verdict, run_to_accuracy};
use crate::studies::trade::report::{Trial, cheapest, front, table};
use crate::studies::trade::{self, Sample, Setting};

/// Accuracies whose search for a level is timed as well as the fixed settings.
const ACCURACIES: [f64; 2] = [1e-2, 1e-3];

/// Errors below this one are small enough for any figure: the search ends there, or where the reference blurs.
const FINE: f64 = 1e-3;

/// Once a setting is fine enough, others are tried up to this many times its work: work predicts the time of
/// different methods only roughly.
const SLOWER: f64 = 2.0;

/// The longest that the search for an accuracy may take, s.
const LONGEST_SEARCH: f64 = 10.0;

/// The accuracy that a setting is recommended for where none is asked for.
const USUAL: f64 = ACCURACIES[0];

/// Runs the study and prints, draws and writes what was asked for.
pub fn trade(options: &Trade) -> Result<ExitCode> {
    let target = options.rows.claim()?;
    let scenario = Scenario::load(&options.scenario, &options.changes.set)?;
    let cycles = end(options.cycles.or(scenario.run().cycles), &options.scenario)?;
    if scenario.setup().wear.is_none() {
        let message = format!(
            "{}: nothing wears, so there is no worn profile to compare; see mdr-tui verify",
            options.scenario
        );
        return Err(Misuse(message).into());
    }
    let stop = stop::signal()?;
    let Some(found) = run(&scenario, cycles, options, &stop)? else {
        complain("interrupted before the reference was computed: no results");
        return Ok(ExitCode::from(FAILED));
    };
    let rows = || table(&found.trials, &found.trials);
    results::write(target.as_ref(), "trade", &found.notes, || rows().csv())?;
    let mut out = io::stdout().lock();
    if let Some(accuracy) = options.accuracy {
        return recommend(&found, accuracy, options.printing.json, &mut out);
    }
    if options.printing.json {
        results::print_json(&rows(), &mut out)?;
    } else {
        let front = front(&found.trials).into_iter().map(|(trial, _)| trial);
        let shown: Vec<&Trial> = match options.all {
            true => found.trials.iter().collect(),
            false => front.collect(),
        };
        writeln!(out, "{}", found.notes.join("\n"))?;
        write!(out, "{}", table(shown, &found.trials).text())?;
        if options.drawing.plot {
            write!(out, "{}", plots(&found.trials, options))?;
        }
        writeln!(out, "{}", advice(&found))?;
    }
    Ok(match found.interrupted {
        true => ExitCode::from(FAILED),
        false => ExitCode::SUCCESS,
    })
}

/// The cheapest setting for an accuracy, as assignments that `--set` takes.
fn recommend(found: &Found, accuracy: f64, json: bool, out: &mut impl Write) -> Result<ExitCode> {
    let Some((trial, [seconds, error])) = cheapest(&found.trials, accuracy) else {
        complain(&format!(
            "no setting reached an error of {accuracy:e}; try larger --points or --steps"
        ));
        return Ok(ExitCode::from(FAILED));
    };
    if json {
        results::print_json(&table([trial], &found.trials), out)?;
        return Ok(ExitCode::SUCCESS);
    }
    let what = "at worst (depth, V, E_d, F_x)";
    writeln!(out, "# error {error:.1e} {what}, in {seconds:.1e} s")?;
    writeln!(out, "{}", assignments(&trial.setting).join("\n"))?;
    Ok(ExitCode::SUCCESS)
}

/// A setting as options that `run` takes.
fn assignments(setting: &Setting) -> Vec<String> {
    let keys = setting.keys().into_iter();
    keys.map(|(key, value)| format!("--set {key}={value}"))
        .collect()
}

/// What was measured.
struct Found {
    trials: Vec<Trial>,
    /// What accuracies cost that find their level by themselves.
    adaptive: Vec<(f64, Reached)>,
    /// What was compared with what.
    notes: Vec<String>,
    interrupted: bool,
}

/// The reference first, then every setting, the cheapest first; `None` without a reference.
fn run(
    scenario: &Scenario,
    cycles: f64,
    options: &Trade,
    stop: &AtomicBool,
) -> Result<Option<Found>> {
    let methods = match options.methods.is_empty() {
        true => &AbelMethod::ALL[..],
        false => &options.methods,
    };
    let settings = trade::settings(scenario, methods, &options.points, &options.steps);
    let finest = trade::reference(scenario, &options.points, &options.steps);
    // With the default cells and steps, settings that are too slow are left out.
    let is_usual = options.points == trade::POINTS && options.steps == trade::STEPS;
    let effort = |setting: &Setting| setting.effort(cycles);
    let work: u64 = [finest, finest.halved()]
        .iter()
        .chain(&settings)
        .map(effort)
        .sum();
    let bar = progress::bar(work, progress::TIMES, options.printing.quiet);
    let go_on = || !stop.load(Ordering::Relaxed);
    let measure = |setting: &Setting, what: &str| {
        bar.set_message(format!("{what}{setting} by {}", setting.scheme));
        let outcome = trade::run(scenario, setting, cycles, &go_on);
        bar.inc(effort(setting));
        outcome
    };
    let Some(reference) = measure(&finest, "reference, ") else {
        return Ok(None);
    };
    let reference = reference.context("the reference")?;
    let half = measure(&finest.halved(), "reference, ");
    let mut interrupted = half.is_none();
    let blur = half.and_then(|half| Some(half.ok()?.against(&reference).worst()));
    // Once a setting is as good as the reference can resolve, slower ones add nothing.
    let (resolved, mut enough) = (FINE.max(blur.unwrap_or(0.0)), f64::INFINITY);
    let mut trials: Vec<Trial> = Vec::new();
    for setting in &settings {
        if is_usual && effort(setting) as f64 > SLOWER * enough {
            bar.inc(effort(setting));
            continue;
        }
        let Some(outcome) = measure(setting, "") else {
            interrupted = true;
            break;
        };
        let judged = |sample: Sample| {
            let errors = sample.against(&reference);
            (sample.judged_by(&reference), errors)
        };
        let trial = Trial {
            setting: *setting,
            outcome: outcome.map(judged).map_err(|error| error.to_string()),
        };
        if trial.point().is_some_and(|[_, error]| error <= resolved) {
            enough = enough.min(effort(setting) as f64);
        }
        trials.push(trial);
    }
    // Those that the result names are timed well.
    bar.set_message("timing");
    let named: Vec<Setting> = front(&trials)
        .iter()
        .map(|(best, _)| best.setting)
        .collect();
    for Trial { setting, outcome } in &mut trials {
        if let (Ok((sample, _)), true) = (outcome, named.contains(setting)) {
            let first = sample.seconds;
            sample.seconds = trade::median_time(scenario, setting, cycles, first, &go_on);
        }
    }
    let mut adaptive = Vec::new();
    for accuracy in ACCURACIES.into_iter().filter(|_| !interrupted) {
        bar.set_message(format!("numerics.accuracy = {accuracy:e}"));
        // If no level runs to its end, there is no cost to report.
        let reached = run_to_accuracy(scenario, cycles, accuracy, LONGEST_SEARCH, &go_on);
        adaptive.extend(reached.ok().map(|reached| (accuracy, reached)));
    }
    bar.finish_and_clear();
    let blur = blur.map_or(String::new(), |blur| {
        format!("; a level half as fine differs by {blur:.1e} at worst")
    });
    let mut notes = vec![
        format!(
            "{}, {} cycles: errors at the end of depth (rms, in largest depths), V, E_d and F_x; the \
             worst counts, and only runs that pass their own checks",
            scenario.title(),
            number(cycles)
        ),
        format!(
            "reference: {finest} per cycle, {:.1e} s{blur}",
            reference.seconds
        ),
    ];
    notes.extend(adaptive.iter().map(|one| cost(one, &trials, &reference)));
    if interrupted {
        let (tried, all) = (trials.len(), settings.len());
        notes.push(format!("interrupted: {tried} of {all} settings were tried"));
    }
    Ok(Some(Found {
        trials,
        adaptive,
        notes,
        interrupted,
    }))
}

/// What an accuracy cost, beside the cheapest fixed setting that would have done.
fn cost((accuracy, reached): &(f64, Reached), trials: &[Trial], reference: &Sample) -> String {
    let (seconds, level) = (reached.seconds, &reached.rung.level);
    let errors = Sample::of(&reached.session, seconds).against(reference);
    let error = errors.of_run.promised();
    let met = match reached.verdict {
        Verdict::Met => "",
        _ => ", not reached",
    };
    let beside = match cheapest(trials, *accuracy) {
        Some((trial, [fixed, _])) => format!(
            "{:.1} times the cheapest fixed setting ({}, {fixed:.1e} s)",
            seconds / fixed,
            trial.setting
        ),
        None => "no fixed setting tried is as good".into(),
    };
    format!(
        "numerics.accuracy = {accuracy:e}{met}: {seconds:.1e} s in all, ends at N = {}, {} steps per cycle; error of \
         scar and volume {error:.1e}; {beside}",
        level.points, level.steps
    )
}

/// The last line: what to use, and what it costs compared with `numerics.accuracy`.
fn advice(found: &Found) -> String {
    let mut adaptive = found.adaptive.iter();
    let usual = adaptive.find(|(accuracy, _)| *accuracy == USUAL);
    let beside = usual.map_or(String::new(), |(_, usual)| {
        format!(
            "; numerics.accuracy={USUAL:e} takes {:.1e} s, for any values of the other keys",
            usual.seconds
        )
    });
    match cheapest(&found.trials, USUAL) {
        Some((trial, [seconds, error])) => format!(
            "use this: {}  (error {error:.1e} at worst, {seconds:.1e} s{beside})",
            assignments(&trial.setting).join(" ")
        ),
        None => format!(
            "use this: --set numerics.accuracy={USUAL:e}  (no fixed setting has an error of at most {USUAL:e} and \
             passes its own checks{beside})"
        ),
    }
}

/// Error against time: one plot per method with its front; the overall front is dashed.
fn plots(trials: &[Trial], options: &Trade) -> String {
    let points = |method: Option<AbelMethod>| -> (Vec<f64>, Vec<f64>) {
        let mine = trials.iter();
        let mine = mine.filter(|trial| method.is_none_or(|method| trial.setting.method == method));
        front(mine)
            .iter()
            .map(|(_, [time, error])| (*time, *error))
            .unzip()
    };
    let all = points(None);
    let fronts = AbelMethod::ALL.map(|method| (format!("{method}: error"), points(Some(method))));
    let fronts = || fronts.iter().filter(|(_, (times, _))| !times.is_empty());
    let times = small_multiples::decades(fronts().flat_map(|(_, (times, _))| times.clone()));
    let errors = small_multiples::decades(fronts().flat_map(|(_, (_, errors))| errors.clone()));
    let (Some(times), Some(errors)) = (times, errors) else {
        return String::new();
    };
    let curve = |(times, errors): &(Vec<f64>, Vec<f64>)| {
        Curve::new("", times.clone(), errors.clone(), Role::Profile)
    };
    let charts = fronts().map(|(name, mine)| {
        Chart::new(
            "",
            Axis::new("time", "s").bounds(times).scale(Scale::Log),
            Axis::new(name.clone(), "").bounds(errors).scale(Scale::Log),
        )
        .curve(curve(&all).dashed())
        .curve(curve(mine))
    });
    small_multiples::draw(&charts.collect::<Vec<_>>(), options.drawing.marker.into())
}

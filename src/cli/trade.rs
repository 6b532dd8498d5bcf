//! `mdr-tui trade`: speed against accuracy, measured on this machine.

use std::process::ExitCode;

use anyhow::{Context, Result, bail, ensure};

use super::args::Trade;
use super::job::end;
use super::report::{self, Report};
use super::{given, progress, stop, succeeded};
use crate::math::abel::AbelMethod;
use crate::math::number::exact;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve, Scale};
use crate::scenario::session::SessionError;
use crate::scenario::{Refusal, Scenario, printable};
use crate::studies::refinement::{Budget, Level, Reached, SearchError, Verdict, run_to_accuracy};
use crate::studies::trade::{self, Candidate, Timed, Trial, cheapest, front, table};

/// Accuracies for which the search for a level is timed, in addition to the fixed settings.
const ACCURACIES: [f64; 2] = [1e-2, 1e-3];

/// The accuracy to recommend a setting for if none is given.
const USUAL: f64 = ACCURACIES[0];

/// Time limit of the search for an accuracy, s.
const LONGEST_SEARCH: Budget = Budget::of_search(10.0);

/// The reference must be this many times more accurate than the smallest error by which settings are judged.
const SHARPER: f64 = 3.0;

/// Runs the study and prints, draws and writes its results.
pub fn trade(options: &Trade) -> Result<ExitCode> {
    let target = options.output.claim()?;
    let scenario = given::scenario(&options.scenario, &options.changes.set)?;
    let name = printable(scenario.origin());
    let cycles = end(options.cycles.or(scenario.run().cycles), &name)?;
    let rule = "nothing wears, so there is no worn profile to compare; see mdr-tui verify";
    let wears = scenario.setup().wear.is_some();
    ensure!(wears, Refusal::new(&name, rule));
    let go_on = stop::signal().map(stop::until_stopped)?;
    let found = run(&scenario, cycles, options, &go_on)?;
    let found = found.context("interrupted before the reference was computed: no results");
    let (trials, notes) = &found?;
    report::write(target.as_ref(), "trade", notes, &table(trials, trials))?;
    let best = cheapest(trials, options.accuracy.unwrap_or(USUAL));
    if let (Some(accuracy), None) = (options.accuracy, best) {
        // A searched level may meet an accuracy that no fixed setting meets.
        let reached = run_to_accuracy(&scenario, cycles, accuracy, LONGEST_SEARCH, &go_on);
        let reached = reached
            .ok()
            .filter(|reached| reached.verdict == Verdict::Met);
        let Some(Reached { seconds, error, .. }) = reached else {
            bail!("no setting reached an error of {accuracy:e}; try larger --points or --steps");
        };
        let (error, found) = (error.promised(), table(&[], trials));
        let mut report = Report::default();
        report.line(format!(
            "# no fixed setting tried; estimated error {error:.1e} at worst (depth, V, E_d, F_x), in {seconds:.1e} s"
        ));
        report.line(format!("--set numerics.accuracy={accuracy:e}"));
        report.print(options.output.json.then_some(&found))?;
        return Ok(succeeded(go_on()));
    }
    let only = best.filter(|_| options.accuracy.is_some());
    let json = options.output.json;
    let shown: Vec<&Trial> = match only {
        Some((trial, _)) => vec![trial],
        None if options.all || json => trials.iter().collect(),
        None => front(trials).into_iter().map(|(trial, _)| trial).collect(),
    };
    let table = table(shown, trials);
    let mut report = Report::default();
    if let Some((trial, [seconds, error])) = only {
        report.line(format!(
            "# error {error:.1e} at worst (depth, V, E_d, F_x), in {seconds:.1e} s"
        ));
        report.lines(trial.setting.assignments());
    } else {
        report.lines(notes);
        report.line("");
        report.table(&table, 2);
        if options.drawing.plot {
            report.charts_alike(charts(trials), options.drawing.marker);
        }
        report.line(advice(best));
    }
    report.print(json.then_some(&table))?;
    Ok(succeeded(go_on()))
}

/// Returns what was measured and notes on what was compared: the reference first, then every setting, cheapest first.
/// `None` without a reference.
fn run(
    scenario: &Scenario,
    cycles: f64,
    options: &Trade,
    go_on: &dyn Fn() -> bool,
) -> Result<Option<(Vec<Trial>, Vec<String>)>> {
    let settings = trade::settings(scenario, &options.methods, &options.points, &options.steps);
    let bar = progress::bar(settings.len(), progress::COUNTS, options.output.quiet);
    let measure = |setting: &Candidate| {
        bar.set_message(format!("{setting} by {}", setting.scheme));
        setting.run(scenario, cycles, go_on)
    };
    bar.set_message("reference");
    let finest = options.accuracy.unwrap_or(USUAL).min(ACCURACIES[1]) / SHARPER;
    let best = trade::by_the_best(scenario)?;
    let reference = match run_to_accuracy(&best, cycles, finest, LONGEST_SEARCH, go_on) {
        Err(SearchError::Session(SessionError::Interrupted)) => return Ok(None),
        reached => reached.context("the reference")?,
    };
    let mut trials: Vec<Trial> = Vec::new();
    for setting in &settings {
        let ended = measure(setting);
        if !go_on() {
            break;
        }
        trials.push(Trial::new(setting.clone(), ended, &reference));
        bar.inc();
    }
    let mut notes = vec![
        format!(
            "{}, {} cycles: errors at the end of depth (rms, in largest depths), V, E_d and F_x; the \
             worst counts, and only runs that pass their own checks",
            scenario.title(),
            exact(cycles)
        ),
        format!("reference: {}", trade::describe_reference(&reference)),
    ];
    for accuracy in ACCURACIES.into_iter().take_while(|_| go_on()) {
        bar.set_message(format!("numerics.accuracy = {accuracy:e}"));
        // If no level runs to its end, there is no cost to report.
        if let Ok(reached) = run_to_accuracy(scenario, cycles, accuracy, LONGEST_SEARCH, go_on) {
            notes.push(cost(accuracy, &reached, &trials, &reference));
        }
    }
    drop(bar);
    if !go_on() {
        let (tried, all) = (trials.len(), settings.len());
        notes.push(format!("interrupted: {tried} of {all} settings were tried"));
    }
    Ok(Some((trials, notes)))
}

/// Describes what an accuracy cost, compared with the cheapest fixed setting that meets it.
fn cost(accuracy: f64, reached: &Reached, trials: &[Trial], reference: &Reached) -> String {
    let (seconds, Level { points, steps, .. }) = (reached.seconds, &reached.rung.level);
    let errors = reached
        .rung
        .outcome
        .difference_from(&reference.rung.outcome);
    let met = match reached.verdict {
        Verdict::Met => "",
        _ => ", not reached",
    };
    let cheapest_setting = match cheapest(trials, accuracy) {
        Some((trial, [fixed, _])) => format!(
            "{:.1} times the cheapest fixed setting ({}, {fixed:.1e} s)",
            seconds / fixed,
            trial.setting
        ),
        None => "no fixed setting tried is as good".into(),
    };
    format!(
        "numerics.accuracy = {accuracy:e}{met}: {seconds:.1e} s in all, ends at N = {points}, {steps} steps per cycle; \
         error of scar and volume {:.1e}; {cheapest_setting}",
        errors.promised()
    )
}

/// Returns the last line: which setting to use.
fn advice(best: Option<Timed>) -> String {
    match best {
        Some((trial, [seconds, error])) => format!(
            "use this: {}  (error {error:.1e} at worst, {seconds:.1e} s)",
            trial.setting.assignments().join(" ")
        ),
        None => format!(
            "use this: --set numerics.accuracy={USUAL:e}  (no fixed setting has an error of at most {USUAL:e} and \
             passes its own checks)"
        ),
    }
}

/// Plots error against time: one plot per method with its Pareto front; the overall front is dashed.
fn charts(trials: &[Trial]) -> Vec<Chart> {
    let curve = |method: Option<AbelMethod>| {
        let mut mine = trials.iter().collect::<Vec<_>>();
        mine.retain(|trial| method.is_none_or(|method| trial.setting.method == method));
        let points = front(mine).into_iter();
        let points = points.map(|(_, [time, error])| (time, error));
        let (times, errors): (Vec<f64>, Vec<f64>) = points.unzip();
        Curve::new("", times, errors, Role::Profile)
    };
    let all = curve(None).dashed();
    let charts = AbelMethod::ALL.into_iter().filter_map(|method| {
        let mine = curve(Some(method));
        let time = Axis::new("time", "s").scale(Scale::Log);
        let error = Axis::new(format!("{method}: error"), "").scale(Scale::Log);
        let chart = Chart::new("", time, error).curve(all.clone());
        (!mine.xs.is_empty()).then(|| chart.curve(mine))
    });
    charts.collect()
}

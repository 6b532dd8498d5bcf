//! `mdr-tui verify`: the error of every method against closed forms.

use anyhow::{Result, bail};

use super::args::Verify;
use super::{progress, results, small_multiples};
use crate::math::abel::AbelMethod;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve, Marker, Scale};
use crate::scenario::Refusal;
use crate::studies::verify::errors::Errors;
use crate::studies::verify::report::{all_nodes, all_rows, problem_table};
use crate::studies::verify::{Outcome, Problem, STICK_RADIUS, Task, tasks};

/// Runs the study and prints, draws and writes what was asked for.
pub fn verify(options: &Verify) -> Result<()> {
    let target = options.output.claim()?;
    let problems = match &options.problem[..] {
        [] => Problem::ALL,
        some => some,
    };
    let tasks = tasks(problems, &options.points, options.long);
    if tasks.is_empty() {
        bail!(Refusal::new(
            "--points",
            "these numbers of cells need --long"
        ));
    }
    let outcomes = run(&tasks, options.output.quiet);
    let (nodes, notes) = (all_nodes(&outcomes), notes(&outcomes));
    results::write(target.as_ref(), "verify", &notes, &nodes)?;
    let rows = options.output.json.then(|| all_rows(&outcomes));
    let is_whole = options.all || options.drawing.plot || !options.problem.is_empty();
    results::print(rows.as_ref(), || match is_whole {
        true => format!("{}\n{}\n", text(&outcomes, options), verdict(&outcomes)),
        false => verdict(&outcomes) + "\n",
    })
}

fn run(tasks: &[Task], quiet: bool) -> Vec<Outcome> {
    let effort = |task: &Task| task.problem.effort(task.points);
    // No remaining time: the effort is too rough an estimate.
    let length = tasks.iter().map(effort).sum();
    let bar = progress::bar(length, "{percent}%  {elapsed} gone", quiet);
    let outcomes = tasks.iter().map(|task| {
        bar.set_message(format!(
            "{}, {}, N = {}",
            task.problem, task.method, task.points
        ));
        bar.tick();
        let outcome = task.run();
        bar.inc(effort(task));
        outcome
    });
    let outcomes = outcomes.collect();
    bar.finish_and_clear();
    outcomes
}

/// Every table under what it shows, and the curves under their table.
fn text(outcomes: &[Outcome], options: &Verify) -> String {
    let marker = options.drawing.marker;
    let mut text = String::new();
    for &problem in Problem::ALL {
        if !outcomes.iter().any(|o| o.task.problem == problem) {
            continue;
        }
        if !text.is_empty() {
            text.push('\n');
        }
        text.push_str(&format!("{problem}\n"));
        for line in &problem.facts().description {
            text.push_str(&format!("  {line}\n"));
        }
        text.push_str(&problem_table(problem, outcomes).text());
        let left = options.points.iter();
        let left = left.filter(|&&points| !options.long && problem.is_long(points));
        let left: Vec<String> = left.map(usize::to_string).collect();
        if !left.is_empty() {
            text.push_str(&format!("N = {} only with --long\n", left.join(", ")));
        }
        if options.drawing.plot {
            text.push_str(&error_curves(problem, outcomes, marker));
        }
    }
    text
}

/// How far the best method is from theory, in a line: its worst problem, on the finest grid of each.
fn verdict(outcomes: &[Outcome]) -> String {
    let stopped = outcomes.iter().filter(|o| o.errors.is_err()).count();
    let stopped = match stopped {
        0 => String::new(),
        count => format!("; {count} runs stopped"),
    };
    let best = AbelMethod::Product;
    let finest = Problem::ALL.iter().filter_map(|problem| {
        let mine = outcomes.iter();
        let mine = mine.filter(|o| o.task.problem == *problem && o.task.method == best);
        let outcome = mine.max_by_key(|o| o.task.points)?;
        let errors = outcome.errors.as_ref().ok()?.iter().map(Errors::rms);
        Some((errors.fold(0.0, f64::max), outcome.task))
    });
    match finest.max_by(|a, b| a.0.total_cmp(&b.0)) {
        Some((error, task)) => format!(
            "verdict: {best} within {error:.1e} rms of theory ({}, N = {}){stopped}",
            task.problem, task.points
        ),
        None => format!("verdict: {best} was not tried{stopped}"),
    }
}

/// What the errors of each problem are.
fn notes(outcomes: &[Outcome]) -> Vec<String> {
    let shown = |problem: &&Problem| outcomes.iter().any(|o| o.task.problem == **problem);
    let shown = Problem::ALL.iter().filter(shown);
    shown
        .map(|problem| format!("{problem}: {}", problem.facts().description.join(" ")))
        .collect()
}

/// Curves of the error over r/a, drawn as text: for all quantities of a problem a small plot per method on its finest
/// grid, all on the same axes, so that they can be compared without colour.
///
/// ```text
/// a: g, N = 800                          b: g, N = 800
/// 1e-1 ┤⡀                                1e-1 ┤⡀
/// 1e-3 ┤⠈⠒⠤⢄⣀⣀⣀⣀⣀⣀⣀⣀                     1e-3 ┤⠈⠒⠤⢄⣀⣀⣀⣀⣀⣀⣀⣀
///      0               1                      0               1   r/a
/// ```
fn error_curves(problem: Problem, outcomes: &[Outcome], marker: Marker) -> String {
    let mut text = String::new();
    for (at, quantity) in problem.facts().quantities.iter().enumerate() {
        let chart = |method| {
            let tried = |o: &&Outcome| o.task.problem == problem && o.task.method == method;
            let (points, errors) = outcomes
                .iter()
                .filter(tried)
                .filter_map(|o| Some((o.task.points, o.errors.as_ref().ok()?.get(at)?)))
                .max_by_key(|(points, _)| *points)?;
            let name = format!("{method}: {}, N = {points}", quantity);
            let y = Axis::new(name, "").scale(Scale::Log);
            let (radii, values) = (errors.radii.clone(), errors.errors.clone());
            let curve = Curve::new("", radii, values, Role::Profile);
            Some(Chart::new("", Axis::new("r/a", ""), y).curve(curve))
        };
        if *quantity != STICK_RADIUS {
            let charts = AbelMethod::ALL.into_iter().filter_map(chart);
            text.push_str(&small_multiples::draw_alike(charts.collect(), marker));
        }
    }
    text
}

//! `mdr-tui verify`: the error of every method against closed forms.

use anyhow::{Result, ensure};

use super::args::Verify;
use super::progress;
use super::report::{self, Report};
use crate::math::abel::AbelMethod;
use crate::plot::theme::Role;
use crate::plot::{Axis, Chart, Curve, Scale};
use crate::scenario::Refusal;
use crate::studies::verify::errors::NodalErrors;
use crate::studies::verify::report::{all_nodes, all_rows, problem_table};
use crate::studies::verify::{Problem, STICK_RADIUS, Solved, Task, tasks};

/// Runs the study and prints, draws and writes its results.
pub fn verify(options: &Verify) -> Result<()> {
    let target = options.output.claim()?;
    let problems = match &options.problem[..] {
        [] => Problem::ALL,
        some => some,
    };
    let tasks = tasks(problems, &options.points, options.long);
    let rule = "these numbers of cells need --long";
    ensure!(!tasks.is_empty(), Refusal::new("--points", rule));
    let outcomes = run(&tasks, options.output.quiet);
    let (nodes, notes) = (all_nodes(&outcomes), notes(&outcomes));
    report::write(target.as_ref(), "verify", &notes, &nodes)?;
    let mut report = Report::default();
    if options.all || options.drawing.plot || !options.problem.is_empty() {
        for (problem, outcomes) in by_problem(&outcomes) {
            add_problem(&mut report, problem, outcomes, options);
        }
    }
    report.line(verdict(&outcomes));
    let rows = options.output.json.then(|| all_rows(&outcomes));
    report.print(rows.as_ref())
}

fn run(tasks: &[Task], quiet: bool) -> Vec<Solved> {
    let bar = progress::bar(tasks.len(), progress::COUNTS, quiet);
    let outcomes = tasks.iter().map(|task| {
        let (problem, method, points) = (task.problem, task.method, task.points);
        bar.set_message(format!("{problem}, {method}, N = {points}"));
        let outcome = task.run();
        bar.inc();
        outcome
    });
    outcomes.collect()
}

/// Groups the outcomes by problem.
fn by_problem(outcomes: &[Solved]) -> impl Iterator<Item = (Problem, &[Solved])> {
    let groups = outcomes.chunk_by(|a, b| a.task.problem == b.task.problem);
    groups.map(|group| (group[0].task.problem, group))
}

/// Adds a problem's description, its table, and the curves below it.
fn add_problem(report: &mut Report, problem: Problem, outcomes: &[Solved], options: &Verify) {
    report.line(problem.to_string());
    let description = problem.facts().description.lines();
    report.lines(description.map(|line| format!("  {line}")));
    report.table(&problem_table(problem, outcomes), 2);
    let points = options.points.iter();
    let left = points.filter(|&&points| !options.long && problem.is_long(points));
    let left: Vec<String> = left.map(usize::to_string).collect();
    if !left.is_empty() {
        report.line(format!("N = {} only with --long", left.join(", ")));
    }
    if options.drawing.plot {
        let charts = error_curves(problem, outcomes).into_iter();
        charts.for_each(|charts| report.charts_alike(charts, options.drawing.marker));
    }
    report.line("");
}

/// Says in one line how far the best method is from theory: its worst problem, on the finest grid of each.
fn verdict(outcomes: &[Solved]) -> String {
    let stopped = match outcomes.iter().filter(|o| o.errors.is_err()).count() {
        0 => String::new(),
        count => format!("; {count} runs stopped"),
    };
    let best = AbelMethod::default();
    let finest = by_problem(outcomes).filter_map(|(_, outcomes)| {
        let tried = outcomes.iter().filter(|o| o.task.method == best);
        let outcome = tried.max_by_key(|o| o.task.points)?;
        let errors = outcome.errors.as_ref().ok()?.iter().map(NodalErrors::rms);
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

/// Describes the errors of each problem.
fn notes(outcomes: &[Solved]) -> Vec<String> {
    let problems = by_problem(outcomes).map(|(problem, _)| problem);
    let note = |problem: Problem| {
        format!(
            "{problem}: {}",
            problem.facts().description.replace('\n', " ")
        )
    };
    problems.map(note).collect()
}

/// Plots the error over r/a: for each quantity of a problem one small plot per method on its finest grid, all
/// on the same axes, so that they can be compared without colour.
///
/// ```text
/// a: g, N = 800                          b: g, N = 800
/// 1e-1 ┤⡀                                1e-1 ┤⡀
/// 1e-3 ┤⠈⠒⠤⢄⣀⣀⣀⣀⣀⣀⣀⣀                     1e-3 ┤⠈⠒⠤⢄⣀⣀⣀⣀⣀⣀⣀⣀
///      0               1                      0               1   r/a
/// ```
fn error_curves(problem: Problem, outcomes: &[Solved]) -> Vec<Vec<Chart>> {
    let quantities = problem.facts().quantities.iter().enumerate();
    let drawn = quantities.filter(|(_, quantity)| **quantity != STICK_RADIUS);
    let plots = drawn.map(|(at, quantity)| {
        let charts = AbelMethod::ALL.into_iter().filter_map(|method| {
            let tried = outcomes.iter().filter(|o| o.task.method == method);
            let ended = tried.filter_map(|o| Some((o.task.points, o.errors.as_ref().ok()?)));
            let (points, errors) = ended.max_by_key(|(points, _)| *points)?;
            let y = Axis::new(format!("{method}: {quantity}, N = {points}"), "").scale(Scale::Log);
            let (radii, values) = (errors[at].radii.clone(), errors[at].errors.clone());
            let curve = Curve::new("", radii, values, Role::Profile);
            Some(Chart::new("", Axis::new("r/a", ""), y).curve(curve))
        });
        charts.collect()
    });
    plots.collect()
}

//! `mdr-tui verify`: the error of every method against closed forms.

use std::io::{self, IsTerminal, Write};
use std::process::ExitCode;

use anyhow::Result;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::args::Verify;
use super::{Misuse, error_curves, results};
use crate::export::file::write_whole;
use crate::studies::verify::report::{all_nodes, all_rows, problem_table};
use crate::studies::verify::{Outcome, Problem, Study, Task};

/// Runs the study and prints, draws and writes what was asked for.
pub fn verify(options: &Verify) -> Result<ExitCode> {
    if let Some(path) = &options.csv {
        results::check(path, options.force)?;
    }
    let study = Study {
        problems: if options.problem.is_empty() {
            Problem::ALL.to_vec()
        } else {
            options.problem.clone()
        },
        points: options.points.clone(),
        long: options.long,
    };
    let tasks = study.tasks();
    if tasks.is_empty() {
        let message = "--points: nothing to try without --long on so many cells";
        return Err(Misuse(message.into()).into());
    }
    let outcomes = run(&tasks, options.quiet);
    // The file first: a closed pipe on stdout must not cost it.
    if let Some(path) = &options.csv {
        write_whole(path, csv(&outcomes).as_bytes())?;
    }
    let mut out = io::stdout().lock();
    if options.json {
        writeln!(
            out,
            "{}",
            serde_json::to_string_pretty(&all_rows(&outcomes))?
        )?;
    } else {
        write!(out, "{}", text(&study, &outcomes, options))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn run(tasks: &[Task], quiet: bool) -> Vec<Outcome> {
    let effort = |task: &Task| task.problem.effort(task.points);
    let bar = ProgressBar::new(tasks.iter().map(effort).sum());
    if quiet || !io::stderr().is_terminal() {
        bar.set_draw_target(ProgressDrawTarget::hidden());
    }
    if let Ok(style) = ProgressStyle::with_template("{msg} [{bar:32}] {percent}%  {elapsed} gone") {
        bar.set_style(style.progress_chars("=> "));
    }
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
fn text(study: &Study, outcomes: &[Outcome], options: &Verify) -> String {
    let marker = options.marker.into();
    let mut text = String::new();
    for problem in Problem::ALL {
        if !outcomes.iter().any(|o| o.task.problem == problem) {
            continue;
        }
        if !text.is_empty() {
            text.push('\n');
        }
        text.push_str(&format!("{problem}\n"));
        for line in problem.description() {
            text.push_str(&format!("  {line}\n"));
        }
        text.push_str(&problem_table(problem, outcomes).text());
        let left = study.left_for_long();
        let left = left.iter().filter(|(left, _)| *left == problem);
        let left: Vec<String> = left.map(|(_, points)| points.to_string()).collect();
        if !left.is_empty() {
            text.push_str(&format!("N = {} only with --long\n", left.join(", ")));
        }
        if options.plot {
            text.push_str(&error_curves::draw(problem, outcomes, marker));
        }
    }
    text
}

/// All nodes, under lines that say what the errors are.
fn csv(outcomes: &[Outcome]) -> String {
    let mut text = format!(
        "# mdr-tui: {}\n# study: verify\n",
        env!("CARGO_PKG_VERSION")
    );
    for problem in Problem::ALL {
        if outcomes.iter().any(|o| o.task.problem == problem) {
            text.push_str(&format!(
                "# {problem}: {}\n",
                problem.description().join(" ")
            ));
        }
    }
    text.push_str(&all_nodes(outcomes).csv());
    text
}

//! `mdr-tui sweep`: a study of many points, whole or in shards.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::{env, thread};

use anyhow::{Context, Result, anyhow, bail, ensure};
use clap::Parser;

use super::args::{Arguments, Sweep};
use super::{UNFINISHED, complain, explore, progress, stop, succeeded};
use crate::export::file::shell_path;
use crate::scenario::{Refusal, bounded_read, printable};
use crate::studies::sweep::{Results, Shard, Status, Study, engine};
use crate::tui::map::live::LiveStudy;

mod merge;
mod output;
mod slurm;

use output::StudyTable;

/// The largest study file to be read, in bytes.
const LARGEST_STUDY: u64 = 1 << 26;

/// The variable with which Slurm gives a task of an array its index.
const SLURM_INDEX: &str = "SLURM_ARRAY_TASK_ID";

/// Runs the command.
pub fn sweep(options: &Sweep) -> Result<ExitCode> {
    if options.sensitivity {
        let rule = "is gone; points = \"file.csv\" takes points around a scenario: see mdr-tui guide studies";
        bail!(Refusal::new("--sensitivity", rule));
    }
    if let Some(directory) = &options.merge {
        return merge::merge(directory, options).map(|()| ExitCode::SUCCESS);
    }
    if let Some(file) = &options.view {
        return view(file, options).map(|()| ExitCode::SUCCESS);
    }
    let path = options.study.clone().unwrap_or_default();
    let study = read(&path, &options.changes.set)?;
    if let Some(point) = options.point {
        print_point(&study, point)?;
    } else if options.slurm {
        refuse_invalid(options, &study, Shard::WHOLE)?;
        let script = slurm::script(&path, options, study.points());
        io::stdout().write_all(script.as_bytes())?;
    } else {
        return run(options, &path, study);
    }
    Ok(ExitCode::SUCCESS)
}

/// Shows a table as a map until the user quits.
fn view(file: &Path, options: &Sweep) -> Result<()> {
    let map = LiveStudy::of_file(file)?;
    let mut explorer = Arguments::try_parse_from(["mdr-tui"])?.explore;
    explorer.screen = options.screen.clone();
    explore::explore(&explorer, Some(map))
}

/// Reads a study and applies the assignments of the command line.
fn read(path: &Path, sets: &[String]) -> Result<Study> {
    let name = printable(&path.display().to_string());
    let text = bounded_read::text(path, LARGEST_STUDY)
        .map_err(|why| Refusal::unread(&name, &why).or("a study is a TOML file"))?;
    let directory = path.parent().unwrap_or(Path::new(""));
    let mut study = Study::read(&text, &name, directory)?;
    for set in sets {
        study.assign(set)?;
    }
    Ok(study)
}

fn print_point(study: &Study, point: usize) -> Result<()> {
    let (place, points) = (format!("--point {point}"), study.points());
    let rule = format!("the study has {points} points, counted from 0");
    ensure!(point < points, Refusal::new(place, rule));
    let scenario = study.scenario(point)?;
    let (name, scenario) = (study.name(point), scenario.to_toml());
    Ok(writeln!(io::stdout(), "# {name}\n{scenario}")?)
}

/// Refuses a study with an invalid point, unless invalid points are skipped.
fn refuse_invalid(options: &Sweep, study: &Study, shard: Shard) -> Result<()> {
    let checked = if options.skip_invalid {
        Ok(())
    } else {
        engine::check(study, shard)
    };
    Ok(checked.map_err(invalid)?)
}

fn invalid(refusal: Refusal) -> Refusal {
    refusal.or("--skip-invalid runs the other points")
}

fn run(options: &Sweep, path: &Path, study: Study) -> Result<ExitCode> {
    let shard = shard(options)?;
    let out = options.out.clone();
    let out = out.unwrap_or_else(|| default_out(path, shard));
    refuse_invalid(options, &study, shard)?;
    let mut output = StudyTable::open(&out, study, shard, options)?;
    let go_on = stop::signal().map(stop::until_stopped)?;
    crate::panics::capture();
    let study = Arc::clone(&output.results.study);
    let (mine, todo) = (shard.points(study.points()), output.results.missing(shard));
    let bar = progress::bar(mine.len(), progress::TIMES, options.quiet);
    bar.set_message(printable(&out.display().to_string()));
    bar.set_position(output.results.rows().len() as f64);
    let (mine, mut points) = (mine.len(), mine.peekable());
    // With --json, prints each row as soon as all rows before it are known.
    let mut print = |results: &Results| -> Result<()> {
        let mut out = io::stdout().lock();
        while options.json
            && let Some(row) = points.peek().and_then(|&point| results.row(point))
        {
            writeln!(out, "{}", results.json(row))?;
            points.next();
        }
        Ok(())
    };
    let (mut outcome, mut checked) = (print(&output.results), Ok(()));
    let processors = || thread::available_parallelism().map_or(1, usize::from);
    let threads = options.threads.map_or_else(processors, usize::from);
    if outcome.is_ok() {
        let started = engine::run(&study, &todo, threads, &go_on, |row| {
            if !options.skip_invalid && matches!(row.status, Status::Invalid(_)) {
                checked = engine::validated(&study, row.point);
                return false;
            }
            let added = output.add(row).map_err(|error| anyhow!("{error}"));
            outcome = added.and_then(|()| print(&output.results));
            bar.inc();
            outcome.is_ok()
        });
        started.context("cannot start the threads")?;
    }
    drop(bar);
    let kept = output.close();
    let there = output.results.rows().len();
    let hint = format!(
        "{there} of {mine} points are in {}; continue with the same command and --resume",
        shell_path(&out)
    );
    outcome.with_context(|| hint.clone())?;
    kept.map_err(|error| anyhow!("{error}; {hint}"))?;
    checked.map_err(|refusal| invalid(refusal).or(&hint))?;
    if there < mine {
        let why = if go_on() { "unfinished" } else { "interrupted" };
        complain(&format!("{why}: {hint}"));
        return Ok(ExitCode::from(UNFINISHED));
    }
    let is_reported = !options.quiet && !options.json && !output.target.is_stdout();
    if complain_of_points(&output.results, options.quiet) && is_reported {
        writeln!(io::stdout(), "{there} points in {}", shell_path(&out))?;
    }
    // Invalid points do not count as failures: they were to be skipped.
    let failed = output
        .results
        .count(|status| matches!(status, Status::Failed(_)));
    Ok(succeeded(failed == 0 && output.results.failed() < there))
}

/// Says how many points of a finished study are not as they should be; returns whether all have a result.
fn complain_of_points(results: &Results, quiet: bool) -> bool {
    let (there, failed) = (results.rows().len(), results.failed());
    let is_inaccurate = |status: &Status| matches!(status, Status::Inaccurate(_));
    let is_unchecked = |status: &Status| matches!(status, Status::Unchecked(_));
    let inaccurate = "did not reach numerics.accuracy; their status says what they reached";
    let unchecked = "fail a check; their status says which, and by how much";
    let without = "failed; their status says why, and --resume --failed runs them again";
    for (count, is_reported, what) in [
        (results.count(is_inaccurate), !quiet, inaccurate),
        (results.count(is_unchecked), !quiet, unchecked),
        (failed, true, without),
    ] {
        if count > 0 && is_reported {
            complain(&format!("{count} of {there} points {what}"));
        }
    }
    failed == 0
}

/// Returns the part of the study to run.
fn shard(options: &Sweep) -> Result<Shard> {
    let Some(count) = options.shards else {
        return Ok(options.shard.unwrap_or(Shard::WHOLE));
    };
    let Ok(index) = env::var(SLURM_INDEX) else {
        let rule = format!("{SLURM_INDEX} is not set, so this is not a task of a Slurm array");
        let refusal = Refusal::new(format_args!("--shards {count}"), rule);
        let hint = format!("use --shard i/{count}, or --slurm for a job script");
        bail!(refusal.or(hint));
    };
    let shard = format!("{index}/{count}").parse();
    shard.map_err(|why: String| Refusal::of_value(SLURM_INDEX, &index, why).into())
}

/// Returns the default output file.
fn default_out(study: &Path, shard: Shard) -> PathBuf {
    match shard {
        Shard::WHOLE => named_after(study, "csv"),
        Shard { index, .. } => named_after(study, "shards").join(format!("shard-{index}.csv")),
    }
}

/// Returns a path in the working directory, named after the study, with another `ending`: for its table, or for the
/// directory of its shards.
fn named_after(study: &Path, ending: &str) -> PathBuf {
    Path::new(study.file_name().unwrap_or_default()).with_extension(ending)
}

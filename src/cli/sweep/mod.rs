//! `mdr-tui sweep`: a study of many points, whole or in shards.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};
use std::{env, thread};

use anyhow::{Context, Result, anyhow, bail, ensure};
use clap::Parser;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::args::{Arguments, Sweep};
use super::{UNFINISHED, complain, explore, progress, stop, succeeded};
use crate::export::file::shell_path;
use crate::scenario::{Refusal, bounded_read, printable};
use crate::studies::sweep::engine;
use crate::studies::sweep::ledger::Ledger;
use crate::studies::sweep::record::{self};
use crate::studies::sweep::{Shard, Study, Success};
use crate::tui::map::live::LiveStudy;

mod merge;
mod output;
mod sensitivity;
mod slurm;

use output::Output;

/// The largest study file to be read, in bytes.
const LARGEST_STUDY: u64 = 1 << 26;

/// The variable with which Slurm gives a task of an array its index.
const SLURM_INDEX: &str = "SLURM_ARRAY_TASK_ID";

/// Runs the command.
pub fn sweep(options: &Sweep) -> Result<ExitCode> {
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
    } else if options.sensitivity {
        sensitivity::sensitivity(options, &study)?;
    } else if study.axes.is_empty() {
        let rule = "the study has no axis (only --sensitivity works without one)";
        bail!(Refusal::new(path.display(), rule));
    } else if options.slurm {
        let pool = pool(options, study.points())?;
        refuse_invalid(options, &study, Shard::WHOLE, &pool, Duration::MAX)?;
        let script = slurm::script(&path, options, study.points());
        io::stdout().write_all(script.as_bytes())?;
    } else {
        return run(options, &path, &study);
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

/// Starts the threads for this many `points`: the number asked for, or one per processor, but no idle ones.
fn pool(options: &Sweep, points: usize) -> Result<ThreadPool> {
    let processors = || thread::available_parallelism().map_or(1, usize::from);
    let threads = options.threads.map_or_else(processors, usize::from);
    let threads = threads.clamp(1, points.max(1));
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    pool.context("cannot start the threads")
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

/// Maximum time for checking points before the first one runs.
const CHECKED_FIRST: Duration = Duration::from_secs(1);

/// Refuses a study with an invalid point, unless invalid points are skipped. Points not checked within `patience` are
/// checked when they run.
fn refuse_invalid(
    options: &Sweep,
    study: &Study,
    shard: Shard,
    pool: &ThreadPool,
    patience: Duration,
) -> Result<()> {
    if options.skip_invalid {
        return Ok(());
    }
    let bar = progress::bar(study.points(), progress::TIMES, options.quiet);
    bar.set_message("checking");
    let start = Instant::now();
    let checked = engine::check(study, shard, pool, |checked| {
        bar.set_position((checked * shard.count) as f64);
        start.elapsed() < patience
    });
    drop(bar);
    Ok(checked.map_err(invalid)?)
}

fn invalid(refusal: Refusal) -> Refusal {
    refusal.or("--skip-invalid runs the other points")
}

fn run(options: &Sweep, path: &Path, study: &Study) -> Result<ExitCode> {
    let shard = shard(options)?;
    let out = options.out.clone();
    let out = out.unwrap_or_else(|| default_out(path, shard));
    let mine = shard.points(study.points()).count();
    let pool = pool(options, mine)?;
    refuse_invalid(options, study, shard, &pool, CHECKED_FIRST)?;
    let mut output = Output::open(&out, study, shard, options)?;
    let go_on = stop::signal().map(stop::until_stopped)?;
    crate::panics::capture();
    let bar = progress::bar(mine, progress::TIMES, options.quiet);
    bar.set_message(printable(&out.display().to_string()));
    bar.set_position(output.ledger.rows() as f64);
    let mut points = shard.points(study.points()).peekable();
    // With --json, prints each row as soon as all rows before it are known.
    let mut print = |ledger: &Ledger| -> Result<()> {
        let mut out = io::stdout().lock();
        while options.json
            && let Some(point) = points.next_if(|&point| ledger.has(point))
        {
            let row = record::json(&study.columns(), &ledger.row(point)?);
            writeln!(out, "{row}")?;
        }
        Ok(())
    };
    let mut outcome = print(&output.ledger);
    let mut checked = Ok(());
    if outcome.is_ok() {
        let todo = output.ledger.missing(study, shard);
        engine::run(study, todo, &pool, &go_on, |point, row| {
            if !options.skip_invalid && Success::from_row(&row) == Success::Invalid {
                checked = engine::validated(study, point);
                return false;
            }
            let added = output.add(point, &row);
            let added = added.map_err(|error| anyhow!("{error}"));
            outcome = added.and_then(|()| print(&output.ledger));
            bar.inc();
            outcome.is_ok()
        });
    }
    drop(bar);
    let kept = output.close();
    let (there, failed) = (output.ledger.rows(), output.ledger.failed());
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
    let inaccurate = output.ledger.count(Success::Inaccurate);
    if inaccurate > 0 && !options.quiet {
        complain(&format!(
            "{inaccurate} of {there} points did not reach numerics.accuracy; their status says what they reached"
        ));
    }
    let unchecked = output.ledger.count(Success::Unchecked);
    if unchecked > 0 && !options.quiet {
        complain(&format!(
            "{unchecked} of {there} points fail a check; their status says which, and by how much"
        ));
    }
    if failed > 0 {
        complain(&format!(
            "{failed} of {there} points failed; their status says why, and --resume --failed runs \
             them again"
        ));
        // Invalid points do not count as failures: they were to be skipped.
        let is_failure = failed == there || output.ledger.count(Success::Failed) > 0;
        return Ok(succeeded(!is_failure));
    }
    if !options.quiet && !options.json && !output.target.is_stdout() {
        writeln!(io::stdout(), "{there} points in {}", shell_path(&out))?;
    }
    Ok(ExitCode::SUCCESS)
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

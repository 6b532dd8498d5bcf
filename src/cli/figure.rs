//! `mdr-tui figure`: figures for a paper, from a run's files or from a scenario.

use std::ffi::OsStr;
use std::fs;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context, Result, bail, ensure};

use super::args::{Figure, PaperFigure};
use super::{accuracy, given, job};
use crate::charts::study::Slice;
use crate::charts::{Recipe, Run, USUAL, depth, on_paper, scar_depth, volume};
use crate::export::target::Target;
use crate::figure::look::FigureStyle;
use crate::figure::{DATA_COLUMNS, Format, Sheet, paper, study as figure_of_study};
use crate::plot::Chart;
use crate::plot::theme::Role;
use crate::scenario::bounded_read::{self, Unread};
use crate::scenario::columns::{Columns, Naming};
use crate::scenario::{Refusal, Scenario, printable};
use crate::studies::ghost::Ghost;
use crate::studies::sweep::record::StudyFile;
use crate::studies::sweep::{Results, Shard};
use crate::traces::Table;

/// The largest table header to be read, in bytes.
const LARGEST_HEADER: u64 = 1 << 20;

/// The scenario of the paper's Fig. 3.
const OF_THE_PAPER: &str = "li2019-fig3";

/// Millimetres per point.
const POINT: f64 = 25.4 / 72.0;

/// Draws the figure and writes it together with its data.
pub fn figure(options: &Figure) -> Result<()> {
    let mut files: Vec<(Target, Format)> = Vec::new();
    let mut data_files: Vec<Target> = Vec::new();
    for path in &options.out {
        let format = Format::from_path(path).ok_or_else(|| {
            let path = path.display();
            Refusal::new(format_args!("-o {path}"), "must end in .svg, .png or .pdf")
        })?;
        if files.iter().any(|(target, _)| target.path() == path) {
            continue;
        }
        files.push((Target::claim(path, options.force)?, format));
        let data_path = data_file(path, options);
        if data_files.iter().all(|target| target.path() != data_path) {
            let is_replaced = options.force || is_data_of_a_figure(&data_path);
            data_files.push(Target::claim(&data_path, is_replaced)?);
        }
    }
    let sheet = sheet(options)?;
    let data = sheet.csv();
    for target in &data_files {
        // Data that are already there are fine: another format of the same figure has the same data.
        if fs::read(target.path()).ok().as_deref() != Some(data.as_bytes()) {
            target.refuse_existing(options.force)?;
        }
    }
    let look = FigureStyle {
        font: options.font_size * POINT,
        style: options.style,
    };
    let dpi = f64::from(options.dpi);
    sheet.save(&look, options.size, dpi, &files, &data_files)?;
    if !options.quiet {
        let written = files.iter().map(|(target, _)| target).chain(&data_files);
        let names = written.map(|target| printable(&target.path().display().to_string()));
        let names: Vec<String> = names.collect();
        writeln!(io::stdout().lock(), "{}", names.join(" and "))?;
    }
    Ok(())
}

/// Returns the path for a figure's data: the figure's name with .csv, or `map-drawn.csv` if `map.csv` is one of the
/// inputs or holds anything but a figure's data.
fn data_file(path: &Path, options: &Figure) -> PathBuf {
    let real = |path: &Path| path.canonicalize().ok();
    let given = options.source.iter().chain(&options.overlay);
    let given: Vec<PathBuf> = given.filter_map(|name| real(Path::new(name))).collect();
    let mut data_path = path.with_extension("csv");
    let is_drawn =
        |data_path: &Path| real(data_path).is_some_and(|data_path| given.contains(&data_path));
    let is_free =
        |data_path: &Path| data_path.symlink_metadata().is_err() || is_data_of_a_figure(data_path);
    while is_drawn(&data_path) || !is_free(&data_path) {
        let stem = data_path.file_stem().unwrap_or_default().to_string_lossy();
        data_path = data_path.with_file_name(format!("{stem}-drawn.csv"));
    }
    data_path
}

/// Whether a file was written by [`Sheet::csv`], judging by its header and columns.
fn is_data_of_a_figure(path: &Path) -> bool {
    let Ok(file) = bounded_read::open(path) else {
        return false;
    };
    let mut lines = BufReader::new(file.take(LARGEST_HEADER)).lines();
    let is_ours = |line: Option<io::Result<String>>| {
        line.is_some_and(|line| line.is_ok_and(|line| line.starts_with("# mdr-tui: ")))
    };
    let is_header =
        |line: &io::Result<String>| line.as_ref().is_ok_and(|line| line.starts_with('#'));
    is_ours(lines.next())
        && lines
            .find(|line| !is_header(line))
            .is_some_and(|line| line.is_ok_and(|line| line == DATA_COLUMNS))
}

fn sheet(options: &Figure) -> Result<Sheet> {
    if options.figure == Some(PaperFigure::Fig2) {
        if let Some(source) = &options.source {
            let source = printable(&source.to_string_lossy());
            let rule = "fig2 is the paper's own error study and takes no source";
            bail!(Refusal::new(source, rule));
        }
        return Ok(paper::errors(paper::POINTS)?);
    }
    let path = Path::new(
        options
            .source
            .as_deref()
            .unwrap_or(OsStr::new(OF_THE_PAPER)),
    );
    let source = &*printable(&path.to_string_lossy());
    if let Some(record) = record(path) {
        return study(source, record, options);
    }
    if let Some(column) = options.column.first() {
        let rule = "is for the table of a sweep; a run has --panel";
        bail!(Refusal::new(format_args!("--column {column}"), rule));
    }
    let mut run = run(path, options)?;
    for given in &options.overlay {
        let ghost = ghost(given, &options.naming.of_columns(), &run)?;
        run.ghosts.push(Arc::new(ghost));
    }
    let refused = |error| Refusal::new(source, error);
    if options.figure.is_some() {
        return Ok(paper::fretting(&run).map_err(refused)?);
    }
    let wanted = options.panel.iter().map(|panel| panel.on_paper(&run));
    let mut charts: Vec<Chart> = wanted.collect::<Result<_, _>>().map_err(refused)?;
    for panels in [usual(&run.ghosts), on_paper().collect()] {
        if charts.is_empty() {
            let found = panels.iter().map(|panel| panel.on_paper(&run));
            charts = found.filter_map(Result::ok).collect();
        }
    }
    ensure_all_is_shown(options, &run.ghosts, &charts)?;
    let facts = run.facts();
    let title = facts.iter().find(|(key, _)| key == "scenario");
    Ok(Sheet {
        title: title.map_or_else(|| source.to_owned(), |(_, title)| title.clone()),
        facts,
        charts,
    })
}

/// Reads the table of a sweep; `None` if it is not one.
fn record(path: &Path) -> Option<StudyFile> {
    let is_table = path.is_file() && path.extension().is_some_and(|end| end == "csv");
    is_table.then(|| StudyFile::of_file(path).ok()).flatten()
}

/// Makes the charts of a sweep's table.
fn study(source: &str, record: StudyFile, options: &Figure) -> Result<Sheet> {
    let of_runs = [
        ("--figure", options.figure.is_some()),
        ("--panel", !options.panel.is_empty()),
        ("--overlay", !options.overlay.is_empty()),
        ("--at", options.at.is_some()),
        ("--cycles", options.cycles.is_some()),
    ];
    if let Some((name, _)) = of_runs.iter().find(|(_, given)| *given) {
        let rule = format!("is for a run; {source} is the table of a sweep, which has --column");
        bail!(Refusal::new(name, rule));
    }
    let (results, _) = Results::read(record.study()?, Shard::WHOLE, &[record])?;
    let slice = Slice::new(results, &options.changes.set).map_err(Refusal::from)?;
    Ok(figure_of_study::sheet(&slice, &options.column, source).map_err(Refusal::from)?)
}

/// Returns the default charts, and those that show measured data.
fn usual(ghosts: &[Arc<Ghost>]) -> Vec<&'static Recipe> {
    let of_ghosts = [&depth::RECIPE, &volume::RECIPE, &scar_depth::RECIPE];
    let is_wanted = |panel: &&Recipe| {
        let mut ghosts = ghosts.iter();
        ghosts.any(|ghost| ghost.is_measured && panel.shows(ghost))
    };
    let mut panels = USUAL.to_vec();
    panels.extend(of_ghosts.into_iter().filter(is_wanted));
    panels
}

/// Checks that every overlay is on one of the charts; the error names the chart that it belongs to.
fn ensure_all_is_shown(options: &Figure, ghosts: &[Arc<Ghost>], charts: &[Chart]) -> Result<()> {
    for (k, (given, ghost)) in options.overlay.iter().zip(ghosts).enumerate() {
        let mut curves = charts.iter().flat_map(|chart| &chart.curves);
        let is_shown = curves.any(|curve| curve.role == Role::Ghost(k));
        let places = on_paper().filter(|panel| panel.shows(ghost));
        let names: Vec<&str> = places.map(|panel| panel.name).collect();
        let places = names.join(" or ");
        let rule = format!("is on none of these charts; it belongs to --panel {places}");
        let given = printable(&given.to_string_lossy());
        ensure!(is_shown, Refusal::new(format!("--overlay {given}"), rule));
    }
    Ok(())
}

/// The curves of a file or of a directory, or of a scenario that is run as far as the figure goes.
fn ghost(given: &OsStr, naming: &Naming, run: &Run) -> Result<Ghost> {
    let path = Path::new(given);
    let ending = path.extension();
    if path.is_dir() || ending.is_some_and(|end| !end.eq_ignore_ascii_case("toml")) {
        let ghost = Ghost::read(path, naming)?;
        if !run.states.is_empty() {
            ghost.check_radii(run.edge())?;
        }
        return Ok(ghost);
    }
    let scenario = Scenario::load(given, &[])?;
    let end = run.end().or(scenario.run().cycles);
    let shown = printable(scenario.origin());
    let end = job::end(end, &shown)?;
    let name = scenario.stem();
    let session = accuracy::session(&scenario, Some(end), true);
    let mut session = session.with_context(|| shown)?;
    Ok(Run::simulate(&mut session, &[end], false)?.ghost(&name))
}

/// Reads the tables of a run on disk, or runs a scenario now.
fn run(path: &Path, options: &Figure) -> Result<Run> {
    let source = &*printable(&path.to_string_lossy());
    let ending = path.extension();
    let mut run = Run::default();
    if path.is_dir() {
        run = from_directory(path)?;
    } else if ending.is_some_and(|end| end.eq_ignore_ascii_case("csv")) {
        add_file(&mut run, path)?;
    } else {
        return from_scenario(path.as_os_str(), options);
    }
    let is_as_it_was = options.changes.set.is_empty() && options.cycles.is_none();
    let rule = "a finished run is not run again, so --set and --cycles have no effect";
    ensure!(is_as_it_was, Refusal::new(source, rule));
    if let Some(wanted) = &options.at {
        let is_at = |state: &Table, cycle: f64| (state.cycle() - cycle).abs() < 1e-9;
        for at in wanted {
            let is_there = run.states.iter().any(|state| is_at(state, at.cycle()));
            let cycles = run.states.iter().map(|state| state.cycle().to_string());
            let cycles = cycles.collect::<Vec<_>>().join(", ");
            let rule = format!("{source} has no such state; it has those at {cycles}");
            ensure!(is_there, Refusal::new(format!("--at {}", at.0), rule));
        }
        let is_wanted = |state: &Arc<Table>| wanted.iter().any(|at| is_at(state, at.cycle()));
        run.states.retain(is_wanted);
    }
    Ok(run)
}

fn from_directory(directory: &Path) -> Result<Run> {
    let mut run = Run::default();
    let failed = |error| Refusal::unread(directory.display(), &Unread::Io(error));
    let entries = fs::read_dir(directory).map_err(failed)?;
    let paths = entries.map(|entry| Ok(entry?.path()));
    let mut paths = paths
        .collect::<io::Result<Vec<PathBuf>>>()
        .map_err(failed)?;
    paths.sort();
    for path in paths {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let is_state = name.starts_with("state") && name.ends_with(".csv");
        let is_table = is_state || ["history.csv", "loop.csv", "field.csv"].contains(&&*name);
        // A figure may have been drawn into the folder.
        if is_table && !is_data_of_a_figure(&path) {
            add_file(&mut run, &path)?;
        }
    }
    let is_empty = run.states.is_empty() && run.history.is_none() && run.field.is_none();
    let why = "has no state.csv, history.csv or field.csv";
    ensure!(!is_empty, unread(directory, why));
    let scenario = directory.join("scenario.toml");
    if scenario.is_file() {
        run = run.with_scenario(&Scenario::load(&scenario, &[])?);
    }
    Ok(run)
}

/// Reads a table of a run.
fn add_file(run: &mut Run, path: &Path) -> Result<()> {
    let table = Table::of_file(&Columns::read(path)?);
    let has_rows = table.rows() > 0;
    run.add_table(table).map_err(|why| unread(path, why))?;
    ensure!(has_rows, unread(path, "has no rows of numbers"));
    Ok(())
}

fn unread(path: &Path, why: impl std::fmt::Display) -> Refusal {
    Refusal::new(path.display(), why)
}

fn from_scenario(name: &OsStr, options: &Figure) -> Result<Run> {
    let scenario = given::scenario(name, &options.changes.set)?;
    let name = &*printable(scenario.origin());
    let mut cycles: Vec<f64> = match &options.at {
        Some(at) => at.iter().map(|at| at.cycle()).collect(),
        None => {
            let end = job::end(options.cycles.or(scenario.run().cycles), name)?;
            let planned = scenario.run().snapshot_at.iter().copied();
            planned.filter(|&at| at < end).chain([end]).collect()
        }
    };
    cycles.sort_by(f64::total_cmp);
    let with_field = options.panel.iter().any(|panel| panel.needs_field);
    let session = accuracy::session(&scenario, cycles.last().copied(), options.quiet);
    let mut session = session.with_context(|| name.to_owned())?;
    Ok(Run::simulate(&mut session, &cycles, with_field)?)
}

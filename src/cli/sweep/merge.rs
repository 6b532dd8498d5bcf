//! `sweep --merge`: merges the shards of a study into one table.

use std::collections::BTreeSet;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::{env, fs};

use anyhow::{Context, Result, bail};

use crate::cli::args::Sweep;
use crate::cli::{complain, stop};
use crate::export::target::Target;
use crate::scenario::{Refusal, printable};
use crate::studies::sweep::ledger::Ledger;
use crate::studies::sweep::record::{self, Arithmetic, Record, Refused};
use crate::studies::sweep::{Shard, Study};

/// Maximum number of points named in a message.
const NAMED: usize = 3;

/// Reads every table of the directory and writes the merged one.
pub fn merge(directory: &Path, options: &Sweep) -> Result<()> {
    let shown = printable(&directory.display().to_string());
    stop::end_at_signal()?;
    let target = Target::claim_given(options.out.as_deref(), options.force)?;
    let mut files = tables(directory).map_err(|error| Refusal::new(&shown, error))?;
    let out = options.out.as_ref().and_then(|out| out.canonicalize().ok());
    files.retain(|file| out.is_none() || file.canonicalize().ok() != out);
    let rule = "has no table written by mdr-tui sweep";
    let first = files.first().ok_or_else(|| Refusal::new(&shown, rule))?;
    let record = Record::of_file(first)?;
    let study = &record.study()?;
    record.expect(study, "this version of mdr-tui")?;
    // Collects the rows in an unnamed file, in the directory of the merged table.
    let beside = target.as_ref().map(|target| target.directory().to_owned());
    let beside = beside.unwrap_or_else(env::temp_dir);
    let rows = tempfile::tempfile_in(&beside);
    let mut ledger = rows
        .and_then(|rows| Ledger::new(study, rows, &beside))
        .with_context(|| format!("{}: cannot make a temporary file", beside.display()))?;
    let mut arithmetic = Arithmetic::new();
    let (mut doubles, mut contradictions, mut count) = (Vec::new(), Vec::new(), 1);
    for file in &files {
        let record = Record::of_file(file)?;
        record.expect(study, &first.display().to_string())?;
        count = count.max(record.shard.count);
        arithmetic.extend(record.arithmetic.iter().cloned());
        for row in record.rows(study)? {
            let row = row?;
            let (file, axes) = (file.display(), study.axes.len().min(row.len()));
            let values = row[..axes].join(", ");
            match ledger
                .add_foreign(study, row)
                .context("cannot keep the rows")?
            {
                Ok(()) => {}
                Err(Refused::Double) => doubles.push(format!("{values} ({file})")),
                Err(Refused::Contradiction) => contradictions.push(format!("{values} ({file})")),
                Err(Refused::Foreign) => {
                    bail!("{file}: row {values} does not belong to the study");
                }
            }
        }
    }
    let rows = &ledger;
    if !doubles.is_empty() {
        let (count, named) = (doubles.len(), first_names(&doubles));
        let word = format!("{count} identical duplicate rows were dropped: {named}");
        complain(&word);
    }
    if !contradictions.is_empty() {
        let (count, named) = (contradictions.len(), first_names(&contradictions));
        bail!("{shown}: {count} points have two rows that differ: {named}");
    }
    refuse_missing(&shown, study, rows, count)?;
    let text = |out: &mut dyn Write| {
        out.write_all(record::head(study, Shard::WHOLE, &arithmetic).as_bytes())?;
        rows.each(|line| out.write_all(line))
    };
    match &target {
        Some(target) => target.write_with(text)?,
        None if options.json => {
            let mut out = io::stdout().lock();
            for point in 0..study.points() {
                writeln!(out, "{}", record::json(&study.columns(), &rows.row(point)?))?;
            }
        }
        None => text(&mut io::stdout().lock())?,
    }
    let (all, failed) = (rows.rows(), rows.failed());
    if failed > 0 {
        let word = format!("{failed} of {all} points failed; their status says why");
        complain(&word);
    }
    Ok(())
}

/// Returns the names of the CSV files in a directory, sorted. Opens nothing else: opening a pipe would block until its
/// other end is opened.
fn tables(directory: &Path) -> io::Result<Vec<PathBuf>> {
    let entries = fs::read_dir(directory)?.map(|entry| Ok(entry?.path()));
    let mut files: Vec<PathBuf> = entries.collect::<io::Result<_>>()?;
    files.retain(|path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.ends_with(".csv") && !name.starts_with('.') && path.is_file()
    });
    files.sort();
    Ok(files)
}

/// Refuses a study with missing points; names some of them, and the shards that should have them.
fn refuse_missing(shown: &str, study: &Study, rows: &Ledger, count: usize) -> Result<()> {
    let missing = || rows.missing(study, Shard::WHOLE);
    let (all, left) = (study.points(), study.points() - rows.rows());
    if left == 0 {
        return Ok(());
    }
    let names = missing().take(NAMED + 1).map(|point| study.name(point));
    let names = first_names(&names.collect::<Vec<_>>());
    let incomplete: BTreeSet<usize> = missing().map(|point| point % count).collect();
    let shards: Vec<String> = incomplete.iter().map(usize::to_string).collect();
    let shards = shards.join(",");
    bail!(
        "{shown}: {left} of {all} points are missing: {names}; of {count} shards, these are incomplete: {shards}"
    )
}

/// Lists the first few names.
fn first_names(names: &[String]) -> String {
    let more = if names.len() > NAMED { ", ..." } else { "" };
    names[..names.len().min(NAMED)].join(", ") + more
}

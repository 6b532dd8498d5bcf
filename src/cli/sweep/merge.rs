//! `sweep --merge`: merges the shards of a study into one table.

use std::collections::BTreeSet;
use std::env;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::{Context, Result, anyhow, bail};

use super::super::args::Sweep;
use super::super::complain;
use crate::export::target::Target;
use crate::scenario::limited::Unread;
use crate::scenario::{Refusal, printable};
use crate::studies::sweep::ledger::Ledger;
use crate::studies::sweep::record::{self, Arithmetic, Record, Refused};
use crate::studies::sweep::{Shard, Study};

/// Maximum number of points named in a message.
const NAMED: usize = 3;

/// Reads every table of the directory and writes the whole one.
pub fn merge(directory: &Path, options: &Sweep) -> Result<ExitCode> {
    let shown = printable(&directory.display().to_string());
    let target = Target::claim_given(options.out.as_deref(), options.force)?;
    let files = tables(directory).map_err(|error| Refusal::new(&shown, error))?;
    let mut arithmetic = Arithmetic::new();
    let mut merged: Option<(Study, PathBuf, Ledger)> = None;
    let (mut doubles, mut contradictions, mut count) = (Vec::new(), Vec::new(), 1);
    for file in files {
        if options.out.as_ref().is_some_and(|out| same(out, &file)) {
            continue;
        }
        let source = fs::File::open(&file)
            .map_err(|error| Refusal::new(file.display(), Unread::Io(error)))?;
        let record = Record::open(source, &file.display().to_string())?;
        count = count.max(record.shard.count);
        arithmetic.extend(record.arithmetic.iter().cloned());
        let (study, ledger) = match &mut merged {
            Some((study, first, ledger)) => {
                record.expect(study, &first.display().to_string())?;
                (study, ledger)
            }
            none => {
                let study = record.study()?;
                record.expect(&study, "this version of mdr-tui")?;
                let ledger = spool(&study, target.as_ref())?;
                let (study, _, ledger) = none.insert((study, file.clone(), ledger));
                (study, ledger)
            }
        };
        for row in record.rows(study)? {
            let row = row?;
            let values = row
                .iter()
                .take(study.axes.len())
                .cloned()
                .collect::<Vec<_>>()
                .join(", ");
            let named = format!("{values} ({})", file.display());
            match ledger.take(study, row).context("cannot keep the rows")? {
                Ok(()) => {}
                Err(Refused::Double) => doubles.push(named),
                Err(Refused::Contradiction) => contradictions.push(named),
                Err(Refused::Foreign | Refused::Length) => {
                    return Err(anyhow!(
                        "{}: row {values} does not belong to the study",
                        file.display()
                    ));
                }
            }
        }
    }
    let Some((study, _, rows)) = merged else {
        bail!(Refusal::new(shown, "has no table written by mdr-tui sweep"));
    };
    if !doubles.is_empty() {
        complain(&format!(
            "{} identical duplicate rows were dropped: {}",
            doubles.len(),
            some(&doubles)
        ));
    }
    if !contradictions.is_empty() {
        return Err(anyhow!(
            "{shown}: {} points have two rows that differ: {}",
            contradictions.len(),
            some(&contradictions)
        ));
    }
    refuse_missing(&shown, &study, &rows, count)?;
    let text = |out: &mut dyn Write| {
        out.write_all(record::head(&study, Shard::WHOLE, &arithmetic).as_bytes())?;
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
    let counts = rows.counts();
    let (all, failed) = (counts.rows, counts.failed);
    if failed > 0 {
        complain(&format!(
            "{failed} of {all} points failed; their status says why"
        ));
    }
    Ok(ExitCode::SUCCESS)
}

/// Rows in a file without a name, where the merged table will stand.
fn spool(study: &Study, target: Option<&Target>) -> Result<Ledger> {
    let directory = target.map_or_else(env::temp_dir, |target| target.directory().to_owned());
    Ledger::unnamed(study, &directory)
        .with_context(|| format!("{}: cannot make a temporary file", directory.display()))
}

/// The names of the CSV files of a directory, sorted. Nothing else is opened:
/// a pipe would wait for its other end.
fn tables(directory: &Path) -> io::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(directory)? {
        let path = entry?.path();
        let hidden = path
            .file_name()
            .is_some_and(|name| name.to_string_lossy().starts_with('.'));
        let is_table = path.extension().is_some_and(|ending| ending == "csv") && path.is_file();
        if is_table && !hidden {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

fn same(a: &Path, b: &Path) -> bool {
    matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

/// Names points without a row, and the shards that should have them.
fn refuse_missing(shown: &str, study: &Study, rows: &Ledger, count: usize) -> Result<()> {
    let missing = || rows.done().clone().missing(study, Shard::WHOLE);
    let (all, there) = (study.points(), rows.counts().rows);
    if there == all {
        return Ok(());
    }
    let names: Vec<String> = missing()
        .take(NAMED + 1)
        .map(|point| study.name(point))
        .collect();
    let shards: BTreeSet<usize> = missing().map(|point| point % count).collect();
    let shards: Vec<String> = shards.iter().map(usize::to_string).collect();
    Err(anyhow!(
        "{shown}: {} of {} points are missing: {}; of {count} shards, these are incomplete: {}",
        all - there,
        all,
        some(&names),
        shards.join(",")
    ))
}

/// The first few names.
fn some(names: &[String]) -> String {
    let more = if names.len() > NAMED { ", ..." } else { "" };
    names[..names.len().min(NAMED)].join(", ") + more
}

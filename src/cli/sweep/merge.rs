//! `sweep --merge`: merges the shards of a study into one table.

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};

use super::output;
use crate::cli::args::Sweep;
use crate::cli::{complain, stop};
use crate::export::target::Target;
use crate::scenario::{Refusal, printable};
use crate::studies::sweep::record::{self, Arithmetic, StudyFile};
use crate::studies::sweep::{Results, Shard};

/// Maximum number of points named in a message.
const NAMED: usize = 3;

/// Reads every table of the directory and writes the merged one.
pub fn merge(directory: &Path, options: &Sweep) -> Result<()> {
    let shown = printable(&directory.display().to_string());
    stop::end_at_signal()?;
    let out = options.out.as_deref().unwrap_or(Path::new("/dev/stdout"));
    let target = Target::claim(out, options.force)?;
    let mut files = tables(directory).map_err(|error| Refusal::new(&shown, error))?;
    let out = out.canonicalize().ok();
    files.retain(|file| out.is_none() || file.canonicalize().ok() != out);
    let rule = "has no table written by mdr-tui sweep";
    let first = files.first().ok_or_else(|| Refusal::new(&shown, rule))?;
    let records = files.iter().map(|file| StudyFile::of_file(file));
    let records: Vec<StudyFile> = records.collect::<Result<_, _>>()?;
    let study = records[0].study()?;
    records[0].expect(&study, "this version of mdr-tui")?;
    let (mut arithmetic, mut count) = (Arithmetic::new(), 1);
    for record in &records {
        record.expect(&study, &first.display().to_string())?;
        count = count.max(record.shard.count);
        arithmetic.extend(record.arithmetic.iter().cloned());
    }
    let (results, doubles) = Results::read(study, Shard::WHOLE, &records)?;
    if let (count @ 1.., named) = (doubles.same.len(), first_names(&doubles.same)) {
        complain(&format!(
            "{count} identical duplicate rows were dropped: {named}"
        ));
    }
    if let (count @ 1.., named) = (doubles.differing.len(), first_names(&doubles.differing)) {
        bail!("{shown}: {count} points have two rows that differ: {named}");
    }
    refuse_missing(&shown, &results, count)?;
    let head = record::head(&results.study, Shard::WHOLE, &arithmetic);
    if options.json && target.is_stdout() {
        let mut out = io::stdout().lock();
        for row in results.rows() {
            writeln!(out, "{}", results.json(row))?;
        }
    } else {
        output::write(&target, &head, &results)?;
    }
    if let (all, failed @ 1..) = (results.rows().len(), results.failed()) {
        complain(&format!(
            "{failed} of {all} points failed; their status says why"
        ));
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
fn refuse_missing(shown: &str, results: &Results, count: usize) -> Result<()> {
    let missing = results.missing(Shard::WHOLE);
    if missing.is_empty() {
        return Ok(());
    }
    let (all, left) = (results.study.points(), missing.len());
    let names = missing.iter().take(NAMED + 1);
    let names = first_names(&Vec::from_iter(
        names.map(|&point| results.study.name(point)),
    ));
    let incomplete: BTreeSet<usize> = missing.iter().map(|point| point % count).collect();
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

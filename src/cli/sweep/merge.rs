//! `sweep --merge`: merges the shards of a study into one table.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::{Result, anyhow};

use super::super::args::Sweep;
use super::super::{Misuse, complain};
use crate::export::target::Target;
use crate::scenario::printable;
use crate::studies::sweep::record::{self, Record, Refused, Rows};
use crate::studies::sweep::{Shard, Study};

/// Maximum number of points named in a message.
const NAMED: usize = 3;

/// Reads every table of the directory and writes the whole one.
pub fn merge(directory: &Path, options: &Sweep) -> Result<ExitCode> {
    let shown = printable(&directory.display().to_string());
    let target = options
        .out
        .as_deref()
        .map(|out| Target::claim(out, options.force))
        .transpose()?;
    let files = tables(directory).map_err(|error| Misuse(format!("{shown}: {error}")))?;
    let mut study: Option<(Study, PathBuf)> = None;
    let mut rows: Option<Rows> = None;
    let (mut doubles, mut contradictions, mut count) = (Vec::new(), Vec::new(), 1);
    for file in files {
        if options.out.as_ref().is_some_and(|out| same(out, &file)) {
            continue;
        }
        let text = fs::read_to_string(&file)
            .map_err(|error| Misuse(format!("{}: cannot be read: {error}", file.display())))?;
        let record = Record::parse(&text, &file.display().to_string())?;
        count = count.max(record.shard.count);
        let (study, _) = match &mut study {
            Some((study, first)) => {
                record.expect(study, &first.display().to_string())?;
                (study, first)
            }
            none => {
                let (study, first) = none.insert((record.study()?, file.clone()));
                record.expect(study, "this version of mdr-tui")?;
                (study, first)
            }
        };
        let rows = rows.get_or_insert_with(|| Rows::new(study));
        for row in record.rows {
            let values = row
                .iter()
                .take(study.axes.len())
                .cloned()
                .collect::<Vec<_>>()
                .join(", ");
            let named = format!("{values} ({})", file.display());
            match rows.take(row) {
                Ok(_) => {}
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
    let (Some((study, _)), Some(rows)) = (study, rows) else {
        return Err(Misuse(format!("{shown}: has no table written by mdr-tui sweep")).into());
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
    let head = record::head(&study, Shard::WHOLE);
    let text = rows.text(&head);
    match target {
        Some(target) => target
            .write(text.as_bytes())
            .map_err(|error| anyhow!("{error}"))?,
        None if options.json => {
            let mut out = io::stdout().lock();
            for row in rows.rows.iter().flatten() {
                writeln!(out, "{}", record::json(&study.columns(), row))?;
            }
        }
        None => io::stdout().write_all(text.as_bytes())?,
    }
    let (all, failed) = rows.count();
    if failed > 0 {
        complain(&format!(
            "{failed} of {all} points failed; their status says why"
        ));
    }
    Ok(ExitCode::SUCCESS)
}

/// The names of the CSV files of a directory, sorted.
fn tables(directory: &Path) -> io::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(directory)? {
        let path = entry?.path();
        let hidden = path
            .file_name()
            .is_some_and(|name| name.to_string_lossy().starts_with('.'));
        if path.extension().is_some_and(|ending| ending == "csv") && !hidden {
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
fn refuse_missing(shown: &str, study: &Study, rows: &Rows, count: usize) -> Result<()> {
    let missing: Vec<usize> = (0..study.points())
        .filter(|&point| rows.rows[point].is_none())
        .collect();
    if missing.is_empty() {
        return Ok(());
    }
    let names: Vec<String> = missing
        .iter()
        .take(NAMED + 1)
        .map(|&p| study.name(p))
        .collect();
    let mut shards: Vec<usize> = missing.iter().map(|point| point % count).collect();
    shards.sort_unstable();
    shards.dedup();
    let shards: Vec<String> = shards.iter().map(usize::to_string).collect();
    Err(anyhow!(
        "{shown}: {} of {} points are missing: {}; of {count} shards, these are incomplete: {}",
        missing.len(),
        study.points(),
        some(&names),
        shards.join(",")
    ))
}

/// The first few names.
fn some(names: &[String]) -> String {
    let more = if names.len() > NAMED { ", ..." } else { "" };
    names[..names.len().min(NAMED)].join(", ") + more
}

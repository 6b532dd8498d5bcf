//! `sweep --sensitivity`: how sensitive the results are to the keys, as a table.

use std::io::{self, Write};
use std::process::ExitCode;
use std::sync::atomic::Ordering;

use anyhow::Result;

use super::super::args::Sweep;
use super::super::{FAILED, complain, results, stop};
use crate::export::target::Target;
use crate::scenario::scalars::Value;
use crate::studies::sweep::Study;
use crate::studies::sweep::sensitivity::{self, Sensitivity};
use crate::studies::table::{Format, Table};

/// Runs the study of sensitivities and prints, or writes, its table.
pub fn sensitivity(options: &Sweep, study: &Study) -> Result<ExitCode> {
    let target = Target::claim_given(options.out.as_deref(), options.force)?;
    let keys = study.varied();
    let pool = super::pool(options)?;
    let stop = stop::patient_signal()?;
    let go_on = || !stop.load(Ordering::Relaxed);
    let Some(found) = sensitivity::run(study, &keys, &pool, &go_on)? else {
        complain("interrupted before all runs had finished: nothing was saved");
        return Ok(ExitCode::from(FAILED));
    };
    let table = table(&found);
    let lines = study.to_toml();
    let mut lines = lines.lines().filter(|line| !line.is_empty());
    let first = lines.next().unwrap_or_default();
    let others: Vec<String> = lines.map(|line| format!("study: {line}")).collect();
    results::write(target.as_ref(), first, &others, || table.csv())?;
    let mut stdout = io::stdout().lock();
    if options.json {
        results::print_json(&table, &mut stdout)?;
    } else if !options.quiet {
        let (cells, steps) = found.numerics;
        writeln!(
            stdout,
            "{}N = {cells}, {steps} steps per cycle",
            table.text()
        )?;
    }
    if !found.is_resolved {
        complain(
            "some elasticities have errors above 2 %; increase numerics.points and \
             numerics.steps_per_cycle",
        );
    }
    Ok(ExitCode::SUCCESS)
}

/// A row per key and column; at the end the spread that all keys bring about together.
fn table(found: &Sensitivity) -> Table {
    let mut table = Table::of(&[
        ("", "key", Format::Words),
        ("", "value", Format::Rough),
        ("", "column", Format::Words),
        ("", "result", Format::Rough),
        ("", "elasticity", Format::Fixed),
        ("", "error deviation relative_spread", Format::Rough),
    ]);
    let mut columns: Vec<&str> = Vec::new();
    for one in &found.elasticities {
        if !columns.contains(&one.column) {
            columns.push(one.column);
        }
        table.push(vec![
            one.key.clone().into(),
            one.value.into(),
            one.column.into(),
            one.result.into(),
            one.elasticity.map(|[elasticity, _]| elasticity).into(),
            one.elasticity.map(|[_, error]| error).into(),
            one.deviation.into(),
            one.spread().into(),
        ]);
    }
    for column in columns {
        let Some(spread) = found.spread(column) else {
            continue;
        };
        let result = found.elasticities.iter().find(|one| one.column == column);
        table.push(vec![
            "all".into(),
            Value::Missing,
            column.into(),
            result.and_then(|one| one.result).into(),
            Value::Missing,
            Value::Missing,
            Value::Missing,
            spread.into(),
        ]);
    }
    table
}

//! `sweep --sensitivity`: how sensitive the results are to the keys, as a table.

use anyhow::{Context, Result};

use crate::cli::args::Sweep;
use crate::cli::report::Report;
use crate::cli::{complain, stop};
use crate::export::target::Target;
use crate::studies::sweep::{Study, record, sensitivity};

/// Runs the sensitivity study and prints or writes its table.
pub fn sensitivity(options: &Sweep, study: &Study) -> Result<()> {
    let target = Target::claim_given(options.out.as_deref(), options.force)?;
    let pool = super::pool(options, usize::MAX)?;
    let go_on = stop::signal().map(stop::until_stopped)?;
    let found = sensitivity::run(study, &pool, &go_on)?;
    let found = found.context("interrupted before all runs had finished: nothing was saved")?;
    let table = &found.table;
    if let Some(target) = &target {
        target.write((record::header(study) + &table.csv()).as_bytes())?;
    }
    let (cells, steps) = found.numerics;
    if options.json || !options.quiet {
        let mut report = Report::default();
        report.table(table, 2);
        report.line(format!("N = {cells}, {steps} steps per cycle"));
        report.print(options.json.then_some(table))?;
    }
    if !found.is_resolved {
        complain(
            "some elasticities have errors above 2 %; increase numerics.points and \
             numerics.steps_per_cycle",
        );
    }
    Ok(())
}

//! `sweep --sensitivity`: how sensitive the results are to the keys, as a table.

use anyhow::{Context, Result};

use super::super::results;
use crate::cli::args::Sweep;
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
    let numerics = || format!("N = {cells}, {steps} steps per cycle\n");
    if options.json || !options.quiet {
        results::print(options.json.then_some(table), || table.text() + &numerics())?;
    }
    if !found.is_resolved {
        complain(
            "some elasticities have errors above 2 %; increase numerics.points and \
             numerics.steps_per_cycle",
        );
    }
    Ok(())
}

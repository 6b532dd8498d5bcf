//! `sweep --slurm`: a job script that runs a study as an array of tasks.
//!
//! It relies on the following:
//! - `--signal=B:TERM@60` sends the signal only to the batch shell, which passes it on; the trap is set before
//!   the program starts. `scancel`, preemption and `scontrol requeue` send SIGTERM to all processes, so the
//!   program may get it twice.
//! - Interrupted, the program keeps its rows and exits with 75; then the task asks to be queued again,
//!   as often as [`MOST_REQUEUES`].
//! - The number of shards is written down: Slurm's own count shrinks when single tasks are queued
//!   again.

use std::path::Path;

use super::named_after;
use crate::cli::UNFINISHED;
use crate::cli::args::Sweep;
use crate::export::file::{shell_path, shell_word};

/// Maximum number of times that an interrupted task asks to be queued again.
const MOST_REQUEUES: u32 = 100;

/// Returns the job script for a study of this many `points`.
pub fn script(study: &Path, options: &Sweep, points: usize) -> String {
    let shards = options.shards.unwrap_or(1);
    let directory = options.out.clone();
    let directory = directory.unwrap_or_else(|| named_after(study, "shards"));
    let (study, directory) = (shell_path(study), shell_path(&directory));
    let set = |set: &String| format!(" --set {}", shell_word(set.as_ref()));
    let mut more: String = options.changes.set.iter().map(set).collect();
    if options.skip_invalid {
        more += " --skip-invalid";
    }
    let wanted = [
        ("time", Some(&options.time)),
        ("account", options.account.as_ref()),
        ("partition", options.partition.as_ref()),
        ("mem", options.mem.as_ref()),
    ];
    let line = |(name, value)| Some(format!("#SBATCH --{name}={}\n", value?));
    let wanted: String = wanted.into_iter().filter_map(line).collect();
    let load = |name: &String| format!("module load {name}\n");
    let modules: String = options.module.iter().map(load).collect();
    format!(
        include_str!("slurm.sh"),
        points = points,
        shards = shards,
        last = shards - 1,
        directory = directory,
        study = study,
        more = more,
        wanted = wanted,
        modules = modules,
        unfinished = UNFINISHED,
        most_requeues = MOST_REQUEUES,
    )
}

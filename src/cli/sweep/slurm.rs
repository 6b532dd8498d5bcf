//! `sweep --slurm`: a job script that runs a study as an array of tasks.
//!
//! It relies on this:
//! - `--signal=B:TERM@60` goes to the batch shell alone, which passes it on; the trap is set before
//!   the program starts. `scancel`, preemption and `scontrol requeue` send SIGTERM to all processes,
//!   so that the program may get it twice.
//! - Interrupted, the program keeps its rows and exits with 75; then the task asks to be queued again,
//!   as often as [`MOST_REQUEUES`].
//! - The number of shards is written down: Slurm's own count shrinks when single tasks are queued
//!   again.

use std::path::Path;

use super::super::UNFINISHED;
use super::super::args::Sweep;
use super::shards_directory;
use crate::export::file::shell_word;

/// How often a task that was interrupted asks to be queued again.
const MOST_REQUEUES: u32 = 100;

/// Returns the job script for a study of this many `points`.
pub fn script(study: &Path, options: &Sweep, points: usize) -> String {
    let shards = options.shards.unwrap_or(1);
    let directory = options.out.clone();
    let directory = directory.unwrap_or_else(|| shards_directory(study));
    let (study, directory) = (shell_word(study), shell_word(&directory));
    let sets = options.changes.set.iter();
    let mut more: String = sets
        .map(|set| format!(" --set {}", shell_word(Path::new(set))))
        .collect();
    if options.skip_invalid {
        more += " --skip-invalid";
    }
    let last = shards - 1;
    let wanted = [
        ("time", Some(&options.time)),
        ("account", options.account.as_ref()),
        ("partition", options.partition.as_ref()),
        ("mem", options.mem.as_ref()),
    ];
    let wanted = wanted.into_iter();
    let wanted: String = wanted
        .filter_map(|(name, value)| Some(format!("#SBATCH --{name}={}\n", value?)))
        .collect();
    let modules = options.module.iter();
    let modules: String = modules
        .map(|name| format!("module load {name}\n"))
        .collect();
    format!(
        r#"#!/bin/bash
# {points} points in {shards} shards. Submit with: sbatch FILE   (a throttle: sbatch --array=0-{last}%4 FILE)
# When all tasks are done: mdr-tui sweep --merge {directory} --out map.csv
#SBATCH --job-name=sweep
#SBATCH --array=0-{last}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
{wanted}#SBATCH --signal=B:TERM@60
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=%x-%A_%a.log

{modules}program= signals=0
trap 'signals=$((signals + 1)); [ -z "$program" ] || kill -TERM "$program" 2>/dev/null' TERM
mdr-tui sweep {study} --shards {shards} --resume --out {directory}/shard-"$SLURM_ARRAY_TASK_ID".csv \
    --threads "${{SLURM_CPUS_PER_TASK:-1}}" --quiet{more} &
program=$!
[ "$signals" = 0 ] || kill -TERM "$program"
# A trapped signal ends wait before the program ends; then wait again. 127: there was nothing left.
status= seen=
while [ "$signals" != "$seen" ]; do
    seen=$signals
    wait "$program"; code=$?
    [ "$code" = 127 ] || status=$code
done
if [ "$status" = {UNFINISHED} ] && [ "${{SLURM_RESTART_COUNT:-0}}" -lt {MOST_REQUEUES} ]; then
    scontrol requeue "$SLURM_JOB_ID"
fi
exit "$status"
"#
    )
}

//! The options of `sweep`.

use std::path::PathBuf;

use clap::builder::{StringValueParser, TypedValueParser};
use clap::{ArgGroup, Args};

use super::{Changes, Screen};
use crate::scenario::printable;
use crate::studies::sweep::Shard;

/// Options of `sweep`.
#[derive(Debug, Args)]
#[command(after_help = include_str!("examples/sweep.txt").trim_end())]
#[command(group = ArgGroup::new("what").required(true).args(["study", "merge", "view"]))]
#[command(mut_group("Screen", |screen| screen.requires("view")))]
pub struct Sweep {
    /// The study, a .toml file.
    pub study: Option<PathBuf>,
    /// Changes applied to all points.
    #[command(flatten)]
    pub changes: Changes,
    /// Output file; default: the study's name with .csv; with --shard, a file in the directory
    /// STUDY.shards; with --merge, stdout.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Overwrite an existing file.
    #[arg(long, conflicts_with = "resume")]
    pub force: bool,
    /// Keep the rows in the file and run the missing points; without a file, start the study.
    #[arg(long)]
    pub resume: bool,
    /// Run failed points again.
    #[arg(long, requires = "resume")]
    pub failed: bool,
    /// Run the study even if some points are invalid; their rows give the reason.
    #[arg(long)]
    pub skip_invalid: bool,
    /// Number of threads; default: one per core.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=4096))]
    pub threads: Option<u16>,
    /// Run one part of the study: every n-th point, starting with point i.
    #[arg(long, value_name = "i/n", conflicts_with = "shards")]
    pub shard: Option<Shard>,
    /// Number of parts; SLURM_ARRAY_TASK_ID selects the one to run.
    #[arg(long, value_name = "n", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub shards: Option<u32>,
    /// Print a job script for Slurm, an array of --shards tasks.
    #[arg(long, requires = "shards", conflicts_with_all = ["resume", "force", "json", "merge"])]
    pub slurm: bool,
    /// With --slurm, the account that pays.
    #[arg(long, value_name = "NAME", requires = "slurm", value_parser = word_parser())]
    pub account: Option<String>,
    /// With --slurm, the partition.
    #[arg(long, value_name = "NAME", requires = "slurm", value_parser = word_parser())]
    pub partition: Option<String>,
    /// With --slurm, the time limit of a task, as Slurm reads it.
    #[arg(long, value_name = "TIME", requires = "slurm", default_value = "01:00:00", value_parser = word_parser())]
    pub time: String,
    /// With --slurm, the memory of a task, as Slurm reads it.
    #[arg(long, value_name = "SIZE", requires = "slurm", value_parser = word_parser())]
    pub mem: Option<String>,
    /// With --slurm, a module to load (repeatable).
    #[arg(long, value_name = "NAME", requires = "slurm", value_parser = word_parser())]
    pub module: Vec<String>,
    /// Print the scenario of this point as TOML, counted from 0 in the order of the rows.
    #[arg(long, value_name = "I", conflicts_with_all = ["slurm", "shard", "shards", "merge"])]
    pub point: Option<usize>,
    /// Merge the shards in this directory.
    #[arg(long, value_name = "DIR", conflicts_with_all = ["study", "set", "resume", "skip_invalid", "threads", "shard", "shards"])]
    pub merge: Option<PathBuf>,
    /// Show this table as a map.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["study", "set", "out", "resume", "force", "skip_invalid", "threads", "shard", "shards", "merge", "json"])]
    pub view: Option<PathBuf>,
    /// Refused, with a line that names what takes its place.
    #[arg(long, hide = true)]
    pub sensitivity: bool,
    /// Print the rows as JSON lines, in the order of the axes, as soon as they are known.
    #[arg(long)]
    pub json: bool,
    /// Print nothing but errors.
    #[arg(long)]
    pub quiet: bool,
    /// How the map looks.
    #[command(flatten, next_help_heading = "With --view")]
    pub screen: Screen,
}

/// Parses a word that a job script can contain unquoted.
fn word_parser() -> impl TypedValueParser<Value = String> {
    StringValueParser::new().try_map(|word| {
        let is_plain = |c: char| !c.is_whitespace() && !"#'\"\\$`;&|<>()".contains(c);
        if !word.is_empty() && printable(&word) == word && word.chars().all(is_plain) {
            Ok(word)
        } else {
            Err("must be a word without blanks and quotes")
        }
    })
}

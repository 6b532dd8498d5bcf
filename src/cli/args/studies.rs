//! Options of the studies. Those for the rows of their tables are the same for all.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::builder::{RangedI64ValueParser, TypedValueParser};
use clap::{Arg, Args, ValueEnum};

use super::Changes;
use super::values::{budget, by_name, cycles, load, number_within, points};
use crate::math::abel::AbelMethod;
use crate::plot::Marker;
use crate::scenario::columns::{self, NamedField};
use crate::studies::fit::Switch;
use crate::studies::measured::Pick;
use crate::studies::verify::{LADDER, Problem};
use crate::studies::{stability, trade};

/// Error for an accuracy outside the limits.
const ACCURACY: &str =
    "an accuracy is greater than 0 and at most 1, relative to the largest depth, e.g. 1e-3";

/// Options of `verify`.
#[derive(Debug, Args)]
#[command(after_help = include_str!("examples/verify.txt").trim_end())]
#[command(mut_args = in_words(&[
    ("csv", "Write the error at every node to this file"),
    ("plot", "Draw the errors over r/a, on the finest grid of each method"),
]))]
pub struct Verify {
    /// Run only this problem and print its table; can be repeated.
    #[arg(long, value_name = "NAME", value_parser = by_name(Problem::ALL.to_vec(), Problem::name))]
    pub problem: Vec<Problem>,
    /// Print the tables of all problems, not only the verdict.
    #[arg(long)]
    pub all: bool,
    /// Numbers of grid cells N to try; default: 50,100,200,400,800.
    #[arg(long, value_name = "N1,N2,...", value_parser = points(), default_values_t = LADDER)]
    #[arg(hide_default_value = true)]
    pub points: Vec<usize>,
    /// Also run what takes minutes: the limiting profile on more than 200 cells.
    #[arg(long)]
    pub long: bool,
    /// What is written and said.
    #[command(flatten)]
    pub output: TableOptions,
    /// What is drawn.
    #[command(flatten)]
    pub drawing: Drawing,
}

/// Options of `trade`.
#[derive(Debug, Args)]
#[command(after_help = include_str!("examples/trade.txt").trim_end())]
#[command(mut_args = in_words(&[
    ("csv", "Write all settings to this file"),
    ("plot", "Draw error against time, one plot per method; the overall front is dashed"),
    ("json", "Print all settings as JSON instead of a table"),
]))]
pub struct Trade {
    /// A preset's name, or a path to a .toml file.
    pub scenario: OsString,
    /// Changes to the scenario.
    #[command(flatten)]
    pub changes: Changes,
    /// Number of cycles to run; default: run.cycles of the scenario.
    #[arg(long, value_name = "X", value_parser = cycles)]
    pub cycles: Option<f64>,
    /// Methods to try; default: all.
    #[arg(long, value_name = "M1,M2,...", value_parser = methods(), default_values_t = AbelMethod::ALL)]
    #[arg(hide_default_value = true)]
    pub methods: Vec<AbelMethod>,
    /// Numbers of grid cells N to try.
    #[arg(long, value_name = "N1,N2,...", value_parser = points(), default_values_t = trade::POINTS)]
    pub points: Vec<usize>,
    /// Numbers of steps per cycle to try.
    #[arg(long, value_name = "S1,S2,...", value_parser = steps(), default_values_t = trade::STEPS)]
    pub steps: Vec<u32>,
    /// Print only the cheapest setting that passes its own checks and whose errors of depth, V, E_d and F_x are at
    /// most E.
    #[arg(long, value_name = "E", value_parser = number_within(f64::MIN_POSITIVE..=1.0, ACCURACY))]
    pub accuracy: Option<f64>,
    /// Print all settings, not only the Pareto front.
    #[arg(long)]
    pub all: bool,
    /// What is written and said.
    #[command(flatten)]
    pub output: TableOptions,
    /// What is drawn.
    #[command(flatten)]
    pub drawing: Drawing,
}

/// Options of `stability`.
#[derive(Debug, Args)]
#[command(after_help = include_str!("examples/stability.txt").trim_end())]
#[command(mut_args = in_words(&[
    ("csv", "Write all runs to this file"),
    ("json", "Print all runs as JSON instead of maps"),
]))]
pub struct StabilityOptions {
    /// A preset's name, or a path to a .toml file.
    pub scenario: OsString,
    /// Changes to the scenario.
    #[command(flatten)]
    pub changes: Changes,
    /// Number of cycles to run.
    #[arg(long, value_name = "X", value_parser = cycles, default_value_t = 20.0)]
    pub cycles: f64,
    /// Methods to try; default: all.
    #[arg(long, value_name = "M1,M2,...", value_parser = methods(), default_values_t = AbelMethod::ALL)]
    #[arg(hide_default_value = true)]
    pub methods: Vec<AbelMethod>,
    /// Numbers of grid cells N to try.
    #[arg(long, value_name = "N1,N2,...", value_parser = points(), default_values_t = stability::POINTS)]
    pub points: Vec<usize>,
    /// Values of K = k E* d/a to try, with d and a at the start.
    #[arg(long, value_name = "K1,K2,...", value_parser = wear_numbers(), default_values_t = stability::WEAR_NUMBERS)]
    pub wear_numbers: Vec<f64>,
    /// Steps per cycle.
    #[arg(long, value_name = "S", value_parser = steps(), default_value_t = 100)]
    pub steps: u32,
    /// Whether steps that are too stiff are split.
    #[arg(long, value_enum, default_value_t = Guard::Off)]
    pub guard: Guard,
    /// What is written and said.
    #[command(flatten)]
    pub output: TableOptions,
}

/// Options of `fit`.
#[derive(Debug, Args)]
#[command(after_help = include_str!("examples/fit.txt").trim_end())]
#[command(mut_args = in_words(&[
    ("plot", "Draw measured minus simulated values, one plot per data set"),
    ("json", "Print the keys with values, standard errors and correlations as JSON"),
    ("force", "Write over the file of --out"),
]))]
pub struct FitCommand {
    /// A preset's name, or a path to a .toml file; its values start the search.
    pub scenario: OsString,
    /// Changes to the scenario.
    #[command(flatten)]
    pub changes: Changes,
    /// A worn profile, or a map of it; can be repeated.
    #[arg(long, value_name = "FILE", required_unless_present_any = ["fretting_loop", "history"])]
    pub scar: Vec<PathBuf>,
    /// A fretting loop, of this cycle if it is given; can be repeated.
    #[arg(long = "loop", value_name = "FILE[@CYCLE]")]
    pub fretting_loop: Vec<PathBuf>,
    /// Worn volume, depth, approach or mass over cycles, time, distance or energy; can be repeated.
    #[arg(long, value_name = "FILE")]
    pub history: Vec<PathBuf>,
    /// How the columns of the files are to be read.
    #[command(flatten)]
    pub naming: NamingOptions,
    /// Compare these cycles of a record of several, counted from 1; default: all whole ones.
    #[arg(long, value_name = "FIRST..LAST")]
    pub pick: Option<Pick>,
    /// Density of what has worn, kg/m^3, where a history has masses.
    #[arg(long, value_name = "KG/M3")]
    pub density: Option<f64>,
    /// The keys to fit, by their dotted paths.
    #[arg(long, value_name = "KEY1,KEY2,...", required = true)]
    pub free: Vec<String>,
    /// Number of cycles to run; default: run.cycles of the scenario, or up to the end of the
    /// histories.
    #[arg(long, value_name = "X", value_parser = cycles)]
    pub cycles: Option<f64>,
    /// Give outliers less weight.
    #[arg(long)]
    pub robust: bool,
    /// Whether the zero of depths and forces is fitted; auto: where the data can show it.
    #[arg(long, value_enum, default_value_t)]
    pub level: Switch,
    /// Whether the centre of a scar and the zero of displacements are fitted.
    #[arg(long, value_enum, default_value_t)]
    pub shift: Switch,
    /// Whether the tilt of a trace through the axis is fitted.
    #[arg(long, value_enum, default_value_t)]
    pub tilt: Switch,
    /// If loops and scenario differ in their stroke: refuse, or use the stroke of the loops.
    #[arg(long, value_enum, default_value_t)]
    pub stroke: StrokeSource,
    /// Time limit of the search, e.g. 60s or 5min; then the best result so far is reported.
    #[arg(long, value_name = "TIME", value_parser = budget)]
    pub budget: Option<f64>,
    /// Write the fitted scenario to this file.
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Overwrite an existing file.
    #[arg(long, requires = "out")]
    pub force: bool,
    /// What is drawn.
    #[command(flatten)]
    pub drawing: Drawing,
    /// Print all rows as JSON.
    #[arg(long)]
    pub json: bool,
    /// Show no progress.
    #[arg(long)]
    pub quiet: bool,
}

/// Whose stroke a fit takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum StrokeSource {
    /// That of the scenario; loops of another one are refused.
    #[default]
    Scenario,
    /// That of the loops.
    FromData,
}

/// How the columns of a measured table are to be read where their names do not say it.
#[derive(Debug, Clone, Default, Args)]
pub struct NamingOptions {
    /// What stands in which column, by number or name: r and wear or f of a scar, u and F of a loop, cycle and
    /// wear_volume or depth of a history.
    #[arg(long, value_name = "r=2,wear=3,...")]
    pub fields: Vec<NamedField>,
    /// Units of these columns, or without --fields of all columns.
    #[arg(long, value_name = "um,nm,...")]
    pub units: Vec<String>,
}

impl NamingOptions {
    /// Returns the same for the reader of tables.
    pub fn of_columns(&self) -> columns::Naming {
        let (fields, units) = (self.fields.clone(), self.units.clone());
        columns::Naming {
            fields,
            units,
            key: None,
        }
    }
}

/// Options of `inspect`.
#[derive(Debug, Args)]
#[command(after_help = include_str!("examples/inspect.txt").trim_end())]
pub struct Inspect {
    /// A table of an instrument: a scar, a map, a loop, a history.
    pub file: PathBuf,
    /// How its columns are to be read.
    #[command(flatten)]
    pub naming: NamingOptions,
    /// Print the figures of this scenario next to the figures of each cycle of a loop's record, which ends with the
    /// scenario's cycle X with FILE@X, else with its last one.
    #[arg(long, value_name = "SCENARIO")]
    pub scenario: Option<OsString>,
    /// Look at these cycles of a loop's record, counted from 1.
    #[arg(long, value_name = "FIRST..LAST")]
    pub pick: Option<Pick>,
    /// The normal force, for the coefficient of friction of each cycle, e.g. 30N; default: the one of --scenario.
    #[arg(long, value_name = "FORCE", value_parser = load)]
    pub load: Option<f64>,
    /// What the plot is made of.
    #[arg(long, value_enum, default_value_t = Marker::Braille)]
    pub marker: Marker,
    /// Print what was understood as JSON.
    #[arg(long)]
    pub json: bool,
}

fn methods() -> impl TypedValueParser<Value = AbelMethod> {
    by_name(AbelMethod::ALL.to_vec(), AbelMethod::name)
}

/// Parses numbers of steps per cycle.
fn steps() -> RangedI64ValueParser<u32> {
    clap::value_parser!(u32).range(1..=100_000)
}

fn wear_numbers() -> impl Fn(&str) -> Result<f64, String> + Clone {
    let rule = "wear numbers are greater than 0 and at most 1e6, e.g. 0.3,3,30";
    number_within(f64::MIN_POSITIVE..=1e6, rule)
}

/// What `stability` does with stiff steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Guard {
    /// Take every step unsplit.
    Off,
    /// Split stiff steps.
    On,
    /// Run each case both ways.
    Both,
}

/// Output of a study: a file, stdout and stderr.
#[derive(Debug, Args)]
pub struct TableOptions {
    /// Write all rows to this file.
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Overwrite an existing file.
    #[arg(long, requires = "csv")]
    pub force: bool,
    /// Print all rows as JSON.
    #[arg(long)]
    pub json: bool,
    /// Show no progress.
    #[arg(long)]
    pub quiet: bool,
}

/// Curves printed below the tables of a study.
#[derive(Debug, Args)]
pub struct Drawing {
    /// Draw the rows.
    #[arg(long, conflicts_with = "json")]
    pub plot: bool,
    /// What the curves of --plot are made of.
    #[arg(long, value_enum, default_value_t = Marker::Braille, requires = "plot")]
    pub marker: Marker,
}

/// Replaces the help texts of shared options by ones worded for each study.
fn in_words(help: &'static [(&'static str, &'static str)]) -> impl Fn(Arg) -> Arg {
    |arg| match help.iter().find(|(name, _)| arg.get_id() == name) {
        Some((_, words)) => arg.help(*words),
        None => arg,
    }
}

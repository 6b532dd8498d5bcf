//! What can be typed: the whole command line, with its help.

use std::path::PathBuf;
use std::str::FromStr;
use std::time::Duration;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use serde::{Deserialize, Serialize};

use crate::math::abel::{AbelMethod, MOST_DENSE_CELLS};
use crate::math::grid::MIN_CELLS;
use crate::scenario::MOST_CYCLES;
use crate::studies::verify::{LADDER, Problem};
use crate::studies::{stability, trade};
use crate::tui::Size;
use crate::tui::plot::Marker;

/// Watch a fretting contact wear away, live in the terminal.
#[derive(Debug, Parser)]
#[command(
    name = "mdr-tui",
    version,
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    disable_help_subcommand = true,
    after_help = "Examples:\n  \
        mdr-tui                                     open the explorer on the preset li2019-fig3\n  \
        mdr-tui gross-slip --set numerics.points=200  another preset, with one value changed\n  \
        mdr-tui presets li2019-fig3 > mine.toml     start a scenario of one's own\n  \
        mdr-tui run mine.toml --cycles 200 --out X  the same simulation without a screen"
)]
pub struct Arguments {
    /// What to do instead of opening the explorer.
    #[command(subcommand)]
    pub command: Option<Command>,
    /// The explorer's options.
    #[command(flatten)]
    pub explore: Explore,
}

/// Everything but the explorer.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a scenario without a screen and write its files.
    Run(Run),
    /// List the presets, or print one as TOML.
    Presets(Presets),
    /// Compare every method with closed forms, over a ladder of N.
    Verify(Verify),
    /// Measure speed against accuracy: one scenario by many settings.
    Trade(Trade),
    /// Map the wear coefficients that each method bears: stable, teeth, exploded.
    Stability(Stability),
    /// Print a completion script for a shell.
    #[command(
        after_help = "Example:\n  mdr-tui completions bash > ~/.local/share/bash-completion/completions/mdr-tui"
    )]
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// Print the manual page.
    #[command(after_help = "Example:\n  mdr-tui man | man -l -")]
    Man,
}

/// A scenario and changes to it.
#[derive(Debug, Args)]
pub struct Changes {
    /// Change a key of the scenario, by its dotted path; can be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}

/// Options of the explorer.
#[derive(Debug, Args)]
pub struct Explore {
    /// A preset's name, or a path to a .toml file.
    #[arg(default_value = "li2019-fig3")]
    pub scenario: String,
    /// Changes to the scenario.
    #[command(flatten)]
    pub changes: Changes,
    /// The most frames drawn in a second.
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u16).range(1..=120))]
    pub fps: u16,
    /// How curves are drawn; the default is braille where the locale is UTF-8, else ascii.
    #[arg(long, value_enum)]
    pub marker: Option<MarkerChoice>,
    /// When to use colour; auto obeys NO_COLOR.
    #[arg(long, value_enum, default_value_t = ColorChoice::Auto)]
    pub color: ColorChoice,
    /// Which colours: for a dark or a light background, or none; the default is what the terminal
    /// says of its background, else dark.
    #[arg(long, value_enum)]
    pub theme: Option<ThemeChoice>,
    /// Use the mouse: a click focuses a panel, a second one zooms it, the wheel moves in lists; without
    /// this, the terminal keeps it for selecting text.
    #[arg(long)]
    pub mouse: bool,
    /// Press these keys instead of reading the keyboard, print the last screen and exit.
    #[arg(
        long,
        value_name = "SCRIPT",
        requires = "print",
        long_help = "Press these keys instead of reading the keyboard, print the last screen and exit.\n\n\
            Ordinary characters stand for themselves; <Space>, <Tab>, <Esc>, <Enter>, <Left>, ... for \
            keys, <lt> for \"<\". Every key waits until the simulation has answered the one before."
    )]
    pub keys: Option<String>,
    /// Go on where an explorer or a run was put away; the simulation starts paused.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["scenario", "set"])]
    pub resume: Option<PathBuf>,
    /// How often the session is put away so that it can be resumed, in seconds; 0: only at the end.
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = interval)]
    pub checkpoint_every: Interval,
    /// Print the screen at this size after the last key; the simulation starts paused.
    #[arg(long, value_name = "COLUMNSxROWS")]
    pub print: Option<Size>,
}

/// Options of `run`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    mdr-tui run li2019-fig3 --cycles 199.24 --snapshot-at 50.72,100 --out fig3\n  \
    mdr-tui run mine.toml --set numerics.method=b --out with-b\n  \
    mdr-tui run fig3/scenario.toml --out again    the same numbers to the last bit\n  \
    mdr-tui run --resume fig3/run.checkpoint      go on with a run that was interrupted")]
pub struct Run {
    /// A preset's name, or a path to a .toml file.
    #[arg(required_unless_present = "resume")]
    pub scenario: Option<String>,
    /// Changes to the scenario.
    #[command(flatten)]
    pub changes: Changes,
    /// Go on with a run that was interrupted, or one that the explorer put away.
    #[arg(
        long,
        value_name = "FILE",
        conflicts_with_all = ["scenario", "set", "snapshot_at", "history"]
    )]
    pub resume: Option<PathBuf>,
    /// How many cycles to run; default: the scenario's run.cycles.
    #[arg(long, value_name = "X", value_parser = cycles, allow_hyphen_values = true)]
    pub cycles: Option<f64>,
    /// Write the state at these cycles as well; default: the scenario's run.snapshot_at.
    #[arg(
        long,
        value_name = "C1,C2,...",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    pub snapshot_at: Option<Vec<CycleAsGiven>>,
    /// The directory for the files; default: a new one named after the scenario, with --resume the
    /// run's own.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Write into a directory that holds files already.
    #[arg(long)]
    pub force: bool,
    /// Which moments the history records.
    #[arg(long, value_enum, default_value_t = HistoryChoice::Cycle)]
    pub history: HistoryChoice,
    /// How often the run is put away so that it can be resumed, in seconds; 0: only when it stops.
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = interval)]
    pub checkpoint_every: Interval,
    /// Print the last moment as JSON.
    #[arg(long)]
    pub json: bool,
    /// Print nothing but errors.
    #[arg(long)]
    pub quiet: bool,
}

/// Options of `presets`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  mdr-tui presets\n  mdr-tui presets cone > mine.toml")]
pub struct Presets {
    /// Print this preset.
    pub name: Option<String>,
    /// Print the list as JSON.
    #[arg(long)]
    pub json: bool,
}

/// Options of `verify`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    mdr-tui verify                                  the error tables of all problems\n  \
    mdr-tui verify --problem hertz --csv fig2.csv   Fig. 2 of the paper, node by node\n  \
    mdr-tui verify --problem hertz --points 100 --plot")]
pub struct Verify {
    /// Only this problem; can be repeated.
    #[arg(long, value_name = "NAME", value_parser = problem_parser())]
    pub problem: Vec<Problem>,
    /// The numbers of grid cells N to try; default: 50,100,200,400,800.
    #[arg(
        long,
        value_name = "N1,N2,...",
        value_delimiter = ',',
        value_parser = points,
        allow_hyphen_values = true,
        default_values_t = LADDER,
        hide_default_value = true
    )]
    pub points: Vec<usize>,
    /// Also the runs that take minutes: the limiting profile on more than 200 cells.
    #[arg(long)]
    pub long: bool,
    /// Write the error at every node to this file.
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Write over a file that is there already.
    #[arg(long, requires = "csv")]
    pub force: bool,
    /// Draw the errors over r/a, on the finest grid of each method.
    #[arg(long, conflicts_with = "json")]
    pub plot: bool,
    /// What the curves of --plot are made of.
    #[arg(long, value_enum, default_value_t = MarkerChoice::Braille, requires = "plot")]
    pub marker: MarkerChoice,
    /// Print all rows as JSON instead of tables.
    #[arg(long)]
    pub json: bool,
    /// Show no progress.
    #[arg(long)]
    pub quiet: bool,
}

/// Options of `trade`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    mdr-tui trade li2019-fig3 --plot            the Pareto front, as a table and drawn\n  \
    mdr-tui trade mine.toml --accuracy 1e-3     the cheapest setting that errs by 1e-3 at most\n  \
    mdr-tui trade mine.toml --methods product,a --points 50,100,200 --csv trade.csv")]
pub struct Trade {
    /// A preset's name, or a path to a .toml file.
    pub scenario: String,
    /// Changes to the scenario.
    #[command(flatten)]
    pub changes: Changes,
    /// How many cycles to run; default: the scenario's run.cycles.
    #[arg(long, value_name = "X", value_parser = cycles, allow_hyphen_values = true)]
    pub cycles: Option<f64>,
    /// The methods to try; default: all.
    #[arg(long, value_name = "M1,M2,...", value_delimiter = ',', value_parser = method_parser())]
    pub methods: Vec<AbelMethod>,
    /// The numbers of grid cells N to try.
    #[arg(
        long,
        value_name = "N1,N2,...",
        value_delimiter = ',',
        value_parser = points,
        allow_hyphen_values = true,
        default_values_t = trade::POINTS
    )]
    pub points: Vec<usize>,
    /// The steps a cycle to try.
    #[arg(
        long,
        value_name = "S1,S2,...",
        value_delimiter = ',',
        value_parser = clap::value_parser!(u32).range(1..=100_000),
        default_values_t = trade::STEPS
    )]
    pub steps: Vec<u32>,
    /// Print only the cheapest setting whose error is at most E, in largest depths.
    #[arg(long, value_name = "E", value_parser = accuracy)]
    pub accuracy: Option<f64>,
    /// Print all settings, not only the front.
    #[arg(long)]
    pub all: bool,
    /// Write all settings to this file.
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Write over a file that is there already.
    #[arg(long, requires = "csv")]
    pub force: bool,
    /// Draw error over time, a plot a method, the front of all dashed.
    #[arg(long, conflicts_with = "json")]
    pub plot: bool,
    /// What the curves of --plot are made of.
    #[arg(long, value_enum, default_value_t = MarkerChoice::Braille, requires = "plot")]
    pub marker: MarkerChoice,
    /// Print all settings as JSON instead of a table.
    #[arg(long)]
    pub json: bool,
    /// Show no progress.
    #[arg(long)]
    pub quiet: bool,
}

/// Options of `stability`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    mdr-tui stability li2019-fig3                         every method as it was published\n  \
    mdr-tui stability li2019-fig3 --guard both --methods product,b\n  \
    mdr-tui stability mine.toml --points 100 --wear-numbers 1,3,10,30 --csv map.csv")]
pub struct Stability {
    /// A preset's name, or a path to a .toml file.
    pub scenario: String,
    /// Changes to the scenario.
    #[command(flatten)]
    pub changes: Changes,
    /// How many cycles to run.
    #[arg(long, value_name = "X", value_parser = cycles, allow_hyphen_values = true, default_value_t = 20.0)]
    pub cycles: f64,
    /// The methods to try; default: all.
    #[arg(long, value_name = "M1,M2,...", value_delimiter = ',', value_parser = method_parser())]
    pub methods: Vec<AbelMethod>,
    /// The numbers of grid cells N to try.
    #[arg(
        long,
        value_name = "N1,N2,...",
        value_delimiter = ',',
        value_parser = points,
        allow_hyphen_values = true,
        default_values_t = stability::POINTS
    )]
    pub points: Vec<usize>,
    /// The wear numbers K = k E* d/a to try, d and a at the beginning.
    #[arg(
        long,
        value_name = "K1,K2,...",
        value_delimiter = ',',
        value_parser = wear_number,
        allow_hyphen_values = true,
        default_values_t = stability::WEAR_NUMBERS
    )]
    pub wear_numbers: Vec<f64>,
    /// The steps a cycle.
    #[arg(long, value_name = "S", value_parser = clap::value_parser!(u32).range(1..=100_000), default_value_t = 100)]
    pub steps: u32,
    /// Whether steps that are too harsh are taken in parts.
    #[arg(long, value_enum, default_value_t = Guard::Off)]
    pub guard: Guard,
    /// Write all runs to this file.
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Write over a file that is there already.
    #[arg(long, requires = "csv")]
    pub force: bool,
    /// Print all runs as JSON instead of maps.
    #[arg(long)]
    pub json: bool,
    /// Show no progress.
    #[arg(long)]
    pub quiet: bool,
}

/// What `stability` does about harsh steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Guard {
    /// The raw method.
    Off,
    /// Parts.
    On,
    /// One after the other.
    Both,
}

/// Which moments `history.csv` records.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum HistoryChoice {
    /// The end of every cycle.
    Cycle,
    /// Every step.
    EveryStep,
}

/// How curves are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MarkerChoice {
    /// Eight dots a cell.
    Braille,
    /// Two blocks a cell.
    Halfblock,
    /// One dot a cell.
    Dot,
    /// One asterisk a cell.
    Ascii,
}

impl From<MarkerChoice> for Marker {
    fn from(choice: MarkerChoice) -> Self {
        match choice {
            MarkerChoice::Braille => Self::Braille,
            MarkerChoice::Halfblock => Self::HalfBlock,
            MarkerChoice::Dot => Self::Dot,
            MarkerChoice::Ascii => Self::Ascii,
        }
    }
}

/// When colour is used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ColorChoice {
    /// Unless NO_COLOR is set.
    Auto,
    /// Always.
    Always,
    /// Never.
    Never,
}

/// Time between two checkpoints; none: only at the end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval(pub Option<Duration>);

fn interval(text: &str) -> Result<Interval, String> {
    match text.parse::<f64>() {
        Ok(0.0) => Ok(Interval(None)),
        Ok(seconds) if (1e-3..=1e6).contains(&seconds) => {
            Ok(Interval(Some(Duration::from_secs_f64(seconds))))
        }
        _ => Err("an interval is 0, or from 0.001 to 1000000 seconds, e.g. 60".into()),
    }
}

/// Which colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ThemeChoice {
    /// For a dark background.
    Dark,
    /// For a light background.
    Light,
    /// Bold, dim and reversed only.
    Mono,
}

/// A cycle, and how it was spelled: the spelling names its file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct CycleAsGiven {
    /// The cycle.
    pub cycle: f64,
    /// As typed.
    pub spelling: String,
}

impl From<CycleAsGiven> for String {
    fn from(cycle: CycleAsGiven) -> Self {
        cycle.spelling
    }
}

impl TryFrom<String> for CycleAsGiven {
    type Error = String;

    fn try_from(spelling: String) -> Result<Self, String> {
        spelling.parse()
    }
}

impl FromStr for CycleAsGiven {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let spelling = text.trim().to_owned();
        Ok(Self {
            cycle: cycles(&spelling)?,
            spelling,
        })
    }
}

fn cycles(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (0.0..=MOST_CYCLES).contains(&value) => Ok(value),
        Ok(value) if value > MOST_CYCLES && value.is_finite() => {
            Err(format!("a run has {MOST_CYCLES:e} cycles or fewer"))
        }
        _ => Err("cycles are a number of 0 or more, e.g. 199.24".into()),
    }
}

fn points(text: &str) -> Result<usize, String> {
    match text.trim().parse::<usize>() {
        Ok(points) if (MIN_CELLS..=MOST_DENSE_CELLS).contains(&points) => Ok(points),
        _ => Err(format!(
            "points are whole numbers from {MIN_CELLS} to {MOST_DENSE_CELLS}, e.g. 100,1000"
        )),
    }
}

fn wear_number(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value > 0.0 && value <= 1e6 => Ok(value),
        _ => Err("wear numbers are greater than 0 and at most 1e6, e.g. 0.3,3,30".into()),
    }
}

fn accuracy(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value <= 1.0 => Ok(value),
        _ => {
            Err("an accuracy is greater than 0 and at most 1, in largest depths, e.g. 1e-3".into())
        }
    }
}

fn method_parser() -> impl TypedValueParser<Value = AbelMethod> {
    PossibleValuesParser::new(AbelMethod::ALL.map(AbelMethod::name))
        .try_map(|name| name.parse::<AbelMethod>())
}

fn problem_parser() -> impl TypedValueParser<Value = Problem> {
    PossibleValuesParser::new(Problem::ALL.map(Problem::name))
        .try_map(|name| name.parse::<Problem>())
}

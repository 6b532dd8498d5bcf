//! What can be typed: the whole command line, with its help.

use std::path::PathBuf;
use std::str::FromStr;

use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::tui::Size;

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
    /// Print the screen at this size after the last key; the simulation starts paused.
    #[arg(long, value_name = "COLUMNSxROWS")]
    pub print: Option<Size>,
}

/// Options of `run`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    mdr-tui run li2019-fig3 --cycles 199.24 --snapshot-at 50.72,100 --out fig3\n  \
    mdr-tui run mine.toml --set numerics.method=b --out with-b\n  \
    mdr-tui run fig3/scenario.toml --out again    the same numbers to the last bit")]
pub struct Run {
    /// A preset's name, or a path to a .toml file.
    pub scenario: String,
    /// Changes to the scenario.
    #[command(flatten)]
    pub changes: Changes,
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
    /// The directory for the files; default: a new one named after the scenario.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Write into a directory that holds files already.
    #[arg(long)]
    pub force: bool,
    /// Which moments the history records.
    #[arg(long, value_enum, default_value_t = HistoryChoice::Cycle)]
    pub history: HistoryChoice,
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

/// A cycle, and how it was spelled: the spelling names its file.
#[derive(Debug, Clone, PartialEq)]
pub struct CycleAsGiven {
    /// The cycle.
    pub cycle: f64,
    /// As typed.
    pub spelling: String,
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
        Ok(value) if value.is_finite() && value >= 0.0 => Ok(value),
        _ => Err("cycles are a number of 0 or more, e.g. 199.24".into()),
    }
}

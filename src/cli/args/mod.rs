//! The command line and its help.

use std::ffi::OsString;
use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, Parser, Subcommand};
use clap_complete::engine::{ArgValueCandidates, ArgValueCompleter};
use ratatui::layout::Size;
use serde::Serialize;

use super::complete;

use crate::plot::Marker;
use crate::plot::theme::Look;
use crate::tui::parse_size;

mod figure;
mod studies;
mod sweep;
mod values;

pub use figure::{Figure, PaperFigure};
pub use studies::{
    FitCommand, Guard, Inspect, NamingOptions, StabilityOptions, StrokeSource, TableOptions, Trade,
    Verify,
};
pub use sweep::Sweep;
pub use values::cycles;
pub use values::{ColorChoice, CycleAsGiven, HistoryChoice};
use values::{budget, interval, listed};

/// Watch a fretting contact wear away, live in the terminal.
#[derive(Debug, Parser)]
#[command(
    name = "mdr-tui",
    version = crate::export::provenance::VERSION,
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    disable_help_subcommand = true,
    mut_subcommands = |command| command.mut_args(listed),
    after_help = include_str!("examples/program.txt").trim_end()
)]
pub struct Arguments {
    /// What to do instead of opening the explorer.
    #[command(subcommand)]
    pub command: Option<CliCommand>,
    /// The explorer's options.
    #[command(flatten)]
    pub explore: Explore,
}

/// All commands except the explorer.
#[derive(Debug, Subcommand)]
pub enum CliCommand {
    /// Run a scenario without a screen and write its files.
    Run(RunOptions),
    /// List the presets, or print one as TOML.
    Presets(Presets),
    /// Answer a few questions, and get a commented scenario of your own.
    ///
    /// Each question has a default, which an empty line takes; what closed forms say of the answers (contact radius, Hertz
    /// pressure, stick or slip) appears below it. Options answer questions beforehand; without a terminal nothing is
    /// asked, and what is not given has its default.
    New(New),
    /// Compare every method with closed forms, for increasing N.
    Verify(Verify),
    /// Measure speed against accuracy of one scenario, for many settings.
    Trade(Trade),
    /// Map the wear coefficients that each method tolerates.
    Stability(StabilityOptions),
    /// Read the guide: methods, accuracy, files, every key of a scenario.
    Guide(Guide),
    /// Run a study: one scenario with many values of some of its keys.
    Sweep(Sweep),
    /// Draw figures for a paper: SVG, PNG or PDF, with their data next to them.
    Figure(Figure),
    /// Find parameters from measured scars, loops and histories.
    Fit(FitCommand),
    /// Show how a measured table is read: columns, units, cycles, zeros; and draw it.
    Inspect(Inspect),
    /// Print a completion script for a shell.
    #[command(
        after_help = "Example:\n  mdr-tui completions bash > ~/.local/share/bash-completion/completions/mdr-tui"
    )]
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// Print the man pages, or write them to files.
    Man(Manual),
}

/// A scenario and changes to it.
#[derive(Debug, Args)]
pub struct Changes {
    /// Set a key of the scenario by its dotted path; can be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE", add = ArgValueCompleter::new(complete::assignments))]
    pub set: Vec<String>,
}

/// Options of the explorer.
#[derive(Debug, Args)]
pub struct Explore {
    /// A preset's name, a path to a .toml file, or a snapshot's directory, to continue its run.
    #[arg(default_value = "li2019-fig3", add = ArgValueCompleter::new(complete::scenarios))]
    pub scenario: OsString,
    /// Changes to the scenario.
    #[command(flatten)]
    pub changes: Changes,
    /// Lay measured data, a run's files or a scenario over the plots; can be repeated.
    ///
    /// FILE is a CSV file (a scar: r_um, wear_nm; a loop: u_um, F_N; a history: cycle, wear_volume_um3 or depth_um;
    /// error_... for error bars), a run's or a snapshot's directory, one of its tables, or a scenario, which runs
    /// alongside.
    #[arg(long, value_name = "FILE", add = ArgValueCompleter::new(complete::overlays))]
    pub overlay: Vec<OsString>,
    /// How the columns of measured overlays are to be read.
    #[command(flatten)]
    pub naming: NamingOptions,
    /// Show the contact and one chart with large words, for a projector: slowly first, then faster.
    #[arg(long)]
    pub present: bool,
    /// Continue from a checkpoint of the explorer or of a run; the simulation starts paused.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["scenario", "set"])]
    pub resume: Option<PathBuf>,
    /// Checkpoint interval in seconds; 0: only at the end.
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = interval)]
    pub checkpoint_every: Duration,
    /// How the screen looks.
    #[command(flatten)]
    pub screen: Screen,
}

/// Display options.
#[derive(Debug, Clone, Args)]
pub struct Screen {
    /// Maximum frame rate per second; default 10.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=120))]
    pub fps: Option<u16>,
    /// Characters for curves; default: braille in a UTF-8 locale, otherwise ascii.
    #[arg(long, value_enum)]
    pub marker: Option<Marker>,
    /// When to use colour; the default, auto, obeys NO_COLOR.
    #[arg(long, value_enum)]
    pub color: Option<ColorChoice>,
    /// Colours for a dark or light background, or none; default: as the terminal reports its
    /// background, otherwise dark.
    #[arg(long, value_enum)]
    pub theme: Option<Look>,
    /// Use the mouse: a click focuses a panel, a second one zooms it, the wheel scrolls lists.
    /// Without this option the terminal keeps it for selecting text.
    #[arg(long)]
    pub mouse: bool,
    /// Press these keys instead of reading the keyboard, print the last screen and exit.
    #[arg(
        long,
        value_name = "SCRIPT",
        requires = "print",
        allow_hyphen_values = true,
        long_help = "Press these keys instead of reading the keyboard, print the last screen and exit.\n\n\
            Ordinary characters stand for themselves; <Space>, <Tab>, <Esc>, <Enter>, <Left>, ... for \
            keys, <lt> for \"<\". Each key waits until the simulation has handled the previous one."
    )]
    pub keys: Option<String>,
    /// Print the screen at this size after the last key, and exit; the simulation starts paused.
    #[arg(long, value_name = "COLUMNSxROWS", value_parser = parse_size)]
    pub print: Option<Size>,
}

/// Options of `run`.
#[derive(Debug, Args)]
#[command(
    override_usage = "mdr-tui run [OPTIONS] <SCENARIO>\n       mdr-tui run [OPTIONS] --resume <FILE>"
)]
#[command(after_help = include_str!("examples/run.txt").trim_end())]
pub struct RunOptions {
    /// A preset's name, or a path to a .toml file; - is the standard input.
    #[arg(required_unless_present = "resume", add = ArgValueCompleter::new(complete::scenarios))]
    pub scenario: Option<OsString>,
    /// Changes to the scenario.
    #[command(flatten)]
    pub changes: Changes,
    /// Continue an interrupted run in its folder, or a session of the explorer, from its checkpoint.
    #[arg(
        long,
        value_name = "FILE",
        conflicts_with_all = ["scenario", "set", "snapshot_at", "history", "column"]
    )]
    pub resume: Option<PathBuf>,
    /// Number of cycles to run; default: run.cycles of the scenario.
    #[arg(long, value_name = "X", value_parser = cycles)]
    pub cycles: Option<f64>,
    /// Also write the state at these cycles; default: run.snapshot_at of the scenario.
    #[arg(long, value_name = "C1,C2,...")]
    pub snapshot_at: Option<Vec<CycleAsGiven>>,
    /// Estimate the error of the result from coarser runs and write it into the file headers.
    #[arg(long)]
    pub estimate_error: bool,
    /// Time limit, e.g. 60s or 5min. A search for numerics.accuracy leaves enough of it to run the best level found so
    /// far; a run that does not end in time saves a checkpoint and exits with 75.
    #[arg(long, value_name = "TIME", value_parser = budget)]
    pub budget: Option<f64>,
    /// Also write field.csv: the stresses inside the half-space at the end and the fatigue parameters of a
    /// steady cycle, in the plane of motion.
    #[arg(long)]
    pub field: bool,
    /// Directory for the files; default: a new one named after the scenario. A run is resumed in its own folder,
    /// which may have been moved.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Write into a directory that is not empty.
    #[arg(long)]
    pub force: bool,
    /// How often the history records a row.
    #[arg(long, value_enum, default_value_t = HistoryChoice::Cycle)]
    pub history: HistoryChoice,
    /// Also record these quantities in the history, by the names that a study gives its columns.
    #[arg(long, value_name = "NAME,...")]
    pub column: Vec<String>,
    /// Checkpoint interval in seconds; 0: only when the run stops.
    #[arg(long, value_name = "SECONDS", default_value = "60", value_parser = interval)]
    pub checkpoint_every: Duration,
    /// Print the final state as JSON.
    #[arg(long)]
    pub json: bool,
    /// Print nothing but errors.
    #[arg(long)]
    pub quiet: bool,
}

/// Options of `guide`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  mdr-tui guide\n  mdr-tui guide scenarios")]
pub struct Guide {
    /// The topic; without one, all topics are listed.
    #[arg(add = ArgValueCandidates::new(complete::topics))]
    pub topic: Option<String>,
}

/// Options of `man`.
#[derive(Debug, Args)]
#[command(after_help = include_str!("examples/manual.txt").trim_end())]
pub struct Manual {
    /// The command; without one, the program and all commands.
    pub command: Option<String>,
    /// Write each page to a file in this directory, as mdr-tui-run.1.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// Options of `new`.
#[derive(Debug, Args, Serialize)]
#[command(after_help = include_str!("examples/new.txt").trim_end())]
pub struct New {
    /// The file to write.
    #[arg(default_value = "new.toml")]
    #[serde(skip)]
    pub file: PathBuf,
    /// Radius of a ball; for two curved bodies 1/R = 1/R1 + 1/R2.
    #[arg(long, value_name = "RADIUS", conflicts_with_all = ["punch", "cylinder"])]
    pub ball: Option<String>,
    /// Radius of a flat punch.
    #[arg(long, value_name = "RADIUS", conflicts_with = "cylinder")]
    pub punch: Option<String>,
    /// Radius of a cylinder on its side: a line contact.
    #[arg(long, value_name = "RADIUS", conflicts_with = "depth")]
    pub cylinder: Option<String>,
    /// Length of the cylinder; forces, volume and energy are of all of it.
    #[arg(long, value_name = "LENGTH")]
    pub length: Option<String>,
    /// Depth of the point that the stroke of a cylinder is measured against.
    #[arg(long, value_name = "LENGTH")]
    pub gauge: Option<String>,
    /// Material of the indenter: steel, titanium alloy, bronze, alumina, glass, rigid and others, or E,NU.
    #[arg(long, value_name = "NAME|E,NU")]
    pub material: Option<String>,
    /// Material of the flat body.
    #[arg(long, value_name = "NAME|E,NU")]
    pub against: Option<String>,
    /// Load that is held, as by a dead weight: the contact sinks in as it wears.
    #[arg(long, value_name = "FORCE", conflicts_with = "depth")]
    pub load: Option<String>,
    /// Depth that is held: wear unloads the contact.
    #[arg(long, value_name = "LENGTH")]
    pub depth: Option<String>,
    /// Stroke, from turning point to turning point.
    #[arg(long, value_name = "LENGTH")]
    pub stroke: Option<String>,
    /// Cycles per second.
    #[arg(long, value_name = "HZ")]
    pub frequency: Option<String>,
    /// Coefficient of friction: dry metals 0.5 to 0.9, ceramics 0.3 to 0.6, lubricated 0.1.
    #[arg(long, value_name = "MU")]
    pub friction: Option<String>,
    /// Wear coefficient of a pin test, per load and sliding distance, or none: mild 1e-7 to 1e-5, severe 1e-4 mm3/Nm.
    #[arg(long, value_name = "MM3/NM|none")]
    pub wear: Option<String>,
    /// Number of cycles; with more than 1000, cycles that are alike are jumped over.
    #[arg(long, value_name = "CYCLES")]
    pub cycles: Option<String>,
    /// Replace the file if it is there.
    #[arg(long)]
    pub force: bool,
    /// Open the scenario in the explorer.
    #[arg(long)]
    pub open: bool,
}

/// Options of `presets`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  mdr-tui presets\n  mdr-tui presets cone > mine.toml")]
pub struct Presets {
    /// Print this preset.
    #[arg(add = ArgValueCandidates::new(complete::presets))]
    pub name: Option<String>,
    /// Print the list as JSON.
    #[arg(long)]
    pub json: bool,
}
